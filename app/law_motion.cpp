// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/law_motion.hpp"
#include "app/tubes_of_laws.hpp"
#include "flow/welch.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

constexpr double linear_share = 0.1;       ///< of the diameter, up to which the laws hold
constexpr double most_building_up = 0.7;   ///< rms of the first quarter of the statistics over that later
constexpr double spectrum_stretches = 4.0; ///< of the later part
constexpr Eigen::Index fewest_in_spectrum = 256; ///< outputs
constexpr double same_motion = 1e-3;             ///< relative, of motions
constexpr double least_unfolded = 0.75;          ///< of half the output rate

double deviation(const post::Moments& m) { return std::max(m.max - m.mean, m.mean - m.min); }

/// The outputs that the statistics see.
struct Outputs {
  explicit Outputs(const results::RunResults& results)
      : time(results.series.time), count(time.size()), from(first_at(results.statistics_from)),
        later(std::max(from, first_at(0.5 * results.duration))),
        step(count > 1 ? (time(count - 1) - time(0)) / static_cast<double>(count - 1) : 0.0) {}

  const Eigen::VectorXd& time;
  Eigen::Index count, from, later;
  double step; ///< s

private:
  [[nodiscard]] Eigen::Index first_at(double instant) const {
    return std::lower_bound(time.begin(), time.end(), instant) - time.begin();
  }
};

/// Of the modes of a law at each output from the statistics on, J.
Eigen::VectorXd modal_energies(const TubesOfLaw& of, const Outputs& outputs,
                               const results::RunResults& results) {
  const Eigen::Index seen = outputs.count - outputs.from, later = outputs.count - outputs.later;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(seen);
  if (later == 0) // of a run that ended early
    return out;
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < results.bases.size(); ++s) {
    const modal::Basis& basis = results.bases[s];
    if (std::binary_search(of.structures.begin(), of.structures.end(), s))
      for (Eigen::Index mode = 0; mode < basis.size(); ++mode) {
        const auto a = results.series.modal_displacement.row(row + mode);
        const auto v = results.series.modal_velocity.row(row + mode);
        const double mean = a.tail(later).mean(), stiffness = std::pow(basis.omega(mode), 2);
        out.array() +=
            0.5 *
            (v.tail(seen).array().square() + stiffness * (a.tail(seen).array() - mean).square()).transpose();
      }
    row += basis.size();
  }
  return out;
}

/// Where the contacts and observed nodes of a law's tubes move most, with its dominant frequency.
class MostMoved {
public:
  MostMoved(const Outputs& outputs, const results::RunResults& results)
      : outputs_(outputs), results_(results) {}

  [[nodiscard]] std::optional<results::LawMotion::Place>
  find(const TubesOfLaw& of, const std::vector<PlacedContact>& placed, const std::vector<NamedNode>& nodes) {
    const auto has = [&](core::Index node) {
      return std::any_of(of.structures.begin(), of.structures.end(),
                         [&](std::size_t s) { return results_.bases[s].row_of(node) >= 0; });
    };
    const auto contacts = [&](bool between_nodes) {
      for (std::size_t c = 0; c < results_.contact_summaries.size(); ++c)
        if (has(placed[c].node) && (placed[c].other >= 0) == between_nodes) {
          const post::ContactSummary& its = results_.contact_summaries[c];
          look(true, placed[c].name, 1, its.y, results_.series.contacts[c]);
          look(true, placed[c].name, 2, its.z, results_.series.contacts[c]);
        }
    };
    contacts(false);
    for (std::size_t k = 0; k < results_.node_summaries.size(); ++k)
      if (has(nodes[k].node))
        for (int axis = 0; axis < 3; ++axis)
          look(false, nodes[k].name, axis,
               results_.node_summaries[k].displacement[static_cast<std::size_t>(axis)],
               results_.series.nodes[k]);
    if (!most_) // relative motions
      contacts(true);
    if (most_)
      set_frequency();
    return most_;
  }

private:
  template <class Series>
  void look(bool contact, const std::string& name, int axis, const post::Moments& moments,
            const Series& series) {
    // a contact before a node at its place
    if (!(deviation(moments) > (most_ ? (1.0 + same_motion) * most_->largest : 0.0)))
      return;
    most_ = {contact, name, "xyz"[axis], moments.std, deviation(moments), {}, 0.0};
    if (series.displacement.rows() < outputs_.count)
      return;
    const Eigen::Index later = outputs_.count - outputs_.later;
    displacement_ = series.displacement.col(axis).head(outputs_.count).tail(later);
    velocity_ = series.velocity.col(axis).head(outputs_.count).tail(later);
  }

