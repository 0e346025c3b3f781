// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gap_opening.hpp"
#include "app/opened_contacts.hpp"
#include "core/error.hpp"
#include "results/figures.hpp"
#include "wear/gap_opening.hpp"
#include "wear/sectors.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::app {
namespace {

using results::no_value;
using wear::OperatingState;
using wear::PlaceState;
using wear::WornBody;

/// The work rate and the two ends of its interval.
enum class End : std::size_t { value, low, high };
constexpr std::array ends{End::value, End::low, End::high};
constexpr std::size_t at(End end) { return static_cast<std::size_t>(end); }
constexpr std::array<double wear::WorkRate::*, 3> rate_at{&wear::WorkRate::value, &wear::WorkRate::low,
                                                          &wear::WorkRate::high};
constexpr std::array<std::vector<double> results::WearCurves::*, 3> curve_at{
    &results::WearCurves::value, &results::WearCurves::low, &results::WearCurves::high};
/// The upper end of the work rate gives the short life.
constexpr std::array<double results::Bounds::*, 3> life_at{&results::Bounds::value, &results::Bounds::high,
                                                           &results::Bounds::low};

/// Operating states of a scar at one end of their intervals, or of a share of its work.
std::vector<OperatingState> loads_of(const results::WearOfSupport& support, const results::WornScar& scar,
                                     End end, double share) {
  std::vector<OperatingState> out;
  for (const results::WearStateRate& state : scar.states) {
    OperatingState load{state.share, share * state.work_rate.*rate_at[at(end)], {}};
    if (!std::isnan(support.impact_index))
      load.indices = wear::ImpactSliding{support.impact_index, support.sliding_index};
    out.push_back(load);
  }
  return out;
}

bool by_sector(const WornPlace& place) {
  return std::holds_alternative<wear::SectorPair>(place.worn.pairing);
}

/// The places of a support: one, its sides, or its sectors.
struct OpenedPlaces {
  std::size_t first, count;
};

/// Keeps the state of wear from stage to stage.
class Opening {
public:
  Opening(const study::Study& study, const std::vector<WornPlace>& worn,
          const std::vector<PlacedContact>& placed, const std::vector<results::ContactFacts>& facts)
      : options_(*study.gap_opening), worn_(worn), placed_(placed) {
    for (const WornPlace& place : worn) {
      const auto of_contact = [&](std::size_t c) {
        return wear::Place{place.worn, std::max(0.0, facts[c].gap), place.name};
      };
      const std::size_t count = by_sector(place) ? static_cast<std::size_t>(study.wear[place.entry].sectors)
                                                 : std::max<std::size_t>(1, place.sides.size());
      supports_.push_back({places_.size(), count});
      places_.insert(places_.end(), count, of_contact(place.contacts.front()));
      for (std::size_t k = 0; k < place.sides.size(); ++k) {
        wear::Place& side = places_[supports_.back().first + k];
        side = of_contact(place.sides[k].parts.front().contact);
        side.support.initial_depth = place.sides[k].initial_depth;
      }
    }
    for (auto& lives : lives_)
      lives.assign(places_.size(), {no_life, no_life, no_life});
    outside_.assign(worn.size(), false);
    out_.supports.resize(worn.size());
  }

  /// Wears at the work rates of a stage until the next one is due. @return what comes next
  wear::Progress advance(const results::Wear& stage) {
    set_loads(stage);
    if (states_.empty())
      states_ = states_at_start();
    wear::AdvanceOptions options{options_.years * wear::year - time_, options_.gap_share, options_.wall_share,
                                 options_.least_wall_share};
    std::vector<PlaceState> states;
    std::vector<std::vector<OperatingState>> loads;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      states.push_back(*states_[k][at(End::value)]);
      loads.push_back(loads_[k][at(End::value)]);
    }
    const wear::Advance next = wear::advance(places_, states, loads, options);
    record_begin(stage);
    for (std::size_t k = 0; k < places_.size(); ++k)
      for (const End end : ends)
        wear_on(k, end, next.time);
    time_ += next.time;
    record_end();
    return next.progress;
  }

