// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/contact_readers.hpp"

namespace fretwork::study {
namespace {

/// A key that another choice would need is refused, with what to do.
void refuse(const TableReader& table, const char* key, const char* why) {
  if (table.has(key))
    table.fail_at(key, why);
}

Restitution read_restitution(const TableReader& table, NormalDamper damper) {
  Restitution out;
  out.value = table.number("restitution", {Range::above_zero, "", "0 would need an infinite damper"});
  if (out.value > 1.0)
    table.fail_at("restitution", "an impact does not gain speed; give a number between 0 and 1");
  refuse(table, "normal_damping", "restitution already gives the damper; keep one of the two");
  refuse(table, "normal_dissipation", "restitution already gives the damper; keep one of the two");
  if (damper == NormalDamper::hunt_crossley) {
    refuse(
        table, "restitution_mass",
        "with normal_law = \"hunt_crossley\" what an impact loses does not depend on the mass; leave it out");
    (void)table.required("restitution_velocity", "the speed of impact (m/s) at which normal_law = "
                                                 "\"hunt_crossley\" shall have this restitution");
    out.velocity = table.number("restitution_velocity", {Range::above_zero, "m/s"});
    return out;
  }
  refuse(table, "restitution_velocity",
         "with normal_law = \"reference\" the restitution is the same at every speed; leave it out");
  out.mass = table.optional_number("restitution_mass", {Range::above_zero, "kg"});
  return out;
}

void read_friction_coefficients(const TableReader& table, Contact& contact) {
  const Value* friction = table.find("friction");
  if (!friction)
    return;
  if (!friction->table()) {
    contact.friction_static = contact.friction_dynamic =
        to_number(*friction, table.path("friction"), {Range::at_least_zero});
    return;
  }
  const TableReader two(*friction, table.path("friction"), {{"static", "dynamic"}});
  contact.friction_static = two.number("static", {Range::at_least_zero});
  contact.friction_dynamic = two.number("dynamic", {Range::at_least_zero});
  if (contact.friction_static < contact.friction_dynamic)
    two.fail_at("static", "less than dynamic; static friction is at least the dynamic one");
}

} // namespace

const std::vector<std::string> normal_law_keys{
    "normal_stiffness", "normal_law",       "normal_damping",       "normal_dissipation",
    "restitution",      "restitution_mass", "restitution_velocity",
};

void read_normal_law(const TableReader& table, Contact& contact) {
  const Value& stiffness = table.required("normal_stiffness", "a number > 0 in N/m, or \"wall\"");
  if (stiffness.string())
    (void)to_choice(stiffness, table.path("normal_stiffness"), {"wall"});
  else
    contact.normal_stiffness = table.number("normal_stiffness", {Range::above_zero, "N/m"});
  contact.normal_damper =
      table.choice("normal_law", NormalDamper::reference,
                   Choices<NormalDamper>{{{"reference", NormalDamper::reference},
                                          {"hunt_crossley", NormalDamper::hunt_crossley}}});
  if (table.has("restitution")) {
    contact.restitution = read_restitution(table, contact.normal_damper);
    return;
  }
  for (const char* key : {"restitution_mass", "restitution_velocity"})
    refuse(table, key, "belongs to restitution, which is not given; give it, or leave this out");
  if (contact.normal_damper == NormalDamper::hunt_crossley)
    refuse(table, "normal_damping",
           "belongs to normal_law = \"reference\"; give normal_dissipation (s/m) or restitution");
  else
    refuse(table, "normal_dissipation",
           "belongs to normal_law = \"hunt_crossley\"; name that law, or give normal_damping (N s/m)");
  contact.normal_damping = table.number_or("normal_damping", 0.0, {Range::at_least_zero, "N s/m"});
  contact.normal_dissipation = table.number_or("normal_dissipation", 0.0, {Range::at_least_zero, "s/m"});
}

const std::vector<std::string> friction_keys{"friction", "friction_memory", "friction_direction",
                                             "tangential_stiffness", "tangential_damping"};

void read_friction(const TableReader& table, Contact& contact) {
  using contact::FrictionMemoryKind;
  using contact::Vec2;
  read_friction_coefficients(table, contact);
  contact.tangential_stiffness = table.number_or("tangential_stiffness", 0.0, {Range::at_least_zero, "N/m"});
  if (contact.friction_static > 0.0 && contact.tangential_stiffness == 0.0)
    table.fail_at(
        "friction",
        "friction needs a tangential_stiffness > 0 (N/m), the stiffness of the contact while it sticks");
  if (const Value* damping = table.find("tangential_damping")) {
    if (damping->string())
      (void)to_choice(*damping, table.path("tangential_damping"), {"auto"});
    else
      contact.tangential_damping =
          to_number(*damping, table.path("tangential_damping"), {Range::at_least_zero, "N s/m"});
  }
  contact.memory = table.choice("friction_memory", FrictionMemoryKind::return_map,
                                Choices<FrictionMemoryKind>{{{"return_map", FrictionMemoryKind::return_map},
                                                             {"reference", FrictionMemoryKind::reference}}});
  contact.friction_along =
      table.choice("friction_direction", Vec2{1.0, 1.0},
                   Choices<Vec2>{{{"both", {1.0, 1.0}}, {"axial", {1.0, 0.0}}, {"transverse", {0.0, 1.0}}}});
}

} // namespace fretwork::study
