// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/depth.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include "wear/cross_section.hpp"
#include "wear/root.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::wear {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;

/// Where angles end, rad, from 0 on.
enum class AngleRange { zero_to_below_right, above_zero_to_below_right, above_zero_to_turn };

void check_angle(std::string_view where, std::string_view name, double value, AngleRange range) {
  const bool with_zero = range == AngleRange::zero_to_below_right,
             with_end = range == AngleRange::above_zero_to_turn;
  const double end = with_end ? 2.0 * pi : 0.5 * pi;
  const bool above = with_zero ? value >= 0.0 : value > 0.0, below = with_end ? value <= end : value < end;
  if (!above || !below) // not a number is neither
    throw core::Error(fmt::format("{}: {} = {:g} rad ({:g} degrees) makes no sense; give a number {} 0 and "
                                  "{} {:.4g} rad ({:g} degrees)",
                                  where, name, value, value / degree, with_zero ? ">=" : ">",
                                  with_end ? "<=" : "<", end, end / degree));
}

void check_inclination(std::string_view where, double inclination) {
  check_angle(where, "inclination", inclination, AngleRange::zero_to_below_right);
}

void check_tube(std::string_view where, double radius, double length) {
  check_positive(where, "tube radius", radius, "m");
  check_positive(where, "length of the support", length, "m");
}

void check_clearance(std::string_view where, double clearance) {
  check_not_negative(where, "clearance", clearance, "m");
  if (clearance == 0.0)
    throw core::Error(
        fmt::format("{}: clearance = 0 m leaves no direction of penetration; give a clearance > 0 "
                    "or take the geometry \"ring\", which wears all round",
                    where));
}

struct Checked {
  Form form;
  void operator()(const FlatBar& g) const {
    check_tube("flat bar", g.radius, g.length);
    check_inclination("flat bar", g.inclination);
  }
  void operator()(const DrilledHole& g) const {
    check_tube("drilled hole", g.radius, g.length);
    check_clearance("drilled hole", g.clearance);
    check_inclination("drilled hole", g.inclination);
  }
  void operator()(const Lands& g) const {
    check_tube("lands", g.radius, g.length);
    check_clearance("lands", g.clearance);
    check_angle("lands", "half-angle of a land", g.half_angle, AngleRange::above_zero_to_below_right);
    check_inclination("lands", g.inclination);
    if (form == Form::reference) {
      if (g.lands != 3 && g.lands != 4)
        throw core::Error(
            fmt::format("lands: the reference form knows 3 and 4 lands, not {}; give one of them or "
                        "take the exact form",
                        g.lands));
      return;
    }
    if (std::none_of(g.middles.begin(), g.middles.end(), [&](double middle) {
          return std::abs(std::remainder(middle, 2.0 * pi)) <= g.half_angle;
        }))
      throw core::Error(
          fmt::format("lands: none of the {} worn lands of half-angle {:g} degrees holds the "
                      "direction of penetration; give the angles of the lands from that direction, "
                      "one of them within the half-angle",
                      g.middles.size(), g.half_angle / degree));
  }
  void operator()(const Ring& g) const { check_tube("ring", g.radius, g.length); }
  void operator()(const TubeOnTube& g) const {
    check_positive("tube on tube", "tube radius", g.radius, "m");
    if (g.crossing == 0.0)
      throw core::Error(
          "tube on tube: crossing angle = 0 degrees: parallel tubes touch over a length that the "
          "formula does not know; give the angle between the tubes (inclination), > 0, or leave the contact "
          "out");
    check_angle("tube on tube", "crossing angle", g.crossing, AngleRange::above_zero_to_below_right);
  }
  void operator()(const TubeSector& g) const {
    check_tube("tube sector", g.radius, g.length);
    check_angle("tube sector", "angle", g.angle, AngleRange::above_zero_to_turn);
  }
  void operator()(const SupportSector& g) const {
    check_positive("support sector", "hole radius", g.hole_radius, "m");
    check_positive("support sector", "length of the support", g.length, "m");
    check_angle("support sector", "angle", g.angle, AngleRange::above_zero_to_turn);
  }
};

/// int_0^min(B, p/theta) A(p - theta s) ds, as in the header.
/// @param kinks  depths between which A is smooth, any order
double along_the_scar(const Function& area, double depth, double length, double inclination,
                      std::vector<double> kinks = {}) {
  if (!(inclination > 0.0))
    return length * area(depth);
  const double start = std::sqrt(std::max(0.0, depth - length * inclination)), end = std::sqrt(depth);
  const double touched = std::min(length, depth / inclination);
  // the mean by a variable x on 0..1: the ends may be so near that their difference has no digits
  const double width = touched * inclination / (start + end); // end - start
  const auto moment = [&](double x) {
    const double t = start + x * width;
    return t * area(std::min(t * t, depth));
  };
  std::sort(kinks.begin(), kinks.end());
  double sum = 0.0, before = 0.0;
  for (const double kink : kinks) {
    const double x = std::clamp((std::sqrt(std::max(0.0, kink)) - start) / width, before, 1.0);
    sum += integral(moment, before, x);
    before = x;
  }
  sum += integral(moment, before, 1.0);
  return 2.0 * touched / (start + end) * sum;
}

