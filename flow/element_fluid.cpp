// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/element_fluid.hpp"
#include <numbers>

namespace fretwork::flow {
namespace {

double disc(double diameter) { return std::numbers::pi / 4.0 * diameter * diameter; }

ElementFluid fluid_of(const TubePoint& point, const FlowPoint& flow, const Profile& profile, Index beam) {
  const double displaced = disc(point.outer_diameter), bore = disc(point.inner_diameter);
  const double confinement =
      flow.zone < 0 ? 1.0
                    : added_mass_coefficient(confinement_ratio(
                          profile.zones()[static_cast<std::size_t>(flow.zone)].bundle, point.outer_diameter));
  const double inner = flow.inner_density * bore;
  return {.beam = beam,
          .s = point.s,
          .fluid = {flow.inner_density, flow.density, confinement},
          .added_mass = confinement * flow.density * displaced,
          .inner_mass = inner,
          .submerged_mass = point.tube_mass + inner - flow.density * displaced};
}

void note_pitch(const Bundle& bundle, double diameter, int zone, Limits& limits) {
  if (is_single(bundle))
    return;
  const double ratio = pitch_ratio(bundle, diameter);
  if (ratio < correlated_pitch_ratio_from)
    limits.push_back({LimitKind::pitch_ratio, -1, zone, ratio, correlated_pitch_ratio_from});
  if (ratio > correlated_pitch_ratio_to)
    limits.push_back({LimitKind::pitch_ratio, -1, zone, ratio, correlated_pitch_ratio_to});
}

} // namespace

TubeFluid fluid_of_elements(const Tube& tube, const Profile& profile) {
  TubeFluid out;
  std::vector<int> elements(profile.zones().size(), 0);
  for (const Tube::Element& element : tube.elements()) {
    const TubePoint point = tube.at(0.5 * (element.from + element.to));
    const FlowPoint flow = profile.at(point);
    out.elements.push_back(fluid_of(point, flow, profile, element.beam));
    if (flow.zone < 0)
      continue;
    if (elements[static_cast<std::size_t>(flow.zone)]++ == 0)
      note_pitch(profile.zones()[static_cast<std::size_t>(flow.zone)].bundle, point.outer_diameter, flow.zone,
                 out.limits);
  }
  for (std::size_t zone = 0; zone < elements.size(); ++zone)
    if (elements[zone] < least_elements_of_zone)
      out.limits.push_back({LimitKind::elements_of_zone, -1, static_cast<int>(zone),
                            static_cast<double>(elements[zone]),
                            static_cast<double>(least_elements_of_zone)});
  return out;
}

} // namespace fretwork::flow
