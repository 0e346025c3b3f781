// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with a damping matrix that couples modes, with every scheme: the same as in other modal axes, and as in closed form.
#include "scenes.hpp"
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace damping_matrix_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Axes that couple all three.
Matrix3d turned() {
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
}

MatrixXd turned_modes() {
  MatrixXd r = MatrixXd::Identity(6, 6); // mode 2 stays alone
  r.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.6).toRotationMatrix();
  r.bottomRightCorner<3, 3>() = turned();
  return r;
}

/// A scene that impacts and slides in axes of its own, and the same seen in turned modal axes of equal stiffness.
std::array<Scene, 2> twins() {
  Scene plain = rattling(3, 6, 0.3);
  plain.system.stiffness.setConstant(4e3);
  plain.system.damping = VectorXd::LinSpaced(6, 0.5, 60.0);
  Scene twin = plain;
  const MatrixXd r = turned_modes();
  twin.system.damping_matrix = r * plain.system.damping.asDiagonal() * r.transpose();
  twin.system.damping.setZero(); // replaced by the matrix
  for (auto& c : twin.contacts)
    c.b = c.b * r.transpose();
  for (auto& load : twin.loads)
    load.modal_force = r * load.modal_force;
  return {plain, twin};
}

} // namespace

class DampingMatrix : public testing::TestWithParam<Candidate> {};
INSTANTIATE_TEST_SUITE_P(Schemes, DampingMatrix, testing::ValuesIn(candidates), name_of_candidate);

TEST_P(DampingMatrix, GivesTheSameInOtherModalAxes) {
  const auto scenes = twins();
  const StepOptions options{
      GetParam().kind, GetParam().kind == SchemeKind::runge_kutta_54 ? std::nullopt : std::optional(1e-4)};
  const History a = simulate(scenes[0], options, 7.7e-4), b = simulate(scenes[1], options, 7.7e-4);
  constexpr double grown = 1e-7; // round-off grows tenfold in 0.05 to 0.1 s
  EXPECT_GT(a.normal.maxCoeff(), 0.0);
  EXPECT_LT((a.normal - b.normal).norm(), grown * a.normal.norm());
  EXPECT_LT(std::abs(a.q.norm() - b.q.norm()), grown * a.q.norm());
  EXPECT_LT(std::abs(a.v.norm() - b.v.norm()), grown * a.v.norm());
  const Energy &x = a.report.energy, &y = b.report.energy;
  EXPECT_GT(x.modal_damping, 0.01 * x.scale);
  // Euler, of order 1, takes the loss of a matrix with the velocity before the step, single dampings with the mean of both
  const double balanced = GetParam().first_order() ? 1e-4 : grown;
  EXPECT_NEAR(x.modal_damping, y.modal_damping, balanced * x.scale);
  EXPECT_NEAR(x.load_work, y.load_work, grown * x.scale);
  EXPECT_NEAR(a.report.residual_relative, b.report.residual_relative, balanced);
}

TEST(Collocation, GivesTheSameInOtherModalAxesWhereItCutsSteps) {
  auto scenes = twins();
  for (Scene& scene : scenes) {
    scene.v0.setConstant(0.02);
    scene.duration = 0.025;
    for (auto& c : scene.contacts)
      c.support.normal.stiffness = 1e8;
  }
  scenes[1].v0 = turned_modes() * scenes[0].v0;
  const History a = simulate(scenes[0], collocation(8e-4), 7.7e-4),
                b = simulate(scenes[1], collocation(8e-4), 7.7e-4);
  constexpr double grown = 1e-6; // round-off through impacts on stiff contacts
  EXPECT_GT(a.report.counts.rejected, 0);
  EXPECT_EQ(a.report.counts.rejected, b.report.counts.rejected);
  EXPECT_LT((a.q - turned_modes().transpose() * b.q).norm(), grown * a.q.norm());
  EXPECT_LT((a.v - turned_modes().transpose() * b.v).norm(), grown * a.v.norm());
}