/// Angles of a land's edges from the direction of penetration.
struct Edges {
  double from, to;
};
Edges edges(const Lands& g, double middle) {
  const double at = std::remainder(middle, 2.0 * pi);
  return {at - g.half_angle, at + g.half_angle};
}

double area_of_lands(const Lands& g, double depth) {
  double sum = 0.0;
  for (const double middle : g.middles) {
    const auto [from, to] = edges(g, middle);
    sum += land_area(g.radius, g.clearance, depth, from, to);
  }
  return sum;
}

/// Depths at which the scar reaches edges of lands.
std::vector<double> kinks_of(const Lands& g) {
  std::vector<double> out;
  for (const double middle : g.middles)
    for (const double edge : {edges(g, middle).from, edges(g, middle).to})
      out.push_back(depth_of_half_angle(g.radius, g.clearance, edge));
  return out;
}

struct ExactVolume {
  double p;
  double operator()(const FlatBar& g) const {
    return along_the_scar([&](double u) { return segment_area(g.radius, u); }, p, g.length, g.inclination);
  }
  double operator()(const DrilledHole& g) const {
    return along_the_scar([&](double u) { return crescent_area(g.radius, g.clearance, u); }, p, g.length,
                          g.inclination);
  }
  double operator()(const Lands& g) const {
    return along_the_scar([&](double u) { return area_of_lands(g, u); }, p, g.length, g.inclination,
                          kinks_of(g));
  }
  double operator()(const Ring& g) const { return pi * g.length * p * (2.0 * g.radius - p); }
  double operator()(const TubeOnTube& g) const {
    return 8.0 * std::sqrt(2.0 * g.radius) * std::pow(p, 2.5) / (15.0 * g.crossing);
  }
  double operator()(const TubeSector& g) const { return 0.5 * g.length * g.angle * p * (2.0 * g.radius - p); }
  double operator()(const SupportSector& g) const {
    return 0.5 * g.length * g.angle * p * (2.0 * g.hole_radius + p);
  }
};

struct ReferenceVolume {
  double p;
  double operator()(const FlatBar& g) const {
    if (!(g.inclination > 0.0))
      return 4.0 / 3.0 * std::sqrt(2.0 * g.radius) * std::pow(p, 1.5) * g.length;
    const double beyond = std::max(0.0, p - g.length * g.inclination);
    return 8.0 * std::sqrt(2.0 * g.radius) * (std::pow(p, 2.5) - std::pow(beyond, 2.5)) /
           (15.0 * g.inclination);
  }
  double operator()(const DrilledHole& g) const {
    const double area = crescent_area(g.radius, g.clearance, p);
    return g.inclination > 0.0 ? 2.0 * p * area / (3.0 * g.inclination) : 2.0 * g.length * area;
  }
  double operator()(const Lands& g) const {
    const double area = crescent_area(g.radius, g.clearance, p) + p * p * std::tan(g.half_angle);
    const double share = g.lands == 4 ? 1.0 : 0.5;
    return share * (g.inclination > 0.0 ? p * area / (3.0 * g.inclination) : g.length * area);
  }
  double operator()(const Ring& g) const { return 2.0 * pi * g.length * g.radius * p; }
  template <class Other> double operator()(const Other& g) const { return ExactVolume{p}(g); }
};

double volume_unchecked(const Geometry& geometry, double p, Form form) {
  if (!(p > 0.0))
    return 0.0;
  return form == Form::exact ? std::visit(ExactVolume{p}, geometry)
                             : std::visit(ReferenceVolume{p}, geometry);
}

double tube_radius(const Geometry& geometry) {
  return std::visit(
      [](const auto& g) {
        if constexpr (requires { g.radius; })
          return g.radius;
        else
          return g.hole_radius;
      },
      geometry);
}

void check_depth(const Geometry& geometry, double depth, Form form) {
  check_not_negative(name_of(geometry), "depth", depth, "m");
  if (const double most = largest_depth(geometry, form); depth > most)
    throw core::Error(
        fmt::format("{}: depth = {:g} m is beyond what the geometry describes; give at most {:g} m",
                    name_of(geometry), depth, most));
}

} // namespace

std::string_view name_of(const Geometry& geometry) {
  static constexpr std::array<std::string_view, 7> names = {
      "flat_bar", "drilled_hole", "lands", "ring", "tube_on_tube", "tube_sector", "support_sector"};
  static_assert(std::variant_size_v<Geometry> == names.size());
  return names[geometry.index()];
}

void check(const Geometry& geometry, Form form) { std::visit(Checked{form}, geometry); }

