// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/reference_solution.hpp"
#include "core/error.hpp"
#include "transient/scene_rates.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::bench {
namespace {

constexpr double converged = 1e-5; ///< change of a contact force, of the largest
constexpr int most_sweeps = 60;
constexpr double broad_phase_angle = 0.5; ///< rad of the highest mode between two broad phases
constexpr std::int64_t most_broad_phase_steps = 16, macro_step_pause = 8;
constexpr double candidate_share = 3.0, clear_share = 0.16, travel_share = 0.5;

double shortest_step(const transient::Scene& scene, double resolution) {
  if (scene.system.damping_matrix.size() > 0 || !scene.motions.empty())
    throw core::Error("the reference solution takes neither coupled damping nor moving obstacles");
  const transient::SceneRates rates = transient::rates_of(scene);
  double h = scene.duration / 1000.0;
  const auto limit = [&](double share, double rate) { h = rate > 0.0 ? std::min(h, share / rate) : h; };
  limit(resolution, rates.contact_frequency);
  limit(resolution, rates.stick_frequency);
  limit(5.0 * resolution, rates.damper_rate);
  limit(10.0 * resolution, transient::relaxation_rate(scene));
  limit(10.0 * resolution, rates.highest_mode);
  return h;
}

double speed_of(Local v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

} // namespace

ReferenceSolution::ReferenceSolution(const transient::Scene& scene, double resolution)
    : scene_(scene), count_(scene.contacts.size()), h_(shortest_step(scene, resolution)), flow_(scene, h_),
      open_since_(count_, 0), speed_(count_, 0.0), speeds_(count_), forces_(count_) {
  const auto& order = flow_.order();
  Eigen::MatrixXd b(static_cast<Eigen::Index>(3 * count_), scene.system.size());
  for (std::size_t c = 0; c < count_; ++c) {
    const Eigen::MatrixXd& one = scene.contacts[c].b;
    b.middleRows(static_cast<Eigen::Index>(3 * c), 3) = one;
    contacts_.emplace_back(scene.contacts[c].support, h_);
    Rows& rows = rows_.emplace_back();
    rows.in_plane = !one.row(0).isZero(0.0);
    for (const Eigen::Index i : order)
      rows.x.push_back(one(0, i));
    for (std::size_t i = flow_.moving_y().begin; i < flow_.moving_y().end; ++i)
      rows.y.push_back(one(1, order[i]));
    for (std::size_t i = flow_.moving_z().begin; i < flow_.moving_z().end; ++i)
      rows.z.push_back(one(2, order[i]));
  }
  const Eigen::MatrixXd w = 0.5 * h_ * b * b.transpose();
  coupling_.resize(9 * count_ * count_);
  for (std::size_t c = 0; c < count_; ++c)
    for (std::size_t d = 0; d < count_; ++d)
      for (std::size_t k = 0; k < 9; ++k)
        coupling_[9 * (c * count_ + d) + k] =
            w(static_cast<Eigen::Index>(3 * c + k / 3), static_cast<Eigen::Index>(3 * d + k % 3));
  const double highest = std::sqrt(scene.system.stiffness.maxCoeff());
  broad_phase_every_ = most_broad_phase_steps;
  if (highest > 0.0)
    broad_phase_every_ = std::clamp(static_cast<std::int64_t>(broad_phase_angle / (highest * h_)),
                                    std::int64_t{1}, broad_phase_every_);
}

Local ReferenceSolution::velocity(std::size_t c, const std::vector<double>& v) const {
  const Rows& rows = rows_[c];
  return {rows.in_plane ? inner(v.size(), rows.x.data(), v.data()) : 0.0,
          inner(rows.y.size(), rows.y.data(), v.data() + flow_.moving_y().begin),
          inner(rows.z.size(), rows.z.data(), v.data() + flow_.moving_z().begin)};
}

Local ReferenceSolution::position(std::size_t c, const std::vector<double>& q) const {
  const core::Vec3& rest = scene_.contacts[c].rest;
  const Local u = velocity(c, q);
  return {u.x + rest.x(), u.y + rest.y(), u.z + rest.z()};
}

void ReferenceSolution::add_impulse(std::size_t c, double weight) {
  const Rows& rows = rows_[c];
  const Local f = forces_[c];
  if (rows.in_plane)
    add(rows.x.size(), weight * h_ * f.x, rows.x.data(), flow_.v.data());
  add(rows.y.size(), weight * h_ * f.y, rows.y.data(), flow_.v.data() + flow_.moving_y().begin);
  add(rows.z.size(), weight * h_ * f.z, rows.z.data(), flow_.v.data() + flow_.moving_z().begin);
}

void ReferenceSolution::run(double from) {
  const auto total = static_cast<std::int64_t>(scene_.duration / h_);
  const auto first = static_cast<std::int64_t>(std::ceil(from / h_));
  length_ = (static_cast<double>(total - first) + 0.5) * h_;
  instant(first == 0, 0.5);
  while (flow_.unit() < total) {
    if (!(touching_.empty() && flow_.unit() >= next_macro_step_ && macro_step(total)))
      flow_.advance();
    ++flows_;
    instant(flow_.unit() >= first, 1.0);
  }
}

/// Macro-step: one flow over several steps in which all contacts stay open. Returns whether there was one.
bool ReferenceSolution::macro_step(std::int64_t end) {
  if (next_broad_phase_ != flow_.unit() + broad_phase_every_)
    broad_phase();
  double time = static_cast<double>(std::min(end - flow_.unit(), flow_.steps_to_row())) * h_;
  for (std::size_t c = 0; c < count_; ++c)
    time = std::min(time, travel_share * contacts_[c].gap() / std::max(speed_[c], 1e-300));
  int level = 0;
  while (level + 1 < flow_.levels() && std::ldexp(h_, level + 1) <= time)
    ++level;
  for (; level > 0; --level) {
    flow_.extrapolate(level);
    const double length = std::ldexp(h_, level);
    bool clear = true;
    for (std::size_t c = 0; c < count_ && clear; ++c) {
      const Local at = position(c, flow_.far_q);
      const double gap = contact::locate(scene_.contacts[c].support.obstacle, at.y, at.z).gap,
                   moved = length * (speed_[c] + speed_of(velocity(c, flow_.far_v)));
      clear = std::min(gap, contacts_[c].gap()) > clear_share * moved;
    }
    if (!clear)
      continue;
    flow_.accept();
    next_broad_phase_ = flow_.unit();
    return true;
  }
  next_macro_step_ = flow_.unit() + macro_step_pause;
  return false;
}

/// Broad phase: the contacts that may close before the next one.
void ReferenceSolution::broad_phase() {
  double fastest = 0.0;
  for (std::size_t c = 0; c < count_; ++c) {
    speed_[c] = speed_of(velocity(c, flow_.v));
    fastest = std::max(fastest, speed_[c]);
  }
  next_broad_phase_ = flow_.unit() + broad_phase_every_;
  const double bound = candidate_share * fastest * static_cast<double>(broad_phase_every_) * h_;
  std::vector<std::size_t> before;
  before.swap(candidates_);
  for (std::size_t c = 0; c < count_; ++c) {
    bool candidate = contacts_[c].closed();
    if (!candidate && contacts_[c].place(position(c, flow_.q))) {
      candidate = true;
      missed_ += flow_.unit() > 0 && std::find(before.begin(), before.end(), c) == before.end() ? 1 : 0;
    } else if (!candidate) {
      contacts_[c].leave_open(flow_.unit() - open_since_[c]);
      open_since_[c] = flow_.unit();
      candidate = contacts_[c].gap() <= bound || flow_.unit() == 0;
    }
    if (candidate)
      candidates_.push_back(c);
  }
}

void ReferenceSolution::instant(bool in_window, double weight) {
  touching_.clear();
  if (flow_.unit() >= next_broad_phase_)
    broad_phase();
  for (const std::size_t c : candidates_)
    if (contacts_[c].place(position(c, flow_.q))) {
      touching_.push_back(c);
    } else {
      contacts_[c].leave_open(flow_.unit() - open_since_[c]);
      open_since_[c] = flow_.unit();
    }
  if (touching_.empty())
    return;
  solve(weight);
  for (const std::size_t c : touching_) {
    contacts_[c].commit(in_window, weight);
    open_since_[c] = flow_.unit();
    add_impulse(c, weight);
  }
}

/// Gauss-Seidel over the contacts with p >= 0, from their forces at the instant before.
void ReferenceSolution::solve(double weight) {
  const auto shift = [&](std::size_t c, std::size_t d, Local df) { // the mean velocity of c by a force of d
    const double* r = coupling_.data() + 9 * (c * count_ + d);
    Local& v = speeds_[c];
    v.x += weight * (r[0] * df.x + r[1] * df.y + r[2] * df.z);
    v.y += weight * (r[3] * df.x + r[4] * df.y + r[5] * df.z);
    v.z += weight * (r[6] * df.x + r[7] * df.y + r[8] * df.z);
  };
  for (const std::size_t c : touching_) {
    speeds_[c] = velocity(c, flow_.v);
    contacts_[c].start(speeds_[c]);
    if (!contacts_[c].closed())
      forces_[c] = {};
  }
  for (const std::size_t c : touching_)
    for (const std::size_t d : touching_)
      if (c != d)
        shift(c, d, forces_[d]);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0.0, largest = 0.0;
    for (const std::size_t c : touching_) {
      Response own;
      for (std::size_t k = 0; k < 9; ++k)
        own[k] = weight * coupling_[9 * (c * count_ + c) + k];
      const Local f = contacts_[c].force(speeds_[c], own), before = forces_[c];
      const Local df{f.x - before.x, f.y - before.y, f.z - before.z};
      forces_[c] = f;
      for (const std::size_t d : touching_)
        if (d != c)
          shift(d, c, df);
      change = std::max({change, std::abs(df.x), std::abs(df.y), std::abs(df.z)});
      largest = std::max({largest, std::abs(f.x), std::abs(f.y), std::abs(f.z)});
    }
    solved_ += static_cast<std::int64_t>(touching_.size());
    if (change <= converged * largest)
      return;
  }
  ++unconverged_;
}

std::vector<ReferenceFigures> ReferenceSolution::figures() const {
  std::vector<ReferenceFigures> out;
  for (const ReferenceContact& contact : contacts_)
    out.push_back(contact.figures(length_));
  return out;
}

} // namespace fretwork::bench
