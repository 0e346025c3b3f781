// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/obstacle.hpp"
#include "contact/profile.hpp"
#include "profile_holes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

using namespace fretwork;
using contact::Location;
using contact::PlanePoint;
using contact::PolarPoint;
using contact::Profile;
using namespace fretwork::tests::holes;

namespace {

constexpr double round_off = 2e-14; // positions and radii are of order 1; a few operations
constexpr double feet_apart = 1e-6; // two feet farther apart than this, equally near: the gap has no gradient
constexpr double near_the_line =
    1e-6; // closer, the direction node - foot is lost in the rounding of the foot
constexpr double direction_error = 1e-9; // round_off / near_the_line, rounded up
constexpr double difference_step = 1e-7;
constexpr double difference_error =
    1e-6; // of central differences: round_off / step, and step / distance to a corner

/// Every foot as near as the nearest one, by a plain look at all facets; inside by the crossings of a ray.
struct Reference {
  double gap;
  std::vector<PlanePoint> feet;
};
Reference look_at_all(const Profile& profile, double y, double z) {
  const auto v = profile.vertices();
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, PlanePoint>> feet;
  bool inside = false;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const PlanePoint a = v[k], b = v[(k + 1) % v.size()];
    const double ey = b.y - a.y, ez = b.z - a.z;
    const double s = std::clamp(((y - a.y) * ey + (z - a.z) * ez) / (ey * ey + ez * ez), 0.0, 1.0);
    const PlanePoint foot{(1.0 - s) * a.y + s * b.y, (1.0 - s) * a.z + s * b.z};
    feet.push_back({std::hypot(y - foot.y, z - foot.z), foot});
    nearest = std::min(nearest, feet.back().first);
    if ((a.z > z) != (b.z > z) && y < a.y + (z - a.z) / ez * ey)
      inside = !inside;
  }
  Reference reference{inside ? nearest : -nearest, {}};
  for (const auto& [distance, foot] : feet)
    if (distance <= nearest + round_off)
      reference.feet.push_back(foot);
  return reference;
}
bool has_gradient(const Reference& reference) {
  const PlanePoint first = reference.feet[0];
  return std::ranges::all_of(
      reference.feet, [&](PlanePoint f) { return std::hypot(f.y - first.y, f.z - first.z) < feet_apart; });
}

/// A node anywhere, or near a corner or a facet at any small distance.
PlanePoint node_near(const Profile& profile, tests::Uniform& uniform, int kind) {
  const auto v = profile.vertices();
  if (kind % 3 == 0)
    return {uniform(-2.0, 2.0), uniform(-2.0, 2.0)};
  const std::size_t k = static_cast<std::size_t>(uniform(0.0, 1.0) * static_cast<double>(v.size()));
  const PlanePoint a = v[k], b = v[(k + 1) % v.size()];
  const double s = kind % 3 == 1 ? 0.0 : uniform(0.0, 1.0), angle = uniform(0.0, 2.0 * pi),
               d = uniform.scale(1e-9, 0.3);
  return {a.y + s * (b.y - a.y) + d * std::cos(angle), a.z + s * (b.z - a.z) + d * std::sin(angle)};
}

void expect_same_bytes(const Location& a, const Location& b) {
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.ny, b.ny);
  EXPECT_EQ(a.nz, b.nz);
}

} // namespace

TEST(Profile, GapIsTheDistanceToTheNearestOfAllFacets) {
  tests::Uniform uniform(11);
  for (const Profile& profile : all())
    for (int i = 0; i < 3000; ++i) {
      const PlanePoint p = node_near(profile, uniform, i);
      ASSERT_NEAR(profile.locate(p.y, p.z).gap, look_at_all(profile, p.y, p.z).gap, round_off)
          << p.y << " " << p.z;
    }
}

TEST(Profile, NormalPointsFromTheNearestPointIntoTheHole) {
  tests::Uniform uniform(12);
  int seen = 0;
  for (const Profile& profile : all())
    for (int i = 0; i < 3000; ++i) {
      const PlanePoint p = node_near(profile, uniform, i);
      const Reference reference = look_at_all(profile, p.y, p.z);
      if (std::abs(reference.gap) < near_the_line || !has_gradient(reference))
        continue;
      const Location at = profile.locate(p.y, p.z);
      ASSERT_NEAR(at.ny, (p.y - reference.feet[0].y) / reference.gap, direction_error) << p.y << " " << p.z;
      ASSERT_NEAR(at.nz, (p.z - reference.feet[0].z) / reference.gap, direction_error) << p.y << " " << p.z;
      ++seen;
    }
  EXPECT_GT(seen, 20000);
}

