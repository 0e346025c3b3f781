// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The words of a .msh file, one after the other: numbers written as text or as bytes behind the same calls.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace fretwork::mesh {

/// Reads a .msh file from its beginning to its end. Every function throws core::Error, naming the file, the
/// section and (in text) the line, where the file holds something else than what is asked for, or ends.
class MshScanner {
public:
  /// @param text  the whole file
  /// @param file  its name, for messages
  MshScanner(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

  /// Go to the next section and return its name without the `$`; empty at the end of the file.
  std::string_view next_section();
  /// Read `$End<section>`: what was read is what the section holds.
  void end_section();
  /// Go behind `$End<section>` without reading.
  void skip_section();

  /// From here on numbers are bytes (32-bit int, 64-bit size, double, this machine's order).
  void set_binary() { binary_ = true; }
  [[nodiscard]] bool is_binary() const { return binary_; }

  [[nodiscard]] int integer();      ///< text, or 32-bit int
  [[nodiscard]] std::size_t size(); ///< text, or 64-bit unsigned
  [[nodiscard]] double number();    ///< text, or double
  [[nodiscard]] int text_integer(); ///< text also in binary files
  [[nodiscard]] double text_number();
  /// Text between the first and the last `"` of what remains of the line.
  [[nodiscard]] std::string quoted();
  /// Go behind the end of the present line.
  void end_line();
  /// `count` things of at least `bytes` bytes each must still fit into the file: a wrong count is found
  /// before it is believed.
  /// @return count
  [[nodiscard]] std::size_t fitting(std::size_t count, std::size_t bytes) const;

  [[noreturn]] void fail(const std::string& what) const;

private:
  template <typename T> T text_value(const char* kind);
  template <typename T> T binary_value();
  void skip_space();
  [[noreturn]] void fail_early() const;
  [[noreturn]] void fail_word(const char* kind) const;

  std::string text_;
  std::string file_;
  std::string section_;
  std::size_t position_ = 0;
  bool binary_ = false;
};

} // namespace fretwork::mesh
