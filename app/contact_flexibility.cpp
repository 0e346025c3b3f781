// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_flexibility.hpp"
#include "app/contact_loads.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/share_out.hpp"
#include "core/symmetric.hpp"
#include "fem/inner_motion.hpp"
#include "modal/static_flexibility.hpp"
#include "modal/static_solvers.hpp"
#include <algorithm>

namespace fretwork::app {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The parts of a model that the flexibilities are made from.
struct Parts {
  const study::Study& study;
  const fem::Model& model;
  const std::vector<fem::Structure>& structures;
  const std::vector<modal::Basis>& bases;
  const std::vector<PlacedContact>& placed;
  const std::vector<Fields::Load>& loads;
  const std::vector<TurbulentLoad>& turbulence;
};

/// Whether the scene takes what is missing beside its modes; otherwise it is for the table only.
bool in_series(const study::Study& study) {
  switch (study.modes.static_modes) {
  case study::StaticModes::none:
  case study::StaticModes::added:
    return false;
  case study::StaticModes::residual:
    return true;
  }
  return false;
}

/// Part of a field over the model that belongs to a structure.
Eigen::VectorXd part_of(const modal::Basis& basis, const Eigen::VectorXd& field) {
  Eigen::VectorXd out(basis.shapes.rows());
  for (std::size_t i = 0; i < basis.nodes.size(); ++i)
    out.segment<6>(static_cast<Index>(6 * i)) = field.segment<6>(static_cast<Index>(basis.nodes[i]) * 6);
  return out;
}

/// Flexibilities between the loaded directions: all of them, or of each contact alone: (i, direction of j) for directions i, j of one contact.
class LoadedFlexibility {
public:
  LoadedFlexibility(const std::vector<Index>& loaded, bool alone)
      : loaded_(loaded), alone_(alone),
        values_(MatrixXd::Zero(static_cast<Index>(loaded.size()),
                               alone ? 3 : static_cast<Index>(loaded.size()))) {}
  /// Adds a part between some of the directions.
  void add(const std::vector<Index>& among, const MatrixXd& part) {
    if (!alone_) {
      values_(among, among) += part;
      return;
    }
    for (std::size_t i = 0; i < among.size(); ++i)
      for (std::size_t j = 0; j < among.size(); ++j)
        if (contact(among[i]) == contact(among[j]))
          values_(among[i], direction(among[j])) += part(static_cast<Index>(i), static_cast<Index>(j));
  }
  [[nodiscard]] const MatrixXd& all() const { return values_; }
  /// Between the directions [first, first + size) of one contact.
  [[nodiscard]] MatrixXd own(Index first, Index size) const {
    MatrixXd out(size, size);
    for (Index j = 0; j < size; ++j)
      out.col(j) = values_.col(alone_ ? direction(first + j) : first + j).segment(first, size);
    return out;
  }
  void set_own(Index first, const MatrixXd& own) {
    for (Index j = 0; j < own.cols(); ++j)
      values_.col(alone_ ? direction(first + j) : first + j).segment(first, own.rows()) = own.col(j);
  }
  /// Over all directions of the contacts.
  [[nodiscard]] MatrixXd among_all(Index directions) const {
    MatrixXd out = MatrixXd::Zero(directions, alone_ ? 3 : directions);
    if (alone_)
      out(loaded_, Eigen::all) = values_;
    else
      out(loaded_, loaded_) = values_;
    return out;
  }

private:
  [[nodiscard]] Index contact(Index i) const { return loaded_[static_cast<std::size_t>(i)] / 3; }
  [[nodiscard]] Index direction(Index i) const { return loaded_[static_cast<std::size_t>(i)] % 3; }
  const std::vector<Index>& loaded_;
  bool alone_;
  MatrixXd values_;
};

/// Of the loaded directions.
struct Flexibilities {
  Flexibilities(const std::vector<Index>& loaded, bool alone)
      : exact(loaded, alone), basis(loaded, alone), inner(loaded, alone) {}
  LoadedFlexibility exact, basis;
  LoadedFlexibility inner; ///< modal::inner_flexibility
};

/// Mean squares of the displacements that fields of unit forces give under the turbulence, m2: f^T S f of a force f along the tube.
/// @param fields  m/N, 6 n rows, one loaded direction a column
Eigen::VectorXd under_turbulence(const Parts& parts, const modal::Basis& basis, const MatrixXd& fields) {
  modal::Basis lacking; // fields in place of shapes
  lacking.nodes = basis.nodes;
  lacking.shapes = fields;
  lacking.omega = Eigen::VectorXd::Zero(fields.cols());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(fields.cols());
  for (const TurbulentLoad& load : parts.turbulence)
    if (const auto zones = zones_on(load, {&lacking}); !zones.empty())
      out += flow::modal_mean_squares(zones, load.band);
  return out;
}

/// Adds what a structure gives to the flexibilities of the loaded directions.
void add_structure(const Parts& parts, std::size_t s, const StructureLoads& loaded,
                   modal::StaticSolvers& solvers, ContactFlexibility& out, Flexibilities& of_loaded) {
  const auto& [among, forces] = loaded;
  if (among.empty())
    return;
  const modal::Basis& basis = parts.bases[s];
  const MatrixXd u = solvers.of(s).solve(forces);
  of_loaded.exact.add(among, forces.transpose() * u);
  of_loaded.basis.add(among, modal::flexibility_of(basis, forces));
  of_loaded.inner.add(
      among, modal::inner_flexibility(
                 basis, forces, fem::largest_inner_changes(parts.model, parts.structures[s], basis.omega)));
  if (!in_series(parts.study))
    return; // nothing is moved beside the modes
  const MatrixXd gain = modal::static_gain(basis, forces);
  out.under_turbulence(among) += under_turbulence(parts, basis, u - basis.shapes * gain.transpose());
  for (std::size_t l = 0; l < parts.loads.size(); ++l) {
    const Eigen::VectorXd load = part_of(basis, parts.loads[l].force);
    const Eigen::VectorXd all = u.transpose() * load, size = u.cwiseAbs().transpose() * load.cwiseAbs();
    const Eigen::VectorXd lacking = all - gain * (basis.shapes.transpose() * load);
    out.under_loads(among, static_cast<Index>(l)) +=
        (lacking.array().abs() > modal::negligible_share * size.array()).select(lacking, 0.0);
  }
}

/// Between all contacts, or where the scene does not take it, what the table tells: of each contact alone.
MatrixXd missing_flexibility(const Parts& parts, const std::vector<Index>& loaded,
                             const Flexibilities& of_loaded, Index all) {
  LoadedFlexibility out(loaded, !in_series(parts.study));
  if (in_series(parts.study))
    out.set_own(
        0, modal::missing_flexibility(of_loaded.exact.all(), of_loaded.basis.all(), of_loaded.inner.all()));
  else
    for (std::size_t begin = 0, end = 0; begin < loaded.size(); begin = end) {
      while (end < loaded.size() && loaded[end] / 3 == loaded[begin] / 3)
        ++end;
      const auto first = static_cast<Index>(begin), size = static_cast<Index>(end - begin);
      out.set_own(first, modal::missing_flexibility(of_loaded.exact.own(first, size),
                                                    of_loaded.basis.own(first, size),
                                                    of_loaded.inner.own(first, size)));
    }
  return out.among_all(all);
}

ContactFlexibility flexibility(const Parts& parts, const std::vector<std::size_t>& structures,
                               const std::vector<std::size_t>& contacts, modal::StaticSolvers& solvers) {
  ContactFlexibility out;
  const ContactLoads scene = contact_loads(parts.study, parts.bases, structures, parts.placed, contacts);
  const std::vector<Index>& loaded = scene.directions;
  const auto all = static_cast<Index>(3 * contacts.size());
  const auto count = static_cast<Index>(loaded.size()), loads = static_cast<Index>(parts.loads.size());
  Flexibilities of_loaded(loaded, !in_series(parts.study));
  out.under_loads = MatrixXd::Zero(count, loads);
  out.under_turbulence = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i < structures.size(); ++i)
    add_structure(parts, structures[i], scene.on[i], solvers, out, of_loaded);
  out.missing = missing_flexibility(parts, loaded, of_loaded, all);
  out.exact = of_loaded.exact.among_all(all);
  out.basis = of_loaded.basis.among_all(all);
  MatrixXd under_loads = MatrixXd::Zero(all, loads);
  under_loads(loaded, Eigen::all) = out.under_loads;
  // a point that misses nothing is moved by the modes alone
  for (Index row = 0; row < all; ++row)
    if (!(ContactFlexibility::own(out.missing, static_cast<std::size_t>(row / 3))(row % 3, row % 3) > 0.0))
      under_loads.row(row).setZero();
  out.under_loads = std::move(under_loads);
  Eigen::VectorXd turbulent = Eigen::VectorXd::Zero(all);
  turbulent(loaded) = out.under_turbulence.cwiseSqrt();
  out.under_turbulence = std::move(turbulent);
  return out;
}

