// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/static_modes.hpp"
#include "app/build_scene.hpp"
#include "app/contact_loads.hpp"
#include "core/mpi.hpp"
#include "core/share_out.hpp"
#include "modal/damping.hpp"
#include "modal/slepc_modes.hpp"
#include "modal/static_modes.hpp"
#include "modal/static_solvers.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::app {
namespace {

/// The rank of every structure.
std::vector<int> owners(MPI_Comm comm, const std::vector<fem::Structure>& structures) {
  std::vector<double> costs;
  for (const fem::Structure& structure : structures)
    costs.push_back(structure.equations);
  return core::share_out(costs, core::size(comm));
}

/// The bases to which something was added, from the ranks that did.
void share(MPI_Comm comm, const std::vector<int>& owner, std::vector<modal::Basis>& bases) {
  for (std::size_t s = 0; s < bases.size(); ++s) {
    int added = bases[s].static_modes > 0 ? 1 : 0;
    MPI_Bcast(&added, 1, MPI_INT, owner[s], comm);
    if (added)
      modal::broadcast(comm, owner[s], bases[s]);
  }
}

} // namespace

void add_static_modes(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                      const std::vector<fem::Structure>& structures, const std::vector<PlacedContact>& placed,
                      std::vector<modal::Basis>& bases) {
  const std::vector<int> owner = owners(comm, structures);
  const auto mine = [&](std::size_t s) { return owner[s] == core::rank(comm); };
  core::agree(comm, [&] {
    modal::StaticSolvers solvers(model, structures);
    for (const std::vector<std::size_t>& scene : joined_structures(bases, placed, {})) {
      if (std::none_of(scene.begin(), scene.end(), mine))
        continue;
      const ContactLoads loads =
          contact_loads(study, bases, scene, placed, contacts_of(bases, scene, placed));
      for (std::size_t i = 0; i < scene.size(); ++i) {
        const std::size_t s = scene[i];
        const Eigen::MatrixXd& forces = loads.on[i].forces;
        if (!mine(s) || forces.cols() == 0)
          continue;
        modal::add_static_modes(model, structures[s], forces, solvers.of(s).solve(forces), bases[s]);
        if (bases[s].static_modes > 0)
          modal::apply_damping(bases[s], study.modes.damping);
      }
    }
  });
  if (core::size(comm) > 1)
    share(comm, owner, bases);
}

std::string static_modes_note(const study::Study& study, const std::vector<modal::Basis>& bases) {
  Eigen::Index count = 0;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const modal::Basis& basis : bases)
    if (basis.static_modes > 0) {
      count += basis.static_modes;
      low = std::min(low, basis.omega(basis.true_modes()));
      high = std::max(high, basis.omega(basis.size() - 1));
    }
  if (count == 0)
    return "no static modes: the modes lack nothing of the static flexibility at the contacts";
  const bool listed = std::holds_alternative<std::vector<double>>(study.modes.damping);
  return fmt::format("{} static modes at the contacts, {:.4g} to {:.4g} Hz, beside the modes{}", count,
                     low / (2.0 * std::numbers::pi), high / (2.0 * std::numbers::pi),
                     listed ? "; the list of modes.damping ends at the modes: static modes have the ratio of "
                              "the highest"
                            : "");
}

} // namespace fretwork::app
