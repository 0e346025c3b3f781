// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stability.hpp"
#include "app/fluidelastic.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "flow/vortex_shedding.hpp"
#include "results/flow_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

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

/// One tube on the modes of one assessment. @param ratios  its damping   @param all  takes warnings
results::StabilityAssessment assess(const TubesInFlow& tubes, const PlacedFlow& placed,
                                    const study::Stability& assessment, const PinnedModes& modes,
                                    Eigen::VectorXd& ratios, results::RunResults& all) {
  const study::Flow& flow = tubes.study.flows[placed.entry];
  const std::string what = fmt::format("stability \"{}\", {}", assessment.name, name_of(flow));
  const flow::Tube tube = tube_of(tubes.study, placed, tubes.model);
  const std::size_t structure = structure_of(placed, flow.name, modes.bases);
  const flow::Sampling sampling = flow::sample(tube, placed.profile, modes.bases[structure]);
  results::StabilityAssessment out;
  out.name = assessment.name;
  out.pinned = names_of(tubes.study, modes.pins);
  out.elastic = assessment.elastic;
  out.sticking = assessment.sticking;
  out.sweep = assessment.sweep;
  out.damping_given = assessment.damping.has_value();
  out.damping = damping_of_tube(tubes, placed, tube, sampling,
                                supports_of(tubes, placed, tube, modes.pins.held, modes.pins.left_out), what);
  out.damping.structure = structure;
  ratios = assessment.damping ? Eigen::VectorXd::Constant(sampling.modes(), *assessment.damping)
                              : out.damping.damping.stability();
  try {
    out.stability = flow::stability(placed.profile, sampling, ratios, assessment.component);
  } catch (const core::Error& error) {
    const bool of_ratio = std::string_view(error.what()).find("damping ratio") != std::string_view::npos;
    throw core::Error(fmt::format("{}: {}{}", what, error.what(),
                                  of_ratio ? " (a ratio may be given by [[stability]] damping)" : ""));
  }
  out.directions = flow::mode_directions(sampling);
  if (assessment.strouhal)
    screen_shedding(what, placed, sampling, *assessment.strouhal, all);
  return out;
}

/// ", out of plane", ", 71% y".
std::string moves_text(const flow::ModeDirection& direction) {
  return direction.kind == flow::ModeDirection::Kind::none ? std::string()
                                                           : ", " + flow::short_text(direction);
}

/// The worst case in words, as a warning where it is unstable. @param has_law  of fluidelastic forces
void report(const results::StabilityAssessment& found, bool has_law, results::RunResults& out) {
  const auto& cases = found.stability.cases;
  if (cases.empty() || found.stability.modes.empty())
    return;
  const flow::StabilityCase& worst = cases[results::worst_case(found.stability)];
  const auto note = [&](const std::string& text) { // before the notes of other kinds
    out.notes.insert(out.notes.begin() +
                         static_cast<std::ptrdiff_t>(std::min(out.notes.size(), out.stability.size())),
                     text);
  };
  if (!worst.margin()) {
    note(fmt::format(
        "stability \"{}\" of flow \"{}\": not assessed, because no mode moves in a velocity across "
        "the tube (Connors' criterion is not one of axial flow)",
        found.name, found.damping.tube));
    return;
  }
  const double margin = *worst.margin();
  const bool unstable = margin <= 0.0;
  const auto& mode = found.stability.modes[static_cast<std::size_t>(worst.critical_mode)];
  const char* stands_for = has_law ? ", by Connors" : ", which no force of the transient stands for";
  const std::string text = fmt::format(
      "stability \"{}\" of flow \"{}\": V/Vc = {:.4g} in mode {} at {:.4g} Hz{}, margin {:.4g}{}{}",
      found.name, found.damping.tube, 1.0 - margin, worst.critical_mode + 1, mode.frequency,
      moves_text(found.directions[static_cast<std::size_t>(worst.critical_mode)]), margin,
      unstable ? ": fluid-elastically unstable" : "", unstable ? stands_for : "");
  if (unstable)
    out.warnings.push_back(text);
  else
    note(text);
}

