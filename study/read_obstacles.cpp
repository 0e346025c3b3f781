// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support_shapes.hpp"
#include "core/error.hpp"
#include "study/contact_readers.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::study {
namespace {

using contact::PlaneAxis;

const Choices<ObstacleKind> obstacles{{{"circle", ObstacleKind::circle},
                                       {"plane_y", ObstacleKind::plane_y},
                                       {"plane_z", ObstacleKind::plane_z},
                                       {"stop_y", ObstacleKind::stop_y},
                                       {"stop_z", ObstacleKind::stop_z},
                                       {"circle_inside", ObstacleKind::circle_inside},
                                       {"profile", ObstacleKind::profile},
                                       {"ellipse", ObstacleKind::ellipse},
                                       {"drilled", ObstacleKind::drilled},
                                       {"broached", ObstacleKind::broached},
                                       {"egg_crate", ObstacleKind::egg_crate},
                                       {"bars_y", ObstacleKind::bars_y},
                                       {"bars_z", ObstacleKind::bars_z}}};

/// The keys of an obstacle fixed in space: all others of its kind are refused.
std::vector<std::string> keys_of(ObstacleKind kind) {
  switch (kind) {
  case ObstacleKind::circle:
  case ObstacleKind::plane_y:
  case ObstacleKind::plane_z:
  case ObstacleKind::stop_y:
  case ObstacleKind::stop_z:
    return {"gap"};
  case ObstacleKind::circle_inside:
    return {};
  case ObstacleKind::profile:
    return {"profile"};
  case ObstacleKind::ellipse:
    return {"tube_radius", "semi_axes"};
  case ObstacleKind::drilled:
    return {"tube_radius", "hole_radius", "clearance"};
  case ObstacleKind::broached:
    return {"tube_radius", "land_radius", "lobe_radius", "lands", "land_angle"};
  case ObstacleKind::egg_crate:
    return {"tube_radius", "half_widths"};
  case ObstacleKind::bars_y:
  case ObstacleKind::bars_z:
    return {"tube_radius", "bars"};
  }
  return {};
}

const std::vector<std::string> size_keys{"gap",        "profile",     "tube_radius", "hole_radius",
                                         "clearance",  "land_radius", "lobe_radius", "lands",
                                         "land_angle", "half_widths", "bars",        "semi_axes"};

void refuse_foreign_sizes(const TableReader& table, ObstacleKind kind) {
  const auto own = keys_of(kind);
  for (const std::string& key : size_keys)
    if (table.has(key) && std::find(own.begin(), own.end(), key) == own.end())
      table.fail_at(key,
                    fmt::format("does not belong to obstacle = \"{}\", whose sizes are {}; leave it out, "
                                "or take the obstacle that has it",
                                name_of(kind), fmt::join(own, ", ")));
}

/// A shape made in contact/: its own message, after the key that is the cause.
template <class Make> auto made(const TableReader& table, const char* key, Make make) {
  try {
    return make();
  } catch (const core::Error& error) {
    table.fail_at(key, error.what());
  }
}

contact::Profile read_profile(const TableReader& table) {
  const std::string expected = "polar points [[degrees, m], ...] of a hole round the node";
  const Array& rows = to_array(table.required("profile", expected), table.path("profile"), expected);
  std::vector<contact::PolarPoint> points;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto pair = to_numbers(rows[i], table.path("profile") + "[" + std::to_string(i) + "]", 2, {});
    points.push_back({pair[0] * degree, pair[1]});
  }
  return made(table, "profile", [&] { return contact::Profile(points); });
}

double tube_radius(const TableReader& table) { return table.number("tube_radius", {Range::above_zero, "m"}); }

contact::Circle read_drilled(const TableReader& table) {
  const double tube = tube_radius(table);
  if (table.has("clearance")) {
    if (table.has("hole_radius"))
      table.fail_at("clearance", "hole_radius and the radial clearance both give the hole; keep one");
    return {table.number("clearance", {Range::at_least_zero, "m"})};
  }
  const double hole = table.number("hole_radius", {Range::above_zero, "m"});
  return made(table, "hole_radius", [&] { return contact::drilled_hole(tube, hole); });
}

