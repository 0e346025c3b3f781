// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_flexibility.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/share_out.hpp"
#include "fem/petsc_static.hpp"
#include "modal/copies.hpp"
#include "modal/static_flexibility.hpp"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>

namespace fretwork::app {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Below this share of the largest, how modes move a contact is the eigensolver's round-off.
constexpr double round_off_of_shapes = 1e-11;

/// Factors by the structure that is solved for all its copies.
using Solvers = std::map<std::size_t, fem::StaticSolver>;

/// The parts of a model that the flexibilities are made from.
struct Parts {
  const study::Study& study;
  const fem::Model& model;
  const std::vector<fem::Structure>& structures;
  const std::vector<std::size_t>& originals;
  const std::vector<modal::Basis>& bases;
  const std::vector<PlacedContact>& placed;
  const std::vector<Fields::Load>& loads;
};

/// Unit forces along x_loc y_loc z_loc of contacts on the nodes of a structure, 6 n x 3 nc; 0 where it has not the node.
MatrixXd unit_forces(const Parts& parts, const std::vector<std::size_t>& contacts,
                     const modal::Basis& basis) {
  MatrixXd forces = MatrixXd::Zero(basis.shapes.rows(), static_cast<Index>(3 * contacts.size()));
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PlacedContact& placed = parts.placed[contacts[k]];
    const Eigen::Matrix3d axes = placed.frame.rotation().transpose();
    const auto column = static_cast<Index>(3 * k);
    for (const fem::NodeShare& share : placed.motion)
      if (const Index row = basis.row_of(share.node); row >= 0)
        forces.block<6, 3>(row, column) += share.weights.transpose() * axes;
    if (placed.other < 0)
      continue;
    if (const Index row = basis.row_of(placed.other); row >= 0)
      forces.block<3, 3>(row, column) -= axes;
  }
  return forces;
}

/// The unit forces that act on a structure: numbers of their columns among all, and these columns.
struct Forces {
  std::vector<Index> columns;
  MatrixXd values;
};
Forces forces_on(const Parts& parts, const std::vector<std::size_t>& contacts, const modal::Basis& basis) {
  const MatrixXd all = unit_forces(parts, contacts, basis);
  Forces out;
  for (Index j = 0; j < all.cols(); ++j)
    if (!all.col(j).isZero(0.0))
      out.columns.push_back(j);
  out.values = all(Eigen::all, out.columns);
  return out;
}

/// Part of a field over the model that belongs to a structure.
Eigen::VectorXd restricted(const modal::Basis& basis, const Eigen::VectorXd& field) {
  Eigen::VectorXd out(basis.shapes.rows());
  for (std::size_t i = 0; i < basis.nodes.size(); ++i)
    out.segment<6>(static_cast<Index>(6 * i)) = field.segment<6>(static_cast<Index>(basis.nodes[i]) * 6);
  return out;
}

/// Numbers of the columns that can be loaded.
std::vector<Index> loaded_directions(const Parts& parts, const std::vector<std::size_t>& contacts,
                                     const Eigen::VectorXd& moved) {
  std::vector<Index> loaded;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PlacedContact& placed = parts.placed[contacts[k]];
    const auto [y, z] = contact::normal_directions(placed.obstacle);
    const bool friction = parts.study.contacts[placed.entry].friction_static > 0.0;
    const bool normal[] = {false, y, z};
    for (Index d = 0; d < 3; ++d) {
      const Index column = static_cast<Index>(3 * k) + d;
      if (normal[d] || (friction && moved(column) > round_off_of_shapes * moved.maxCoeff()))
        loaded.push_back(column);
    }
  }
  return loaded;
}

const fem::StaticSolver& solver_of(const Parts& parts, std::size_t structure, Solvers& solvers) {
  const std::size_t original = parts.originals[structure];
  return solvers.try_emplace(original, parts.model, parts.structures[original]).first->second;
}

