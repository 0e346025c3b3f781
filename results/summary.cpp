// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/contact_position.hpp"
#include "results/error_estimate.hpp"
#include "results/flow_json.hpp"
#include "results/force_results.hpp"
#include "results/json_number.hpp"
#include "results/step_error.hpp"
#include "results/summary_file.hpp"
#include "results/totals.hpp"
#include "results/wear_json.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace fretwork::results {
namespace {

Json triple(const core::Vec3& v) { return {number(v.x()), number(v.y()), number(v.z())}; }

Json model(const ModelFacts& m) {
  return {{"nodes", m.nodes},
          {"elements", m.elements},
          {"dofs", m.dofs},
          {"mass_kg", number(m.mass_kg)},
          {"different_structures", m.different_structures}};
}

Json modes(const std::vector<modal::Basis>& bases) {
  Json frequencies = Json::array(), residuals = Json::array(), damping = Json::array(),
       structure = Json::array(), errors = Json::array(), masses = Json::array();
  for (const ModeOf& m : sorted_modes(bases)) {
    const modal::Basis& basis = bases[m.structure];
    frequencies.push_back(number(m.frequency));
    residuals.push_back(number(basis.residuals(m.mode)));
    damping.push_back(number(basis.damping(m.mode)));
    structure.push_back(m.structure);
    errors.push_back(number(basis.error(m.mode)));
    masses.push_back(triple(basis.participation.row(m.mode).cwiseAbs2().transpose()));
  }
  double orthogonality = 0.0;
  bool distributed = false;
  core::Vec3 kept = core::Vec3::Zero(), moving = core::Vec3::Zero();
  for (const modal::Basis& basis : bases) {
    kept += basis.participation.topRows(basis.true_modes()).colwise().squaredNorm().transpose();
    moving += basis.moving_mass;
    orthogonality = std::max(orthogonality, basis.orthogonality);
    distributed = distributed || basis.distributed;
  }
  const std::vector<ModeOf> static_modes = sorted_static_modes(bases);
  Json out{{"frequencies_hz", frequencies},
           {"residuals", residuals},
           {"damping", damping},
           {"static_modes", static_modes.size()}};
  if (!static_modes.empty()) {
    Json static_frequencies = Json::array(), static_damping = Json::array();
    for (const ModeOf& m : static_modes) {
      static_frequencies.push_back(number(m.frequency));
      static_damping.push_back(number(bases[m.structure].damping(m.mode)));
    }
    out["static_frequencies_hz"] = static_frequencies;
    out["static_damping"] = static_damping;
  }
  if (bases.size() > 1)
    out["structure"] = structure;
  out["error_estimate"] = errors;
  out["effective_mass_kg"] = masses;
  out["effective_mass_sum_kg"] = triple(kept);
  out["moving_mass_kg"] = triple(moving);
  out["orthogonality"] = number(orthogonality);
  out["distributed"] = distributed;
  return out;
}

/// Under the names of the figures they belong to; null where the window has too few batches.
Json standard_error(const post::StandardErrors& e) {
  return {{"work_rate", number(e.work_rate)},
          {"friction_power", number(e.friction_power)},
          {"impacts_per_second", number(e.impact_rate)},
          {"contact_time_ratio", number(e.contact_time_ratio)},
          {"normal_force",
           {{"mean", number(e.normal_mean)}, {"rms", number(e.normal_rms)}, {"max", number(e.normal_max)}}},
          {"displacement", {{"y", {{"std", number(e.y_std)}}}, {"z", {{"std", number(e.z_std)}}}}},
          {"batches", number(e.batches)},
          {"work_rate_batches", number(e.work_rate_batches)}};
}

/// Null where nothing was measured.
Json step_error(const RunResults& results, const transient::StepError& of) {
  if (results.step_errors.empty() || of.parts == 0)
    return nullptr;
  Json out{{"intervals", of.parts}};
  for (const RelativeError& e : relative_errors(of))
    out[e.name] = {{"relative", number(e.value)}, {"standard_error", number(e.standard_error)}};
  return out;
}

Json flexibility(const std::optional<StaticFlexibility>& f) {
  if (!f)
    return nullptr;
  return {{"exact", number(f->exact)}, {"basis", number(f->basis)}, {"missing", number(f->missing)}};
}

/// By name of the side, of obstacles of several.
Json sides(const ContactFacts& facts, const post::SideWorks& works) {
  Json out = Json::object();
  for (const contact::Side& side : facts.sides) {
    const post::SideWork& w = works[side.number];
    out[side.name] = {
        {"work_rate", number(w.work_rate)},
        {"standard_error", {{"work_rate", number(w.error)}, {"work_rate_batches", number(w.batches)}}}};
  }
  return out;
}

Json contact(const ContactFacts& facts, const post::ContactSummary& c) {
  const ContactPosition position = position_of(facts, c);
  const Json radial{{"rms", number(c.radial_rms)}, {"max", number(c.radial_max)}};
  Json out{{"name", facts.name},
           {"impacts", c.impacts},
           {"impacts_per_second", number(c.impact_rate)},
           {"contact_time_ratio", number(c.contact_time_ratio)},
           {"normal_force",
            {{"mean", number(c.normal_mean)}, {"rms", number(c.normal_rms)}, {"max", number(c.normal_max)}}},
           {"normal_force_in_contact",
            {{"mean", number(c.normal_in_contact_mean)}, {"rms", number(c.normal_in_contact_rms)}}},
           {"tangential_force", {{"rms", number(c.tangential_rms)}, {"max", number(c.tangential_max)}}},
           {"displacement", {{"y", moments(c.y)}, {"z", moments(c.z)}, {"radial", radial}}},
           {"position", {{"y", moments(position.y)}, {"z", moments(position.z)}, {"radial", radial}}},
           {"penetration", {{"max", number(c.penetration_max)}}},
           {"work_rate", number(c.work_rate)},
           {"friction_power", number(c.friction_power)},
           {"impact_velocity",
            {{"mean", number(c.impact_velocity_mean)},
             {"rms", number(c.impact_velocity_rms)},
             {"max", number(c.impact_velocity_max)}}},
           {"contact_duration",
            {{"mean", number(c.contact_duration_mean)}, {"max", number(c.contact_duration_max)}}},
           {"departure_velocity",
            {{"mean", number(c.departure_velocity_mean)}, {"max", number(c.departure_velocity_max)}}},
           {"energy", {{"damping_J", number(c.damping_work)}, {"friction_J", number(c.friction_work)}}},
           {"sliding_distance_m", number(c.sliding_distance)},
           {"impulse_Ns", number(c.impulse)},
           // nothing sticks or slides where there is no friction
           {"sticking_ratio", facts.friction_static > 0.0 ? number(c.sticking_ratio) : Json(nullptr)},
           {"standard_error", standard_error(c.error)},
           {"static_flexibility", flexibility(facts.static_flexibility)}};
  if (!facts.sides.empty())
    out["sides"] = sides(facts, c.sides);
  return out;
}

Json contact_sums(const RunResults& results) {
  double work = 0.0, friction = 0.0, impacts = 0.0;
  for (const post::ContactSummary& c : results.contact_summaries) {
    work += c.work_rate;
    friction += c.friction_power;
    impacts += c.impact_rate;
  }
  const post::StandardErrors& e = results.errors_of_sums;
  return {{"work_rate", number(work)},
          {"friction_power", number(friction)},
          {"impacts_per_second", number(impacts)},
          {"standard_error",
           {{"work_rate", number(e.work_rate)},
            {"friction_power", number(e.friction_power)},
            {"impacts_per_second", number(e.impact_rate)},
            {"batches", number(e.batches)},
            {"work_rate_batches", number(e.work_rate_batches)}}},
          {"step_error", step_error(results, sum_of(results.step_errors))}};
}

Json compared(const std::vector<post::ComparedFigure>& figures) {
  Json out = Json::array();
  for (const post::ComparedFigure& f : figures)
    out.push_back({{"name", f.name},
                   {"value", number(f.value)},
                   {"value_at_half_step", number(f.at_half)},
                   {"difference", number(f.difference())},
                   {"standard_error", number(f.error)},
                   {"agrees", f.agrees}});
  return out;
}

Json verification(const Verification& v, const std::vector<ContactFacts>& contacts) {
  if (!v.failure.empty())
    return {{"agrees", false}, {"failure", v.failure}};
  Json by_contact = Json::array();
  for (std::size_t c = 0; c < v.contacts.size(); ++c)
    by_contact.push_back({{"name", contacts[c].name}, {"figures", compared(v.contacts[c])}});
  return {{"agrees", disagreement(v, contacts).differ == 0},
          {"step_max_s", number(v.step_max)},
          {"factor", {{"sums", post::factor_of_sums}, {"contacts", number(v.factor)}}},
          {"sums", compared(v.sums)},
          {"contacts", by_contact}};
}

Json error_estimate_json(const RunResults& results) {
  const ErrorEstimate estimate = error_estimate(results);
  return {{"kind", name_of(estimate.kind)}, {"relative", number(estimate.relative)}, {"text", estimate.text}};
}

Json node(const std::string& name, const post::NodeSummary& n) {
  return {{"name", name},
          {"displacement",
           {{"x", moments(n.displacement[0])},
            {"y", moments(n.displacement[1])},
            {"z", moments(n.displacement[2])}}},
          {"standard_error",
           {{"displacement",
             {{"x", {{"std", number(n.std_error[0])}}},
              {"y", {{"std", number(n.std_error[1])}}},
              {"z", {{"std", number(n.std_error[2])}}}}},
            {"batches", number(n.batches)}}}};
}

Json energy(const EnergyTotals& e) {
  Json out = {{"input_J", number(e.input)},
              {"initial_J", number(e.initial)},
              {"stored_J", number(e.stored)},
              {"modal_damping_J", number(e.modal_damping)},
              {"contact_damping_J", number(e.contact_damping)},
              {"friction_J", number(e.friction)},
              {"residual_relative", number(e.residual_relative)}};
  if (e.fluid != 0.0) // with a law of fluidelastic forces
    out["fluid_J"] = number(e.fluid);
  return out;
}

Json transient(const TransientTotals& t, const RunResults& results) {
  return {{"scheme", t.scheme},
          {"steps", t.steps},
          {"rejected", t.rejected},
          {"force_evaluations", t.evaluations},
          {"step_min_s", number(t.step_min)},
          {"step_max_s", number(t.step_max)},
          {"step_reason", t.step_reason},
          {"scheme_reason", t.scheme_reason},
          {"contact_frequency_rad_s", number(t.contact_frequency)},
          {"resolution",
           {{"w_c_h", number(t.resolution.contact)},
            {"w_t_h", number(t.resolution.stick)},
            {"w_s_h", number(t.resolution.structure)},
            {"r_t_h", number(t.resolution.damper)},
            {"w_max_h", number(t.resolution.highest_mode)}}},
          {"scaled_modes", {{"count", t.scaled_modes}, {"frequency_hz", number(t.fastest_hz)}}},
          {"outcome", t.diverged ? "diverged" : "done"},
          {"unconverged_steps", t.unconverged},
          {"duration_s", number(results.duration)},
          {"end_time_s", number(t.end_time)},
          {"statistics_from_s", number(results.statistics_from)}};
}

Json timings(const Timings& t) {
  return {{"read", number(t.read)},     {"mesh", number(t.mesh)},   {"assembly", number(t.assembly)},
          {"modes", number(t.modes)},   {"basis", number(t.basis)}, {"transient", number(t.transient)},
          {"output", number(t.output)}, {"total", number(t.total)}};
}

/// `key=value` as {"key", "value"}: the value as JSON has it, text where it is none.
Json overrides(const std::vector<std::string>& all) {
  Json out = Json::array();
  for (const std::string& text : all) {
    const std::size_t equals = text.find('=');
    const std::string value = text.substr(equals + 1);
    Json parsed = Json::parse(value, nullptr, false);
    out.push_back({{"key", text.substr(0, equals)}, {"value", parsed.is_discarded() ? Json(value) : parsed}});
  }
  return out;
}

void add_transient(Json& out, const RunResults& results) {
  assert(results.contact_summaries.size() == results.contacts.size());
  assert(results.node_summaries.size() == results.node_names.size());
  const TransientTotals totals = add_up(results.transients);
  out["contacts"] = Json::array();
  for (std::size_t c = 0; c < results.contacts.size(); ++c) {
    out["contacts"].push_back(contact(results.contacts[c], results.contact_summaries[c]));
    out["contacts"].back()["step_error"] =
        results.step_errors.empty() ? Json(nullptr) : step_error(results, results.step_errors[c]);
  }
  if (!results.contacts.empty())
    out["contact_sums"] = contact_sums(results);
  if (results.verification)
    out["verification"] = verification(*results.verification, results.contacts);
  if (results.wear) {
    std::vector<std::string> names;
    for (const ContactFacts& facts : results.contacts)
      names.push_back(facts.name);
    out["wear"] = wear_json(*results.wear, names);
  }
  out["error_estimate"] = error_estimate_json(results);
  out["nodes"] = Json::array();
  for (std::size_t n = 0; n < results.node_names.size(); ++n)
    out["nodes"].push_back(node(results.node_names[n], results.node_summaries[n]));
  add_forces(out, results);
  for (const MotionFacts& m : results.motions)
    out["motions"].push_back({{"name", m.name},
                              {"largest_acceleration_m_s2", number(m.largest)},
                              {"largest_at_s", number(m.time)},
                              {"largest_displacement_m", number(m.displacement)},
                              {"rows", m.rows},
                              {"record_s", m.rows > 0 ? Json{m.record_from, m.record_to} : Json(nullptr)}});
  out["energy"] = energy(totals.energy);
  out["transient"] = transient(totals, results);
}

} // namespace

