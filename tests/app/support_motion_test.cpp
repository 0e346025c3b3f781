// SPDX-License-Identifier: GPL-3.0-or-later
// Supports that move by themselves: static shapes, closed forms, and the same structures described in other ways.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::support_motion_test {
namespace {

constexpr double static_solution = 1e-9; ///< relative, of the factorisation on a mesh of some ten beams
constexpr double same_equations = 1e-8;  ///< relative: the same numbers by other ways, over some impacts
constexpr double pi = std::numbers::pi;

const std::string beam = steel_pipe("mesh.msh") + tube_between("tube") + R"([modes]
count = 20
damping = 0.01
[transient]
duration = 0.1
[output]
every = 1.0e-3
nodes = ["middle"]
)";

/// A tube along x of length 1, its middle a point; and a point of its own beside it.
void write_tube(const Workshop& folder) {
  MeshText mesh = straight_line("tube", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 10);
  mesh.points.emplace_back("middle", 5);
  mesh.points.emplace_back("plate", static_cast<int>(mesh.nodes.size()));
  mesh.nodes.emplace_back(0.5, 0.0, 0.0);
  folder.write("mesh.msh", mesh.text());
}

std::string hole(const std::string& more) {
  return "[[contacts]]\nname = \"hole\"\ngroup = \"middle\"\naxis = [1.0, 0.0, 0.0]\nnormal_stiffness = "
         "1.0e5\n"
         "normal_damping = 5.0\nfriction = 0.2\ntangential_stiffness = 1.0e5\n" +
         more + "\n";
}
std::string restrained(const std::string& group) {
  return "[[restraints]]\ngroup = \"" + group + "\"\nfixed = \"all\"\n";
}
std::string moved(const std::string& group, const std::string& how) {
  return "[[support_motion]]\ngroup = \"" + group + "\"\n" + how + "\n";
}

double largest(const Eigen::MatrixXd& x) { return x.cwiseAbs().maxCoeff(); }

/// A mass on a spring of 100 rad/s along y, as the study of lone points.
std::string oscillator(const std::string& more) {
  return R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 2.0
[[restraints]]
group = "mass"
fixed = ["ux", "uz", "rx", "ry", "rz"]
[modes]
count = 1
damping = 0.0
[transient]
duration = 0.1
[output]
every = 1.0e-3
nodes = ["mass"]
)" + more;
}

/// u = s + q, q'' + w0^2 q = -s'', s = A sin(w t): imposed by the foot at t = 0.
void expect_shaken(const post::NodeSeries& mass, const Eigen::VectorXd& time) {
  constexpr double amplitude = 1e-3, w0 = 100.0, w = 2.0 * pi * 10.0;
  constexpr double of_linear_loads = 1e-4; // (2 pi/200)^2/12 of the loads and what they force
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const double t = time(i), c = amplitude * w * w / (w0 * w0 - w * w);
    const double u = amplitude * std::sin(w * t) + c * (std::sin(w * t) - w / w0 * std::sin(w0 * t));
    const double v = amplitude * w * std::cos(w * t) + c * w * (std::cos(w * t) - std::cos(w0 * t));
    const double a = -w0 * w0 * (u - amplitude * std::sin(w * t));
    EXPECT_NEAR(mass.displacement(i, 1), u, of_linear_loads * amplitude);
    EXPECT_NEAR(mass.velocity(i, 1), v, of_linear_loads * amplitude * w0);
    EXPECT_NEAR(mass.acceleration(i, 1), a, of_linear_loads * amplitude * w0 * w0);
  }
}

const std::string shaken = "direction = [0.0, 1.0, 0.0]\nquantity = \"displacement\"\n"
                           "harmonic = { amplitude = 1.0e-3, frequency = 10.0 }\n";

} // namespace

