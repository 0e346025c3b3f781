// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of several tubes: a row of one metre of each, against Connors' closed form, against the determinant of the motion in a root s, and
// against the laws of tubes alone.
#include "core/general_eigenvalues.hpp"
#include "fluidelastic_cases.hpp"
#include <gtest/gtest.h>

namespace fluidelastic_test::tubes {
namespace {

using Complex = std::complex<double>;
constexpr double digits = 1e-9; // of reference values and of roots, relative

/// Each tube a structure of its own.
std::vector<TubeOfLaw> row(const std::vector<Sampling>& samplings) {
  std::vector<TubeOfLaw> out;
  Eigen::Index first = 0;
  for (const Sampling& one : samplings) {
    out.push_back({one, first});
    first += one.modes();
  }
  return out;
}

Eigen::VectorXcd roots(const std::vector<TubeOfLaw>& tubes, const FluidelasticLaw& law, double damping,
                       double factor) {
  Eigen::VectorXd w(tubes.back().first + tubes.back().sampling.modes());
  for (const TubeOfLaw& tube : tubes)
    w.segment(tube.first, tube.sampling.modes()) = 2.0 * std::numbers::pi * tube.sampling.frequency;
  return core::general_eigenvalues(state_matrix(
      w.cwiseAbs2(), 2.0 * damping * w, scaled(motion_forces(tubes, law, w.size(), no_limit), factor)));
}

double critical(const std::vector<TubeOfLaw>& tubes, const FluidelasticLaw& law, double damping, double low,
                double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (roots(tubes, law, damping, middle).real().maxCoeff() < 0.0 ? low : high) = middle;
  }
  return low;
}

/// Lifts of two neighbours that push each other, and each what law S1 says.
FluidelasticLaw law_of_two() {
  FluidelasticLaw law;
  law.stiffness = for_each_tube(law_s1().stiffness, 2);
  law.damping = for_each_tube(law_s1().damping, 2);
  law.lags = {{0.4, for_each_tube(law_s1().lags[0].force, 2)}, {1.7, Eigen::MatrixXcd::Zero(4, 4)}};
  law.stiffness(1, 3) = 2.5;
  law.stiffness(3, 1) = -1.5;
  law.damping(1, 3) = 0.1;
  law.lags[0].force(3, 1) = -1.2;
  law.lags[1].force(1, 3) = 0.7;
  return law;
}

/// Two neighbours of equal frequency: V_c/(f D) = K sqrt(m delta/(rho D^2)).
TEST(FluidelasticTubes, ConnorsCouplesNeighbours) {
  const Sampling one = metre(s1, 1.0);
  FluidelasticLaw law;
  law.stiffness = law.damping = Eigen::MatrixXd::Zero(4, 4);
  law.stiffness(1, 3) = connors_law(3.0).stiffness(0, 1);
  law.stiffness(3, 1) = -law.stiffness(1, 3);
  EXPECT_NEAR(critical(row({one, one}), law, s1.damping, 0.5, 1.5), 0.8237621096, digits);
  law.damping(1, 1) = law.damping(3, 3) = -0.4;
  EXPECT_NEAR(critical(row({one, one}), law, s1.damping, 0.5, 1.5), 1.0128649486, digits);
}

/// Every root s has a motion: det(m (s^2 + 2 zeta w s + w^2) - q F(s D/V)) = 0, q and V those of the tube of the row.
TEST(FluidelasticTubes, RootsOfTwoTubesInDifferentFlowSolveTheirEquations) {
  const OneDof masses[] = {s1, {1.3, 23.0, s1.damping, 500.0}};
  const double velocities[] = {2.0, 1.4};
  const FluidelasticLaw law = law_of_two();
  const Eigen::VectorXcd all =
      roots(row({metre(masses[0], velocities[0]), metre(masses[1], velocities[1])}), law, s1.damping, 1.0);
  EXPECT_EQ(
      all.size(),
      4 + 3 +
          1); // lags of the first tube at both V/D, of the second at its own; and one at that of the first
  int unseen = 0;
  for (const Complex s : all) {
    if (std::abs(s + 0.4 * velocities[1] / diameter) < digits * std::abs(s)) {
      ++unseen; // two lags of one rate on the second tube: a combination has no force
      continue;
    }
    Eigen::Matrix2cd of_motion;
    double size = 1.0;
    for (int i = 0; i < 2; ++i) {
      const double w = 2.0 * std::numbers::pi * masses[i].frequency,
                   q = 0.5 * masses[i].density * velocities[i] * velocities[i];
      const Complex p = s * diameter / velocities[i];
      double terms = 0.0;
      for (int j = 0; j < 2; ++j) {
        Complex f = law.stiffness(2 * i + 1, 2 * j + 1) + p * law.damping(2 * i + 1, 2 * j + 1);
        for (const FluidelasticLaw::Lag& lag : law.lags)
          f += lag.force(2 * i + 1, 2 * j + 1) * p / (p + lag.rate);
        of_motion(i, j) = -q * f;
        terms += std::abs(of_motion(i, j));
      }
      const Complex own = masses[i].mass * (s * s + 2.0 * s1.damping * w * s + w * w);
      terms += masses[i].mass * (std::norm(s) + w * w);
      of_motion(i, i) += own;
      size *= terms;
    }
    EXPECT_LT(std::abs(of_motion.determinant()), 1e-10 * size) << s; // round-off of a small lag root
  }
  EXPECT_EQ(unseen, 1);
}

/// What a law does not couple is, bit for bit, what laws of tubes alone say.
TEST(FluidelasticTubes, WithoutCouplingAreTubesAlone) {
  constexpr Eigen::Index modes = 6;
  std::vector<Sampling> tubes{pinned(modes, 0.25, 0.75), pinned(modes, 0.25, 0.75)};
  for (std::size_t i = 0; i < tubes[0].stations.size(); ++i) // as long as the other, and faster
    tubes[1].stations[i].flow.velocity = 1.0 + 0.5 * tubes[1].stations[i].shapes(1, 0);
  FluidelasticLaw law;
  law.stiffness = for_each_tube(law_s1().stiffness, 2);
  law.damping = for_each_tube(law_s1().damping, 2);
  law.lags = {{0.4, for_each_tube(law_s1().lags[0].force, 2)}};
  const core::MotionForces both = motion_forces(row(tubes), law, 2 * modes, no_limit);
  EXPECT_TRUE(both.stiffness.topRightCorner(modes, modes).isZero(0.0));
  EXPECT_EQ(both.stiffness.topLeftCorner(modes, modes),
            motion_forces(tubes[0], law_s1(), modes, no_limit).stiffness);
  EXPECT_EQ(both.damping.bottomRightCorner(modes, modes),
            motion_forces(tubes[1], law_s1(), modes, no_limit).damping);
  for (Eigen::Index state = 0; state < both.states(); ++state) {
    const bool of_first = !both.output.row(state).head(modes).isZero(0.0);
    EXPECT_TRUE(both.output.row(state).segment(of_first ? modes : 0, modes).isZero(0.0));
    EXPECT_TRUE(both.input.col(state).segment(of_first ? modes : 0, modes).isZero(0.0));
  }
  const std::vector<Sampling> equal{tubes[0], tubes[0]};
  const core::MotionForces twice = motion_forces(row(equal), law, 2 * modes, no_limit),
                           once = motion_forces(tubes[0], law_s1(), modes, no_limit);
  ASSERT_EQ(twice.states(), 2 * once.states());
  EXPECT_EQ(twice.input.topLeftCorner(modes, once.states()), once.input);
  EXPECT_EQ(twice.output.bottomRightCorner(once.states(), modes), once.output);
}

/// Two tubes that are one structure: the same motion in modes of both.
TEST(FluidelasticTubes, OfOneStructureMoveAsThoseOfTwo) {
  const Sampling one = metre(s1, 2.0);
  Sampling first = one, second = one;
  for (Sampling* tube : {&first, &second}) {
    tube->frequency = Eigen::Vector2d::Constant(s1.frequency);
    tube->modal_mass = Eigen::Vector2d::Ones();
    const double sign = tube == &first ? 1.0 : -1.0; // in phase, and against each other
    tube->stations[0].shapes =
        Eigen::Vector3d::UnitY() * Eigen::RowVector2d(1.0, sign) / std::sqrt(2.0 * s1.mass);
  }
  const auto sorted = [](Eigen::VectorXcd values) {
    std::sort(values.begin(), values.end(), [](Complex a, Complex b) {
      return std::pair(a.imag(), a.real()) < std::pair(b.imag(), b.real());
    });
    return values;
  };
  FluidelasticLaw law = law_of_two();
  law.lags.pop_back(); // lags of a structure are of all its tubes, those of two of each
  const Eigen::VectorXcd apart = sorted(roots(row({one, one}), law, s1.damping, 1.0)),
                         together = sorted(roots({{first, 0}, {second, 0}}, law, s1.damping, 1.0));
  ASSERT_EQ(apart.size(), together.size());
  EXPECT_LT((apart - together).cwiseAbs().maxCoeff(), digits * apart.cwiseAbs().maxCoeff());
}

} // namespace
} // namespace fluidelastic_test::tubes
