// SPDX-License-Identifier: GPL-3.0-or-later
// Geometries and meshes of unknown origin: they run nothing, write nothing and end.
#include "core/confinement.hpp"
#include "mesh_files.hpp"
#include <cstdlib>

namespace fretwork::mesh::test::confinement_test {
namespace {

constexpr const char* line = "Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5};\nLine(1) = {1, 2};\n";

class Stranger : public MeshFiles {
protected:
  ~Stranger() override { unsetenv("FRETWORK_CONFINEMENT"); }
  /// The message about a line with these commands after it; empty where it is meshed.
  [[nodiscard]] std::string refusal(const std::string& commands, bool trusted = false,
                                    double seconds = 30.0) const {
    Source source{.file = write("a.geo", line + commands + "\n")};
    source.trusted = trusted;
    source.longest_conversion = seconds;
    return message_of([&] { static_cast<void>(read(source)); });
  }
  [[nodiscard]] std::string touch() const { return "SystemCall \"touch " + path("made").string() + "\";"; }
  /// Commands that would make the file "made".
  [[nodiscard]] std::vector<std::string> attacks() const {
    const std::string made = '"' + path("made").string() + '"';
    const std::string touch_made = "\"touch " + path("made").string() + "\";";
    return {touch(),
            "NonBlocking" + touch(),
            "System " + touch_made,
            "StringToName[StrCat(\"Sys\", \"temCall\")] " + touch_made,
            "S2N[StrCat(\"Sys\", \"temCall\")] " + touch_made,
            "Printf(\"text\") > " + made + ";",
            "Mesh 1; Save " + made + ";",
            "Print " + made + ";"};
  }
};

TEST_F(Stranger, RunsNoCommandAndWritesNoFileWhereItIsConfined) {
  if (!core::Confinement::available())
    GTEST_SKIP() << "this kernel has no Landlock or no seccomp";
  EXPECT_EQ(refusal(""), "");
  for (const std::string& attack : attacks()) {
    const std::string message = refusal(attack);
    EXPECT_FALSE(fs::exists(path("made"))) << attack;
    EXPECT_TRUE(says(message, "a.geo: ")) << attack;
  }
  EXPECT_TRUE(says(refusal(touch()), "it runs a command, which a file of unknown origin may not; correct the "
                                     "file, or set mesh.trusted = true"));
}

TEST_F(Stranger, IsRefusedWithCommandsWhereNothingConfinesIt) {
  setenv("FRETWORK_CONFINEMENT", "off", 1);
  EXPECT_EQ(refusal(""), "");
  (void)write("more.geo", touch());
  std::vector<std::string> all = attacks();
  all.push_back("Include \"more.geo\";");
  all.push_back("Merge \"more.geo\";");
  for (const std::string& attack : all) {
    EXPECT_TRUE(says(refusal(attack), "and this system cannot confine it")) << attack;
    EXPECT_FALSE(fs::exists(path("made"))) << attack;
  }
}

TEST_F(Stranger, IsRefusedWithOptionsWhereNothingConfinesIt) {
  setenv("FRETWORK_CONFINEMENT", "off", 1);
  (void)write("a.geo.opt", touch() + "\n"); // gmsh runs it after a.geo
  EXPECT_TRUE(says(refusal(""), "a.geo.opt: gmsh would run it, and this system cannot confine it"));
  EXPECT_FALSE(fs::exists(path("made")));
}

TEST_F(Stranger, IsReadAsACommandFileUnderEndingsThatGmshDoesNotKnow) {
  setenv("FRETWORK_CONFINEMENT", "off", 1);
  for (const char* name : {"a.Step", "a.sTP", "a.BREP"}) {
    const Source source{.file = write(name, line + touch() + "\n")};
    EXPECT_TRUE(says(message_of([&] { static_cast<void>(read(source)); }), "it has the command System"))
        << name;
    EXPECT_FALSE(fs::exists(path("made"))) << name;
  }
}

TEST_F(Stranger, IsRefusedWithAWordOfAnyLength) {
  setenv("FRETWORK_CONFINEMENT", "off", 1);
  EXPECT_TRUE(says(refusal("Onelab" + std::string(1'000'000, 'a') + ";"), "it has the command Onelab"));
}

TEST_F(Stranger, MayDoAllOfItWhereItIsTrusted) {
  EXPECT_EQ(refusal(touch(), true), "");
  EXPECT_TRUE(fs::exists(path("made")));
}

TEST_F(Stranger, IsEndedWhereItHasNoEnd) {
  EXPECT_TRUE(says(refusal("For i In {0:1e18}\nx = i;\nEndFor", false, 2.0),
                   "a.geo: its conversion was ended: it ran for more than 2 s"));
}

TEST_F(Stranger, IsEndedWhereItTakesAllMemory) {
  const std::string message = refusal("Transfinite Curve {1} = 1000000000;");
  EXPECT_TRUE(says(message, "a.geo: its conversion "))
      << "more than 4 GB, or more than 30 s on the way there";
}

TEST_F(Stranger, GivesNoModulesToTheInterpreter) {
  const std::string code = "open(r'" + path("made").string() + "', 'w').write('text')\n";
  (void)write("meshio.py", code);
  (void)write("numpy.py", code);
  const fs::path file =
      write("a.inp", "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n*ELEMENT, TYPE=B31, ELSET=tube\n1, 1, 2\n");
  const fs::path before = fs::current_path();
  fs::current_path(file.parent_path());
  Source source{.file = file};
  source.trusted = true; // nothing but the isolation of the interpreter protects
  const std::string message = message_of([&] { static_cast<void>(read(source)); });
  fs::current_path(before);
  EXPECT_FALSE(fs::exists(path("made")));
  EXPECT_EQ(message, "");
}

} // namespace
} // namespace fretwork::mesh::test::confinement_test