TEST(SupportMotion, CarriesTheStructureStatically) {
  const Workshop folder;
  write_tube(folder);
  // clamped at both ends, one moved by d: u = d (3 x^2 - 2 x^3)
  const Results run =
      folder.run_text(beam + moved("tube_end", "direction = [0.0, 3.0, 4.0]\nquantity = \"displacement\"\n"
                                               "constant = 1.0e-3\n"));
  const auto& middle = run.node("middle");
  for (Eigen::Index i = 0; i < middle.displacement.rows(); ++i) {
    EXPECT_NEAR(middle.displacement(i, 1), 0.5 * 0.6e-3, static_solution * 1e-3);
    EXPECT_NEAR(middle.displacement(i, 2), 0.5 * 0.8e-3, static_solution * 1e-3);
  }
  EXPECT_EQ(largest(middle.velocity), 0.0);
  const auto& mean = run.summary["nodes"][0]["displacement"]["y"];
  EXPECT_NEAR(mean["mean"].get<double>(), 0.3e-3, static_solution * 1e-3);
}

TEST(SupportMotion, ShakesAnOscillatorByItsFoot) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass", "foot"}).text());
  const Results run = folder.run_text(oscillator("[[springs]]\ngroup = \"mass\"\nother = \"foot\"\n"
                                                 "stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]\n" +
                                                 restrained("foot") + moved("foot", shaken)));
  expect_shaken(run.node("mass"), run.archive.series.time);
}

TEST(SupportMotion, ShakesAnOscillatorByTheGroundOfItsSpring) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass"}).text());
  const Results run = folder.run_text(oscillator("[[springs]]\ngroup = \"mass\"\n"
                                                 "stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]\n" +
                                                 moved("mass", shaken)));
  expect_shaken(run.node("mass"), run.archive.series.time);
}

TEST(SupportMotion, DampersFeelWhatTheStaticShapeMoves) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass", "foot"}).text());
  // the foot leaves at v, pulling by a spring; another spring and a damper hold the mass to the ground:
  // m u'' + c u' + (k + k2) u = k v t with u = 0 and u' = e v at the start, e = k/(k + k2)
  constexpr double m = 2.0, k = 300.0, k2 = 200.0, c = 6.0, v = 0.2, duration = 2.0;
  for (const char* scheme : {"splitting", "runge_kutta_54"}) {
    const Results run = folder.run_text(
        oscillator("[[springs]]\ngroup = \"mass\"\nother = \"foot\"\nstiffness = [0, 300.0, 0, 0, 0, 0]\n"
                   "[[springs]]\ngroup = \"mass\"\nstiffness = [0, 200.0, 0, 0, 0, 0]\n"
                   "damping = [0, 6.0, 0, 0, 0, 0]\n" +
                   restrained("foot") +
                   moved("foot", "direction = [0, 1, 0]\nconstant = 0.0\nvelocity0 = 0.2")),
        {"--set", fmt::format("transient.duration={}", duration), "--set",
         fmt::format("transient.scheme={}", scheme)});
    const double e = k / (k + k2), lag = c / (k + k2), rate = c / (2.0 * m),
                 w = std::sqrt((k + k2) / m - rate * rate);
    const Eigen::VectorXd& time = run.archive.series.time;
    constexpr double of_the_tolerance = 1e-5; // of runge_kutta_54
    for (Eigen::Index i = 0; i < time.size(); ++i) {
      const double t = time(i), decay = std::exp(-rate * t);
      const double u = e * v * (t - lag + lag * decay * (std::cos(w * t) + rate / w * std::sin(w * t)));
      EXPECT_NEAR(run.node("mass").displacement(i, 1), u, of_the_tolerance * v * duration)
          << scheme << ", " << t;
    }
  }
}

TEST(SupportMotion, MovesTheGroundOfADamper) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass"}).text());
  // a mass at rest that a damper drags behind a ground of velocity v: u' = v (1 - exp(-c t/m))
  const Results run =
      folder.run_text(oscillator("[[springs]]\ngroup = \"mass\"\ndamping = [0, 40.0, 0, 0, 0, 0]\n" +
                                 moved("mass", "direction = [0, 1, 0]\nconstant = 0.0\nvelocity0 = 0.2")));
  const Eigen::VectorXd& time = run.archive.series.time;
  for (Eigen::Index i = 0; i < time.size(); ++i)
    EXPECT_NEAR(run.node("mass").velocity(i, 1), 0.2 * (1.0 - std::exp(-20.0 * time(i))), 1e-9);
}

