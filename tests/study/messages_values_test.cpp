// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_messages.hpp"

namespace fretwork::study {
namespace {

TEST(Messages, OfNumbersThatAreNotFinite) {
  for (const char* number : {"nan", "inf", "-inf"})
    expect_messages(
        {{"scale = 0.001",
          std::string("scale = ") + number,
          {"mesh.scale = ", "a finite number is expected"}},
         {"poisson_ratio = 0.3", std::string("poisson_ratio = ") + number, {"a finite number is expected"}},
         {"stiffness = [0, 1e4, 0, 0, 0, 6]",
          std::string("stiffness = [0, 0, 0, 0, 0, ") + number + "]",
          {"springs.apex.stiffness[5] = ", "a finite number is expected"}},
         {"table = [[0, 1], [1, 1], [1, 2.5]]",
          std::string("table = [[0, ") + number + "]]",
          {"loads.foot.table[0][1] = ", "a finite number is expected"}},
         {"damping = [0.01, 0.02]", std::string("damping = ") + number, {"a finite number is expected"}},
         {"velocity = [1, 2, 3]",
          std::string("velocity = [0, 0, ") + number + "]",
          {"a finite number is expected"}}});
}

TEST(Messages, OfNumbersOutOfRange) {
  expect_messages({
      {"element_size = 0.05", "element_size = 0", {"mesh.element_size = 0: a number > 0 in m is expected"}},
      {"element_size = 0.05", "order = 3", {"mesh.order = 3: 1 (straight elements) or 2 (arcs)"}},
      {"scale = 0.001", "scale = -1", {"mesh.scale = -1: a number > 0 is expected"}},
      {"merge_tolerance = 1e-6",
       "merge_tolerance = -1",
       {"mesh.merge_tolerance = -1: a number >= 0 in m is expected"}},
      {"young_modulus = 2e11",
       "young_modulus = 0",
       {"materials.inconel.young_modulus = 0: a number > 0 in Pa is expected"}},
      {"density = 8200",
       "density = -1",
       {"materials.inconel.density = -1: a number >= 0 in kg/m3 is expected"}},
      {"poisson_ratio = 0.3",
       "poisson_ratio = 0.5",
       {"materials.inconel.poisson_ratio = 0.5: a number between -1 and 0.5"}},
      {"poisson_ratio = 0.3",
       "poisson_ratio = -1",
       {"materials.inconel.poisson_ratio = -1: a number between -1 and 0.5"}},
      {"outer_diameter = 0.02",
       "outer_diameter = 0",
       {"sections.tube.outer_diameter = 0: a number > 0 in m is expected"}},
      {"thickness = 0.001",
       "thickness = 0.011",
       {"sections.tube.thickness = 0.011: more than half of outer_diameter", "shape = \"circle\""}},
      {"diameter = 0.2", "diameter = -0.2", {"sections.rod.diameter = -0.2: a number > 0 in m is expected"}},
      {"height_y = 0.01", "height_y = 0", {"sections.bar.height_y = 0: a number > 0 in m is expected"}},
      {"area = 1e-3", "area = 0", {"sections.free.area = 0: a number > 0 in m2 is expected"}},
      {"polar_inertia = 4e-8",
       "polar_inertia = -1",
       {"sections.free.polar_inertia = -1: a number >= 0 in m4 is expected"}},
      {"added_mass = 0.3",
       "added_mass = -0.3",
       {"beams.tube.added_mass = -0.3: a number >= 0 in kg/m is expected"}},
      {"mass = 0.5", "mass = -0.5", {"masses.apex.mass = -0.5: a number >= 0 in kg is expected"}},
      {"inertia = [1, 2, 3]",
       "inertia = [1, -2, 3]",
       {"masses.apex.inertia[1] = -2: a number >= 0 in kg m2 is expected"}},
      {"stiffness = [0, 1e4, 0, 0, 0, 6]",
       "stiffness = [-1, 0, 0, 0, 0, 0]",
       {"springs.apex.stiffness[0] = -1: a number >= 0"}},
      {"damping = [1, 2, 3, 4, 5, 6]",
       "damping = [0, 0, 0, 0, 0, -1]",
       {"springs.apex.damping[5] = -1: a number >= 0"}},
      {"count = 12", "count = 0", {"modes.count = 0: an integer >= 1 is expected"}},
      {"count = 12",
       "count = 9999999999",
       {"modes.count = 9999999999: more modes than a structure can have"}},
      {"count = 12", "up_to_hz = 0", {"modes.up_to_hz = 0: a number > 0 in Hz is expected"}},
      {"damping = [0.01, 0.02]",
       "damping = [0.01, -0.02]",
       {"modes.damping[1] = -0.02: a number >= 0 is expected"}},
      {"damping = [0.01, 0.02]", "damping = -0.01", {"modes.damping = -0.01: a number >= 0 is expected"}},
      {"damping = [0.01, 0.02]",
       "damping = { mass = -1 }",
       {"modes.damping.mass = -1: a number >= 0 in 1/s is expected"}},
      {"gap = 2e-4",
       "gap = -2e-4",
       {"contacts.tsp1.gap = -0.0002: a number >= 0 in m is expected; an overlap is made by origin or "
        "offset, with a gap >= 0"}},
      {"normal_stiffness = 1e6",
       "normal_stiffness = 0",
       {"contacts.tsp1.normal_stiffness = 0: a number > 0 in N/m is expected"}},
      {"normal_damping = 10",
       "normal_damping = -1",
       {"contacts.tsp1.normal_damping = -1: a number >= 0 in N s/m is expected"}},
      {"tangential_stiffness = 2e6",
       "tangential_stiffness = -1",
       {"contacts.tsp1.tangential_stiffness = -1: a number >= 0 in N/m"}},
      {"tangential_damping = 3",
       "tangential_damping = -1",
       {"contacts.tsp1.tangential_damping = -1: a number >= 0 in N s/m"}},
      {"friction = 0.2", "friction = -0.2", {"contacts.tsp2.friction = -0.2: a number >= 0 is expected"}},
      {"harmonic = { amplitude = 10, frequency = 25, phase = 0.5 }",
       "harmonic = { amplitude = 1, frequency = 0 }",
       {"loads.apex.harmonic.frequency = 0: a number > 0 in Hz is expected"}},
      {"random = { rms = 5, band = [5, 200], seed = 7 }",
       "random = { rms = -5, band = [5, 200] }",
       {"loads.bar.random.rms = -5: a number >= 0 in N is expected"}},
      {"random = { rms = 5, band = [5, 200], seed = 7 }",
       "random = { rms = 5, band = [200, 5] }",
       {"loads.bar.random.band = [200, 5]: the lower frequency is expected first", "write [low, high]"}},
      {"random = { rms = 5, band = [5, 200], seed = 7 }",
       "random = { rms = 5, band = [5, 5] }",
       {"below the upper one"}},
      {"random = { rms = 5, band = [5, 200], seed = 7 }",
       "random = { rms = 5, band = [-5, 5] }",
       {"loads.bar.random.band[0] = -5: a number >= 0 in Hz"}},
      {"random = { rms = 5, band = [5, 200], seed = 7 }",
       "random = { rms = 5, band = [5, 200], seed = -7 }",
       {"loads.bar.random.seed = -7: an integer >= 0 is expected"}},
      {"duration = 2", "duration = 0", {"transient.duration = 0: a number > 0 in s is expected"}},
      {"accuracy = 0.02", "accuracy = 0", {"transient.accuracy = 0: a number > 0 is expected"}},
      {"accuracy = 0.02", "accuracy = 1", {"transient.accuracy = 1: a relative error below 1 is expected"}},
      {"step = 1e-5", "step = 0", {"transient.step = 0: a number > 0 in s is expected"}},
      {"step = 1e-5", "step = 3", {"transient.step = 3: longer than the duration"}},
      {"every = 1e-4", "every = 0", {"output.every = 0: a number > 0 in s is expected"}},
      {"every = 1e-4", "every = 3", {"output.every = 3: longer than transient.duration"}},
      {"statistics_from = 0.2",
       "statistics_from = -1",
       {"output.statistics_from = -1: a number >= 0 in s is expected"}},
      {"statistics_from = 0.2",
       "statistics_from = 2",
       {"output.statistics_from = 2: the statistics must start before the end"}},
      {"impacts = 500", "impacts = -1", {"output.impacts = -1: an integer >= 0 is expected"}},
      {"impacts = 500", "impacts = 1.5", {"output.impacts = 1.5: an integer >= 0 is expected, not a number"}},
      {"rest_time = 1e-3", "rest_time = -1", {"output.rest_time = -1: a number >= 0 in s is expected"}},
      {"checkpoint = 30", "checkpoint = -1", {"output.checkpoint = -1: a number >= 0 in s is expected"}},
  });
}

TEST(Messages, OfUnknownNames) {
  expect_messages({
      {"shape = \"pipe\"",
       "shape = \"pip\"",
       {"sections.tube.shape = \"pip\": unknown; did you mean \"pipe\"? available: \"pipe\", \"circle\", "
        "\"rectangle\", \"general\""}},
      {"material = \"inconel\"",
       "material = \"inconl\"",
       {"beams.tube.material = \"inconl\": there is no [materials.inconl]; did you mean \"inconel\"? "
        "existing: \"inconel\""}},
      {"section = \"tube\"",
       "section = \"tub\"",
       {"beams.tube.section = \"tub\": there is no [sections.tub]; did you mean \"tube\"? existing: \"bar\", "
        "\"free\", \"rod\", \"tube\""}},
      {"added_mass_direction = \"all\"",
       "added_mass_direction = \"axial\"",
       {"beams.tube.added_mass_direction = \"axial\": unknown; available: \"transverse\", \"all\""}},
      {"fixed = [\"ux\", \"rz\"]",
       "fixed = [\"ux\", \"rw\"]",
       {"restraints.ends.fixed = \"rw\": unknown; did you mean \"rx\"? available: \"ux\", \"uy\", \"uz\", "
        "\"rx\", \"ry\", \"rz\""}},
      {"fixed = \"all\"",
       "fixed = \"al\"",
       {"restraints.foot.fixed = \"al\": unknown; did you mean \"all\"?"}},
      {"static_modes = \"none\"",
       "static_modes = \"non\"",
       {"modes.static_modes = \"non\": unknown; did you mean \"none\"? available: \"none\", \"auto\""}},
      {"obstacle = \"plane_y\"",
       "obstacle = \"cirlce\"",
       {"contacts.tsp1.obstacle = \"cirlce\": unknown; did you mean \"circle\"? available: \"circle\", "
        "\"plane_y\", \"plane_z\", \"stop_y\", \"stop_z\""}},
      {"tangential_damping = \"auto\"",
       "tangential_damping = \"automatic\"",
       {"contacts.tsp2.tangential_damping = \"automatic\": unknown; available: \"auto\""}},
      {"friction_memory = \"reference\"",
       "friction_memory = \"return-map\"",
       {"contacts.tsp1.friction_memory = \"return-map\": unknown; did you mean \"return_map\"? available: "
        "\"return_map\", \"reference\""}},
      {"attached_to = \"base\"",
       "attached_to = \"bas\"",
       {"contacts.tsp1.attached_to = \"bas\": unknown; did you mean \"base\"? available: \"base\", "
        "\"ground\""}},
      {"constant = 1.5", "velocity0 = \"fast\"\nconstant = 1.5", {"base_motion.0.velocity0 = \"fast\": "}},
      {"start = \"rest\"",
       "start = \"rests\"",
       {"transient.start = \"rests\": unknown; did you mean \"rest\"? available: \"rest\", \"static\""}},
      {"scheme = \"splitting\"",
       "scheme = \"eulr\"",
       {"transient.scheme = \"eulr\": unknown; did you mean \"euler\"? available: \"auto\", \"splitting\", "
        "\"collocation\", \"euler\""}},
  });
}

TEST(Messages, OfWhatThisVersionDoesNotCompute) {
  const std::string available = " is not available in this version; available: ";
  expect_messages({
      {"static_modes = \"none\"", "static_modes = \"all\"", {"\"all\"" + available + "\"none\""}},
      {"per_length = true",
       "moment = true\nper_length = true",
       {"loads.apex.moment = true: a moment per length is not available in this version"}},
  });
}

TEST(Messages, OfKeysThatContradictEachOther) {
  const std::string harmonic = "harmonic = { amplitude = 10, frequency = 25, phase = 0.5 }";
  expect_messages({
      {"accuracy = 0.02",
       "tolerance = 1e-4",
       {"transient.tolerance = 0.0001: only scheme = \"runge_kutta_54\" follows a tolerance"}},
      {"scheme = \"splitting\"",
       "tolerance = 0.5\nscheme = \"runge_kutta_54\"",
       {"transient.tolerance = 0.5: ", "at most 0.1 is expected"}},
      {harmonic,
       "",
       {"loads.apex: no time function; give exactly one of \"constant\", \"harmonic\", \"table\", "
        "\"random\""},
       "[[loads]]"},
      {"constant = 1.5", "", {"base_motion.0: no time function; give exactly one of"}, "[[base_motion]]"},
      {harmonic,
       harmonic + "\nconstant = 1",
       {"loads.apex.harmonic: several time functions: \"constant\", \"harmonic\"; keep one"}},
      {"angle = 30",
       "y_axis = [0, 1, 0]\nangle = 30",
       {"contacts.tsp2.y_axis = [0, 1, 0]: angle and y_axis both give the local axes; keep one"}},
      {"y_axis = [1, 0, 0]",
       "y_axis = [0, 0, -3]",
       {"contacts.tsp1.y_axis = [0, 0, -3]: parallel to axis; give a vector across the axis"}},
      {"axis = [1, 0, 0]",
       "",
       {"contacts.tsp2: obstacle \"stop_z\" needs its direction; give y_axis, or axis (and angle)"},
       "",
       -5},
      {"tangential_stiffness = 2e6",
       "",
       {"contacts.tsp1.friction: friction needs a tangential_stiffness > 0 (N/m)"},
       "friction = { static = 0.4, dynamic = 0.3 }"},
      {"tangential_stiffness = 1e6",
       "tangential_stiffness = 0",
       {"contacts.tsp2.friction = 0.2: friction needs a tangential_stiffness > 0 (N/m)"},
       "friction = 0.2"},
      {"friction = { static = 0.4, dynamic = 0.3 }",
       "friction = { static = 0.2, dynamic = 0.3 }",
       {"contacts.tsp1.friction.static = 0.2: less than dynamic"}},
      {"name = \"tsp2\"",
       "name = \"tsp1\"",
       {"contacts.1: a second contact called \"tsp1\" (the first: ",
        "); give each contact a name of its own"},
       "",
       -1},
      {"name = \"tsp1\"",
       "name = \"sg/tsp1\"",
       {"contacts.\"sg/tsp1\".name = \"sg/tsp1\": the name of a contact must not contain a slash"}},
      {"count = 12",
       "up_to_hz = 800\ncount = 12",
       {"modes.up_to_hz = 800: count and up_to_hz both say how many modes; keep one"}},
      {"damping = [0.01, 0.02]", "damping = {}", {"modes.damping: neither stiffness nor mass nor table"}},
      {"damping = [0.01, 0.02]",
       "damping = { mass = 1, table = [[1, 0.1]] }",
       {"modes.damping.table = [[1, 0.1]]: table and stiffness or mass both say the damping; keep one"}},
      {"damping = [0.01, 0.02]",
       "damping = { table = [[1, 0.1], [1, 0.2]] }",
       {"modes.damping.table = [1, 0.2]: its frequency is not above that of the row before; let"}},
      {"damping = [0.01, 0.02]",
       "damping = { table = [1, 0.1] }",
       {"modes.damping.table = 1: a row [Hz, ratio] is expected"}},
      {"damping = [0.01, 0.02]",
       "damping = { table = [[1, -0.1]] }",
       {"modes.damping.table[1] = -0.1: a number >= 0"}},
      {"section = \"tube\"",
       "section = \"bar\"",
       {"beams.tube.orientation: this required key is missing",
        "the section \"bar\" has different iy and iz"},
       "[[beams]]"},
      {"fluid_inside = 750", "fluid_inside = -1", {"beams.tube.fluid_inside = -1: a number >= 0 in kg/m3"}},
      {"fluid_outside = { density = 1000, confinement = 1.5 }",
       "fluid_outside = { confinement = 1.5 }",
       {"beams.tube.fluid_outside.density: this required key is missing"}},
      {"orientation = [0, 0, 2]",
       "orientation = [0, 0, 2]\nfluid_outside = { density = 1000 }",
       {"beams.bar.fluid_outside", "the section \"bar\" is neither a pipe nor a circle",
        "give added_mass (kg/m)"},
       {},
       1},
      {"section = \"tube\"",
       "section = \"rod\"",
       {"beams.tube.fluid_inside = 750: the section \"rod\" has no bore; leave it out"},
       "fluid_inside = 750"},
      {"other = \"wall\"",
       "other = \"apex\"",
       {"springs.apex.other = \"apex\": the group itself: a spring needs two nodes"}},
      {"other = \"arm_end\"",
       "other = \"hinge\"",
       {"ties.hinge.other = \"hinge\": the group itself: a tie needs two nodes; name the group of the "
        "other"}},
      {"other = \"arm_end\"",
       "",
       {"ties.hinge.other: this required key is missing; ", "the group whose nodes move with those of group"},
       "[[ties]]"},
      {"tied = [\"ux\", \"rz\"]",
       "tied = [\"ux\", \"dz\"]",
       {"ties.hinge.tied = \"dz\": unknown; ", "\"ux\", \"uy\", \"uz\", \"rx\", \"ry\", \"rz\""}},
      {"tied = [\"ux\", \"rz\"]", "tied = []", {"ties.hinge.tied = []: the array is empty"}},
      {"nodes = [\"apex\", \"foot\"]",
       "nodes = [\"apex\", \"apex\"]",
       {"output.nodes = \"apex\": named twice; name each group once"}},
      {"start = \"rest\"",
       "start = \"static\"",
       {"initial.apex.displacement = [0, 0.001, 0]: transient.start = \"static\" finds the displacements "
        "itself; leave them out, or take start = \"rest\""},
       "displacement = [0, 1e-3, 0]"},
      {"rotation_rate = [0, 0, 3.8]",
       "",
       {"initial.apex.centre = [0, 0, 1]: a centre without rotation_rate has no effect"},
       "centre = [0, 0, 1]"},
  });
  const std::string mesh = "[mesh]\nfile = \"a.msh\"\n";
  EXPECT_EQ(message_of(mesh + "[[springs]]\ngroup = \"p\"\n"),
            "study.toml:3: springs.p: neither stiffness nor damping; give 6 numbers [ux, uy, uz, rx, ry, rz] "
            "of one of them");
  EXPECT_EQ(message_of(mesh + "[[initial]]\ngroup = \"p\"\n"),
            "study.toml:3: initial.p: no initial state; give displacement, velocity or rotation_rate");
}

TEST(Messages, OfVectorsWithoutDirection) {
  expect_messages({
      {"direction = [0, 3, 4]",
       "direction = [0, 0, 0]",
       {"loads.apex.direction = [0, 0, 0]: a zero vector has no direction"}},
      {"direction = [0, 0, -2]",
       "direction = [0, 0, 0.0]",
       {"base_motion.0.direction = [0, 0, 0]: a zero vector has no direction"}},
      {"axis = [0, 0, 1]",
       "axis = [0, 0, 0]",
       {"contacts.tsp1.axis = [0, 0, 0]: a zero vector has no direction"}},
      {"y_axis = [1, 0, 0]",
       "y_axis = [0, 0, 0]",
       {"contacts.tsp1.y_axis = [0, 0, 0]: a zero vector has no direction"}},
      {"orientation = [0, 0, 2]",
       "orientation = [0, 0, 0]",
       {"beams.bar.orientation = [0, 0, 0]: a zero vector has no direction"}},
  });
}

TEST(Messages, OfEmptyArrays) {
  expect_messages({
      {"fixed = [\"ux\", \"rz\"]",
       "fixed = []",
       {"restraints.ends.fixed = []: the array is empty; give \"all\" or an array of \"ux\""}},
      {"damping = [0.01, 0.02]", "damping = []", {"modes.damping = []: the array is empty"}},
      {"nodes = [\"apex\", \"foot\"]",
       "nodes = []",
       {"output.nodes = []: the array is empty; give an array of group names, or leave the key out"}},
      {"table = [[0, 1], [1, 1], [1, 2.5]]",
       "table = []",
       {"loads.foot.table = []: the array is empty; give an array of rows [t, value]"}},
      {"arm = [0, 0.1, -0.1]", "arm = []", {"masses.apex.arm = []: the array is empty"}},
      {"title = \"U-bend\"", "springs = []", {"not valid TOML"}, "[[springs]]"},
  });
  EXPECT_EQ(message_of("contacts = []\n[mesh]\nfile = \"a.msh\"\n"),
            "study.toml:1: contacts = []: the array is empty; give an array of tables [[contacts]], or leave "
            "the key out where it is optional");
}

TEST(Messages, OfTablesInTime) {
  const std::string table = "table = [[0, 1], [1, 1], [1, 2.5]]";
  expect_messages({
      {table,
       "table = [[1, 1], [0, 1]]",
       {"loads.foot.table[1] = [0, 1]: the time decreases; sort the rows by time"}},
      {table,
       "table = [[1, 1], [1, 2], [1, 3]]",
       {"loads.foot.table[2] = [1, 3]: a third row at the same time"}},
      {table, "table = [1, 2]", {"loads.foot.table[0] = 1: an array of numbers (2 in N m) is expected"}},
      {table,
       "table = [[1, 2, 3]]",
       {"loads.foot.table[0] = [1, 2, 3]: an array of numbers (2 in N m) is expected, not of 3"}},
      {table,
       "table = \"none.csv\"",
       {"loads.foot.table = \"none.csv\": file none.csv does not exist or cannot be read; paths start from "
        "the folder of the study"}},
      {table,
       "table = \"study.toml\"",
       {"loads.foot.table = \"study.toml\": study.toml:1: ", "a row is two finite numbers, t,value"}},
      {table, "table = \"\"", {"loads.foot.table = \"\": the string is empty"}},
  });
}

TEST(Messages, ShowOnlyTheBeginningOfALongValue) {
  const std::string message =
      message_of("[mesh]\nfile = \"a.msh\"\nscale = \"" + std::string(500, 'x') + "\"\n");
  EXPECT_EQ(message, "study.toml:3: mesh.scale = \"" + std::string(59, 'x') +
                         "...: a number > 0 is expected, not a string");
}

} // namespace
} // namespace fretwork::study
