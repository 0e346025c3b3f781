// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/force_statistics.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace fretwork::post {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

enum Component : std::size_t { n, vy, vz, t, my, mz };
/// Pairs whose products are kept.
constexpr std::array<std::array<std::size_t, 2>, 3> pairs{{{n, my}, {n, mz}, {my, mz}}};
/// Sums of a force whose batches are kept: of its components, of their squares, of the pairs.
constexpr std::size_t squares_at = force_components, products_at = 2 * force_components,
                      force_sums = products_at + pairs.size();
/// Directions round a section in which the largest deviation is looked for: 1e-5 of it.
constexpr int directions = 720;

double stress_of(const OuterFibre& fibre, double normal, double about_y, double about_z) {
  const double y = about_y * fibre.e_z, z = about_z * fibre.e_y;
  return std::abs(normal) / fibre.area + (fibre.round ? std::sqrt(y * y + z * z) : std::abs(y) + std::abs(z));
}

/// What each of N, My and Mz adds to the stress of a fibre.
using Weights = std::array<double, 3>;

std::vector<Weights> fibres(const OuterFibre& fibre) {
  std::vector<Weights> out;
  if (!fibre.round)
    for (const double b : {1.0, -1.0}) // the others have the opposite bending
      for (const double a : {1.0, -1.0})
        out.push_back({1.0 / fibre.area, a * fibre.e_z, b * fibre.e_y});
  for (int i = 0; fibre.round && i < directions; ++i) {
    const double p = 2.0 * std::numbers::pi * i / directions;
    out.push_back({1.0 / fibre.area, std::cos(p) * fibre.e_z, std::sin(p) * fibre.e_y});
  }
  return out;
}

/// The sum of w_i w_j c_ij. @param squares  of N, My, Mz   @param products  of the pairs
double quadratic(const Weights& w, const std::array<double, 3>& squares,
                 const std::array<double, 3>& products) {
  double sum = 2.0 * (w[0] * w[1] * products[0] + w[0] * w[2] * products[1] + w[1] * w[2] * products[2]);
  for (std::size_t i = 0; i < 3; ++i)
    sum += w[i] * w[i] * squares[i];
  return sum;
}

std::vector<std::size_t> with_dampers(const std::vector<FollowedForce>& forces) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < forces.size(); ++k)
    if (forces[k].by_velocity.size() > 0)
      out.push_back(k);
  return out;
}

/// Whether a damper acts in a component of a force.
bool damps(const FollowedForce& force, std::size_t component) {
  const auto row = static_cast<Eigen::Index>(component);
  return !force.by_velocity.row(row).isZero(0.0) ||
         (force.imposed_velocity.size() > 0 && !force.imposed_velocity.row(row).isZero(0.0));
}

} // namespace

ForceStatistics::ForceStatistics(const std::vector<FollowedForce>& forces, double from)
    : from_(from), damped_(with_dampers(forces)), before_(2 * force_components * damped_.size()),
      width_(static_cast<std::size_t>(kernels::padded(static_cast<int>(forces.size() + damped_.size())))),
      products_(pairs.size() * width_), force_(width_), moment_(width_), stress_(width_),
      stress_time_(width_), ends_(force_sums * forces.size()) {
  for (kernels::Array* of_components : {&first_, &sums_, &squares_, &min_, &max_})
    of_components->assign(force_components * width_, 0.0);
  values_.assign(together * first_.size(), 0.0);
  for (const FollowedForce& force : forces) {
    kinds_.push_back({force.section, force.fibre});
    modes_ = static_cast<std::size_t>(kernels::padded(static_cast<int>(force.rows.cols())));
    inputs_of_record_ =
        modes_ + static_cast<std::size_t>(kernels::padded(static_cast<int>(force.by_contacts.cols())));
  }
  inputs_.assign(together * inputs_of_record_, 0.0);
  for (const std::size_t k : damped_)
    for (std::size_t c = 0; c < force_components; ++c)
      damps_.push_back(damps(forces[k], c));
  for (std::size_t c = 0; c < force_components; ++c)
    for (std::size_t begin = 0; begin < width_; begin += kernels::lanes) {
      std::map<int, std::array<double, kernels::lanes>> pack;
      for (std::size_t k = begin; k < std::min(begin + kernels::lanes, forces.size() + damped_.size()); ++k) {
        const auto add = [&](const Eigen::MatrixXd& of, std::size_t first) {
          for (Eigen::Index i = 0; i < of.cols(); ++i)
            if (const double value = of(static_cast<Eigen::Index>(c), i); value != 0.0)
              pack[static_cast<int>(first) + static_cast<int>(i)][k - begin] = value;
        };
        if (k >= forces.size()) {
          add(forces[damped_[k - forces.size()]].by_velocity, 0);
          continue;
        }
        add(forces[k].rows, 0);
        add(forces[k].by_contacts, modes_);
      }
      gather_.add_pack(pack);
    }
}

