// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/python_report.hpp"
#include "core/child_process.hpp"
#include "core/error.hpp"
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

/// The first interpreter that has the modules: FRETWORK_PYTHON, python3 of the PATH, Debian's own.
std::string find_python() {
  std::vector<std::string> candidates;
  if (const char* chosen = std::getenv("FRETWORK_PYTHON"))
    candidates.emplace_back(chosen);
  candidates.insert(candidates.end(), {"python3", "/usr/bin/python3"});
  for (const std::string& python : candidates)
    if (core::run_child(
            {python, "-I", "-c",
             "import importlib.util as u, sys; sys.exit(not (u.find_spec('h5py') and u.find_spec('numpy')))"})
            .status == 0)
      return python;
  throw core::Error(fmt::format("the report needs a Python with h5py and numpy, and {} have not both; "
                                "install the packages python3-h5py "
                                "and python3-numpy, or name an interpreter in FRETWORK_PYTHON",
                                fmt::join(candidates, ", ")));
}

fs::path find_script() {
  const fs::path here = core::executable_directory();
  for (const fs::path& folder : {here / "../share/fretwork/report", here / "../../share/fretwork/report"})
    if (const fs::path script = folder / "fretwork_report.py"; fs::exists(script))
      return script;
  throw core::Error(
      fmt::format("the report's program fretwork_report.py is not at {}; install Fretwork whole",
                  (here / "../share/fretwork/report").lexically_normal().string()));
}

} // namespace

void write_report(const fs::path& directory) {
  const core::ChildResult result =
      core::run_child({find_python(), "-I", find_script().string(), directory.string()});
  if (result.status != 0)
    throw core::Error("the report could not be written: " + result.output);
}

} // namespace fretwork::app
