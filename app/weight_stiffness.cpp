// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/weight_stiffness.hpp"
#include "app/pinned_model.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/symmetric.hpp"
#include "fem/beam_constants.hpp"
#include "fem/beam_element.hpp"
#include "fem/weight.hpp"
#include "modal/static_solvers.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

using core::dofs_per_node;
using core::Index;

/// The lowest modes, which the weight changes most.
constexpr Eigen::Index most_modes = 200;
/// Of the largest omega^2, and of the largest change of one.
constexpr double round_off = 1e-12;

/// Of a structure on its closed contacts: omega^2 and shapes of its lowest modes.
struct LowModes {
  Eigen::VectorXd squares; ///< 1/s2; 0 of motions without strain
  Eigen::MatrixXd shapes;
};

LowModes low_modes(const modal::Basis& basis, const fem::Model& model, const fem::Model& pinned) {
  const Eigen::Index modes = std::min(basis.true_modes(), most_modes);
  const auto [values, vectors] = core::symmetric_eigenpairs(stiffness_with_pins(basis, modes, model, pinned));
  const double rigid = round_off * values.cwiseAbs().maxCoeff();
  return {(values.array() > rigid).select(values, 0.0), basis.shapes.leftCols(modes) * vectors};
}

/// Axial forces that the weight makes, and the change of omega^2 of each mode, 1/s2.
struct Stiffening {
  double lowest = 0.0, highest = 0.0; ///< N, tension > 0
  Eigen::VectorXd squares;
};

/// @param weight  6 values a node of the model
Stiffening stiffening_of(const fem::Model& model, const fem::Structure& structure, const LowModes& modes,
                         const fem::StaticSolver& solver, const Eigen::VectorXd& weight) {
  Stiffening out;
  out.squares = Eigen::VectorXd::Zero(modes.squares.size());
  Eigen::VectorXd here(dofs_per_node * static_cast<Eigen::Index>(structure.nodes.size()));
  for (std::size_t k = 0; k < structure.nodes.size(); ++k)
    here.segment<dofs_per_node>(dofs_per_node * static_cast<Eigen::Index>(k)) =
        weight.segment<dofs_per_node>(dofs_per_node * static_cast<Eigen::Index>(structure.nodes[k]));
  const Eigen::VectorXd sag = solver.solve(here).col(0);
  for (const Index number : structure.beams) {
    const fem::Beam& beam = model.beams[static_cast<std::size_t>(number)];
    if (beam.middle ||
        fem::axial_force(model.properties[static_cast<std::size_t>(beam.property)], beam.along) != 0.0)
      continue;
    const Eigen::Index a = Eigen::Index{fem::position_of(structure, beam.a)} * dofs_per_node,
                       b = Eigen::Index{fem::position_of(structure, beam.b)} * dofs_per_node;
    fem::Vector12 u;
    u << sag.segment<6>(a), sag.segment<6>(b);
    const double force = fem::BeamElement(model, beam).section_forces(u, 0.5)[0];
    const core::Vec3 span = model.node(beam.b) - model.node(beam.a);
    const double length = span.norm();
    const Eigen::MatrixXd rise = modes.shapes.middleRows(b, 3) - modes.shapes.middleRows(a, 3);
    const Eigen::RowVectorXd along = (span / length).transpose() * rise;
    out.squares += force / length * (rise.colwise().squaredNorm() - along.cwiseAbs2()).transpose();
    out.lowest = std::min(out.lowest, force);
    out.highest = std::max(out.highest, force);
  }
  return out;
}

/// The mode whose frequency changes most.
struct Worst {
  double share = 0.0, hz = 0.0, lowest = 0.0, highest = 0.0; ///< share: of its frequency, -1: it buckles
  bool pendulum = false; ///< a motion without strain; hz is its frequency under the weight alone
};

void look(const LowModes& modes, const Stiffening& found, Worst& worst) {
  const double least = round_off * found.squares.cwiseAbs().maxCoeff();
  const auto take = [&](double share, double square, bool pendulum) {
    if (std::abs(share) > std::abs(worst.share))
      worst = {share, std::sqrt(square) / (2.0 * std::numbers::pi), found.lowest, found.highest, pendulum};
  };
  for (Eigen::Index i = 0; i < modes.squares.size(); ++i)
    if (const double square = modes.squares(i), change = found.squares(i); square > 0.0)
      take(std::sqrt(std::max(0.0, 1.0 + change / square)) - 1.0, square, false);
    else if (std::abs(change) > least)
      take(change > 0.0 ? 1.0 : -1.0, std::abs(change), true);
}

std::string text_of(const Worst& worst, bool contacts) {
  const std::string change =
      worst.pendulum
          ? worst.share > 0.0
                ? fmt::format("with them a motion without strain is a pendulum of {:.3g} Hz", worst.hz)
                : std::string("with them a motion without strain falls over")
      : worst.share <= -1.0
          ? fmt::format("with them the mode at {:.4g} Hz buckles", worst.hz)
          : fmt::format("they change the frequency of {:.4g} Hz by {:+.2g} %", worst.hz, 100.0 * worst.share);
  return fmt::format("[gravity]: the weight makes axial forces of {:.3g} to {:.3g} N in the beams (tension > "
                     "0), which the modes "
                     "leave out: {}{}; give them by axial_force = [a, b] and from of [[beams]]",
                     worst.lowest, worst.highest, change, contacts ? " (with closed contacts)" : "");
}

} // namespace

void note_weight_stiffness(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                           const std::vector<fem::Structure>& structures,
                           const std::vector<modal::Basis>& bases, const std::vector<PlacedContact>& contacts,
                           results::RunResults& out) {
  if (!study.gravity)
    return;
  std::string text;
  int warns = 0;
  core::agree(comm, [&] {
    if (core::rank(comm) != 0)
      return;
    Worst worst;
    try {
      modal::StaticSolvers solvers(model, structures);
      const fem::Model pinned = pinned_model(study, model, that_can_pin(model, contacts), {true, true});
      const Eigen::VectorXd weight = fem::weight(model, *study.gravity);
      for (std::size_t s = 0; s < bases.size(); ++s) {
        const LowModes modes = low_modes(bases[s], model, pinned);
        look(modes, stiffening_of(model, structures[s], modes, solvers.of(s), weight), worst);
      }
    } catch (const core::Error&) { // of the static solution, which the run does without
      return;
    } catch (const core::ComputationError&) {
      return;
    }
    if (!(std::abs(worst.share) >= noted_by_weight))
      return;
    text = text_of(worst, !contacts.empty());
    warns = std::abs(worst.share) >= warned_by_weight ? 1 : 0;
  });
  core::broadcast(comm, 0, text);
  MPI_Bcast(&warns, 1, MPI_INT, 0, comm);
  if (!text.empty())
    (warns ? out.warnings : out.notes).push_back(text);
}

} // namespace fretwork::app
