// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/power_balance.hpp"
#include <algorithm>
#include <functional>

namespace fretwork::post {
namespace {

/// In the order of PowerBalance.
std::array<double, 6> energy_terms(const transient::Energy& e) {
  return {e.load_work, e.fluid_work, e.modal_damping, e.contact_damping, e.friction, e.stored};
}

} // namespace

PowerStatistics::PowerStatistics(double from) : from_(from), ends_(terms) {}

void PowerStatistics::step(const transient::Record& record) {
  if (!seen_) { // the run begins
    transient::Energy start;
    start.start(record.energy.initial);
    before_ = now_ = energy_terms(start);
    seen_ = true;
  }
  now_ = energy_terms(record.energy);
  if (record.time < from_) {
    before_ = now_;
    return;
  }
  time_ += record.step;
  ends_.watch(time_, [this](double* row) { write_sums(row); });
}

void PowerStatistics::write_sums(double* row) const {
  std::transform(now_.begin(), now_.end(), before_.begin(), row, std::minus<>());
}

PowerBalance PowerStatistics::balance() const {
  if (!(time_ > 0.0))
    return {};
  const BatchSums batches = ends_.batches(time_, [this](double* row) { write_sums(row); });
  const auto mean = [&](std::size_t term) {
    return MeanPower{(now_[term] - before_[term]) / time_,
                     batch_means(batches.lengths, batches.sums[term]).error};
  };
  return {mean(0), mean(1), mean(2), mean(3), mean(4), mean(5)};
}

} // namespace fretwork::post
