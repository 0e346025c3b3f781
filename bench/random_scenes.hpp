// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random scenes that no part of the program has been tuned for: bench/run accuracy. A scene follows from its kind, a seed and its number
/// alone, on every machine.
///
///     mass   a mass on springs in three directions, one contact
///     tube   a simply supported tube in its sine modes of two planes, 15 to 60, 1 to 20 contacts
///     mixed  a tube whose contacts have laws of their own in wider ranges, some at one node
///     pair   two such tubes, 1 to 3 contacts between them (rows B_1 - B_2) beside their supports
/// Common to all: w_c is 5 to 50 times the lowest mode (tubes: of one span); normal damping ratio 0 (two fifths) to 0.3, sometimes Hunt and
/// Crossley's; mu 0.1 to 1, in a quarter of the scenes with a static coefficient up to 1.6 times as large; K_T/K_N 0.01 to 1; C_T 0 (a
/// fifth), automatic or 0.05 to 1 of the critical damping of the mass that the contact feels; friction in the tangent plane, or restricted
/// to one direction. Of a quarter of masses and tubes the mass along x_loc is up to a thousand times that across; other tubes have no motion
/// along it. Contacts are open, touch, stand out of the middle or are pressed. Loads are harmonic, random, constant, or tables of 2 to 20
/// rows a period, at unequal distances, with lines between them.
#pragma once
#include "transient/scene/scene.hpp"
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace fretwork::bench {

enum class SceneKind { mass, tube, pair, mixed };
[[nodiscard]] std::string name_of(SceneKind kind);

/// Share of masses and tubes that are heavier along x_loc than across; the tubes have one mode along it.
inline constexpr double heavy_axes = 0.25;

struct RandomScene {
  SceneKind kind;
  std::string name, description;               ///< kind and number; what it is, one line
  transient::Scene scene;                      ///< its duration is 100 periods; bench_accuracy sets it
  double period = 0.0;                         ///< s, of the lowest mode (tubes: of a span)
  double gap = 0.0;                            ///< m, the scale of the clearances
  std::vector<Eigen::Index> first_modes = {0}; ///< of each structure, three at least
};
[[nodiscard]] RandomScene random_scene(SceneKind kind, std::uint64_t seed, int number);

/// Numbers for one scene, equal on all machines.
class Draw {
public:
  Draw(std::uint64_t seed, std::uint64_t kind, std::uint64_t number);
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] double logarithmic(double low, double high); ///< uniform in its logarithm
  [[nodiscard]] bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  [[nodiscard]] int integer(int low, int high); ///< both included
  [[nodiscard]] std::uint64_t seed();           ///< of a random load

private:
  std::mt19937_64 generator_;
};

/// The laws of the contacts of a scene, in ratios.
struct LawDraw {
  double normal_ratio, dissipation_number; ///< xi_N; d times the speed of impact, 0: the law of the reference
  double mu_static, mu_dynamic, stiffness_ratio;
  double tangential_ratio; ///< C_T over 2 sqrt(K_T m); 0: none; < 0: automatic
  contact::Vec2 along;
};
[[nodiscard]] LawDraw draw_laws(Draw& draw);
/// The mode whose stuck contact the automatic C_T damps critically (R5.06.03, section 6.5).
struct DampedMode {
  double stiffness, mass, ratio; ///< N/m, kg
};
/// @param normal_stiffness  N/m   @param mass  kg, felt by the contact   @param speed  m/s, of a typical impact
void set_laws(contact::Support& support, const LawDraw& laws, double normal_stiffness, double mass,
              const DampedMode& mode, double speed);
[[nodiscard]] std::string described(const LawDraw& laws);

/// An obstacle and where the node at rest is in it.
struct Place {
  contact::Obstacle obstacle;
  core::Vec3 rest;
  std::string name;
};
/// Of one node. @param gap  m   @param overlap  m: how deep a pressed node is in it   @param tube  with the shapes of supports of tubes
[[nodiscard]] Place draw_place(Draw& draw, double gap, double overlap, bool tube);

/// Periods of the lowest mode (tubes: of a span) that a scene can last.
inline constexpr double most_periods = 4000.0;

/// A load per unit of stiffness, m: harmonic, a table or noise in a band, such that an oscillator of a frequency (Hz) and damping ratio
/// moves by some `amplitude` (rms, m). `about`: the frequency (Hz) about which it is, at most twice that of the scene's period.
[[nodiscard]] signals::TimeFunction draw_load(Draw& draw, double frequency, double ratio, double about,
                                              double amplitude);
/// In descriptions: h, r, t or c.
[[nodiscard]] char letter_of(const signals::TimeFunction& load);

/// Of a mass, of one tube or of two (random_tubes.cpp).
[[nodiscard]] RandomScene random_mass(Draw& draw);
[[nodiscard]] RandomScene random_tube(Draw& draw, bool mixed);
[[nodiscard]] RandomScene random_pair(Draw& draw);

} // namespace fretwork::bench
