// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A temporary folder with a study file in it.
#pragma once
#include "core/error.hpp"
#include "study/study.hpp"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace fretwork::study {

class Folder {
public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "fretwork_study_XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

inline Study read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  return read(folder.write("study.toml", text), overrides);
}

/// The message of a study that must be refused, without the folder's name; empty where the study is accepted.
inline std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  const auto file = folder.write("study.toml", text);
  try {
    (void)read(file, overrides);
  } catch (const core::Error& error) {
    std::string message = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = 0; (at = message.find(prefix)) != std::string::npos;)
      message.erase(at, prefix.size());
    return message;
  }
  return {};
}

/// What an obstacle leaves to a node at its centre, m.
inline double gap_of(const Contact& contact) { return contact::locate(contact.shape, 0.0, 0.0).gap; }

inline std::string contact(const std::string& keys) {
  return "[mesh]\nfile = \"a.msh\"\n[[contacts]]\nname = \"c\"\ngroup = \"p\"\ngap = 0.1\nnormal_stiffness = "
         "1e6\n" +
         keys;
}

/// Every key of a study; the lines matter to no test.
inline const std::string full_study = R"(title = "U-bend"

[mesh]
file = "meshes/tube.geo"
element_size = 0.05
scale = 0.001
merge_tolerance = 1e-6

[materials.inconel]
young_modulus = 2e11
poisson_ratio = 0.3
density = 8200

[sections.tube]
shape = "pipe"
outer_diameter = 0.02
thickness = 0.001

[sections.bar]
shape = "rectangle"
height_y = 0.01
height_z = 0.02

[sections.rod]
shape = "circle"
diameter = 0.2

[sections.free]
shape = "general"
area = 1e-3
iy = 1e-8
iz = 2e-8
torsion_constant = 1e-9
polar_inertia = 4e-8

[[beams]]
group = "tube"
material = "inconel"
section = "tube"
added_mass = 0.3
added_mass_direction = "all"
fluid_inside = 750
fluid_outside = { density = 1000, confinement = 1.5 }

[[beams]]
group = "bar"
material = "inconel"
section = "bar"
orientation = [0, 0, 2]

[[restraints]]
group = "ends"
fixed = ["ux", "rz"]

[[restraints]]
group = "foot"
fixed = "all"

[[masses]]
group = "apex"
mass = 0.5
inertia = [1, 2, 3]
arm = [0, 0.1, -0.1]

[[springs]]
group = "apex"
other = "wall"
stiffness = [0, 1e4, 0, 0, 0, 6]
damping = [1, 2, 3, 4, 5, 6]

[[ties]]
group = "hinge"
other = "arm_end"
tied = ["ux", "rz"]

[modes]
count = 12
damping = [0.01, 0.02]
static_modes = "none"
distributed = true

[[contacts]]
name = "tsp1"
group = "point1"
obstacle = "plane_y"
gap = 2e-4
axis = [0, 0, 1]
y_axis = [1, 0, 0]
origin = [0.1, 0.2, 0.3]
offset = [1e-5, -2e-5]
normal_stiffness = 1e6
normal_damping = 10
tangential_stiffness = 2e6
tangential_damping = 3
friction = { static = 0.4, dynamic = 0.3 }
friction_memory = "reference"
attached_to = "base"

[[contacts]]
name = "tsp2"
group = "point2"
obstacle = "stop_z"
gap = 0
axis = [1, 0, 0]
angle = 30
normal_stiffness = 1e6
tangential_stiffness = 1e6
tangential_damping = "auto"
friction = 0.2

[[loads]]
group = "apex"
per_length = true
direction = [0, 3, 4]
harmonic = { amplitude = 10, frequency = 25, phase = 0.5 }

[[loads]]
group = "foot"
moment = true
direction = [0, 0, 1]
table = [[0, 1], [1, 1], [1, 2.5]]

[[loads]]
group = "bar"
direction = [1, 0, 0]
random = { rms = 5, band = [5, 200], seed = 7 }

[gravity]
acceleration = [0, 0, -9.81]

[[base_motion]]
direction = [0, 0, -2]
constant = 1.5

[[initial]]
group = "apex"
displacement = [0, 1e-3, 0]
velocity = [1, 2, 3]
rotation_rate = [0, 0, 3.8]
centre = [0, 0, 1]

[transient]
duration = 2
start = "rest"
scheme = "splitting"
accuracy = 0.02
step = 1e-5

[output]
every = 1e-4
nodes = ["apex", "foot"]
statistics_from = 0.2
impacts = 500
rest_time = 1e-3
checkpoint = 30

[[wear]]
contacts = "tsp*"
coefficient = 1e-14
length = 0.02
)";

} // namespace fretwork::study
