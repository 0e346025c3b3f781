// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/slepc_modes.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "fem/rigid_motions.hpp"
#include "modal/finish.hpp"
#include "modal/slepc_krylov.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::modal {
namespace {

/// Beyond this a dense solve takes minutes and gigabytes.
constexpr int largest_dense = 6000;
/// A frequency that is the limit to its last digits is within the limit.
constexpr double limit_margin = 1e-9;

void check(const Wanted& wanted) {
  if (wanted.count.has_value() == wanted.up_to_hz.has_value())
    throw core::Error("[modes]: give exactly one of count and up_to_hz");
  if (wanted.count && *wanted.count <= 0)
    throw core::Error(fmt::format("[modes] count = {}; give a number of modes > 0", *wanted.count));
  if (wanted.up_to_hz && !(*wanted.up_to_hz > 0.0 && std::isfinite(*wanted.up_to_hz)))
    throw core::Error(fmt::format("[modes] up_to_hz = {:g}; give a frequency > 0", *wanted.up_to_hz));
}

/// @throws core::Error where compressed beams buckle. Collective.
void check_stable(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
                  const Eigen::MatrixXd& rigid) {
  const bool compressed =
      std::any_of(structure.beams.begin(), structure.beams.end(), [&](core::Index number) {
        const fem::Beam& beam = model.beams[static_cast<std::size_t>(number)];
        return model.properties[static_cast<std::size_t>(beam.property)].axial_force < 0.0;
      });
  if (compressed && !is_stable(comm, model, structure, rigid))
    throw core::Error("the structure that starts at node " +
                      fem::place(model.nodes[static_cast<std::size_t>(structure.nodes.front())]) +
                      " buckles under the compression of its beams ([[beams]] axial_force < 0): lower it, or "
                      "support the structure better");
}

Cut cut_of(const Wanted& wanted) {
  Cut cut;
  if (wanted.count)
    cut.count = *wanted.count;
  else
    cut.omega = 2.0 * std::numbers::pi * *wanted.up_to_hz * (1.0 + limit_margin);
  cut.whole_groups = wanted.whole_groups;
  return cut;
}

/// The elastic modes up to the cut and some more; none, and `dense` set, where so many are wanted that a
/// dense solve must serve.
Pairs iterate(const KrylovModes& krylov, Eigen::Index rigid, const Cut& cut, bool& dense) {
  const int count = std::isinf(cut.omega)
                        ? static_cast<int>(cut.count - rigid)
                        : krylov.below(krylov.reach(cut.omega * cut.omega)) - static_cast<int>(rigid);
  dense = 3 * (count + 10) > krylov.massive(); // the space must hold twice as many vectors and leave a choice
  if (dense || count <= 0)
    return {};
  Pairs found = krylov.lowest(count);
  dense = found.lambda.size() == 0;
  return found;
}

} // namespace

Basis solve_modes(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
                  const Wanted& wanted) {
  check(wanted);
  Basis basis;
  basis.nodes = structure.nodes;
  if (structure.equations == 0) {
    basis.shapes.resize(static_cast<Eigen::Index>(structure.nodes.size()) * core::dofs_per_node, 0);
    basis.participation.resize(0, 3);
    basis.complete = true;
    return basis;
  }
  const Cut cut = cut_of(wanted);
  const Eigen::MatrixXd rigid = fem::rigid_motions(model, structure);
  check_stable(comm, model, structure, rigid);
  Pairs pairs{Eigen::VectorXd(0), Eigen::MatrixXd(structure.equations, 0)};
  bool dense = structure.equations <= wanted.dense_up_to;
  if (!dense) {
    const KrylovModes krylov(comm, model, structure, rigid);
    Pairs found = iterate(krylov, rigid.cols(), cut, dense);
    if (found.lambda.size() > 0)
      pairs = std::move(found);
  }
  if (dense && structure.equations > largest_dense)
    throw core::ComputationError(
        fmt::format("[modes]: a third of the {} modes of a structure, or more, is wanted; ask for "
                    "fewer modes",
                    structure.equations));
  core::agree(comm, [&] {
    if (core::rank(comm) != 0)
      return;
    basis = finish(model, structure, rigid, dense ? dense_modes(model, structure, rigid) : pairs, cut);
    basis.complete = basis.complete && dense; // iteration finds some of them
  });
  broadcast(comm, 0, basis);
  basis.nodes = structure.nodes;
  basis.distributed = !dense && core::size(comm) > 1;
  return basis;
}

void broadcast(MPI_Comm comm, int root, Basis& basis) {
  core::broadcast(comm, root, basis.shapes);
  core::broadcast(comm, root, basis.omega);
  core::broadcast(comm, root, basis.error);
  core::broadcast(comm, root, basis.damping);
  core::broadcast(comm, root, basis.damping_matrix);
  core::broadcast(comm, root, basis.residuals);
  core::broadcast(comm, root, basis.participation);
  MPI_Bcast(basis.moving_mass.data(), 3, MPI_DOUBLE, root, comm);
  MPI_Bcast(&basis.static_modes, 1, MPI_INT64_T, root, comm);
  MPI_Bcast(&basis.orthogonality, 1, MPI_DOUBLE, root, comm);
  MPI_Bcast(&basis.splits_group, 1, MPI_CXX_BOOL, root, comm);
  MPI_Bcast(&basis.complete, 1, MPI_CXX_BOOL, root, comm);
  MPI_Bcast(&basis.distributed, 1, MPI_CXX_BOOL, root, comm);
}

} // namespace fretwork::modal