  void set_frequency() {
    const Eigen::Index n = displacement_.size();
    if (n < fewest_in_spectrum)
      return;
    const double rms = std::sqrt((displacement_.array() - displacement_.mean()).square().mean()),
                 speed = std::sqrt(velocity_.array().square().mean());
    if (!(speed < std::numbers::pi * least_unfolded / outputs_.step * rms))
      return;
    const double resolution = spectrum_stretches / (outputs_.step * static_cast<double>(n));
    const flow::PowerSpectrum spectrum =
        flow::welch({displacement_.data(), static_cast<std::size_t>(n)}, outputs_.step, resolution);
    const std::vector<double>& density = spectrum.density;
    const auto line = std::max_element(density.begin() + 1, density.end() - 1);
    const double below = *(line - 1),
                 above = *(line + 1), // a sine has one half of its amplitude or more there
        ratio = std::sqrt(std::max(below, above) / *line),
                 share = std::max(0.0, (2.0 * ratio - 1.0) / (ratio + 1.0));
    most_->resolution = spectrum.frequency[1];
    most_->frequency =
        most_->resolution * (static_cast<double>(line - density.begin()) + (above > below ? share : -share));
  }

  const Outputs& outputs_;
  const results::RunResults& results_;
  std::optional<results::LawMotion::Place> most_;
  Eigen::VectorXd displacement_, velocity_; ///< there, later
};

/// The transient in which the tubes of a law ran.
const results::TransientFacts* transient_of(const TubesOfLaw& of, const results::RunResults& results) {
  const auto found = std::find_if(
      results.transients.begin(), results.transients.end(), [&](const results::TransientFacts& one) {
        return std::count(one.structures.begin(), one.structures.end(), of.structures.front()) > 0;
      });
  return found == results.transients.end() ? nullptr : &*found;
}

std::vector<std::string> tube_names(const TubesOfLaw& of, const TubesInFlow& tubes) {
  std::vector<std::string> out;
  for (const std::size_t f : of.flows)
    out.push_back(tubes.study.flows[tubes.flows[f].entry].name);
  return out;
}

std::string told_growth(const std::string& name, const post::Growth& growth, double from, double end) {
  return fmt::format(
      "{}: the motion still grows, by {:.3g} 1/s from {:.4g} to {:.4g} s (its rms in the second "
      "half of that time is {:.4g} times that in the first): amplitudes, forces and work rates "
      "are of no steady state; give a longer duration, or supports that limit the motion",
      name, growth.rate, from, end, growth.rms_ratio);
}

} // namespace

void judge_motion(const TubesInFlow& tubes, const std::vector<PlacedContact>& placed,
                  const std::vector<NamedNode>& nodes, results::RunResults& out) {
  const std::vector<TubesOfLaw> laws = tubes_of_laws(tubes, out.bases);
  const Outputs outputs(out);
  std::size_t assessed = 0; // of out.laws
  for (const TubesOfLaw& of : laws) {
    const auto [velocity, diameter] = fastest(of);
    if (velocity == 0.0)
      continue;
    results::LawAtWork& at_work = out.laws[assessed++];
    const auto place = MostMoved(outputs, out).find(of, placed, nodes);
    if (place && !(place->largest <= linear_share * diameter))
      out.warnings.push_back(fmt::format(
          "{}: {} \"{}\" moves by {:.3g} m about its mean, {:.2g} of the diameter: the "
          "fluidelastic law is linear, good to some {:g} of it; amplitudes, forces and work rates "
          "are not to be trusted",
          of.name, place->contact ? "contact" : "node", place->name, place->largest,
          place->largest / diameter, linear_share));
    const results::TransientFacts* transient = transient_of(of, out);
    if (!at_work.unstable() || transient == nullptr)
      continue;
    results::LawMotion motion{place,
                              outputs.later < outputs.count ? outputs.time(outputs.later) : out.duration,
                              {},
                              {},
                              transient->power};
    for (const TubesOfLaw& other : laws)
      if (transient_of(other, out) == transient)
        for (std::string& name : tube_names(other, tubes))
          motion.tubes.push_back(std::move(name));
    const Eigen::VectorXd energies = modal_energies(of, outputs, out);
    const Eigen::Index later = outputs.count - outputs.later, quarter = energies.size() / 4;
    motion.growth = post::amplitude_growth(
        {energies.data() + energies.size() - later, static_cast<std::size_t>(later)}, outputs.step);
    if (motion.growth && motion.growth->significant)
      out.warnings.push_back(told_growth(of.name, *motion.growth, motion.later_from, out.duration));
    else if (motion.growth && outputs.from < outputs.later) {
      const double ratio = std::sqrt(energies.head(quarter).mean() / energies.tail(later).mean());
      if (ratio < most_building_up)
        out.warnings.push_back(fmt::format(
            "{}: the statistics begin before the motion has built up (its rms in the first quarter of their "
            "window is {:.2g} times that in the second half of the run): amplitudes and work rates are "
            "those of no steady state; give output.statistics_from = {:g}",
            of.name, ratio, 0.5 * out.duration));
    }
    at_work.motion = std::move(motion);
  }
}

} // namespace fretwork::app