void ForceStatistics::add_loads(const std::vector<FollowedForce>& forces,
                                const std::vector<vibration::Load>& loads, double duration) {
  const std::vector<std::size_t> first = vibration::first_with_function(loads);
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (first[l] != l)
      continue;
    kernels::Array values(first_.size(), 0.0);
    for (std::size_t same = l; same < loads.size(); ++same)
      for (std::size_t k = 0; k < forces.size() && first[same] == l; ++k)
        for (std::size_t c = 0; c < force_components && forces[k].by_loads.size() > 0; ++c)
          values[c * width_ + k] +=
              forces[k].by_loads(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(same));
    if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; }))
      continue;
    loads_.emplace_back(loads[l].function, duration);
    of_loads_.insert(of_loads_.end(), values.begin(), values.end());
  }
}

void ForceStatistics::add_imposed_motion(const std::vector<FollowedForce>& forces,
                                         const std::vector<signals::PrescribedMotion>& motions,
                                         double duration) {
  imposed_.assign(motions.size() * first_.size(), 0.0);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    motions_.emplace_back(motions[m], duration);
    for (std::size_t k = 0; k < forces.size(); ++k)
      for (std::size_t c = 0; c < force_components && forces[k].imposed.size() > 0; ++c)
        imposed_[m * first_.size() + c * width_ + k] =
            forces[k].imposed(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(m));
    for (std::size_t i = 0; i < damped_.size(); ++i)
      for (std::size_t c = 0; c < force_components && forces[damped_[i]].imposed_velocity.size() > 0; ++c)
        imposed_[m * first_.size() + c * width_ + forces.size() + i] =
            forces[damped_[i]].imposed_velocity(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(m));
  }
}

void ForceStatistics::step(const transient::Record& record) {
  if (record.time < from_ || kinds_.empty())
    return;
  double* inputs = inputs_.data() + static_cast<std::size_t>(waiting_) * inputs_of_record_;
  double* forces = std::copy_n(record.q, modes_, inputs);
  if (inputs_of_record_ > modes_) {
    std::fill(forces, inputs + inputs_of_record_, 0.0);
    for (const int c : record.active) {
      const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
      double* force = forces + 3 * c;
      force[0] = state.friction.x;
      force[1] = state.force_y();
      force[2] = state.force_z();
    }
  }
  instants_[static_cast<std::size_t>(waiting_)] = {record.time, record.step};
  if (++waiting_ == together)
    look_at_waiting();
}

void ForceStatistics::look_at_waiting() {
  if (waiting_ == 0)
    return;
  const std::size_t size = first_.size();
  kernels::gather_together(gather_, inputs_.data(), static_cast<int>(inputs_of_record_), values_.data(),
                           static_cast<int>(size));
  const int count = std::exchange(waiting_, 0);
  for (int k = 0; k < count; ++k)
    add(instants_[static_cast<std::size_t>(k)], values_.data() + static_cast<std::size_t>(k) * size);
}

void ForceStatistics::add(const Instant& instant, double* values) {
  const std::size_t size = first_.size();
  const auto add = [&](double factor, const double* of) {
    for (std::size_t i = 0; i < size; ++i)
      values[i] += factor * of[i];
  };
  for (std::size_t l = 0; l < loads_.size(); ++l)
    add(loads_[l](instant.time), of_loads_.data() + l * size);
  for (std::size_t m = 0; m < motions_.size(); ++m)
    add(motions_[m](instant.time).displacement, imposed_.data() + m * size);
  add_dampers(instant.time, values);
  if (!(time_ > 0.0))
    for (kernels::Array* of : {&first_, &min_, &max_})
      std::copy_n(values, size, of->begin());
  const double weight = instant.step;
  for (std::size_t i = 0; i < size; ++i) {
    const double value = values[i], d = value - first_[i];
    sums_[i] += weight * d;
    squares_[i] += weight * d * d;
    min_[i] = std::min(min_[i], value);
    max_[i] = std::max(max_[i], value);
  }
  add_products(weight, values);
  add_magnitudes(instant.time, values);
  time_ += weight;
  ends_.watch(time_, [this](double* row) { write_sums(row); });
}

void ForceStatistics::add_dampers(double time, double* values) {
  const double passed = time - time_before_;
  for (std::size_t i = 0; i < damped_.size(); ++i)
    for (std::size_t c = 0; c < force_components; ++c) {
      if (!damps_[i * force_components + c])
        continue;
      double& force = values[c * width_ + damped_[i]];
      const double dampers = values[c * width_ + kinds_.size() + i];
      double* before = before_.data() + 2 * (i * force_components + c);
      const double here = force;
      if (time_ > 0.0 && passed > 0.0)
        force = 0.5 * (here + before[0]) + (dampers - before[1]) / passed;
      before[0] = here;
      before[1] = dampers;
    }
  time_before_ = time;
}

