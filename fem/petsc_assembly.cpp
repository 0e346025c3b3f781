// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/petsc_assembly.hpp"
#include "core/error.hpp"
#include "core/petsc.hpp"
#include "fem/node_blocks.hpp"
#include <algorithm>
#include <utility>

namespace fretwork::fem {
namespace {

/// Independent loops from which on MUMPS is faster than PETSc's own factorisation: a grid of 40 x 40 cells
/// costs both the same.
constexpr std::size_t many_loops = 1600;

/// Compressed rows [begin, end) of K and M.
struct Rows {
  std::vector<PetscInt> start{0}, column;
  std::vector<PetscScalar> stiffness, mass;
};

/// Where an equation is in the blocks: several places for dofs that are tied.
struct Place {
  Index equation;
  std::size_t node; ///< row of blocks
  int dof;
};

struct Entry {
  Index column;
  double stiffness, mass;
};

Index equation_of(const Structure& structure, Index position, int d) {
  return structure.equation[static_cast<std::size_t>(position) * dofs_per_node + static_cast<std::size_t>(d)];
}

/// The places of the equations [begin, end), by equation.
std::vector<Place> places_of(const Structure& structure, const NodeBlocks& blocks, PetscInt begin,
                             PetscInt end) {
  std::vector<Place> places;
  for (std::size_t i = 0; i + 1 < blocks.start.size(); ++i)
    for (int d = 0; d < dofs_per_node; ++d)
      if (const Index e = equation_of(structure, blocks.first + static_cast<Index>(i), d);
          e >= begin && e < end)
        places.push_back({e, i, d});
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.equation < b.equation; });
  return places;
}

/// By column, each once: columns of dofs that are tied come unordered and more than once.
void add_up(std::vector<Entry>& row) {
  const auto not_before = [](const Entry& a, const Entry& b) { return a.column >= b.column; };
  if (std::adjacent_find(row.begin(), row.end(), not_before) == row.end())
    return;
  std::stable_sort(row.begin(), row.end(),
                   [](const Entry& a, const Entry& b) { return a.column < b.column; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < row.size(); ++i)
    if (row[i].column == row[last].column) {
      row[last].stiffness += row[i].stiffness;
      row[last].mass += row[i].mass;
    } else {
      row[++last] = row[i];
    }
  row.resize(last + 1);
}

/// @param keep_zeros  entries that are exactly zero in both matrices too
Rows compress(const Structure& structure, const NodeBlocks& blocks, PetscInt begin, PetscInt end,
              bool keep_zeros) {
  Rows rows;
  std::vector<Entry> row;
  const std::vector<Place> places = places_of(structure, blocks, begin, end);
  for (auto place = places.begin(); place != places.end();) {
    row.clear();
    for (const Index equation = place->equation; place != places.end() && place->equation == equation;
         ++place)
      for (std::size_t b = blocks.start[place->node]; b < blocks.start[place->node + 1]; ++b)
        for (int e = 0; e < dofs_per_node; ++e)
          if (const Index column = equation_of(structure, blocks.column[b], e); column >= 0)
            if (const double k = blocks.stiffness[b](place->dof, e), m = blocks.mass[b](place->dof, e);
                keep_zeros || k != 0.0 || m != 0.0 || column == equation)
              row.push_back({column, k, m});
    add_up(row);
    for (const Entry& entry : row) {
      rows.column.push_back(entry.column);
      rows.stiffness.push_back(entry.stiffness);
      rows.mass.push_back(entry.mass);
    }
    rows.start.push_back(static_cast<PetscInt>(rows.column.size()));
  }
  return rows;
}

/// Positions of the nodes that have one of the equations [begin, end).
std::pair<Index, Index> nodes_of(const Structure& structure, PetscInt begin, PetscInt end) {
  auto first = static_cast<Index>(structure.nodes.size());
  Index last = 0;
  for (std::size_t i = 0; i < structure.equation.size(); ++i)
    if (structure.equation[i] >= begin && structure.equation[i] < end) {
      first = std::min(first, static_cast<Index>(i / dofs_per_node));
      last = static_cast<Index>(i / dofs_per_node) + 1;
    }
  return {std::min(first, last), last};
}

bool uses_mumps(MPI_Comm comm, Elimination elimination) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  return ranks > 1 || elimination == Elimination::network;
}

