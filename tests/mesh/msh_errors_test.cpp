// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/msh_reader.hpp"
#include "mesh_files.hpp"
#include <cstring>

namespace fretwork::mesh::test::msh_errors_test {
namespace {

class MshErrors : public MeshFiles {
protected:
  [[nodiscard]] std::string message(const std::string& text) const {
    return message_of([&] { static_cast<void>(read_msh(write("bad.msh", text))); });
  }
};

const std::string format_22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string format_41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string good_22 = msh22("1 1 \"a\"\n", "1 0 0 0\n2 1 0 0\n", "1 1 1 2\n");

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  return text.replace(text.find(old), old.size(), with);
}

TEST_F(MshErrors, NameTheFile) { EXPECT_TRUE(says(message("nonsense"), "bad.msh, line 1: ")); }

TEST_F(MshErrors, RefuseAFileThatCannotBeOpened) {
  EXPECT_TRUE(says(message_of([&] { static_cast<void>(read_msh(path("none.msh"))); }),
                   "none.msh: the mesh cannot be opened"));
}

TEST_F(MshErrors, RefuseGarbage) {
  EXPECT_TRUE(says(message("#!/bin/sh\necho\n"), "\"#!/bin/sh\" stands where a section ($...) should begin"));
  EXPECT_TRUE(says(message("$NOD\n1\n"), "not a gmsh mesh: it does not begin with $MeshFormat"));
  EXPECT_TRUE(says(message(""), "not a gmsh mesh"));
}

TEST_F(MshErrors, RefuseAPhysicalTagWithoutPositiveCounterpart) {
  EXPECT_TRUE(says(message(replaced(good_22, "1 1 \"a\"", "1 -2147483648 \"a\"")),
                   "a physical tag of -2147483648 has no positive counterpart"));
}

TEST_F(MshErrors, RefuseOtherVersions) {
  EXPECT_TRUE(says(message("$MeshFormat\n4 0 8\n$EndMeshFormat\n"),
                   "format 4.0 is not read; save the mesh as 4.1 or 2.2"));
  EXPECT_TRUE(says(message("$MeshFormat\n1.0 0 8\n$EndMeshFormat\n"), "format 1.0 is not read"));
  EXPECT_TRUE(says(message("$MeshFormat\n4.1 0 4\n$EndMeshFormat\n"), "numbers of 4 bytes are not read"));
}

TEST_F(MshErrors, RefuseTheOtherByteOrder) {
  EXPECT_TRUE(
      says(message(std::string("$MeshFormat\n4.1 1 8\n") + std::string("\0\0\0\1", 4) + "\n$EndMeshFormat\n"),
           "binary file of a machine with another byte order"));
}

TEST_F(MshErrors, RefusePartitionedMeshes) {
  EXPECT_TRUE(says(message(format_41 + "$PartitionedEntities\n2\n"), "a partitioned mesh is not read"));
}

TEST_F(MshErrors, NameTheWordThatIsNoNumber) {
  EXPECT_TRUE(
      says(message(replaced(good_22, "2 1 0 0", "2 1 x0 0")), "line 11: \"x0\" is not a number in $Nodes"));
  EXPECT_TRUE(says(message(replaced(good_22, "1 1 2 1 1 1 2", "1 1 2 1 1 1 2.5")),
                   "\"2.5\" is not an integer in $Elements"));
  EXPECT_TRUE(says(message(replaced(good_22, "1 1 \"a\"", "1 1 a")),
                   "a name in double quotes is missing in $PhysicalNames"));
}

TEST_F(MshErrors, TellMoreAndLessDataThanAnnounced) {
  EXPECT_TRUE(
      says(message(replaced(good_22, "$Nodes\n2", "$Nodes\n1")), "more data than announced in $Nodes"));
  EXPECT_TRUE(
      says(message(replaced(good_22, "$Nodes\n2", "$Nodes\n3")), "less data than announced in $Nodes"));
}

TEST_F(MshErrors, TellATruncatedFileWhereverItEnds) {
  const std::size_t nodes = good_22.find("$Nodes"), elements = good_22.find("$Elements");
  for (std::size_t length = format_22.size() + 16; length + 1 < good_22.size(); ++length) {
    // Between two sections the file is complete as far as it goes: what is missing is told by what the mesh
    // lacks.
    if (length >= nodes - 1 && length <= nodes)
      continue;
    if (length >= elements - 1 && length <= elements)
      continue;
    if (length + 1 >= good_22.size())
      continue;
    EXPECT_FALSE(message(good_22.substr(0, length)).empty()) << "ends after " << length << " characters";
  }
  EXPECT_TRUE(says(message(good_22.substr(0, nodes + 12)), "the file ends inside $Nodes; it is truncated"));
  EXPECT_TRUE(says(message(format_22 + "$Periodic\n1\n"), "the file ends inside $Periodic"));
}

TEST_F(MshErrors, DoNotBelieveHugeCounts) {
  EXPECT_TRUE(
      says(message(format_22 + "$Nodes\n2000000000\n1 0 0 0\n$EndNodes\n"), "the file ends inside $Nodes"));
  EXPECT_TRUE(says(message(format_41 + "$Nodes\n1 99999999999 1 1\n"),
                   "a count of 99999999999 is more than 2147483647"));
  EXPECT_TRUE(says(message(format_22 + "$Nodes\n-1\n"), "a count of"));
}

TEST_F(MshErrors, NameNodesThatAreMissingOrTwice) {
  EXPECT_TRUE(says(message(msh22("", "1 0 0 0\n2 1 0 0\n", "1 1 1 77\n")),
                   "an element has node 77, which the file does not define"));
  EXPECT_TRUE(says(message(msh22("", "5 0 0 0\n5 1 0 0\n", "1 1 5 5\n")), "node 5 is given twice"));
  EXPECT_TRUE(
      says(message(msh22("", "123456 0 0 0\n123456 1 0 0\n", "1 1 1 1\n")), "node 123456 is given twice"));
}

TEST_F(MshErrors, RefuseElementsThatCannotBeRead) {
  EXPECT_TRUE(says(message(msh22("", "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 3 0 0\n", "26 1 1 4 2 3\n")),
                   "lines of order 3 or more"));
  EXPECT_TRUE(says(message(msh22("", "1 0 0 0\n", "777 1 1\n")), "element type 777 is not known"));
}

} // namespace
} // namespace fretwork::mesh::test::msh_errors_test
