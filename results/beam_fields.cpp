// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/beam_fields.hpp"
#include "fem/beam_constants.hpp"
#include <Eigen/Geometry>
#include <cassert>
#include <limits>
#include <numbers>

namespace fretwork::results {
namespace {

constexpr std::array stations{0.0, 0.5, 1.0};
/// The mean of the directions of beams that meet in a node is this long at least; shorter: they have none in common.
constexpr double shortest_mean = 0.5;

Frames no_frames(Eigen::Index count) {
  return {Field::Zero(3, count), Field::Zero(3, count), Field::Zero(3, count)};
}

const fem::BeamProperty& property_of(const RunResults& results, const fem::Beam& beam) {
  return results.properties[static_cast<std::size_t>(beam.property)];
}

fem::Section section_at(const RunResults& results, const fem::Beam& beam, double share) {
  return fem::property_at(property_of(results, beam), std::lerp(beam.along[0], beam.along[1], share)).section;
}

double radius_of(const fem::Section& section) {
  return fem::outer_radius(section).value_or(std::sqrt(section.area / std::numbers::pi));
}

void set(Frames& frames, Eigen::Index at, const Eigen::Matrix3d& axes) {
  frames.x.col(at) = axes.row(0).transpose();
  frames.y.col(at) = axes.row(1).transpose();
  frames.z.col(at) = axes.row(2).transpose();
}

} // namespace

BeamFields::BeamFields(const RunResults& results)
    : results_(results), of_beams_(no_frames(static_cast<Eigen::Index>(results.beams.size()))),
      of_nodes_(no_frames(static_cast<Eigen::Index>(results.nodes.size()))),
      radius_(Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(results.nodes.size()))) {
  assert(results.beams.size() == results.lines.size());
  elements_.reserve(results.beams.size());
  for (const fem::Beam& beam : results.beams) {
    elements_.emplace_back(results.nodes[static_cast<std::size_t>(beam.a)],
                           results.nodes[static_cast<std::size_t>(beam.b)], property_of(results, beam),
                           beam.middle, beam.along);
    set(of_beams_, static_cast<Eigen::Index>(elements_.size()) - 1, elements_.back().section_axes(0.5));
  }
  set_nodes();
}

void BeamFields::set_nodes() {
  const auto nodes = static_cast<Eigen::Index>(results_.nodes.size());
  Eigen::VectorXd beams = Eigen::VectorXd::Zero(nodes);
  std::vector<Eigen::Matrix3d> first(results_.nodes.size());
  for (std::size_t i = 0; i < elements_.size(); ++i)
    for (const double end : {0.0, 1.0}) {
      const fem::Beam& beam = results_.beams[i];
      const core::Index node = end == 0.0 ? beam.a : beam.b;
      const Eigen::Matrix3d axes = elements_[i].section_axes(end);
      if (beams(node)++ == 0.0)
        first[static_cast<std::size_t>(node)] = axes;
      of_nodes_.x.col(node) += axes.row(0).transpose();
      of_nodes_.y.col(node) += axes.row(1).transpose();
      radius_(node) = std::max(radius_(node), radius_of(section_at(results_, beam, end)));
    }
  for (Eigen::Index node = 0; node < nodes; ++node) {
    if (beams(node) == 0.0)
      continue;
    Eigen::Matrix3d axes = first[static_cast<std::size_t>(node)];
    if (of_nodes_.x.col(node).norm() > shortest_mean * beams(node)) {
      const core::Vec3 x = of_nodes_.x.col(node).normalized();
      const auto across = [&](const core::Vec3& y) { return core::Vec3(y - x * x.dot(y)); };
      core::Vec3 y = across(of_nodes_.y.col(node) / beams(node));
      for (const int row : {1, 2}) // of the first, of which one is across
        if (y.norm() <= shortest_mean)
          y = across(axes.row(row).transpose());
      y.normalize();
      axes << x.transpose(), y.transpose(), x.cross(y).transpose();
    }
    set(of_nodes_, node, axes);
  }
}

BeamFields::Forces BeamFields::forces(const Motion& motion) const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto count = static_cast<Eigen::Index>(elements_.size());
  Forces out{{6, count}, Eigen::RowVectorXd::Zero(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const fem::Beam& beam = results_.beams[static_cast<std::size_t>(i)];
    fem::Vector12 u;
    u << motion.col(beam.a), motion.col(beam.b);
    for (const double share : stations) {
      const fem::Vector6 forces = elements_[static_cast<std::size_t>(i)].section_forces(u, share);
      if (share == 0.5)
        out.middle.col(i) = forces;
      const auto stress =
          fem::outer_fibre_stress(section_at(results_, beam, share), forces(0), forces(4), forces(5));
      out.stress(i) = std::max(out.stress(i), stress.value_or(unknown));
      if (!stress)
        out.stress(i) = unknown;
    }
  }
  return out;
}

} // namespace fretwork::results
