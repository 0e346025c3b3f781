// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/cross_spectrum.hpp"
#include "turbulent_zone.hpp"
#include <gtest/gtest.h>

namespace cross_spectrum_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

/// Sums over all pairs of patches.
Eigen::MatrixXd direct_sum(const Eigen::MatrixXd& a, const Eigen::VectorXd& s, double correlation_length) {
  Eigen::MatrixXd r(s.size(), s.size());
  for (Eigen::Index k = 0; k < s.size(); ++k)
    for (Eigen::Index l = 0; l < s.size(); ++l)
      r(k, l) = std::exp(-std::abs(s[k] - s[l]) / correlation_length);
  return a * r * a.transpose();
}

/// Joint acceptance of two modes sin(m pi s/L), sin(n pi s/L) of a pinned tube under a uniform load of correlation exp(-|s - s'|/lambda):
///     I_mn/L^2 = a d_mn/(a^2 + n^2 pi^2) + m n pi^2 (1 - (-1)^m e^-a)(1 + (-1)^(m+n))/[(a^2 + m^2 pi^2)(a^2 + n^2 pi^2)],   a = L/lambda
/// @param m, n  >= 1   @param relative_length  lambda/L, > 0
double pinned_joint_acceptance(int m, int n, double relative_length) {
  const double a = 1.0 / relative_length;
  const double am = a * a + m * m * pi * pi, an = a * a + n * n * pi * pi;
  const double sign_m = m % 2 == 0 ? 1.0 : -1.0, sign_sum = (m + n) % 2 == 0 ? 1.0 : -1.0;
  return (m == n ? a / an : 0.0) +
         m * n * pi * pi * (1.0 - sign_m * std::exp(-a)) * (1.0 + sign_sum) / (am * an);
}

/// G for a spectrum of 1 and L = 1: the joint acceptance I_mn/L^2.
Eigen::MatrixXd acceptance(double relative_length, Eigen::Index patches, int modes) {
  TurbulentZone zone = pinned_zone(1.0, relative_length, patches, modes);
  zone.spectrum = white(1.0);
  return CrossSpectrum({zone})(10.0);
}

/// V = 1 + s on the span, V varying by a factor of 2.
TurbulentZone sheared_zone() {
  TurbulentZone zone = pinned_zone(1.0, 0.1, 100, 4, 2);
  zone.velocity = 1.0 + zone.s.array();
  zone.axes[1].weight = 0.5;
  zone.spectrum = Cor3{};
  return zone;
}

} // namespace

TEST(JointAcceptance, HasTheReferenceValues) {
  constexpr double printed = 5e-9; // relative, nine digits
  const auto expect = [](int m, int n, double relative_length, double value) {
    EXPECT_NEAR(pinned_joint_acceptance(m, n, relative_length), value, printed * std::abs(value));
    EXPECT_EQ(pinned_joint_acceptance(m, n, relative_length), pinned_joint_acceptance(n, m, relative_length));
  };
  expect(1, 1, 0.1, 0.0926522721);
  expect(2, 2, 0.1, 0.0757540907);
  expect(1, 3, 0.1, 0.00285450197);
  expect(3, 3, 0.1, 0.0579414039);
  expect(1, 1, 5.0, 0.385765040);
  expect(1, 3, 5.0, 0.122299676);
  EXPECT_EQ(pinned_joint_acceptance(1, 2, 0.1), 0.0);
}

TEST(CrossSpectrum, OfPatchesConvergesToTheJointAcceptance) {
  for (const double relative_length : {0.1, 5.0}) {
    const Eigen::MatrixXd coarse = acceptance(relative_length, 500, 3),
                          fine = acceptance(relative_length, 1000, 3);
    for (int m = 1; m <= 3; ++m)
      for (int n = 1; n <= 3; ++n) {
        const double exact = pinned_joint_acceptance(m, n, relative_length);
        const double error = fine(m - 1, n - 1) - exact, before = coarse(m - 1, n - 1) - exact;
        constexpr double small = 2e-5,
                         order = 0.02; // error (ds/lambda)^2/6 = 1.7e-5 of the diagonal; of order 2
        EXPECT_LT(std::abs(error), small * pinned_joint_acceptance(1, 1, relative_length));
        if (exact != 0.0) {
          EXPECT_NEAR(before / error, 4.0, 4.0 * order) << m << n;
        }
      }
  }
}

