// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One block of a random draw (draws.hpp): lines of all loads, projected on the modes, and their inverse transforms.
/// The amplitudes of lines are the same for all blocks and are tabulated.
#pragma once
#include "flow/draws.hpp"
#include "flow/line_kernels.hpp"
#include <Eigen/Core>
#include <memory>
#include <new>
#include <vector>

namespace fretwork::flow {

inline constexpr int fades_per_block = 8; ///< T_b/C

/// Numbers aligned to 64 bytes.
class AlignedArray {
public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size)
      : size_(size), values_(static_cast<double*>(::operator new(size * sizeof(double), alignment))) {
    set_zero();
  }
  void set_zero() { std::fill_n(values_.get(), size_, 0.0); }
  [[nodiscard]] double* data() { return values_.get(); }
  [[nodiscard]] const double* data() const { return values_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }

private:
  static constexpr std::align_val_t alignment{64};
  struct Free {
    void operator()(double* p) const { ::operator delete(p, alignment); }
  };
  std::size_t size_ = 0;
  std::unique_ptr<double, Free> values_;
};

class BlockSynthesis {
public:
  /// @throws core::Error
  BlockSynthesis(const std::vector<TurbulentZone>& zones, const std::vector<MatrixLoad>& matrices,
                 const DrawOptions& options);
  ~BlockSynthesis();
  BlockSynthesis(const BlockSynthesis&) = delete;
  BlockSynthesis& operator=(const BlockSynthesis&) = delete;

  [[nodiscard]] Eigen::Index modes() const { return modes_; }
  /// Of a block's samples: modes, padded.
  [[nodiscard]] Eigen::Index rows() const { return padded_modes_; }
  /// Of a block, a multiple of fades_per_block.
  [[nodiscard]] std::int64_t samples() const { return samples_; }
  /// Between samples, s.
  [[nodiscard]] double step() const { return step_; }
  /// Block `number`.  @param out  rows() x samples()
  void compute(std::uint32_t number, Eigen::MatrixXd& out);

private:
  /// Loads at points of one zone along one axis, or the forces of a spectral matrix.
  struct Source {
    std::uint32_t stream;
    int points;
    AlignedArray shapes;   ///< as project_lines takes them
    std::vector<double> r; ///< of points; empty for a matrix
    std::shared_ptr<const AlignedArray>
        table; ///< amplitudes [group][point][line], or roots [group][row][column][line, line]
  };
  struct Transform;

  void set_grid(const DrawOptions& options);
  void add(const TurbulentZone& zone);
  void add(const MatrixLoad& load);
  void check_numbers(const std::vector<TurbulentZone>& zones, const std::vector<MatrixLoad>& matrices) const;
  /// Lines of a group of points of a zone, or of forces, to `lines_`.
  void draw_patches(const Source& source, LineSequence sequence, std::uint32_t group);
  void draw_forces(const Source& source, LineSequence sequence, std::uint32_t group);
  void transform(Eigen::MatrixXd& out);
  /// sqrt(df)/2 for lines that carry something, else 0: half of a line goes into each half of the Hermitian transform.
  [[nodiscard]] double line_scale(std::int64_t line) const;

  DrawOptions options_;
  Eigen::Index modes_ = 0, padded_modes_ = 0;
  std::int64_t samples_ = 0, last_line_ = 0;
  std::uint32_t groups_ = 0;
  double step_ = 0.0;
  std::vector<Source> sources_;
  AlignedArray lines_, sums_; ///< of a group: points x group_size; of all: modes x groups x group_size
  std::unique_ptr<Transform> transform_;
};

} // namespace fretwork::flow
