// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Modal forces given by samples at equal steps from t = 0 on, such as those of a random draw:
///     F_i(t) = ramp(t) scale_i [(1 - s) x_k + s x_(k+1)]_row(i),   k + s = t/step,   0 <= s < 1
///     ramp(t) = (1 - cos(pi t/T_r))/2 up to T_r, 1 from there
/// Samples are made as the run goes on: memory does not grow with its duration.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace fretwork::signals {

/// Samples of modal forces, by rows.
class ForceSamples {
public:
  virtual ~ForceSamples() = default;
  [[nodiscard]] virtual Eigen::Index rows() const = 0;
  /// Between samples, s.
  [[nodiscard]] virtual double step() const = 0;
  /// Samples first, first + 1 ...: the same whatever has been asked before. Does not throw.
  /// @param first  >= 0   @param forces  rows() x samples
  virtual void fill(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> forces) = 0;
};

/// What makes samples for a run. All that read them at a time share one: a block is made once.
class ForceSource {
public:
  virtual ~ForceSource() = default;
  [[nodiscard]] virtual std::shared_ptr<ForceSamples> open() const = 0;
};

struct SampledLoad {
  std::shared_ptr<const ForceSource> source;
  std::vector<Eigen::Index> rows; ///< of the samples, one for each mode of the scene
  Eigen::VectorXd scale;          ///< n: factors of the rows; 0: the load does not move the mode
  Eigen::VectorXd rms;            ///< n: of the modal forces, `scale` included
  double highest = 0.0;           ///< Hz, above which the forces carry nothing
  double ramp = 0.0;              ///< s, T_r; 0: none

  [[nodiscard]] bool acts() const { return (scale.array() != 0.0).any(); }
  /// The same load on some of the modes.
  [[nodiscard]] SampledLoad of_modes(const std::vector<Eigen::Index>& modes) const;
  /// The modal forces times factors.  @param factors  n
  void multiply(const Eigen::VectorXd& factors);
};

/// The forces of a sampled load as a function of time.
class SampledForce {
public:
  explicit SampledForce(const SampledLoad& load);
  /// Adds the modal force at a time. Nothing is allocated but what makes the samples allocates.
  /// @param time  s, >= 0   @param force  n
  void add(double time, double* force);

private:
  std::shared_ptr<ForceSamples> samples_;
  std::vector<Eigen::Index> rows_;
  Eigen::VectorXd scale_;
  double ramp_, per_step_;
  std::int64_t first_ = -1;         ///< sample of the first column
  Eigen::MatrixXd window_, forces_; ///< a stretch of samples: rows; n, scaled
};

} // namespace fretwork::signals
