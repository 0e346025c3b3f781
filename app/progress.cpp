// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace fretwork::app {
namespace {

constexpr std::chrono::milliseconds between_updates{200};

} // namespace

std::optional<double> Pace::left(double share, double seconds) {
  if (!begin_) {
    begin_ = {share, seconds};
    return {};
  }
  const double done = share - begin_->first;
  return done > 0.0 ? std::optional((seconds - begin_->second) * (1.0 - share) / done) : std::nullopt;
}

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
  pace_ = {};
  if (!shown_)
    return;
  clear();
  if (!stage_.empty())
    fmt::print(stderr, "{} ...", stage_);
  std::fflush(stderr);
}

void Progress::update(double share, double time) {
  const auto now = Clock::now();
  if (!shown_ || !(share > 0.0))
    return;
  const std::optional<double> left = pace_.left(share, std::chrono::duration<double>(now - begin_).count());
  if (now - last_ < between_updates)
    return;
  last_ = now;
  clear();
  fmt::print(stderr, "{} {:5.1f} %   t = {:.4g} s", stage_, 100.0 * share, time);
  if (left)
    fmt::print(stderr, "   {:.0f} s left", *left);
  std::fflush(stderr);
}

} // namespace fretwork::app
