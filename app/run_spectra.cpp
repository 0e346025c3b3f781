// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_spectra.hpp"
#include "core/names.hpp"
#include "flow/welch.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace fretwork::app {
namespace {

constexpr double stretches = 8.0; ///< of the window: the 95 % band of a density is then 0.6 to 2 times it
constexpr Eigen::Index fewest_samples = 256;
constexpr int excitation_points = 200;
constexpr double upper_frequencies = 0.75; ///< of half the output rate
constexpr double much_above = 0.01;        ///< of the variance: what a spectrum that falls by 1/f^2 has there
constexpr std::size_t most_spectra_named = 3;

results::Spectrum excitation(const TurbulentLoad& load, const PatchedZone& patched) {
  const flow::ZoneSpectra spectra(patched.zone);
  Eigen::Index fastest = 0;
  patched.zone.velocity.maxCoeff(&fastest);
  results::Spectrum out{
      fmt::format("{}, {}", patched.flow, patched.zone.name), "force per length", "N2/m2/Hz", {}, {}};
  const double low = std::max(load.band.low, 1.0 / load.band.block_period), high = load.band.high;
  for (int k = 0; k <= excitation_points; ++k) {
    const double f = low * std::pow(high / low, static_cast<double>(k) / excitation_points);
    out.frequency.push_back(f);
    out.density.push_back(std::pow(spectra.amplitude(fastest, f), 2));
  }
  return out;
}

/// Samples in the window of the statistics, at equal steps.
class Window {
public:
  explicit Window(const results::RunResults& results) {
    const Eigen::VectorXd& time = results.series.time;
    while (first_ < time.size() && time(first_) < results.statistics_from)
      ++first_;
    count_ = time.size() - first_;
    if (count_ > 1)
      step_ = (time(time.size() - 1) - time(first_)) / static_cast<double>(count_ - 1);
  }
  [[nodiscard]] bool long_enough() const { return count_ >= fewest_samples && step_ > 0.0; }
  /// Nothing of a series that stays 0.
  void add(const std::string& name, const std::string& quantity, const std::string& unit,
           const Eigen::VectorXd& series, std::vector<results::Spectrum>& out) const {
    const Eigen::VectorXd values = series.segment(first_, count_);
    if (values.isZero(0.0) || !values.allFinite())
      return;
    const flow::PowerSpectrum found = flow::welch({values.data(), static_cast<std::size_t>(values.size())},
                                                  step_, stretches / (step_ * static_cast<double>(count_)));
    out.push_back({name, quantity, unit, found.frequency, found.density, found.lower, found.upper});
  }

private:
  Eigen::Index first_ = 0, count_ = 0;
  double step_ = 0.0;
};

} // namespace

std::vector<results::FlowRow> flow_rows(const study::Study& study, const fem::Model& model,
                                        const std::vector<PlacedFlow>& flows) {
  std::vector<results::FlowRow> out;
  for (const PlacedFlow& placed : flows) {
    const flow::Tube tube = tube_of(study, placed, model);
    for (const flow::Tube::Element& element : tube.elements()) {
      const flow::TubePoint point = tube.at(0.5 * (element.from + element.to));
      const flow::FlowPoint fluid = placed.profile.at(point);
      const std::string zone =
          fluid.zone < 0 ? "" : placed.profile.zones()[static_cast<std::size_t>(fluid.zone)].name;
      out.push_back({tube.name(), zone, point.s, fluid.velocity, fluid.density, fluid.void_fraction,
                     fluid.inner_density, point.mass});
    }
  }
  return out;
}

std::vector<results::Spectrum> run_spectra(const std::vector<TurbulentLoad>& loads,
                                           const results::RunResults& results) {
  std::vector<results::Spectrum> out;
  for (const TurbulentLoad& load : loads)
    for (const PatchedZone& zone : load.zones)
      out.push_back(excitation(load, zone));
  const Window window(results);
  if (!window.long_enough())
    return out;
  for (const post::NodeSeries& node : results.series.nodes)
    for (int axis = 0; axis < 3; ++axis)
      window.add(node.name, fmt::format("displacement {}", "xyz"[axis]), "m2/Hz", node.displacement.col(axis),
                 out);
  for (const post::ContactSeries& contact : results.series.contacts) {
    window.add(contact.name, "displacement y_loc", "m2/Hz", contact.displacement.col(1), out);
    window.add(contact.name, "displacement z_loc", "m2/Hz", contact.displacement.col(2), out);
    window.add(contact.name, "normal force", "N2/Hz", contact.normal_force, out);
  }
  return out;
}

std::string folding_note(const std::vector<results::Spectrum>& spectra) {
  std::vector<std::string> names;
  double largest = 0.0, highest = 0.0;
  for (const results::Spectrum& spectrum : spectra) {
    if (spectrum.lower == spectrum.upper) // no estimate
      continue;
    double sum = 0.0, upper = 0.0;
    for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
      sum += spectrum.density[k];
      upper +=
          spectrum.frequency[k] > upper_frequencies * spectrum.frequency.back() ? spectrum.density[k] : 0.0;
    }
    if (!(upper > much_above * sum))
      continue;
    names.push_back(fmt::format("{} of {}", spectrum.quantity, spectrum.name));
    largest = std::max(largest, upper / sum);
    highest = spectrum.frequency.back();
  }
  return names.empty()
             ? std::string()
             : fmt::format(
                   "spectra.csv: {} {} up to {:.2g} % of the variance above {:.4g} Hz: motion above half the "
                   "output rate, {:.4g} Hz, is folded into {}; give a shorter output.every",
                   core::list_names(names, most_spectra_named), names.size() > 1 ? "have" : "has",
                   100.0 * largest, upper_frequencies * highest, highest, names.size() > 1 ? "them" : "it");
}

} // namespace fretwork::app
