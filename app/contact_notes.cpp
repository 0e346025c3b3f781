// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_notes.hpp"
#include "app/contact_laws.hpp"
#include "app/contact_questions.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <numbers>

namespace fretwork::app {
namespace {

/// A point of an entry and how it starts.
struct Point {
  const PlacedContact* placed;
  const transient::ContactPoint* contact;
  const std::vector<Eigen::Index>* true_modes; ///< of its scene
  double gap;                                  ///< m, at t = 0
  double force;                                ///< N, normal, at t = 0
};

/// @param k  number of the contact in its scene
Point at_start(const PlacedContact& placed, std::size_t k, const BuiltScene& built) {
  const transient::Scene& scene = built.scene;
  const transient::ContactPoint& contact = scene.contacts[k];
  core::Vec3 speed = contact.moved_by(scene.v0);
  for (Eigen::Index m = 0; m < contact.imposed.cols(); ++m)
    speed += scene.motions[static_cast<std::size_t>(m)].velocity0 * contact.imposed.col(m);
  const contact::Location at = scene.location_at_start(contact);
  const double penetration_rate = -(at.ny * speed.y() + at.nz * speed.z());
  return {&placed, &contact, &built.true_modes, at.gap,
          contact::normal_force(contact.support.normal, -at.gap, penetration_rate)};
}

/// m: a smaller overlap is round-off of places.
constexpr double least_overlap = 1e-12;

/// Empty where nothing overlaps.
std::string overlap_note(const std::string& name, const std::vector<Point>& points) {
  const auto overlapping =
      std::count_if(points.begin(), points.end(), [](const Point& p) { return p.gap < -least_overlap; });
  if (overlapping == 0)
    return {};
  const Point& deepest = *std::min_element(points.begin(), points.end(),
                                           [](const Point& a, const Point& b) { return a.gap < b.gap; });
  if (points.size() == 1)
    return fmt::format("contact \"{}\" starts with an overlap of {:.4g} m: it presses with {:.4g} N", name,
                       -deepest.gap, deepest.force);
  return fmt::format(
      "contact \"{}\": {} of {} points start with an overlap, the deepest \"{}\" with {:.4g} m: "
      "it presses with {:.4g} N",
      name, overlapping, points.size(), deepest.placed->name, -deepest.gap, deepest.force);
}

/// A value of every point, or from the least to the largest.
template <class Value> std::string range(const std::vector<Point>& points, Value value) {
  double least = value(points.front()), most = least;
  for (const Point& point : points) {
    least = std::min(least, value(point));
    most = std::max(most, value(point));
  }
  const std::string low = fmt::format("{:.4g}", least), high = fmt::format("{:.4g}", most);
  return low == high ? low : low + " to " + high;
}

std::string restitution_text(const study::Contact& entry, const std::vector<Point>& points) {
  const study::Restitution& wanted = *entry.restitution;
  switch (entry.normal_damper) {
  case study::NormalDamper::reference: {
    const auto damping = [](const Point& p) { return p.contact->support.normal.damping / p.placed->share; };
    const auto mass = [&](const Point& p) {
      return wanted.mass
                 ? *wanted.mass
                 : normal_mass(p.contact->support.obstacle,
                               p.contact->b(Eigen::all, true_modes_of(*p.contact, *p.true_modes).columns),
                               p.placed->name);
    };
    return fmt::format("normal damping {} N s/m for restitution {:g} with a mass of {} kg",
                       range(points, damping), wanted.value, range(points, mass));
  }
  case study::NormalDamper::hunt_crossley:
    return fmt::format("normal dissipation {} s/m for restitution {:g} at {:g} m/s",
                       range(points, [](const Point& p) { return p.contact->support.normal.dissipation; }),
                       wanted.value, wanted.velocity);
  }
  return {};
}

/// Empty where the study gives every value.
std::string laws_note(const study::Contact& entry, const std::vector<Point>& points) {
  std::vector<std::string> found;
  if (!entry.normal_stiffness)
    found.push_back(fmt::format(
        "stiffness of the tube's wall {} N/m{}",
        range(points, [](const Point& p) { return p.contact->support.normal.stiffness / p.placed->share; }),
        entry.other ? " (two walls in series)" : ""));
  if (entry.restitution)
    found.push_back(restitution_text(entry, points));
  if (entry.friction_static > 0.0 && !entry.tangential_damping)
    found.push_back(fmt::format(
        "automatic tangential damping {} N s/m, stiffer than tangential_stiffness above {} Hz "
        "(tangential_damping "
        "gives another)",
        range(points, [](const Point& p) { return p.contact->support.friction.damping / p.placed->share; }),
        range(points, [](const Point& p) {
          const contact::FrictionLaw& law = p.contact->support.friction;
          return law.stiffness / law.damping / (2.0 * std::numbers::pi);
        })));
  if (entry.friction_static == 0.0 && entry.tangential_stiffness > 0.0)
    found.push_back("tangential_stiffness without friction: nothing tangential is computed");
  if (found.empty())
    return {};
  return fmt::format(
      "contact \"{}\": {}{}", entry.name, fmt::join(found, ", "),
      points.front().placed->share < 1.0
          ? fmt::format(" (of the whole support: each point has {:.4g} of it)", points.front().placed->share)
          : "");
}

} // namespace

std::vector<std::string> contact_notes(const study::Study& study, const std::vector<PlacedContact>& placed,
                                       const std::vector<BuiltScene>& scenes) {
  std::vector<std::vector<Point>> of_entry(study.contacts.size());
  for (const BuiltScene& built : scenes)
    for (std::size_t k = 0; k < built.contacts.size(); ++k) {
      const PlacedContact& at = placed[built.contacts[k]];
      of_entry[at.entry].push_back(at_start(at, k, built));
    }
  std::vector<std::string> overlaps, laws;
  for (std::size_t e = 0; e < of_entry.size(); ++e)
    if (!of_entry[e].empty()) {
      overlaps.push_back(overlap_note(study.contacts[e].name, of_entry[e]));
      laws.push_back(laws_note(study.contacts[e], of_entry[e]));
    }
  overlaps.insert(overlaps.end(), laws.begin(), laws.end());
  std::erase(overlaps, std::string());
  return overlaps;
}

namespace {

/// Of an entry: its points with an overlap that the static start has opened.
struct LostPreload {
  std::size_t points = 0, lost = 0;
  std::string name;                ///< of the point with the largest overlap of these
  double overlap = 0.0, gap = 0.0; ///< m, at its rest and at the start
};

std::string lost_preload_warning(const LostPreload& of) {
  return fmt::format(
      "contact \"{}\": placed with an overlap of {:.4g} m, it is open by {:.4g} m in the static start{}: "
      "what acts at "
      "t = 0 takes its preload; look at the sign of offset and y_axis, or give a larger overlap",
      of.name, of.overlap, of.gap,
      of.points > 1 ? fmt::format(" ({} of {} points of its entry are so)", of.lost, of.points) : "");
}

/// Gaps tell obstacles apart; m from the place at rest, along y_loc and z_loc.
bool same_obstacle(const PlacedContact& a, const PlacedContact& b) {
  constexpr double probe = 1e-3;
  constexpr std::array<std::array<double, 2>, 5> probes{{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return a.obstacle.index() == b.obstacle.index() &&
         std::all_of(probes.begin(), probes.end(), [&](const std::array<double, 2>& at) {
           const auto gap = [&](const PlacedContact& contact) {
             return contact::locate(contact.obstacle, contact.rest.y() + probe * at[0],
                                    contact.rest.z() + probe * at[1])
                 .gap;
           };
           return gap(a) == gap(b);
         });
}

bool same(const PlacedContact& a, const PlacedContact& b) {
  return a.other == b.other && a.place == b.place && a.rest == b.rest &&
         a.frame.rotation() == b.frame.rotation() && same_obstacle(a, b);
}

/// The contact of the same two nodes, given from the other of them: where the first moves by p, the second is as far off as where itself
/// moves by -p. Axes and places are each those of their own node: to round-off.
bool same_reversed(const PlacedContact& a, const PlacedContact& b) {
  constexpr double probe = 1e-3, tolerance = 1e-9; // m
  constexpr double parallel = 1.0 - 1e-8;
  if (a.other < 0 || a.other != b.node || a.node != b.other || a.obstacle.index() != b.obstacle.index() ||
      std::abs(a.frame.x.dot(b.frame.x)) < parallel)
    return false;
  const auto gap = [](const PlacedContact& contact, const core::Vec3& moved) {
    const core::Vec3 place = contact.rest + contact.frame.rotation() * moved;
    return contact::locate(contact.obstacle, place.y(), place.z()).gap;
  };
  const core::Vec3 y = probe * a.frame.y, z = probe * a.frame.z;
  const std::array<core::Vec3, 5> probes{core::Vec3::Zero(), y, z, -y, -z};
  return std::all_of(probes.begin(), probes.end(), [&](const core::Vec3& moved) {
    return std::abs(gap(a, moved) - gap(b, -moved)) < tolerance;
  });
}

std::vector<std::string> lost_preloads(const study::Study& study, const std::vector<PlacedContact>& placed,
                                       const std::vector<BuiltScene>& scenes) {
  std::vector<std::string> out;
  if (!study.transient || study.transient->start != study::Start::equilibrium)
    return out;
  std::vector<LostPreload> of_entry(study.contacts.size());
  for (const BuiltScene& built : scenes)
    for (std::size_t k = 0; k < built.contacts.size(); ++k) {
      const PlacedContact& at = placed[built.contacts[k]];
      const transient::ContactPoint& contact = built.scene.contacts[k];
      const double overlap = -built.scene.location_undeformed(contact).gap,
                   gap = built.scene.location_at_start(contact).gap;
      LostPreload& entry = of_entry[at.entry];
      ++entry.points;
      if (!(overlap > least_overlap) || !(gap > least_overlap))
        continue;
      ++entry.lost;
      if (overlap > entry.overlap) {
        entry.name = at.name;
        entry.overlap = overlap;
        entry.gap = gap;
      }
    }
  for (const LostPreload& entry : of_entry)
    if (entry.lost > 0)
      out.push_back(lost_preload_warning(entry));
  return out;
}

/// m, of each node of the model: the largest outer radius of the beams at it, 0 without any.
std::vector<double> outer_radii(const fem::Model& model) {
  std::vector<double> out(model.nodes.size(), 0.0);
  for (const fem::Beam& beam : model.beams)
    for (const core::Index node : {beam.a, beam.b})
      if (const auto here =
              fem::outer_radius(fem::property_at(model.properties[static_cast<std::size_t>(beam.property)],
                                                 beam.along[node == beam.b])
                                    .section)) {
        double& most = out[static_cast<std::size_t>(node)];
        most = std::max(most, *here);
      }
  return out;
}

/// A clearance of the size of the tube: of a radius given as a gap, or a diameter given as a radius. Empty where it is not.
std::string clearance_warning(const PlacedContact& contact, study::ObstacleKind kind, double radius) {
  constexpr double like_a_radius = 0.9, like_a_diameter = 2.2; // in radii of the tube
  const double clearance = gap_of(contact, contact.obstacle);
  using enum study::ObstacleKind;
  if (kind == stop_y || kind == stop_z || !(clearance > like_a_radius * radius) ||
      !(clearance < like_a_diameter * radius))
    return {};
  return fmt::format(
      "contact \"{}\": its clearance of {:g} m is of the size of the tube, whose radius is {:g} m; a "
      "clearance is radial, and sizes of obstacles are radii and distances from the centre: is one a "
      "diameter, "
      "or gap a radius?",
      contact.name, clearance, radius);
}

/// A tube that rests in its obstacle by more than its radius, beyond a clearance below 0, which is meant. Empty where it does not.
std::string inside_warning(const PlacedContact& contact, double radius) {
  const double meant = std::max(0.0, -contact::locate(contact.obstacle, 0.0, 0.0).gap);
  const double overlap = -contact::locate(contact.obstacle, contact.rest.y(), contact.rest.z()).gap;
  if (overlap - meant <= radius)
    return {};
  return fmt::format(
      "contact \"{}\": the tube, of radius {:g} m, rests {:.4g} m inside its obstacle; look at "
      "origin, offset, axes and sizes of the obstacle",
      contact.name, radius, overlap);
}

/// Of contacts of beams with fixed obstacles, one warning an entry.
std::vector<std::string> misplaced_obstacles(const study::Study& study, const fem::Model& model,
                                             const std::vector<PlacedContact>& placed) {
  const std::vector<double> radii = outer_radii(model);
  std::vector<std::string> out;
  std::size_t said = study.contacts.size(); // entry of the last warning
  for (const PlacedContact& contact : placed) {
    const double radius = radii[static_cast<std::size_t>(contact.node)];
    if (contact.entry == said || contact.other >= 0 || radius == 0.0)
      continue;
    std::string warning = clearance_warning(contact, study.contacts[contact.entry].obstacle, radius);
    if (warning.empty())
      warning = inside_warning(contact, radius);
    if (warning.empty())
      continue;
    said = contact.entry;
    out.push_back(std::move(warning));
  }
  return out;
}

std::string twice_placed(const std::vector<PlacedContact>& placed) {
  std::multimap<core::Index, const PlacedContact*> by_node;
  std::string first, where;
  int pairs = 0;
  const auto note = [&](const PlacedContact& a, const PlacedContact& b, const char* how) {
    if (pairs++ > 0)
      return;
    first = fmt::format("contacts \"{}\" and \"{}\"", a.name, b.name);
    where = how;
  };
  for (const PlacedContact& contact : placed) {
    const auto found_at = [&](core::Index node, bool (*is_same)(const PlacedContact&, const PlacedContact&)) {
      const auto [begin, end] = by_node.equal_range(node);
      const auto found =
          std::find_if(begin, end, [&](const auto& other) { return is_same(*other.second, contact); });
      return found == end ? nullptr : found->second;
    };
    if (const PlacedContact* other = found_at(contact.node, same))
      note(*other, contact, "are at one node with the same axes and obstacle");
    else if (const PlacedContact* reversed = found_at(contact.other, same_reversed))
      note(*reversed, contact, "join the same two nodes with the same obstacle, group and other exchanged");
    by_node.emplace(contact.node, &contact);
  }
  if (pairs == 0)
    return {};
  return fmt::format("{}{} {}: they share its force, work rate and wear; leave one out", first,
                     pairs > 1 ? fmt::format(" (and {} more pair{})", pairs - 1, pairs > 2 ? "s" : "") : "",
                     where);
}

} // namespace

std::vector<std::string> placement_warnings(const study::Study& study, const fem::Model& model,
                                            const std::vector<PlacedContact>& placed) {
  std::vector<std::string> out = misplaced_obstacles(study, model, placed);
  for (std::string& question : contact_questions(study, model, placed))
    out.push_back(std::move(question));
  return out;
}

std::vector<std::string> start_warnings(const study::Study& study, const std::vector<PlacedContact>& placed,
                                        const std::vector<BuiltScene>& scenes) {
  std::vector<std::string> out;
  if (std::string twice = twice_placed(placed); !twice.empty())
    out.push_back(std::move(twice));
  for (std::string& lost : lost_preloads(study, placed, scenes))
    out.push_back(std::move(lost));
  return out;
}

} // namespace fretwork::app
