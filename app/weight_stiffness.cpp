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

/// Chords that an arc is taken for: the sum over them is within 0.2 % of the integral along a quarter of a circle.
constexpr int chords_of_arc = 8;
/// Of the change of a mode: arcs have a part in it.
constexpr double noticed_arcs = 0.01;

/// Axial forces that the weight makes, and the change of omega^2 of each mode, 1/s2.
struct Stiffening {
  double lowest = 0.0, highest = 0.0; ///< N, tension > 0
  Eigen::VectorXd squares, in_arcs;   ///< in_arcs: the part of `squares` that arcs have

  /// A straight piece.  @param rise  m, its end from its start, by modes
  /// @return its change of omega^2
  Eigen::VectorXd add(double force, const core::Vec3& span, const Eigen::MatrixXd& rise) {
    const double length = span.norm();
    const Eigen::RowVectorXd along = (span / length).transpose() * rise;
    const Eigen::VectorXd change =
        force / length * (rise.colwise().squaredNorm() - along.cwiseAbs2()).transpose();
    squares += change;
    lowest = std::min(lowest, force);
    highest = std::max(highest, force);
    return change;
  }
};

/// Its end b bears K u - f, f the load at its dofs; what lies between a section and b adds its load, taken for uniform. The deformation by u
/// alone leaves out the thrust that the weight of an arc makes between ends that are held.
/// @param sag  of the ends of the arc   @param load  at its dofs: weight less the inertia of what falls   @param shapes  of its two nodes, 12 rows
void add_arc(const fem::BeamElement& arc, const fem::Vector12& sag, const fem::Vector12& load,
             const Eigen::MatrixXd& shapes, Stiffening& out) {
  const core::Vec3 at_b = (arc.elastic_force(sag) - load).segment<3>(dofs_per_node),
                   all = load.head<3>() + load.segment<3>(dofs_per_node);
  const double length = arc.axis().length();
  const auto point = [&](int i) { return arc.axis().point(length * i / chords_of_arc); };
  const auto motion = [&](int i) -> Eigen::MatrixXd {
    return arc.shapes(static_cast<double>(i) / chords_of_arc).topRows<3>() * shapes;
  };
  Eigen::MatrixXd before = motion(0);
  for (int i = 0; i < chords_of_arc; ++i) {
    const Eigen::MatrixXd after = motion(i + 1);
    const double share = (i + 0.5) / chords_of_arc;
    const double force = arc.axis().tangent(share * length).dot(at_b + (1.0 - share) * all);
    out.in_arcs += out.add(force, point(i + 1) - point(i), after - before);
    before = after;
  }
}

/// @param weight  6 values a node of the model
Stiffening stiffening_of(const fem::Model& model, const fem::Structure& structure, const LowModes& modes,
                         const fem::StaticSolver& solver, const core::Vec3& gravity,
                         const Eigen::VectorXd& weight) {
  Stiffening out;
  out.squares = out.in_arcs = Eigen::VectorXd::Zero(modes.squares.size());
  Eigen::VectorXd here(dofs_per_node * static_cast<Eigen::Index>(structure.nodes.size()));
  for (std::size_t k = 0; k < structure.nodes.size(); ++k)
    here.segment<dofs_per_node>(dofs_per_node * static_cast<Eigen::Index>(k)) =
        weight.segment<dofs_per_node>(dofs_per_node * static_cast<Eigen::Index>(structure.nodes[k]));
  const Eigen::VectorXd sag = solver.solve(here).col(0),
                        fall = solver.rigid() * (solver.rigid().transpose() * here);
  for (const Index number : structure.beams) {
    const fem::Beam& beam = model.beams[static_cast<std::size_t>(number)];
    if (fem::axial_force(model.properties[static_cast<std::size_t>(beam.property)], beam.along) != 0.0)
      continue;
    const Eigen::Index a = Eigen::Index{fem::position_of(structure, beam.a)} * dofs_per_node,
                       b = Eigen::Index{fem::position_of(structure, beam.b)} * dofs_per_node;
    fem::Vector12 u;
    u << sag.segment<6>(a), sag.segment<6>(b);
    const fem::BeamElement element(model, beam);
    if (beam.middle) {
      Eigen::MatrixXd shapes(2 * dofs_per_node, modes.shapes.cols());
      shapes << modes.shapes.middleRows(a, dofs_per_node), modes.shapes.middleRows(b, dofs_per_node);
      fem::Vector12 acceleration;
      acceleration << fall.segment<6>(a), fall.segment<6>(b);
      add_arc(element, u, fem::weight(model, beam, gravity) - element.mass() * acceleration, shapes, out);
    } else
      out.add(element.section_forces(u, 0.5)[0], model.node(beam.b) - model.node(beam.a),
              modes.shapes.middleRows(b, 3) - modes.shapes.middleRows(a, 3));
  }
  return out;
}

/// The mode whose frequency changes most.
struct Worst {
  double share = 0.0, hz = 0.0, lowest = 0.0, highest = 0.0; ///< share: of its frequency, -1: it buckles
  bool pendulum = false; ///< a motion without strain; hz is its frequency under the weight alone
  bool arcs = false;     ///< have a part in it
};

void look(const LowModes& modes, const Stiffening& found, Worst& worst) {
  const double least = round_off * found.squares.cwiseAbs().maxCoeff();
  const auto take = [&](Eigen::Index i, double share, double square, bool pendulum) {
    const double straight = found.squares(i) - found.in_arcs(i);
    if (std::abs(share) > std::abs(worst.share))
      worst = {share,        std::sqrt(square) / (2.0 * std::numbers::pi),
               found.lowest, found.highest,
               pendulum,     std::abs(found.in_arcs(i)) > noticed_arcs * std::abs(straight)};
  };
  for (Eigen::Index i = 0; i < modes.squares.size(); ++i)
    if (const double square = modes.squares(i), change = found.squares(i); square > 0.0)
      take(i, std::sqrt(std::max(0.0, 1.0 + change / square)) - 1.0, square, false);
    else if (std::abs(change) > least)
      take(i, change > 0.0 ? 1.0 : -1.0, std::abs(change), true);
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
                     "leave out: {}{}; {}",
                     worst.lowest, worst.highest, change, contacts ? " (with closed contacts)" : "",
                     worst.arcs ? "axial_force = [a, b] and from of [[beams]] give those of straight beams; "
                                  "arcs cannot have any"
                                : "give them by axial_force = [a, b] and from of [[beams]]");
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
        look(modes, stiffening_of(model, structures[s], modes, solvers.of(s), *study.gravity, weight), worst);
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
