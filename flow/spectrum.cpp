// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/spectrum.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::flow {
namespace {

constexpr std::array<std::string_view, std::variant_size_v<Spectrum>> names = {
    "cor_1", "cor_2", "cor_3", "cor_4", "axisa", "interior", "inlet", "two_phase", "table"};

constexpr double gravity = 9.81;            ///< m/s2
constexpr double reference_length = 1.0;    ///< L0, m: Axisa, Antunes and Villard 1990
constexpr double reference_diameter = 0.02; ///< D0, m: the same

/// y = y0 (x/x0)^-slope with y = level x^-slope.
PointSpectrum::Piece piece(double from, double level, double slope) {
  return {from, level * std::pow(from, -slope), slope};
}

double positive(double value, std::string_view what, std::string_view unit, std::string_view where) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(
        fmt::format("{}: {} = {:g}{} makes no sense; give a number > 0", where, what, value, unit));
  return value;
}

double void_fraction(const FlowState& state, std::string_view name, std::string_view where) {
  const double a = state.void_fraction;
  if (!(a > 0.0 && a < 1.0))
    throw core::Error(
        fmt::format("{}: the spectrum {} is one of two-phase flow, void fraction = {:g}; give one "
                    "between 0 and 1 or another spectrum",
                    where, name, a));
  return a;
}

/// Of two-phase flow, D_w = 0.1 D/sqrt(1 - a), m.
double bubble_length(const FlowState& state) {
  return 0.1 * state.diameter / std::sqrt(1.0 - state.void_fraction);
}

std::vector<PointSpectrum::Piece> pieces(const TableSpectrum& t, std::string_view where) {
  if (t.x.empty() || t.x.size() != t.y.size())
    throw core::Error(
        fmt::format("{}: the table of a spectrum has {} abscissas and {} values; give as many of both, "
                    "at least one",
                    where, t.x.size(), t.y.size()));
  std::vector<PointSpectrum::Piece> out;
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    positive(t.x[i], fmt::format("abscissa {} of the spectrum's table", i + 1), "", where);
    positive(t.y[i], fmt::format("value {} of the spectrum's table", i + 1), "", where);
    if (i > 0 && !(t.x[i] > t.x[i - 1]))
      throw core::Error(fmt::format("{}: abscissas of the spectrum's table are to ascend; {:g} follows {:g}",
                                    where, t.x[i], t.x[i - 1]));
    if (i + 1 < t.x.size())
      out.push_back({t.x[i], t.y[i], -std::log(t.y[i + 1] / t.y[i]) / std::log(t.x[i + 1] / t.x[i])});
  }
  if (out.empty())
    out.push_back({t.x[0], t.y[0], 0.0});
  return out;
}

} // namespace

std::string_view name_of(const Spectrum& spectrum) { return names[spectrum.index()]; }

double cor4_level(double a) {
  const double root = std::sqrt(a);
  const double exponent = root * (24.042 + a * (-50.421 + a * (63.483 - 33.284 * a))); // Code_Aster, CORR 4
  return std::pow(10.0, exponent) / 0.068;
}

/// Constants of Code_Aster's first spectrum of tube bundles.
PointSpectrum::Resonant PointSpectrum::resonant(double re) {
  double p =
      20.42 + re * (-14.00e-4 + re * (-9.81e-8 + re * (11.97e-12 + re * (-35.95e-17 + re * 34.69e-22))));
  if (re <= 1.5e4)
    p = 2.1808;
  else if (re > 5e4)
    p = 38.6075;
  const double eps = re <= 3.5e4 ? 0.7 : re <= 5.5e4 ? 0.3 : 0.6;
  return {1.3e-4 * p, eps, re <= 3.5e4 ? 3.0 : 4.0};
}

void PointSpectrum::set_level(double level, double time) {
  level_ = level;
  time_ = time;
}