  [[nodiscard]] std::vector<PlacedContact> opened() const {
    std::vector<PlacedContact> out = placed_;
    for (std::size_t s = 0; s < worn_.size(); ++s) {
      const std::vector<PlaceState> worn = values(supports_[s]);
      for (const std::size_t c : worn_[s].contacts)
        if (by_sector(worn_[s]))
          out[c].obstacle = contact::Profile(wear::opened_profile(worn));
        else if (worn_[s].sides.empty())
          out[c].obstacle = opened_obstacle(placed_[c].obstacle, worn.front().opened);
        else
          open_contact(c, worn_[s].sides, worn, out[c]);
    }
    return out;
  }

  [[nodiscard]] results::GapOpening result(const std::string& end, const std::string& reason) && {
    out_.end = end;
    out_.reason = reason;
    for (std::size_t s = 0; s < worn_.size(); ++s) {
      out_.supports[s].life = life_of(s, WornBody::tube);
      if (worn_[s].worn.support_limit)
        out_.supports[s].support_life = life_of(s, WornBody::support);
    }
    return std::move(out_);
  }

private:
  /// By place and end; nothing: beyond its geometry.
  using States = std::vector<std::array<std::optional<PlaceState>, 3>>;
  static constexpr double no_life = std::numeric_limits<double>::infinity();

  [[nodiscard]] results::WearLife life_of(std::size_t s, WornBody body) const {
    if (outside_[s])
      return {"outside_law", {no_value, no_value, no_value}};
    results::WearLife out;
    for (const End which : ends)
      out.years.*life_at[at(which)] = life_of(supports_[s], body, which) / wear::year;
    out.end = std::isnan(out.years.value)   ? "beyond_geometry"
              : std::isinf(out.years.value) ? "never"
                                            : "reached";
    return out;
  }

  /// Each side of a contact by its own depth. @param worn  as `sides`
  static void open_contact(std::size_t contact, const std::vector<WornSide>& sides,
                           const std::vector<PlaceState>& worn, PlacedContact& placed) {
    SideGrowth growth{};
    for (std::size_t k = 0; k < sides.size(); ++k)
      for (const WornSide::Part& part : sides[k].parts) {
        if (part.contact != contact)
          continue;
        if (!part.side) { // its only one
          placed.obstacle = opened_obstacle(placed.obstacle, worn[k].opened);
          return;
        }
        growth[*part.side] = worn[k].opened;
      }
    open_sides(growth, placed);
  }

  void set_loads(const results::Wear& stage) {
    loads_.clear();
    for (std::size_t s = 0; s < worn_.size(); ++s) {
      const results::WearOfSupport& support = stage.supports[s];
      outside_[s] = outside_[s] || support.life.end == "outside_law";
      double sum = 0.0;
      for (const double rate : support.sector_rates)
        sum += rate;
      for (std::size_t k = 0; k < supports_[s].count; ++k) {
        const auto count = static_cast<double>(supports_[s].count);
        const double share = !by_sector(worn_[s]) ? 1.0
                             : sum > 0.0          ? support.sector_rates[k] / sum
                                                  : 1.0 / count;
        const results::WornScar& scar =
            worn_[s].sides.empty() ? static_cast<const results::WornScar&>(support) : support.sides[k];
        loads_.push_back({loads_of(support, scar, End::value, share),
                          loads_of(support, scar, End::low, share),
                          loads_of(support, scar, End::high, share)});
      }
    }
  }

  /// W, mean over the states.
  [[nodiscard]] double work_rate(std::size_t k) const {
    double out = 0.0;
    for (const OperatingState& state : loads_[k][at(End::value)])
      out += state.share * state.work_rate;
    return out;
  }

  /// By the loads of the first stage. Sectors are of the age of the one with the most work, whose depth is the initial one of the tube.
  [[nodiscard]] States states_at_start() const {
    States out;
    for (std::size_t s = 0; s < worn_.size(); ++s) {
      const auto [first, count] = supports_[s];
      std::size_t most = first;
      for (std::size_t k = first; k < first + count; ++k)
        if (work_rate(k) > work_rate(most))
          most = k;
      std::array<double, 3> age{}; // of sectors
      if (by_sector(worn_[s]))
        for (const End end : ends)
          age[at(end)] = place_at_start(places_[most], loads_[most][at(end)]).age;
      for (std::size_t k = first; k < first + count; ++k) {
        auto& states = out.emplace_back();
        for (const End end : ends) {
          const auto& loads = loads_[k][at(end)];
          states[at(end)] = age[at(end)] > 0.0 ? place_of_age(places_[k], loads, age[at(end)])
                                               : place_at_start(places_[k], loads);
        }
      }
    }
    return out;
  }