contact::Ellipse read_ellipse(const TableReader& table) {
  const double tube = tube_radius(table);
  (void)table.required("semi_axes",
                       "two numbers [y, z] in m, half the width and half the height of the hole");
  const auto axes = *table.optional_numbers("semi_axes", 2, {Range::above_zero, "m"});
  return made(table, "semi_axes", [&] { return contact::elliptic_hole(tube, axes[0], axes[1]); });
}

contact::BroachedSpace read_broached(const TableReader& table) {
  const double tube = tube_radius(table);
  contact::BroachedHole hole{};
  hole.land_radius = table.number("land_radius", {Range::above_zero, "m"});
  hole.lobe_radius = table.number("lobe_radius", {Range::above_zero, "m"});
  hole.lands = read_lands(table, 3);
  const double land_angle = table.number("land_angle", {Range::above_zero, "degrees"});
  if (const double whole = 360.0 / hole.lands; land_angle >= whole)
    table.fail_at(
        "land_angle",
        fmt::format("{} lands of this angle leave no lobe between them; give less than {:g} degrees",
                    hole.lands, whole));
  hole.land_angle = land_angle * degree;
  return made(table, "land_radius", [&] { return contact::BroachedSpace(tube, hole); });
}

contact::Profile read_egg_crate(const TableReader& table) {
  const double tube = tube_radius(table);
  (void)table.required("half_widths", "two numbers [y, z] in m, from the middle to the faces");
  const auto widths = *table.optional_numbers("half_widths", 2, {Range::above_zero, "m"});
  return made(table, "half_widths", [&] { return contact::egg_crate(tube, widths[0], widths[1]); });
}

/// One number: one bar, on the positive side. Two: the middle between them may lie beside the tube.
void read_bars(const TableReader& table, PlaneAxis axis, Contact& contact) {
  const double tube = tube_radius(table);
  const Value& bars = table.required(
      "bars", "the distance (m) of a bar's face from the tube's centre, or [minus, plus] of two bars");
  if (!bars.array()) {
    const double distance = table.number("bars", {Range::above_zero, "m"});
    contact.shape =
        made(table, "bars", [&] { return contact::flat_bars(tube, distance, axis, contact::BarSides::one); });
    return;
  }
  const auto faces = *table.optional_numbers("bars", 2, {Range::any, "m"});
  const auto between =
      made(table, "bars", [&] { return contact::flat_bars_between(tube, faces[0], faces[1], axis); });
  contact.shape = between.planes;
  contact.offset[axis == PlaneAxis::y ? 0 : 1] += between.offset;
}

void read_fixed_obstacle(const TableReader& table, Contact& contact) {
  refuse_foreign_sizes(table, contact.obstacle);
  const auto gap = [&] {
    return table.number(
        "gap", {Range::at_least_zero, "m", "an overlap is made by origin or offset, with a gap >= 0"});
  };
  if (table.has("tube_radius"))
    contact.tube_radius = tube_radius(table);
  switch (contact.obstacle) {
  case ObstacleKind::circle:
    contact.shape = contact::Circle{gap()};
    return;
  case ObstacleKind::plane_y:
    contact.shape = contact::PlanePair{gap(), PlaneAxis::y};
    return;
  case ObstacleKind::plane_z:
    contact.shape = contact::PlanePair{gap(), PlaneAxis::z};
    return;
  case ObstacleKind::stop_y:
    contact.shape = contact::Stop{gap(), PlaneAxis::y};
    return;
  case ObstacleKind::stop_z:
    contact.shape = contact::Stop{gap(), PlaneAxis::z};
    return;
  case ObstacleKind::circle_inside:
    table.fail_at("obstacle",
                  "a ring that moves with a second node; name that node in other, or take circle");
  case ObstacleKind::profile:
    contact.shape = read_profile(table);
    return;
  case ObstacleKind::ellipse:
    contact.shape = read_ellipse(table);
    return;
  case ObstacleKind::drilled:
    contact.shape = read_drilled(table);
    return;
  case ObstacleKind::broached:
    contact.shape = read_broached(table);
    return;
  case ObstacleKind::egg_crate:
    contact.shape = read_egg_crate(table);
    return;
  case ObstacleKind::bars_y:
    return read_bars(table, PlaneAxis::y, contact);
  case ObstacleKind::bars_z:
    return read_bars(table, PlaneAxis::z, contact);
  }
}

