// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/wear_of_run.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace fretwork::app {
namespace {

constexpr int history_steps = 40; ///< of depth against time

/// Work rates of a contact in this run.
ContactRates rates_of_contact(const results::RunResults& run, std::size_t contact) {
  const post::ContactSummary& statistics = run.contact_summaries[contact];
  ContactRates out{{statistics.work_rate, statistics.error.work_rate, statistics.error.work_rate_batches},
                   {}};
  for (std::size_t side = 0; side < out.sides.size(); ++side) {
    const post::SideWork& own = statistics.sides[side];
    out.sides[side] = StatedRate{own.work_rate, own.error, own.batches};
  }
  return out;
}

wear::WorkRate scaled(const wear::WorkRate& rate, double factor) {
  wear::WorkRate out = rate;
  out.value *= factor;
  out.low *= factor;
  out.high *= factor;
  return out;
}

/// Mean over the states, by their shares of the time.
wear::WorkRate mean_of_states(const std::vector<results::WearStateRate>& states) {
  std::vector<wear::WorkRate> weighted;
  for (const auto& state : states)
    weighted.push_back(scaled(state.work_rate, state.share));
  return wear::sum_of_points(weighted);
}

/// Work of this run by angular sector in the axes of the first contact, sum over the contacts of a support. A quarter turn that is no whole
/// number of sectors goes to the next one.
std::vector<double> sum_of_sectors(const results::RunResults& run, const WornPlace& place) {
  std::vector<double> sum;
  for (std::size_t c = 0; c < place.contacts.size(); ++c) {
    const std::vector<double>& own = run.sector_rates[place.contacts[c]];
    sum.resize(own.size(), 0.0);
    for (std::size_t k = 0; k < sum.size(); ++k)
      sum[(k + (place.turns[c] * sum.size() + 2) / 4) % sum.size()] += own[k];
  }
  return sum;
}

/// Shares of the volume that the sectors wear; equal ones where nothing slides.
std::vector<double> shares_of(const std::vector<double>& rates) {
  double sum = 0.0;
  for (const double rate : rates)
    sum += rate;
  std::vector<double> shares;
  for (const double rate : rates)
    shares.push_back(sum > 0.0 ? rate / sum : 1.0 / static_cast<double>(rates.size()));
  return shares;
}

/// Si and Sg of all contacts of a support.
std::optional<wear::ImpactSliding> indices_of(const study::Wear& entry, const results::RunResults& run,
                                              const std::vector<std::size_t>& contacts,
                                              results::WearOfSupport& facts) {
  if (!(entry.kwu_maxima.force > 0.0))
    return {};
  wear::KwuClasses all(entry.kwu_maxima.force, entry.kwu_maxima.speed);
  for (const std::size_t c : contacts)
    all.add(run.force_speed_classes[c].value());
  const wear::ImpactSliding found = all.indices(entry.kwu);
  facts.impact_index = found.impact;
  facts.sliding_index = found.sliding;
  facts.share_above = all.share_above();
  return found;
}

/// Appends a list against time; where the law does not apply, as many times without a value.
void append(const std::vector<wear::DepthAt>& history, std::size_t times, double share,
            std::vector<double> results::WearCurves::*which, results::WornScar& out) {
  for (std::size_t i = 0; i < times; ++i) {
    const bool applies = i < history.size();
    const auto depth = applies ? history[i].depth : std::nullopt;
    (out.volume.*which).push_back(applies ? history[i].tube_volume / share : results::no_value);
    (out.support_volume.*which).push_back(applies ? history[i].support_volume / share : results::no_value);
    (out.depth.*which).push_back(depth ? depth->tube : results::no_value);
    (out.support_depth.*which).push_back(depth ? depth->support : results::no_value);
  }
}

std::string name_of(wear::LifeEnd end) {
  switch (end) {
  case wear::LifeEnd::reached:
    return "reached";
  case wear::LifeEnd::never:
    return "never";
  case wear::LifeEnd::outside_law:
    return "outside_law";
  case wear::LifeEnd::beyond_geometry:
    return "beyond_geometry";
  }
  return {};
}

/// The upper end of the work rate gives the short life.
results::WearLife life_of(const wear::TimeToLimit& value, const wear::TimeToLimit& at_low,
                          const wear::TimeToLimit& at_high) {
  return {name_of(value.end), {value.years(), at_high.years(), at_low.years()}};
}

void set_scar(const wear::WornSupport& worn, results::WornScar& out) {
  const auto* shared = std::get_if<wear::SharedScar>(&worn.pairing);
  const double depth = out.depth.last().value + out.support_depth.last().value;
  if (!shared || std::isnan(depth) || depth > wear::largest_depth(shared->geometry))
    return;
  const wear::Scar scar = wear::scar(shared->geometry, depth);
  out.scar_width = scar.width;
  out.scar_length = scar.length;
  out.scar_half_angle = scar.half_angle;
}

/// Depth of every sector at the last time, from its share of the volumes.
void set_sector_depths(const wear::WornSupport& worn, const std::vector<double>& shares,
                       results::WearOfSupport& out) {
  for (const double share : shares) {
    const auto depth =
        wear::depths(worn.pairing, share * out.volume.last().value, share * out.support_volume.last().value);
    out.sector_depth.push_back(depth ? depth->tube : results::no_value);
    out.sector_support_depth.push_back(depth ? depth->support : results::no_value);
  }
}

/// Volume, depth and life of a scar.
/// @param share  of the work rates of its states that is counted: of the sector with most
void set_histories(const wear::WornSupport& worn, const std::vector<double>& time,
                   const std::optional<wear::ImpactSliding>& indices, double share, results::WornScar& out) {
  std::vector<wear::UncertainState> states;
  for (const auto& state : out.states)
    states.push_back({state.share, scaled(state.work_rate, share), indices});
  const wear::DepthHistory history = wear::depth_history(worn, states, time);
  append(history.value, time.size(), share, &results::WearCurves::value, out);
  append(history.low, time.size(), share, &results::WearCurves::low, out);
  append(history.high, time.size(), share, &results::WearCurves::high, out);
  if (history.outside)
    out.outside = history.outside->text;
  out.initial_depth = worn.initial_depth;
  if (const auto before = wear::initial_wear(worn, states); before && before->age > 0.0)
    out.initial_years = before->age / wear::year;
  const wear::Life life = wear::time_to_limit(worn, states);
  out.life = life_of(life.value.tube, life.at_low.tube, life.at_high.tube);
  if (life.value.support)
    out.support_life = life_of(*life.value.support, *life.at_low.support, *life.at_high.support);
  set_scar(worn, out);
}

std::vector<double> times_over(double years) {
  std::vector<double> out;
  for (int k = 0; k <= history_steps; ++k)
    out.push_back(years * wear::year * k / history_steps);
  return out;
}

/// Work rates of the operating states of a place.
class StateRates {
public:
  StateRates(const study::Study& study, const WornPlace& place, const std::vector<PlacedContact>& placed,
             const OtherRuns& others, const results::RunResults& run)
      : entry_(study.wear[place.entry]), place_(place), placed_(placed), others_(others.rates[place.entry]),
        run_(run) {}

