// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels that move the modes against plain loops.
#include "kernels/kernels.hpp"
#include "vibration/oscillator.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <tuple>
#include <vector>

namespace kernels_test {

using namespace fretwork;
using namespace fretwork::vibration;

namespace {

constexpr double round_off = 1e-14; // relative to the sum of magnitudes
constexpr double step = 1e-3;

struct Modes {
  int count, padded;
  std::vector<double> stiffness;
  std::vector<kernels::StepCoefficients> coefficients;
  kernels::FlowTable table;
  kernels::Array k, q, v, f0, f1;
};

kernels::Array random_values(int count, std::mt19937& generator) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  kernels::Array out(static_cast<std::size_t>(kernels::padded(count)), 0.0);
  std::generate_n(out.begin(), count, [&] { return value(generator); });
  return out;
}

/// Slow and fast modes, every third of them rigid or damped beyond oscillation.
Modes some_modes(int count) {
  std::mt19937 generator(static_cast<unsigned>(count));
  Modes m{count, kernels::padded(count), {}, {}, kernels::FlowTable(kernels::padded(count)), {}, {}, {}, {},
          {}};
  m.k.assign(static_cast<std::size_t>(m.padded), 0.0);
  for (int i = 0; i < count; ++i) {
    const double w = i % 3 == 1 ? 0.0 : 30.0 * (i + 1), c = i % 3 == 2 ? 3.0 * w : 0.01 * w;
    m.stiffness.push_back(w * w);
    m.coefficients.push_back(step_coefficients(w * w, c, step));
    m.table.set(i, w * w, m.coefficients.back());
    m.k[static_cast<std::size_t>(i)] = w * w;
  }
  m.q = random_values(count, generator);
  m.v = random_values(count, generator);
  m.f0 = random_values(count, generator);
  m.f1 = random_values(count, generator);
  return m;
}

/// For numbers of modes, in vectors of 2, 4 and 8 doubles, as far as the processor has them.
class MovingKernels : public testing::TestWithParam<std::tuple<int, kernels::VectorSize>> {
protected:
  MovingKernels() { kernels::limit_vectors(std::get<1>(GetParam())); }
  ~MovingKernels() override { kernels::limit_vectors(kernels::VectorSize::pack); }
  const int modes_ = std::get<0>(GetParam());
};

void expect_padding_at_rest(const Modes& m) {
  for (auto i = static_cast<std::size_t>(m.count); i < m.q.size(); ++i) {
    EXPECT_EQ(m.q[i], 0.0);
    EXPECT_EQ(m.v[i], 0.0);
  }
}

} // namespace

TEST_P(MovingKernels, FollowTheCoefficientsUnderLoadsAndSumTheirWorkAndTheEnergy) {
  Modes m = some_modes(modes_);
  const kernels::Array q0 = m.q, v0 = m.v;
  const kernels::FlowSums sums =
      kernels::flow_loaded(m.padded, m.table, m.q.data(), m.v.data(), m.f0.data(), m.f1.data());
  double work = 0.0, energy = 0.0, size = 0.0;
  for (std::size_t i = 0; i < m.coefficients.size(); ++i) {
    const kernels::StepCoefficients& s = m.coefficients[i];
    const double a = m.f0[i], b = m.f1[i];
    const double q = s.qq * q0[i] + s.qv * v0[i] + s.qf0 * a + s.qf1 * b;
    const double v = s.vq * q0[i] + s.vv * v0[i] + s.vf0 * a + s.vf1 * b;
    const double mean = s.mq * q0[i] + s.mv * v0[i] + s.mf0 * a + s.mf1 * b;
    EXPECT_NEAR(m.q[i], q, round_off);
    EXPECT_NEAR(m.v[i], v, round_off * (1.0 + std::sqrt(m.stiffness[i])));
    work += a * (q - q0[i]) + (b - a) * (q - mean);
    energy += v * v + m.stiffness[i] * q * q;
    size += std::abs(a) + std::abs(b);
  }
  EXPECT_NEAR(sums.work, work, round_off * size);
  EXPECT_NEAR(sums.twice_energy, energy, round_off * energy);
  EXPECT_EQ(sums.twice_energy, kernels::twice_energy(m.padded, m.k.data(), m.q.data(), m.v.data()));
  expect_padding_at_rest(m);
}