bool joins_nodes(ObstacleKind kind) {
  return kind == ObstacleKind::circle || kind == ObstacleKind::circle_inside ||
         kind == ObstacleKind::plane_y || kind == ObstacleKind::plane_z;
}

void read_moving_obstacle(const TableReader& table, Contact& contact) {
  if (!joins_nodes(contact.obstacle))
    table.fail_at("obstacle", "an obstacle fixed in space; between two nodes take circle, circle_inside, "
                              "plane_y or plane_z");
  const bool ring = contact.obstacle == ObstacleKind::circle_inside;
  for (const std::string& key : size_keys)
    if (table.has(key) && (key != "gap" || ring))
      table.fail_at(key,
                    ring && key == "gap"
                        ? "the clearance of a ring is distance_2 - distance_1; leave it out"
                        : "between two nodes bodies have distance_1 and distance_2, or a gap; leave it out");
  contact.pair_gap = table.optional_number("gap", {Range::at_least_zero, "m"});
  for (const char* key : {"distance_1", "distance_2"})
    if (contact.pair_gap && table.has(key))
      table.fail_at(key, "the gap at rest says how large the bodies are; leave one of them out");
  const auto distance = [&](const char* key) {
    return contact.pair_gap ? 0.0 : table.number(key, {Range::at_least_zero, "m"});
  };
  const double first = distance("distance_1"), second = distance("distance_2");
  contact.side = table.optional_number("side", {});
  if (contact.side && is_round(contact.obstacle))
    table.fail_at("side", "round bodies meet on any side; leave it out");
  if (contact.side && *contact.side != 1.0 && *contact.side != -1.0)
    table.fail_at("side", "the side of the second node on which the first stays; give 1 or -1");
  if (contact.obstacle == ObstacleKind::circle_inside) {
    if (second < first)
      table.fail_at("distance_2", "the ring round the second node is smaller than what moves in it; give a "
                                  "radius of at least distance_1");
    contact.shape = contact::Circle{second - first};
  } else if (contact.obstacle == ObstacleKind::circle) {
    if (!contact.pair_gap && !(first + second > 0.0))
      table.fail_at("distance_1", "two bodies without size never meet; give a radius > 0 to one");
    contact.shape = contact::RoundPair{first + second};
  } else {
    const PlaneAxis axis = contact.obstacle == ObstacleKind::plane_y ? PlaneAxis::y : PlaneAxis::z;
    contact.shape = contact::FacingPlanes{first + second, axis, contact.side.value_or(1.0)};
  }
}

} // namespace

const std::vector<std::string> obstacle_keys = [] {
  std::vector<std::string> keys{"obstacle", "other", "distance_1", "distance_2", "side"};
  keys.insert(keys.end(), size_keys.begin(), size_keys.end());
  return keys;
}();

bool is_round(ObstacleKind kind) {
  return kind == ObstacleKind::circle || kind == ObstacleKind::circle_inside || kind == ObstacleKind::drilled;
}

std::string name_of(ObstacleKind kind) {
  const auto& all = obstacles.available;
  return std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.second == kind; })->first;
}

int read_lands(const TableReader& table, int otherwise) {
  constexpr std::int64_t most = 360; // one a degree
  const std::int64_t lands = table.optional_integer("lands", 2).value_or(otherwise);
  if (lands > most)
    table.fail_at("lands", "more lands than a hole has room for; 3 make a trefoil, 4 a quatrefoil");
  return static_cast<int>(lands);
}

void read_obstacle(const TableReader& table, Contact& contact) {
  contact.obstacle = table.choice("obstacle", ObstacleKind::circle, obstacles);
  contact.other = table.optional_text("other");
  if (contact.other)
    return read_moving_obstacle(table, contact);
  for (const char* key : {"distance_1", "distance_2", "side"})
    if (table.has(key))
      table.fail_at(key,
                    "belongs to a contact between two nodes; name the second one in other, or leave it out");
  read_fixed_obstacle(table, contact);
}

} // namespace fretwork::study
