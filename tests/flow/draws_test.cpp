// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_mode.hpp"
#include "flow/block_synthesis.hpp"
#include "flow/cross_spectrum.hpp"
#include "flow/draws.hpp"
#include "flow/welch.hpp"
#include "turbulent_zone.hpp"
#include <complex>
#include <gtest/gtest.h>

namespace draws_test {

using namespace fretwork;
using namespace fretwork::flow;

namespace {

DrawOptions options(double f_max, double block) {
  DrawOptions o;
  o.f_max = f_max;
  o.block_period = block;
  return o;
}

/// Flow of varying velocity, lift and drag.
TurbulentZone sheared_zone(int modes = 4) {
  TurbulentZone zone = pinned_zone(1.0, 0.1, 60, modes, 2);
  zone.velocity = 1.0 + zone.s.array();
  zone.axes[1].weight = 0.5;
  zone.axes[1].shapes *= -0.7;
  zone.spectrum = Cor2{};
  return zone;
}

/// Forces of constant spectral matrix on modes of their own.
MatrixLoad white_forces(const Eigen::MatrixXd& g) {
  const Eigen::MatrixXcd matrix = g.cast<std::complex<double>>();
  return {"white", 0, [matrix](double) { return matrix; }, Eigen::MatrixXd::Identity(g.rows(), g.rows())};
}

/// Relative standard deviation of the mean square of a mode's displacement over n draws of length T.
double mean_square_scatter(double damping, double omega, double duration, int draws) {
  return 1.0 / std::sqrt(damping * omega * duration * draws);
}

Eigen::MatrixXd samples(ForceDraw draw, std::int64_t first, Eigen::Index count) {
  Eigen::MatrixXd out(draw.modes(), count);
  draw.fill(first, out);
  return out;
}

} // namespace

TEST(Draw, OfALongerRunBeginsLikeThatOfAShorterOne) {
  ForceDraw a({sheared_zone()}, {}, options(50.0, 1.0)), b({sheared_zone()}, {}, options(50.0, 1.0));
  const Eigen::MatrixXd brief = draw_forces(a, 1.3), whole = draw_forces(b, 4.7);
  EXPECT_EQ(whole.leftCols(brief.cols()), brief); // to the last bit
  EXPECT_GE(static_cast<double>(brief.cols() - 1) * a.step(), 1.3);
}

TEST(Draw, IsTheSameInPiecesOfAnyLengthAndOrder) {
  ForceDraw draw({sheared_zone()}, {}, options(50.0, 1.0));
  const Eigen::MatrixXd whole = draw_forces(draw, 4.0);
  for (const std::int64_t first : {3000, 17, 900, 2500, 0})
    EXPECT_EQ(samples(ForceDraw({sheared_zone()}, {}, options(50.0, 1.0)), first, 333),
              whole.middleCols(first, 333));
  Eigen::MatrixXd piece(4, 100);
  for (const std::int64_t first : {3000, 17, 900}) {
    draw.fill(first, piece);
    EXPECT_EQ(piece, whole.middleCols(first, 100));
  }
}

TEST(Draw, IsPhysicallyTheSameForAnyBasis) {
  const TurbulentZone zone = sheared_zone(4);
  const Eigen::MatrixXd forces = samples(ForceDraw({zone}, {}, options(50.0, 1.0)), 0, 4000);
  TurbulentZone more = sheared_zone(11); // modes are added
  EXPECT_EQ(samples(ForceDraw({more}, {}, options(50.0, 1.0)), 0, 4000).topRows(4), forces);
  for (LoadAxis& axis : more.axes)
    axis.shapes.bottomRows(7).setZero(); // that the load does not reach
  const Eigen::MatrixXd with_idle = samples(ForceDraw({more}, {}, options(50.0, 1.0)), 0, 4000);
  EXPECT_EQ(with_idle.topRows(4), forces);
  EXPECT_EQ(with_idle.bottomRows(7).norm(), 0.0);
  TurbulentZone turned = zone; // another order and scale
  for (LoadAxis& axis : turned.axes)
    axis.shapes = (-4.0 * zone.axes[&axis - turned.axes.data()].shapes).colwise().reverse();
  EXPECT_EQ(samples(ForceDraw({turned}, {}, options(50.0, 1.0)), 0, 4000), -4.0 * forces.colwise().reverse());
}

TEST(Draw, KeepsItsLinesWhereTheHighestFrequencyRises) {
  // the force up to 50 Hz does not change: it is the draw to 80 Hz less that of 50 to 80 Hz
  DrawOptions high = options(80.0, 1.0), band = options(80.0, 1.0);
  band.f_min = 50.5;
  DrawOptions low = options(50.0, 1.0);
  low.samples_per_period = 32.0; // 80 . 20 = 50 . 32: the same samples
  const Eigen::MatrixXd difference = samples(ForceDraw({sheared_zone()}, {}, high), 0, 3000) -
                                     samples(ForceDraw({sheared_zone()}, {}, band), 0, 3000);
  const Eigen::MatrixXd direct = samples(ForceDraw({sheared_zone()}, {}, low), 0, 3000);
  constexpr double round_off = 1e-12;
  EXPECT_LT((difference - direct).norm(), round_off * direct.norm());
}

TEST(Draw, OfZonesIsTheSumInAnyOrder) {
  TurbulentZone first = sheared_zone(), second = sheared_zone();
  second.id = 5;
  const DrawOptions o = options(50.0, 1.0);
  const Eigen::MatrixXd sum =
      samples(ForceDraw({first}, {}, o), 0, 3000) + samples(ForceDraw({second}, {}, o), 0, 3000);
  constexpr double round_off = 1e-13;
  EXPECT_LT((samples(ForceDraw({second, first}, {}, o), 0, 3000) - sum).norm(), round_off * sum.norm());
}

TEST(Draw, DiffersBySeedDrawAndNumberOfTheZone) {
  const DrawOptions o = options(50.0, 1.0);
  const Eigen::MatrixXd forces = samples(ForceDraw({sheared_zone()}, {}, o), 0, 20000);
  const double scale = forces.row(0).squaredNorm();
  const auto correlation = [&](const TurbulentZone& zone, const DrawOptions& other) {
    return samples(ForceDraw({zone}, {}, other), 0, 20000).row(0).dot(forces.row(0)) / scale;
  };
  constexpr double tolerance =
      0.25; // 17 s of a force whose spectrum is some 10 Hz wide: three standard deviations
  DrawOptions seed = o, draw = o;
  seed.seed = 2;
  draw.draw = 1;
  TurbulentZone zone = sheared_zone();
  zone.id = 1;
  EXPECT_EQ(correlation(sheared_zone(), o), 1.0);
  EXPECT_NEAR(correlation(sheared_zone(), seed), 0.0, tolerance);
  EXPECT_NEAR(correlation(sheared_zone(), draw), 0.0, tolerance);
  EXPECT_NEAR(correlation(zone, o), 0.0, tolerance);
}

TEST(Draw, HasTheVarianceOfItsSpectrumAtEveryInstant) {
  for (const bool phase_only : {false, true}) {
    DrawOptions o = options(100.0, 1.0);
    o.phase_only = phase_only;
    ForceDraw draw({}, {white_forces(Eigen::MatrixXd::Constant(1, 1, 2.0))}, o);
    const std::int64_t hop = draw.hop(), fade = hop / 7;
    Eigen::MatrixXd forces(1, hop);
    double flat = 0.0, faded = 0.0, middle = 0.0;
    constexpr int hops = 4000;
    for (int b = 0; b < hops; ++b) {
      draw.fill(b * hop, forces);
      flat += forces.leftCols(hop - fade).squaredNorm() / static_cast<double>(hop - fade) / hops;
      faded += forces.rightCols(fade).squaredNorm() / static_cast<double>(fade) / hops;
      middle += forces.middleCols(hop - fade / 2 - 20, 40).squaredNorm() / 40.0 / hops;
    }
    // 100 lines of 2 N^2/Hz; standard deviations: squares independent over 1/200 s: 175, 25 and 4 of them a hop
    EXPECT_NEAR(flat / 200.0, 1.0, 3.0 * std::sqrt(2.0 / (175.0 * hops))) << phase_only;
    EXPECT_NEAR(faded / 200.0, 1.0, 3.0 * std::sqrt(2.0 / (25.0 * hops))) << phase_only;
    EXPECT_NEAR(middle / 200.0, 1.0, 3.0 * std::sqrt(2.0 / (4.0 * hops))) << phase_only;
  }
}

TEST(Draw, HasTheCrossSpectrumOfItsZones) {
  TurbulentZone zone = sheared_zone();
  zone.spectrum = white(3.0);
  ForceDraw draw({zone}, {}, options(60.0, 1.0));
  const Eigen::MatrixXd exact = 60.0 * CrossSpectrum({zone})(10.0); // 60 lines
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(4, 4), forces(4, draw.hop());
  constexpr int hops = 2000;
  for (int b = 0; b < hops; ++b) {
    draw.fill(b * draw.hop(), forces);
    mean += forces * forces.transpose() / static_cast<double>(draw.hop() * hops);
  }
  constexpr double tolerance = 0.01; // three standard deviations of 2000 hops of 105 independent squares
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      EXPECT_NEAR(mean(i, j), exact(i, j), tolerance * std::sqrt(exact(i, i) * exact(j, j)));
}

TEST(Draw, HasTheSpectrumThatItStates) {
  // mean spectrum of the faded blocks without approximation: sum of the lines' powers times |W(f - f_n)|^2/H, W of the fades
  constexpr double period = 1.0, fade = period / fades_per_block, hop = period - fade;
  static_assert(fades_per_block == 8, "the shares of lines below are those of such fades");
  const auto window = [&](double f) { // transform of w: even about the middle of the block
    constexpr int points = 4000;
    double sum = 0.0;
    for (int j = 0; j < points; ++j) {
      const double u = (j + 0.5) * period / points, edge = std::min(u, period - u);
      sum += (edge < fade ? std::sin(0.5 * pi * edge / fade) : 1.0) *
             std::cos(2.0 * pi * f * (u - 0.5 * period));
    }
    return sum * period / points;
  };
  const auto g = [](double f) { return std::pow(f, -3.5); };
  const auto stated_mean = [&](double f) { // flow/draws.hpp: G_drawn
    constexpr double df = 1.0 / period;
    return 6.0 / 7.0 * g(f) + (g(f + 2.0 * df) + g(std::abs(f - 2.0 * df))) / 14.0;
  };
  std::vector<double> squares; // |W|^2 at multiples of 1/2T
  for (int k = 0; k <= 400; ++k)
    squares.push_back(std::pow(window(0.5 * k / period), 2.0));
  constexpr double of_lines = 2e-4;
  for (const double f : {32.0, 32.5, 48.0, 64.5}) {
    double sum = 0.0;
    double leakage = 0.0; // of far lines: twice its mean at multiples of df, 0 midway
    for (int n = 4; n < 150; ++n) {
      sum += g(n / period) / period *
             squares[static_cast<std::size_t>(std::abs(std::lround(2.0 * (f - n))))] / hop;
      if (n < 0.5 * f && f == std::floor(f))
        leakage += 2.0 * 0.232 * g(n / period) / std::pow(f - n, 4.0);
    }
    EXPECT_NEAR(sum / (stated_mean(f) + leakage), 1.0, of_lines) << f;
    constexpr double stated = 4.5; // of G ~ f^-3.5
    EXPECT_NEAR(stated_mean(f) / g(f) - 1.0, stated / (f * f), 0.3 / (f * f));
  }
}

TEST(Draw, KeepsCoherenceAndDelay) {
  // two-sided S11 = 2 to 100 Hz, linear to 0.01 at 200 Hz, 0.01 to 300 Hz; S22 = 1; S12 = sqrt(0.8 S11) exp(2 pi i f tau)
  constexpr double tau = 0.025;
  const auto s11 = [](double f) {
    return f <= 100.0 ? 2.0 : f <= 200.0 ? 2.0 - 1.99 * (f - 100.0) / 100.0 : 0.01;
  };
  MatrixLoad load{"pair", 0, {}, Eigen::MatrixXd::Identity(2, 2)};
  load.spectrum = [&](double f) {
    Eigen::MatrixXcd g(2, 2);
    const std::complex<double> g12 = 2.0 * std::sqrt(0.8 * s11(f)) * std::polar(1.0, 2.0 * pi * f * tau);
    g << 2.0 * s11(f), g12, std::conj(g12), 2.0;
    return g;
  };
  ForceDraw draw({}, {load}, options(300.0, 4.0));
  WelchEstimate welch(2, draw.step(), static_cast<std::size_t>(2 * std::lround(1.0 / draw.step())));
  constexpr double duration = 400.0;
  Eigen::MatrixXd forces(2, draw.hop());
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  double delayed = 0.0, count = 0.0;
  const auto lag = static_cast<Eigen::Index>(std::lround(tau / draw.step()));
  for (std::int64_t first = 0; static_cast<double>(first) * draw.step() < duration; first += draw.hop()) {
    draw.fill(first, forces);
    for (Eigen::Index j = 0; j < forces.cols(); ++j)
      welch.add({forces.col(j).data(), 2});
    variance += forces.rowwise().squaredNorm();
    delayed += forces.row(0).head(forces.cols() - lag).dot(forces.row(1).tail(forces.cols() - lag)) *
               static_cast<double>(forces.cols()) / static_cast<double>(forces.cols() - lag);
    count += static_cast<double>(forces.cols());
  }
  // three standard deviations: sqrt(int G^2 df/T)/int G = 0.38 % and 0.29 %
  EXPECT_NEAR(variance[0] / count / 603.0, 1.0, 0.0115);
  EXPECT_NEAR(variance[1] / count / 600.0, 1.0, 0.0087);
  // E[x1(t) x2(t + tau)] = int |G12| df: signal 2 is signal 1 delayed by tau
  double covariance = 0.0;
  for (int n = 0; n < 3000; ++n)
    covariance += 0.1 * 2.0 * std::sqrt(0.8 * s11(0.1 * n + 0.05));
  constexpr double of_samples = 0.015; // three standard deviations, and tau rounded to a sample
  EXPECT_NEAR(delayed / count / covariance, 1.0, of_samples);
  const CrossPowerSpectrum cross = welch.cross(0, 1);
  double coherence = 0.0, lines = 0.0;
  std::complex<double> turned = 0.0;
  for (std::size_t k = 0; k < cross.frequency.size(); ++k)
    if (const double f = cross.frequency[k]; f > 5.0 && f < 95.0) {
      coherence += cross.coherence(k);
      turned += cross.xy[k] * std::polar(1.0, -2.0 * pi * f * tau);
      lines += 1.0;
    }
  constexpr double of_welch = 0.01; // delay against the segment's length: 1 - 2 tau/2 s; scatter 0.2 %
  EXPECT_NEAR(coherence / lines, 0.8, of_welch);
  EXPECT_NEAR(std::arg(turned), 0.0, of_welch);
}

TEST(Draw, GivesTwoModesTheirVariancesUnderWhiteNoise) {
  constexpr double mass = 0.4, w1 = 2.0 * pi * 36.0, w2 = 2.0 * pi * 40.0, xi1 = 0.01, xi2 = 0.02,
                   duration = 20.0;
  constexpr int draws = 200;
  Eigen::MatrixXd g(2, 2);
  g << 1e-3, 4e-4, 4e-4, 2e-3;
  double q1 = 0, q2 = 0, v1 = 0, v2 = 0, count = 0;
  for (int n = 0; n < draws; ++n) {
    DrawOptions o = options(160.0, 1.0);
    o.draw = static_cast<std::uint32_t>(n);
    ForceDraw draw({}, {white_forces(g)}, o);
    const double start = 3.0 / (xi1 * w1); // 5 % of the amplitude at the start is left
    const Eigen::MatrixXd f = draw_forces(draw, start + duration);
    ExactMode first(mass, w1, xi1, draw.step()), second(mass, w2, xi2, draw.step());
    for (Eigen::Index j = 1; j < f.cols(); ++j) {
      first.advance(f(0, j - 1), f(0, j));
      second.advance(f(1, j - 1), f(1, j));
      if (static_cast<double>(j) * draw.step() < start)
        continue;
      q1 += first.displacement() * first.displacement();
      q2 += second.displacement() * second.displacement();
      v1 += first.velocity() * first.velocity();
      v2 += second.velocity() * second.velocity();
      count += 1.0;
    }
  }
  const double of_first = 3.0 * mean_square_scatter(xi1, w1, duration, draws);
  const double of_second = 3.0 * mean_square_scatter(xi2, w2, duration, draws);
  constexpr double above_160_hertz = 0.004; // of the velocities
  EXPECT_NEAR(q1 / count / 6.750609e-9, 1.0, of_first);
  EXPECT_NEAR(q2 / count / 4.921194e-9, 1.0, of_second);
  EXPECT_NEAR(v1 / count / 3.453883e-4, 1.0, of_first + above_160_hertz);
  EXPECT_NEAR(v2 / count / 3.108495e-4, 1.0, of_second + above_160_hertz);
}

TEST(Draw, GivesModesThatRememberManyBlocksTheirVariance) {
  // damping ratio 0.001: the mode remembers 8 s, blocks last 2 s; its frequency lies midway between lines
  constexpr double f = 20.25, w = 2.0 * pi * f, xi = 0.001, duration = 12000.0, g = 1e-3;
  const DrawOptions o = options(50.0, 2.0);
  ForceDraw draw({}, {white_forces(Eigen::MatrixXd::Constant(1, 1, g))}, o);
  ExactMode mode(1.0, w, xi, draw.step());
  Eigen::MatrixXd forces(1, draw.hop() + 1);
  double sum = 0.0, count = 0.0;
  for (std::int64_t first = 0; static_cast<double>(first) * draw.step() < duration; first += draw.hop()) {
    draw.fill(first, forces);
    for (Eigen::Index j = 1; j < forces.cols(); ++j) {
      mode.advance(forces(0, j - 1), forces(0, j));
      if (static_cast<double>(first) * draw.step() > 40.0) {
        sum += mode.displacement() * mode.displacement();
        count += 1.0;
      }
    }
  }
  EXPECT_NEAR(sum / count / (g / (8.0 * xi * w * w * w)), 1.0, 3.0 * mean_square_scatter(xi, w, duration, 1));
}

TEST(Draw, RefusesWrongInput) {
  const auto message = [](auto change) {
    DrawOptions o = options(50.0, 1.0);
    change(o);
    return message_of([&] { ForceDraw({sheared_zone()}, {}, o); });
  };
  EXPECT_EQ(message([](DrawOptions&) {}), "");
  EXPECT_EQ(message([](DrawOptions& o) { o.f_min = 50.0; }),
            "random forces from 50 Hz to 50 Hz make no sense; give 0 <= f_min < f_max");
  EXPECT_EQ(message([](DrawOptions& o) { o.block_period = 0.1; }),
            "blocks of 0.1 s have fewer than 8 lines up to 50 Hz; give a longer block period");
  EXPECT_EQ(message([](DrawOptions& o) { o.samples_per_period = 2.0; }),
            "2 samples per period of the highest frequency do not follow it; give 4 at least, 20 for 0.8 % "
            "of its amplitude");
  EXPECT_EQ(message([](DrawOptions& o) { o.block_period = 1e6; }),
            "a block of 1e+06 s up to 50 Hz needs 1e+09 samples, more than 6.711e+07; lower f_max or the "
            "block period");
  const DrawOptions o = options(50.0, 1.0);
  EXPECT_EQ(message_of([&] { ForceDraw({}, {}, o); }),
            "a random draw without a load; give a zone of turbulence or a spectral matrix");
  const MatrixLoad load = white_forces(Eigen::MatrixXd::Identity(2, 2));
  EXPECT_EQ(
      message_of([&] {
        ForceDraw({}, {load, load}, o);
      }),
      "random load 'white': another load has the number 0 too, both would be the same; give each its own");
  MatrixLoad other = load;
  other.id = 3;
  EXPECT_EQ(message_of([&] { ForceDraw({sheared_zone()}, {other}, o); }),
            "random load 'white' has 2 modes, others have 4; give all the same modes, at least one");
  ForceDraw draw({sheared_zone()}, {}, o);
  EXPECT_EQ(message_of([&] { (void)draw_forces(draw, -1.0); }),
            "a draw of -1 s makes no sense; give a duration >= 0");
}

} // namespace draws_test
