// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of modes under forces that depend on their motion (core/motion_forces.hpp), in coordinates in which it is apart. With
/// X = (q, v, z) of a block (coupled_blocks.hpp), X' = A X + f on v, A = T diag(l) T^-1 and y = T^-1 X:
///     y' = l y + Q f,   over a step under f from f0 to f1:   y <- e^(l h) y + h (phi_1 - phi_2) Q f0 + h phi_2 Q f1,   phi_k of l h
/// phi_1(x) = (e^x - 1)/x, phi_2(x) = (phi_1(x) - 1)/x, Q the columns of T^-1 for v. Growth and decay are no special cases: the flow does not
/// limit the step. A step of m modes and r states costs some 4 (2m + r) multiplications for y and 2m (2m + r) for q and v.
///
/// T is that of the scaled unknowns (w q, v, w_1 z), w_1 the lowest frequency of the block. Blocks where its condition is above 1e6 are left to
/// coupled_flow.hpp: round-off of q and v would exceed 1e-10.
#pragma once
#include "transient/modes/coupled_blocks.hpp"
#include "transient/simd/state_kernels.hpp"
#include <array>
#include <complex>
#include <vector>

namespace fretwork::transient {

/// Forces on contacts along components y z x of their local axes.
struct RowForces {
  std::size_t count = 0;
  const int* rows = nullptr; ///< 3 times the contact plus the component
  const double *mean = nullptr,
               *slope = nullptr; ///< N, from mean - slope to mean + slope; slope null: constant
};

class DiagonalFlow {
public:
  DiagonalFlow() = default;
  /// @param scene  with the system, whose contacts bear the forces
  /// @param blocks  those of the system that are to be moved; those that cannot be diagonalised stay there, the others are taken out
  /// @param lengths  of steps in numbers of `step`, s
  DiagonalFlow(const Scene& scene, std::vector<CoupledBlock>& blocks, double step,
               const std::vector<int>& lengths);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  /// Numbers of y, of all blocks; a multiple of kernels::lanes.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// y for q and v and z = 0. Arrays of modes hold all of them.
  void start(const double* q, const double* v, double* y) const;
  /// Over a step of the length at `place` of the list. No allocation.
  /// @param load0, load1  null: there are none
  void move(std::size_t place, const double* y0, const double* load0, const double* load1, double* y,
            double* q, double* v);
  /// After `move` over one step: what forces on contacts add to it. No allocation.
  void push(const RowForces& forces, double* y, double* q, double* v);
  /// Displacement after one step from rest under a constant force.
  void response(const double* force, double* moved);
  /// State a time t after y0 under the load f0 + t slope. No allocation.
  void inside(double t, const double* y0, const double* f0, const double* slope, double* q, double* v);
  /// Adds the forces of motion where `inside` was last. No allocation.
  void add_forces(double* force) const;

private:
  struct Block {
    std::vector<Eigen::Index> modes;
    kernels::StateCount count;
    std::size_t first = 0;                      ///< of its numbers in y
    int rows = 0;                               ///< 2m, padded
    std::vector<std::complex<double>> values;   ///< by numbers of y: pairs, then reals after 2 count.pairs
    kernels::Array top;                         ///< rows x width: q and v of y
    kernels::Array input;                       ///< width x m: Q
    Eigen::MatrixXd start, forces;              ///< width x 2m; m x width: the forces of motion of y
    std::vector<kernels::Array> decay, answers; ///< by lengths
    kernels::Array constant;                    ///< rows x m: q and v after one step under a constant force
    kernels::Array
        of_rows; ///< input, then q and v after one step by mean and slope, of the rows of contacts that move the block
    std::vector<int> row_places;     ///< by rows of contacts: which of them; -1: it does not move the block
    kernels::Array load, load_input; ///< modal force and Q of it, at the end of the last step
    kernels::Array y, qv;            ///< after the last move
    [[nodiscard]] int width() const { return count.width(); }
    [[nodiscard]] std::size_t row_size() const { return static_cast<std::size_t>(width() + 2 * rows); }
  };
  [[nodiscard]] bool add_block(const System& system, const CoupledBlock& of, double step,
                               const std::vector<int>& lengths);
  void add_rows(const Scene& scene, Block& b, double step);
  void set_times(const Block& b, double t, double* decay, double* answer) const;
  void load_block(Block& b, std::size_t place, const double* load0, const double* load1);
  /// The block's part of a modal array.
  const double* part(const Block& b, const double* all, kernels::Array& to) const;
  static void give(const Block& b, const double* qv, double* q, double* v);

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
  kernels::Array a_, b_, g0_, g1_, moved_, decay_, answer_,
      inside_;                                      ///< of the largest block; inside_: of all
  std::array<std::vector<const double*>, 3> parts_; ///< of the rows that push a block
  std::array<std::vector<double>, 4> factors_;      ///< early, late, mean, slope
};

} // namespace fretwork::transient
