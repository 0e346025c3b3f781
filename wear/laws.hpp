// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Worn volume of one body against time, from the work rate W: the mean over time of F_N |v_T| while the contact
/// slides (W, not multiplied by the friction coefficient).
///
///     archard    V = K W t
///     edf_mz     V = S t + (V0 - S)(1 - exp(-n t))/n,   V0 = A W^b,   for S <= V0
///     kwu_epri   V = K I W t,   I = Sg^2/(Sg + Si),                   for Si >= Sg   (kwu_epri.hpp)
///
/// Operating states j, each for a share a_j of the time: archard W = sum a_j W_j, edf_mz V0 = sum a_j V0_j on one
/// clock, kwu_epri I W = sum a_j I_j W_j. Work rates of random draws are averaged first, wear being the sum over
/// time of what each moment wears.
/// All are V = S t + (V0 - S)(1 - exp(-n t))/n, archard and kwu_epri with S = V0 and n = 0.
/// Outside its condition a law says nothing: that is returned as data, and nothing is put in its place.
/// Sources: J. F. Archard, J. Appl. Phys. 24 (1953) 981; edf_mz and kwu_epri with their constants as Code_Aster 17,
/// POST_USURE (which permutes the four of edf_mz where they come from its own bank; here they are as written).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace fretwork::wear {

inline constexpr double year = 31536000.0; ///< s, 365 days

struct Archard {
  double coefficient; ///< K, m2/N, >= 0 (0: a body that does not wear)
};
/// The constants are Code_Aster's.
struct EdfMz {
  double a = 1e-13;    ///< A, m3/s/W^b, > 0
  double b = 1.2;      ///< > 0
  double n = 2.44e-8;  ///< 1/s, > 0
  double s = 1.14e-16; ///< S, m3/s, >= 0
};
struct KwuEpri {
  double coefficient; ///< K, m2/N, >= 0
};
using Law = std::variant<Archard, EdfMz, KwuEpri>;

/// "archard", "edf_mz", "kwu_epri".
[[nodiscard]] std::string_view name_of(const Law& law);

/// What kwu_epri takes from the forces and speeds of a contact: kwu_epri.hpp.
struct ImpactSliding {
  double impact;  ///< Si, >= 0
  double sliding; ///< Sg, >= 0
};

struct OperatingState {
  double share;                              ///< a_j of the time, >= 0; the shares sum to 1
  double work_rate;                          ///< W, >= 0
  std::optional<ImpactSliding> indices = {}; ///< for kwu_epri
};

/// V(t) of one body.
struct WornVolume {
  double initial_rate = 0.0; ///< V0, m3/s
  double final_rate = 0.0;   ///< S, m3/s, <= V0
  double decay = 0.0;        ///< n, 1/s; 0: the rate stays V0

  /// m3 after t (s, >= 0).
  [[nodiscard]] double at(double time) const;
  /// s until a volume (m3, >= 0) is worn; nothing: never.
  [[nodiscard]] std::optional<double> time_of(double volume) const;
};

/// Of a body that its law has worn for `age` seconds (0: not this law), to the volume `before`.
struct AgedVolume {
  WornVolume law;
  double age = 0.0, before = 0.0; ///< s, m3
  /// m3 a time (s, >= 0) later.
  [[nodiscard]] double at(double time) const { return before + (law.at(age + time) - law.at(age)); }
  /// s until a volume (m3) is worn; nothing: never.
  [[nodiscard]] std::optional<double> time_of(double volume) const;
};

/// The condition of a law that does not hold: `value` is below `least`.
struct OutsideLaw {
  std::string law, quantity; ///< "edf_mz", "V0"
  double value, least;       ///< m3/s; without unit for kwu_epri
  std::size_t state = 0;     ///< kwu_epri: the operating state, from 0
  /// One sentence with the condition, the values and the cure.
  std::string text;
};

/// Either the worn volume or why the law does not apply.
struct LawResult {
  std::optional<WornVolume> volume;
  std::optional<OutsideLaw> outside;
};

/// @throws core::Error for a constant out of range
void check(const Law& law);
/// @throws core::Error for no state, a share or a work rate out of range, or shares that do not sum to 1 (1e-9)
void check(std::span<const OperatingState> states);

/// @throws core::Error as `check`, and for kwu_epri without indices
[[nodiscard]] LawResult worn_volume(const Law& law, std::span<const OperatingState> states);
/// One state for all the time. @param work_rate  W, >= 0
[[nodiscard]] LawResult worn_volume(const Law& law, double work_rate);

/// edf_mz applies from this work rate on, W: (S/A)^(1/b).
[[nodiscard]] double least_work_rate(const EdfMz& law);

} // namespace fretwork::wear
