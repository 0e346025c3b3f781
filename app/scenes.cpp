// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/scenes.hpp"
#include "app/build_up.hpp"
#include "app/contact_notes.hpp"
#include "app/missing_flexibility.hpp"
#include "app/modal_truncation.hpp"
#include "app/shared_signals.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

results::ContactFacts facts_of(const study::Contact& contact, const PlacedContact& placed,
                               const contact::Support& support) {
  results::ContactFacts facts;
  facts.name = placed.name;
  facts.node = placed.node;
  facts.other = placed.other;
  facts.point = {placed.place, placed.motion};
  facts.axes = placed.frame.rotation();
  facts.obstacle = study::name_of(contact.obstacle);
  facts.gap = gap_of(placed, support.obstacle);
  if (auto sides = contact::sides_of(support.obstacle); sides.size() > 1)
    facts.sides = std::move(sides);
  facts.rest = placed.rest;
  const auto outline = contact::outline_of(support.obstacle);
  facts.outline.resize(static_cast<Eigen::Index>(outline.size()), 2);
  for (std::size_t i = 0; i < outline.size(); ++i)
    facts.outline.row(static_cast<Eigen::Index>(i)) << outline[i].y, outline[i].z;
  facts.normal_stiffness = support.normal.stiffness;
  facts.normal_damping = support.normal.damping;
  facts.normal_dissipation = support.normal.dissipation;
  facts.tangential_stiffness = support.friction.stiffness;
  facts.tangential_damping = support.friction.damping;
  facts.friction_static = support.friction.mu_static;
  facts.friction_dynamic = support.friction.mu_dynamic;
  facts.friction_along = {support.friction.along.x, support.friction.along.t};
  return facts;
}

/// Of a table of accelerations that ends before the run and not at 0, which drives the base or support away; else empty.
std::string goes_on_note(const Fields::Load& load, double duration) {
  constexpr double rest = 1e-3; // of the largest value: what a record is cut off at
  const auto* table = std::get_if<signals::Table>(&load.function);
  if (!load.inertial || !table || table->time.back() >= duration)
    return {};
  double largest = 0.0;
  for (const double value : table->value)
    largest = std::max(largest, std::abs(value));
  return std::abs(table->value.back()) > rest * largest
             ? fmt::format("{}: the table ends at {:g} s, before the run; its last acceleration, {:g} m/s2, "
                           "goes on to "
                           "the end: let it end at 0 where it should not",
                           load.name, table->time.back(), table->value.back())
             : std::string();
}

/// Whether anything moves the scene: loads, motions, an initial state, or a contact that is pressed at the start.
bool is_moved(const transient::Scene& scene) {
  const auto acts = [](const vibration::Load& load) { return !load.modal_force.isZero(0.0); };
  const auto pressed = [&](const transient::ContactPoint& contact) {
    return scene.location_at_start(contact).gap < 0.0;
  };
  return std::any_of(scene.loads.begin(), scene.loads.end(), acts) || !scene.motions.empty() ||
         std::any_of(scene.sampled_loads.begin(), scene.sampled_loads.end(),
                     [](const signals::SampledLoad& load) { return load.acts(); }) ||
         !scene.q0.isZero(0.0) || !scene.v0.isZero(0.0) ||
         std::any_of(scene.contacts.begin(), scene.contacts.end(), pressed);
}

