// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/response.hpp"
#include "turbulent_zone.hpp"
#include <gtest/gtest.h>

namespace response_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

constexpr double seven_digits = 5e-7; ///< relative: of the reference values

LoadSpectrum constant(const Eigen::MatrixXd& g) {
  return {[g](double, Eigen::MatrixXd& out) { out = g; }, {}, {}};
}

LinearModes two_modes() {
  return {Eigen::Vector2d(0.4, 0.4), 2.0 * pi * Eigen::Vector2d(36.0, 40.0), Eigen::Vector2d(0.01, 0.02)};
}

Eigen::MatrixXd two_by_two(double a, double b, double c) {
  Eigen::MatrixXd g(2, 2);
  g << a, b, b, c;
  return g;
}

/// Chain of eight masses of 10 kg between nine springs of 1e5 N/m, shapes in columns normalised to the mass.
struct Chain {
  Eigen::MatrixXd shapes = Eigen::MatrixXd(8, 8);
  LinearModes modes{Eigen::VectorXd::Ones(8), Eigen::VectorXd(8), Eigen::VectorXd(8)};
  Chain() {
    modes.damping << .00868241, .01710101, .025, .03213938, .03830222, .04331851, .04698464, .0492404;
    for (int n = 1; n <= 8; ++n) {
      modes.omega[n - 1] = 200.0 * std::sin(n * pi / 18.0);
      for (int k = 1; k <= 8; ++k)
        shapes(k - 1, n - 1) = std::sqrt(2.0 / 9.0 / 10.0) * std::sin(n * k * pi / 9.0);
    }
  }
};

/// Clamped tube of 1 m under cor_1, zone_mean, velocity 4 s (1 - s), running velocity 1 m/s, Re 4e4.
struct ClampedTube {
  TurbulentZone zone = pinned_zone(1.0, 0.136, 8000, 1);
  static double shape(double s) {
    const double k = 4.730040744862704, c = (std::cosh(k) - std::cos(k)) / (std::sinh(k) - std::sin(k));
    const auto y = [&](double x) {
      return std::cosh(k * x) - std::cos(k * x) - c * (std::sinh(k * x) - std::sin(k * x));
    };
    return y(s) / y(0.5);
  }
  ClampedTube() {
    for (Eigen::Index i = 0; i < zone.patches(); ++i)
      zone.axes[0].shapes(0, i) = shape(zone.s[i]);
    zone.velocity = 4.0 * zone.s.array() * (1.0 - zone.s.array());
    zone.density.setConstant(1000.0);
    zone.diameter.setConstant(0.04);
    zone.viscosity.setConstant(1e-6);
    zone.scaling = Scaling::zone_mean;
    zone.running_velocity = 1.0;
  }
  double rms(const Spectrum& spectrum) {
    zone.spectrum = spectrum;
    const LinearModes mode{Eigen::VectorXd::Constant(1, 5.795132 * 0.396478),
                           Eigen::VectorXd::Constant(1, 2.0 * pi * 194.74),
                           Eigen::VectorXd::Constant(1, 0.0015)};
    return LinearResponse(mode, load_spectrum({zone}, 1.0, 500.0), 1.0, 500.0)
        .at(Eigen::VectorXd::Constant(1, shape(0.23)))
        .rms();
  }
};

} // namespace

TEST(LinearResponse, HasTheClosedFormsUnderWhiteNoise) {
  const LinearResponse r(two_modes(), constant(two_by_two(1e-3, 4e-4, 2e-3)), 0.0, 1e5);
  constexpr double of_the_end = 2e-5; // of velocities 4 xi f/(pi 1e5 Hz) lies above 1e5 Hz: 1e-5
  EXPECT_NEAR(r.moment(0)(0, 0) / 6.750609e-9, 1.0, seven_digits);
  EXPECT_NEAR(r.moment(0)(1, 1) / 4.921194e-9, 1.0, seven_digits);
  EXPECT_NEAR(r.moment(0)(0, 1) / 1.170296e-10, 1.0, seven_digits);
  EXPECT_NEAR(r.moment(2)(0, 0) / 3.453883e-4, 1.0, of_the_end);
  EXPECT_NEAR(r.moment(2)(1, 1) / 3.108495e-4, 1.0, of_the_end);
  EXPECT_EQ(r.moment(0)(0, 1), r.moment(0)(1, 0));
}

TEST(LinearResponse, OfTheChainHasTheReferenceVariance) {
  const Chain chain;
  const Eigen::VectorXd fourth = chain.shapes.row(3).transpose();
  const SpectralMoments m =
      LinearResponse(chain.modes, constant(2.0 * fourth * fourth.transpose()), 3.0, 13.0).at(fourth);
  EXPECT_NEAR(m.L0 / 3.169462e-7, 1.0, seven_digits);
  constexpr double printed = 1e-6; // six digits
  EXPECT_NEAR(m.up_crossings() / 5.51324, 1.0, printed);
}

