// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace fretwork::app {
namespace {

constexpr std::chrono::milliseconds between_updates{200};

} // namespace

Progress::Progress(bool wanted)
    : shown_(wanted && isatty(STDERR_FILENO)), begin_(Clock::now()), last_(begin_) {}

Progress::~Progress() { clear(); }

void Progress::clear() const {
  if (shown_)
    fmt::print(stderr, "\r\033[K");
}

void Progress::stage(const std::string& name) {
  stage_ = name;
  begin_ = last_ = Clock::now();
  if (!shown_)
    return;
  clear();
  if (!stage_.empty())
    fmt::print(stderr, "{} ...", stage_);
  std::fflush(stderr);
}

void Progress::update(double share, double time) {
  const auto now = Clock::now();
  if (!shown_ || now - last_ < between_updates || !(share > 0.0))
    return;
  last_ = now;
  const double spent = std::chrono::duration<double>(now - begin_).count();
  clear();
  fmt::print(stderr, "{} {:5.1f} %   t = {:.4g} s   {:.0f} s left", stage_, 100.0 * share, time,
             spent * (1.0 / share - 1.0));
  std::fflush(stderr);
}

} // namespace fretwork::app