TEST(CrossSpectrum, OfPatchesOfAFifthOfTheCorrelationLengthIsWithinSevenInAThousand) {
  constexpr double stated = 0.007; // (ds/lambda)^2/6
  const Eigen::MatrixXd g = acceptance(0.1, 50, 3);
  for (int m = 1; m <= 3; ++m)
    EXPECT_NEAR(g(m - 1, m - 1) / pinned_joint_acceptance(m, m, 0.1), 1.0, stated);
}

TEST(CrossSpectrum, IsTheSumOverAllPairsOfPatches) {
  constexpr double round_off = 1e-13;
  const TurbulentZone zone = sheared_zone();
  const ZoneSpectra spectra(zone);
  Eigen::MatrixXd direct = Eigen::MatrixXd::Zero(4, 4);
  for (const LoadAxis& axis : zone.axes) {
    Eigen::MatrixXd a = std::sqrt(axis.weight) * axis.shapes * zone.ds.asDiagonal();
    for (Eigen::Index k = 0; k < zone.patches(); ++k)
      a.col(k) *= spectra.amplitude(k, 30.0);
    direct += direct_sum(a, zone.s, zone.correlation_length);
  }
  const Eigen::MatrixXd g = CrossSpectrum({zone})(30.0);
  EXPECT_LT((g - direct).norm(), round_off * direct.norm());
  EXPECT_EQ((g - g.transpose()).norm(), 0.0);
}

TEST(CrossSpectrum, OfZonesAndAxesIsTheirSum) {
  constexpr double round_off = 1e-13;
  TurbulentZone one = sheared_zone(), other = pinned_zone(1.0, 0.2, 60, 4);
  other.id = 1;
  const Eigen::MatrixXd sum = CrossSpectrum({one})(30.0) + CrossSpectrum({other})(30.0);
  EXPECT_LT((CrossSpectrum({one, other})(30.0) - sum).norm(), round_off * sum.norm());
}

TEST(CrossSpectrum, FollowsTheScaleOfTheShapes) {
  constexpr double round_off = 1e-13;
  TurbulentZone zone = sheared_zone();
  const Eigen::MatrixXd g = CrossSpectrum({zone})(30.0);
  const Eigen::VectorXd scale = Eigen::Vector4d(2.0, -0.5, 1e3, 1.0);
  for (LoadAxis& axis : zone.axes)
    axis.shapes = scale.asDiagonal() * axis.shapes;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * g * scale.asDiagonal();
  EXPECT_LT((CrossSpectrum({zone})(30.0) - scaled).norm(), round_off * scaled.norm());
}

TEST(CrossSpectrum, OfZoneMeanIsThatOfLocalScalingWhereTheFlowIsUniform) {
  constexpr double round_off = 1e-13;
  for (const Spectrum& s :
       {Spectrum{Cor1{}}, Spectrum{Cor2{}}, Spectrum{Cor3{}}, Spectrum{Cor4{}}, Spectrum{Axisa{}},
        Spectrum{Inlet{}}, Spectrum{TwoPhaseSpectrum{740.0}}, white(2.0)}) {
    TurbulentZone zone = pinned_zone(1.0, 0.1, 60, 2);
    zone.void_fraction.setConstant(0.4);
    zone.spectrum = s;
    const Eigen::MatrixXd local = CrossSpectrum({zone})(30.0);
    zone.scaling = Scaling::zone_mean;
    EXPECT_LT((CrossSpectrum({zone})(30.0) - local).norm(), round_off * local.norm()) << name_of(s);
  }
}

