// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/flow_json.hpp"
#include "results/flow_text.hpp"
#include "results/json_number.hpp"

namespace fretwork::results {
namespace {

Json list(const Eigen::VectorXd& values) {
  Json out = Json::array();
  for (const double value : values)
    out.push_back(number(value));
  return out;
}

Json terms(const flow::DampingTerms& t) {
  return {{"viscous", number(t.viscous)},
          {"two_phase", number(t.two_phase)},
          {"squeeze_film", number(t.squeeze_film)},
          {"friction", number(t.friction)},
          {"gas", number(t.gas)}};
}

Json mode_damping(const flow::ModeDamping& mode, const TubeDamping& tube, Eigen::Index i) {
  Json zones = Json::object();
  for (std::size_t z = 0; z < tube.zones.size(); ++z)
    zones[tube.zones[z]] = terms(mode.zones[z]);
  return {{"frequency_hz", number(tube.frequency(i))},
          {"assessed", mode.assessed},
          {"stability", number(mode.stability)},
          {"transient", number(mode.transient)},
          {"terms", terms(mode.sum)},
          {"left_to_contacts", terms(mode.contacts)},
          {"zones", zones}};
}

Json damping(const TubeDamping& tube) {
  Json modes = Json::array();
  for (std::size_t i = 0; i < tube.damping.modes.size(); ++i)
    modes.push_back(mode_damping(tube.damping.modes[i], tube, static_cast<Eigen::Index>(i)));
  return {{"tube", tube.tube},
          {"structure", tube.structure},
          {"length_m", number(tube.length)},
          {"spans", tube.damping.layout.spans},
          {"mean_span_m", number(tube.damping.layout.mean_span)},
          {"modes", modes},
          {"limits", tube.limits}};
}

Json stability_case(const flow::StabilityCase& one, const StabilityAssessment& assessment) {
  Json constants = Json::object();
  for (std::size_t z = 0; z < one.constants.size(); ++z)
    if (one.constants[z] > 0.0)
      constants[assessment.damping.zones[z]] = one.constants[z];
  Json out{{"connors_constants", constants},
           {"critical_mode", one.critical_mode < 0 ? Json(nullptr) : Json(one.critical_mode + 1)},
           {"margin", one.margin() ? number(*one.margin()) : Json(nullptr)},
           {"critical_scale", number(one.critical_scale())},
           {"ratios", list(one.ratio)},
           {"critical_velocities_m_s", list(one.critical_velocity)}};
  const Eigen::MatrixXd sweep = flow::velocity_sweep(one, assessment.sweep);
  Json rows = Json::array();
  for (Eigen::Index k = 0; k < sweep.rows(); ++k)
    rows.push_back({{"factor", assessment.sweep[static_cast<std::size_t>(k)]},
                    {"largest_ratio", number(sweep.cols() > 0 ? sweep.row(k).maxCoeff() : 0.0)},
                    {"unstable_modes", (sweep.row(k).array() >= 1.0).count()}});
  out["sweep"] = rows;
  return out;
}

Json crossing(const flow::Crossing& one, const LawStability& law) {
  const double hertz = flow::frequency_of(one.root);
  const auto reduced = law.reduced_velocity(one.factor, hertz);
  return {{"factor", number(one.factor)},
          {"velocity_m_s", number(one.factor * law.velocity)},
          {"frequency_hz", number(hertz)},
          {"reduced_velocity", reduced ? number(*reduced) : Json(nullptr)},
          {"mode", one.mode < 0 ? Json(nullptr) : Json(one.mode + 1)},
          {"becomes", one.to_unstable ? "unstable" : "stable"},
          {"outside_range", reduced && law.outside(*reduced)}};
}

Json law(const LawStability& of) {
  const flow::StabilityDiagram& diagram = of.diagram;
  Json modes = Json::array(), crossings = Json::array();
  for (Eigen::Index mode = 0; mode < diagram.roots.cols(); ++mode) {
    Json frequency = Json::array(), damping = Json::array(), growth = Json::array();
    for (const std::complex<double>& root : diagram.roots.col(mode)) {
      frequency.push_back(number(flow::frequency_of(root)));
      damping.push_back(number(flow::damping_of(root)));
      growth.push_back(number(root.real()));
    }
    const auto critical = of.critical_factor(mode);
    const LawStability::Mode& its = of.modes[static_cast<std::size_t>(mode)];
    modes.push_back({{"tube", its.tube},
                     {"mode", its.number + 1},
                     {"frequencies_hz", frequency},
                     {"dampings", damping},
                     {"growths_per_s", growth},
                     {"critical_factor", critical ? number(*critical) : Json(nullptr)},
                     {"connors_factor", number(its.connors)}});
  }
  for (const flow::Crossing& one : diagram.crossings)
    crossings.push_back(crossing(one, of));
  const flow::Crossing* critical = diagram.critical();
  return {{"tubes", of.tubes},
          {"velocity_m_s", number(of.velocity)},
          {"diameter_m", number(of.diameter)},
          {"range", of.range ? Json(*of.range) : Json(nullptr)},
          {"critical_factor", critical ? number(critical->factor) : Json(nullptr)},
          {"critical_velocity_m_s", critical ? number(critical->factor * of.velocity) : Json(nullptr)},
          {"crossings", crossings},
          {"factors", diagram.factors},
          {"modes", modes}};
}

Json power(const post::MeanPower& of) {
  return {{"mean", number(of.mean)}, {"standard_error", number(of.error)}};
}

Json law_motion(const LawMotion& of, const LawAtWork& law) {
  Json place = nullptr, growth = nullptr;
  if (const auto& p = of.place) {
    const double hertz = p->frequency.value_or(no_value);
    place = {{"kind", p->contact ? "contact" : "node"},
             {"name", p->name},
             {"axis", std::string(1, p->axis)},
             {"rms_m", number(p->rms)},
             {"largest_m", number(p->largest)},
             {"largest_of_diameter", number(p->largest / law.diameter)},
             {"frequency_hz", number(hertz)},
             {"frequency_resolution_hz", number(p->frequency ? p->resolution : no_value)},
             {"reduced_velocity", number(law.reduced_velocity(hertz))}};
  }
  if (const auto& g = of.growth)
    growth = {{"rate_per_s", number(g->rate)},
              {"standard_error_per_s", number(g->error)},
              {"rms_ratio", number(g->rms_ratio)},
              {"grows", g->significant}};
  const post::PowerBalance& p = of.power;
  return {{"place", place},
          {"later_from_s", number(of.later_from)},
          {"growth", growth},
          {"power_tubes", of.tubes},
          {"power_W",
           {{"loads", power(p.loads)},
            {"fluid", power(p.fluid)},
            {"modal_damping", power(p.modal_damping)},
            {"contact_damping", power(p.contact_damping)},
            {"friction", power(p.friction)},
            {"stored", power(p.stored)}}}};
}

Json law_at_work(const LawAtWork& of) {
  const auto& critical = of.critical_factor;
  return {{"tubes", of.tubes},
          {"unknowns", of.unknowns},
          {"growth_per_s", number(of.root.real())},
          {"frequency_hz", number(flow::frequency_of(of.root))},
          {"damping", number(flow::damping_of(of.root))},
          {"velocity_m_s", number(of.velocity)},
          {"reduced_velocity", number(of.root.imag() == 0.0 ? no_value : of.reduced_velocity())},
          {"critical_factor", critical ? number(*critical) : Json(nullptr)},
          {"critical_velocity_m_s", critical ? number(*critical * of.velocity) : Json(nullptr)},
          {"motion", of.motion ? law_motion(*of.motion, of) : Json(nullptr)}};
}

Json stability(const StabilityAssessment& assessment) {
  Json modes = Json::array(), cases = Json::array();
  for (std::size_t i = 0; i < assessment.stability.modes.size(); ++i) {
    const flow::ModeInFlow& mode = assessment.stability.modes[i];
    const flow::ModeDirection& direction = assessment.directions[i];
    const char* along = flow::key_of(direction.kind);
    modes.push_back({{"frequency_hz", number(mode.frequency)},
                     {"direction", along ? Json(along) : Json(nullptr)},
                     {"direction_share", number(along ? direction.share : no_value)},
                     {"damping", number(mode.damping)},
                     {"decrement", number(mode.decrement)},
                     {"effective_velocity_m_s", number(mode.effective_velocity)}});
  }
  for (const flow::StabilityCase& one : assessment.stability.cases)
    cases.push_back(stability_case(one, assessment));
  Json out{{"name", assessment.name},
           {"tube", assessment.damping.tube},
           {"pinned", assessment.pinned},
           {"elastic", assessment.elastic},
           {"sticking", assessment.sticking},
           {"damping_given", assessment.damping_given},
           {"modes", modes},
           {"cases", cases},
           {"damping", damping(assessment.damping)}};
  if (assessment.law)
    out["law"] = law(*assessment.law);
  return out;
}

Json response(const LinearResponse& r) {
  Json points = Json::array();
  for (const ResponsePoint& p : r.points)
    points.push_back({{"name", p.name},
                      {"direction", p.direction},
                      {"rms_m", number(p.rms)},
                      {"rms_velocity_m_s", number(p.rms_velocity)},
                      {"up_crossings_per_second", number(p.up_crossings)},
                      {"irregularity", number(p.irregularity)},
                      {"maximum_m", p.maximum ? number(*p.maximum) : Json(nullptr)},
                      {"share_outside", number(p.share_outside)},
                      {"share_above", number(p.share_above)}});
  return {{"name", r.name},
          {"pinned", r.pinned},
          {"modes", r.modes},
          {"lowest_mode", {{"frequency_hz", number(r.frequency)}, {"damping", number(r.damping)}}},
          {"damping_set", r.by_flow ? Json("stability") : Json(nullptr)},
          {"duration_s", r.duration},
          {"probability", r.probability},
          {"points", points}};
}

} // namespace

void add_flow(Json& out, const RunResults& results) {
  if (!results.flow_damping.empty()) {
    out["flow"] = Json::array();
    for (const TubeDamping& tube : results.flow_damping)
      out["flow"].push_back(damping(tube));
  }
  if (!results.stability.empty()) {
    out["stability"] = Json::array();
    for (const StabilityAssessment& assessment : results.stability)
      out["stability"].push_back(stability(assessment));
  }
  if (!results.laws.empty()) {
    out["fluidelastic"] = Json::array();
    for (const LawAtWork& one : results.laws)
      out["fluidelastic"].push_back(law_at_work(one));
  }
  if (!results.responses.empty()) {
    out["response"] = Json::array();
    for (const LinearResponse& one : results.responses)
      out["response"].push_back(response(one));
  }
}

} // namespace fretwork::results
