// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_terms.hpp"
#include <algorithm>

namespace fretwork::transient {

double longest_for_tables(const StepChoice& c) {
  if (c.scheme != SchemeKind::splitting)
    return c.table_interval;
  const double contacts = std::max(c.contact_frequency, c.stick_frequency);
  return std::max(table_share * c.table_interval,
                  std::min(c.table_interval, contact_beside_tables / contacts)); // infinite without contacts
}

StepTerm mode_term(const StepChoice& c, bool contacts) {
  const SchemeLimits& limits = limits_of(c.scheme);
  StepTerm out{"the highest mode", "w_max h", c.highest_mode, "rad/s", limits.highest_mode};
  if (limits.exact_modes && !contacts)
    out.bound.share = mode_without_contacts;
  return out;
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

std::array<StepTerm, 3> contact_terms(const StepChoice& c) {
  const StepBound& bound = limits_of(c.scheme).contact;
  const double fastest = std::max(c.contact_frequency, c.stick_frequency);
  return {{{"the contact frequency", "w_c h", c.contact_frequency, "rad/s", bound},
           {"the frequency of sticking contacts", "w_t h", c.stick_frequency, "rad/s", bound},
           {.name = "the structure's frequency at contacts",
            .symbol = "w_s h",
            .rate = c.scheme == SchemeKind::splitting ? c.structure_frequency : 0.0,
            .unit = "rad/s",
            .bound = structure_at_contacts,
            .shortest = contact_beside_structure.times(1.0 / fastest),
            .never_warned = contact_beside_structure.largest / fastest}}};
}

std::array<StepTerm, 3> damper_terms(const StepChoice& c) {
  const SchemeLimits& limits = limits_of(c.scheme);
  return {{{"the tangential dampers' rate", "r_t h", c.damper_rate, "1/s",
            limits.tangential_damper.times(limits.intervals),
            limits.intervals > 1 ? "; a smaller tangential_damping makes the step longer"
                                 : "; a smaller tangential_damping makes the step longer (scheme = "
                                   "\"splitting\" resolves the dampers within a step)"},
           normal_damper_term(c),
           {"the dampers' rate", "r_e h", c.explicit_rate, "1/s", limits.tangential_damper}}};
}

} // namespace fretwork::transient
