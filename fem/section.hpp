// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Cross-sections in their principal axes y, z: the constants of a beam's section and, where it has one, the
/// shape they follow from.
#pragma once
#include <optional>
#include <variant>

namespace fretwork::fem {

/// Sizes, m.
struct Pipe {
  double outer_diameter, thickness;
  bool operator==(const Pipe&) const = default;
};
struct Circle {
  double diameter;
  bool operator==(const Circle&) const = default;
};
struct Rectangle {
  double height_y, height_z;
  bool operator==(const Rectangle&) const = default;
};
/// The first: none, the constants are given by themselves.
using Shape = std::variant<std::monostate, Pipe, Circle, Rectangle>;

/// k of each direction: a shear force Q along y shears the section by Q / (k_y G A).
struct ShearCoefficients {
  double y, z; ///< > 0
  bool operator==(const ShearCoefficients&) const = default;
};
/// k of the shape, see shear_coefficients().
struct ShapeShear {
  bool operator==(const ShapeShear&) const = default;
};
/// The first: the section does not shear (Euler and Bernoulli).
using Shear = std::variant<std::monostate, ShapeShear, ShearCoefficients>;

struct Section {
  double area;             ///< m2, > 0
  double iy;               ///< m4, > 0: second moment about y (bending in the plane x-z)
  double iz;               ///< m4, > 0: about z (bending in the plane x-y)
  double torsion_constant; ///< m4, > 0
  double polar_inertia; ///< m4, >= 0: iy + iz for a solid section; rotary inertia about the axis is density
                        ///< times this
  Shape shape = {};
  Shear shear = {};
  bool rotary_inertia = false; ///< density times iy and iz resist the turning of the section in bending
  bool operator==(const Section&) const = default;
};

// Sections by shape; each throws core::Error for a size that makes no section.
[[nodiscard]] Section pipe_section(double outer_diameter, double thickness);
[[nodiscard]] Section circle_section(double diameter);
/// Torsion constant: Saint-Venant series of the rectangle.
[[nodiscard]] Section rectangle_section(double height_y, double height_z);

/// k of a section that shears, by the formulas of Cowper (The shear coefficient in Timoshenko's beam theory,
/// Journal of Applied Mechanics 33 (1966) 335-340) unless it is given; nu = Poisson's ratio:
///   pipe, m = inner / outer diameter, and circle, m = 0:
///     6 (1 + nu)(1 + m^2)^2 / ((7 + 6 nu)(1 + m^2)^2 + (20 + 12 nu) m^2)
///   rectangle: 10 (1 + nu) / (12 + 11 nu)
/// None where the section does not shear, or has no shape that a formula is for.
[[nodiscard]] std::optional<ShearCoefficients> shear_coefficients(const Section& section,
                                                                  double poisson_ratio);

/// Areas across a round section, m2.
struct Outline {
  double bore, displaced;
};
/// None where the section is neither a pipe nor a circle.
[[nodiscard]] std::optional<Outline> outline_of(const Section& section);

/// m, of a pipe or circle; none of other sections.
[[nodiscard]] std::optional<double> outer_radius(const Section& section);

/// The largest |N/A + My z/Iy - Mz y/Iz| on the outline of a pipe, circle or rectangle, Pa; none of a section without shape, whose
/// outline is unknown. Torsion and shear are not in it.
/// @param n, my, mz  N, N m
[[nodiscard]] std::optional<double> outer_fibre_stress(const Section& section, double n, double my,
                                                       double mz);

/// Whether one section can change into the other along a beam: of one shape, shearing alike, both with or both
/// without rotary inertia.
[[nodiscard]] bool same_kind(const Section& a, const Section& b);
/// The section at the share (0 to 1) of the way from a to b, of the same kind: sizes of the shape change linearly, the
/// constants follow; without a shape, the constants change linearly.
[[nodiscard]] Section between(const Section& a, const Section& b, double share);

} // namespace fretwork::fem
