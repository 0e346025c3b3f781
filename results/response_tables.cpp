// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/flow_text.hpp"
#include "results/text_file.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace fretwork::results {
namespace {

constexpr std::size_t most_points = 60;

std::string in_micrometres(double metres) { return fmt::format("{:.4g}", 1e6 * metres); }

} // namespace

std::string response_table(const RunResults& results) {
  std::string text;
  for (const LinearResponse& response : results.responses) {
    text += fmt::format("Linear response \"{}\" on {} modes, {}; maxima of {:g} s, not exceeded with "
                        "probability {:g}\n",
                        response.name, response.modes, pinned_text(response.pinned), response.duration,
                        response.probability);
    text += fmt::format("  lowest mode {:.4g} Hz with {:.3g} % of critical damping{}\n", response.frequency,
                        100.0 * response.damping,
                        response.by_flow
                            ? ", by the flow and the supports (set of stability); in a transient closed "
                              "contacts take the part of the supports"
                            : "");
    text += fmt::format("  {:<24} {:>6} {:>10} {:>12} {:>12} {:>10}\n", "node or contact", "along", "rms um",
                        "rms mm/s", "crossings/s", "max um");
    for (std::size_t k = 0; k < std::min(most_points, response.points.size()); ++k) {
      const ResponsePoint& p = response.points[k];
      text += fmt::format("  {:<24} {:>6} {:>10} {:>12.4g} {:>12.4g} {:>10}\n", p.name, p.direction,
                          in_micrometres(p.rms), 1e3 * p.rms_velocity, p.up_crossings,
                          p.maximum ? in_micrometres(*p.maximum) : "-");
    }
    if (response.points.size() > most_points)
      text += fmt::format("  ... {} more in response.csv\n", response.points.size() - most_points);
  }
  return text;
}

void write_response_csv(const std::filesystem::path& file, const RunResults& results) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "response,name,direction,rms [m],rms_velocity [m/s],up_crossings [1/s],irregularity [1],"
                 "maximum [m],share_outside [1],share_above [1]\n");
  for (const LinearResponse& response : results.responses)
    for (const ResponsePoint& p : response.points)
      fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{}\n", quoted(response.name), quoted(p.name),
                     p.direction, p.rms, p.rms_velocity, p.up_crossings, p.irregularity,
                     p.maximum ? fmt::format("{}", *p.maximum) : "", p.share_outside, p.share_above);
  write_text(file, {text.data(), text.size()});
}

} // namespace fretwork::results
