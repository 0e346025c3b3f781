// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where contacts are and which are near, against their rows and `locate` one by one.
#include "transient/contacts/contact_motion.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace fretwork::transient::contact_motion_test {
namespace {

constexpr Eigen::Index modes = 21;

class ContactMotions : public testing::TestWithParam<kernels::VectorSize> {
protected:
  void SetUp() override { kernels::limit_vectors(GetParam()); }
  void TearDown() override { kernels::limit_vectors(kernels::VectorSize::pack); }

  std::mt19937 random_{3};
  std::normal_distribution<double> normal_;

  std::vector<ContactPoint> points(int count, bool rubs) {
    using contact::PlaneAxis;
    std::vector<contact::PolarPoint> corners;
    for (int k = 0; k < 12; ++k)
      corners.push_back({k / 12.0 * 2.0 * std::numbers::pi, 1e-3});
    const contact::Obstacle obstacles[] = {contact::Circle{1e-3},
                                           contact::PlanePair{8e-4, PlaneAxis::z},
                                           contact::Stop{3e-4, PlaneAxis::y},
                                           contact::RoundPair{1e-3},
                                           contact::FacingPlanes{2e-4, PlaneAxis::z, -1.0},
                                           contact::Ellipse{6.1e-3, 6e-3, 5e-3},
                                           contact::BroachedSpace(9e-3, {9.9e-3, 1.1e-2, 3, 0.35}),
                                           contact::Profile(corners)};
    constexpr std::size_t kinds = std::size(obstacles);
    static_assert(kinds == std::variant_size_v<contact::Obstacle>); // one of each
    for (std::size_t k = 0; k < kinds; ++k)
      EXPECT_EQ(obstacles[k].index(), k);
    std::vector<ContactPoint> out(static_cast<std::size_t>(count));
    for (std::size_t c = 0; c < out.size(); ++c) {
      out[c].support = {obstacles[(c + static_cast<std::size_t>(count)) % kinds], {1e5}, {}};
      if (rubs) // along x_loc too
        out[c].support.friction = {5e4, 15.0, 0.4, 0.3};
      out[c].rest = {0.0, 2e-4 * normal_(random_), 2e-4 * normal_(random_)};
      out[c].b = Eigen::MatrixXd::NullaryExpr(3, modes, [&] { return normal_(random_); });
    }
    return out;
  }
};

TEST_P(ContactMotions, AreThoseOfTheRowsAndTheirPlaces) {
  for (const int count : {1, 2, 3, 4, 5, 8, 11})
    for (const auto& [window, rubs] : {std::pair{0.0, false}, {0.0, true}, {5e-5, false}, {5e-5, true}}) {
      const auto all = points(count, rubs);
      const PackedContacts contacts(all, modes);
      EXPECT_EQ(contacts.components, rubs ? 3 : 2);
      ContactMotion motion(contacts);
      kernels::Array q(static_cast<std::size_t>(contacts.padded_modes)), v(q);
      int near = 0, open = 0;
      for (int k = 0; k < 400; ++k) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(modes); ++i) {
          q[i] = 1.5e-4 * normal_(random_);
          v[i] = normal_(random_);
        }
        motion.gather(q.data(), v.data());
        const bool any = motion.find_near(window);
        double number = 0.0;
        for (int c = 0; c < count; ++c) {
          const auto& point = all[static_cast<std::size_t>(c)];
          const Eigen::Map<const Eigen::VectorXd> by_mode(q.data(), modes), rates(v.data(), modes);
          const Eigen::Vector3d u = point.b * by_mode, w = point.b * rates;
          EXPECT_NEAR(motion.u[c], u.y(), 1e-17 * modes);
          EXPECT_NEAR(motion.u[contacts.width + c], u.z(), 1e-17 * modes);
          if (rubs) {
            EXPECT_NEAR(motion.u[2 * contacts.width + c], u.x(), 1e-17 * modes);
          }
          EXPECT_NEAR(motion.w[c], w.y(), 1e-14 * modes);
          EXPECT_NEAR(motion.w[contacts.width + c], w.z(), 1e-14 * modes);
          const contact::Location at = motion.locate(c);
          const double left = at.gap - window * w.tail<2>().norm();
          if (std::abs(left) < 1e-15)
            continue;
          const bool bound = !contact::properties_of(point.support.obstacle).is_bound_gap;
          EXPECT_TRUE(motion.near(c) == (left < 0.0) || (bound && motion.near(c)))
              << count << " contacts, " << c;
          number += motion.near(c);
          near += motion.near(c);
          open += !motion.near(c);
          if (motion.near(c)) {
            EXPECT_NEAR(motion.gaps[c], at.gap, 1e-17);
            EXPECT_NEAR(motion.normal_y[c], at.ny, 1e-13);
            EXPECT_NEAR(motion.normal_z[c], at.nz, 1e-13);
          }
        }
        EXPECT_EQ(motion.places.near, number);
        EXPECT_EQ(any, number > 0.0);
      }
      EXPECT_GT(near, 40) << count;
      EXPECT_GT(open, 40) << count;
    }
}

INSTANTIATE_TEST_SUITE_P(InVectors, ContactMotions,
                         testing::Values(kernels::VectorSize::pair, kernels::VectorSize::half,
                                         kernels::VectorSize::pack));

} // namespace
} // namespace fretwork::transient::contact_motion_test
