// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/export.hpp"
#include "app/size_of_results.hpp"
#include "app/stages.hpp"
#include "core/error.hpp"
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// What the series hold of the outputs, and how to choose others.
std::string series_text(const results::VtuSeries& series) {
  if (series.count == 0)
    return "modes.vtu alone: these results hold no series of the modes (no [transient], or output.modal = "
           "false)\n";
  return fmt::format("modes.vtu, snapshots.pvd{}: {} of {} outputs, {:g} to {:g} s, {}{}\n",
                     series.contacts ? ", contacts.pvd" : "", series.count, series.outputs, series.from,
                     series.to, size_text(series.bytes),
                     series.count < series.outputs ? "; --from, --to and --every choose others" : "");
}

} // namespace

std::string export_results(const ExportRequest& request) {
  if (request.format != "vtu" && request.window.given())
    throw core::Error(
        fmt::format("--from, --to and --every choose outputs for --format vtu, and --format {} has all; "
                    "leave them out, or add --format vtu",
                    request.format));
  const results::RunResults stored = results::read_archive(request.directory);
  const std::filesystem::path target = request.directory / ("export-" + request.format);
  make_directory(target);
  std::string more;
  try {
    if (request.format == "csv")
      results::export_csv(target, stored);
    else if (request.format == "vtu")
      more = series_text(results::export_vtu(target, stored, request.window));
    else
      results::export_msh(target, stored);
  } catch (...) {
    std::error_code not_empty; // what was written, or an earlier export, stays
    std::filesystem::remove(target, not_empty);
    throw;
  }
  return fmt::format("written: {}\n{}", target.string(), more);
}

} // namespace fretwork::app