void ForceStatistics::add_products(double weight, const double* values) {
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const double *a = values + pairs[p][0] * width_, *b = values + pairs[p][1] * width_,
                 *a0 = first_.data() + pairs[p][0] * width_, *b0 = first_.data() + pairs[p][1] * width_;
    double* sum = products_.data() + p * width_;
    for (std::size_t k = 0; k < width_; ++k)
      sum[k] += weight * (a[k] - a0[k]) * (b[k] - b0[k]);
  }
}

void ForceStatistics::add_magnitudes(double time, const double* values) {
  const auto value = [&](std::size_t component, std::size_t k) { return values[component * width_ + k]; };
  const auto square = [&](std::size_t component, std::size_t k) {
    return value(component, k) * value(component, k);
  };
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const Kind& kind = kinds_[k];
    force_[k] = std::max(force_[k], square(vy, k) + square(vz, k) + (kind.section ? 0.0 : square(n, k)));
    moment_[k] = std::max(moment_[k], square(my, k) + square(mz, k) + (kind.section ? 0.0 : square(t, k)));
    if (!kind.fibre)
      continue;
    if (const double stress = stress_of(*kind.fibre, value(n, k), value(my, k), value(mz, k));
        stress > stress_[k]) {
      stress_[k] = stress;
      stress_time_[k] = time;
    }
  }
}

void ForceStatistics::write_sums(double* row) const {
  for (std::size_t k = 0; k < kinds_.size(); ++k, row += force_sums) {
    for (std::size_t c = 0; c < force_components; ++c) {
      row[c] = sums_[c * width_ + k];
      row[squares_at + c] = squares_[c * width_ + k];
    }
    for (std::size_t p = 0; p < pairs.size(); ++p)
      row[products_at + p] = products_[p * width_ + k];
  }
}

void ForceStatistics::add_stress_deviation(const BatchSums& batches, std::size_t site,
                                           ForceSummary& out) const {
  const auto mean = [&](std::size_t c) { return sums_[c * width_ + site] / time_; };
  const auto variance = [&](std::size_t c) {
    return squares_[c * width_ + site] / time_ - mean(c) * mean(c);
  };
  const auto covariance = [&](std::size_t p) {
    return products_[p * width_ + site] / time_ - mean(pairs[p][0]) * mean(pairs[p][1]);
  };
  const std::array variances{variance(n), variance(my), variance(mz)};
  const std::array covariances{covariance(0), covariance(1), covariance(2)};
  Weights largest{};
  double square = 0.0;
  for (const Weights& w : fibres(*kinds_[site].fibre))
    if (const double s = quadratic(w, variances, covariances); s > square) {
      square = s;
      largest = w;
    }
  out.stress_std = std::sqrt(square);
  const auto* sums = batches.sums.data() + force_sums * site;
  std::vector<double> first(batches.lengths.size()), squares(first.size());
  for (std::size_t b = 0; b < first.size(); ++b) {
    first[b] = largest[0] * sums[n][b] + largest[1] * sums[my][b] + largest[2] * sums[mz][b];
    squares[b] =
        quadratic(largest, {sums[squares_at + n][b], sums[squares_at + my][b], sums[squares_at + mz][b]},
                  {sums[products_at][b], sums[products_at + 1][b], sums[products_at + 2][b]});
  }
  const double shift = largest[0] * mean(n) + largest[1] * mean(my) + largest[2] * mean(mz);
  const BatchEstimate estimate = batch_deviation(batches.lengths, first, squares, shift, out.stress_std);
  out.stress_std_error = estimate.error;
  out.batches = std::min(out.batches, estimate.batches);
}

std::vector<ForceSummary> ForceStatistics::summaries() {
  look_at_waiting();
  std::vector<ForceSummary> out(kinds_.size());
  if (!(time_ > 0.0))
    return out;
  const BatchSums batches = ends_.batches(time_, [this](double* row) { write_sums(row); });
  for (std::size_t k = 0; k < out.size(); ++k) {
    ForceSummary& o = out[k];
    o.batches = std::numeric_limits<double>::infinity();
    o.force = std::sqrt(force_[k]);
    o.moment = std::sqrt(moment_[k]);
    for (std::size_t c = 0; c < force_components; ++c) {
      const std::size_t i = c * width_ + k;
      const double shift = sums_[i] / time_;
      o.components[c] = {first_[i] + shift, std::sqrt(std::max(0.0, squares_[i] / time_ - shift * shift)),
                         min_[i], max_[i]};
      const auto* sums = batches.sums.data() + force_sums * k;
      const BatchEstimate estimate =
          batch_deviation(batches.lengths, sums[c], sums[squares_at + c], shift, o.components[c].std);
      o.std_error[c] = estimate.error;
      o.batches = std::min(o.batches, estimate.batches);
    }
    o.stress = kinds_[k].fibre ? stress_[k] : no_number;
    o.stress_time = kinds_[k].fibre ? stress_time_[k] : no_number;
    o.stress_std = o.stress_std_error = no_number;
    if (kinds_[k].fibre)
      add_stress_deviation(batches, k, o);
  }
  return out;
}

} // namespace fretwork::post
