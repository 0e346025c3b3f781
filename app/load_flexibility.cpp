// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/load_flexibility.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "modal/static_flexibility.hpp"
#include "modal/static_solvers.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// Of the nodes of a structure, 6 rows each.
Eigen::VectorXd on_structure(const Eigen::VectorXd& force, const modal::Basis& basis) {
  Eigen::VectorXd out(core::dofs_per_node * static_cast<Eigen::Index>(basis.nodes.size()));
  for (std::size_t k = 0; k < basis.nodes.size(); ++k)
    out.segment<core::dofs_per_node>(core::dofs_per_node * static_cast<Eigen::Index>(k)) =
        force.segment<core::dofs_per_node>(core::dofs_per_node * static_cast<Eigen::Index>(basis.nodes[k]));
  return out;
}

/// Work of a load on a structure at rest, J.
struct Work {
  double exact = 0.0, of_modes = 0.0;

  [[nodiscard]] double missing_share() const { return exact > 0.0 ? 1.0 - of_modes / exact : 0.0; }
};

} // namespace

void warn_of_load_flexibility(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                              const std::vector<fem::Structure>& structures,
                              const std::vector<modal::Basis>& bases, Fields& fields) {
  std::string text;
  core::agree(comm, [&] {
    if (core::rank(comm) != 0)
      return;
    modal::StaticSolvers solvers(model, structures);
    std::vector<std::string> names;
    double most = 0.0;
    try {
      for (std::size_t l = 0; l < std::min(study.loads.size(), most_loads); ++l) {
        Work work;
        for (std::size_t s = 0; s < bases.size(); ++s) {
          const Eigen::VectorXd force = on_structure(fields.loads[l].force, bases[s]);
          if (force.isZero(0.0))
            continue;
          work.exact += force.dot(solvers.of(s).solve(force).col(0));
          work.of_modes += modal::flexibility_of(bases[s], force)(0, 0);
        }
        if (work.missing_share() > much_deflection)
          names.push_back(fields.loads[l].name);
        most = std::max(most, work.missing_share());
      }
    } catch (const core::Error&) { // of the static solution, which the run does without
      return;
    } catch (const core::ComputationError&) {
      return;
    }
    if (!names.empty())
      text = fmt::format(
          "modal truncation: the modes lack up to {:.0f} % of the static deflection under {}; ask "
          "for more modes by modes.up_to_hz or modes.count",
          100.0 * most, fmt::join(names, ", "));
  });
  core::broadcast(comm, 0, text);
  if (!text.empty())
    fields.warnings.push_back(text);
}

} // namespace fretwork::app