void write_summary(const std::filesystem::path& file, const RunResults& results) {
  const RunRecord& record = results.record;
  Json out{{"version", record.version}, {"study", record.title}, {"ranks", record.ranks}};
  out["seed"] = record.seeds.empty() ? Json(nullptr) : Json(record.seeds.front());
  out["seeds"] = record.seeds;
  out["input_sha256"] = record.input_sha256;
  out["overrides"] = overrides(record.overrides);
  out["model"] = model(results.model);
  out["modes"] = modes(results.bases);
  if (!results.closed_frequencies.empty())
    out["closed_contacts_hz"] = results.closed_frequencies;
  if (const auto& limit = results.modes_limit)
    out["modes"]["limit"] = {{"accuracy", number(limit->accuracy)},
                             {"up_to_hz", number(limit->up_to)},
                             {"contact", limit->contact},
                             {"contact_frequency_hz", number(limit->contact_frequency)}};
  add_flow(out, results);
  if (!results.transients.empty())
    add_transient(out, results);
  out["timings_s"] = timings(results.timings);
  out["warnings"] = all_warnings(results);
  out["notes"] = all_notes(results);
  out["libraries"] = record.libraries;
  out["vector_width"] = record.vector_width;
  out["files_sha256"] = digests_of_tables(file.parent_path());
  save_summary(file, std::move(out));
}

} // namespace fretwork::results
