// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/block_synthesis.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <complex>
#include <fftw3.h>
#include <fmt/format.h>
#include <set>

namespace fretwork::flow {
namespace {

constexpr int transforms_together = 8; ///< modes whose samples are written side by side: a line of the cache
constexpr double most_samples = 67108864.0; ///< 2^26 of a block: half a gigabyte for one mode
constexpr double fewest_lines = 8.0;        ///< up to f_max: fewer are no random force
constexpr double fewest_samples_per_period = 4.0;
constexpr std::uint32_t axes_per_zone = 256;

/// Smallest length >= least that transforms fast and that fades divide: 8, 9, 10 or 12 times a power of 2 that is 8 at least.
std::int64_t fast_length(double least) {
  for (std::int64_t power = fades_per_block;; power *= 2)
    for (const std::int64_t eighths : {8, 9, 10, 12})
      if (static_cast<double>(power * eighths) >= least)
        return power * eighths;
}

std::size_t size(std::int64_t n) { return static_cast<std::size_t>(n); }

/// Mode by mode in blocks, as project_lines takes them; modes that fill the last block up are 0.
AlignedArray packed(const Eigen::MatrixXd& shapes, Eigen::Index padded_modes) {
  AlignedArray out(size(padded_modes * shapes.cols()));
  for (Eigen::Index k = 0; k < shapes.cols(); ++k)
    for (Eigen::Index i = 0; i < shapes.rows(); ++i)
      out.data()[(i / mode_block * shapes.cols() + k) * mode_block + i % mode_block] = shapes(i, k);
  return out;
}

void check_options(const DrawOptions& o) {
  if (!(o.f_min >= 0.0) || !(o.f_max > o.f_min) || !std::isfinite(o.f_max))
    throw core::Error(fmt::format(
        "random forces from {:g} Hz to {:g} Hz make no sense; give 0 <= f_min < f_max", o.f_min, o.f_max));
  if (!(o.block_period > 0.0) || !(o.f_max * o.block_period >= fewest_lines))
    throw core::Error(
        fmt::format("blocks of {:g} s have fewer than {:g} lines up to {:g} Hz; give a longer block period",
                    o.block_period, fewest_lines, o.f_max));
  if (!(o.samples_per_period >= fewest_samples_per_period))
    throw core::Error(fmt::format(
        "{:g} samples per period of the highest frequency do not follow it; give {:g} at least, 20 "
        "for 0.8 % of its amplitude",
        o.samples_per_period, fewest_samples_per_period));
  const double needed = o.f_max * o.block_period * o.samples_per_period;
  if (!(needed <= most_samples))
    throw core::Error(fmt::format(
        "a block of {:g} s up to {:g} Hz needs {:.4g} samples, more than {:.4g}; lower f_max or the "
        "block period",
        o.block_period, o.f_max, needed, most_samples));
}

} // namespace

/// Of one mode at a time, from n/2 + 1 complex lines to n real samples.
struct BlockSynthesis::Transform {
  explicit Transform(std::int64_t n)
      : lines(size(n + 2)), samples(size(n) * transforms_together),
        plan(fftw_plan_dft_c2r_1d(static_cast<int>(n), reinterpret_cast<fftw_complex*>(lines.data()),
                                  samples.data(), FFTW_ESTIMATE)) {}
  ~Transform() { fftw_destroy_plan(plan); }
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;
  void operator()(double* to) {
    fftw_execute_dft_c2r(plan, reinterpret_cast<fftw_complex*>(lines.data()), to);
  }

