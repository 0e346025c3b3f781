// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/dormand_prince.hpp"
#include "transient/explicit/motion_rates.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

constexpr double nodes[] = {0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
constexpr double weights[7][6] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}, // the solution
};
/// Solution of order 5 minus that of order 4.
constexpr double differences[7] = {71.0 / 57600,      0.0,        -71.0 / 16695, 71.0 / 1920,
                                   -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
constexpr double extension[7] = {-12715105075.0 / 11282082432.0,  0.0,
                                 87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
                                 701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
                                 69997945.0 / 29380423.0};

} // namespace

DormandPrince::DormandPrince(int size) {
  for (kernels::Array* a : {&y0_, &y1_, &error_})
    a->assign(static_cast<std::size_t>(size), 0.0);
  for (auto& a : k_)
    a = y0_;
  for (auto& a : r_)
    a = y0_;
}

/// target += h sum factors[j] k[j]
void DormandPrince::combine(const double* factors, int count, double h, kernels::Array& target) {
  int used = 0;
  for (int j = 0; j < count; ++j)
    if (factors[j] != 0.0) {
      rows_[static_cast<std::size_t>(used)] = k_[static_cast<std::size_t>(j)].data();
      scaled_[static_cast<std::size_t>(used++)] = h * factors[j];
    }
  kernels::scatter(static_cast<int>(target.size()), used, rows_.data(), scaled_.data(), target.data());
}

void DormandPrince::make(MotionRates& rates, double time, double h) {
  for (int s = 1; s < stages; ++s) {
    y1_ = y0_;
    combine(weights[s], s, h, y1_);
    rates.rate(time + nodes[s] * h, y1_.data(), k_[static_cast<std::size_t>(s)].data());
  }
}

const double* DormandPrince::error(double h) {
  std::fill(error_.begin(), error_.end(), 0.0);
  combine(differences, stages, h, error_);
  return error_.data();
}

void DormandPrince::extend(double h) {
  for (std::size_t i = 0; i < y0_.size(); ++i) {
    const double change = y1_[i] - y0_[i];
    r_[0][i] = y0_[i];
    r_[1][i] = change;
    r_[2][i] = h * k_[0][i] - change;
    r_[3][i] = change - h * k_[6][i] - r_[2][i];
    r_[4][i] = 0.0;
  }
  combine(extension, stages, h, r_[4]);
}

void DormandPrince::inside(double share, kernels::Array& y) const {
  const auto factor = factors(share);
  y = r_[0];
  for (std::size_t j = 1; j < terms; ++j)
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += factor[j] * r_[j][i];
}

std::array<double, DormandPrince::terms> DormandPrince::factors(double share) {
  const double rest = 1.0 - share;
  return {1.0, share, share * rest, share * rest * share, share * rest * share * rest};
}

void DormandPrince::advance() {
  y0_.swap(y1_);
  k_[0].swap(k_[stages - 1]);
}

} // namespace fretwork::transient
