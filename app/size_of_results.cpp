// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/size_of_results.hpp"
#include "app/expected_time.hpp"
#include "app/jobs.hpp"
#include "results/figures.hpp"
#include "results/totals.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

constexpr double of_number = sizeof(double);
constexpr double of_contact = 12.0 * of_number + 1.0; // displacement, velocity, gap, forces, normal; state
constexpr double of_node = 9.0 * of_number, of_mode = 2.0 * of_number;
constexpr double of_impact = 8.0 * of_number; // a row of the table

} // namespace

SizeOfResults size_of_results(const study::Study& study, const std::vector<BuiltScene>& scenes,
                              const std::vector<PlacedContact>& placed, double outputs,
                              const std::vector<double>& rows) {
  SizeOfResults size;
  double at_an_output = of_number; // the time
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const BuiltScene& built = scenes[s];
    at_an_output += of_node * static_cast<double>(built.nodes.size());
    if (study.output.modal)
      at_an_output += of_mode * static_cast<double>(built.modes);
    for (const std::size_t c : built.contacts)
      at_an_output += study.contacts[placed[c].entry].series ? of_contact : 0.0;
    size.impacts += of_impact * rows[s] * static_cast<double>(built.contacts.size());
  }
  size.series = outputs * at_an_output;
  return size;
}

std::string size_text(double bytes) {
  constexpr double thousand = 1e3;
  for (const char* unit : {"B", "kB", "MB"}) {
    if (bytes < thousand)
      return fmt::format("{:.3g} {}", bytes, unit);
    bytes /= thousand;
  }
  return fmt::format("{:.3g} GB", bytes);
}

void leave_out_series(const study::Study& study, const std::vector<PlacedContact>& placed,
                      results::RunResults& out) {
  if (!study.output.modal) {
    out.series.modal_displacement.resize(0, 0);
    out.series.modal_velocity.resize(0, 0);
  }
  std::erase_if(out.series.contacts, [&](const post::ContactSeries& series) {
    const auto found = std::find_if(placed.begin(), placed.end(), [&](const PlacedContact& contact) {
      return contact.name == series.name;
    });
    return found != placed.end() && !study.contacts[found->entry].series;
  });
}

std::string forecast_text(MPI_Comm comm, const study::Study& study, const std::vector<BuiltScene>& scenes,
                          const std::vector<PlacedContact>& placed, results::RunResults& out) {
  const Forecast forecast = check_jobs(comm, study, scenes);
  out.warnings.insert(out.warnings.end(), forecast.warnings.begin(), forecast.warnings.end());
  const SizeOfResults size = size_of_results(study, scenes, placed, forecast.outputs, forecast.impact_rows);
  const std::string steps = forecast.steps > 0.0
                                ? results::counted(static_cast<std::int64_t>(forecast.steps), "step")
                                : std::string("steps as the tolerance asks for");
  std::string limit;
  if (out.modes_limit)
    limit = fmt::format(" up to {:.4g} Hz ({})", out.modes_limit->up_to,
                        std::isnan(out.modes_limit->accuracy)
                            ? std::string("the most that the default takes")
                            : fmt::format("modes.accuracy = {:g}{}", out.modes_limit->accuracy,
                                          study.modes.number_given ? "" : ", the default"));
  return fmt::format(
      "  {}{}; a run: {:g} s, {}, {}{}; results.h5: {} of series, up to {} of impacts\n  step: {}\n",
      results::counted(static_cast<std::int64_t>(results::sorted_modes(out.bases).size()), "mode"), limit,
      study.transient->duration, steps, time_text(forecast.time),
      study.gap_opening ? fmt::format(" each of up to {} times", study.gap_opening->stages) : "",
      size_text(size.series), size_text(size.impacts), forecast.step_reason);
}

} // namespace fretwork::app