  AlignedArray lines, samples;
  fftw_plan plan;
};

BlockSynthesis::~BlockSynthesis() = default;

BlockSynthesis::BlockSynthesis(const std::vector<TurbulentZone>& zones,
                               const std::vector<MatrixLoad>& matrices, const DrawOptions& options)
    : options_(options) {
  check_options(options);
  check(zones);
  check_numbers(zones, matrices);
  modes_ = zones.empty() ? matrices.front().shapes.rows() : zones.front().modes();
  padded_modes_ = (modes_ + transforms_together - 1) / transforms_together * transforms_together;
  set_grid(options);
  for (const TurbulentZone& zone : zones)
    add(zone);
  for (const MatrixLoad& load : matrices)
    add(load);
  int most_points = 0;
  for (const Source& s : sources_)
    most_points = std::max(most_points, s.points);
  lines_ = AlignedArray(size(std::int64_t{most_points} * 2 * group_size)); // of matrices e too
  sums_ = AlignedArray(size(padded_modes_ * groups_ * group_size));
  transform_ = std::make_unique<Transform>(samples_);
}

void BlockSynthesis::set_grid(const DrawOptions& options) {
  samples_ = fast_length(options.f_max * options.block_period * options.samples_per_period);
  step_ = options.block_period / static_cast<double>(samples_);
  last_line_ = static_cast<std::int64_t>(std::floor(options.f_max * options.block_period * (1.0 + 1e-12)));
  groups_ = static_cast<std::uint32_t>(last_line_ / group_lines + 1);
}

void BlockSynthesis::check_numbers(const std::vector<TurbulentZone>& zones,
                                   const std::vector<MatrixLoad>& matrices) const {
  if (zones.empty() && matrices.empty())
    throw core::Error("a random draw without a load; give a zone of turbulence or a spectral matrix");
  std::set<std::uint32_t> ids;
  for (const TurbulentZone& zone : zones)
    ids.insert(zone.id);
  const Eigen::Index modes = zones.empty() ? matrices.front().shapes.rows() : zones.front().modes();
  for (const MatrixLoad& load : matrices) {
    if (!ids.insert(load.id).second)
      throw core::Error(fmt::format(
          "random load '{}': another load has the number {} too, both would be the same; give each "
          "its own",
          load.name, load.id));
    if (load.shapes.rows() != modes || modes == 0)
      throw core::Error(
          fmt::format("random load '{}' has {} modes, others have {}; give all the same modes, at least one",
                      load.name, load.shapes.rows(), modes));
  }
}

double BlockSynthesis::line_scale(std::int64_t line) const {
  const double f = static_cast<double>(line) / options_.block_period;
  return line == 0 || line > last_line_ || f < options_.f_min ? 0.0 : 0.5 / std::sqrt(options_.block_period);
}

void BlockSynthesis::add(const TurbulentZone& zone) {
  const ZoneSpectra spectra(zone);
  const Eigen::Index points = zone.patches();
  auto table = std::make_shared<AlignedArray>(size(groups_ * points * group_lines));
  for (std::int64_t line = 0; line <= last_line_; ++line) {
    const double f = static_cast<double>(line) / options_.block_period, scale = line_scale(line);
    const double common = spectra.separable() && scale > 0.0 ? std::sqrt(spectra.common(f)) : 0.0;
    double* to = table->data() + line / group_lines * points * group_lines + line % group_lines;
    if (scale > 0.0)
      for (Eigen::Index k = 0; k < points; ++k)
        to[k * group_lines] =
            scale * (spectra.separable() ? spectra.factor(k) * common : spectra.amplitude(k, f));
  }
  std::vector<double> r(size(points), 0.0);
  for (Eigen::Index k = 1; k < points; ++k)
    r[size(k)] = std::exp(-(zone.s[k] - zone.s[k - 1]) / zone.correlation_length);
  for (std::size_t axis = 0; axis < zone.axes.size(); ++axis) {
    const LoadAxis& a = zone.axes[axis];
    sources_.push_back({zone.id * axes_per_zone + static_cast<std::uint32_t>(axis), static_cast<int>(points),
                        packed(std::sqrt(a.weight) * a.shapes * zone.ds.asDiagonal(), padded_modes_), r,
                        table});
  }
}

void BlockSynthesis::add(const MatrixLoad& load) {
  const Eigen::Index n = load.shapes.cols();
  auto table = std::make_shared<AlignedArray>(size(groups_ * n * n * group_size));
  for (std::int64_t line = 0; line <= last_line_; ++line) {
    const double scale = line_scale(line);
    if (scale == 0.0)
      continue;
    const Eigen::MatrixXcd root = hermitian_root(load, static_cast<double>(line) / options_.block_period);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        double* to = table->data() + ((line / group_lines * n + i) * n + j) * group_size + line % group_lines;
        to[0] = scale * root(i, j).real();
        to[group_lines] = scale * root(i, j).imag();
      }
  }
  sources_.push_back({load.id * axes_per_zone,
                      static_cast<int>(n),
                      packed(load.shapes, padded_modes_),
                      {},
                      std::move(table)});
}

