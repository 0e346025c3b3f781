// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of one large frame or of a bundle of U-tubes, once, alone or under mpirun: prints one line of JSON.
// bench_structures frame DOFS MODES | tubes COUNT MODES | copies COUNT MODES, and distributed: each over all ranks
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "fem/section.hpp"
#include "modal/slepc_structures.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <sys/resource.h>

namespace {

using namespace fretwork;
using core::Index;
using core::Vec3;

constexpr std::uint8_t clamped = 0b111111;

Index add_node(fem::Model& model, const Vec3& place, std::uint8_t fixed = 0) {
  model.nodes.push_back(place);
  model.fixed.push_back(fixed);
  return static_cast<Index>(model.nodes.size() - 1);
}

fem::BeamProperty tube() { return {{2e11, 0.3, 8000.0}, fem::pipe_section(0.01905, 0.00109)}; }

/// A U-tube of 220 elements: legs of 9 m, held across each metre, clamped in the tube sheet.
void add_u_tube(fem::Model& model, double radius, double y) {
  constexpr int per_metre = 10, metres = 9, bend = 40, legs = per_metre * metres;
  const auto place = [&](int i) {
    if (i <= legs)
      return Vec3(-radius, y, static_cast<double>(i) / per_metre);
    if (i >= legs + bend)
      return Vec3(radius, y, static_cast<double>(2 * legs + bend - i) / per_metre);
    const double angle = std::numbers::pi * (i - legs) / bend;
    return Vec3(-radius * std::cos(angle), y, metres + radius * std::sin(angle));
  };
  const auto held = [&](int i) -> std::uint8_t {
    const int on_leg = std::min(i, 2 * legs + bend - i);
    return on_leg == 0 ? clamped : on_leg <= legs && on_leg % per_metre == 0 ? 0b000011 : 0;
  };
  for (int i = 0; i <= 2 * legs + bend; ++i) {
    const Index node = add_node(model, place(i), held(i));
    if (i > 0)
      model.beams.push_back({node - 1, node, 0});
  }
}

fem::Model bundle(int tubes, bool equal) {
  fem::Model model;
  model.properties.push_back(tube());
  for (int i = 0; i < tubes; ++i)
    add_u_tube(model, equal ? 0.5 : 0.3 + 1.2 * i / tubes, 0.03 * i);
  return model;
}

/// A flat square grid of beams, about 6 n^2 dofs, clamped along one side.
fem::Model frame(double dofs) {
  fem::Model model;
  model.properties.push_back(tube());
  const auto n = static_cast<int>(std::lround(std::sqrt(dofs / 6.0)));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Index node = add_node(model, {0.1 * i, 0.1 * j, 0.01 * ((i * j) % 3)}, j == 0 ? clamped : 0);
      if (j > 0)
        model.beams.push_back({node - 1, node, 0});
      if (i > 0)
        model.beams.push_back({node - n, node, 0});
    }
  return model;
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec) +
         static_cast<double>(usage.ru_stime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_stime.tv_usec);
}

void run(const std::string& kind, double size, int modes, std::optional<bool> distributed) {
  const fem::Model model = kind == "frame" ? frame(size) : bundle(static_cast<int>(size), kind == "copies");
  const auto structures = fem::structures(model);
  Index dofs = 0;
  for (const fem::Structure& structure : structures)
    dofs += structure.equations;
  MPI_Barrier(MPI_COMM_WORLD);
  const double cpu = cpu_seconds();
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<modal::Basis> bases =
      modal::solve_structures(MPI_COMM_WORLD, model, structures, {modes, std::nullopt}, distributed);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double residual = 0.0;
  for (const modal::Basis& basis : bases)
    residual = std::max(residual, basis.residuals.maxCoeff());
  if (core::rank(MPI_COMM_WORLD) == 0)
    std::printf("{\"kind\": \"%s\", \"ranks\": %d, \"dofs\": %d, \"structures\": %zu, "
                "\"modes\": %d, \"seconds\": %.4g, \"cpu_seconds\": %.4g, \"peak_mb\": %.0f, "
                "\"residual\": %.2g, \"first_hz\": %.12g}\n",
                kind.c_str(), core::size(MPI_COMM_WORLD), dofs, structures.size(), modes, seconds,
                cpu_seconds() - cpu, static_cast<double>(usage.ru_maxrss) / 1024.0, residual,
                bases.front().omega[0] / (2.0 * std::numbers::pi));
}

} // namespace

int main(int argc, char** argv) {
  const core::MpiSession mpi(argc, argv);
  const core::PetscSession petsc(MPI_COMM_WORLD);
  if (argc < 4 || argc > 5) {
    std::fprintf(
        stderr, "bench_structures frame DOFS MODES | tubes COUNT MODES | copies COUNT MODES [distributed]\n");
    return 1;
  }
  run(argv[1], std::stod(argv[2]), std::stoi(argv[3]), argc == 5 ? std::optional(true) : std::nullopt);
}
