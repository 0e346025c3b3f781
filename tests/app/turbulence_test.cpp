// SPDX-License-Identifier: GPL-3.0-or-later
// Turbulence as users meet it: transients against closed forms, what forces may not depend on, the linear response, messages.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <sstream>

namespace fretwork::app::test::turbulence_test {
namespace {

using nlohmann::json;
constexpr double pi = std::numbers::pi, level = 0.02, correlation = 0.1, ratio = 0.02;
const double outer = 0.01905, bore = outer - 2.0 * 0.00109, displaced = pi / 4.0 * outer * outer,
             bending = 2.0e11 * pi / 64.0 * (std::pow(outer, 4) - std::pow(bore, 4)),
             mass = 8000.0 * (displaced - pi / 4.0 * bore * bore) +
                    740.0 * displaced; // C_m = 1 of a single tube

/// Pinned tubes of 1 m along x, 20 elements each, 0.1 m apart; drag along z, lift along y. `held`: components restrained all along.
std::string tubes(const Workshop& folder, int count, const std::string& held, const std::string& more) {
  MeshText mesh;
  std::string study;
  for (int k = 0; k < count; ++k) {
    const std::string name = fmt::format("tube{}", k);
    MeshText one = straight_line(name, {0.0, 0.1 * k, 0.0}, {1.0, 0.1 * k, 0.0}, 20);
    one.points.emplace_back(fmt::format("middle{}", k), 10);
    mesh = k == 0 ? one : together(mesh, one);
    study += fmt::format("[[beams]]\ngroup = \"{0}\"\nmaterial = \"steel\"\nsection = \"tube\"\n"
                         "[[restraints]]\ngroup = \"{0}\"\nfixed = {1}\n"
                         "[[restraints]]\ngroup = \"{0}_begin\"\nfixed = [\"uy\", \"uz\"]\n"
                         "[[restraints]]\ngroup = \"{0}_end\"\nfixed = [\"uy\", \"uz\"]\n"
                         "[[flow]]\ngroup = \"{0}\"\nfrom = \"{0}_begin\"\n[[flow.zones]]\nname = \"water\"\n"
                         "velocity = [0, 0, 1]\ndensity = 740\nviscosity = 1.23e-7\nconnors_constant = 3\n",
                         name, held);
  }
  folder.write("mesh.msh", mesh.text());
  return steel_pipe("mesh.msh") + study + more;
}
const std::string in_one_plane = R"(["ux", "uz", "rx", "ry"])", across = R"(["ux", "rx"])";

/// White lift. @param keys  more of them
std::string white(const std::string& keys = "band = [1, 300]\n") {
  return fmt::format("[[turbulence]]\nname = \"t\"\nspectrum = \"table\"\ntable_frequency = \"hz\"\n"
                     "table = [[1, {0}], [1000, {0}]]\ncorrelation_length = {1}\ndrag = 0\n",
                     level, correlation) +
         keys;
}
std::string modes(int count) { return fmt::format("[modes]\ncount = {}\ndamping = {}\n", count, ratio); }
std::string run(double duration, const std::string& output, const std::string& keys = {}) {
  return fmt::format("[transient]\nduration = {}\n{}[output]\n", duration, keys) + output;
}

/// Of mode m under the white lift: f, Hz, and the variance of the middle, m^2 (W7 and W8 of closed forms).
double frequency(int m) { return pi / 2.0 * m * m * std::sqrt(bending / mass); }
double variance_of_middle(int m, double lambda = correlation) {
  const double a = 1.0 / lambda, n = m * pi, even = 1.0 - (m % 2 == 0 ? 1.0 : -1.0) * std::exp(-a);
  const double acceptance = a / (a * a + n * n) + 2.0 * n * n * even / std::pow(a * a + n * n, 2);
  const double modal_mass = 0.5 * mass, w = 2.0 * pi * frequency(m);
  return std::pow(std::sin(0.5 * n), 2) * level * acceptance /
         (8.0 * ratio * w * w * w * modal_mass * modal_mass);
}

double rms_of(const json& points, const std::string& name, const std::string& direction) {
  for (const json& point : points)
    if (point["name"] == name && point["direction"] == direction)
      return point["rms_m"];
  ADD_FAILURE() << name;
  return 0.0;
}

/// Displacement of the first observed node along y.
Eigen::VectorXd lift_of(const Results& results) {
  return results.archive.series.nodes[0].displacement.col(1);
}

Outcome outcome_of(const Workshop& folder, const std::string& text, const std::string& command,
                   const std::vector<std::string>& more = {}) {
  folder.write("study.toml", text);
  std::vector<std::string> arguments{command, folder.path("study.toml").string(), "-o",
                                     folder.path("out").string(), "--force"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return folder.fretwork(arguments);
}

TEST(Turbulence, GivesTheMeanSquareOfTheClosedFormOverManyDraws) {
  // tubes of one study have independent forces: as many draws
  constexpr int draws = 16;
  constexpr double duration = 12.0, from = 1.0; // the start has decayed: 3/(xi w) = 0.5 s
  const Workshop folder;
  std::string nodes;
  for (int k = 0; k < draws; ++k)
    nodes += fmt::format("{}\"middle{}\"", k ? ", " : "nodes = [", k);
  const Results results = folder.run_text(tubes(
      folder, draws, in_one_plane,
      white() + modes(3) + run(duration, nodes + "]\nevery = 0.01\nstatistics_from = 1\n", "step = 5e-4\n")));
  double squares = 0.0;
  for (const json& node : results.summary["nodes"])
    squares += (std::pow(node["displacement"]["y"]["std"].get<double>(), 2) +
                std::pow(node["displacement"]["y"]["mean"].get<double>(), 2)) /
               draws;
  const double closed = variance_of_middle(1) + variance_of_middle(3);
  const double scatter = 1.0 / std::sqrt(ratio * 2.0 * pi * frequency(1) * (duration - from) * draws);
  constexpr double of_patches = 7e-3,
                   of_band = 2e-3; // (1/5)^2/6; the first mode's quasi-static part above 300 Hz, and samples
  EXPECT_NEAR(squares / closed, 1.0, 3.0 * scatter + of_patches + of_band);
  EXPECT_LT(3.0 * scatter, 0.11); // the test can fail
}

TEST(Turbulence, TellsTheModesAboveItsBand) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 1, in_one_plane, white() + modes(3) + "[output]\nnodes = [\"middle0\"]\n");
  ASSERT_GT(frequency(3), 300.0);
  ASSERT_LT(frequency(2), 300.0);
  const Results narrow = folder.run_text(study + "[transient]\nduration = 0.1\nstep = 5e-4\n");
  EXPECT_TRUE(says(narrow.summary["notes"].dump(),
                   "1 of 3 modes lie above its band, which ends at 300 Hz, and respond quasi-statically"));
  const Results wide = folder.run_text(
      tubes(folder, 1, in_one_plane,
            white("band = [1, 400]\n") + modes(3) + run(0.1, "every = 0.01\n", "step = 5e-4\n")));
  EXPECT_FALSE(says(wide.summary["notes"].dump(), "lie above its band"));
  ASSERT_EQ(outcome_of(folder, study, "response").status, 0);
  EXPECT_TRUE(says(read_results(folder.path("out")).summary["notes"].dump(),
                   "1 of 3 modes, up to " + fmt::format("{:.4g}", frequency(3))));
}

TEST(Turbulence, TellsZonesWithVelocityThatItLeavesOut) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 2, across, white("band = [1, 300]\nflow = \"tube0\"\n") + modes(3) + run(0.01, "", ""));
  const Outcome outcome = outcome_of(folder, study, "modes");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string notes = json::parse(bytes_of(folder.path("out") / "summary.json"))["notes"].dump();
  EXPECT_TRUE(says(
      notes, "flow \\\"tube1\\\", zone \\\"water\\\": it has a velocity and no [[turbulence]] names it"));
  EXPECT_EQ(notes.find("flow \\\"tube0\\\", zone"), std::string::npos);
}