void BlockSynthesis::draw_patches(const Source& source, LineSequence sequence, std::uint32_t group) {
  alignas(64) double z[group_size] = {};
  const double* amplitude = source.table->data() + std::int64_t{group} * source.points * group_lines;
  for (int k = 0; k < source.points; ++k) {
    sequence.point = static_cast<std::uint32_t>(k);
    advance_lines(sequence, group, source.r[size(k)], amplitude + std::int64_t{k} * group_lines, z,
                  lines_.data() + std::int64_t{k} * group_size);
  }
}

void BlockSynthesis::draw_forces(const Source& source, LineSequence sequence, std::uint32_t group) {
  const std::int64_t n = source.points;
  double* e = lines_.data() + n * group_size;
  for (std::int64_t j = 0; j < n; ++j) {
    sequence.point = static_cast<std::uint32_t>(j);
    draw_lines(sequence, group, e + j * group_size);
  }
  std::fill_n(lines_.data(), n * group_size, 0.0);
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; j < n; ++j) {
      const double *h = source.table->data() + ((group * n + i) * n + j) * group_size,
                   *from = e + j * group_size;
      double* to = lines_.data() + i * group_size;
      for (int l = 0; l < group_lines; ++l) {
        to[l] += h[l] * from[l] - h[group_lines + l] * from[group_lines + l];
        to[group_lines + l] += h[l] * from[group_lines + l] + h[group_lines + l] * from[l];
      }
    }
}

void BlockSynthesis::compute(std::uint32_t number, Eigen::MatrixXd& out) {
  sums_.set_zero();
  const std::ptrdiff_t stride = std::int64_t{groups_} * group_size;
  for (const Source& source : sources_)
    for (std::uint32_t group = 0; group < groups_; ++group) {
      const LineSequence sequence{options_.seed, options_.draw,      source.stream, 0,
                                  number,        options_.phase_only};
      if (source.r.empty())
        draw_forces(source, sequence, group);
      else
        draw_patches(source, sequence, group);
      project_lines(static_cast<int>(padded_modes_ / mode_block), source.points, source.shapes.data(),
                    lines_.data(), sums_.data() + std::int64_t{group} * group_size, stride);
    }
  transform(out);
}

void BlockSynthesis::transform(Eigen::MatrixXd& out) {
  Transform& t = *transform_;
  for (Eigen::Index first = 0; first < padded_modes_; first += transforms_together) {
    for (Eigen::Index i = 0; i < transforms_together; ++i) {
      double* to = t.samples.data() + i * samples_;
      if (first + i >= modes_) {
        std::fill_n(to, samples_, 0.0);
        continue;
      }
      t.lines.set_zero(); // the transform overwrites them
      const double* from = sums_.data() + (first + i) * groups_ * group_size;
      for (std::uint32_t group = 0; group < groups_; ++group, from += group_size)
        for (std::int64_t l = 0, line = std::int64_t{group} * group_lines;
             l < group_lines && line <= last_line_; ++l, ++line) {
          t.lines.data()[2 * line] = from[l];
          t.lines.data()[2 * line + 1] = from[group_lines + l];
        }
      t(to);
    }
    for (std::int64_t j = 0; j < samples_; ++j)
      for (Eigen::Index i = 0; i < transforms_together; ++i)
        out(first + i, j) = t.samples.data()[i * samples_ + j];
  }
}

} // namespace fretwork::flow