/// Adds what a structure gives to the flexibilities of the loaded directions.
/// @param forces  on its nodes, one loaded direction a column
/// @param among   their numbers among all loaded directions
void add_structure(const Parts& parts, std::size_t s, const MatrixXd& forces, const std::vector<Index>& among,
                   Solvers& solvers, ContactFlexibility& out) {
  const modal::Basis& basis = parts.bases[s];
  const MatrixXd u = solver_of(parts, s, solvers).solve(forces);
  out.exact(among, among) += forces.transpose() * u;
  out.basis(among, among) += modal::flexibility_of(basis, forces);
  if (parts.study.modes.static_modes == study::StaticModes::none)
    return; // nothing is moved beside the modes
  const MatrixXd gain = modal::static_gain(basis, forces);
  for (std::size_t l = 0; l < parts.loads.size(); ++l) {
    const Eigen::VectorXd load = restricted(basis, parts.loads[l].force);
    const Eigen::VectorXd all = u.transpose() * load, size = u.cwiseAbs().transpose() * load.cwiseAbs();
    const Eigen::VectorXd lacking = all - gain * (basis.shapes.transpose() * load);
    out.under_loads(among, static_cast<Index>(l)) +=
        (lacking.array().abs() > modal::negligible_share * size.array()).select(lacking, 0.0);
  }
}

/// Adds what a structure gives of the directions that are loaded and that it has forces along.
void add_loaded(const Parts& parts, std::size_t s, const Forces& forces, const std::vector<Index>& loaded,
                Solvers& solvers, ContactFlexibility& out) {
  std::vector<Index> columns, among;
  for (std::size_t j = 0; j < forces.columns.size(); ++j)
    if (const auto found = std::lower_bound(loaded.begin(), loaded.end(), forces.columns[j]);
        found != loaded.end() && *found == forces.columns[j]) {
      columns.push_back(static_cast<Index>(j));
      among.push_back(found - loaded.begin());
    }
  if (!columns.empty())
    add_structure(parts, s, forces.values(Eigen::all, columns), among, solvers, out);
}

/// Between all contacts, or where the scene does not take it, what the table tells: of each contact alone.
MatrixXd missing_flexibility(const Parts& parts, const std::vector<Index>& loaded,
                             const ContactFlexibility& of_loaded) {
  if (parts.study.modes.static_modes != study::StaticModes::none)
    return modal::missing_flexibility(of_loaded.exact, of_loaded.basis);
  MatrixXd out = MatrixXd::Zero(of_loaded.exact.rows(), of_loaded.exact.cols());
  for (std::size_t begin = 0, end = 0; begin < loaded.size(); begin = end) {
    while (end < loaded.size() && loaded[end] / 3 == loaded[begin] / 3)
      ++end;
    const auto first = static_cast<Index>(begin), size = static_cast<Index>(end - begin);
    out.block(first, first, size, size) = modal::missing_flexibility(
        of_loaded.exact.block(first, first, size, size), of_loaded.basis.block(first, first, size, size));
  }
  return out;
}

/// Rows and columns of the loaded directions among all.
MatrixXd among_all(const MatrixXd& some, const std::vector<Index>& loaded, Index all) {
  MatrixXd out = MatrixXd::Zero(all, all);
  out(loaded, loaded) = some;
  return out;
}

ContactFlexibility flexibility(const Parts& parts, const std::vector<std::size_t>& structures,
                               const std::vector<std::size_t>& contacts, Solvers& solvers) {
  ContactFlexibility out;
  std::vector<Forces> forces;
  const auto all = static_cast<Index>(3 * contacts.size());
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(all);
  for (const std::size_t s : structures) {
    const auto& [columns, of_columns] = forces.emplace_back(forces_on(parts, contacts, parts.bases[s]));
    const MatrixXd b = of_columns.transpose() * parts.bases[s].shapes;
    moved(columns) = moved(columns).cwiseMax(b.cwiseAbs().rowwise().maxCoeff());
  }
  const std::vector<Index> loaded = loaded_directions(parts, contacts, moved);
  const auto count = static_cast<Index>(loaded.size()), loads = static_cast<Index>(parts.loads.size());
  out.exact = out.basis = MatrixXd::Zero(count, count);
  out.under_loads = MatrixXd::Zero(count, loads);
  for (std::size_t i = 0; i < structures.size(); ++i)
    add_loaded(parts, structures[i], forces[i], loaded, solvers, out);
  out.missing = among_all(missing_flexibility(parts, loaded, out), loaded, all);
  out.exact = among_all(out.exact, loaded, all);
  out.basis = among_all(out.basis, loaded, all);
  MatrixXd under_loads = MatrixXd::Zero(all, loads);
  under_loads(loaded, Eigen::all) = out.under_loads;
  // a point that misses nothing is moved by the modes alone
  for (Index row = 0; row < all; ++row)
    if (!(out.missing(row, row) > 0.0))
      under_loads.row(row).setZero();
  out.under_loads = std::move(under_loads);
  return out;
}

