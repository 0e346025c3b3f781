// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `fretwork export`: results in the formats of other programs.
#pragma once
#include "results/write.hpp"

namespace fretwork::app {

struct ExportRequest {
  std::filesystem::path directory; ///< of the results
  std::string format = "csv";      ///< csv, vtu or msh
  results::OutputWindow window;    ///< of vtu
};

/// Writes DIR/export-<format>/ from the results in DIR.
/// @return where the files are and what they hold, for the terminal
/// @throws core::Error where there is nothing to export, or a window is given for another format than vtu
[[nodiscard]] std::string export_results(const ExportRequest& request);

} // namespace fretwork::app