  /// Wear of a place over a time; a limit lost within it is its life.
  void wear_on(std::size_t k, End end, double time) {
    auto& state = states_[k][at(end)];
    if (!state)
      return;
    auto after = state_after(places_[k], *state, loads_[k][at(end)], time);
    for (const WornBody body : {WornBody::tube, WornBody::support})
      if (!after || depth_of(after->depth, body) >= limit_of(places_[k].support, body))
        if (const double life = life_from_here(k, body, end); !std::isnan(life))
          life_at_place(k, body, end) = std::min(life_at_place(k, body, end), life);
    state = std::move(after);
  }

  [[nodiscard]] double& life_at_place(std::size_t k, WornBody body, End end) {
    return lives_[static_cast<std::size_t>(body)][k][at(end)];
  }

  /// s, at the present work rates; infinity: never; not a number: the wear leaves its geometry before.
  [[nodiscard]] double life_from_here(std::size_t k, WornBody body, End end) const {
    return time_ + time_to_limit(places_[k], *states_[k][at(end)], loads_[k][at(end)], body);
  }

  /// That of its first sector, s; infinity: never; not a number: the wear leaves its geometry before.
  [[nodiscard]] double life_of(const OpenedPlaces& support, WornBody body, End end) const {
    double first = no_life;
    bool beyond = false;
    for (std::size_t k = support.first; k < support.first + support.count; ++k) {
      const double from_here = states_[k][at(end)] ? life_from_here(k, body, end) : no_value;
      beyond = beyond || std::isnan(from_here);
      first = std::min({first, lives_[static_cast<std::size_t>(body)][k][at(end)],
                        std::isnan(from_here) ? no_life : from_here});
    }
    return beyond && std::isinf(first) ? no_value : first;
  }

  /// At the work rates themselves.
  [[nodiscard]] std::vector<PlaceState> values(const OpenedPlaces& of) const {
    std::vector<PlaceState> out;
    for (std::size_t k = of.first; k < of.first + of.count; ++k)
      out.push_back(*states_[k][at(End::value)]);
    return out;
  }

  void record_begin(const results::Wear& stage) {
    for (std::size_t s = 0; s < worn_.size(); ++s) {
      double gap = 0.0;
      for (const PlaceState& state : values(supports_[s]))
        gap = std::max(gap, state.gap);
      out_.supports[s].gap.push_back(gap);
      for (const End end : ends)
        (out_.supports[s].work_rate.*curve_at[at(end)])
            .push_back(stage.supports[s].work_rate.*rate_at[at(end)]);
    }
  }

  void record_end() {
    out_.time.push_back(time_);
    for (std::size_t s = 0; s < worn_.size(); ++s)
      for (const End end : ends) {
        const wear::PairDepth depth = deepest(supports_[s], end);
        (out_.supports[s].depth.*curve_at[at(end)]).push_back(depth.tube);
        (out_.supports[s].support_depth.*curve_at[at(end)]).push_back(depth.support);
      }
  }

  /// Of the sector in which the tube has lost most; not numbers where one is beyond its geometry.
  [[nodiscard]] wear::PairDepth deepest(const OpenedPlaces& of, End end) const {
    wear::PairDepth out{0.0, 0.0};
    for (std::size_t k = of.first; k < of.first + of.count; ++k) {
      if (!states_[k][at(end)])
        return {no_value, no_value};
      if (states_[k][at(end)]->depth.tube >= out.tube)
        out = states_[k][at(end)]->depth;
    }
    return out;
  }

  const study::GapOpening& options_;
  const std::vector<WornPlace>& worn_;
  const std::vector<PlacedContact>& placed_;
  std::vector<OpenedPlaces> supports_;
  std::vector<wear::Place> places_;
  States states_; ///< none before the first stage
  std::vector<std::array<std::vector<OperatingState>, 3>> loads_;
  std::array<std::vector<std::array<double, 3>>, 2> lives_; ///< s, by body, place and end
  std::vector<bool> outside_; ///< supports to which their law did not apply in a stage
  double time_ = 0.0;         ///< s
  results::GapOpening out_;
};