/// What the law of the flow says in words; a warning where the velocities given are unstable, or where a crossing is outside of the range of the law.
void report_law(const results::StabilityAssessment& found, results::RunResults& out) {
  if (!found.law)
    return;
  const results::LawStability& law = *found.law;
  const std::string what =
      fmt::format("stability \"{}\" of flow \"{}\", fluidelastic law{}", found.name, found.damping.tube,
                  law.tubes.size() > 1 ? fmt::format(" of {} tubes", law.tubes.size()) : "");
  const flow::Crossing* critical = law.diagram.critical();
  if (!critical) {
    out.notes.push_back(
        fmt::format("{}: stable up to {:g} times the velocity", what, law.diagram.factors.back()));
    return;
  }
  const double frequency = flow::frequency_of(critical->root);
  const std::string at =
      fmt::format("{}: critical velocity {:.5g} m/s, factor {:.5g}, with the damping of the assessment, {}",
                  what, critical->factor * law.velocity, critical->factor,
                  frequency > 0.0 ? fmt::format("at {:.5g} Hz", frequency) : std::string("by divergence"));
  const bool unstable = law.diagram.factors.back() >= 1.0 && law.unstable_at(1.0);
  (unstable ? out.warnings : out.notes)
      .push_back(at + (unstable ? ": unstable at the velocities given" : ""));
  for (const flow::Crossing& one : law.diagram.crossings) {
    if (one.factor == 0.0)
      continue;
    if (const auto reduced = law.reduced_velocity(one.factor, flow::frequency_of(one.root));
        reduced && law.outside(*reduced))
      out.warnings.push_back(fmt::format(
          "{}: reduced velocity {:.4g} of the crossing at factor {:.5g} is outside the law's range "
          "{:g} to {:g}; the law is extrapolated",
          what, *reduced, one.factor, (*law.range)[0], (*law.range)[1]));
  }
}

} // namespace

std::vector<study::Stability> assessments_of(const study::Study& study) {
  if (!study.stabilities.empty())
    return study.stabilities;
  study::Stability one;
  one.name = "all contacts pinned";
  const bool law = std::any_of(study.flows.begin(), study.flows.end(),
                               [](const study::Flow& flow) { return flow.law.has_value(); });
  if (!law)
    return {one};
  study::Stability free; // a law is assessed for the tube between its supports, and held by them
  free.name = "without contacts";
  free.pinned = study::Pinned::none;
  if (study.contacts.empty())
    return {free};
  one.name = "contacts closed";
  one.elastic = one.sticking = true;
  return {free, one};
}

PinsAsked pins_asked(const study::Stability& assessment) {
  return {fmt::format("stability \"{}\"", assessment.name),
          assessment.pinned,
          assessment.contacts,
          {assessment.elastic, assessment.sticking}};
}

ConnorsStability connors_stability(MPI_Comm comm, const TubesInFlow& tubes,
                                   const std::vector<PlacedContact>& contacts) {
  results::RunResults out; // its notes are those of the study
  for (study::Stability assessment : tubes.study.stabilities) {
    assessment.strouhal.reset();
    const PinnedModes modes = pinned_modes(comm, pins_asked(assessment), tubes, contacts, out.notes);
    core::agree(comm, [&] {
      for (const PlacedFlow& placed : tubes.flows) {
        Eigen::VectorXd ratios;
        out.stability.push_back(assess(tubes, placed, assessment, modes, ratios, out));
        report(out.stability.back(), tubes.study.flows[placed.entry].law.has_value(), out);
      }
    });
  }
  return {std::move(out.stability), std::move(out.warnings)};
}

void assess_stability(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<PlacedContact>& contacts,
                      results::RunResults& out) {
  for (const study::Stability& assessment : assessments_of(tubes.study)) {
    const PinnedModes modes = pinned_modes(comm, pins_asked(assessment), tubes, contacts, out.notes);
    core::agree(comm, [&] {
      std::vector<results::StabilityAssessment> all;
      std::vector<Eigen::VectorXd> ratios(tubes.flows.size());
      for (std::size_t f = 0; f < tubes.flows.size(); ++f)
        all.push_back(assess(tubes, tubes.flows[f], assessment, modes, ratios[f], out));
      assess_laws(tubes, modes.bases, assessment, ratios, all);
      for (std::size_t f = 0; f < all.size(); ++f) {
        results::StabilityAssessment& found = all[f];
        if (!found.damping_given) // correlations of damping are of no effect on a given ratio
          out.notes.insert(out.notes.end(), found.damping.limits.begin(), found.damping.limits.end());
        report(found, tubes.study.flows[tubes.flows[f].entry].law.has_value(), out);
        report_law(found, out);
        out.stability.push_back(std::move(found));
      }
    });
  }
}

} // namespace fretwork::app
