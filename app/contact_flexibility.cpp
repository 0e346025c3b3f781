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

using Eigen::MatrixXd;

/// The parts of a model that the flexibilities are made from.
struct Parts {
  const study::Study& study;
  const fem::Model& model;
  const std::vector<fem::Structure>& structures;
  const std::vector<modal::Basis>& bases;
  const std::vector<PlacedContact>& placed;
};

/// Flexibilities between the loaded directions of each contact: (i, direction of j) for directions i, j of one contact.
class LoadedFlexibility {
public:
  explicit LoadedFlexibility(const std::vector<Eigen::Index>& loaded)
      : loaded_(loaded), values_(MatrixXd::Zero(static_cast<Eigen::Index>(loaded.size()), 3)) {}
  /// Adds a part between some of the directions.
  void add(const std::vector<Eigen::Index>& among, const MatrixXd& part) {
    for (std::size_t i = 0; i < among.size(); ++i)
      for (std::size_t j = 0; j < among.size(); ++j)
        if (contact(among[i]) == contact(among[j]))
          values_(among[i], direction(among[j])) +=
              part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  /// Between the directions [first, first + size) of one contact.
  [[nodiscard]] MatrixXd own(Eigen::Index first, Eigen::Index size) const {
    MatrixXd out(size, size);
    for (Eigen::Index j = 0; j < size; ++j)
      out.col(j) = values_.col(direction(first + j)).segment(first, size);
    return out;
  }
  void set_own(Eigen::Index first, const MatrixXd& own) {
    for (Eigen::Index j = 0; j < own.cols(); ++j)
      values_.col(direction(first + j)).segment(first, own.rows()) = own.col(j);
  }
  /// Over all directions of the contacts.
  [[nodiscard]] MatrixXd among_all(Eigen::Index directions) const {
    MatrixXd out = MatrixXd::Zero(directions, 3);
    out(loaded_, Eigen::all) = values_;
    return out;
  }

private:
  [[nodiscard]] Eigen::Index contact(Eigen::Index i) const {
    return loaded_[static_cast<std::size_t>(i)] / 3;
  }
  [[nodiscard]] Eigen::Index direction(Eigen::Index i) const {
    return loaded_[static_cast<std::size_t>(i)] % 3;
  }
  const std::vector<Eigen::Index>& loaded_;
  MatrixXd values_;
};

/// Of the loaded directions.
struct Flexibilities {
  explicit Flexibilities(const std::vector<Eigen::Index>& loaded)
      : exact(loaded), basis(loaded), inner(loaded) {}
  LoadedFlexibility exact, basis;
  LoadedFlexibility inner; ///< modal::inner_flexibility
};

/// Adds what a structure gives to the flexibilities of the loaded directions.
void add_structure(const Parts& parts, std::size_t s, const StructureLoads& loaded,
                   modal::StaticSolvers& solvers, Flexibilities& of_loaded) {
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
}

/// Of each contact alone.
MatrixXd missing_flexibility(const std::vector<Eigen::Index>& loaded, const Flexibilities& of_loaded,
                             Eigen::Index all) {
  LoadedFlexibility out(loaded);
  for (std::size_t begin = 0, end = 0; begin < loaded.size(); begin = end) {
    while (end < loaded.size() && loaded[end] / 3 == loaded[begin] / 3)
      ++end;
    const auto first = static_cast<Eigen::Index>(begin), size = static_cast<Eigen::Index>(end - begin);
    out.set_own(first,
                modal::missing_flexibility(of_loaded.exact.own(first, size), of_loaded.basis.own(first, size),
                                           of_loaded.inner.own(first, size)));
  }
  return out.among_all(all);
}

ContactFlexibility flexibility(const Parts& parts, const std::vector<std::size_t>& structures,
                               const std::vector<std::size_t>& contacts, modal::StaticSolvers& solvers) {
  ContactFlexibility out;
  const ContactLoads scene = contact_loads(parts.study, parts.bases, structures, parts.placed, contacts);
  const std::vector<Eigen::Index>& loaded = scene.directions;
  const auto all = static_cast<Eigen::Index>(3 * contacts.size());
  Flexibilities of_loaded(loaded);
  for (std::size_t i = 0; i < structures.size(); ++i)
    add_structure(parts, structures[i], scene.on[i], solvers, of_loaded);
  out.missing = missing_flexibility(loaded, of_loaded, all);
  out.exact = of_loaded.exact.among_all(all);
  out.basis = of_loaded.basis.among_all(all);
  return out;
}

void broadcast(MPI_Comm comm, int root, ContactFlexibility& flexibility) {
  for (MatrixXd* matrix : {&flexibility.exact, &flexibility.basis, &flexibility.missing})
    core::broadcast(comm, root, *matrix);
  core::broadcast(comm, root, flexibility.failure);
}

} // namespace

Eigen::Matrix3d ContactFlexibility::own(const MatrixXd& matrix, std::size_t k) {
  const auto first = static_cast<Eigen::Index>(3 * k);
  return matrix.block<3, 3>(first, 0);
}

results::StaticFlexibility ContactFlexibility::at(std::size_t k, const contact::Obstacle& obstacle) const {
  const auto [y, z] = contact::normal_directions(obstacle);
  std::vector<Eigen::Index> rows;
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

std::vector<ContactFlexibility> contact_flexibilities(MPI_Comm comm, const study::Study& study,
                                                      const fem::Model& model,
                                                      const std::vector<fem::Structure>& structures,
                                                      const std::vector<modal::Basis>& bases,
                                                      const std::vector<std::vector<std::size_t>>& scenes,
                                                      const std::vector<PlacedContact>& placed) {
  const Parts parts{study, model, structures, bases, placed};
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
  core::agree(comm, [&] {
    modal::StaticSolvers solvers(model, structures);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (owner[i] != core::rank(comm) || contacts[i].empty())
        continue;
      try {
        out[i] = flexibility(parts, scenes[i], contacts[i], solvers);
      } catch (const core::Error& error) {
        out[i].failure = error.what();
      } catch (const core::ComputationError& error) {
        out[i].failure = error.what();
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
