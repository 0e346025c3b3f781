// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stability.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "flow/vortex_shedding.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// Modes near the frequency of vortices, one warning for each zone: the nearest.
void screen_shedding(const std::string& what, const PlacedFlow& placed, const flow::Sampling& sampling,
                     double strouhal, results::RunResults& out) {
  const auto found = flow::shedding_coincidences(sampling, strouhal);
  const auto distance = [&](const flow::SheddingCoincidence& one) {
    return std::abs(sampling.frequency(one.mode) - one.frequency) / one.frequency;
  };
  for (std::size_t z = 0; z < placed.profile.zones().size(); ++z) {
    const flow::SheddingCoincidence* nearest = nullptr;
    int modes = 0;
    for (const flow::SheddingCoincidence& one : found) {
      if (one.zone != static_cast<int>(z))
        continue;
      ++modes;
      if (!nearest || distance(one) < distance(*nearest))
        nearest = &one;
    }
    if (nearest)
      out.warnings.push_back(fmt::format("{}, zone \"{}\": vortices are shed at {:.4g} Hz at s = {:.4g} m, "
                                         "within {:g} % of mode {} at {:.4g} Hz ({} "
                                         "mode{} of this zone)",
                                         what, placed.profile.zones()[z].name, nearest->frequency, nearest->s,
                                         100.0 * flow::shedding_band, nearest->mode + 1,
                                         sampling.frequency(nearest->mode), modes, modes == 1 ? "" : "s"));
  }
}

/// One tube on the modes of one assessment. @param all  takes warnings
results::StabilityAssessment assess(const TubesInFlow& tubes, const PlacedFlow& placed,
                                    const study::Stability& assessment, const PinnedModes& modes,
                                    results::RunResults& all) {
  const study::Flow& flow = tubes.study.flows[placed.entry];
  const std::string what = fmt::format("stability \"{}\", {}", assessment.name, name_of(flow));
  const flow::Tube tube = tube_of(tubes.study, placed, tubes.model);
  const std::size_t structure = structure_of(placed, flow.name, modes.bases);
  const flow::Sampling sampling = flow::sample(tube, placed.profile, modes.bases[structure]);
  results::StabilityAssessment out;
  out.name = assessment.name;
  out.pinned = names_of(tubes.study, modes.pins.held);
  out.sweep = assessment.sweep;
  out.damping_given = assessment.damping.has_value();
  out.damping = damping_of_tube(tubes, placed, tube, sampling,
                                supports_of(tubes, placed, tube, modes.pins.held, modes.pins.left_out), what);
  out.damping.structure = structure;
  const Eigen::VectorXd ratios = assessment.damping
                                     ? Eigen::VectorXd::Constant(sampling.modes(), *assessment.damping)
                                     : out.damping.damping.stability();
  try {
    out.stability = flow::stability(placed.profile, sampling, ratios, assessment.component);
  } catch (const core::Error& error) {
    throw core::Error(
        fmt::format("{}: {} (a ratio may be given by [[stability]] damping)", what, error.what()));
  }
  if (assessment.strouhal)
    screen_shedding(what, placed, sampling, *assessment.strouhal, all);
  return out;
}

/// The worst case in words, as a warning where it is unstable.
void report(const results::StabilityAssessment& found, results::RunResults& out) {
  const auto& cases = found.stability.cases;
  const auto worst = std::max_element(cases.begin(), cases.end(),
                                      [](const auto& a, const auto& b) { return a.margin() > b.margin(); });
  if (worst == cases.end() || worst->critical_mode < 0)
    return;
  const bool unstable = worst->margin() <= 0.0;
  const auto& mode = found.stability.modes[static_cast<std::size_t>(worst->critical_mode)];
  const std::string text = fmt::format(
      "stability \"{}\" of flow \"{}\": V/Vc = {:.4g} in mode {} at {:.4g} Hz, margin {:.4g}{}", found.name,
      found.damping.tube, 1.0 - worst->margin(), worst->critical_mode + 1, mode.frequency, worst->margin(),
      unstable ? ": fluid-elastically unstable, which no force of the transient stands for" : "");
  if (unstable)
    out.warnings.push_back(text);
  else // before the notes of other kinds
    out.notes.insert(out.notes.begin() +
                         static_cast<std::ptrdiff_t>(std::min(out.notes.size(), out.stability.size())),
                     text);
}

} // namespace

std::vector<study::Stability> assessments_of(const study::Study& study) {
  if (!study.stabilities.empty())
    return study.stabilities;
  study::Stability one;
  one.name = "all contacts pinned";
  return {one};
}

PinsAsked pins_asked(const study::Stability& assessment) {
  return {fmt::format("stability \"{}\"", assessment.name), assessment.pinned, assessment.contacts};
}

void assess_stability(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<PlacedContact>& contacts,
                      results::RunResults& out) {
  for (const study::Stability& assessment : assessments_of(tubes.study)) {
    const PinnedModes modes = pinned_modes(comm, pins_asked(assessment), tubes, contacts, out.notes);
    core::agree(comm, [&] {
      for (const PlacedFlow& placed : tubes.flows) {
        results::StabilityAssessment found = assess(tubes, placed, assessment, modes, out);
        out.notes.insert(out.notes.end(), found.damping.limits.begin(), found.damping.limits.end());
        report(found, out);
        out.stability.push_back(std::move(found));
      }
    });
  }
}

} // namespace fretwork::app