PointSpectrum::PointSpectrum(const Spectrum& spectrum, const FlowState& state, double correlation_length,
                             bool two_sided, std::string_view where) {
  const double sides = two_sided ? 2.0 : 1.0;
  if (const auto* table = std::get_if<TableSpectrum>(&spectrum)) {
    shape_ = pieces(*table, where);
    low_ = table->x.front();
    high_ = table->x.back();
    if (table->absolute) {
      set_level(sides, 1.0);
      return;
    }
  }
  const double v = positive(state.velocity, "velocity", " m/s", where);
  const double rho = positive(state.density, "density", " kg/m3", where);
  const double d = positive(state.diameter, "diameter", " m", where);
  const double lambda = positive(correlation_length, "correlation length", " m", where);
  const double pressure = 0.5 * rho * v * v * d;         // N/m
  const double p2 = sides * pressure * pressure * d / v; // N^2/m^2/Hz
  const double equivalent = reference_length / reference_diameter * d / (2.0 * lambda);
  set_level(p2, d / v);
  const auto reference_equivalent = [&](double low, double middle, double high, double at_low,
                                        double at_high) {
    shape_ = Powers{piece(low, at_low, 0.5), piece(middle, at_high, 3.5)};
    low_ = low;
    high_ = high;
    level_ *= equivalent;
  };
  const double no_end = std::numeric_limits<double>::infinity();
  if (std::holds_alternative<Cor1>(spectrum)) {
    shape_ = resonant(v * d / positive(state.viscosity, "kinematic viscosity", " m2/s", where));
  } else if (const auto* c2 = std::get_if<Cor2>(&spectrum)) {
    shape_ =
        Rational{positive(c2->phi0, "phi0 of cor_2", "", where), positive(c2->f_c, "f_c of cor_2", "", where),
                 positive(c2->beta, "beta of cor_2", "", where)};
  } else if (const auto* c3 = std::get_if<Cor3>(&spectrum)) {
    const double at = positive(c3->f_c, "f_c of cor_3", "", where);
    shape_ = Powers{piece(at, positive(c3->phi_low, "phi_low of cor_3", "", where),
                          positive(c3->beta_low, "beta_low of cor_3", "", where)),
                    piece(at, positive(c3->phi_high, "phi_high of cor_3", "", where),
                          positive(c3->beta_high, "beta_high of cor_3", "", where))};
  } else if (const auto* c4 = std::get_if<Cor4>(&spectrum)) {
    const double a = void_fraction(state, "cor_4", where);
    const double flux = positive(state.mean_density, "mean density of the zone", " kg/m3", where) * v;
    shape_ = Powers{{1.0, cor4_level(a) * std::pow(flux, -positive(c4->gamma, "gamma of cor_4", "", where)),
                     positive(c4->beta, "beta of cor_4", "", where)}};
  } else if (std::holds_alternative<Axisa>(spectrum)) {
    reference_equivalent(0.01, 0.2, 3.0, 4e-4, 3e-6);
  } else if (std::holds_alternative<Interior>(spectrum)) {
    reference_equivalent(0.01, 0.5, no_end, 4e-4, 5e-5);
  } else if (std::holds_alternative<Inlet>(spectrum)) {
    reference_equivalent(0.01, 0.5, no_end, 1e-2, 1.25e-3);
  } else if (const auto* mixture = std::get_if<TwoPhaseSpectrum>(&spectrum)) {
    void_fraction(state, "two_phase", where);
    const double length = bubble_length(state);
    const double weight =
        positive(mixture->rho_liquid, "density of the liquid", " kg/m3", where) * gravity * length * d; // N/m
    set_level(sides * weight * weight * length / v, length / v);
    reference_equivalent(0.001, 0.06, 1.0, 10.0, 2e-3);
  }
}

double PointSpectrum::reduced(double x) const {
  if (const auto* r = std::get_if<Resonant>(&shape_)) {
    const double square = (x / 0.2) * (x / 0.2); // of f_r/0.2; y = (f_r/0.2)^(beta/2)
    const double y = r->beta == 4.0 ? square : std::sqrt(square * x / 0.2);
    return r->phi0 / ((1.0 - y) * (1.0 - y) + 4.0 * r->eps * r->eps * y);
  }
  if (const auto* r = std::get_if<Rational>(&shape_))
    return r->phi0 / (1.0 + std::pow(x / r->f_c, r->beta));
  const Powers& pieces = std::get<Powers>(shape_);
  const double within = std::max(x, low_); // held below the range
  auto p = pieces.begin();
  while (p + 1 != pieces.end() && within > (p + 1)->from)
    ++p;
  return p->level * std::pow(within / p->from, -p->slope);
}

double PointSpectrum::operator()(double f) const { return f > 0.0 ? level_ * reduced(f * time_) : 0.0; }

std::vector<double> PointSpectrum::breaks() const {
  std::vector<double> out;
  if (const auto* pieces = std::get_if<Powers>(&shape_))
    for (const Piece& p : *pieces)
      out.push_back(p.from / time_);
  if (std::isfinite(high_))
    out.push_back(highest());
  return out;
}

} // namespace fretwork::flow
