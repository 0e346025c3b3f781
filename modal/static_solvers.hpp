// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Static solutions of the structures of a model, of which copies share one factorisation.
#pragma once
#include "fem/petsc_static.hpp"
#include "modal/copies.hpp"
#include <map>

namespace fretwork::modal {

class StaticSolvers {
public:
  /// @param model, structures  must live longer
  StaticSolvers(const fem::Model& model, const std::vector<fem::Structure>& structures)
      : model_(model), structures_(structures), originals_(originals(model, structures)) {}

  /// Factorises where no copy of the structure was asked for before. Serial.
  /// @throws what fem::StaticSolver throws
  [[nodiscard]] const fem::StaticSolver& of(std::size_t structure) {
    const std::size_t original = originals_[structure];
    return solvers_.try_emplace(original, model_, structures_[original]).first->second;
  }

private:
  const fem::Model& model_;
  const std::vector<fem::Structure>& structures_;
  std::vector<std::size_t> originals_;
  std::map<std::size_t, fem::StaticSolver> solvers_;
};

} // namespace fretwork::modal
