// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/expected_time.hpp"
#include "core/error.hpp"
#include <fmt/format.h>

namespace fretwork::app {
namespace {

constexpr double minute = 60.0, hour = 3600.0; // s

std::string in_words(double seconds) {
  return seconds < hour ? fmt::format("{:.0f} min", seconds / minute)
                        : fmt::format("{:.3g} h", seconds / hour);
}

} // namespace

void ExpectedTime::look(double time) {
  if (told_ || time <= begin_ || Clock::now() - start_ < settling)
    return;
  told_ = true;
  const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
  const double left = spent * (limit_.duration - time) / (time - begin_);
  if (left > limit_.most_hours * hour)
    throw core::Error(fmt::format(
        "transient: {:.3g} s of {:.6g} s have taken {:.2g} s; the rest would take {}, more than "
        "transient.max_hours = {:g}; shorten the duration, take a longer step, or raise max_hours",
        time - begin_, limit_.duration, spent, in_words(left), limit_.most_hours));
  if (left > worth_telling)
    limit_.tell(fmt::format("transient: {} to go", in_words(left)));
}

} // namespace fretwork::app
