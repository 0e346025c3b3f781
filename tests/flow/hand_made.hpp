// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Tubes with mode shapes written down by hand.
#pragma once
#include "../fem/model_builder.hpp"
#include "flow/sampling.hpp"
#include <Eigen/Geometry>
#include <functional>
#include <numeric>

namespace fretwork::tests {

inline constexpr double pi = std::numbers::pi;

/// A tube of one model whose beams are all its own, with the basis that belongs to it.
struct HandMade {
  ModelBuilder builder;
  std::vector<Index> nodes; ///< along the tube
  modal::Basis basis;

  [[nodiscard]] flow::Tube tube() const {
    std::vector<Index> beams(builder.model.beams.size());
    std::iota(beams.begin(), beams.end(), 0);
    return {builder.model, beams, nodes.front(), "T1"};
  }
  void set_frequencies(const std::vector<double>& hertz) {
    basis.omega.resize(static_cast<Eigen::Index>(hertz.size()));
    basis.nodes = nodes;
    std::sort(basis.nodes.begin(), basis.nodes.end());
    for (std::size_t i = 0; i < hertz.size(); ++i)
      basis.omega(static_cast<Eigen::Index>(i)) = 2.0 * pi * hertz[i];
    basis.shapes = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(nodes.size()), basis.omega.size());
  }
  /// Displacement and rotation of a mode at a node.
  void set_shape(Eigen::Index mode, Index node, const Vec3& displacement, const Vec3& rotation) {
    basis.shapes.col(mode).segment<6>(basis.row_of(node)) << displacement, rotation;
  }
};

/// A straight tube along z from the origin, n elements of equal length, with the pinned shapes sin(k pi s/L) along x for
/// k = 1 ... frequencies.size().
inline HandMade pinned_tube(const fem::BeamProperty& property, double length, int n,
                            const std::vector<double>& frequencies, const Vec3& motion = Vec3::UnitX()) {
  HandMade out;
  const Index number = out.builder.property(property);
  out.nodes = out.builder.line(Vec3::Zero(), length * Vec3::UnitZ(), n, number);
  out.set_frequencies(frequencies);
  for (std::size_t i = 0; i < frequencies.size(); ++i)
    for (const Index node : out.nodes) {
      const double wave = static_cast<double>(i + 1) * pi / length,
                   s = out.builder.model.nodes[static_cast<std::size_t>(node)].z();
      out.set_shape(static_cast<Eigen::Index>(i), node, std::sin(wave * s) * motion,
                    wave * std::cos(wave * s) * Vec3::UnitZ().cross(motion));
    }
  return out;
}

/// One value over a zone.
inline flow::Table<double> constant(double value) { return flow::Table<double>::constant(value); }

inline flow::SinglePhase liquid(double density, double viscosity = 1.23e-7) {
  return {flow::Phase::liquid, constant(density), viscosity};
}

inline flow::Zone liquid_zone(const std::string& name, double from, double to, double density,
                              double velocity) {
  return {{name, from, to}, flow::ScalarVelocity{constant(velocity), Vec3::UnitX()}, liquid(density)};
}

} // namespace fretwork::tests
