// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stability.hpp"
#include "app/pinned_model.hpp"
#include "app/stages.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "flow/vortex_shedding.hpp"
#include "modal/slepc_structures.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

bool is_pinned(const study::Stability& assessment, const study::Contact& contact) {
  switch (assessment.pinned) {
  case study::Pinned::contacts:
    return contact.active;
  case study::Pinned::none:
    return false;
  case study::Pinned::named:
    break;
  }
  const auto& names = assessment.contacts;
  return std::find(names.begin(), names.end(), contact.name) != names.end();
}

std::vector<std::string> names_of(const study::Study& study, const std::vector<PlacedContact>& pins) {
  std::vector<std::string> names;
  for (const PlacedContact& pin : pins)
    if (const std::string& name = study.contacts[pin.entry].name;
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

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
                                    const study::Stability& assessment,
                                    const std::vector<PlacedContact>& pins,
                                    const std::vector<PlacedContact>& others,
                                    const std::vector<modal::Basis>& bases, results::RunResults& all) {
  const study::Flow& flow = tubes.study.flows[placed.entry];
  const std::string what = fmt::format("stability \"{}\", {}", assessment.name, name_of(flow));
  const flow::Tube tube = tube_of(tubes.study, placed, tubes.model);
  const std::size_t structure = structure_of(placed, flow.name, bases);
  const flow::Sampling sampling = flow::sample(tube, placed.profile, bases[structure]);
  results::StabilityAssessment out;
  out.name = assessment.name;
  out.pinned = names_of(tubes.study, pins);
  out.sweep = assessment.sweep;
  out.damping_given = assessment.damping.has_value();
  out.damping =
      damping_of_tube(tubes, placed, tube, sampling, supports_of(tubes, placed, tube, pins, others), what);
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
  (unstable ? out.warnings : out.notes)
      .push_back(fmt::format(
          "stability \"{}\" of flow \"{}\": V/Vc = {:.4g} in mode {} at {:.4g} Hz, margin "
          "{:.4g}{}",
          found.name, found.damping.tube, 1.0 - worst->margin(), worst->critical_mode + 1, mode.frequency,
          worst->margin(),
          unstable ? ": fluid-elastically unstable, which no force of the transient stands for" : ""));
}

} // namespace

std::vector<study::Stability> assessments_of(const study::Study& study) {
  if (!study.stabilities.empty())
    return study.stabilities;
  study::Stability one;
  one.name = "all contacts pinned";
  return {one};
}

std::vector<PlacedContact> pins_of(const study::Stability& assessment, const study::Study& study,
                                   const fem::Model& model, const std::vector<PlacedContact>& contacts,
                                   std::vector<std::string>& notes) {
  std::vector<PlacedContact> pins;
  for (const PlacedContact& contact : contacts) {
    if (!is_pinned(assessment, study.contacts[contact.entry]))
      continue;
    if (can_pin(model, contact)) {
      pins.push_back(contact);
      continue;
    }
    const std::string problem =
        fmt::format("stability \"{}\": contact \"{}\" is between two nodes that move and "
                    "pins nothing",
                    assessment.name, contact.name);
    if (assessment.pinned == study::Pinned::named)
      throw core::Error(problem + "; leave it out of pinned");
    notes.push_back(problem);
  }
  return pins;
}

void assess_stability(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<PlacedContact>& contacts,
                      results::RunResults& out) {
  const study::Modes& modes = tubes.study.modes;
  for (const study::Stability& assessment : assessments_of(tubes.study)) {
    std::vector<PlacedContact> pins, others;
    fem::Model pinned;
    std::vector<fem::Structure> structures;
    core::agree(comm, [&] {
      pins = pins_of(assessment, tubes.study, tubes.model, contacts, out.notes);
      std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(others),
                   [&](const PlacedContact& contact) {
                     return !is_pinned(assessment, tubes.study.contacts[contact.entry]);
                   });
      pinned = pinned_model(tubes.study, tubes.model, pins);
      structures = moving_structures(pinned);
    });
    const std::vector<modal::Basis> bases =
        modal::solve_structures(comm, pinned, structures, {modes.count, modes.up_to_hz}, modes.distributed);
    core::agree(comm, [&] {
      for (const PlacedFlow& placed : tubes.flows) {
        results::StabilityAssessment found = assess(tubes, placed, assessment, pins, others, bases, out);
        out.notes.insert(out.notes.end(), found.damping.limits.begin(), found.damping.limits.end());
        report(found, out);
        out.stability.push_back(std::move(found));
      }
    });
  }
}

} // namespace fretwork::app
