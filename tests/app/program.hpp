// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The program as its users meet it: a folder with study and mesh files, the executable as a child process,
/// its exit status, what it says and what it leaves.
#pragma once
#include "results/run_results.hpp"
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::app::test {

namespace fs = std::filesystem;

struct Outcome {
  int status; ///< exit status; 124 where it was still running after a minute
  std::string out, err;
};

/// What a run left.
struct Results {
  nlohmann::json summary;
  results::RunResults archive;

  /// Series of a contact or of an observed node.
  [[nodiscard]] const post::ContactSeries& contact(const std::string& name) const;
  [[nodiscard]] const post::NodeSeries& node(const std::string& name) const;
  /// Summary of a contact.
  [[nodiscard]] const nlohmann::json& statistics(const std::string& name) const;
};

/// A variable of the environment of this process and its children, as before at the end.
class EnvironmentVariable {
public:
  EnvironmentVariable(std::string name, const std::string& value);
  ~EnvironmentVariable();
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

private:
  std::string name_;
  std::optional<std::string> before_;
};

/// A temporary folder, removed at the end.
class Workshop {
public:
  Workshop();
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
  fs::path write(const std::string& name, const std::string& text) const;
  /// fretwork with these arguments; with `ranks` under mpirun.
  [[nodiscard]] Outcome fretwork(const std::vector<std::string>& arguments, int ranks = 0) const;
  /// Runs a study file into the folder `output` without report; a test failure where its status is not 0.
  [[nodiscard]] Results run(const fs::path& study, const std::string& output,
                            const std::vector<std::string>& more = {}, int ranks = 0) const;
  /// The same from the text of a study, its mesh written before.
  [[nodiscard]] Results run_text(const std::string& study, const std::vector<std::string>& more = {},
                                 int ranks = 0) const;

private:
  fs::path folder_;
};

[[nodiscard]] Results read_results(const fs::path& directory);
[[nodiscard]] std::string bytes_of(const fs::path& file);
/// The path of an example's study.
[[nodiscard]] fs::path example(const std::string& name);

/// Passes where `text` contains `part`.
[[nodiscard]] testing::AssertionResult says(const std::string& text, const std::string& part);
/// Passes where |value - reference| <= tolerance |reference|.
[[nodiscard]] testing::AssertionResult close_to(double value, double reference, double tolerance);

/// A summary without what may differ between runs of the same study: timings, ranks, the checksum.
[[nodiscard]] nlohmann::json lasting(nlohmann::json summary);
/// Passes where two archives hold the same numbers in every series, mode and fact of a contact, bit for bit.
[[nodiscard]] testing::AssertionResult same_numbers(const results::RunResults& a,
                                                    const results::RunResults& b);

} // namespace fretwork::app::test
