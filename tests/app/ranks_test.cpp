// SPDX-License-Identifier: GPL-3.0-or-later
// Under mpirun: the same results for any number of ranks, one message for all, no rank left waiting (the
// tests' timeout would tell).
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app::test::ranks_test {
namespace {

constexpr double distributed_solver =
    1e-8; ///< relative: a distributed solve converges to the tolerance of its residuals, in another order

std::string five_tubes(const Workshop& folder) {
  return bundle(folder, 5, R"([transient]
duration = 0.1
[output]
every = 1.0e-3
nodes = ["drive0", "drive3"]
)");
}

/// A grid of three by three cells of beams, clamped at one corner.
MeshText grid() {
  constexpr int cells = 3, per_side = 4, n = cells * per_side;
  MeshText mesh;
  std::vector<std::vector<int>> number(n + 1, std::vector<int>(n + 1, -1));
  const auto node = [&](int i, int j) {
    int& at = number[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    if (at < 0) {
      at = static_cast<int>(mesh.nodes.size());
      mesh.nodes.emplace_back(0.25 * i, 0.3 * j, 0.0);
    }
    return at;
  };
  for (int line = 0; line <= n; line += per_side)
    for (int k = 0; k < n; ++k) {
      mesh.lines.push_back({"grid", {node(line, k), node(line, k + 1)}});
      mesh.lines.push_back({"grid", {node(k, line), node(k + 1, line)}});
    }
  mesh.points = {{"corner", node(0, 0)}, {"far", node(n, n)}};
  return mesh;
}

/// Runs on one process and on 1, 2 and 3 ranks; the same numbers everywhere.
void expect_same_on_all_ranks(const Workshop& folder, const fs::path& study,
                              const std::vector<std::string>& more) {
  const Results alone = folder.run(study, "alone", more);
  const std::string bytes = bytes_of(folder.path("alone") / "results.h5");
  for (const int ranks : {1, 2, 3}) {
    const Results many = folder.run(study, fmt::format("ranks{}", ranks), more, ranks);
    EXPECT_EQ(many.summary["ranks"], ranks);
    EXPECT_EQ(lasting(many.summary), lasting(alone.summary)) << ranks << " ranks";
    EXPECT_TRUE(same_numbers(many.archive, alone.archive)) << ranks << " ranks";
    EXPECT_TRUE(bytes_of(folder.path(fmt::format("ranks{}", ranks)) / "results.h5") == bytes)
        << "bytes on " << ranks << " ranks";
  }
}

TEST(Ranks, GiveTheSameOscillator) {
  const Workshop folder;
  expect_same_on_all_ranks(folder, example("oscillator"), {});
}

TEST(Ranks, GiveTheSameStraightTube) {
  const Workshop folder;
  expect_same_on_all_ranks(folder, example("straight_tube"),
                           {"--set", "transient.duration=0.2", "--set", "output.statistics_from=0"});
}

TEST(Ranks, GiveTheSameUBend) {
  const Workshop folder;
  expect_same_on_all_ranks(folder, example("u_bend"),
                           {"--set", "transient.duration=0.02", "--set", "output.statistics_from=0", "--set",
                            "modes.count=40", "--set", "output.every=1e-3"});
}

TEST(Ranks, GiveTheSameBundle) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", five_tubes(folder));
  expect_same_on_all_ranks(folder, study, {});
  const Results run = read_results(folder.path("ranks3"));
  EXPECT_EQ(run.archive.bases.size(), 5u);
  EXPECT_EQ(run.summary["seeds"], (std::vector<int>{11, 12, 13, 14, 15}));
  for (const auto& contact : run.summary["contacts"])
    EXPECT_GT(contact["impacts"].get<int>(), 0) << contact["name"];
}

TEST(Ranks, ShareOneLargeStructureWhereTheStudySaysSo) {
  const Workshop folder;
  folder.write("grid.msh", grid().text());
  const std::string study = R"([mesh]
file = "grid.msh"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.3
density = 7800.0
[sections.rod]
shape = "circle"
diameter = 0.02
[[beams]]
group = "grid"
material = "steel"
section = "rod"
[[restraints]]
group = "corner"
fixed = "all"
[modes]
count = 12
distributed = true
[[loads]]
group = "far"
direction = [0.0, 0.0, 1.0]
constant = 1.0
[transient]
duration = 0.01
)";
  const Results one = folder.run_text(study), two = folder.run(folder.path("study.toml"), "two", {}, 2);
  EXPECT_EQ(one.summary["modes"]["distributed"], false);
  EXPECT_EQ(two.summary["modes"]["distributed"], true);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_TRUE(close_to(two.summary["modes"]["frequencies_hz"][i], one.summary["modes"]["frequencies_hz"][i],
                         distributed_solver));
  // a distributed solve repeats to round-off only; from its stored modes on, all is the same
  const Results longer =
      folder.run(folder.path("study.toml"), "two", {"--set", "transient.duration=0.02"}, 2);
  EXPECT_EQ(longer.summary["modes"], two.summary["modes"]);
}

TEST(Ranks, SayOneMessageAboutAWrongStudy) {
  const Workshop folder;
  const std::string results = folder.path("results").string();
  const std::string broken = folder.write("broken.geo", "Line(1) = {1, 2};\n").string();
  // found by reading the study, by one rank in the mesh, by all in the model; without MPI
  const std::vector<std::vector<std::string>> wrong{
      {"run", example("straight_tube").string(), "-o", results, "--set", "contacts.support.gap=-1"},
      {"run", example("straight_tube").string(), "-o", results, "--set", "mesh.file=" + broken},
      {"run", example("straight_tube").string(), "-o", results, "--set", "contacts.support.group=suports"},
      {"check", folder.path("none.toml").string()}};
  for (const auto& command : wrong) {
    const Outcome outcome = folder.fretwork(command, 2);
    EXPECT_EQ(outcome.status, 1) << command.back() << outcome.err;
    const auto first = outcome.err.find("fretwork: ");
    EXPECT_NE(first, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("fretwork: ", first + 1), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out.find("fretwork: "), std::string::npos) << outcome.out;
  }
  EXPECT_FALSE(fs::exists(folder.path("results") / "summary.json"));
}

TEST(Ranks, SayOneMessageAboutADivergingRun) {
  const Workshop folder;
  const Outcome outcome =
      folder.fretwork({"run", example("cantilever_stop").string(), "-o", folder.path("results").string(),
                       "--set", "transient.scheme=euler", "--set", "transient.step=5e-3"},
                      2);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  const auto first = outcome.err.find("diverged");
  EXPECT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("diverged", first + 1), std::string::npos) << outcome.err;
}

} // namespace
} // namespace fretwork::app::test::ranks_test