TEST(Profile, NormalIsTheGradientOfTheGap) {
  tests::Uniform uniform(13);
  const double h = difference_step;
  int seen = 0;
  for (const Profile& profile :
       {Profile(polygon(4, round_hole, 0.3)), Profile(polygon(60, trefoil)), Profile(jagged(50, 2))})
    for (int i = 0; i < 3000; ++i) {
      const PlanePoint p{uniform(-1.5, 1.5), uniform(-1.5, 1.5)};
      const Location at = profile.locate(p.y, p.z);
      const auto turned = [&](double y, double z) {
        const Location other = profile.locate(y, z);
        return std::hypot(other.ny - at.ny, other.nz - at.nz) > 0.01;
      };
      // a ridge, or a corner too near for the step
      if (turned(p.y + h, p.z) || turned(p.y - h, p.z) || turned(p.y, p.z + h) || turned(p.y, p.z - h))
        continue;
      ASSERT_NEAR(at.ny, (profile.locate(p.y + h, p.z).gap - profile.locate(p.y - h, p.z).gap) / (2 * h),
                  difference_error);
      ASSERT_NEAR(at.nz, (profile.locate(p.y, p.z + h).gap - profile.locate(p.y, p.z - h).gap) / (2 * h),
                  difference_error);
      ++seen;
    }
  EXPECT_GT(seen, 8900); // of 9000: ridges are lines
}

TEST(Profile, GapNeverChangesByMoreThanTheNodeMoves) {
  tests::Uniform uniform(14);
  for (const Profile& profile : all())
    for (int i = 0; i < 3000; ++i) {
      const PlanePoint p = node_near(profile, uniform, i);
      const double d = uniform.scale(1e-12, 0.5), angle = uniform(0.0, 2.0 * pi);
      const Location a = profile.locate(p.y, p.z),
                     b = profile.locate(p.y + d * std::cos(angle), p.z + d * std::sin(angle));
      ASSERT_LE(std::abs(a.gap - b.gap), d + round_off);
    }
}

TEST(Profile, NormalStaysTheSameThroughAFacet) {
  for (const Profile& profile : all()) {
    const auto v = profile.vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const PlanePoint a = v[k], b = v[(k + 1) % v.size()];
      const double length = std::hypot(b.y - a.y, b.z - a.z), d = 1e-6 * length;
      const double ny = (a.z - b.z) / length, nz = (b.y - a.y) / length;
      const double y = 0.4 * a.y + 0.6 * b.y, z = 0.4 * a.z + 0.6 * b.z;
      const Location in = profile.locate(y + d * ny, z + d * nz),
                     out = profile.locate(y - d * ny, z - d * nz);
      ASSERT_NEAR(in.gap, d, round_off);
      ASSERT_NEAR(out.gap, -d, round_off);
      ASSERT_NEAR(in.ny, ny, direction_error);
      ASSERT_NEAR(in.nz, nz, direction_error);
      ASSERT_EQ(in.ny, out.ny);
      ASSERT_EQ(in.nz, out.nz);
    }
  }
}

TEST(Profile, NormalTurnsWithTheNodeRoundAProtrudingCorner) {
  // the corner at (0.2, 0) protrudes; the facets that meet there leave a wedge of directions round -y
  const Profile profile(std::vector<PolarPoint>{{0.0, 0.2}, {pi / 3, 1.0}, {pi, 1.0}, {5 * pi / 3, 1.0}});
  for (double turned = -0.15; turned < 0.15; turned += 0.01) {
    const double angle = pi + turned;
    const Location at = profile.locate(0.2 + 0.05 * std::cos(angle), 0.05 * std::sin(angle));
    EXPECT_NEAR(at.gap, 0.05, round_off);
    EXPECT_NEAR(at.ny, std::cos(angle), round_off);
    EXPECT_NEAR(at.nz, std::sin(angle), round_off);
  }
}

TEST(Profile, NormalOutsideACornerOfTheHolePointsToIt) {
  const Profile square(polygon(
      4, [](double) { return std::sqrt(2.0); }, pi / 4));
  const Location at = square.locate(1.3, 1.4);
  EXPECT_NEAR(at.gap, -0.5, round_off);
  EXPECT_NEAR(at.ny, -0.6, round_off);
  EXPECT_NEAR(at.nz, -0.8, round_off);
}

