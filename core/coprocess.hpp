// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A program that runs beside this one and answers line by line. What may crash runs there: its end is an answer that is missing.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace fretwork::core {

/// Standard input and output of the program are a socket of ours, its standard error is that of this process. It dies with this process, however
/// that ends.
class Coprocess {
public:
  /// @param arguments    `arguments[0]` is searched on PATH; no shell
  /// @param environment  `NAME=value`
  /// @throws ComputationError where no process can be started; a program that is not there is one that ends at once, with status 127
  Coprocess(const std::vector<std::string>& arguments, const std::vector<std::string>& environment);
  /// Ends the program.
  ~Coprocess();
  Coprocess(const Coprocess&) = delete;
  Coprocess& operator=(const Coprocess&) = delete;

  /// Sends a line. A program that has ended takes none: the next read tells.
  /// @param line  without its end
  void write(const std::string& line);
  /// Waits for the next line, without its end; none where the program has ended.
  /// @param between  called now and then while it waits (every 0.1 s)
  [[nodiscard]] std::optional<std::string> read(const std::function<void()>& between);
  /// Of a program that has given no answer: waits for its end. `signal 11 (SIGSEGV)`, `exit status 127`
  [[nodiscard]] std::string end();

private:
  pid_t child_ = -1;
  int socket_ = -1;
  std::string received_; ///< behind the last line
};

} // namespace fretwork::core