std::string name_of(wear::Progress progress) {
  switch (progress) {
  case wear::Progress::go_on:
    return "stages_used";
  case wear::Progress::geometry_stands:
    return "geometry_stands";
  case wear::Progress::life_reached:
    return "life_reached";
  case wear::Progress::horizon_reached:
    return "horizon_reached";
  }
  return {};
}

} // namespace

void check_gap_opening(const study::Study& study, const std::vector<WornPlace>& places,
                       const std::vector<PlacedContact>& placed) {
  if (!study.gap_opening)
    return;
  if (places.empty())
    throw core::Error("[gap_opening]: no active contact wears, so that no gap opens; leave it out");
  constexpr std::int64_t fewest_sectors = 3; // that enclose a hole
  for (const WornPlace& place : places)
    if (const study::Wear& entry = study.wear[place.entry];
        by_sector(place) && entry.sectors < fewest_sectors)
      throw core::Error(
          fmt::format("{}.sectors = {}: with [gap_opening] the sectors enclose the hole; give {} "
                      "or more",
                      entry.path, entry.sectors, fewest_sectors));
  for (const WornPlace& place : places)
    for (const std::size_t c : place.contacts)
      if (by_sector(place) && !opens_by_angle(placed[c]))
        throw core::Error(
            fmt::format("{}, contact \"{}\": with [gap_opening] only a circle or a drilled hole "
                        "with a gap > 0, not between two nodes, opens by sectors; give another geometry",
                        study.wear[place.entry].path, placed[c].name));
}

void open_gaps(const study::Study& study, const std::vector<WornPlace>& places,
               const std::vector<PlacedContact>& placed, const RunStage& run, results::RunResults& out) {
  if (!study.gap_opening || !out.wear)
    return;
  Opening opening(study, places, placed, out.contacts);
  const std::int64_t stages = study.gap_opening->stages;
  std::string reason, end;
  wear::Progress progress = wear::Progress::go_on;
  results::Wear rates = *out.wear;
  for (std::int64_t stage = 1;; ++stage) {
    std::vector<PlacedContact> opened;
    try {
      progress = opening.advance(rates);
      if (progress != wear::Progress::go_on || stage == stages)
        break;
      opened = opening.opened();
    } catch (const core::Error& error) { // the stages so far stand
      reason = error.what();
      end = "beyond_geometry";
      break;
    }
    results::RunResults next;
    const auto stop = [&](const char* how, const std::exception& error) { // alike on all ranks
      reason = fmt::format("stage {}: {}", stage + 1, error.what());
      end = how;
    };
    try {
      next = run(opened, stage + 1);
    } catch (const core::Interrupted& error) {
      throw core::Interrupted(fmt::format("gap opening, stage {}: {}", stage + 1, error.what()));
    } catch (const core::ComputationError& error) { // it diverged, or found no static start
      stop("stage_failed", error);
      break;
    } catch (const core::Error& error) { // too long a run
      stop("stage_refused", error);
      break;
    }
    for (const std::string& warning : next.warnings)
      out.warnings.push_back(fmt::format("gap opening, stage {}: {}", stage + 1, warning));
    rates = std::move(*next.wear);
    for (const results::WearOfSupport& support : rates.supports)
      if (!support.outside.empty())
        out.warnings.push_back(fmt::format("gap opening, stage {}: wear of \"{}\": {}", stage + 1,
                                           support.name, support.outside));
  }
  if (!reason.empty())
    out.warnings.push_back("gap opening: " + reason);
  out.wear->opening = std::move(opening).result(reason.empty() ? name_of(progress) : end, reason);
  if (out.wear->opening->end == "stages_used")
    out.warnings.push_back(fmt::format("gap opening: {} after {:.3g} years, lives are those at the last work "
                                       "rates; give more gap_opening.stages",
                                       results::counted(stages, "stage"),
                                       out.wear->opening->time.back() / wear::year));
}

study::Study without_series(const study::Study& study) {
  study::Study out = study;
  out.output.every = study.transient->duration;
  out.output.modal = false;
  out.output.nodes.clear();
  out.output.impacts = 0;
  out.transient->verify = false;
  return out;
}

} // namespace fretwork::app