  /// @param side  null: all of the support
  [[nodiscard]] std::vector<results::WearStateRate> of(const WornSide* side) const {
    std::vector<results::WearStateRate> out;
    for (std::size_t j = 0; j < entry_.states.size(); ++j) {
      const study::WearState& state = entry_.states[j];
      out.push_back(
          {state.name, state.share, state.given ? of_given(*state.given, side) : of_state(j, side)});
    }
    return out;
  }

private:
  [[nodiscard]] wear::WorkRate of_state(std::size_t j, const WornSide* side) const {
    std::vector<wear::WorkRate> points;
    const auto add = [&](const WornSide::Part& part) {
      const ContactRates rates =
          others_[j] ? others_[j]->at(placed_[part.contact].name) : rates_of_contact(run_, part.contact);
      points.push_back(rates.at(part.side).with(entry_.confidence));
    };
    if (side)
      std::for_each(side->parts.begin(), side->parts.end(), add);
    else
      for (const std::size_t c : place_.contacts)
        add({c, {}});
    return wear::sum_of_points(points);
  }

  /// A rate that the study gives has the shares of this run; where nothing slides in it, one side bears all.
  [[nodiscard]] wear::WorkRate of_given(const wear::WorkRate& given, const WornSide* side) const {
    if (!side)
      return given;
    double own = 0.0, sum = 0.0;
    for (const WornSide& other : place_.sides)
      for (const WornSide::Part& part : other.parts) {
        const double rate = rates_of_contact(run_, part.contact).at(part.side).value;
        sum += rate;
        own += other.name == side->name ? rate : 0.0;
      }
    return scaled(given, sum > 0.0 ? own / sum : side->name == place_.sides.front().name ? 1.0 : 0.0);
  }

