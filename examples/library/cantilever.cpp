// SPDX-License-Identifier: GPL-3.0-or-later
// The study examples/cantilever_stop by the libraries: a mesh file, the modes in one plane, and a transient in which the tip meets a stop.
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "mesh/read.hpp"
#include "modal/slepc_modes.hpp"
#include "transient/run.hpp"
#include <algorithm>
#include <cstdio>
#include <numbers>

using namespace fretwork;

struct PeakForce : transient::Observer {
  double value = 0.0; // N
  void step(const transient::Record& record) override { value = std::max(value, record.states[0].peak); }
  void visit(core::StateArchive& state) override { state(value); }
};

int main(int argc, char** argv) try {
  if (argc != 2)
    throw core::Error("the mesh is missing: cantilever beam.msh");
  const core::MpiSession mpi(argc, argv);
  const core::PetscSession petsc(MPI_COMM_WORLD);
  const mesh::LineMesh mesh = mesh::read({.file = argv[1]});

  fem::Model model;
  model.nodes = mesh.nodes;
  model.properties = {{.material = {1e10, 0.3, 1e6}, .section = fem::circle_section(0.2)}}; // Pa, -, kg/m3; m
  for (const mesh::Line& line : mesh.lines)
    model.beams.push_back({line.nodes[0], line.nodes[1], 0});
  model.fixed.assign(mesh.nodes.size(), 0b011101); // all but uy and rz
  model.fixed[mesh::group_nodes(mesh, "foot", "foot")[0]] = 0b111111;
  const modal::Basis basis =
      modal::solve_modes(MPI_COMM_SELF, model, fem::structures(model)[0], {.count = 5});

  const Eigen::MatrixXd tip =
      basis.shapes.middleRows<3>(basis.row_of(mesh::group_nodes(mesh, "tip", "tip")[0]));
  transient::Scene scene;
  scene.system = {basis.omega.cwiseAbs2(), Eigen::VectorXd::Zero(5), {}};
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(5);
  scene.duration = 0.16;                                                                     // s
  scene.loads = {{signals::Constant{1.0}, tip.transpose() * core::Vec3(0.0, -1000.0, 0.0)}}; // N
  scene.contacts = {{"stop",
                     {contact::Circle{1e-4}, {.stiffness = 1e8}, {}},
                     core::Vec3::Zero(),
                     tip}}; // m, N/m; local axes = global axes
  PeakForce peak;
  transient::Observer* const observers[] = {&peak};
  const auto report = transient::run(scene, transient::choose_step(scene, {}), observers, nullptr,
                                     transient::output_grid(scene.duration, 1e-3));

  std::printf("frequency %.10g Hz\npeak_force %.10g N\nbalance %.2g\n",
              basis.omega(0) / (2.0 * std::numbers::pi), peak.value, report.residual_relative);
  return report.outcome == transient::Outcome::done ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "cantilever: %s\n", error.what());
  return 1;
}