TEST(SupportMotion, OfAllSupportsIsBaseMotionSeenFromSpace) {
  const Workshop folder;
  write_tube(folder);
  const std::string how = "direction = [0.0, 1.0, 0.5]\nvelocity0 = -0.05\n"
                          "harmonic = { amplitude = 20.0, frequency = 40.0 }\n";
  const Results base =
      folder.run_text(beam + "[[base_motion]]\n" + how + hole("gap = 1.0e-4\nattached_to = \"ground\""));
  const Results supports =
      folder.run_text(beam + moved("tube_begin", how) + moved("tube_end", how) + hole("gap = 1.0e-4"));
  const auto &a = base.contact("hole"), &b = supports.contact("hole");
  EXPECT_GT(largest(a.normal_force), 1.0);
  EXPECT_LT(largest(a.displacement - b.displacement), same_equations * largest(a.displacement));
  EXPECT_LT(largest(a.velocity - b.velocity), same_equations * largest(a.velocity));
  EXPECT_LT(largest(a.normal_force - b.normal_force), same_equations * largest(a.normal_force));
  // the observed node: relative to the base there, in space here; at the contact both are the same point
  const auto& node = supports.node("middle");
  EXPECT_LT(largest(node.displacement.col(1) - b.displacement.col(1)),
            same_equations * largest(b.displacement));
  EXPECT_GT(largest(base.node("middle").displacement - node.displacement), 0.1 * largest(b.displacement));
  EXPECT_TRUE(close_to(supports.summary["energy"]["input_J"].get<double>(),
                       base.summary["energy"]["input_J"].get<double>(), same_equations));
}

TEST(SupportMotion, OfOneEndIsThatOfAHeavyMass) {
  const Workshop folder;
  write_tube(folder);
  // s'' = a cos(w t), from rest; no damping, that of the mass' own mode would be another
  const std::string function =
      "harmonic = {{ amplitude = {}, frequency = 30.0, phase = 1.5707963267948966 }}\n";
  std::string heavy = beam, end = "group = \"tube_end\"\nfixed = \"all\"";
  heavy.replace(heavy.find(end), end.size(),
                "group = \"tube_end\"\nfixed = [\"ux\", \"uz\", \"rx\", \"ry\", \"rz\"]");
  const std::vector<std::string> undamped = {"--set", "modes.damping=0.0"};
  const Results moved_end = folder.run_text(
      beam + moved("tube_end", "direction = [0.0, 1.0, 0.0]\n" + fmt::format(fmt::runtime(function), 60.0)) +
          hole("gap = 2.0e-4"),
      undamped);
  const Results pushed =
      folder.run_text(heavy +
                          "[[masses]]\ngroup = \"tube_end\"\nmass = 1.0e6\n[[loads]]\ngroup = \"tube_end\"\n"
                          "direction = [0.0, 1.0, 0.0]\n" +
                          fmt::format(fmt::runtime(function), 60.0e6) + hole("gap = 2.0e-4"),
                      undamped);
  const auto &a = moved_end.contact("hole"), &b = pushed.contact("hole");
  constexpr double truncated = 1e-3; // the modes left out move in one description and are static in the other
  EXPECT_GT(largest(a.normal_force), 10.0);
  EXPECT_LT(largest(a.displacement - b.displacement), truncated * largest(a.displacement));
  EXPECT_LT(largest(a.normal_force - b.normal_force), 0.02 * largest(a.normal_force));
}

TEST(SupportMotion, CarriesObstaclesThatAreAttachedToIt) {
  const Workshop folder;
  write_tube(folder);
  const std::string plate =
      restrained("plate") + moved("plate",
                                  "direction = [0.0, 0.0, 1.0]\nquantity = \"displacement\"\n"
                                  "table = [[0.0, 0.0], [0.01, 1.0e-3], [0.02, -1.0e-3], [0.03, 0.0]]\n");
  const Results attached = folder.run_text(beam + plate + hole("gap = 1.0e-4\nattached_to = \"plate\""));
  const Results between = folder.run_text(
      beam + plate +
      hole("other = \"plate\"\nobstacle = \"circle_inside\"\ndistance_1 = 0.01\ndistance_2 = 0.0101"));
  const Results space = folder.run_text(beam + plate + hole("gap = 1.0e-4"));
  const auto &a = attached.contact("hole"), &b = between.contact("hole");
  EXPECT_GT(largest(a.normal_force), 10.0);
  EXPECT_LT(largest(a.normal_force - b.normal_force), same_equations * largest(a.normal_force));
  EXPECT_LT(largest(a.displacement - b.displacement), same_equations * largest(a.displacement));
  EXPECT_EQ(largest(space.contact("hole").normal_force), 0.0);
  // the plate has come back: the tube's own displacement is that from the obstacle
  const auto last = a.displacement.rows() - 1;
  EXPECT_NEAR(a.displacement(last, 2), attached.node("middle").displacement(last, 2), 1e-12);
}