  const study::Wear& entry_;
  const WornPlace& place_;
  const std::vector<PlacedContact>& placed_;
  const std::vector<std::optional<std::map<std::string, ContactRates>>>& others_;
  const results::RunResults& run_;
};

bool is_at_rest(const std::vector<results::WearStateRate>& states) {
  return std::all_of(states.begin(), states.end(),
                     [](const auto& state) { return !(state.work_rate.high > 0.0); });
}

/// The scar of each side, and the support from them. A side at which nothing slides does not wear, by any law.
void add_sides(const WornPlace& place, const StateRates& rates,
               const std::optional<wear::ImpactSliding>& indices, results::WearOfSupport& support) {
  for (const WornSide& worn_side : place.sides) {
    results::WearOfSide side;
    side.name = worn_side.name;
    side.states = rates.of(&worn_side);
    side.work_rate = mean_of_states(side.states);
    wear::WornSupport worn = place.worn;
    if (is_at_rest(side.states))
      worn.tube = worn.support = wear::Archard{0.0};
    worn.initial_depth = worn_side.initial_depth;
    set_histories(worn, support.time, indices, 1.0, side);
    support.sides.push_back(std::move(side));
  }
  results::combine_sides(support);
}

/// One scar, or by sector the deepest of them.
void add_scar(const WornPlace& place, const std::optional<wear::ImpactSliding>& indices,
              results::WearOfSupport& support) {
  const bool by_sector = std::holds_alternative<wear::SectorPair>(place.worn.pairing);
  const std::vector<double> shares = shares_of(support.sector_rates);
  set_histories(place.worn, support.time, indices,
                by_sector ? *std::max_element(shares.begin(), shares.end()) : 1.0, support);
  if (by_sector)
    set_sector_depths(place.worn, shares, support);
}

/// The place with its scars about a corner of their lands, where they are those of broached holes.
std::optional<WornPlace> about_corners(const WornPlace& place, const std::vector<PlacedContact>& placed) {
  WornPlace out = place;
  auto* shared = std::get_if<wear::SharedScar>(&out.worn.pairing);
  auto* lands =
      shared && shared->form == wear::Form::exact ? std::get_if<wear::Lands>(&shared->geometry) : nullptr;
  if (!lands || !std::all_of(place.contacts.begin(), place.contacts.end(), [&](std::size_t c) {
        return std::holds_alternative<contact::BroachedSpace>(placed[c].obstacle) &&
               !contact::sides_of(placed[c].obstacle).empty();
      }))
    return {};
  lands->middles = {lands->half_angle};
  return out;
}

/// Volume, depth and life of all scars of a support, which has its states and times.
void add_scars(const WornPlace& place, const StateRates& rates,
               const std::optional<wear::ImpactSliding>& indices, results::WearOfSupport& support) {
  if (place.sides.empty())
    add_scar(place, indices, support);
  else
    add_sides(place, rates, indices, support);
}

/// How much of the work of this run is at corners of lands, and what a scar about a corner would be.
void set_corners(const WornPlace& place, const std::vector<PlacedContact>& placed, const StateRates& rates,
                 const std::optional<wear::ImpactSliding>& indices, const results::RunResults& run,
                 results::WearOfSupport& support) {
  double work = 0.0, at_corners = 0.0;
  for (const std::size_t c : place.contacts) {
    work += run.contact_summaries[c].work_rate;
    at_corners += run.contact_summaries[c].corner_work_rate;
  }
  const std::optional<WornPlace> corners = about_corners(place, placed);
  if (!corners || !(work > 0.0))
    return;
  support.corner_share = at_corners / work;
  results::WearOfSupport about = support; // without scars yet
  add_scars(*corners, rates, indices, about);
  support.corner_depth = about.depth.last().value;
  support.corner_years = about.life.years.value;
}

} // namespace

void add_wear(const study::Study& study, const std::vector<WornPlace>& places,
              const std::vector<PlacedContact>& placed, const OtherRuns& others, results::RunResults& out) {
  if (places.empty() || !others.complete())
    return;
  out.wear.emplace();
  for (const WornPlace& place : places) {
    const study::Wear& entry = study.wear[place.entry];
    results::WearOfSupport support = place.facts;
    support.confidence = entry.confidence;
    const auto structure = modal::structure_of(out.bases, placed[place.contacts.front()].node);
    support.tube = structure ? static_cast<std::int64_t>(*structure) : -1;
    const auto indices = indices_of(entry, out, place.contacts, support);
    const StateRates rates(study, place, placed, others, out);
    support.states = rates.of(nullptr);
    support.work_rate = mean_of_states(support.states);
    support.sector_rates = sum_of_sectors(out, place);
    support.time = times_over(entry.years);
    set_corners(place, placed, rates, indices, out, support);
    add_scars(place, rates, indices, support);
    out.wear->supports.push_back(std::move(support));
  }
  out.wear->tubes = results::wear_by_tube(out.wear->supports);
}

} // namespace fretwork::app
