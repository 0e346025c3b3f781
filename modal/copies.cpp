// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/copies.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace fretwork::modal {
namespace {

using core::Index;
using core::Vec3;

/// A structure without its place: nodes numbered from 0, measured from the first; properties numbered by
/// value.
struct Shape {
  std::vector<Vec3> nodes; ///< and, after them, the middles of arcs
  std::vector<std::uint8_t> fixed;
  std::vector<fem::Beam> beams;
  std::vector<fem::LumpedMass> masses;
  std::vector<fem::Spring> springs;
  std::vector<fem::Tie> ties;
  std::vector<double> along; ///< of the ends of beams on the way of a taper
  double size = 0.0;         ///< m, the largest distance from the first node
};

/// For each property the number of the first one of equal value.
std::vector<Index> property_values(const std::vector<fem::BeamProperty>& properties) {
  std::vector<Index> first;
  for (const fem::BeamProperty& p : properties)
    first.push_back(
        static_cast<Index>(std::find(properties.begin(), properties.end(), p) - properties.begin()));
  return first;
}

Shape shape_of(const fem::Model& whole, const fem::Structure& structure, const std::vector<Index>& values) {
  // named one by one: a new part of a model or of a structure does not compile until it is compared too
  const auto& [places, properties, all_beams, all_masses, all_springs, all_fixed, all_ties] = whole;
  const auto& [nodes, beams, masses, springs, ties, equation, equations] = structure;
  static_cast<void>(properties), static_cast<void>(equation), static_cast<void>(equations); // follow
  const auto own = [&](Index node) { return node < 0 ? node : fem::position_of(structure, node); };
  const Vec3& origin = places[static_cast<std::size_t>(nodes.front())];
  Shape shape;
  for (const Index node : nodes) {
    const auto i = static_cast<std::size_t>(node);
    shape.nodes.emplace_back(places[i] - origin);
    shape.fixed.push_back(all_fixed[i]);
    shape.size = std::max(shape.size, shape.nodes.back().norm());
  }
  for (const Index i : beams) {
    fem::Beam& beam = shape.beams.emplace_back(all_beams[static_cast<std::size_t>(i)]);
    beam.a = own(beam.a);
    beam.b = own(beam.b);
    beam.property = values[static_cast<std::size_t>(beam.property)];
    shape.along.insert(shape.along.end(), beam.along.begin(), beam.along.end());
    beam.along = {};
    if (beam.middle) { // a place like those of the nodes
      shape.nodes.emplace_back(*beam.middle - origin);
      beam.middle = Vec3::Zero();
    }
  }
  for (const Index i : masses) {
    fem::LumpedMass& body = shape.masses.emplace_back(all_masses[static_cast<std::size_t>(i)]);
    body.node = own(body.node);
  }
  for (const Index i : springs) {
    fem::Spring& spring = shape.springs.emplace_back(all_springs[static_cast<std::size_t>(i)]);
    spring.node = own(spring.node);
    spring.other = own(spring.other);
  }
  for (const Index i : ties) {
    fem::Tie& tie = shape.ties.emplace_back(all_ties[static_cast<std::size_t>(i)]);
    tie.node = own(tie.node);
    tie.other = own(tie.other);
  }
  return shape;
}

bool same(const Shape& a, const Shape& b) {
  const double tolerance = same_place * a.size;
  return a.fixed == b.fixed && a.masses == b.masses && a.springs == b.springs && a.ties == b.ties &&
         a.beams == b.beams &&
         std::equal(a.along.begin(), a.along.end(), b.along.begin(), b.along.end(),
                    [](double x, double y) { return std::abs(x - y) <= same_place; }) &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [&](const Vec3& x, const Vec3& y) { return (x - y).norm() <= tolerance; });
}

/// Counts and sums that copies share to the last bit: few others share them too.
using Digest = std::array<double, 6>;

Digest digest(const Shape& shape) {
  Digest sums{static_cast<double>(shape.nodes.size()), static_cast<double>(shape.beams.size())};
  for (const fem::Beam& beam : shape.beams)
    sums[2] += beam.property;
  for (const fem::LumpedMass& body : shape.masses)
    sums[3] += body.mass;
  for (const fem::Spring& spring : shape.springs)
    for (const double k : spring.stiffness)
      sums[4] += k;
  for (const std::uint8_t fixed : shape.fixed)
    sums[5] += fixed;
  return sums;
}

} // namespace

std::vector<std::size_t> originals(const fem::Model& model, const std::vector<fem::Structure>& structures) {
  const std::vector<Index> values = property_values(model.properties);
  std::vector<Shape> shapes(structures.size());
  std::map<Digest, std::vector<std::size_t>> known; // originals
  std::vector<std::size_t> original(structures.size());
  for (std::size_t s = 0; s < structures.size(); ++s) {
    shapes[s] = shape_of(model, structures[s], values);
    std::vector<std::size_t>& candidates = known[digest(shapes[s])];
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [&](std::size_t c) { return same(shapes[c], shapes[s]); });
    original[s] = found != candidates.end() ? *found : s;
    if (original[s] == s)
      candidates.push_back(s);
    else
      shapes[s] = {}; // compared with no more
  }
  return original;
}

} // namespace fretwork::modal