TEST(LinearResponse, OfATubeUnderCor1HasTheReferenceValue) {
  constexpr double printed =
      2e-6; // relative: frequency and the integral of phi^2 are given by five and six digits
  EXPECT_NEAR(ClampedTube().rms(Cor1{}) / 3.677977e-8, 1.0, printed);
  EXPECT_NEAR(ClampedTube().rms(Cor2{}) / 2.135301e-8, 1.0, printed);
}

TEST(LinearResponse, DoesNotDependOnTheScaleOfTheShapes) {
  TurbulentZone zone = pinned_zone(1.0, 0.1, 60, 2);
  zone.velocity = 1.0 + zone.s.array();
  const auto rms = [&](const Eigen::Vector2d& scale) {
    TurbulentZone scaled = zone;
    scaled.axes[0].shapes = scale.asDiagonal() * zone.axes[0].shapes;
    LinearModes m = two_modes();
    m.mass.array() *= scale.array().square();
    const LinearResponse r(m, load_spectrum({scaled}, 1.0, 200.0), 1.0, 200.0);
    return r.at(scale.cwiseProduct(Eigen::Vector2d(0.7, -0.2))).rms();
  };
  constexpr double round_off = 1e-12;
  EXPECT_NEAR(rms({3.0, -200.0}) / rms({1.0, 1.0}), 1.0, round_off);
}

TEST(LinearResponse, IgnoresModesThatTheLoadDoesNotReach) {
  const LinearModes two = two_modes();
  LinearModes three = two;
  three.mass = Eigen::Vector3d(0.4, 0.4, 1.0);
  three.omega = Eigen::Vector3d(two.omega[0], two.omega[1], 300.0);
  three.damping = Eigen::Vector3d(0.01, 0.02, 0.001);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(3, 3);
  g.topLeftCorner(2, 2) = two_by_two(1e-3, 4e-4, 2e-3);
  const LinearResponse a(two, constant(g.topLeftCorner(2, 2)), 0.0, 100.0), b(three, constant(g), 0.0, 100.0);
  constexpr double of_panels = 1e-9; // other panels
  EXPECT_NEAR(b.at(Eigen::Vector3d(1.0, 0.5, 2.0)).L0 / a.at(Eigen::Vector2d(1.0, 0.5)).L0, 1.0, of_panels);
}

TEST(LinearResponse, IsThatOfTheImaginaryPartToo) {
  // the second force is the first one delayed by tau: coordinates q(t) and q(t - tau) of two equal modes
  constexpr double tau = 0.004, xi = 0.01, w = 2.0 * pi * 36.0;
  const LinearModes m{Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(w, w), Eigen::Vector2d(xi, xi)};
  MatrixLoad load{"pair", 0, {}, Eigen::MatrixXd::Identity(2, 2)};
  load.spectrum = [](double f) {
    Eigen::MatrixXcd g(2, 2);
    const std::complex<double> turned = std::polar(1.0, 2.0 * pi * f * tau);
    g << 1.0, turned, std::conj(turned), 1.0;
    return g;
  };
  const LinearResponse r(m, load_spectrum(load), 0.0, 2000.0);
  const double damped = w * std::sqrt(1.0 - xi * xi);
  const double correlation =
      std::exp(-xi * w * tau) * (std::cos(damped * tau) + xi * w / damped * std::sin(damped * tau));
  constexpr double of_the_end = 1e-6; // above 2000 Hz
  EXPECT_NEAR(r.moment(0)(0, 1) / r.moment(0)(0, 0), correlation, of_the_end);
}

TEST(LinearResponse, IsThatOfASpectrumWithSteps) {
  // G = 1 from 20 to 50 Hz only: the same with the steps as breaks of a wider range as with a narrower range
  const LinearModes m = two_modes();
  const Eigen::MatrixXd one = two_by_two(1.0, 0.0, 1.0), nothing = Eigen::MatrixXd::Zero(2, 2);
  LoadSpectrum band{
      [&](double f, Eigen::MatrixXd& g) { g = f > 20.0 && f < 50.0 ? one : nothing; }, {}, {20.0, 50.0}};
  const LinearResponse wide(m, band, 0.0, 500.0), narrow(m, constant(one), 20.0, 50.0);
  constexpr double of_panels = 1e-9;
  EXPECT_NEAR(wide.moment(0)(0, 0) / narrow.moment(0)(0, 0), 1.0, of_panels);
}

