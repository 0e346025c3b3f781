// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/check.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::wear {

namespace {

[[noreturn]] void refuse(std::string_view where, std::string_view name, double value, std::string_view unit,
                         std::string_view range) {
  throw core::Error(fmt::format("{}: {} = {:g}{}{} makes no sense; give a finite number {} 0", where, name,
                                value, unit.empty() ? "" : " ", unit, range));
}

} // namespace

void check_positive(std::string_view where, std::string_view name, double value, std::string_view unit) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse(where, name, value, unit, ">");
}

void check_not_negative(std::string_view where, std::string_view name, double value, std::string_view unit) {
  if (!(value >= 0.0) || !std::isfinite(value))
    refuse(where, name, value, unit, ">=");
}

} // namespace fretwork::wear
