// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_terms.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

/// 1/s: at which the dampers of contacts stop them; those of Hunt and Crossley at any rate.
double stopping_rate(const StepChoice& c) {
  return c.hunt_crossley ? unbounded : std::max(c.damper_rate, c.normal_damper_rate);
}

std::array<StepTerm, 2> contact_terms_within(const StepChoice& c, const StepBound& bound,
                                             const char* condition = "") {
  return {{{"the contact frequency", "w_c h", c.contact_frequency, "rad/s", bound, condition},
           {"the frequency of sticking contacts", "w_t h", c.stick_frequency, "rad/s", bound, condition}}};
}

} // namespace

double followed_modes(const StepChoice& c, double step) {
  return stopping_rate(c) * step > fast_damper ? mode_with_fast_damper
                                               : limits_of(SchemeKind::splitting).highest_mode.largest;
}

StepTerm mode_term(const StepChoice& c, bool contacts, double followed) {
  const SchemeLimits& limits = limits_of(c.scheme);
  StepTerm out{"the highest mode", "w_max h", c.highest_mode, "rad/s", limits.highest_mode};
  if (limits.exact_modes && !contacts)
    out.bound.share = mode_without_contacts;
  if (c.scheme == SchemeKind::splitting && followed < out.bound.largest) {
    out.bound.largest = followed;
    const bool normal = c.normal_damper_rate > c.damper_rate;
    out.condition = c.hunt_crossley ? ", with Hunt and Crossley's dampers"
                    : normal        ? ", with normal dampers"
                                    : ", with tangential dampers";
    out.cure = c.hunt_crossley ? ""
               : normal        ? "; a smaller normal_damping makes the step longer"
                               : smaller_tangential;
  }
  return out;
}

StepTerm mode_term(const StepChoice& c, bool contacts) {
  const double most = limits_of(SchemeKind::splitting).highest_mode.largest, stopping = stopping_rate(c),
               slow = stopping > 0.0 ? fast_damper * c.highest_mode / stopping : most;
  return mode_term(c, contacts, std::clamp(slow, mode_with_fast_damper, most));
}

StepTerm normal_damper_term(const StepChoice& c) {
  const SchemeLimits& limits = limits_of(c.scheme);
  return {.name = "the normal dampers' rate",
          .symbol = "r_n h",
          .rate = c.normal_damper_rate,
          .unit = "1/s",
          .bound = limits.normal_damper.times(limits.intervals),
          .spoiled = limits.by_normal_damper,
          .shortest = {finest_for_normal_dampers / c.contact_frequency, unbounded}};
}

std::array<StepTerm, 2> contact_terms(const StepChoice& c) {
  return contact_terms_within(c, limits_of(c.scheme).contact);
}

std::array<StepTerm, 2> contact_terms_beside_modes(const StepChoice& c) {
  std::array<StepTerm, 2> out = contact_terms_within(c, contact_beside_modes, ", with fast modes");
  for (StepTerm& term : out)
    term.shortest = {fast_mode / c.highest_mode, fast_mode / c.highest_mode};
  return out;
}

std::array<StepTerm, 3> damper_terms(const StepChoice& c) {
  const SchemeLimits& limits = limits_of(c.scheme);
  return {{{"the tangential dampers' rate", "r_t h", c.damper_rate, "1/s",
            limits.tangential_damper.times(limits.intervals), "",
            limits.intervals > 1 ? smaller_tangential
                                 : "; a smaller tangential_damping makes the step longer (scheme = "
                                   "\"splitting\" resolves the dampers within a step)"},
           normal_damper_term(c),
           {"the dampers' rate", "r_e h", c.explicit_rate, "1/s", limits.tangential_damper}}};
}

} // namespace fretwork::transient
