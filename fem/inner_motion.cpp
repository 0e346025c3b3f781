// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/inner_motion.hpp"
#include "fem/beam_constants.hpp"
#include "fem/beam_element.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace fretwork::fem {
namespace {

/// Change of lambda beyond which a mode is not resolved.
constexpr double resolved = 0.05;

/// Sums over the beams, of u^T M u = 1.
struct Shares {
  explicit Shares(Eigen::Index fields)
      : answer(Eigen::ArrayXd::Zero(fields)), moving(answer), strained(answer) {}
  Eigen::ArrayXd answer;   ///< c^T stiffness c / lambda^2 = c^T coupling u / lambda
  Eigen::ArrayXd moving;   ///< c^T mass c / lambda^2
  Eigen::ArrayXd strained; ///< |strain_mass u|^2
};

/// @param strain_mass  of inner, as a matrix of few rows where it has few, which is faster
template <class Rows>
void add_beam(const InnerMotion& inner, const Rows& strain_mass, const Eigen::MatrixXd& fields,
              Eigen::Index a, Eigen::Index b, Shares& shares) {
  const Eigen::Matrix2d flexibility = inner.stiffness.inverse();
  for (Eigen::Index j = 0; j < fields.cols(); ++j) {
    Vector12 u;
    u << fields.col(j).segment<6>(a), fields.col(j).segment<6>(b);
    const Eigen::Vector2d load = inner.coupling * u, c = flexibility * load;
    shares.answer[j] += load.dot(c);
    shares.moving[j] += c.dot(inner.mass * c);
    shares.strained[j] += (strain_mass * u).squaredNorm();
  }
}

} // namespace

InnerQuotients with_inner_motion(const Model& model, const Structure& structure,
                                 const Eigen::MatrixXd& fields, const Eigen::VectorXd& lambda) {
  assert(fields.cols() == lambda.size());
  Shares shares(fields.cols());
  for (const Index number : structure.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const Eigen::Index a = Eigen::Index{position_of(structure, beam.a)} * dofs_per_node,
                       b = Eigen::Index{position_of(structure, beam.b)} * dofs_per_node;
    const InnerMotion inner = BeamElement(model, beam).inner_motion();
    if (inner.strain_mass.rows() == 2)
      add_beam(inner, Eigen::Matrix<double, 2, 12>(inner.strain_mass), fields, a, b, shares);
    else
      add_beam(inner, inner.strain_mass, fields, a, b, shares);
  }
  const Eigen::ArrayXd l = lambda.array();
  const Eigen::ArrayXd change = (1.0 + l * shares.answer) / (1.0 + 2.0 * l * shares.answer +
                                                             l.square() * shares.moving - shares.strained) -
                                1.0;
  const auto is_resolved = change.abs() <= resolved;
  return {is_resolved.select(l * (1.0 + change), l), is_resolved.select(0.0, change.abs())};
}

double inner_motion_scale(const Model& model, const Structure& structure) {
  double scale = 0.0;
  for (const Index number : structure.beams) {
    const Beam& beam = model.beams[static_cast<std::size_t>(number)];
    const BeamProperty& property = model.properties[static_cast<std::size_t>(beam.property)];
    const double length = BeamAxis(model.nodes[static_cast<std::size_t>(beam.a)],
                                   model.nodes[static_cast<std::size_t>(beam.b)], beam.middle)
                              .length();
    for (const double share : {0.0, 0.5, 1.0}) {
      const BeamConstants k = beam_constants(property, std::lerp(beam.along[0], beam.along[1], share));
      scale =
          std::max(scale, length * length / 12.0 * std::max(k.mass_axial / k.axial, k.inertia_x / k.torsion));
      if (!property.taper)
        break;
    }
  }
  return scale;
}

// Of lambda: below 1.06 x where x < 0.05. Of lambda': by 5 % more.
double largest_inner_change(double scale, double lambda) { return std::min(1.12 * scale * lambda, resolved); }

Eigen::VectorXd largest_inner_changes(const Model& model, const Structure& structure,
                                      const Eigen::VectorXd& omega) {
  const double scale = inner_motion_scale(model, structure);
  return omega.unaryExpr([scale](double w) { return largest_inner_change(scale, w * w); });
}

} // namespace fretwork::fem