double largest_depth(const Geometry& geometry, Form form) {
  const double radius = tube_radius(geometry);
  if (form == Form::exact)
    return radius;
  return std::visit(
      [=](const auto& g) {
        using G = std::decay_t<decltype(g)>;
        if constexpr (std::is_same_v<G, DrilledHole> || std::is_same_v<G, Lands>)
          return g.inclination > 0.0 ? std::min(radius, g.length * g.inclination) : radius;
        else
          return radius;
      },
      geometry);
}

double volume(const Geometry& geometry, double depth, Form form) {
  check(geometry, form);
  check_depth(geometry, depth, form);
  return volume_unchecked(geometry, depth, form);
}

std::optional<double> depth(const Geometry& geometry, double volume, Form form) {
  check(geometry, form);
  check_not_negative(name_of(geometry), "worn volume", volume, "m3");
  if (volume == 0.0)
    return 0.0;
  const double most = largest_depth(geometry, form);
  if (const double at_most = volume_unchecked(geometry, most, form); volume >= at_most)
    return volume > at_most ? std::nullopt : std::optional(most);
  double low = most; // V falls at least as p
  do
    low *= 1e-3;
  while (volume_unchecked(geometry, low, form) > volume);
  // ln V is nearly linear in ln p
  const double target = std::log(volume);
  return root_of_positive(
      [&](double p) {
        // as p -> 0 the volume may underflow
        return std::log(
                   std::max(volume_unchecked(geometry, p, form), std::numeric_limits<double>::denorm_min())) -
               target;
      },
      low, most);
}

Scar scar(const Geometry& geometry, double depth) {
  check(geometry);
  check_depth(geometry, depth, Form::exact);
  const auto length = [=](double whole, double inclination) {
    return inclination > 0.0 ? std::min(whole, depth / inclination) : whole;
  };
  const auto segment = [=](double radius, double along) {
    return Scar{2.0 * std::sqrt(depth * (2.0 * radius - depth)), along,
                2.0 * std::asin(std::sqrt(0.5 * depth / radius))};
  };
  struct Sizes {
    decltype(length)& along;
    decltype(segment)& flat;
    double p;
    Scar operator()(const FlatBar& g) const { return flat(g.radius, along(g.length, g.inclination)); }
    Scar operator()(const DrilledHole& g) const {
      const double half = crescent_half_angle(g.radius, g.clearance, p);
      return {2.0 * (g.radius + g.clearance) * half, along(g.length, g.inclination), half};
    }
    Scar operator()(const Lands& g) const {
      const double half = crescent_half_angle(g.radius, g.clearance, p);
      double widest = 0.0;
      for (const double middle : g.middles) {
        const auto [from, to] = edges(g, middle);
        widest = std::max(widest, std::min(to, half) - std::max(from, -half));
      }
      return {(g.radius + g.clearance) * widest, along(g.length, g.inclination), half};
    }
    Scar operator()(const Ring& g) const { return {2.0 * pi * g.radius, g.length, pi}; }
    Scar operator()(const TubeOnTube& g) const { return flat(g.radius, p / g.crossing); }
    Scar operator()(const TubeSector& g) const { return {g.radius * g.angle, g.length, 0.5 * g.angle}; }
    Scar operator()(const SupportSector& g) const {
      return {g.hole_radius * g.angle, g.length, 0.5 * g.angle};
    }
  };
  return std::visit(Sizes{length, segment, depth}, geometry);
}

void check(const Pairing& pairing) {
  if (const auto* shared = std::get_if<SharedScar>(&pairing))
    return check(shared->geometry, shared->form);
  const auto& pair = std::get<SectorPair>(pairing);
  check(Geometry(pair.tube));
  check(Geometry(pair.support));
}

std::optional<PairDepth> depths(const Pairing& pairing, double tube, double support) {
  if (const auto* shared = std::get_if<SharedScar>(&pairing)) {
    check_not_negative(name_of(shared->geometry), "worn volume of the tube", tube, "m3");
    check_not_negative(name_of(shared->geometry), "worn volume of the support", support, "m3");
    const double both = tube + support;
    const auto p = depth(shared->geometry, both, shared->form);
    if (!p)
      return std::nullopt;
    return both > 0.0 ? PairDepth{*p * (tube / both), *p * (support / both)} : PairDepth{0.0, 0.0};
  }
  const auto& pair = std::get<SectorPair>(pairing);
  const auto p_t = depth(pair.tube, tube), p_s = depth(pair.support, support);
  if (!p_t || !p_s)
    return std::nullopt;
  return PairDepth{*p_t, *p_s};
}

double largest_depth(const Pairing& pairing) {
  if (const auto* shared = std::get_if<SharedScar>(&pairing))
    return largest_depth(shared->geometry, shared->form);
  const auto& pair = std::get<SectorPair>(pairing);
  return std::min(pair.tube.radius, pair.support.hole_radius);
}

} // namespace fretwork::wear