/// The contacts that a scene has: one of their nodes belongs to it.
std::vector<std::size_t> contacts_of(const std::vector<modal::Basis>& bases,
                                     const std::vector<std::size_t>& structures,
                                     const std::vector<PlacedContact>& placed) {
  const auto has = [&](core::Index node) {
    return node >= 0 && std::any_of(structures.begin(), structures.end(),
                                    [&](std::size_t s) { return bases[s].row_of(node) >= 0; });
  };
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < placed.size(); ++c)
    if (has(placed[c].node) || has(placed[c].other))
      out.push_back(c);
  return out;
}

void broadcast(MPI_Comm comm, int root, ContactFlexibility& flexibility) {
  for (MatrixXd* matrix :
       {&flexibility.exact, &flexibility.basis, &flexibility.missing, &flexibility.under_loads})
    core::broadcast(comm, root, *matrix);
  core::broadcast(comm, root, flexibility.failure);
}

} // namespace

results::StaticFlexibility ContactFlexibility::at(std::size_t k, const contact::Obstacle& obstacle) const {
  const auto [y, z] = contact::normal_directions(obstacle);
  std::vector<Index> rows;
  for (const auto& [taken, d] : {std::pair{y, 1}, std::pair{z, 2}})
    if (taken)
      rows.push_back(static_cast<Index>(3 * k) + d);
  const auto principal = [&](const MatrixXd& matrix) {
    return Eigen::VectorXd(
        Eigen::SelfAdjointEigenSolver<MatrixXd>(MatrixXd(matrix(rows, rows))).eigenvectors().rightCols<1>());
  };
  const bool lacks = missing(rows, rows).diagonal().maxCoeff() > 0.0;
  const Eigen::VectorXd d = principal(lacks ? missing : exact);
  const auto along = [&](const MatrixXd& matrix) { return d.dot(matrix(rows, rows) * d); };
  return {along(exact), along(basis), along(missing)};
}

std::vector<ContactFlexibility>
contact_flexibilities(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                      const std::vector<fem::Structure>& structures, const std::vector<modal::Basis>& bases,
                      const std::vector<std::vector<std::size_t>>& scenes,
                      const std::vector<PlacedContact>& placed, const std::vector<Fields::Load>& loads) {
  const std::vector<std::size_t> originals = modal::originals(model, structures);
  const Parts parts{study, model, structures, originals, bases, placed, loads};
  std::vector<double> costs;
  std::vector<std::vector<std::size_t>> contacts;
  for (const auto& scene : scenes) {
    contacts.push_back(contacts_of(bases, scene, placed));
    double equations = 0.0;
    for (const std::size_t s : scene)
      equations += structures[s].equations;
    costs.push_back(equations * static_cast<double>(1 + contacts.back().size()));
  }
  const std::vector<int> owner = core::share_out(costs, core::size(comm));
  std::vector<ContactFlexibility> out(scenes.size());
  // where the scene does not take them, they are for the table only
  const auto fail = [&](const std::exception& error, ContactFlexibility& of_scene) {
    if (study.modes.static_modes != study::StaticModes::none)
      throw;
    of_scene.failure = error.what();
  };
  core::agree(comm, [&] {
    Solvers solvers;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (owner[i] != core::rank(comm) || contacts[i].empty())
        continue;
      try {
        out[i] = flexibility(parts, scenes[i], contacts[i], solvers);
      } catch (const core::Error& error) {
        fail(error, out[i]);
      } catch (const core::ComputationError& error) {
        fail(error, out[i]);
      }
    }
  });
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (core::size(comm) > 1)
      broadcast(comm, owner[i], out[i]);
    out[i].contacts = std::move(contacts[i]);
  }
  return out;
}

} // namespace fretwork::app
