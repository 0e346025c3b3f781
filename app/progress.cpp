// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace fretwork::app {
namespace {

constexpr std::chrono::milliseconds between_updates{200};
constexpr double share_between_lines = 0.01; // a file holds a hundred lines at most of any stage

} // namespace

std::optional<double> Pace::left(double share, double seconds) {
  if (!begin_) {
    begin_ = {share, seconds};
    return {};
  }
  const double done = share - begin_->first;
  return done > 0.0 ? std::optional((seconds - begin_->second) * (1.0 - share) / done) : std::nullopt;
}

Progress::Progress(bool wanted, std::chrono::milliseconds between_lines)
    : shown_(wanted), on_terminal_(isatty(STDERR_FILENO) != 0), between_lines_(between_lines),
      begin_(Clock::now()), last_(begin_) {}

Progress::~Progress() { clear(); }

void Progress::clear() const {
  if (shown_ && on_terminal_)
    fmt::print(stderr, "\r\033[K");
}

void Progress::stage(const std::string& name) {
  stage_ = name;
  begin_ = last_ = Clock::now();
  last_share_ = 0.0;
  pace_ = {};
  if (!shown_ || !on_terminal_)
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
  if (on_terminal_ ? now - last_ < between_updates
                   : now - last_ < between_lines_ || share - last_share_ < share_between_lines)
    return false;
  last_ = now;
  last_share_ = share;
  clear();
  return true;
}

void Progress::update_cases(std::int64_t ended, std::int64_t all, std::int64_t failed) {
  std::optional<double> left;
  if (!is_due(static_cast<double>(ended) / static_cast<double>(all), left))
    return;
  std::string text = fmt::format("{} {} of {}", stage_, ended, all);
  if (failed > 0)
    text += fmt::format(", {} without a result", failed);
  print(text, left);
}

void Progress::update(double share, double time) {
  std::optional<double> left;
  if (is_due(share, left))
    print(fmt::format("{} {:5.1f} %   t = {:.4g} s", stage_, 100.0 * share, time), left);
}

void Progress::print(std::string text, std::optional<double> left) const {
  if (left)
    text += fmt::format("   {:.0f} s left", *left);
  fmt::print(stderr, "{}{}", text, on_terminal_ ? "" : "\n");
  std::fflush(stderr);
}

} // namespace fretwork::app
