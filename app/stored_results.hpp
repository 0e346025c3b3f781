// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the results folder holds already.
#pragma once
#include "app/stages.hpp"
#include <filesystem>
#include <functional>
#include <string>

namespace fretwork::app {

/// True where the results in the folder are whole and were computed from the same inputs. @param tell  takes a line on results that are damaged
[[nodiscard]] bool up_to_date(const Inputs& inputs, const std::function<void(const std::string&)>& tell);

/// True where a folder holds the results of a transient, of any inputs and version.
[[nodiscard]] bool has_run(const std::filesystem::path& folder);

} // namespace fretwork::app
