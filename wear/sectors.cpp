// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/sectors.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include <fmt/format.h>
#include <numeric>

namespace fretwork::wear {

namespace {

std::size_t checked(int sectors) {
  if (sectors < 1 || sectors > SectorWork::most)
    throw core::Error(
        fmt::format("wear: {} sectors make no sense; give a number from 1 to {}", sectors, SectorWork::most));
  return static_cast<std::size_t>(sectors);
}

} // namespace

SectorWork::SectorWork(int sectors) : work_(checked(sectors), 0.0) {}

double SectorWork::total() const { return std::accumulate(work_.begin(), work_.end(), 0.0); }

std::vector<double> SectorWork::rates(double duration) const {
  check_positive("work by sector", "length of the window", duration, "s");
  std::vector<double> out(work_);
  for (double& value : out)
    value /= duration;
  return out;
}

} // namespace fretwork::wear