TEST(Profile, NearestFacetCountsAndNotTheOneOfTheSector) {
  // a slot of half widths 1 and 0.05: the ray of the node ends at its far end, 0.1 away; the long sides are
  // at 0.05
  const double corner = std::atan2(0.05, 1.0), radius = std::hypot(1.0, 0.05);
  const Profile profile(std::vector<PolarPoint>{
      {corner, radius}, {pi - corner, radius}, {pi + corner, radius}, {2.0 * pi - corner, radius}});
  const Location at = profile.locate(0.9, 0.01);
  EXPECT_NEAR(at.gap, 0.04, round_off);
  EXPECT_NEAR(at.ny, 0.0, round_off);
  EXPECT_NEAR(at.nz, -1.0, round_off);
}

TEST(Profile, EveryNodeHasAUnitNormalAlsoOnCornersFacetsAndTheCentre) {
  for (const Profile& profile : all()) {
    const auto expect_unit = [&](double y, double z, double gap) {
      const Location at = profile.locate(y, z);
      ASSERT_NEAR(at.gap, gap, round_off);
      ASSERT_NEAR(at.ny * at.ny + at.nz * at.nz, 1.0, round_off);
    };
    const auto v = profile.vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const PlanePoint a = v[k], b = v[(k + 1) % v.size()];
      expect_unit(a.y, a.z, 0.0);
      expect_unit(0.5 * (a.y + b.y), 0.5 * (a.z + b.z), 0.0);
      expect_unit(std::nextafter(a.y, 9.0), std::nextafter(a.z, 9.0), 0.0);
    }
    expect_unit(0.0, 0.0, profile.inscribed());
    const Location far = profile.locate(1e9, -1e9);
    EXPECT_NEAR(far.gap, -std::hypot(1e9, 1e9), 2.0);
    EXPECT_NEAR(std::hypot(far.ny, far.nz), 1.0, round_off);
  }
}

TEST(Profile, NormalOnACornerIsItsBisector) {
  const Profile square(polygon(4, round_hole));
  const Location at = square.locate(square.vertices()[1].y, square.vertices()[1].z);
  EXPECT_NEAR(at.ny, 0.0, round_off);
  EXPECT_NEAR(at.nz, -1.0, round_off);
}

TEST(Profile, NormalOnAnyCornerHalvesTheAngleOfItsFacets) {
  for (const Profile& profile : all()) {
    const auto v = profile.vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const PlanePoint before = v[(k + v.size() - 1) % v.size()], after = v[(k + 1) % v.size()];
      const auto along_normal = [](const Location& at, PlanePoint a,
                                   PlanePoint b) { // n times that of a facet
        const double y = b.y - a.y, z = b.z - a.z;
        return (at.nz * y - at.ny * z) / std::hypot(y, z);
      };
      const Location at = profile.locate(v[k].y, v[k].z);
      EXPECT_NEAR(at.gap, 0.0, round_off);
      EXPECT_NEAR(std::hypot(at.ny, at.nz), 1.0, round_off);
      EXPECT_NEAR(along_normal(at, before, v[k]), along_normal(at, v[k], after), 1e-9) << k;
      EXPECT_GT(along_normal(at, before, v[k]), 0.0) << k;
    }
  }
}

TEST(Profile, CopiesAndRebuildsGiveTheSameBytes) {
  for (const auto& points : {polygon(60, trefoil), jagged(400, 3)}) {
    const Profile profile(points), again(points), copy(profile);
    for (double y = -1.0; y < 1.0; y += 0.01) {
      expect_same_bytes(profile.locate(y, 0.4 * y), again.locate(y, 0.4 * y));
      expect_same_bytes(profile.locate(y, 0.4 * y), copy.locate(y, 0.4 * y));
    }
  }
}

TEST(Profile, ANodeThatIsNoNumberHasAGapThatIsNoNumber) {
  for (const Profile& profile : all())
    EXPECT_TRUE(std::isnan(profile.locate(std::numeric_limits<double>::quiet_NaN(), 0.1).gap));
}