TEST(SupportMotion, CarriesObstaclesByAnyScheme) {
  const Workshop folder;
  write_tube(folder);
  const std::string plate = restrained("plate") +
                            moved("plate", "direction = [0.0, 0.0, 1.0]\nquantity = \"displacement\"\n"
                                           "harmonic = { amplitude = 1.0e-3, frequency = 20.0 }\n") +
                            hole("gap = 1.0e-4\nattached_to = \"plate\"");
  const auto with = [&](const std::string& scheme) {
    return folder.run_text(
        beam + plate, {"--force", "--set", "transient.duration=0.02", "--set", "transient.scheme=" + scheme});
  };
  const Results run = with("splitting");
  const auto& wanted = run.contact("hole");
  EXPECT_GT(largest(wanted.normal_force), 10.0);
  constexpr double of_the_steps = 1e-3; // Euler's, of order 1; the others are much nearer
  for (const std::string scheme :
       {"collocation", "euler", "energy_conserving", "devogelaere", "runge_kutta_54"}) {
    const Results other = with(scheme);
    const auto& found = other.contact("hole");
    EXPECT_LT(largest(found.displacement - wanted.displacement), of_the_steps * largest(wanted.displacement))
        << scheme;
    EXPECT_LT(other.summary["energy"]["residual_relative"].get<double>(), of_the_steps) << scheme;
  }
}

TEST(SupportMotion, CarriesATubeThatIsFreeToSpinAndToSlide) {
  const Workshop folder;
  write_tube(folder);
  std::string pinned = beam;
  for (const std::string end : {"tube_begin", "tube_end"}) {
    const std::string clamp = "group = \"" + end + "\"\nfixed = \"all\"";
    pinned.replace(pinned.find(clamp), clamp.size(), "group = \"" + end + "\"\nfixed = [\"uy\", \"uz\"]");
  }
  const std::string shake =
      "direction = [0.0, 1.0, 0.0]\nharmonic = { amplitude = 50.0, frequency = 40.0 }\n";
  const std::string text =
      pinned + moved("tube_begin", shake) + moved("tube_end", shake) + hole("gap = 1.0e-4");
  const Outcome checked = folder.fretwork({"check", folder.write("pinned.toml", text).string()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  const Results free = folder.run_text(text, {"--force"});
  // held along and about its axis it moves no other way
  std::string held = text;
  const std::string pin = "fixed = [\"uy\", \"uz\"]";
  held.replace(held.find(pin), pin.size(), "fixed = [\"ux\", \"uy\", \"uz\", \"rx\"]");
  const Results fixed = folder.run_text(held, {"--force", "--set", "modes.count=18"});
  const auto &a = free.contact("hole"), &b = fixed.contact("hole");
  EXPECT_GT(largest(a.normal_force), 1.0);
  EXPECT_LT(largest(a.displacement - b.displacement), same_equations * largest(a.displacement));
  // pinned ends moved alike: the static shape is a translation
  const auto& node = free.node("middle");
  EXPECT_EQ(node.displacement(0, 1), 0.0);
  EXPECT_LT(largest(node.displacement.col(0)), same_equations * largest(node.displacement));
}

TEST(SupportMotion, OfARandomAccelerationStaysAboutItsPlace) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass", "foot"}).text());
  const auto shaken_at_random = [&](const std::string& start) {
    return folder.run_text(
        oscillator("[[springs]]\ngroup = \"mass\"\nother = \"foot\"\n"
                   "stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]\n" +
                   restrained("foot") +
                   moved("foot", "direction = [0.0, 1.0, 0.0]\nrandom = { rms = 5.0, band = [5.0, 50.0] }\n" +
                                     start)),
        {"--force", "--set", "transient.duration=4.0", "--set", "modes.damping=0.1"});
  };
  const Results about = shaken_at_random(""),
                told = shaken_at_random("velocity0 = 0.0\ndisplacement0 = 0.0\n"),
                drifting = shaken_at_random("velocity0 = 0.1\n");
  const auto most = [](const Results& run) { return largest(run.node("mass").displacement); };
  constexpr double of_the_band = 5.0 / 900.0; // rms/w^2 at 5 Hz is 5 mm
  EXPECT_LT(most(about), 3.0 * of_the_band);
  EXPECT_EQ(most(told), most(about));
  EXPECT_NEAR(most(drifting), 0.4, most(about)); // as given
  const Eigen::VectorXd y = about.node("mass").displacement.col(1);
  const Eigen::Index half = y.size() / 2;
  EXPECT_NEAR(y.head(half).mean(), y.tail(half).mean(), 0.2 * of_the_band);
}

TEST(SupportMotion, ThatRisesForMuchOfTheRunIsWarnedAbout) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass", "foot"}).text());
  const auto warned = [&](const std::string& band) {
    const auto study =
        folder.write("study.toml", oscillator("[[springs]]\ngroup = \"mass\"\nother = \"foot\"\n"
                                              "stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]\n" +
                                              restrained("foot") +
                                              moved("foot", "direction = [0.0, 1.0, 0.0]\n"
                                                            "random = { rms = 5.0, band = " +
                                                                band + " }\n")));
    const Outcome outcome = folder.fretwork({"check", study.string(), "--set", "transient.duration=4.0"});
    EXPECT_EQ(outcome.status, 0) << outcome.out;
    return outcome.out.find("rises from rest") != std::string::npos;
  };
  EXPECT_TRUE(warned("[1.0, 50.0]"));
  EXPECT_FALSE(warned("[2.0, 50.0]"));
}

