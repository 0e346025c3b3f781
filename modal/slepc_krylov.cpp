// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/slepc_krylov.hpp"
#include "core/error.hpp"
#include "core/petsc.hpp"
#include "fem/beam_constants.hpp"
#include "fem/inner_motion.hpp"
#include "fem/node_blocks.hpp"
#include "fem/petsc_static.hpp"
#include "modal/canonical.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <slepceps.h>

namespace fretwork::modal {
namespace {

/// Of the residual of (K - sigma M)^-1 M: gives orthogonality of 1e-14 for a third more solves than the usual
/// 1e-8.
constexpr double krylov_tolerance = 1e-12;
/// Modes beyond those wanted: the next cluster begins among them, in nearly all structures.
constexpr int reserve = 4;
/// Rounds in search of missed modes. A round finds one vector at least of each multiple eigenvalue, normally
/// many.
constexpr int search_rounds = 8;

/// Of the projected tridiagonal matrix (LAPACK's stedc, in SLEPc's numbering): a third of the time of the QR
/// iteration.
constexpr PetscInt divide_and_conquer = 2;

/// Vectors of the Krylov space for `count` modes, which may be few: two each, but fewer for many modes, where
/// orthogonalisation costs most.
int space_for(int count) { return count + std::max(15, count <= 40 ? count : std::max(40, count / 2)); }

/// More modes than this are searched interval by interval on one rank.
constexpr int largest_space = 120;
/// An interval may hold a share of 1 / 8 more modes than asked.
constexpr int slice_slack = 8;

/// Share of the scale of the lowest elastic eigenvalue below which none is: a frequency of 1e-12 of the usual.
constexpr double no_mode_below = 1e-24;

/// Owners of the PETSc objects used here.
struct Solver {
  explicit Solver(MPI_Comm comm) {
    FW_PETSC(EPSCreate(comm, &handle));
    FW_PETSC(EPSSetProblemType(handle, EPS_GHEP));
    FW_PETSC(EPSSetType(handle, EPSKRYLOVSCHUR));
    FW_PETSC(EPSSetTolerances(handle, krylov_tolerance, PETSC_DEFAULT));
    DS projected = nullptr;
    FW_PETSC(EPSGetDS(handle, &projected));
    FW_PETSC(DSSetMethod(projected, divide_and_conquer));
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  ~Solver() { EPSDestroy(&handle); }
  EPS handle = nullptr;
};
struct Vector {
  Vec handle = nullptr;
  Vector() = default;
  Vector(Vector&& other) noexcept : handle(other.handle) { other.handle = nullptr; }
  ~Vector() { VecDestroy(&handle); }
};
struct Gather {
  VecScatter handle = nullptr;
  ~Gather() { VecScatterDestroy(&handle); }
};

Vector vector_like(Mat matrix) {
  Vector vector;
  FW_PETSC(MatCreateVecs(matrix, &vector.handle, nullptr));
  return vector;
}

/// Fills the rows of this rank from value(i) of the global row i.
template <class Value> void fill(Vec vector, Value value) {
  PetscInt begin = 0, end = 0;
  FW_PETSC(VecGetOwnershipRange(vector, &begin, &end));
  PetscScalar* values = nullptr;
  FW_PETSC(VecGetArray(vector, &values));
  for (PetscInt i = begin; i < end; ++i)
    values[i - begin] = value(i);
  FW_PETSC(VecRestoreArray(vector, &values));
}

/// A start without symmetry, the same for any number of ranks: fractions of multiples of an irrational
/// number.
double start_value(PetscInt row, int start) {
  const double x = (static_cast<double>(row) + 1.0) * (0.6180339887498949 + 0.1 * start);
  return 1.0 + x - std::floor(x);
}

/// Scale of the lowest elastic eigenvalue: a beam as long as the structure (or a typical spring) with all the
/// mass. Anything between 1e-6 and 1e2 times the lowest eigenvalue serves as a shift.
double eigenvalue_scale(const fem::Model& model, const fem::Structure& structure) {
  const auto at = [](const auto& items, core::Index i) -> const auto& {
    return items[static_cast<std::size_t>(i)];
  };
  core::Vec3 low = at(model.nodes, structure.nodes.front()), high = low;
  for (const core::Index node : structure.nodes) {
    low = low.cwiseMin(at(model.nodes, node));
    high = high.cwiseMax(at(model.nodes, node));
  }
  double mass = 0.0, bending = 0.0, spring = 0.0;
  for (const core::Index i : structure.beams) {
    const fem::Beam& beam = at(model.beams, i);
    const fem::BeamProperty& p = at(model.properties, beam.property);
    const fem::BeamConstants k = fem::beam_constants(p, 0.5 * (beam.along[0] + beam.along[1]));
    mass += k.mass_transverse * (at(model.nodes, beam.b) - at(model.nodes, beam.a)).norm();
    bending = std::max(bending, std::min(k.bending_y, k.bending_z));
  }
  for (const core::Index i : structure.masses)
    mass += at(model.masses, i).mass;
  for (const core::Index i : structure.springs)
    for (int d = 0; d < 3; ++d)
      spring = std::max(spring, at(model.springs, i).stiffness[static_cast<std::size_t>(d)]);
  if (!(mass > 0.0))
    return 1.0;
  const double size = (high - low).norm();
  return (bending > 0.0 ? 100.0 * bending / (size * size * size) : spring) / mass;
}

/// K - s M.
fem::PetscMatrix shifted(const fem::SystemMatrices& system, double s) {
  Mat handle = nullptr;
  FW_PETSC(MatDuplicate(system.stiffness.get(), MAT_COPY_VALUES, &handle));
  fem::PetscMatrix matrix(handle);
  FW_PETSC(MatAXPY(handle, -s, system.mass.get(), SAME_NONZERO_PATTERN));
  FW_PETSC(MatSetOption(handle, MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

int negative_pivots(Mat matrix, fem::Elimination elimination) {
  const fem::PetscMatrix factor = fem::factorise(matrix, elimination);
  PetscInt negative = 0;
  FW_PETSC(MatGetInertia(factor.get(), &negative, nullptr, nullptr));
  return static_cast<int>(negative);
}

void set_factorisation(EPS eps, Mat matrix, double shift, fem::Elimination elimination) {
  const auto [package, ordering] =
      fem::factoriser(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), elimination);
  ST st = nullptr;
  KSP ksp = nullptr;
  PC pc = nullptr;
  FW_PETSC(EPSGetST(eps, &st));
  FW_PETSC(STSetType(st, STSINVERT));
  FW_PETSC(STSetShift(st, shift));
  FW_PETSC(STSetMatStructure(st, SAME_NONZERO_PATTERN));
  FW_PETSC(STGetKSP(st, &ksp));
  FW_PETSC(KSPSetType(ksp, KSPPREONLY));
  FW_PETSC(KSPGetPC(ksp, &pc));
  FW_PETSC(PCSetType(pc, PCCHOLESKY));
  FW_PETSC(PCFactorSetMatSolverType(pc, package));
  FW_PETSC(PCFactorSetMatOrderingType(pc, ordering));
}

void deflate(EPS eps, Mat matrix, const Eigen::MatrixXd& columns) {
  std::vector<Vector> owners;
  std::vector<Vec> space;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    owners.push_back(vector_like(matrix));
    fill(owners.back().handle, [&](PetscInt i) { return columns(i, j); });
    space.push_back(owners.back().handle);
  }
  if (!space.empty())
    FW_PETSC(EPSSetDeflationSpace(eps, static_cast<PetscInt>(space.size()), space.data()));
}

/// The converged pairs with a finite eigenvalue above zero, ascending, on every rank.
Pairs gather(EPS eps, Mat matrix) {
  PetscInt converged = 0, rows = 0;
  FW_PETSC(EPSGetConverged(eps, &converged));
  FW_PETSC(MatGetSize(matrix, &rows, nullptr));
  const Vector local = vector_like(matrix);
  Vector all;
  Gather scatter;
  FW_PETSC(VecScatterCreateToAll(local.handle, &scatter.handle, &all.handle));
  Pairs pairs{Eigen::VectorXd(converged), Eigen::MatrixXd(rows, converged)};
  for (PetscInt j = 0; j < converged; ++j) {
    FW_PETSC(EPSGetEigenpair(eps, j, &pairs.lambda[j], nullptr, local.handle, nullptr));
    FW_PETSC(VecScatterBegin(scatter.handle, local.handle, all.handle, INSERT_VALUES, SCATTER_FORWARD));
    FW_PETSC(VecScatterEnd(scatter.handle, local.handle, all.handle, INSERT_VALUES, SCATTER_FORWARD));
    const PetscScalar* values = nullptr;
    FW_PETSC(VecGetArrayRead(all.handle, &values));
    pairs.vectors.col(j) = Eigen::Map<const Eigen::VectorXd>(values, rows);
    FW_PETSC(VecRestoreArrayRead(all.handle, &values));
  }
  return pairs;
}

Pairs sorted(const Pairs& pairs) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(pairs.lambda.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return pairs.lambda[i] < pairs.lambda[j]; });
  return {pairs.lambda(order), pairs.vectors(Eigen::all, order)};
}

Pairs joined(const Pairs& a, const Pairs& b) {
  Pairs both{Eigen::VectorXd(a.lambda.size() + b.lambda.size()),
             Eigen::MatrixXd(a.vectors.rows(), a.vectors.cols() + b.vectors.cols())};
  both.lambda << a.lambda, b.lambda;
  both.vectors << a.vectors, b.vectors;
  return sorted(both);
}

double half_way(const Eigen::VectorXd& lambda, Eigen::Index place) {
  return 0.5 * (lambda[place - 1] + lambda[place]);
}

/// The place from `first` on (so many modes below it), half way there above `least`, with the widest relative gap to the next
/// mode, or 0 where there is none but in the cluster or below.
Eigen::Index widest_gap(const Eigen::VectorXd& lambda, Eigen::Index first, double least) {
  Eigen::Index best = 0;
  double widest = cluster_gap;
  for (Eigen::Index i = std::max<Eigen::Index>(first, 1); i < lambda.size(); ++i)
    if (const double gap = (lambda[i] - lambda[i - 1]) / lambda[i];
        gap > widest && half_way(lambda, i) > least) {
      widest = gap;
      best = i;
    }
  return best;
}

} // namespace

KrylovModes::KrylovModes(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
                         const Eigen::MatrixXd& rigid)
    : comm_(comm), model_(model), structure_(structure), rigid_(free_rows(structure, rigid)),
      system_(fem::assemble(comm, model, structure)), elimination_(fem::elimination_of(model, structure)),
      inner_scale_(fem::inner_motion_scale(model, structure)) {
  const Vector diagonal = vector_like(system_.mass.get());
  FW_PETSC(MatGetDiagonal(system_.mass.get(), diagonal.handle));
  PetscInt local = 0;
  FW_PETSC(VecGetLocalSize(diagonal.handle, &local));
  const PetscScalar* values = nullptr;
  FW_PETSC(VecGetArrayRead(diagonal.handle, &values));
  const auto mine = static_cast<int>(std::count_if(values, values + local, [](double m) { return m > 0.0; }));
  FW_PETSC(VecRestoreArrayRead(diagonal.handle, &values));
  MPI_Allreduce(&mine, &massive_, 1, MPI_INT, MPI_SUM, comm);
  if (rigid.cols() > 0)
    shift_ = -eigenvalue_scale(model, structure);
}

std::string KrylovModes::what() const {
  return "modes of the structure that starts at node " +
         fem::place(model_.nodes[static_cast<std::size_t>(structure_.nodes.front())]);
}

// A mode below may rise by as much as one above falls: (1 + x) / (1 - x), x <= 0.05.
double KrylovModes::reach(double lambda) const {
  return lambda * (1.0 + 2.2 * fem::largest_inner_change(inner_scale_, 1.06 * lambda));
}

int KrylovModes::below(double s) const { return negative_pivots(shifted(system_, s).get(), elimination_); }

// Rigid motions are held: nothing pulls at them, and what is left of K has the negative eigenvalues of K and no zero.
bool is_stable(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
               const Eigen::MatrixXd& rigid) {
  const fem::SystemMatrices system = fem::assemble(comm, model, structure);
  if (rigid.cols() > 0)
    fem::hold(system.stiffness.get(),
              fem::equations_to_hold(structure, rigid, fem::scale_of(model, structure)));
  return negative_pivots(system.stiffness.get(), fem::elimination_of(model, structure)) == 0;
}

Pairs KrylovModes::solve(int count, const Eigen::MatrixXd& deflated, int start) const {
  Mat k = system_.stiffness.get(), m = system_.mass.get();
  const Solver solver(comm_);
  EPS eps = solver.handle;
  FW_PETSC(EPSSetOperators(eps, k, m));
  FW_PETSC(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
  FW_PETSC(EPSSetTarget(eps, shift_));
  FW_PETSC(EPSSetDimensions(eps, count, space_for(count), PETSC_DEFAULT));
  set_factorisation(eps, k, shift_, elimination_);
  deflate(eps, k, deflated);
  const Vector first = vector_like(k);
  fill(first.handle, [&](PetscInt i) { return start_value(i, start); });
  Vec space = first.handle;
  FW_PETSC(EPSSetInitialSpace(eps, 1, &space));
  FW_PETSC(EPSSolve(eps));
  PetscInt converged = 0;
  FW_PETSC(EPSGetConverged(eps, &converged));
  if (converged < count)
    throw core::ComputationError(
        fmt::format("{}: {} of {} modes converged; ask for fewer ([modes] count)", what(), converged, count));
  return sorted(gather(eps, k));
}

/// All elastic modes up to a limit that has at least `count` below it, interval by interval of the spectrum:
/// many small Krylov spaces instead of one large one, whose orthogonalisation would cost the square of
/// `count`.
Pairs KrylovModes::slice(int count) const {
  const int rigid = static_cast<int>(rigid_.cols()), most = rigid + count + count / slice_slack;
  double low = eigenvalue_scale(model_, structure_), high = low;
  while (below(high) < rigid + count) {
    high *= 4.0;
    if (!std::isfinite(high))
      throw core::ComputationError(
          fmt::format("{}: it has fewer than {} modes (masses without inertia on massless beams?); "
                      "ask for fewer ([modes] count)",
                      what(), count));
  }
  for (const double slowest = low * no_mode_below; below(low) > rigid; low /= 4.0)
    if (low < slowest)
      throw core::ComputationError(
          fmt::format("{}: more motions than its {} rigid ones have no frequency above 0; compressed parts "
                      "that buckle, or round-off of parts hardly held: support them, or mesh more coarsely",
                      what(), rigid));
  for (double from = low; below(high) > most;) {
    const double middle = std::sqrt(from * high); // evenly in octaves
    (below(middle) < rigid + count ? from : high) = middle;
    if (high - from < cluster_gap * high)
      break; // one cluster holds all that are too many
  }
  const Solver solver(comm_);
  EPS eps = solver.handle;
  FW_PETSC(EPSSetOperators(eps, system_.stiffness.get(), system_.mass.get()));
  FW_PETSC(EPSSetWhichEigenpairs(eps, EPS_ALL));
  FW_PETSC(EPSSetInterval(eps, low, high));
  set_factorisation(eps, system_.stiffness.get(), low, elimination_);
  FW_PETSC(EPSSolve(eps));
  return sorted(gather(eps, system_.stiffness.get()));
}

Pairs KrylovModes::complete(Pairs pairs, int count) const {
  for (int round = 1;; ++round) {
    const std::vector<Eigen::Index> ends = cluster_ends(pairs.lambda, 0);
    const Eigen::Index first = *std::lower_bound(ends.begin(), ends.end(), Eigen::Index{count});
    const Eigen::Index place = widest_gap(pairs.lambda, first, reach(pairs.lambda[first - 1]));
    if (place == 0)
      return {};
    const double s = half_way(pairs.lambda, place);
    const auto missing = below(s) - static_cast<int>(rigid_.cols() + place);
    if (missing == 0)
      return {pairs.lambda.head(place), pairs.vectors.leftCols(place)};
    if (missing < 0 || round > search_rounds)
      throw core::ComputationError(
          fmt::format("{}: {} modes found below {:.6g} Hz where there are {}; ask for another number "
                      "([modes] count), or mesh more coarsely",
                      what(), place, std::sqrt(s) / (2.0 * std::numbers::pi), place + missing));
    Eigen::MatrixXd known(pairs.vectors.rows(), rigid_.cols() + pairs.vectors.cols());
    known << rigid_, pairs.vectors;
    pairs = joined(pairs, solve(missing, known, round));
  }
}

Pairs KrylovModes::lowest(int count) const {
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  const bool can_slice = elimination_ == fem::Elimination::chain && ranks == 1;
  for (int asked = count + reserve;;) {
    Pairs found = can_slice && asked > largest_space ? slice(asked) : solve(asked, rigid_, 0);
    const double last = found.lambda[count - 1];
    Pairs pairs = complete(std::move(found), count);
    if (pairs.lambda.size() > 0)
      return pairs;
    const int within_reach = below(reach(last)) - static_cast<int>(rigid_.cols());
    if (within_reach + reserve > asked) {
      asked = within_reach + reserve;
      if (space_for(asked) >= massive_)
        return {};
      continue;
    }
    if (3 * asked > massive_)
      throw core::ComputationError(
          fmt::format("{}: mode {} belongs to a cluster of more than {} modes of one frequency; ask "
                      "for another number of modes ([modes] count)",
                      what(), count, asked - count));
    asked *= 2;
  }
}

} // namespace fretwork::modal
