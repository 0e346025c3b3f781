// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The flow along a tube: zones [s0, s1] that do not overlap, each with its tables over s, its fluid and its bundle.
/// Outside all zones there is no fluid and V = 0; where that is meant, a dry zone says so.
///
/// V is the gap (pitch) velocity. A velocity vector U(s) acts by its part across the tube,
///     U_n = U - (U.t) t,   V = |U_n|,   drag axis e_D = U_n/V,   lift axis e_L = t x e_D,
/// with the local tangent t in a bend. Where V < 1e-6 of the largest |U| or V of the profile the flow is along the tube
/// and nothing acts: V = 0, no axes. A scalar V(s) is normal to the tube already; its drag axis is the `direction` made
/// normal to t.
/// Density: rho of a single phase, or of the homogeneous mixture (void_fraction.hpp).
///
/// A table must reach both ends of its zone to within 0.5 % of the tube's length, and keeps its last value over what is
/// missing; a zone may reach beyond the tube by as much, and acts up to the tube's end.
#pragma once
#include "flow/added_mass.hpp"
#include "flow/table.hpp"
#include "flow/tube.hpp"
#include "flow/void_fraction.hpp"
#include <optional>
#include <variant>

namespace fretwork::flow {

struct ScalarVelocity {
  Table<double> speed; ///< m/s, V >= 0, normal to the tube
  std::optional<Vec3> direction =
      std::nullopt; ///< of drag, not along the tube; without one there are no axes
};
struct VectorVelocity {
  Table<Vec3> velocity; ///< m/s, U, global axes
};
using Velocity = std::variant<ScalarVelocity, VectorVelocity>;

enum class Phase { none, liquid, gas, two_phase };

struct SinglePhase {
  Phase phase = Phase::liquid; ///< liquid or gas
  Table<double> density;       ///< kg/m3, > 0
  double viscosity = 0.0;      ///< m2/s, kinematic, > 0
};
/// The void fraction itself.
struct GivenVoidFraction {
  Table<double> alpha; ///< 0 to 1
};
/// Steam quality: Feenstra's void fraction where the mass flux is given, else the homogeneous one.
struct Quality {
  Table<double> x;                                       ///< 0 to 1
  std::optional<Table<double>> mass_flux = std::nullopt; ///< kg/m2/s, G_p > 0, through the gaps
};
struct TwoPhase {
  Phases phases;
  std::variant<GivenVoidFraction, Quality> content;
};
using OuterFluid = std::variant<SinglePhase, TwoPhase>;

/// Where a zone is.
struct Extent {
  std::string name;
  double from = 0.0, to = 0.0; ///< m
};

struct Zone : Extent {
  Velocity velocity;
  OuterFluid fluid;
  Table<double> inner_density = Table<double>::constant(0.0); ///< kg/m3, >= 0, of the fluid inside the tube
  Bundle bundle = {};
  std::vector<double> connors_constants =
      {}; ///< K > 0; several are tabulated, none: by P/D (connors_constant.hpp)
};

/// The fluid at a point of the tube.
struct FlowPoint {
  int zone = -1; ///< -1: outside all zones, all else is 0
  Phase phase = Phase::none;
  double velocity = 0.0;                         ///< m/s, V
  Vec3 drag = Vec3::Zero(), lift = Vec3::Zero(); ///< e_D, e_L; 0 where V = 0 or the direction is not given
  double density = 0.0;                          ///< kg/m3, rho
  double viscosity = 0.0;                        ///< m2/s, nu, of the mixture in two-phase flow
  double void_fraction = 0.0;                    ///< alpha; 0 of a single phase
  double homogeneous_void_fraction = 0.0;        ///< of the steam quality; alpha where that is given itself
  double liquid_density = 0.0;                   ///< kg/m3, of the liquid phase; 0 in gas
  double inner_density = 0.0;                    ///< kg/m3
};

class Profile {
public:
  /// @param zones   in any order, which is kept   @param length  m, of the tube
  /// @param dry  zones that are declared to be without fluid
  /// @throws core::Error naming the zone: for zones that overlap, are empty or leave the tube, tables that end early or
  ///         hold values out of range, fluids and bundles without sense
  Profile(std::vector<Zone> zones, double length, std::vector<Extent> dry = {});

  [[nodiscard]] const std::vector<Zone>& zones() const { return zones_; }
  [[nodiscard]] const std::vector<Extent>& dry() const { return dry_; }
  /// Number of the zone at s, or -1. Where one zone ends and another begins: the one that begins.
  [[nodiscard]] int zone_at(double s) const;
  /// @throws core::Error where the drag direction is along the tube, or P/D <= 1.05
  [[nodiscard]] FlowPoint at(const TubePoint& point) const;
  /// Abscissae between which everything is smooth: ends of zones and rows of tables within them, ascending, each once.
  [[nodiscard]] std::vector<double> breaks() const;

private:
  std::vector<Zone> zones_;
  std::vector<Extent> dry_;
  double fastest_ = 0.0; ///< m/s, largest |U| or V
};

} // namespace fretwork::flow
