// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The state of objects as bytes, to go on from it later in objects made anew from the same inputs.
///
/// A class says once what its state is, for both directions:
///     void visit(core::StateArchive& state) { state(time_, q_, memory_); }
/// What follows from the constructor's arguments is no part of it. Plain values go as they lie in memory: a state belongs to the program
/// that saved it.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace fretwork::core {

/// The bytes are not the state of these objects.
class StateMismatch : public std::runtime_error {
public:
  StateMismatch() : std::runtime_error("the saved state does not fit the run") {}
};

/// True for types that are no state: where they point to means nothing in another process.
template <class T> inline constexpr bool points_elsewhere = std::is_pointer_v<T>;

class StateArchive {
public:
  /// To save into.
  StateArchive() = default;
  /// To restore from.
  explicit StateArchive(std::string bytes) : bytes_(std::move(bytes)), restores_(true) {}

  /// Saves or restores, one after the other: objects with `visit`, plain values, and vectors and arrays of these.
  /// @throws StateMismatch
  template <class... T> void operator()(T&... values) { (visit(values), ...); }

  /// `count` plain values.
  /// @throws StateMismatch
  template <class T> void block(T* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && !points_elsewhere<T>);
    const std::size_t size = count * sizeof(T);
    if (size == 0)
      return;
    if (!restores_) {
      bytes_.append(reinterpret_cast<const char*>(first), size);
      return;
    }
    if (size > bytes_.size() - at_)
      throw StateMismatch();
    std::memcpy(first, bytes_.data() + at_, size);
    at_ += size;
  }

  /// What has been saved.
  [[nodiscard]] std::string bytes() && { return std::move(bytes_); }
  /// After the last value is restored.
  /// @throws StateMismatch where there is more
  void end() const {
    if (restores_ && at_ != bytes_.size())
      throw StateMismatch();
  }

private:
  template <class T> void visit(T& value) {
    if constexpr (requires { value.visit(*this); })
      value.visit(*this);
    else
      block(&value, 1);
  }
  template <class T, std::size_t n> void visit(std::array<T, n>& values) {
    for (T& value : values)
      visit(value);
  }
  template <class T, std::size_t n> void visit(T (&values)[n]) {
    for (T& value : values)
      visit(value);
  }
  /// Its length may differ from that of the object made anew, but not beyond what that has reserved: pointers into it stay good.
  template <class T, class Allocator> void visit(std::vector<T, Allocator>& values) {
    auto size = static_cast<std::uint64_t>(values.size());
    visit(size);
    if (restores_) {
      if (size > values.capacity())
        throw StateMismatch();
      values.resize(size);
    }
    if constexpr (requires(T & value) { value.visit(*this); })
      for (T& value : values)
        visit(value);
    else
      block(values.data(), values.size());
  }

  std::string bytes_;
  std::size_t at_ = 0; ///< of what is restored next
  bool restores_ = false;
};

} // namespace fretwork::core