TEST(Profile, TurnsWithItsPoints) {
  tests::Uniform uniform(15);
  const double turned = 0.7, c = std::cos(turned), s = std::sin(turned);
  const Profile profile(polygon(60, trefoil)), other(polygon(60, trefoil, turned));
  for (int i = 0; i < 3000; ++i) {
    const PlanePoint p = node_near(profile, uniform, i);
    const Location at = profile.locate(p.y, p.z), there = other.locate(c * p.y - s * p.z, s * p.y + c * p.z);
    ASSERT_NEAR(there.gap, at.gap, round_off);
    if (std::abs(at.gap) < near_the_line || !has_gradient(look_at_all(profile, p.y, p.z)))
      continue;
    ASSERT_NEAR(there.ny, c * at.ny - s * at.nz, direction_error);
    ASSERT_NEAR(there.nz, s * at.ny + c * at.nz, direction_error);
  }
}

TEST(Profile, IsMirroredWithItsPoints) {
  tests::Uniform uniform(16);
  std::vector<PolarPoint> points = jagged(50, 2), mirrored;
  for (auto p = points.rbegin(); p != points.rend(); ++p)
    mirrored.push_back({-p->angle, p->radius});
  const Profile profile(points), other(mirrored);
  for (int i = 0; i < 3000; ++i) {
    const PlanePoint p = node_near(profile, uniform, i);
    const Location at = profile.locate(p.y, p.z), there = other.locate(p.y, -p.z);
    ASSERT_NEAR(there.gap, at.gap, round_off);
    if (std::abs(at.gap) < near_the_line || !has_gradient(look_at_all(profile, p.y, p.z)))
      continue;
    ASSERT_NEAR(there.ny, at.ny, direction_error);
    ASSERT_NEAR(there.nz, -at.nz, direction_error);
  }
}

TEST(Profile, ScaledByAPowerOfTwoGivesTheSameBytes) {
  tests::Uniform uniform(17);
  constexpr double scale = 0x1p-13;
  for (auto points : {polygon(2000, trefoil, -1.0), polygon(10, round_hole), jagged(400, 3)}) {
    const Profile profile(points);
    for (PolarPoint& p : points)
      p.radius *= scale;
    const Profile small(points);
    EXPECT_EQ(small.inscribed(), scale * profile.inscribed());
    for (int i = 0; i < 3000; ++i) {
      const PlanePoint p = node_near(profile, uniform, i);
      const Location at = profile.locate(p.y, p.z);
      expect_same_bytes(small.locate(scale * p.y, scale * p.z), {scale * at.gap, at.ny, at.nz});
    }
  }
}

TEST(Profile, ManyFacetsTendToTheCircleAtSecondOrder) {
  const auto error = [](int n) {
    const Profile profile(polygon(n, round_hole));
    tests::Uniform uniform(18);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double angle = uniform(0.0, 2.0 * pi), r = uniform(0.3, 1.5);
      const double y = r * std::cos(angle), z = r * std::sin(angle);
      const Location at = profile.locate(y, z), exact = contact::locate(contact::Circle{1.0}, y, z);
      worst = std::max(worst, std::abs(at.gap - exact.gap));
      EXPECT_LE(std::hypot(at.ny - exact.ny, at.nz - exact.nz), 1.01 * pi / n); // half the angle of a facet
    }
    return worst;
  };
  double before = error(25);
  for (int n = 50; n <= 400; n *= 2) {
    const double now = error(n);
    EXPECT_NEAR(std::log2(before / now), 2.0, 0.05);
    EXPECT_LE(now, 1.0 - std::cos(pi / n) + round_off); // the sagitta
    before = now;
  }
}

TEST(Profile, InscribedBoundsTheGapFromBelow) {
  tests::Uniform uniform(19);
  for (const Profile& profile : all()) {
    double sharpest = 1.0;
    for (int i = 0; i < 3000; ++i) {
      const PlanePoint p = node_near(profile, uniform, i);
      const double slack = profile.locate(p.y, p.z).gap - (profile.inscribed() - std::hypot(p.y, p.z));
      ASSERT_GE(slack, -round_off);
      sharpest = std::min(sharpest, slack);
    }
    EXPECT_LT(sharpest, 0.01);
    EXPECT_NEAR(profile.inscribed(), look_at_all(profile, 0.0, 0.0).gap, round_off);
  }
}

TEST(Profile, LastPointThatRepeatsTheFirstIsDropped) {
  std::vector<PolarPoint> points = jagged(50, 2);
  const Profile open(points);
  points.push_back({points[0].angle + 2.0 * pi, points[0].radius});
  const Profile closed(points);
  EXPECT_EQ(closed.vertices().size(), 50u);
  expect_same_bytes(open.locate(0.3, -0.4), closed.locate(0.3, -0.4));
}
