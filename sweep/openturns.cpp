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
  throw core::Error(fmt::format("sweeps draw and evaluate by the helper program openturns_helper.py, which "
                                "is not in {}; it belongs there beside "
                                "the program: install the package fretwork, or use cmake --install",
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

void write(const fs::path& file, const void* bytes, std::size_t size) {
  std::ofstream out(file, std::ios::binary);
  out.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  out.close();
  if (!out)
    throw core::Error(fmt::format(
        "{}: cannot be written; check the space left there, or set TMPDIR to another folder", file.string()));
}

/// @throws core::Error where the file is not whole
std::vector<double> read_values(const fs::path& file, std::size_t count) {
  std::vector<double> out(count);
  const auto bytes = static_cast<std::streamsize>(count * sizeof(double));
  std::ifstream in(file, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(out.data()), bytes) || in.peek() != std::ifstream::traits_type::eof())
    throw core::Error(
        fmt::format("{}: OpenTURNS has not written {} numbers there; check the space left in this folder, or "
                    "set TMPDIR to another",
                    file.string(), count));
  return out;
}

nlohmann::json read_answer(const fs::path& file) {
  std::ifstream in(file);
  nlohmann::json answer = nlohmann::json::parse(in, nullptr, false);
  if (!answer.is_object())
    throw core::Error(
        fmt::format("{}: the answer of OpenTURNS is not whole; check the space left in this folder, or set "
                    "TMPDIR to another",
                    file.string()));
  return answer;
}

} // namespace

Answer ask_openturns(const nlohmann::json& request, const std::vector<double>& values) {
  const core::TemporaryDirectory folder;
  const std::string text = request.dump();
  write(folder.path() / "request.json", text.data(), text.size());
  if (!values.empty())
    write(folder.path() / "values.bin", values.data(), values.size() * sizeof(double));
  const core::ChildResult result = run_helper(folder.path());
  if (result.status != 0)
    throw core::Error(fmt::format("draws and statistics by OpenTURNS: {}", result.output));
  Answer out{.json = read_answer(folder.path() / "answer.json"), .values = {}};
  if (request.at("operation") == "draw")
    out.values = read_values(folder.path() / "values.bin", out.json.at("rows").get<std::size_t>() *
                                                               out.json.at("columns").get<std::size_t>());
  return out;
}

} // namespace fretwork::sweep