TEST_P(MovingKernels, MoveFreeModesAsUnderNoLoad) {
  Modes free = some_modes(modes_), loaded = free;
  std::fill(loaded.f0.begin(), loaded.f0.end(), 0.0);
  const kernels::FlowSums sums = kernels::flow_free(free.padded, free.table, free.q.data(), free.v.data());
  const kernels::FlowSums same = kernels::flow_loaded(loaded.padded, loaded.table, loaded.q.data(),
                                                      loaded.v.data(), loaded.f0.data(), loaded.f0.data());
  EXPECT_EQ(free.q, loaded.q);
  EXPECT_EQ(free.v, loaded.v);
  EXPECT_EQ(sums.work, 0.0);
  EXPECT_EQ(sums.twice_energy, same.twice_energy);
  expect_padding_at_rest(free);
}

TEST_P(MovingKernels, CombineAnyNumberOfShapes) {
  std::mt19937 generator(1);
  for (const int sources : {1, 2, 4, 5, 9}) {
    const int n = modes_, padded = kernels::padded(n);
    kernels::Array shapes;
    for (int s = 0; s < sources; ++s) {
      const kernels::Array shape = random_values(n, generator);
      shapes.insert(shapes.end(), shape.begin(), shape.end());
    }
    const kernels::Array values = random_values(sources, generator);
    kernels::Array force(static_cast<std::size_t>(padded), -1.0);
    kernels::combine(padded, sources, shapes.data(), values.data(), force.data());
    for (int i = 0; i < padded; ++i) {
      double sum = 0.0;
      for (int s = 0; s < sources; ++s)
        sum += values[static_cast<std::size_t>(s)] * shapes[static_cast<std::size_t>(s * padded + i)];
      EXPECT_NEAR(force[static_cast<std::size_t>(i)], sum, round_off * sources);
    }
  }
}

TEST_P(MovingKernels, ScatterRowsToSeveralVectors) {
  const int count = std::get<0>(GetParam()), np = kernels::padded(count), rows = 7;
  std::mt19937 generator(static_cast<unsigned>(count));
  std::vector<kernels::Array> row, factor, v;
  std::vector<const double*> starts;
  for (int r = 0; r < rows; ++r)
    row.push_back(random_values(count, generator));
  for (const kernels::Array& r : row)
    starts.push_back(r.data());
  for (int t = 0; t < kernels::most_scattered; ++t) {
    factor.push_back(random_values(rows, generator));
    v.push_back(random_values(count, generator));
  }
  for (int targets = 2; targets <= kernels::most_scattered; ++targets) {
    std::vector<kernels::Array> found = v;
    std::vector<kernels::ScatterTarget> to;
    for (std::size_t t = 0; t < found.size(); ++t)
      to.push_back({factor[t].data(), found[t].data()});
    kernels::scatter_several(np, rows, starts.data(), targets, to.data());
    for (std::size_t t = 0; t < found.size(); ++t)
      for (std::size_t i = 0; i < found[t].size(); ++i) {
        double expected = v[t][i];
        for (std::size_t r = 0; t < static_cast<std::size_t>(targets) && r < row.size(); ++r)
          expected += factor[t][r] * row[r][i];
        EXPECT_NEAR(found[t][i], expected, rows * round_off) << targets << " " << t << " " << i;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(OfModes, MovingKernels,
                         testing::Combine(testing::Values(1, 7, 8, 9, 23, 40, 60),
                                          testing::Values(kernels::VectorSize::pair,
                                                          kernels::VectorSize::half,
                                                          kernels::VectorSize::pack)));

} // namespace kernels_test
