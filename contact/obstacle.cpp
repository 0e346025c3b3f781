// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/obstacle.hpp"

namespace fretwork::contact {

namespace {

/// -1/r or 1/r; 0 at the centre, where the normal is a choice that does not turn.
double of_circle(double sign, double y, double z) {
  const double r = std::sqrt(y * y + z * z);
  return r > 0.0 ? sign / r : 0.0;
}

} // namespace

double curvature(const Obstacle& obstacle, double y, double z) {
  struct Visitor {
    double y, z;
    double operator()(const Circle&) const { return of_circle(-1.0, y, z); }
    double operator()(const PlanePair&) const { return 0.0; }
    double operator()(const Stop&) const { return 0.0; }
    double operator()(const RoundPair&) const { return of_circle(1.0, y, z); }
    double operator()(const FacingPlanes&) const { return 0.0; }
    double operator()(const Profile& profile) const { return profile.curvature(y, z); }
  };
  return std::visit(Visitor{y, z}, obstacle);
}

Reach reach(const Obstacle& obstacle) {
  struct Visitor {
    static Reach plane(PlaneAxis axis, double limit, double radial, double linear) {
      return axis == PlaneAxis::y ? Reach{1.0, 0.0, limit, radial, linear, 0.0}
                                  : Reach{0.0, 1.0, limit, radial, 0.0, linear};
    }
    Reach operator()(const Circle& c) const { return {1.0, 1.0, c.gap}; }
    Reach operator()(const PlanePair& p) const { return plane(p.axis, p.gap, 1.0, 0.0); }
    Reach operator()(const Stop& s) const { return plane(s.axis, s.gap, 0.0, 1.0); }
    Reach operator()(const Profile& p) const { return {1.0, 1.0, p.inscribed()}; }
    Reach operator()(const RoundPair& p) const { return {1.0, 1.0, -p.distance, -1.0}; }
    Reach operator()(const FacingPlanes& p) const { return plane(p.axis, -p.distance, 0.0, -p.side); }
  };
  return std::visit(Visitor{}, obstacle);
}

std::array<bool, 2> normal_directions(const Obstacle& obstacle) {
  const Reach r = reach(obstacle);
  return {r.wy > 0.0, r.wz > 0.0};
}

} // namespace fretwork::contact
