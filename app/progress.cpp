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

bool Progress::is_due(double share, std::optional<double>& left) {
  const auto now = Clock::now();
  if (!shown_ || !(share > 0.0))
    return false;
  left = pace_.left(share, std::chrono::duration<double>(now - begin_).count());
  if (now - last_ < between_updates)
    return false;
  last_ = now;
  clear();
  return true;
}

void Progress::update_cases(std::int64_t ended, std::int64_t all, std::int64_t failed) {
  std::optional<double> left;
  if (!is_due(static_cast<double>(ended) / static_cast<double>(all), left))
    return;
  fmt::print(stderr, "{} {} of {}", stage_, ended, all);
  if (failed > 0)
    fmt::print(stderr, ", {} without a result", failed);
  if (left)
    fmt::print(stderr, "   {:.0f} s left", *left);
  std::fflush(stderr);
}

void Progress::update(double share, double time) {
  std::optional<double> left;
  if (!is_due(share, left))
    return;
  fmt::print(stderr, "{} {:5.1f} %   t = {:.4g} s", stage_, 100.0 * share, time);
  if (left)
    fmt::print(stderr, "   {:.0f} s left", *left);
  std::fflush(stderr);
}

} // namespace fretwork::app
