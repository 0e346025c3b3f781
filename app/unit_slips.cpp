// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/unit_slips.hpp"
#include "core/error.hpp"
#include "results/grouped_messages.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::app {
namespace {

constexpr double largest_section = 3.0, largest_gap = 0.1, largest_mesh = 1000.0; // m
constexpr double least_stiffness = 1e3;                                           // N/m, of a contact
constexpr double least_modulus = 1e7;                                             // Pa
constexpr double least_density = 50.0, largest_density = 3e4;                     // kg/m3
constexpr double largest_friction = 2.0;
constexpr double largest_support = 1.0, largest_correlation = 10.0; // m
constexpr double largest_damping = 0.3;
constexpr double largest_viscosity = 2e-5;  // m2/s
constexpr double largest_wear = 1e-10;      // m2/N
constexpr double largest_slenderness = 2e4; // mesh over the largest size of its sections
constexpr double largest_gravity = 100.0;   // m/s2
constexpr double largest_shake = 500.0;     // m/s2, 51 g: of bases and supports
constexpr double largest_speed = 100.0, largest_gas_speed = 1000.0; // m/s, in gaps
constexpr double largest_added_mass = 100.0;                        // of the material's mass

/// Sizes of a shape, m, by their keys.
std::vector<std::pair<const char*, double>> sizes(const fem::Shape& shape) {
  if (const auto* pipe = std::get_if<fem::Pipe>(&shape))
    return {{"outer_diameter", pipe->outer_diameter}, {"thickness", pipe->thickness}};
  if (const auto* circle = std::get_if<fem::Circle>(&shape))
    return {{"diameter", circle->diameter}};
  if (const auto* rectangle = std::get_if<fem::Rectangle>(&shape))
    return {{"height_y", rectangle->height_y}, {"height_z", rectangle->height_z}};
  return {};
}

/// The clearance of a shape that has one, m; 0 for others.
double given_gap(const contact::Obstacle& obstacle) {
  if (const auto* circle = std::get_if<contact::Circle>(&obstacle))
    return circle->gap;
  if (const auto* planes = std::get_if<contact::PlanePair>(&obstacle))
    return planes->gap;
  if (const auto* stop = std::get_if<contact::Stop>(&obstacle))
    return stop->gap;
  return 0.0;
}

/// m, from end to end of the box about the mesh along its longest side.
double length_of(const mesh::LineMesh& mesh) {
  if (mesh.nodes.empty())
    return 0.0;
  core::Vec3 low = mesh.nodes.front(), high = low;
  for (const core::Vec3& node : mesh.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  return (high - low).maxCoeff();
}

/// m, the largest of all sections with sizes; infinite without one.
double largest_size(const study::Study& study) {
  double largest = 0.0;
  for (const auto& [name, section] : study.sections)
    for (const auto& [key, value] : sizes(section.shape))
      largest = std::max(largest, value);
  return largest > 0.0 ? largest : std::numeric_limits<double>::infinity();
}

/// m, of the clearance of a contact: that about a tube is of its size at most, one to a stop may be longer. @param section  the largest size of all
double most_gap(const study::Contact& contact, double section) {
  constexpr double of_section =
      1.1; // up to which a clearance is a mistaken radius or diameter (contact_notes.cpp)
  const bool about_the_tube = !contact.other && !std::holds_alternative<contact::Stop>(contact.shape);
  return about_the_tube ? std::min(largest_gap, of_section * section) : largest_gap;
}

/// Values that are too large for metres, each `key = value`.
std::vector<std::string> too_long(const study::Study& study, const mesh::LineMesh& mesh) {
  std::vector<std::string> out;
  for (const auto& [name, section] : study.sections) {
    const auto all = sizes(section.shape);
    if (std::any_of(all.begin(), all.end(), [](const auto& size) { return size.second > largest_section; }))
      for (const auto& [key, value] : all)
        out.push_back(fmt::format("sections.{}.{} = {:g} m", name, key, value));
  }
  const double section = largest_size(study);
  for (const study::Contact& contact : study.contacts) {
    if (const double gap = given_gap(contact.shape); gap > most_gap(contact, section))
      out.push_back(fmt::format("gap = {:g} m of contact \"{}\"", gap, contact.name));
    if (const auto& [y, z] = contact.offset; std::max(std::abs(y), std::abs(z)) > largest_gap)
      out.push_back(fmt::format("offset = [{:g}, {:g}] m of contact \"{}\"", y, z, contact.name));
    if (contact.thickness > largest_support)
      out.push_back(fmt::format("thickness = {:g} m of contact \"{}\"", contact.thickness, contact.name));
  }
  for (const study::Wear& wear : study.wear)
    if (wear.length && *wear.length > largest_support)
      out.push_back(fmt::format("{}.length = {:g} m", wear.path, *wear.length));
  for (const study::Turbulence& turbulence : study.turbulence)
    if (turbulence.correlation_length > largest_correlation)
      out.push_back(fmt::format("turbulence.{}.correlation_length = {:g} m", turbulence.name,
                                turbulence.correlation_length));
  const double length = length_of(mesh);
  if (length > std::min(largest_mesh, largest_slenderness * section))
    out.push_back(
        fmt::format("a mesh {:g} m long{} (mesh.scale = 1e-3 turns mm into m)", length,
                    std::isfinite(section) ? fmt::format(", of sections up to {:g} m", section) : ""));
  return out;
}

std::vector<std::string> odd_materials(const study::Study& study) {
  std::vector<std::string> out;
  for (const auto& [name, material] : study.materials) {
    if (material.young_modulus < least_modulus)
      out.push_back(
          fmt::format("materials.{}.young_modulus = {:g} Pa (steel: 2e11)", name, material.young_modulus));
    if (material.density > 0.0 && (material.density < least_density || material.density > largest_density))
      out.push_back(fmt::format("materials.{}.density = {:g} kg/m3 (steel: 7850)", name, material.density));
  }
  return out;
}

std::vector<std::string> odd_friction(const study::Study& study) {
  std::vector<std::string> out;
  for (const study::Contact& contact : study.contacts)
    if (contact.friction_static > largest_friction)
      out.push_back(fmt::format("friction = {:g} of contact \"{}\"", contact.friction_static, contact.name));
  return out;
}

std::vector<std::string> odd_damping(const study::Study& study) {
  if (study.modes.flow_damping)
    return {};
  const modal::Damping& given = study.modes.damping;
  if (const auto* ratio = std::get_if<double>(&given); ratio && *ratio > largest_damping)
    return {fmt::format("modes.damping = {:g}", *ratio)};
  // fast modes may be meant to be damped so
  if (const auto* list = std::get_if<std::vector<double>>(&given); list && list->front() > largest_damping)
    return {fmt::format("modes.damping = [{:g}, ...]", list->front())};
  if (const auto* table = std::get_if<modal::DampingTable>(&given);
      table && table->rows.front().ratio > largest_damping)
    return {fmt::format("modes.damping table of {:g} and more", table->rows.front().ratio)};
  return {};
}

/// Liquids of g/cm3, and dynamic viscosities.
std::vector<std::string> odd_liquids(const study::Study& study) {
  std::vector<std::string> out;
  const auto look = [&](const std::string& keys, double density, double viscosity) {
    if (density < least_density)
      out.push_back(fmt::format("{}.density = {:g} kg/m3", keys, density));
    if (viscosity > largest_viscosity)
      out.push_back(fmt::format("{}.viscosity = {:g} m2/s", keys, viscosity));
  };
  for (const study::Flow& flow : study.flows)
    for (const flow::Zone& zone : flow.zones) {
      const std::string keys = fmt::format("flow.{}.zones.{}", flow.name, zone.name);
      if (const auto* two = std::get_if<flow::TwoPhase>(&zone.fluid))
        look(keys + ".liquid", two->phases.liquid_density, two->phases.liquid_viscosity);
      else if (const auto& single = std::get<flow::SinglePhase>(zone.fluid);
               single.phase == flow::Phase::liquid)
        look(keys, *std::max_element(single.density.values.begin(), single.density.values.end()),
             single.viscosity);
    }
  return out;
}

/// Stiffnesses of contacts in N/mm.
std::vector<std::string> odd_stiffness(const study::Study& study) {
  std::vector<std::string> out;
  if (study.beams.empty())
    return out;
  for (const study::Contact& contact : study.contacts)
    if (contact.active && contact.normal_stiffness && *contact.normal_stiffness <= least_stiffness)
      out.push_back(fmt::format("normal_stiffness = {:g} N/m of contact \"{}\"", *contact.normal_stiffness,
                                contact.name));
  return out;
}

/// Coefficients of wear in mm3/(N m), or without a unit.
std::vector<std::string> odd_wear(const study::Study& study) {
  std::vector<std::string> out;
  const auto look = [&](const study::Wear& wear, const char* key, double value) {
    if (value > largest_wear)
      out.push_back(fmt::format("{}.{} = {:g} m2/N", wear.path, key, value));
  };
  for (const study::Wear& wear : study.wear) {
    if (const auto* archard = std::get_if<wear::Archard>(&wear.law))
      look(wear, "coefficient", archard->coefficient);
    else if (const auto* kwu = std::get_if<wear::KwuEpri>(&wear.law))
      look(wear, "coefficient", kwu->coefficient);
    look(wear, "support_coefficient", wear.support_coefficient);
  }
  return out;
}

/// Of given functions: the largest magnitude, of a random one its rms.
double largest_magnitude(const signals::TimeFunction& function) {
  if (const auto* constant = std::get_if<signals::Constant>(&function))
    return std::abs(constant->value);
  if (const auto* harmonic = std::get_if<signals::Harmonic>(&function))
    return std::abs(harmonic->amplitude);
  if (const auto* random = std::get_if<signals::Random>(&function))
    return random->rms;
  double largest = 0.0;
  if (const auto* table = std::get_if<signals::Table>(&function))
    for (const double value : table->value)
      largest = std::max(largest, std::abs(value));
  return largest;
}

/// Accelerations and velocities of mm.
std::vector<std::string> odd_motion(const study::Study& study) {
  std::vector<std::string> out;
  if (study.gravity && study.gravity->norm() > largest_gravity)
    out.push_back(fmt::format("gravity.acceleration of {:g} m/s2 (weight: 9.81)", study.gravity->norm()));
  const auto look = [&](const std::string& keys, const signals::TimeFunction& acceleration) {
    if (const double largest = largest_magnitude(acceleration); largest > largest_shake)
      out.push_back(fmt::format("acceleration of {:.4g} m/s2 in {} (earthquakes: below 30)", largest, keys));
  };
  for (std::size_t k = 0; k < study.base_motions.size(); ++k)
    look(fmt::format("[[base_motion]] entry {}", k + 1), study.base_motions[k].acceleration);
  for (std::size_t k = 0; k < study.support_motions.size(); ++k)
    if (!study.support_motions[k].by_displacement)
      look(fmt::format("[[support_motion]] entry {}", k + 1), study.support_motions[k].function);
  for (const study::Flow& flow : study.flows)
    for (const flow::Zone& zone : flow.zones) {
      double speed = 0.0;
      if (const auto* scalar = std::get_if<flow::ScalarVelocity>(&zone.velocity))
        speed = *std::max_element(scalar->speed.values.begin(), scalar->speed.values.end());
      else
        for (const core::Vec3& value : std::get<flow::VectorVelocity>(zone.velocity).velocity.values)
          speed = std::max(speed, value.norm());
      const auto* single = std::get_if<flow::SinglePhase>(&zone.fluid);
      if (speed > (single && single->phase == flow::Phase::gas ? largest_gas_speed : largest_speed))
        out.push_back(fmt::format("flow.{}.zones.{}.velocity = {:g} m/s", flow.name, zone.name, speed));
    }
  return out;
}

/// Added masses far above that of the beams' own material.
std::vector<std::string> odd_added_mass(const study::Study& study) {
  std::vector<std::string> out;
  for (const study::Beams& beams : study.beams) {
    const double own = study.materials.at(beams.material).density * study.sections.at(beams.section).area;
    if (own > 0.0 && beams.added_mass > largest_added_mass * own)
      out.push_back(fmt::format("added_mass = {:g} kg/m of beams \"{}\" (their material: {:.3g} kg/m)",
                                beams.added_mass, beams.group, own));
  }
  return out;
}

/// A fixed step beyond the longest period that a contact can have, that of all the mass on its spring; else empty.
std::string long_step(const study::Study& study, const fem::Model& model) {
  if (!study.transient || !study.transient->step)
    return {};
  double stiffness = 0.0;
  for (const study::Contact& contact : study.contacts)
    if (contact.active)
      stiffness = std::max(stiffness, contact.normal_stiffness.value_or(0.0));
  const double mass = fem::total_mass(model), step = *study.transient->step;
  if (!(stiffness > 0.0) || !(mass > 0.0))
    return {};
  const double period = 2.0 * std::numbers::pi * std::sqrt(mass / stiffness);
  return step > period
             ? fmt::format(
                   "transient.step = {:g} s is longer than the slowest vibration on a contact can be, "
                   "{:.2g} s: is it ms? Leave step out to have it chosen",
                   step, period)
             : std::string();
}

/// The questions first: a message of what follows from them may be long.
std::string with_questions(const char* message, const std::vector<std::string>& questions) {
  return fmt::format("{}; {}", fmt::join(questions, "; "), message);
}

/// `values` with a question; nothing without values. Equal ones of several contacts are one.
void ask(const std::vector<std::string>& values, const char* question, std::vector<std::string>& out) {
  if (!values.empty())
    out.push_back(fmt::format("units: {}: {}", fmt::join(results::grouped_messages(values), ", "), question));
}

} // namespace

std::vector<std::string> unit_slips(const study::Study& study, const mesh::LineMesh& mesh,
                                    const fem::Model& model) {
  std::vector<std::string> out;
  ask(too_long(study, mesh),
      fmt::format("are these mm? Lengths are metres; the structure without fluid weighs {:.3g} kg",
                  fem::total_mass(model))
          .c_str(),
      out);
  ask(odd_materials(study), "units are SI: Pa and kg/m3", out);
  ask(odd_stiffness(study),
      "are these N/mm? Stiffnesses are N/m: 1e4 to 1e6 of springs of fuel rods, 1e5 to 1e8 of supports of "
      "tubes",
      out);
  ask(odd_friction(study), "is this per cent? Coefficients of friction lie between 0 and 2", out);
  ask(odd_damping(study), "is this per cent? It is the share of critical damping, 0.002 to 0.05 of tubes",
      out);
  ask(odd_liquids(study),
      "units are SI: kg/m3, and m2/s of the kinematic viscosity, which is the dynamic one (Pa s) over the "
      "density (water: 1e-7 to 2e-6)",
      out);
  ask(odd_wear(study),
      "are these mm3/(N m), or without a unit? Coefficients are m2/N (1/Pa), 1e-17 to 1e-12 most often: "
      "1 mm3/(N m) is 1e-9 m2/N, and one without a unit is divided by the hardness in Pa",
      out);
  ask(odd_added_mass(study), "are these g/m? Masses are kg, added masses kg per metre of beam", out);
  ask(odd_motion(study), "are these mm? Units are SI: m/s2 and m/s", out);
  if (std::string step = long_step(study, model); !step.empty())
    out.push_back("units: " + step);
  return out;
}

void asking_about_units(const std::vector<std::string>& slips, const std::function<void()>& work) {
  const std::vector<std::string> questions = slips; // work may add to them
  try {
    work();
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::ComputationError& error) {
    if (questions.empty())
      throw;
    throw core::ComputationError(with_questions(error.what(), questions));
  } catch (const core::Error& error) {
    if (questions.empty())
      throw;
    throw core::Error(with_questions(error.what(), questions));
  }
}

} // namespace fretwork::app
