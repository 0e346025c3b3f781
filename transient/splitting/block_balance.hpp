// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The terms of the energy balance that belong to modes in blocks (modes/linear_flow.hpp). Each step adds works of loads and contact forces. Energy of the
/// modes and work of the fluid are found where a record is asked for them; until then the balance counts the blocks without damping and fluid, whose
/// residual is the same.
#pragma once
#include "transient/modes/linear_flow.hpp"
#include "transient/scene/scheme.hpp"
#include <cmath>
#include <cstdint>

namespace fretwork::transient {

struct BlockBalance {
  LinearFlow::BlockWorks works; ///< since the start
  double fluid_work = 0.0;      ///< J, when it was found last for the scale
  std::int64_t records = 0;     ///< since then
  void visit(core::StateArchive& state) { state(works, fluid_work, records); }

  /// After each step: what the fluid's work adds to the scale of the balance, J, that of many records being taken as one. No allocation.
  double add_to_scale(LinearFlow& modes, const LinearFlow::State& end) {
    constexpr std::int64_t records_of_scale = 256;
    if (++records < records_of_scale)
      return 0.0;
    records = 0;
    const double before = fluid_work;
    fluid_work = modes.energies(end, works).fluid_work;
    return std::abs(fluid_work - before);
  }

  /// The balance with damping and fluid of the blocks.   @param end  state to which it belongs
  [[nodiscard]] Energy whole(Energy e, LinearFlow& modes, const LinearFlow::State& end) const {
    const LinearFlow::BlockEnergies found = modes.energies(end, works);
    const double growth = found.stored - modes.undamped_energy(works);
    e.fluid_work += found.fluid_work;
    e.modal_damping += found.fluid_work - growth;
    e.stored += growth;
    e.scale += std::abs(found.fluid_work - fluid_work);
    return e;
  }
};

} // namespace fretwork::transient
