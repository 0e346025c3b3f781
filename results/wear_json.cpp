// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/wear_json.hpp"
#include "results/json_number.hpp"

namespace fretwork::results {
namespace {

Json numbers(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values)
    out.push_back(number(value));
  return out;
}

Json bounds(const Bounds& b) {
  return {{"value", number(b.value)}, {"low", number(b.low)}, {"high", number(b.high)}};
}

Json rate(const wear::WorkRate& w) {
  return {{"value", number(w.value)},
          {"low", number(w.low)},
          {"high", number(w.high)},
          {"has_interval", w.has_interval},
          {"low_at_zero", w.low_at_zero}};
}

Json life(const WearLife& l) {
  if (l.end.empty())
    return nullptr;
  Json out{{"end", l.end}};
  out.update(bounds(l.years));
  return out;
}

Json states(const std::vector<WearStateRate>& all) {
  Json out = Json::array();
  for (const WearStateRate& state : all)
    out.push_back(
        {{"name", state.name}, {"share", number(state.share)}, {"work_rate", rate(state.work_rate)}});
  return out;
}

Json geometry(const WearOfSupport& s) {
  return {{"kind", s.geometry},
          {"form", s.form},
          {"tube_radius_m", number(s.radius)},
          {"wall_m", number(s.wall)},
          {"length_m", number(s.length)},
          {"clearance_m", number(s.clearance)},
          {"inclination_rad", number(s.inclination)}};
}

Json sectors(const WearOfSupport& s) {
  Json out{{"count", s.sector_rates.size()}, {"work_rate", numbers(s.sector_rates)}};
  if (!s.sector_depth.empty()) {
    out["depth_m"] = numbers(s.sector_depth);
    out["support_depth_m"] = numbers(s.sector_support_depth);
  }
  return out;
}

/// Figures of one scar, after the years asked for.
Json scar(const WornScar& s) {
  return {{"outside_law", s.outside.empty() ? Json(nullptr) : Json(s.outside)},
          {"initial_depth_m", number(s.initial_depth)},
          {"initial_years", number(s.initial_years)},
          {"volume_m3", bounds(s.volume.last())},
          {"depth_m", bounds(s.depth.last())},
          {"support_volume_m3", bounds(s.support_volume.last())},
          {"support_depth_m", bounds(s.support_depth.last())},
          {"scar",
           {{"width_m", number(s.scar_width)},
            {"length_m", number(s.scar_length)},
            {"half_angle_rad", number(s.scar_half_angle)}}},
          {"life_years", life(s.life)},
          {"support_life_years", life(s.support_life)}};
}

Json sides(const WearOfSupport& s) {
  Json out = Json::array();
  for (const WearOfSide& side : s.sides) {
    out.push_back(
        {{"name", side.name}, {"states", states(side.states)}, {"work_rate", rate(side.work_rate)}});
    out.back().update(scar(side));
  }
  return out;
}

Json support(const WearOfSupport& s, const std::vector<std::string>& contacts) {
  Json names = Json::array();
  for (const std::int64_t c : s.contacts)
    names.push_back(contacts.at(static_cast<std::size_t>(c)));
  Json out{{"name", s.name},
           {"contacts", names},
           {"tube", s.tube},
           {"law", s.law},
           {"coefficient_m2_per_N", number(s.coefficient)},
           {"coefficient_source", s.source},
           {"support_coefficient_m2_per_N", number(s.support_coefficient)},
           {"geometry", geometry(s)},
           {"limit_m", number(s.limit)},
           {"support_limit_m", number(s.support_limit)},
           {"states", states(s.states)},
           {"work_rate", rate(s.work_rate)},
           {"years", s.time.empty() ? Json(nullptr) : number(s.time.back() / fretwork::wear::year)}};
  out.update(scar(s));
  if (!s.sides.empty())
    out["sides"] = sides(s);
  if (!std::isnan(s.corner_share))
    out["corners"] = {{"work_share", number(s.corner_share)},
                      {"depth_m", number(s.corner_depth)},
                      {"life_years", number(s.corner_years)}};
  out["sectors"] = sectors(s);
  if (s.confidence)
    out["confidence"] = *s.confidence;
  if (!std::isnan(s.impact_index))
    out["kwu_epri"] = {{"impact_index", number(s.impact_index)},
                       {"sliding_index", number(s.sliding_index)},
                       {"share_above_maxima", number(s.share_above)}};
  return out;
}

Json tube(const WearOfTube& t) {
  return {{"tube", t.tube},
          {"supports", t.supports},
          {"work_rate", rate(t.work_rate)},
          {"volume_m3", bounds(t.volume)},
          {"depth_m", bounds(t.depth)},
          {"deepest_support", t.deepest.empty() ? Json(nullptr) : Json(t.deepest)},
          {"life_years", bounds(t.years)},
          {"first_support", t.first.empty() ? Json(nullptr) : Json(t.first)},
          {"first_body", t.body.empty() ? Json(nullptr) : Json(t.body)},
          {"unknown_lives", t.unknown_lives}};
}

Json by_stage(const WearCurves& c) {
  Json out = Json::array();
  for (std::size_t i = 0; i < c.value.size(); ++i)
    out.push_back(bounds({c.value[i], c.low[i], c.high[i]}));
  return out;
}

Json gap_opening(const Wear& wear) {
  const GapOpening& opening = *wear.opening;
  Json years = Json::array(), supports = Json::array();
  for (const double time : opening.time)
    years.push_back(number(time / fretwork::wear::year));
  for (std::size_t s = 0; s < opening.supports.size(); ++s) {
    const OpenedSupport& opened = opening.supports[s];
    supports.push_back({{"name", wear.supports[s].name},
                        {"gap_m", numbers(opened.gap)},
                        {"work_rate", by_stage(opened.work_rate)},
                        {"depth_m", by_stage(opened.depth)},
                        {"support_depth_m", by_stage(opened.support_depth)},
                        {"life_years", life(opened.life)},
                        {"support_life_years", life(opened.support_life)}});
  }
  return {{"end", opening.end},
          {"reason", opening.reason.empty() ? Json(nullptr) : Json(opening.reason)},
          {"years", years},
          {"supports", supports}};
}

} // namespace

Json wear_json(const Wear& wear, const std::vector<std::string>& contacts) {
  Json supports = Json::array(), tubes = Json::array();
  for (const WearOfSupport& s : wear.supports)
    supports.push_back(support(s, contacts));
  for (const WearOfTube& t : wear.tubes)
    tubes.push_back(tube(t));
  Json out{{"supports", supports}, {"tubes", tubes}};
  if (wear.opening)
    out["gap_opening"] = gap_opening(wear);
  return out;
}

} // namespace fretwork::results
