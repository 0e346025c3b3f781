// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Kernels (kernels.hpp) of modes that forces of motion couple, in the coordinates in which they are apart (vibration/diagonal_flow.hpp).
#pragma once
#include "kernels/kernels.hpp"

namespace fretwork::kernels {

/// Coordinates y of a block: the real parts of its pairs, their imaginary parts, its real ones; each padded to `lanes`, zero there.
struct StateCount {
  int pairs = 0, reals = 0; ///< padded
  [[nodiscard]] int width() const { return 2 * pairs + reals; }
};

/// Numbers of a block for steps of one length t, arrays as y one after the other. With l the eigenvalues, phi_k of l t, inputs G0 and G1 at the start
/// and at the end, linear between them:
///     y1 = e y0 + a0 G0 + a1 G1,   y1' = l y1 (but for G1, which moves no displacement),
///     int (1 - s) y dt = p y0 + p0 G0 + p1 G1,   int s y dt = r y0 + r0 G0 + r1 G1,   s the share of the step
struct StateTable {
  enum Number { e, a0, a1, l, p, p0, p1, r, r0, r1, numbers };
};
/// What a force on a block is: three numbers for each of y, one array after the other. Its input G; the row of y for its power, f^T v; and the row
/// for what it adds to the fluid's work (vibration/diagonal_flow.hpp).
inline constexpr int numbers_of_input = 3;
/// Inputs over a step: a load from load0 to load1 and a contact force from mean - slope to mean + slope.
struct StateInputs {
  const double *load0, *load1, *mean, *slope;
};
/// y1 and l y1.
extern const Kernel<void(StateCount count, const double* table, const double* y0, const StateInputs& inputs,
                         double* y, double* rate)>
    move_states;
/// J over the step: of the load, of the contact force, and of both by the third row.
struct StateWorks {
  double load = 0.0, contact = 0.0, fluid = 0.0;
};
extern const Kernel<StateWorks(StateCount count, const double* table, const double* y0,
                               const StateInputs& inputs)>
    state_works;

/// Rows of a matrix whose columns follow each other, for `multiply`: two packs, or the last one.
inline constexpr int tile = 2 * lanes;
/// Where a value of a matrix with np rows stands for `multiply`: tile after tile of rows, column by column within each.
[[nodiscard]] constexpr std::size_t place_in_tiles(int np, int columns, int row, int column) {
  const int first = row - row % tile, rows = np - first < tile ? np - first : tile;
  return static_cast<std::size_t>(first) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(column * rows + row - first);
}
/// y = sum over k of x[k] column[k].   @param matrix  np x columns, in tiles
extern const Kernel<void(int np, int columns, const double* matrix, const double* x, double* y)> multiply;

/// Over a step of modes that start at q0, v0 and end at q1, v1 under a load from l0 to l1, a contact force from mean - slope to mean + slope, and a
/// further force of their own.
struct OwnWorks {
  double load = 0.0, contact = 0.0, own = 0.0; ///< J, of the three
  double twice_energy = 0.0;                   ///< J, at the end
};
/// The further force from own0 to own1, linear in time, for which the modes by themselves come to q1, v1; its works, and the mean of q.
/// @param inverse  a pack of modes after another, four numbers each: (own0, own1) by what q1 and v1 differ from without it
extern const Kernel<OwnWorks(int np, const FlowTable& table, const double* inverse, const double* q0,
                             const double* v0, const double* q1, const double* v1, const double* l0,
                             const double* l1, const double* mean, const double* slope, double* own0,
                             double* own1, double* mean_q)>
    own_works;

} // namespace fretwork::kernels