TEST(CrossSpectrum, OfZoneMeanHasTheReferenceValueUnderCor1) {
  // clamped tube L 1 m, D 40 mm, first mode of maximum 1, V = 4 s(1 - s), running velocity 1 m/s, Re 4e4
  TurbulentZone zone = pinned_zone(1.0, 0.136, 8000, 1);
  const double k = 4.730040744862704, c = (std::cosh(k) - std::cos(k)) / (std::sinh(k) - std::sin(k));
  const auto shape = [&](double s) {
    return std::cosh(k * s) - std::cos(k * s) - c * (std::sinh(k * s) - std::sin(k * s));
  };
  for (Eigen::Index i = 0; i < zone.patches(); ++i)
    zone.axes[0].shapes(0, i) = shape(zone.s[i]) / shape(0.5);
  zone.velocity = 4.0 * zone.s.array() * (1.0 - zone.s.array());
  zone.density.setConstant(1000.0);
  zone.diameter.setConstant(0.04);
  zone.viscosity.setConstant(1e-6);
  zone.spectrum = Cor1{};
  zone.scaling = Scaling::zone_mean;
  zone.running_velocity = 1.0;
  constexpr double printed = 5e-7; // relative
  EXPECT_NEAR((zone.axes[0].shapes.array().square().matrix() * zone.ds)(0), 0.396478, 1e-6);
  const double g = CrossSpectrum({zone})(5.0)(0, 0);
  EXPECT_NEAR(g, 1.576820e-2, printed * g);
  const double integral = g / (0.25 * std::pow(0.04, 3.0) * 3.049800e-3);
  EXPECT_NEAR(integral, 3.231400e5, printed * integral);
}

TEST(CrossSpectrumTable, IsExactForSeparableSpectra) {
  constexpr double round_off = 1e-13;
  TurbulentZone zone = pinned_zone(1.0, 0.1, 60, 3);
  zone.spectrum = Axisa{};
  const CrossSpectrum exact({zone});
  const CrossSpectrumTable table(exact, 1.0, 400.0);
  Eigen::MatrixXd g;
  for (const double f : {1.7, 17.0, 170.0}) {
    table(f, g);
    EXPECT_LT((g - exact(f)).norm(), round_off * g.norm());
  }
  EXPECT_EQ(exact.breaks().size(), 3u); // 0.01, 0.2 and 3 times V/D
}

TEST(CrossSpectrumTable, InterpolatesSpectraThatDifferFromPatchToPatch) {
  constexpr double stated = 2e-3; // where the slopes of patches jump
  const CrossSpectrum exact({sheared_zone()});
  const CrossSpectrumTable table(exact, 1.0, 400.0);
  Eigen::MatrixXd g;
  for (double f = 1.0; f < 400.0; f *= 1.0173) {
    table(f, g);
    EXPECT_LT((g - exact(f)).norm(), stated * g.norm()) << f;
  }
  EXPECT_EQ(message_of([&] { (void)CrossSpectrumTable(exact, 0.0, 2.0); }),
            "a table of cross-spectra from 0 Hz to 2 Hz makes no sense; give ends with 0 < low < high");
}

TEST(CrossSpectrum, LeavesOutWhatItsRangeDoesNotCover) {
  TurbulentZone zone = pinned_zone(1.0, 0.1, 60, 2);
  zone.spectrum = TableSpectrum{{10.0, 20.0}, {1.0, 1.0}, true};
  const CrossSpectrum all({zone}), covered({zone}, Part::covered);
  EXPECT_EQ((all(15.0) - covered(15.0)).norm(), 0.0);
  EXPECT_GT(all(25.0).norm(), 0.0);
  EXPECT_EQ(covered(25.0).norm(), 0.0);
}

TEST(Patches, WithoutFlowCarryNothing) {
  TurbulentZone zone = pinned_zone(1.0, 0.1, 60, 2);
  zone.velocity.head(20).setConstant(1e-7);
  const ZoneSpectra spectra(zone);
  EXPECT_EQ(spectra.idle(), 20);
  EXPECT_EQ(spectra.amplitude(3, 10.0), 0.0);
  EXPECT_GT(spectra.amplitude(30, 10.0), 0.0);
  zone.velocity.setZero();
  EXPECT_EQ(message_of([&] { (void)ZoneSpectra(zone); }),
            "zone 'span': the velocity is 0 all along; give its profile or leave the zone out");
}

