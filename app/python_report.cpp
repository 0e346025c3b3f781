// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/python_report.hpp"
#include "core/child_process.hpp"
#include "core/error.hpp"
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

constexpr int not_started = 127; // status of a child, core/child_process.hpp

/// The interpreter named by FRETWORK_PYTHON, or the first that has the modules: python3 of the PATH, Debian's own.
std::string find_python() {
  std::vector<std::string> candidates;
  if (const char* chosen = std::getenv("FRETWORK_PYTHON"))
    candidates.emplace_back(chosen);
  else
    candidates = {"python3", "/usr/bin/python3"};
  std::vector<std::string> found;
  for (const std::string& python : candidates) {
    const int status =
        core::run_child(
            {python, "-I", "-c",
             "import importlib.util as u, sys; sys.exit(not (u.find_spec('h5py') and u.find_spec('numpy')))"})
            .status;
    if (status == 0)
      return python;
    found.push_back(python + (status == not_started ? " cannot be started" : " has not both"));
  }
  throw core::Error(
      fmt::format("reports and comparisons need a Python with h5py and numpy: {}; install the packages "
                  "python3-h5py and python3-numpy, or name an interpreter in FRETWORK_PYTHON",
                  fmt::join(found, ", ")));
}

/// The folder of the Python package `fretwork`.
fs::path find_package() {
  const fs::path here = core::executable_directory();
  for (const fs::path& folder : {here / "../share/fretwork/python", here / "../../share/fretwork/python"})
    if (fs::exists(folder / "fretwork/report"))
      return folder;
  throw core::Error(fmt::format("the Python package of the report is not at {}; install Fretwork whole",
                                (here / "../share/fretwork/python").lexically_normal().string()));
}

/// What `main` of a module of fretwork.report prints, run in an isolated interpreter: it sees the package, and neither
/// the current folder nor the user's modules. @throws core::Error with its message after `failure`
std::string run_module(const std::string& module, const std::vector<std::string>& arguments,
                       const std::string& failure) {
  std::vector<std::string> command = {
      find_python(), "-I", "-c",
      "import sys; sys.path.insert(0, sys.argv.pop(1)); from fretwork.report." + module +
          " import main; sys.exit(main())",
      find_package().string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  core::ChildResult result = core::run_child(command);
  if (result.status == 0)
    return std::move(result.output);
  while (result.output.ends_with('\n'))
    result.output.pop_back();
  throw core::Error(failure + ": " + result.output);
}

} // namespace

void write_report(const fs::path& directory) {
  run_module("build", {directory.string()}, "the report could not be written");
}

void write_sweep_report(const fs::path& directory) {
  run_module("sweep", {directory.string()}, "the report could not be written");
}

std::string make_report(const fs::path& directory) {
  try {
    write_report(directory);
    return fmt::format("report: {}\n", (directory / "report.html").string());
  } catch (const core::Error& error) {
    return fmt::format("no report: {}\n", error.what());
  }
}

std::string compare_results(const std::vector<fs::path>& directories, const std::string& page) {
  std::vector<std::string> arguments;
  for (const fs::path& directory : directories)
    arguments.push_back(directory.string());
  if (!page.empty()) {
    arguments.emplace_back("--html");
    arguments.push_back(page);
  }
  return run_module("compare", arguments, "the results cannot be compared");
}

} // namespace fretwork::app
