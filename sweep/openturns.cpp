// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/openturns.hpp"
#include "core/child_process.hpp"
#include "core/error.hpp"
#include "core/temporary_directory.hpp"
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string>

namespace fretwork::sweep {
namespace {

namespace fs = std::filesystem;

constexpr int lacks_modules = 3, not_started = 127; ///< status of the helper, core/child_process.hpp

fs::path find_helper() {
  const fs::path here = core::executable_directory();
  for (const fs::path& folder : {here / "../share/fretwork/sweep", here / "../../share/fretwork/sweep"})
    if (const fs::path script = folder / "openturns_helper.py"; fs::exists(script))
      return script;
  throw core::Error(fmt::format("the helper program openturns_helper.py is not at {}; install Fretwork whole",
                                (here / "../share/fretwork/sweep").lexically_normal().string()));
}

/// With the interpreter named by FRETWORK_PYTHON, or the first that has the modules: python3 of the PATH, Debian's own.
core::ChildResult run_helper(const fs::path& folder) {
  std::vector<std::string> candidates{"python3", "/usr/bin/python3"};
  if (const char* chosen = std::getenv("FRETWORK_PYTHON"))
    candidates = {chosen};
  const std::string helper = find_helper().string();
  core::ChildResult result;
  for (const std::string& python : candidates) {
    result = core::run_child({python, "-I", helper, folder.string()});
    if (result.status != lacks_modules && result.status != not_started)
      return result;
  }
  throw core::Error(
      fmt::format("sweeps need a Python with OpenTURNS and NumPy for draws and statistics ({}); install the "
                  "package python3-openturns, or name an interpreter in FRETWORK_PYTHON",
                  result.output.substr(0, result.output.find('\n'))));
}

void write_values(const fs::path& file, const std::vector<double>& values) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(double)));
}

std::vector<double> read_values(const fs::path& file) {
  std::error_code absent;
  const std::uintmax_t bytes = fs::file_size(file, absent);
  std::vector<double> out(absent ? 0 : bytes / sizeof(double));
  std::ifstream(file, std::ios::binary)
      .read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size() * sizeof(double)));
  return out;
}

} // namespace

Answer ask_openturns(const nlohmann::json& request, const std::vector<double>& values) {
  const core::TemporaryDirectory folder;
  std::ofstream(folder.path() / "request.json") << request.dump();
  if (!values.empty())
    write_values(folder.path() / "values.bin", values);
  const core::ChildResult result = run_helper(folder.path());
  if (result.status != 0)
    throw core::Error(fmt::format("draws and statistics by OpenTURNS: {}", result.output));
  Answer out;
  std::ifstream(folder.path() / "answer.json") >> out.json;
  if (request.at("operation") == "draw")
    out.values = read_values(folder.path() / "values.bin");
  return out;
}

} // namespace fretwork::sweep