TEST(Patches, AreEqualAndAsNarrowAsRequired) {
  const PatchGrid grid = cut_into_patches(1.0, 2.0, 0.3);
  ASSERT_EQ(grid.s.size(), 4);
  EXPECT_DOUBLE_EQ(grid.s[0], 1.125);
  EXPECT_DOUBLE_EQ(grid.ds.sum(), 1.0);
  EXPECT_EQ(cut_into_patches(0.0, 0.3, 0.1).s.size(), 3);
  EXPECT_EQ(message_of([] { (void)cut_into_patches(1.0, 1.0, 0.1); }),
            "a zone from s = 1 m to 1 m cannot be cut into patches of 0.1 m; give an end beyond its start "
            "and a width > 0");
}

TEST(Patches, RefuseWrongInput) {
  const TurbulentZone good = pinned_zone(1.0, 0.1, 60, 2);
  const auto message = [&](auto change) {
    TurbulentZone zone = good;
    change(zone);
    return message_of([&] { check(zone); });
  };
  EXPECT_EQ(message([](TurbulentZone&) {}), "");
  EXPECT_EQ(message([](TurbulentZone& z) { z.s.resize(0); }), "zone 'span' has no patches; cut it into some");
  EXPECT_EQ(message([](TurbulentZone& z) { z.id = 1u << 24; }),
            "zone 'span': its number 16777216 is too large; give one below 16777216");
  EXPECT_EQ(message([](TurbulentZone& z) { z.density.conservativeResize(3); }),
            "zone 'span': density, kg/m3, has 3 values for 60 patches; give one for each patch");
  EXPECT_EQ(message([](TurbulentZone& z) { z.velocity[0] = -1.0; }),
            "zone 'span': velocity, m/s, = -1 at s = 0.00833333 m makes no sense; give a number >= 0");
  EXPECT_EQ(message([](TurbulentZone& z) { z.diameter[0] = 0.0; }),
            "zone 'span': diameter, m, = 0 at s = 0.00833333 m makes no sense; give a number > 0");
  EXPECT_EQ(
      message([](TurbulentZone& z) { z.correlation_length = 0.0; }),
      "zone 'span': correlation length = 0 m makes no sense; give a number > 0, typically 2 to 4 diameters");
  EXPECT_EQ(message([](TurbulentZone& z) { z.running_velocity = 1.0; }),
            "zone 'span': a running velocity has no meaning with the scaling local; leave it out or ask for "
            "zone_mean");
  EXPECT_EQ(message([](TurbulentZone& z) { z.s[1] = z.s[0]; }),
            "zone 'span': the patches at s = 0.00833333 m and 0.00833333 m overlap; give midpoints in "
            "ascending order and "
            "widths that fit between them");
  EXPECT_EQ(message([](TurbulentZone& z) { z.correlation_length = 0.05; }),
            "zone 'span': a patch is 0.0166667 m wide, more than a fifth of the correlation length 0.05 m; "
            "cut the zone into "
            "patches of 0.01 m at most");
  EXPECT_EQ(message([](TurbulentZone& z) { z.axes.clear(); }),
            "zone 'span' has 0 axes of load; give 1 to 256");
  EXPECT_EQ(message([](TurbulentZone& z) { z.axes[0].shapes.conservativeResize(2, 5); }),
            "zone 'span': mode shapes of an axis have 2 modes and 5 patches, expected 2 and 60; give the "
            "same modes for each "
            "axis and a value for each patch");
  EXPECT_EQ(message([](TurbulentZone& z) { z.axes[0].shapes(0, 0) = std::nan(""); }),
            "zone 'span': mode shapes contain values that are no numbers");
  EXPECT_EQ(message([](TurbulentZone& z) { z.axes[0].weight = -1.0; }),
            "zone 'span': weight = -1 of an axis makes no sense; give a number >= 0");
  EXPECT_EQ(message_of([&] {
              check(std::vector{good, good});
            }),
            "zone 'span': another zone has the number 0 too, their loads would be the same; give each zone "
            "its own");
  TurbulentZone other = pinned_zone(1.0, 0.1, 60, 3);
  other.id = 1;
  other.name = "bend";
  EXPECT_EQ(message_of([&] {
              check(std::vector{good, other});
            }),
            "zone 'bend' has 3 modes, zone 'span' 2; give all the same modes");
  EXPECT_EQ(message_of([] { (void)CrossSpectrum(std::vector<TurbulentZone>{}); }),
            "a cross-spectrum of turbulence without a zone; give one at least");
}

} // namespace cross_spectrum_test