void broadcast(MPI_Comm comm, int root, ContactFlexibility& flexibility) {
  for (MatrixXd* matrix :
       {&flexibility.exact, &flexibility.basis, &flexibility.missing, &flexibility.under_loads})
    core::broadcast(comm, root, *matrix);
  core::broadcast(comm, root, flexibility.under_turbulence);
  core::broadcast(comm, root, flexibility.failure);
}

} // namespace

Eigen::Matrix3d ContactFlexibility::own(const MatrixXd& matrix, std::size_t k) {
  const auto first = static_cast<Index>(3 * k);
  return matrix.block<3, 3>(first, matrix.cols() == matrix.rows() ? first : 0);
}

results::StaticFlexibility ContactFlexibility::at(std::size_t k, const contact::Obstacle& obstacle) const {
  const auto [y, z] = contact::normal_directions(obstacle);
  std::vector<Index> rows;
  for (const auto& [taken, d] : {std::pair{y, 1}, std::pair{z, 2}})
    if (taken)
      rows.push_back(d);
  const auto part = [&](const MatrixXd& matrix) { return MatrixXd(own(matrix, k)(rows, rows)); };
  const auto principal = [&](const MatrixXd& matrix) {
    return Eigen::VectorXd(core::symmetric_eigenpairs(matrix).vectors.rightCols<1>());
  };
  const bool lacks = part(missing).diagonal().maxCoeff() > 0.0;
  const Eigen::VectorXd d = principal(part(lacks ? missing : exact));
  const auto along = [&](const MatrixXd& matrix) { return d.dot(part(matrix) * d); };
  return {along(exact), along(basis), along(missing)};
}

std::vector<ContactFlexibility>
contact_flexibilities(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                      const std::vector<fem::Structure>& structures, const std::vector<modal::Basis>& bases,
                      const std::vector<std::vector<std::size_t>>& scenes,
                      const std::vector<PlacedContact>& placed, const std::vector<Fields::Load>& loads,
                      const std::vector<TurbulentLoad>& turbulence) {
  const Parts parts{study, model, structures, bases, placed, loads, turbulence};
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
    if (in_series(study))
      throw;
    of_scene.failure = error.what();
  };
  core::agree(comm, [&] {
    modal::StaticSolvers solvers(model, structures);
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
