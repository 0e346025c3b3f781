// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/mode_direction.hpp"
#include "core/symmetric.hpp"
#include <fmt/format.h>
#include <optional>

namespace fretwork::flow {
namespace {

constexpr double no_spread = 1e-3; ///< of the largest rms spread of the places: none
constexpr double alone = 0.95;     ///< share from which a direction is given without it

/// Normal of the plane in which the tube is bent; none of a straight one, or one that leaves every plane.
std::optional<Vec3> plane_of(const std::vector<Station>& stations) {
  double length = 0.0;
  Vec3 mean = Vec3::Zero();
  for (const Station& station : stations) {
    length += station.weight;
    mean += station.weight * station.tube.position;
  }
  mean /= length;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Station& station : stations) {
    const Vec3 from = station.tube.position - mean;
    spread += station.weight * from * from.transpose();
  }
  const core::Eigenpairs principal = core::symmetric_eigenpairs(spread);
  const double least = no_spread * no_spread * principal.values(2);
  if (principal.values(1) < least || principal.values(0) > least)
    return {};
  return principal.vectors.col(0);
}

} // namespace

std::vector<ModeDirection> mode_directions(const Sampling& sampling) {
  using Kind = ModeDirection::Kind;
  const std::optional<Vec3> normal = plane_of(sampling.stations);
  Eigen::Matrix3Xd along =
      Eigen::Matrix3Xd::Zero(3, sampling.modes()); // int m (phi_n . e)^2 ds by global axes
  Eigen::RowVectorXd out_of_plane = Eigen::RowVectorXd::Zero(sampling.modes());
  for (const Station& station : sampling.stations) {
    along += station.weight * station.tube.mass * station.shapes.cwiseAbs2();
    if (normal)
      out_of_plane += station.weight * station.tube.mass * (normal->transpose() * station.shapes).cwiseAbs2();
  }
  const Eigen::VectorXd across = transverse_share(sampling);
  std::vector<ModeDirection> out(static_cast<std::size_t>(sampling.modes()));
  for (Eigen::Index i = 0; i < sampling.modes(); ++i) {
    if (!(across(i) > least_transverse_share))
      continue;
    ModeDirection& one = out[static_cast<std::size_t>(i)];
    const double all = along.col(i).sum();
    if (normal) {
      const double share = out_of_plane(i) / all;
      one =
          share > 0.5 ? ModeDirection{Kind::out_of_plane, share} : ModeDirection{Kind::in_plane, 1.0 - share};
      continue;
    }
    Eigen::Index axis = 0;
    const double largest = along.col(i).maxCoeff(&axis);
    one = {axis == 0 ? Kind::x : axis == 1 ? Kind::y : Kind::z, largest / all};
  }
  return out;
}

const char* key_of(ModeDirection::Kind kind) {
  switch (kind) {
  case ModeDirection::Kind::none:
    return nullptr;
  case ModeDirection::Kind::in_plane:
    return "in_plane";
  case ModeDirection::Kind::out_of_plane:
    return "out_of_plane";
  case ModeDirection::Kind::x:
    return "x";
  case ModeDirection::Kind::y:
    return "y";
  case ModeDirection::Kind::z:
    return "z";
  }
  return nullptr;
}

std::string short_text(const ModeDirection& direction) {
  using Kind = ModeDirection::Kind;
  if (direction.kind == Kind::none)
    return "-";
  const bool in = direction.kind == Kind::in_plane, out = direction.kind == Kind::out_of_plane;
  if (direction.share >= alone)
    return in ? "in plane" : out ? "out of plane" : key_of(direction.kind);
  return fmt::format("{:.0f}% {}", 100.0 * direction.share, in ? "in" : out ? "out" : key_of(direction.kind));
}

} // namespace fretwork::flow
