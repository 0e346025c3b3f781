// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of modes under forces that depend on their motion (core/motion_forces.hpp), in coordinates in which it is apart. With
/// X = (q, v, z) of a block (system.hpp), X' = A X + f on v, A = T diag(l) T^-1 and y = T^-1 X:
///     y' = l y + G,  G = Q f,  Q the columns of T^-1 for v
/// over a step under G linear in time by phi functions, phi_0 = e^x, phi_(k+1) = (phi_k - 1/k!)/x, of l h. Growth and decay are no special cases:
/// the flow does not limit the step. A step of m modes and r states costs some 30 (2m + r) multiplications, and contacts as many numbers a row as
/// there are of y; q and v of all modes cost 2m (2m + r) and are found where they are asked for.
///
/// Works. A force has the power f^T v = (T_v^T f)^T y, T_v the rows of T for v. The power of the forces of motion, F = K q + C v + G z, is a quadratic
/// form, F^T v = y^T S y. With P_ab = -S_ab/(l_a + l_b) (the Lyapunov equation A^T P + P A = -S in coordinates y)
///     d(y^T P y)/dt = -y^T S y + 2 G^T P y:   fluid work = y^T P y at the start - y^T P y now + int 2 (P Q f)^T y dt
/// exactly. A step needs the last integral alone, of the same kind as a power.
///
/// T is that of the scaled unknowns (w q, v, w_1 z), w_1 the lowest frequency of the block. Blocks where its condition or an element of P is above 1e6
/// (a motion that neither grows nor decays, though the fluid feeds it) are left to coupled_flow.hpp: round-off of q and v, or of the fluid work, would
/// exceed 1e-10. Eigenvalues that leave q and v alone to 1e-12 are left out.
#pragma once
#include "kernels/state_kernels.hpp"
#include "vibration/modal_flow.hpp"
#include <complex>
#include <vector>

namespace fretwork::vibration {

class DiagonalFlow {
public:
  DiagonalFlow() = default;
  /// @param blocks  those of the system that are to be moved; those that cannot be diagonalised are left out (`modes`)
  /// @param lengths  of steps in numbers of `step`, s
  DiagonalFlow(const System& system, const std::vector<CoupledBlock>& blocks, double step,
               const std::vector<int>& lengths);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  /// Numbers of y, of all blocks; a multiple of kernels::lanes. A force on them has `kernels::numbers_of_input` times as many.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
  /// Modes of a block, and its part of y.
  [[nodiscard]] const std::vector<Eigen::Index>& modes(std::size_t block) const {
    return blocks_[block].modes;
  }
  [[nodiscard]] ModeRange range(std::size_t block) const {
    return {static_cast<Eigen::Index>(blocks_[block].first), blocks_[block].width()};
  }
  /// T_q, its columns in the places of y: displacements of the block's modes, m x width.
  [[nodiscard]] auto displacements(std::size_t block) const {
    return blocks_[block].state.topRows(static_cast<Eigen::Index>(blocks_[block].modes.size()));
  }
  /// Forces on the block's modes as inputs, 3 width x m.
  [[nodiscard]] const Eigen::MatrixXd& inputs(std::size_t block) const { return blocks_[block].input; }

  /// y for q and v and z = 0. Arrays of modes hold all of them.
  void start(const double* q, const double* v, double* y) const;
  /// Adds forces on all modes to inputs. No allocation.
  void add_input(const double* force, double* input);
  /// Over a step of the length at `place` of the list: y and l y, y0 something else. No allocation.
  void move(std::size_t place, const double* y0, const kernels::StateInputs& inputs, double* y,
            double* rate) const;
  /// Of this step, J. No allocation.
  [[nodiscard]] kernels::StateWorks works(std::size_t place, const double* y0,
                                          const kernels::StateInputs& inputs) const;
  /// q and v of the blocks' modes. No allocation.
  void modes_of(const double* y, double* q, double* v);
  /// y in the middle of such a step. No allocation.
  void middle(std::size_t place, const double* y0, const kernels::StateInputs& inputs, double* y);
  /// As ModalFlow::bow, of y over one step, so far as it shows in displacements. No allocation.
  void bow(const double* y0, const kernels::StateInputs& inputs, double* bow);
  /// As ModalFlow::linear_for_bends, of the numbers of inputs from `first` on: those of one y have the same.
  void linear_for_bends(BentForce& by, std::size_t first) const;
  /// y, and l y where it is asked for, a time t after y0, the inputs being those at the start and then. No allocation.
  void inside(double t, const double* y0, const kernels::StateInputs& inputs, double* y,
              double* rate = nullptr);
  /// Energy of the blocks' modes, and y^T P y, J. No allocation.
  [[nodiscard]] double energy(const double* y);
  [[nodiscard]] double fluid_form(const double* y);
  /// Adds the forces of motion on all modes. No allocation.
  void add_forces(const double* y, double* force) const;
  /// Displacement and velocity of the blocks' modes after one step from rest under a constant force.
  void response(const double* force, double* moved, double* velocity) const;

private:
  struct Block {
    std::vector<Eigen::Index> modes;
    kernels::StateCount count;
    std::size_t first = 0;                    ///< of its numbers in y
    std::vector<std::complex<double>> values; ///< by numbers of y: pairs, then reals after 2 count.pairs
    Eigen::VectorXd stiffness;
    Eigen::MatrixXd state, start, forces;       ///< 2m x width, T; width x 2m; m x width: F of y
    Eigen::MatrixXd input;                      ///< 3 width x m
    Eigen::MatrixXd response;                   ///< 2m x m
    kernels::Array top, input_tiles, form;      ///< T, `input` and P in tiles
    std::vector<kernels::Array> tables, halves; ///< by lengths; of half the lengths
    kernels::Array bow;                         ///< of one step, in place of e, a0, a1
    [[nodiscard]] int width() const { return count.width(); }
    [[nodiscard]] int rows() const { return kernels::padded(2 * static_cast<int>(modes.size())); }
  };
  void add_block(const System& system, const CoupledBlock& of, double step, const std::vector<int>& lengths);
  template <class Write> static void write_numbers(const Block& b, double* table, const Write& write);
  static void set_table(const Block& b, double t, double* table);
  static void set_bow(const Block& b, double t, double* table);
  [[nodiscard]] const double* modes_of_block(const Block& b, const double* y);

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
  double step_ = 0.0;
  kernels::Array modes_, moved_, table_; ///< of the largest block
};

} // namespace fretwork::vibration