/// What the user should know of the loads.
void note_loads(const study::Study& study, const Fields& fields, const std::vector<BuiltScene>& scenes,
                results::RunResults& out) {
  const double duration = study.transient->duration;
  if (std::none_of(scenes.begin(), scenes.end(),
                   [](const BuiltScene& built) { return is_moved(built.scene); }))
    out.warnings.push_back(
        "nothing moves: no load, motion, turbulence or initial state acts on the modes, and "
        "no contact is pressed at the start");
  for (const SharedSignal& shared : shared_signals(study))
    out.notes.push_back(text_of(shared) + "; give one another seed if they are independent");
  constexpr double long_rise = 0.2; // of the run
  for (const Fields::Load& load : fields.loads)
    if (const auto* random = std::get_if<signals::Random>(&load.function);
        random && random->of_motion && signals::rise_time(*random) > long_rise * duration)
      out.warnings.push_back(
          fmt::format("{}: the random acceleration rises from rest over {:.2g} s, a period of the lower end "
                      "of its band or 8 of the upper; "
                      "the run of {:g} s has less than its rms: raise the lower end, or run longer",
                      load.name, signals::rise_time(*random), duration));
  for (const Fields::Load& load : fields.loads)
    if (const std::string note = goes_on_note(load, duration); !note.empty())
      out.notes.push_back(note);
  // a support that moves nothing by its inertia may still carry an obstacle
  for (std::size_t k = 0; k < fields.loads.size() && !fields.loads[k].of_support; ++k) {
    const auto idle = [&](const BuiltScene& scene) { return scene.scene.loads[k].modal_force.isZero(0.0); };
    if (std::all_of(scenes.begin(), scenes.end(), idle))
      out.warnings.push_back(
          fmt::format("{} moves nothing: its nodes are restrained in its direction; apply it elsewhere",
                      fields.loads[k].name));
  }
}

} // namespace

std::vector<BuiltScene> build_scenes(const study::Study& study, const std::vector<modal::Basis>& bases,
                                     const std::vector<PlacedContact>& placed,
                                     const std::vector<NamedNode>& nodes, const AtContacts& at_contacts,
                                     results::RunResults& out) {
  const auto& [fields, turbulence, joined, flexibilities] = at_contacts;
  std::vector<BuiltScene> scenes;
  out.contacts.resize(placed.size());
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const ContactFlexibility& flexibility = flexibilities[i];
    scenes.push_back(
        build_scene(study, bases, placed, nodes, fields,
                    {joined[i], flexibility, sampled_loads(turbulence, bases, joined[i], out.notes)}));
    const BuiltScene& scene = scenes.back();
    for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
      const std::size_t c = scene.contacts[k];
      out.contacts[c] = facts_of(study.contacts[placed[c].entry], placed[c], scene.scene.contacts[k].support);
      if (flexibility.failure.empty())
        out.contacts[c].static_flexibility = flexibility.at(k, placed[c].obstacle);
    }
    if (!flexibility.failure.empty())
      out.notes.push_back("no static flexibility at the contacts: " + flexibility.failure);
    out.warnings.insert(out.warnings.end(), scene.warnings.begin(), scene.warnings.end());
    out.notes.insert(out.notes.end(), scene.notes.begin(), scene.notes.end());
  }
  out.warnings.insert(out.warnings.end(), fields.warnings.begin(), fields.warnings.end());
  out.notes.insert(out.notes.end(), fields.notes.begin(), fields.notes.end());
  for (std::string& warning : start_warnings(study, placed, scenes))
    out.warnings.push_back(std::move(warning));
  const auto of_contacts = contact_notes(study, placed, scenes);
  out.notes.insert(out.notes.end(), of_contacts.begin(), of_contacts.end());
  if (const std::string note = flexibility_note(scenes); !note.empty())
    out.notes.insert(out.notes.begin(), note);
  for (const std::string& warning :
       {missing_flexibility_warning(study, scenes), load_band_warning(study, bases, fields.loads)})
    if (!warning.empty()) // what makes forces wrong by factors comes first
      out.warnings.insert(out.warnings.begin(), warning);
  note_loads(study, fields, scenes, out);
  if (const std::string note = build_up_note(study, scenes);
      !note.empty() && (!placed.empty() || !nodes.empty()))
    out.notes.push_back(note);
  for (const NamedNode& node : nodes)
    if (!modal::structure_of(bases, node.node))
      throw core::Error(fmt::format(
          "[output] nodes: \"{}\" belongs to no structure that moves; observe another node", node.name));
  return scenes;
}

} // namespace fretwork::app
