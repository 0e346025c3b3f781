// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What `fretwork check` says of a sweep: which of its cases would be refused.
#pragma once
#include "app/stages.hpp"

namespace fretwork::app {

/// Reads the cases of `[sweep]` one after the other, as many as a few seconds allow; nothing is computed.
/// @param request  of a study with `[sweep]`; `scratch` is a folder for its mesh
/// @return lines for the terminal: the cases, and those that would be refused
/// @throws core::Error where a limit is asked of an output that there is not, or every case would be refused; without OpenTURNS
[[nodiscard]] std::string sweep_check_text(const Request& request);

} // namespace fretwork::app
