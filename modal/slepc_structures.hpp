// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modes of all structures of a model, over all ranks.
#pragma once
#include "modal/slepc_modes.hpp"
#include <vector>

namespace fretwork::modal {

/// Whether solve_structures solves it over all ranks.
/// @param asked  what the user says; without it those of more than 300 000 free dofs are
[[nodiscard]] bool is_distributed(MPI_Comm comm, const fem::Structure& structure, std::optional<bool> asked);

/// Collective; the same bytes on every rank, and, where no structure is distributed, for any number of ranks.
/// Copies of a structure take its modes; the others are shared out over ranks, each solved by one; a large one
/// is solved over all ranks.
/// @throws what solve_modes throws
[[nodiscard]] std::vector<Basis> solve_structures(MPI_Comm comm, const fem::Model& model,
                                                  const std::vector<fem::Structure>& structures,
                                                  const Wanted& wanted,
                                                  std::optional<bool> distributed = std::nullopt);

} // namespace fretwork::modal
