// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/tube.hpp"
#include "core/error.hpp"
#include "fem/beam_constants.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <set>

namespace fretwork::flow {
namespace {

constexpr double same_abscissa =
    1e-9; ///< of the tube's length: what sums of arc lengths and printed abscissae leave

std::string beam_name(const fem::Model& model, const fem::Beam& beam) {
  return fem::beam_text(model.nodes[static_cast<std::size_t>(beam.a)],
                        model.nodes[static_cast<std::size_t>(beam.b)]);
}

std::string node_name(const fem::Model& model, Index node) {
  return "the node at " + fem::place(model.nodes[static_cast<std::size_t>(node)]);
}

void check_beams(const fem::Model& model, std::span<const Index> beams, const std::string& name) {
  if (beams.empty())
    throw core::Error(fmt::format("tube \"{}\" has no beams; name a group of beams", name));
  std::set<Index> seen;
  for (const Index beam : beams) {
    if (beam < 0 || static_cast<std::size_t>(beam) >= model.beams.size())
      throw core::Error(
          fmt::format("tube \"{}\": beam {} is not one of the {} of the model; give numbers from 0", name,
                      beam, model.beams.size()));
    const fem::Beam& it = model.beams[static_cast<std::size_t>(beam)];
    if (!seen.insert(beam).second)
      throw core::Error(
          fmt::format("tube \"{}\": {} is named twice; name each beam once", name, beam_name(model, it)));
    if (!fem::outline_of(model.properties[static_cast<std::size_t>(it.property)].section))
      throw core::Error(
          fmt::format("tube \"{}\": {} is neither a pipe nor a circle; the fluid needs a diameter: give "
                      "its section a round shape",
                      name, beam_name(model, it)));
  }
}

using BeamsOfNodes = std::map<Index, std::vector<Index>>;

BeamsOfNodes beams_of_nodes(const fem::Model& model, std::span<const Index> beams) {
  BeamsOfNodes out;
  for (const Index beam : beams) {
    const fem::Beam& it = model.beams[static_cast<std::size_t>(beam)];
    out[it.a].push_back(beam);
    out[it.b].push_back(beam);
  }
  return out;
}

void check_chain(const fem::Model& model, const BeamsOfNodes& at_nodes, Index start,
                 const std::string& name) {
  for (const auto& [node, beams] : at_nodes)
    if (beams.size() > 2)
      throw core::Error(
          fmt::format("tube \"{}\": {} of its beams meet at {}; name the beams of one tube without "
                      "branches",
                      name, beams.size(), node_name(model, node)));
  const auto found = at_nodes.find(start);
  if (found == at_nodes.end())
    throw core::Error(fmt::format("tube \"{}\": no beam of it is at its start{}; start it at one of its ends",
                                  name,
                                  start >= 0 && static_cast<std::size_t>(start) < model.nodes.size()
                                      ? ", " + node_name(model, start)
                                      : fmt::format(", node {}, which the model does not have", start)));
  if (found->second.size() != 1)
    throw core::Error(
        fmt::format("tube \"{}\": its start, {}, is inside it or on a closed loop, not at an end; start "
                    "it at one of its ends",
                    name, node_name(model, start)));
}

} // namespace

Tube::Tube(const fem::Model& model, std::span<const Index> beams, Index start, std::string name)
    : name_(std::move(name)) {
  check_beams(model, beams, name_);
  const BeamsOfNodes at_nodes = beams_of_nodes(model, beams);
  check_chain(model, at_nodes, start, name_);
  elements_.reserve(beams.size());
  pieces_.reserve(beams.size());
  Index beam = at_nodes.at(start).front();
  append(model, beam, start);
  for (;;) {
    const std::vector<Index>& here = at_nodes.at(elements_.back().second);
    if (here.size() == 1)
      break;
    beam = here[0] == beam ? here[1] : here[0];
    append(model, beam, elements_.back().second);
  }
  if (elements_.size() == beams.size())
    return;
  std::set<Index> left(beams.begin(), beams.end());
  for (const Element& element : elements_)
    left.erase(element.beam);
  throw core::Error(fmt::format("tube \"{}\": its beams form no single chain: from its start {} of {} beams "
                                "are reached, {} is not; merge the "
                                "nodes of the gap or name the beams of one tube",
                                name_, elements_.size(), beams.size(),
                                beam_name(model, model.beams[static_cast<std::size_t>(*left.begin())])));
}

void Tube::append(const fem::Model& model, Index beam, Index first) {
  const fem::Beam& it = model.beams[static_cast<std::size_t>(beam)];
  pieces_.push_back({fem::BeamElement(model, it), model.properties[static_cast<std::size_t>(it.property)],
                     it.along, it.a, it.b});
  const double from = elements_.empty() ? 0.0 : elements_.back().to;
  const bool reversed = it.b == first;
  elements_.push_back(
      {beam, reversed, from, from + pieces_.back().element.axis().length(), first, reversed ? it.a : it.b});
}

Tube::Place Tube::locate(double s) const {
  if (!(s >= -same_abscissa * length() && s <= (1.0 + same_abscissa) * length()))
    throw core::Error(
        fmt::format("tube \"{}\": s = {:g} m is not on it; give an abscissa from 0 to its length, {:g} m",
                    name_, s, length()));
  const auto after =
      std::upper_bound(elements_.begin(), elements_.end(), s,
                       [](double where, const Element& element) { return where < element.to; });
  const auto k = static_cast<std::size_t>(std::min(after, elements_.end() - 1) - elements_.begin());
  const Element& element = elements_[k];
  const double share = std::clamp((s - element.from) / (element.to - element.from), 0.0, 1.0);
  return {k, element.reversed ? 1.0 - share : share};
}

TubePoint Tube::at(double s) const {
  const auto [k, share] = locate(s);
  const Piece& piece = pieces_[k];
  const fem::BeamAxis& axis = piece.element.axis();
  const double along = std::lerp(piece.along[0], piece.along[1], share), distance = share * axis.length();
  const fem::BeamProperty property = fem::property_at(piece.property, along);
  const auto outline = fem::outline_of(property.section);
  const auto diameter = [](double area) { return std::sqrt(4.0 * area / std::numbers::pi); };
  return {.s = s,
          .position = axis.point(distance),
          .tangent = elements_[k].reversed ? Vec3(-axis.tangent(distance)) : axis.tangent(distance),
          .outer_diameter = diameter(outline->displaced),
          .inner_diameter = diameter(outline->bore),
          .mass = fem::beam_constants(property).mass_transverse,
          .tube_mass = property.material.density * property.section.area};
}

Eigen::Matrix3Xd Tube::shapes(const modal::Basis& basis, double s) const {
  const auto [k, share] = locate(s);
  const Piece& piece = pieces_[k];
  const Eigen::Index a = basis.row_of(piece.a), b = basis.row_of(piece.b);
  if (a < 0 || b < 0)
    throw core::Error(
        fmt::format("tube \"{}\": the modes are those of another structure, without its nodes at s = "
                    "{:g} m; take the modes of the structure that the tube belongs to",
                    name_, s));
  const Eigen::Matrix<double, 3, 12> moved = piece.element.shapes(share).topRows<3>();
  return moved.leftCols<6>() * basis.shapes.middleRows<6>(a) +
         moved.rightCols<6>() * basis.shapes.middleRows<6>(b);
}

Eigen::Matrix3Xd Tube::mean_shapes(const modal::Basis& basis, double from, double to) const {
  static const double gauss = 0.5 / std::sqrt(3.0); // two points: exact for cubics
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, basis.size());
  auto element = std::upper_bound(elements_.begin(), elements_.end(), from,
                                  [](double at, const Element& e) { return at < e.to; });
  for (; element != elements_.end() && element->from < to; ++element) {
    const double a = std::max(from, element->from), b = std::min(to, element->to), middle = 0.5 * (a + b);
    for (const double way : {-gauss, gauss})
      sum += 0.5 * (b - a) * shapes(basis, middle + way * (b - a));
  }
  return sum / (to - from);
}

} // namespace fretwork::flow
