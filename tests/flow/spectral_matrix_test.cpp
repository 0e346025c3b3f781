// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/cross_spectrum.hpp"
#include "flow/spectral_matrix.hpp"
#include "turbulent_zone.hpp"
#include <gtest/gtest.h>

namespace spectral_matrix_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

MatrixLoad load_of(const Eigen::MatrixXcd& g) {
  return {"pair", 0, [g](double) { return g; }, Eigen::MatrixXd::Identity(g.rows(), g.rows())};
}

} // namespace

TEST(SpectralMatrix, OfASineCrossSpectrumHasTheReferenceValues) {
  // S = f sin(pi y) sin(pi y') on the first half of a span, modes sin(pi y) and sin(2 pi y), f = 1
  const PatchGrid grid = cut_into_patches(0.0, 0.5, 0.5 / 400.0);
  const Eigen::VectorXd load = (grid.s.array() * pi).sin() * grid.ds.array();
  Eigen::MatrixXd shapes(2, grid.s.size());
  shapes.row(0) = (grid.s.array() * pi).sin();
  shapes.row(1) = (grid.s.array() * (2.0 * pi)).sin();
  const MatrixLoad sine{"sine", 0,
                        [&](double f) -> Eigen::MatrixXcd {
                          return (f * load * load.transpose()).cast<std::complex<double>>();
                        },
                        shapes};
  const Eigen::MatrixXcd g = cross_spectrum(sine, 1.0);
  constexpr double midpoint_rule = 5e-6; // (pi/800)^2/3
  EXPECT_NEAR(std::abs(g(0, 0)), 1.0 / 16.0, midpoint_rule);
  EXPECT_NEAR(std::abs(g(0, 1)), 1.0 / (6.0 * pi), midpoint_rule);
  EXPECT_NEAR(std::abs(g(1, 1)), 4.0 / (9.0 * pi * pi), midpoint_rule);
}

TEST(SpectralMatrix, HasAHermitianRoot) {
  Eigen::MatrixXcd g(2, 2);
  const std::complex<double> c = std::polar(0.8, 1.1);
  g << 2.0, c, std::conj(c), 1.0;
  constexpr double round_off = 1e-14;
  const Eigen::MatrixXcd h = hermitian_root(load_of(g), 5.0);
  EXPECT_LT((h * h - g).norm(), round_off);
  EXPECT_LT((h - h.adjoint()).norm(), round_off);
}

TEST(SpectralMatrix, MayLackRank) {
  Eigen::MatrixXcd g = Eigen::MatrixXcd::Constant(3, 3, 1.0); // one source, three forces
  constexpr double round_off = 1e-7; // square root of that of the eigenvalues that are 0
  const Eigen::MatrixXcd h = hermitian_root(load_of(g), 5.0);
  EXPECT_LT((h * h - g).norm(), round_off);
  g(0, 0) -= 1e-7;
  EXPECT_NE(message_of([&] { (void)hermitian_root(load_of(g), 5.0); }).find("has the eigenvalue -"),
            std::string::npos);
  g(0, 0) += 1e-7 - 1e-9; // round-off
  EXPECT_EQ(message_of([&] { (void)hermitian_root(load_of(g), 5.0); }), "");
}

TEST(SpectralMatrix, IsLinearBetweenRows) {
  const Eigen::MatrixXcd a = Eigen::MatrixXcd::Identity(2, 2), b = 3.0 * a;
  const SpectralMatrixTable table({10.0, 20.0}, {a, b});
  EXPECT_EQ(table(15.0), 2.0 * a);
  EXPECT_EQ(table(10.0), a);
  EXPECT_EQ(table(20.0), b);
  EXPECT_EQ(table(9.99).norm(), 0.0);
  EXPECT_EQ(table(20.01).norm(), 0.0);
}

TEST(SpectralMatrix, RefusesWrongInput) {
  const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(2, 2);
  EXPECT_EQ(
      message_of([&] { (void)SpectralMatrixTable({1.0}, {one}); }),
      "a table of spectral matrices has 1 frequencies and 1 matrices; give as many of both, at least two");
  EXPECT_EQ(message_of([&] {
              (void)SpectralMatrixTable({2.0, 1.0}, {one, one});
            }),
            "frequencies of spectral matrices are to ascend; 1 Hz follows 2 Hz");
  EXPECT_EQ(message_of([&] {
              (void)SpectralMatrixTable({1.0, 2.0}, {one, Eigen::MatrixXcd::Identity(3, 3)});
            }),
            "the spectral matrix at 2 Hz is 3 x 3, that at 1 Hz 2 x 2; give all the same size");
  MatrixLoad load = load_of(one);
  load.shapes.resize(2, 3);
  EXPECT_EQ(message_of([&] { (void)cross_spectrum(load, 4.0); }),
            "random load 'pair': its spectral matrix at 4 Hz is 2 x 2, its forces are 3; give a row and a "
            "column for each force");
  Eigen::MatrixXcd skew = one;
  skew(0, 1) = 0.5;
  EXPECT_EQ(message_of([&] { (void)cross_spectrum(load_of(skew), 4.0); }),
            "random load 'pair': its spectral matrix at 4 Hz is not Hermitian; give G_ji = conj G_ij");
  load.spectrum = {};
  EXPECT_EQ(message_of([&] { (void)cross_spectrum(load, 4.0); }),
            "random load 'pair' has no spectral matrix; give one");
  EXPECT_EQ(message_of([&] { (void)hermitian_root(load_of(-one), 4.0); }),
            "random load 'pair': its spectral matrix at 4 Hz has the eigenvalue -1, that of no force; give a "
            "matrix without "
            "negative eigenvalues");
}

} // namespace spectral_matrix_test
