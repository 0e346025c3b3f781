// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/slepc_structures.hpp"
#include "core/mpi.hpp"
#include "core/share_out.hpp"
#include "modal/copies.hpp"

namespace fretwork::modal {
namespace {

/// A structure of more free dofs than this is solved over all ranks unless asked otherwise: below, one rank
/// is faster (a distributed factorisation costs 5 to 7 times a serial one) and the result does not depend on
/// the number of ranks.
constexpr core::Index distribute_above = 300'000;

} // namespace

bool is_distributed(MPI_Comm comm, const fem::Structure& structure, std::optional<bool> asked) {
  return core::size(comm) > 1 && asked.value_or(structure.equations > distribute_above);
}

std::vector<Basis> solve_structures(MPI_Comm comm, const fem::Model& model,
                                    const std::vector<fem::Structure>& structures, const Wanted& wanted,
                                    std::optional<bool> distributed) {
  const int ranks = core::size(comm), here = core::rank(comm);
  const std::vector<std::size_t> original = originals(model, structures);
  std::vector<std::size_t> alone; // solved by one rank
  std::vector<double> costs;
  std::vector<Basis> bases(structures.size());
  for (std::size_t s = 0; s < structures.size(); ++s) {
    if (original[s] != s)
      continue;
    if (is_distributed(comm, structures[s], distributed)) {
      core::agree(comm, [&] { bases[s] = solve_modes(comm, model, structures[s], wanted); });
      continue;
    }
    alone.push_back(s);
    costs.push_back(structures[s].equations);
  }
  const std::vector<int> owner = core::share_out(costs, ranks);
  core::agree(comm, [&] {
    for (std::size_t k = 0; k < alone.size(); ++k)
      if (owner[k] == here)
        bases[alone[k]] = solve_modes(MPI_COMM_SELF, model, structures[alone[k]], wanted);
  });
  for (std::size_t k = 0; k < alone.size(); ++k)
    broadcast(comm, owner[k], bases[alone[k]]);
  for (std::size_t s = 0; s < structures.size(); ++s) {
    if (original[s] != s)
      bases[s] = bases[original[s]];
    bases[s].nodes = structures[s].nodes;
  }
  return bases;
}

} // namespace fretwork::modal
