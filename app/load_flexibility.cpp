// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/load_flexibility.hpp"
#include "app/pinned_model.hpp"
#include "app/stages.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/symmetric.hpp"
#include "modal/static_flexibility.hpp"
#include "modal/static_solvers.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace fretwork::app {
namespace {

/// Of the work of a load by which its rigid motions exceed its deflection, in the frequencies of the modes: what is strained is of no effect.
constexpr double negligible_strain = 1e-6;

/// Of a model whose first nodes are those of `model`: 6 rows each of the nodes of a structure.
Eigen::VectorXd on_structure(const Eigen::VectorXd& force, const std::vector<core::Index>& nodes) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(core::dofs_per_node * static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (const Eigen::Index at = core::dofs_per_node * static_cast<Eigen::Index>(nodes[k]); at < force.size())
      out.segment<core::dofs_per_node>(core::dofs_per_node * static_cast<Eigen::Index>(k)) =
          force.segment<core::dofs_per_node>(at);
  return out;
}

/// Work of a load on a structure at rest, J.
struct Work {
  double exact = 0.0, of_modes = 0.0;

  void operator+=(const Work& other) {
    exact += other.exact;
    of_modes += other.of_modes;
  }
  [[nodiscard]] double missing_share() const { return exact > 0.0 ? 1.0 - of_modes / exact : 0.0; }
};

/// Structures that can move rigidly, with their contacts closed: as springs of K_N and, with friction, K_T.
class OnContacts {
public:
  /// @param model  must live longer
  OnContacts(const study::Study& study, const fem::Model& model, const std::vector<PlacedContact>& contacts)
      : model_(model), pinned_(pinned_model(study, model, that_can_pin(model, contacts), {true, true})),
        structures_(moving_structures(pinned_)), solvers_(pinned_, structures_) {}

  /// @param force  of the nodes of the model   @return zeros where the load accelerates the structure and strains next to nothing
  Work work(const modal::Basis& basis, const Eigen::VectorXd& force) {
    const std::size_t s = structure_of(basis.nodes.front());
    const fem::StaticSolver& solver = solvers_.of(s);
    const Eigen::VectorXd here = on_structure(force, structures_[s].nodes);
    const double rigid = (solver.rigid().transpose() * here).squaredNorm(), top = basis.omega.maxCoeff();
    Work out{here.dot(solver.solve(here).col(0)), 0.0};
    if (solver.rigid().cols() > 0 && out.exact * top * top <= negligible_strain * rigid)
      return {};
    out.of_modes = work_of_modes(basis, solver.rigid().cols(), on_structure(force, basis.nodes));
    return out;
  }

private:
  [[nodiscard]] std::size_t structure_of(core::Index node) const {
    std::size_t s = 0;
    while (fem::position_of(structures_[s], node) < 0)
      ++s;
    return s;
  }

  /// By the modes of the structure on the springs, without its rigid motions: omega^2 and those springs, in modal coordinates.
  [[nodiscard]] double work_of_modes(const modal::Basis& basis, Eigen::Index rigid,
                                     const Eigen::VectorXd& force) const {
    const auto [values, vectors] =
        core::symmetric_eigenpairs(stiffness_with_pins(basis, basis.size(), model_, pinned_));
    const Eigen::Index elastic = std::max<Eigen::Index>(values.size() - rigid, 0);
    const Eigen::VectorXd loads = vectors.rightCols(elastic).transpose() * (basis.shapes.transpose() * force);
    return (loads.array().square() / values.tail(elastic).array()).sum();
  }

  const fem::Model& model_;
  fem::Model pinned_;
  std::vector<fem::Structure> structures_;
  modal::StaticSolvers solvers_;
};

/// What is found of the loads of a study.
struct Lacking {
  std::vector<std::string> loads;
  double most = 0.0;
  bool on_contacts = false; ///< one of them, at least, of a structure that contacts alone hold
};

Lacking lacking_deflection(const study::Study& study, const fem::Model& model,
                           const std::vector<fem::Structure>& structures,
                           const std::vector<modal::Basis>& bases, const Fields& fields,
                           const std::vector<PlacedContact>& contacts) {
  modal::StaticSolvers solvers(model, structures);
  std::optional<OnContacts> closed; // made where a structure needs it
  Lacking out;
  for (std::size_t l = 0; l < std::min(fields.loads.size(), most_loads); ++l) {
    const bool base = fields.loads[l].inertial && !fields.loads[l].of_support;
    if (l >= study.loads.size() && !base) // weights along tubes hardly strain them
      continue;
    Work work;
    bool free = false;
    for (std::size_t s = 0; s < bases.size(); ++s) {
      const Eigen::VectorXd force = on_structure(fields.loads[l].force, bases[s].nodes);
      if (force.isZero(0.0))
        continue;
      if (solvers.of(s).rigid().cols() > 0) {
        if (!closed)
          closed.emplace(study, model, contacts);
        work += closed->work(bases[s], fields.loads[l].force);
        free = true;
      } else {
        work += {force.dot(solvers.of(s).solve(force).col(0)), modal::flexibility_of(bases[s], force)(0, 0)};
      }
    }
    if (work.missing_share() > much_deflection) {
      out.loads.push_back(fields.loads[l].name);
      out.on_contacts = out.on_contacts || (free && !contacts.empty());
    }
    out.most = std::max(out.most, work.missing_share());
  }
  return out;
}

} // namespace

void warn_of_load_flexibility(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                              const std::vector<fem::Structure>& structures,
                              const std::vector<modal::Basis>& bases,
                              const std::vector<PlacedContact>& contacts, Fields& fields) {
  std::string text;
  core::agree(comm, [&] {
    if (core::rank(comm) != 0)
      return;
    Lacking lacking;
    try {
      lacking = lacking_deflection(study, model, structures, bases, fields, contacts);
    } catch (const core::Error&) { // of the static solution, which the run does without
      return;
    } catch (const core::ComputationError&) {
      return;
    }
    if (!lacking.loads.empty())
      text = fmt::format(
          "modal truncation: the modes lack up to {:.0f} % of the static deflection under {}{}; ask "
          "for more modes by modes.up_to_hz or modes.count",
          100.0 * lacking.most, fmt::join(lacking.loads, ", "),
          lacking.on_contacts ? " (with closed contacts, where these alone hold the structure)" : "");
  });
  core::broadcast(comm, 0, text);
  if (!text.empty())
    fields.warnings.push_back(text);
}

} // namespace fretwork::app