TEST(SupportMotion, TellsWhatIsWrong) {
  const Workshop folder;
  write_tube(folder);
  const auto refused = [&](const std::string& more) {
    const Outcome outcome = folder.fretwork({"check", folder.write("study.toml", beam + more).string()});
    EXPECT_EQ(outcome.status, 1);
    return outcome.err;
  };
  EXPECT_TRUE(says(
      refused(moved("middle", "direction = [0.0, 1.0, 0.0]\nconstant = 1.0")),
      "[[support_motion]] entry 1: a node of \"middle\" at (0.5, 0, 0) is neither restrained nor held by a "
      "grounded spring along y, so that nothing moves it; add \"uy\" to its [[restraints]], a spring, or "
      "change the direction"));
  EXPECT_TRUE(
      says(refused(moved("tube_ends", "direction = [0.0, 1.0, 0.0]\nconstant = 1.0")), "\"tube_ends\""));
}

TEST(SupportMotion, FrictionOfTheReferenceOnACarriedNodeIsRefusedWhereItCannotBeSolved) {
  const Workshop folder;
  std::string study = bytes_of(example("straight_tube"));
  study.replace(study.find("tube.geo"), 8, (example("straight_tube").parent_path() / "tube.geo").string());
  study +=
      "[[base_motion]]\ndirection = [1.0, 0.0, 0.0]\nharmonic = { amplitude = 15.0, frequency = 23.0 }\n";
  const fs::path file = folder.write("study.toml", study);
  const auto outcome = folder.fretwork(
      {"run", file.string(), "-o", folder.path("results").string(), "--set", "transient.duration=0.1",
       "--set", "output.statistics_from=0", "--set", "transient.scheme=collocation", "--set",
       "contacts.support.friction_memory=reference", "--set", "contacts.support.attached_to=ground"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err,
                   "scheme = \"collocation\" does not take friction_memory = \"reference\" of contact "
                   "\"support[0]\", which an obstacle carries along x_loc where no mode moves its node (it "
                   "does take \"return_map\"); use scheme = \"splitting\""));
}

} // namespace fretwork::app::test::support_motion_test