TEST(DampingMatrix, TakesWhatTheEnergyBalanceSays) {
  // free motion of two coupled modes: the loss is int v.C v dt, here by Simpson's rule over fine outputs
  Scene s = mass_point(1.0, Vec3(100.0, 900.0, 0.0), 1.0);
  s.system.damping_matrix = Matrix3d{{3.0, 2.0, 0.0}, {2.0, 5.0, 0.0}, {0.0, 0.0, 1.0}};
  start(s, 1.0, Vec3(0.1, -0.05, 0.0), Vec3(1.0, 0.0, 2.0));
  constexpr int intervals = 2000;
  for (const StepOptions& options : {splitting(1e-2), collocation(1e-2)}) {
    const History run = simulate(s, options, 1.0 / intervals);
    // energies of splitting are those at the end of the last record's step, of collocation those at its time
    const double end =
        run.report.end_time + (run.choice.scheme == SchemeKind::splitting ? 0.5 * run.choice.step : 0.0);
    double loss = 0.0;
    const int last = static_cast<int>(std::lround(end * intervals));
    for (int k = 0; k <= last; ++k) {
      const double weight = k == 0 || k == last ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
      loss += weight / (3.0 * intervals) * run.v.col(k).dot(s.system.damping_matrix * run.v.col(k));
    }
    ASSERT_EQ(last % 2, 0);
    constexpr double simpson = 1e-8; // (w h)^4/180 with w h = 0.03
    EXPECT_NEAR(run.report.energy.modal_damping, loss, simpson * loss);
    EXPECT_LT(run.report.residual_relative, 1e-12);
  }
}

TEST(CaseA5, ChainWithNonProportionalDamping) {
  // eight masses between fixed ends; modes of the undamped chain, known in closed form
  constexpr int n = 8;
  MatrixXd shapes(n, n), damping = MatrixXd::Zero(n, n);
  Scene s;
  s.system.stiffness.resize(n);
  const double pi = std::acos(-1.0);
  for (int i = 0; i < n; ++i) {
    s.system.stiffness(i) = 4.0 * 1e4 * std::pow(std::sin((i + 1) * pi / 18.0), 2);
    for (int j = 0; j < n; ++j)
      shapes(j, i) = std::sqrt(2.0 / 9.0 / 10.0) * std::sin((i + 1) * (j + 1) * pi / 9.0);
  }
  for (int d = 0; d < n + 1; ++d) { // between masses d - 1 and d
    const double c = d == 0 ? 250.0 : d == n ? 25.0 : 50.0;
    if (d < n)
      damping(d, d) += c;
    if (d > 0)
      damping(d - 1, d - 1) += c;
    if (d > 0 && d < n) {
      damping(d - 1, d) -= c;
      damping(d, d - 1) -= c;
    }
  }
  s.system.damping_matrix = shapes.transpose() * damping * shapes;
  s.system.damping = s.system.damping_matrix.diagonal();
  s.loads = {{Constant{1.0}, shapes.row(3).transpose()}};
  s.q0 = s.v0 = VectorXd::Zero(n);
  s.duration = 1.0;
  const History run = simulate(s, {}, 0.09);
  EXPECT_EQ(run.choice.scheme, SchemeKind::splitting);
  const std::array<double, 9> exact = {3.954085e-5, 5.135974e-6, 3.767924e-5, 7.355104e-6, 3.585249e-5,
                                       8.819161e-6, 3.465793e-5, 1.009426e-5, 3.362162e-5};
  constexpr double digits = 1e-11; // of the six decimals printed, with one unit of 1e-5's seventh digit
  for (int k = 1; k <= 9; ++k)
    EXPECT_NEAR(shapes.row(3).dot(run.q.col(k)), exact[static_cast<std::size_t>(k - 1)], digits)
        << "0.09 * " << k;
}

} // namespace damping_matrix_test
