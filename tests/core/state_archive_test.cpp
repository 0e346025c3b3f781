// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/state_archive.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace fretwork::core::state_archive_test {
namespace {

struct Plain {
  int a;
  double b;
};

struct Part {
  std::vector<double> values;
  bool flag = false;
  void visit(StateArchive& state) { state(values, flag); }
};

struct Whole {
  double number = 0.0;
  Plain plain{};
  std::array<Part, 2> parts;
  int numbers[3] = {};
  std::vector<Part> list;
  std::vector<int> growing;
  void visit(StateArchive& state) { state(number, plain, parts, numbers, list, growing); }
};

Whole made_up() {
  Whole w{0.1, {3, -0.0}, {}, {1, 2, 3}, std::vector<Part>(2), {7, 8}};
  w.parts[1].values = {1.5, 2.5};
  w.list[1].flag = true;
  return w;
}

std::string saved(Whole& whole) {
  StateArchive state;
  state(whole);
  state.end();
  return std::move(state).bytes();
}

/// Made anew, with the room that the other one has.
Whole anew() {
  Whole w;
  w.parts[1].values.resize(2);
  w.list.resize(2);
  w.growing.reserve(5);
  return w;
}

TEST(StateArchive, RestoresWhatItSaved) {
  Whole from = made_up(), to = anew();
  const std::string bytes = saved(from);
  StateArchive state(bytes);
  state(to);
  state.end();
  EXPECT_EQ(to.number, 0.1);
  EXPECT_EQ(to.plain.a, 3);
  EXPECT_TRUE(std::signbit(to.plain.b));
  EXPECT_EQ(to.parts[1].values, from.parts[1].values);
  EXPECT_EQ(to.numbers[2], 3);
  EXPECT_TRUE(to.list[1].flag);
  EXPECT_EQ(to.growing, from.growing);
  EXPECT_EQ(saved(to), bytes);
}

TEST(StateArchive, KeepsArraysInTheirPlace) {
  Whole from = made_up(), to = anew();
  const double* values = to.parts[1].values.data();
  const int* growing = to.growing.data();
  StateArchive state(saved(from));
  state(to);
  EXPECT_EQ(to.parts[1].values.data(), values);
  EXPECT_EQ(to.growing.data(), growing);
}

TEST(StateArchive, RefusesWhatDoesNotFit) {
  Whole from = made_up();
  const std::string bytes = saved(from);
  const auto restore = [](std::string wrong, Whole to) {
    StateArchive state(std::move(wrong));
    state(to);
    state.end();
  };
  EXPECT_NO_THROW(restore(bytes, anew()));
  EXPECT_THROW(restore(bytes + "x", anew()), StateMismatch);
  EXPECT_THROW(restore(bytes.substr(0, bytes.size() - 1), anew()), StateMismatch);
  EXPECT_THROW(restore("", anew()), StateMismatch);
  Whole small = anew();
  small.list.pop_back();
  small.list.shrink_to_fit();
  EXPECT_THROW(restore(bytes, small), StateMismatch);
}

} // namespace
} // namespace fretwork::core::state_archive_test