TEST(SpectralMoments, OfANarrowBandAreThoseOfASine) {
  const SpectralMoments m{4.0, 4.0 * 50.0, 4.0 * 2500.0, 4.0 * 6.25e6};
  EXPECT_DOUBLE_EQ(m.rms(), 2.0);
  EXPECT_DOUBLE_EQ(m.rms_velocity(), 100.0);
  EXPECT_DOUBLE_EQ(m.up_crossings(), 50.0 / (2.0 * pi));
  EXPECT_DOUBLE_EQ(m.irregularity(), 1.0);
  EXPECT_EQ(SpectralMoments{}.up_crossings(), 0.0);
  EXPECT_EQ(SpectralMoments{}.maximum(10.0, 0.5), 0.0);
}

TEST(SpectralMoments, GiveTheMaximumOfVanmarcke) {
  const SpectralMoments m{1.0, 90.0, 1e4, 2e8}; // 15.9 Hz, d = sqrt(0.19)
  const double n = 10.0 * 100.0 / (2.0 * pi * std::log(2.0)), d = std::sqrt(0.19);
  const double peak = std::sqrt(
      2.0 * std::log(2.0 * n * (1.0 - std::exp(-std::pow(d, 1.2) * std::sqrt(pi * std::log(2.0 * n))))));
  constexpr double round_off = 1e-14;
  EXPECT_NEAR(m.maximum(10.0, 0.5).value(), peak, round_off);
  EXPECT_GT(m.maximum(10.0, 0.9).value(), peak);
  EXPECT_GT(m.maximum(20.0, 0.5).value(), peak);
  EXPECT_FALSE(m.maximum(0.01, 0.5).has_value()); // less than one up-crossing
  EXPECT_EQ(
      message_of([&] { (void)m.maximum(10.0, 1.0); }),
      "no maximum over 10 s at a probability of 1; give a duration > 0 and a probability between 0 and 1");
}

TEST(LinearResponse, KnowsWhatLiesOutsideTheRangeOfTheSpectrum) {
  TurbulentZone zone = pinned_zone(1.0, 0.1, 60, 2);
  zone.spectrum = TableSpectrum{{1.0, 38.0}, {1.0, 1.0}, true}; // modes at 36 and 40 Hz
  const Eigen::MatrixXd shapes = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::VectorXd share = share_outside(two_modes(), {zone}, 1.0, 200.0, shapes);
  const double g = CrossSpectrum({zone})(10.0)(0, 0);
  const LinearModes m = two_modes();
  const double below = LinearResponse(m, constant(two_by_two(g, 0, g)), 1.0, 38.0).moment(0)(0, 0);
  const double all = LinearResponse(m, constant(two_by_two(g, 0, g)), 1.0, 200.0).moment(0)(0, 0);
  constexpr double of_panels = 1e-9;
  EXPECT_NEAR(share[0], 1.0 - below / all, of_panels);
  EXPECT_GT(share[1], 0.8);
  EXPECT_EQ(share_outside(m, {zone}, 1.0, 200.0, Eigen::MatrixXd::Zero(1, 2))[0], 0.0);
}

TEST(LinearResponse, RefusesWrongInput) {
  const auto message = [](auto change, double low = 0.0, double high = 100.0) {
    LinearModes m = two_modes();
    change(m);
    return message_of([&] { LinearResponse(m, constant(two_by_two(1, 0, 1)), low, high); });
  };
  const auto nothing = [](LinearModes&) {};
  EXPECT_EQ(message(nothing), "");
  EXPECT_EQ(message(nothing, 5.0, 5.0),
            "a linear response from 5 Hz to 5 Hz makes no sense; give 0 <= low < high");
  EXPECT_EQ(message([](LinearModes& m) { m.mass.conservativeResize(1); }),
            "modes of a linear response have 1 masses, 2 frequencies and 2 damping ratios; give as many of "
            "all, at least one");
  EXPECT_EQ(message([](LinearModes& m) { m.mass[1] = 0.0; }),
            "mode 2: modal mass = 0 makes no sense; give a number > 0");
  EXPECT_EQ(message([](LinearModes& m) { m.omega[1] = -1.0; }),
            "mode 2: -1 rad/s makes no sense; give a number >= 0");
  EXPECT_EQ(message([](LinearModes& m) { m.damping[0] = 0.0; }),
            "mode 1: a damping ratio of 0 gives no stationary response; give one between 0 and 1");
  const auto rigid = [](LinearModes& m) { m.omega[0] = 0.0; };
  EXPECT_EQ(message(rigid),
            "mode 1 is a rigid motion, whose response has no end towards 0 Hz; begin above 0 Hz");
  EXPECT_EQ(message(rigid, 1.0), "");
}

} // namespace response_test