TEST(Turbulence, IsNotAskedForWhereTheFlowIsAlongTheTube) {
  const Workshop folder;
  std::string study =
      tubes(folder, 2, across, white("band = [1, 300]\nflow = \"tube0\"\n") + modes(3) + run(0.01, "", ""));
  study.replace(study.rfind("[0, 0, 1]"), 9, "[1, 0, 0]");
  const Outcome outcome = outcome_of(folder, study, "modes");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string notes = json::parse(bytes_of(folder.path("out") / "summary.json"))["notes"].dump();
  EXPECT_TRUE(says(notes, "its velocity is along the tube: no random forces act there"));
  EXPECT_FALSE(says(notes, "no [[turbulence]] names it"));
}

TEST(Turbulence, OfOnePhaseInTwoIsWarnedOf) {
  const Workshop folder;
  const auto warnings_with = [&](const char* spectrum, double void_fraction) {
    std::string study = tubes(folder, 1, across,
                              fmt::format("[[turbulence]]\nname = \"t\"\nspectrum = \"{}\"\n"
                                          "correlation_length = {}\n",
                                          spectrum, correlation) +
                                  modes(3) + run(0.01, "", ""));
    const std::string water = "density = 740\nviscosity = 1.23e-7\n";
    study.replace(
        study.find(water), water.size(),
        fmt::format("phase = \"two_phase\"\nvoid_fraction = {}\nliquid = {{ density = 740, viscosity = "
                    "1.23e-7 }}\ngas = {{ density = 40, viscosity = 5e-7 }}\n",
                    void_fraction));
    const Outcome outcome = outcome_of(folder, study, "modes", {"--force"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(bytes_of(folder.path("out") / "summary.json"))["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings_with("axisa", 0.6),
                   "spectrum axisa is a single-phase one, and zone \\\"water\\\" "
                   "has a void fraction of 0.6"));
  EXPECT_FALSE(says(warnings_with("axisa", 0.05), "a single-phase one"));
  EXPECT_FALSE(says(warnings_with("two_phase", 0.6), "a single-phase one"));
}

TEST(Turbulence, GivesModesToTheEndOfItsBandByDefault) {
  const Workshop folder;
  const Results results = folder.run_text(tubes(folder, 1, across, white() + run(0.1, "", "step = 5e-4\n")));
  EXPECT_EQ(results.summary["modes"]["limit"]["up_to_hz"], 300.0);
  EXPECT_LT(results.summary["modes"]["frequencies_hz"].back(), 300.0);
  EXPECT_GT(results.summary["modes"]["frequencies_hz"].back(), 150.0);
  EXPECT_TRUE(says(results.summary["notes"].dump(), "modes up to 300 Hz, as far as turbulence"));
}

TEST(Turbulence, TellsSpectraThatMotionAboveHalfTheOutputRateIsFoldedInto) {
  const Workshop folder;
  const auto notes = [&](const std::string& every) {
    return folder
        .run_text(tubes(folder, 1, in_one_plane,
                        white() + modes(1) +
                            run(3.0, "nodes = [\"middle0\"]\nevery = " + every + "\n", "step = 5e-4\n")))
        .summary["notes"]
        .dump();
  };
  EXPECT_TRUE(
      says(notes("0.008"), "is folded into it; give a shorter output.every")); // 62.5 Hz, the mode at 55
  EXPECT_FALSE(says(notes("0.001"), "is folded into"));
}

TEST(Turbulence, ForcesDoNotDependOnTheDuration) {
  const Workshop folder;
  const auto of = [&](double duration) {
    return lift_of(folder.run_text(
        tubes(folder, 1, in_one_plane,
              white() + modes(3) + run(duration, "nodes = [\"middle0\"]\nevery = 0.01\n", "step = 1e-3\n"))));
  };
  const Eigen::VectorXd longer = of(9.0), shorter = of(1.0);
  ASSERT_GT(shorter.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((shorter - longer.head(shorter.size())).cwiseAbs().maxCoeff(),
            1e-12 * shorter.cwiseAbs().maxCoeff());
}

TEST(Turbulence, ForcesDoNotDependOnTheBasis) {
  // modes across, and eight modes instead of four: lift reaches those in the plane x-y alone
  const Workshop folder;
  const std::string rest = run(1.0, "nodes = [\"middle0\"]\nevery = 0.01\n", "step = 1e-3\n");
  const Eigen::VectorXd plane = lift_of(
                            folder.run_text(tubes(folder, 1, in_one_plane, white() + modes(4) + rest))),
                        both = lift_of(folder.run_text(tubes(folder, 1, across, white() + modes(8) + rest)));
  constexpr double of_solver = 1e-6; // residuals of two solutions
  EXPECT_LT((plane - both).norm(), of_solver * plane.norm());
}

TEST(Turbulence, ForcesDoNotDependOnRanksNorOnOtherTubes) {
  const Workshop folder;
  const std::string rest = white() + modes(3) + run(0.5, "nodes = [\"middle0\"]\n", "step = 1e-3\n");
  const Results one = folder.run_text(tubes(folder, 2, in_one_plane, rest)),
                two = folder.run_text(tubes(folder, 2, in_one_plane, rest), {"--force"}, 2);
  EXPECT_TRUE(same_numbers(one.archive, two.archive));
  const Eigen::VectorXd alone = lift_of(folder.run_text(tubes(folder, 1, in_one_plane, rest)));
  EXPECT_LT((lift_of(one) - alone).norm(),
            1e-6 * alone.norm()); // the band is that of the spectrum, not of the tubes
  const Eigen::VectorXd other =
      lift_of(folder.run_text(tubes(folder, 1, in_one_plane, rest), {"--set", "turbulence.t.seed=2"}));
  EXPECT_GT((other - alone).norm(), 0.1 * alone.norm());
}

TEST(Turbulence, TablesThatWereChangedAreNotTakenForGood) {
  const Workshop folder;
  const std::string study = tubes(folder, 1, in_one_plane,
                                  white() + modes(3) + run(0.5, "nodes = [\"middle0\"]\n", "step = 1e-3\n"));
  const std::vector<std::string> command{"run", folder.write("study.toml", study).string(), "-o",
                                         folder.path("results").string(), "--no-report"};
  ASSERT_EQ(folder.fretwork(command).status, 0);
  for (const char* name : {"flow.csv", "spectra.csv"}) {
    const fs::path table = folder.path("results") / name;
    const std::string whole = bytes_of(table);
    const fs::path changed = folder.write("changed", whole + "\n");
    fs::copy_file(changed, table, fs::copy_options::overwrite_existing);
    const Outcome report = folder.fretwork({"report", folder.path("results").string()});
    EXPECT_EQ(report.status, 1) << name;
    EXPECT_TRUE(says(report.err, std::string(name) + " is not as it was written"));
    EXPECT_TRUE(says(folder.fretwork(command).out, std::string(name) + " is not as it was written"));
    EXPECT_EQ(bytes_of(table), whole);
  }
  EXPECT_TRUE(says(folder.fretwork(command).out, "up to date"));
}

TEST(Turbulence, IsNoPartOfAStaticStart) {
  const Workshop folder;
  const Results results =
      folder.run_text(tubes(folder, 1, in_one_plane,
                            white() + modes(3) + "[gravity]\nacceleration = [0, -9.81, 0]\n" +
                                run(0.01, "nodes = [\"middle0\"]\n", "start = \"static\"\nstep = 1e-3\n")));
  const double weight = 9.81 * (8000.0 * (displaced - pi / 4.0 * bore * bore) - 740.0 * displaced),
               sag = 5.0 * weight / (384.0 * bending);
  constexpr double of_modes = 5e-3; // the modes 5, 7 ... : 1/5^5 and more
  EXPECT_NEAR(results.archive.series.nodes[0].displacement(0, 1) / -sag, 1.0, of_modes);
}

TEST(LinearResponse, IsThatOfTheClosedForm) {
  const Workshop folder;
  const Outcome outcome =
      outcome_of(folder,
                 tubes(folder, 1, in_one_plane,
                       white("band = [0.1, 2000]\n") + modes(3) + "[output]\nnodes = [\"middle0\"]\n"),
                 "response");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "Linear response \"all contacts pinned\" on 3 modes, nothing pinned"));
  const json summary = json::parse(bytes_of(folder.path("out") / "summary.json"));
  const double closed = std::sqrt(variance_of_middle(1) + variance_of_middle(3));
  constexpr double of_patches = 4e-3; // half of (1/5)^2/6, and the coupling of modes 1 and 3
  EXPECT_TRUE(close_to(rms_of(summary["response"][0]["points"], "middle0", "y"), closed, of_patches));
  std::istringstream table(bytes_of(folder.path("out") / "response.csv"));
  std::string header, first;
  std::getline(table, header);
  std::getline(table, first);
  EXPECT_TRUE(header.starts_with("response,name,direction,rms [m]"));
  EXPECT_TRUE(first.starts_with("\"all contacts pinned\",\"middle0\",x,"));
}

// From forces that a tenth of the tube shares to one that all of it does: the shape of a mode counts, not that at a few places.
TEST(LinearResponse, IsThatOfAnyCorrelationLength) {
  const Workshop folder;
  for (const double lambda : {0.1, 1.0, 2.0, 5.0, 100.0}) {
    std::string study = tubes(folder, 1, in_one_plane,
                              white("band = [0.1, 2000]\n") + modes(1) + "[output]\nnodes = [\"middle0\"]\n");
    const std::string key = fmt::format("correlation_length = {}", correlation);
    study.replace(study.find(key), key.size(), fmt::format("correlation_length = {}", lambda));
    ASSERT_EQ(outcome_of(folder, study, "response").status, 0);
    const json summary = json::parse(bytes_of(folder.path("out") / "summary.json"));
    constexpr double of_patches = 4e-3; // half of (1/5)^2/6
    EXPECT_TRUE(close_to(rms_of(summary["response"][0]["points"], "middle0", "y"),
                         std::sqrt(variance_of_middle(1, lambda)), of_patches))
        << lambda;
  }
}

// Its modes move along the tube by round-off alone: no up-crossings and no maximum follow from that.
TEST(LinearResponse, AlongATubeThatTheFlowCrossesIsNone) {
  const Workshop folder;
  const std::string study = tubes(folder, 1, R"(["rx"])",
                                  white("band = [0.1, 2000]\n") + modes(12) +
                                      "[[restraints]]\ngroup = \"tube0_begin\"\nfixed = [\"ux\"]\n"
                                      "[output]\nnodes = [\"middle0\"]\n");
  const Outcome outcome = outcome_of(folder, study, "response");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json point = json::parse(bytes_of(folder.path("out") / "summary.json"))["response"][0]["points"][0];
  EXPECT_EQ(point["direction"], "x");
  EXPECT_EQ(point["rms_m"], 0.0);
  EXPECT_EQ(point["up_crossings_per_second"], 0.0);
}

// The turbulence alone does not say how a tube moves that the flow makes unstable.
TEST(LinearResponse, WarnsOfATubePastItsCriticalVelocity) {
  const Workshop folder;
  const double decrement = 2.0 * pi * ratio / std::sqrt(1.0 - ratio * ratio),
               critical = 3.0 * frequency(1) * std::sqrt(mass * decrement / 740.0); // Connors, K = 3
  const auto said = [&](double share, const std::string& constant = "connors_constant = 3\n") {
    std::string study =
        tubes(folder, 1, in_one_plane, white() + modes(3) + "[output]\nnodes = [\"middle0\"]\n");
    const auto replace = [&study](const std::string& old, const std::string& by) {
      study.replace(study.find(old), old.size(), by);
    };
    replace("velocity = [0, 0, 1]", fmt::format("velocity = [0, 0, {}]", share * critical));
    replace("connors_constant = 3\n", constant);
    const Outcome outcome = outcome_of(folder, study, "response");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(bytes_of(folder.path("out") / "summary.json"))["warnings"].dump();
  };
  EXPECT_TRUE(says(
      said(1.2), "response \\\"all contacts pinned\\\": flow \\\"tube0\\\" is fluid-elastically unstable on "
                 "its modes, V/Vc = 1.2 in mode 1 at "));
  EXPECT_FALSE(says(said(0.95), "unstable"));
  EXPECT_FALSE(says(said(1.2, ""), "unstable")); // without a constant nothing is judged
}

TEST(LinearResponse, PinsContactsAndLeavesOthersFree) {
  const Workshop folder;
  const std::string contact =
      "[[contacts]]\nname = \"support\"\ngroup = \"middle0\"\ngap = 1e-3\nnormal_stiffness = 1e6\n";
  const std::string study = tubes(folder, 1, across, white() + modes(6) + contact) +
                            "[[response]]\nname = \"held\"\ndamping = 0.05\n[[response]]\nname = \"free\"\n"
                            "pinned = \"none\"\n[output]\nnodes = [\"tube0\"]\n";
  const Outcome outcome = outcome_of(folder, study, "response");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json responses = json::parse(bytes_of(folder.path("out") / "summary.json"))["response"];
  ASSERT_EQ(responses.size(), 2u);
  EXPECT_EQ(responses[0]["pinned"], json({"support"}));
  EXPECT_TRUE(responses[1]["pinned"].empty());
  EXPECT_TRUE(close_to(responses[1]["lowest_mode"]["frequency_hz"], frequency(1), 1e-3));
  EXPECT_EQ(responses[0]["lowest_mode"]["damping"], 0.05);
  EXPECT_TRUE(close_to(responses[1]["lowest_mode"]["damping"], ratio, 1e-12));
  EXPECT_TRUE(says(outcome.out, "with 5 % of critical damping\n"));
  const double held = rms_of(responses[0]["points"], "tube0[10]", "y"),
               free = rms_of(responses[1]["points"], "tube0[10]", "y");
  EXPECT_LT(held, 1e-3 * free);
  // a contact that is not pinned is watched along its local axes: y_loc is y of a tube along x
  EXPECT_TRUE(close_to(rms_of(responses[1]["points"], "support", "y_loc"), free, 1e-9));
  for (const json& point : responses[0]["points"])
    EXPECT_NE(point["name"], "support");
}

TEST(Turbulence, IsRefusedWhereItCannotAct) {
  const Workshop folder;
  const auto refused = [&](const std::string& text, const std::string& part, const std::string& command) {
    const Outcome outcome = outcome_of(folder, text, command);
    EXPECT_EQ(outcome.status, 1) << part;
    EXPECT_TRUE(says(outcome.err, part));
  };
  const std::string entry = "[[turbulence]]\nspectrum = \"cor_3\"\ncorrelation_length = 0.06\n";
  const auto with = [&](const std::string& keys) { return tubes(folder, 1, in_one_plane, entry + keys); };
  const auto instead = [&](const std::string& old, const std::string& text) {
    std::string study = with("");
    return study.replace(study.find(old), old.size(), text);
  };
  refused(with("flow = \"tube9\"\n"), "no [[flow]] is called so", "mesh");
  refused(with("zones = [\"wather\"]\n"), "did you mean \"water\"", "mesh");
  refused(with("zones = \"water\"\n" + entry + "zones = \"water\"\n"), "would double it", "mesh");
  refused(with(entry + "zones = \"water\"\n"), "acts on no zone", "mesh");
  refused(instead("velocity = [0, 0, 1]", "velocity = 1.0"), "no direction of drag", "mesh");
  refused(instead("[0, 0, 1]", "[5, 0, 0]"),
          "up to 5 m/s, is along the tube everywhere: spectra are those of cross flow", "mesh");
  refused(instead("cor_3", "two_phase"), "has one phase", "mesh");
  refused(instead("0.06", "1e-5"), "correlation_length", "mesh");
  refused(tubes(folder, 1, in_one_plane, ""), "no [[turbulence]]", "response");
  refused(tubes(folder, 1, in_one_plane, white() + "[modes]\ncount = 3\n[output]\nnodes = [\"middle0\"]\n"),
          "damping ratio 0", "response");
  refused(tubes(folder, 1, in_one_plane, white() + modes(3)), "nothing is observed", "response");
}

} // namespace
} // namespace fretwork::app::test::turbulence_test
