// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/coupled_contacts.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hold_back_test {

using namespace fretwork;
using namespace fretwork::transient;

namespace {

constexpr double h = 1e-3, stiffness = 1e6; // s, N/m
constexpr double own = 1.2, by_other = 0.5; // 1/kg
constexpr double held_back = 3.0 / (h * h); // V over W, 1/s2: of modes of w h = 1.7
constexpr std::array at = {1e-5, 2e-5};     // m, penetrations where the step begins
constexpr std::array speeds = {0.05, 0.02}; // m/s, likewise, and of the path

/// Mean and slope of the force of each contact along y, N.
using Forces = std::array<std::array<double, 2>, 2>;

std::vector<ContactPoint> on_stops(std::size_t count) {
  std::vector<ContactPoint> contacts;
  for (std::size_t c = 0; c < count; ++c) {
    ContactPoint point;
    point.name = "c" + std::to_string(c);
    point.support = {contact::Stop{0.0, contact::PlaneAxis::y}, {stiffness}, {}};
    point.b = Eigen::MatrixXd::Zero(3, 2);
    point.b(1, static_cast<Eigen::Index>(c)) = 1.0;
    contacts.push_back(point);
  }
  return contacts;
}

double mobility(std::size_t to, std::size_t from) { return to == from ? own : by_other; }

/// Through a step in so many intervals.
Forces in_intervals(std::size_t count, int intervals, double v_over_w) {
  Scene scene;
  scene.system.stiffness = scene.system.damping = scene.q0 = scene.v0 = Eigen::Vector2d::Zero();
  scene.contacts = on_stops(count);
  const PackedContacts packed(scene.contacts, 2);
  std::vector<std::vector<ImpulseResponse>> responses(1, std::vector<ImpulseResponse>(count * count));
  for (std::size_t from = 0; from < count; ++from)
    for (std::size_t to = 0; to < count; ++to) {
      responses[0][from * count + to].w.add(0, 0, mobility(to, from));
      responses[0][from * count + to].v.add(0, 0, v_over_w * mobility(to, from));
    }
  CoupledContacts contacts(packed, ContactBlocks(scene), responses, h, intervals);
  ContactMotion start(packed), end(packed);
  std::vector<int> near;
  for (std::size_t c = 0; c < count; ++c) {
    near.push_back(static_cast<int>(c));
    start.u[c] = at[c];
    end.u[c] = at[c] + h * speeds[c];
    start.w[c] = end.w[c] = speeds[c];
    contacts.preload(near.back(), start.locate(near.back()), stiffness * at[c]);
  }
  ContactTrial trial(packed.count);
  ContactLosses losses;
  contacts.make({start, end, kernels::Array(start.u.size(), 0.0)}, near, trial, losses);
  Forces out{};
  for (std::size_t c = 0; c < count; ++c)
    out[c] = {contacts.force(near[c]).mean.y(), contacts.force(near[c]).slope.y()};
  return out;
}

/// By the convolution of the forces with W t - V t^3/6, with the trapezoidal rule.
Forces exact(std::size_t count) {
  constexpr std::size_t steps = 2000;
  constexpr double dt = h / steps;
  std::array<std::vector<double>, 2> change; // of the forces, N
  Forces out{};
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) * dt;
    std::array<double, 2> moved{};
    for (std::size_t j = 0; j < i; ++j) { // the last, t - s = 0, adds nothing
      const double s = t - static_cast<double>(j) * dt, g = s - held_back * s * s * s / 6.0;
      for (std::size_t to = 0; to < count; ++to)
        for (std::size_t from = 0; from < count; ++from)
          moved[to] += (j == 0 ? 0.5 : 1.0) * dt * g * mobility(to, from) * change[from][j];
    }
    for (std::size_t c = 0; c < count; ++c) {
      const double u = at[c] + speeds[c] * t + moved[c], force = -stiffness * u, x = 2.0 * t / h - 1.0;
      change[c].push_back(force + stiffness * at[c]);
      const double weight = (i == 0 || i == steps ? 0.5 : 1.0) / steps;
      out[c][0] += weight * force;
      out[c][1] += 3.0 * weight * x * force;
    }
  }
  return out;
}

/// Of the means and slopes: the largest difference, over the largest change of a force in the step.
double difference(std::size_t count, const Forces& a, const Forces& b) {
  double out = 0.0;
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t k = 0; k < a[c].size(); ++k)
      out = std::max(out, std::abs(a[c][k] - b[c][k]));
  return out / (stiffness * h * speeds[0]);
}

} // namespace

// Each halving of the intervals leaves a tenth of the error and less; without V a hundredth of the change would be missing in any number of them.
TEST(HoldBack, FollowsTheConvolutionWithTheImpulseResponse) {
  for (const std::size_t count : {1U, 2U}) {
    const Forces right = exact(count);
    double before = 2e-3;
    for (const int intervals : {2, 4, 8}) {
      const double error = difference(count, in_intervals(count, intervals, held_back), right);
      EXPECT_LT(error, before) << count << ' ' << intervals;
      EXPECT_GT(difference(count, in_intervals(count, intervals, 0.0), right), 1e-2) << count;
      before = error / 10.0;
    }
  }
}

} // namespace hold_back_test