PetscMatrix make_matrix(MPI_Comm comm, PetscInt local, PetscInt global, const Rows& rows,
                        const std::vector<PetscScalar>& values) {
  Mat handle = nullptr;
  FW_PETSC(MatCreate(comm, &handle));
  PetscMatrix matrix(handle);
  FW_PETSC(MatSetSizes(handle, local, local, global, global));
  FW_PETSC(MatSetType(handle, MATAIJ));
  FW_PETSC(MatSeqAIJSetPreallocationCSR(handle, rows.start.data(), rows.column.data(), values.data()));
  FW_PETSC(MatMPIAIJSetPreallocationCSR(handle, rows.start.data(), rows.column.data(), values.data()));
  FW_PETSC(MatSetOption(handle, MAT_SYMMETRIC, PETSC_TRUE));
  FW_PETSC(MatSetOption(handle, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  return matrix;
}

/// Owns a pair of orderings.
struct Ordering {
  IS row = nullptr, column = nullptr;
  ~Ordering() {
    ISDestroy(&row);
    ISDestroy(&column);
  }
};

} // namespace

PetscMatrix& PetscMatrix::operator=(PetscMatrix&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

PetscMatrix::~PetscMatrix() { MatDestroy(&handle_); }

/// Motions in and across the plane of a flat structure do not meet: without the zeros between them PETSc's own
/// products and solves take a third to a half of the time. MUMPS instead eliminates the dofs of a node together
/// where they have one pattern, and would be slower.
SystemMatrices assemble(MPI_Comm comm, const Model& model, const Structure& structure) {
  const PetscInt global = structure.equations;
  PetscInt local = PETSC_DECIDE, total = global;
  FW_PETSC(PetscSplitOwnership(comm, &local, &total));
  PetscInt end = 0;
  MPI_Scan(&local, &end, 1, MPIU_INT, MPI_SUM, comm);
  const auto [first, last] = nodes_of(structure, end - local, end);
  const Rows rows = compress(structure, node_blocks(model, structure, first, last), end - local, end,
                             uses_mumps(comm, elimination_of(model, structure)));
  return {make_matrix(comm, local, global, rows, rows.stiffness),
          make_matrix(comm, local, global, rows, rows.mass)};
}

Elimination elimination_of(const Model& model, const Structure& structure) {
  if (is_chain(model, structure))
    return Elimination::chain;
  std::size_t links = structure.beams.size() + structure.ties.size();
  for (const Index i : structure.springs)
    links += model.springs[static_cast<std::size_t>(i)].other >= 0 ? 1 : 0;
  return links > structure.nodes.size() + many_loops ? Elimination::network : Elimination::tree;
}

Factoriser factoriser(MPI_Comm comm, Elimination elimination) {
  constexpr Factoriser mumps{MATSOLVERMUMPS, MATORDERINGEXTERNAL};
  if (uses_mumps(comm, elimination))
    return mumps;
  switch (elimination) {
  case Elimination::chain:
    return {MATSOLVERPETSC, MATORDERINGNATURAL};
  case Elimination::tree:
    return {MATSOLVERPETSC, MATORDERINGND};
  case Elimination::network:
    break;
  }
  return mumps;
}

PetscMatrix factorise(Mat matrix, Elimination elimination) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix));
  const auto [package, order] = factoriser(comm, elimination);
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  Mat handle = nullptr;
  FW_PETSC(MatGetFactor(matrix, package, MAT_FACTOR_CHOLESKY, &handle));
  PetscMatrix factor(handle);
  if (ranks > 1)
    FW_PETSC(MatMumpsSetIcntl(handle, 13, 1)); // no ScaLAPACK at the root: it hides the signs of its pivots
  Ordering ordering;
  FW_PETSC(MatGetOrdering(matrix, order, &ordering.row, &ordering.column));
  MatFactorInfo info;
  FW_PETSC(MatFactorInfoInitialize(&info));
  FW_PETSC(MatCholeskyFactorSymbolic(handle, matrix, ordering.row, &info));
  FW_PETSC(MatCholeskyFactorNumeric(handle, matrix, &info));
  MatFactorError outcome = MAT_FACTOR_NOERROR;
  FW_PETSC(MatFactorGetError(handle, &outcome));
  if (outcome != MAT_FACTOR_NOERROR)
    throw core::ComputationError("factorisation of the stiffness: a pivot vanishes, the matrix is singular");
  return factor;
}

} // namespace fretwork::fem
