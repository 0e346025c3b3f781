// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files for the tests of the mesh readers.
#pragma once
#include "core/error.hpp"
#include "mesh/read.hpp"
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

namespace fretwork::mesh::test {

namespace fs = std::filesystem;

/// A directory for the files of one test.
class MeshFiles : public ::testing::Test {
protected:
  MeshFiles() {
    std::string name = (fs::temp_directory_path() / "fretwork-test-XXXXXX").string();
    directory_ = mkdtemp(name.data());
  }
  ~MeshFiles() override { fs::remove_all(directory_); }

  [[nodiscard]] fs::path path(const std::string& name) const { return directory_ / name; }
  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  [[nodiscard]] LineMesh read_text(const std::string& text, double merge_tolerance = 0.0) const {
    return read({.file = write("mesh.msh", text), .merge_tolerance = merge_tolerance});
  }

private:
  fs::path directory_;
};

/// The message of the core::Error that `work` throws; empty where it throws none.
template <typename Work> std::string message_of(Work work) {
  try {
    work();
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

/// Passes where `message` contains `part`.
inline ::testing::AssertionResult says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << message << "\" does not contain \"" << part << "\"";
}

/// Equal numbering, directions and groups; coordinates equal to `tolerance`, bit for bit where it is 0.
inline ::testing::AssertionResult same_mesh(const LineMesh& a, const LineMesh& b, double tolerance = 0.0) {
  const auto fail = [](const char* what) { return ::testing::AssertionFailure() << "different " << what; };
  const auto near = [&](const Vec3& x, const Vec3& y) { return (x - y).norm() <= tolerance; };
  if (!std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), near))
    return fail("nodes");
  const auto same_line = [&](const Line& s, const Line& t) {
    return s.nodes == t.nodes && s.middle.has_value() == t.middle.has_value() &&
           (!s.middle || near(*s.middle, *t.middle));
  };
  if (!std::equal(a.lines.begin(), a.lines.end(), b.lines.begin(), b.lines.end(), same_line))
    return fail("lines");
  if (a.points != b.points)
    return fail("named points");
  if (a.curves != b.curves)
    return fail("named curves");
  return ::testing::AssertionSuccess();
}

/// .msh 2.2 text: nodes as `tag x y z` lines, elements as `type physical nodes...` lines.
inline std::string msh22(const std::string& names, const std::string& nodes, const std::string& elements) {
  std::string numbered;
  int number = 0;
  std::istringstream lines(elements);
  for (std::string type, physical, rest; lines >> type >> physical && std::getline(lines, rest);)
    numbered += fmt::format("{} {} 2 {} 1{}\n", ++number, type, physical, rest);
  const auto count = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  return fmt::format("$MeshFormat\n2.2 0 "
                     "8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n"
                     "$Elements\n{}\n{}$EndElements\n",
                     count(names), names, count(nodes), nodes, number, numbered);
}

} // namespace fretwork::mesh::test
