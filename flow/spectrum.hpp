// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Spectra of the turbulent force per length on a tube in cross flow, N^2/m^2/Hz, one-sided in Hz: variance = int_0^inf G df.
///
///     G(f) = p^2 Phi(f_r),   p^2 = [(1/2) rho V^2 D]^2 D/V,   f_r = f D/V
///
/// V gap velocity normal to the tube, m/s; D outer diameter, m; rho density, kg/m3; Re = V D/nu; a void fraction.
///
/// name        Phi
/// cor_1       phi0/[(1 - y)^2 + 4 eps^2 y], y = (f_r/0.2)^(beta/2); phi0, eps and beta by Re
/// cor_2       phi0/(1 + (f_r/f_c)^beta)
/// cor_3       phi_low f_r^-beta_low up to f_c, phi_high f_r^-beta_high above
/// cor_4       phi0(a)/(f_r^beta (rho V)^gamma), rho the mean over the zone: two-phase flow
/// axisa       Phi_E: 4e-4 f_r^-0.5 (0.01..0.2), 3e-6 f_r^-3.5 (0.2..3)
/// interior    Phi_E: 4e-4 f_r^-0.5 (0.01..0.5), 5e-5 f_r^-3.5 above
/// inlet       Phi_E: 1e-2 f_r^-0.5 (0.01..0.5), 1.25e-3 f_r^-3.5 above
/// two_phase   Phi_E: 10 F^-0.5 (0.001..0.06), 2e-3 F^-3.5 (0.06..1), F = f D_w/V, D_w = 0.1 D/sqrt(1-a)
/// table       (f_r, Phi) or (f, G), log-log between the rows
///
/// Reference equivalent spectra Phi_E (lengths L0 = 1 m, D0 = 0.02 m) fix the product of level and correlation length lambda:
///     2 lambda G = p^2 Phi_E (L0/D0) D,   two_phase: p^2 = (rho_l g D_w D)^2 D_w/V
/// Below its range a spectrum is constant, above it continues with its last slope. At f = 0 it carries nothing.
///
/// Sources: cor_1 to cor_4: Code_Aster v17, DEFI_SPEC_TURB. axisa: F. Axisa, J. Antunes, B. Villard, J. Fluids Struct. 4 (1990) 321.
/// interior, inlet: C. Taylor, M. Pettigrew, 2000. two_phase: E. de Langre, B. Villard, J. Fluids Struct. 12 (1998) 1005.
#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fretwork::flow {

/// Liquid; 0 < Re. Its parameters jump at Re = 3.5e4 and 5.5e4.
struct Cor1 {};
/// All > 0.
struct Cor2 {
  double phi0 = 1.5e-3, f_c = 0.1, beta = 2.7;
};
/// All > 0.
struct Cor3 {
  double f_c = 0.2, phi_low = 5e-3, beta_low = 0.5, phi_high = 4e-5, beta_high = 3.5;
};
/// 0 < a < 1. phi0 has the unit (kg/m2/s)^gamma; not integrable down to f = 0.
struct Cor4 {
  double beta = 2.0, gamma = 4.0; ///< > 0
};
struct Axisa {};
struct Interior {};
struct Inlet {};
/// 0 < a < 1.
struct TwoPhaseSpectrum {
  double rho_liquid; ///< kg/m3, > 0
};
struct TableSpectrum {
  std::vector<double> x; ///< f_r or Hz, > 0, ascending
  std::vector<double> y; ///< Phi or N^2/m^2/Hz, > 0, as many
  bool absolute = false; ///< (f, G) in place of (f_r, Phi): the load acts whatever the velocity
};
using Spectrum =
    std::variant<Cor1, Cor2, Cor3, Cor4, Axisa, Interior, Inlet, TwoPhaseSpectrum, TableSpectrum>;

/// "cor_1", "cor_2", ...
[[nodiscard]] std::string_view name_of(const Spectrum& spectrum);

/// Flow at a point of the tube.
struct FlowState {
  double velocity;            ///< V, m/s, > 0
  double density;             ///< rho, kg/m3, > 0
  double void_fraction = 0.0; ///< a
  double viscosity = 0.0;     ///< nu, m2/s; > 0 for cor_1
  double diameter = 0.0;      ///< D, m, > 0
  double mean_density = 0.0;  ///< of the zone, kg/m3, > 0 for cor_4
};

/// phi0 of cor_4 by void fraction: log10(0.068 phi0) = 24.042 a^0.5 - 50.421 a^1.5 + 63.483 a^2.5 - 33.284 a^3.5
[[nodiscard]] double cor4_level(double void_fraction);

/// A spectrum at one point of the tube, ready for many frequencies.
class PointSpectrum {
public:
  /// @param correlation_length  lambda, m, > 0: reference equivalent spectra need it
  /// @param two_sided  the constants are those of a two-sided spectrum in Hz: G is twice as large
  /// @param where  begins the messages: "zone 'inlet'"
  /// @throws core::Error  a parameter out of its range
  PointSpectrum(const Spectrum& spectrum, const FlowState& state, double correlation_length, bool two_sided,
                std::string_view where);

  /// N^2/m^2/Hz. 0 at f = 0.  @param f  Hz, >= 0
  [[nodiscard]] double operator()(double f) const;
  /// Phi or Phi_E (of a table: y), without level and unit.  @param x  f_r, F, or Hz of an absolute table
  [[nodiscard]] double reduced(double x) const;
  /// True where f lies in the range of the spectrum.
  [[nodiscard]] bool covers(double f) const { return f * time_ >= low_ && f * time_ <= high_; }
  /// Range of the spectrum, Hz: 0 to infinity where the source gives none.
  [[nodiscard]] double lowest() const { return low_ / time_; }
  [[nodiscard]] double highest() const { return high_ / time_; }
  /// Frequencies at which the slope jumps, Hz.
  [[nodiscard]] std::vector<double> breaks() const;

  /// y = level (x/from)^-slope up to the `from` of the next piece; the first one from 0 on.
  struct Piece {
    double from, level, slope;
  };

private:
  struct Resonant { // cor_1
    double phi0, eps, beta;
  };
  struct Rational { // cor_2
    double phi0, f_c, beta;
  };
  using Powers = std::vector<Piece>;

  void set_level(double level, double time);
  [[nodiscard]] static Resonant resonant(double reynolds);

  std::variant<Resonant, Rational, Powers> shape_;
  double level_ = 0.0; ///< G/Phi
  double time_ = 0.0;  ///< x/f, s
  double low_ = 0.0, high_ = std::numeric_limits<double>::infinity();
};

} // namespace fretwork::flow
