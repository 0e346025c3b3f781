// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the modes of one structure against its size: a clamped straight tube with a lateral support each
// metre.
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "fem/section.hpp"
#include "modal/slepc_modes.hpp"
#include <benchmark/benchmark.h>

namespace {

using namespace fretwork;

fem::Model supported_tube(int elements) {
  fem::Model model;
  model.properties.push_back({{2e11, 0.3, 8000.0}, fem::pipe_section(0.01905, 0.00109)});
  constexpr double length = 20.0;
  for (int i = 0; i <= elements; ++i)
    model.nodes.emplace_back(length * i / elements, 0.0, 0.0);
  for (int i = 0; i < elements; ++i)
    model.beams.push_back({i, i + 1, 0});
  model.fixed.assign(model.nodes.size(), 0);
  model.fixed.front() = model.fixed.back() = 0b111111;
  for (int metre = 1; metre < 20; ++metre)
    model.fixed[static_cast<std::size_t>(metre * elements / 20)] |= 0b000110;
  return model;
}

void modes_of_a_tube(benchmark::State& state) {
  const fem::Model model = supported_tube(static_cast<int>(state.range(0)));
  const auto structures = fem::structures(model);
  modal::Wanted wanted;
  wanted.count = static_cast<int>(state.range(1));
  double residual = 0.0;
  for (auto _ : state) {
    const modal::Basis basis = modal::solve_modes(MPI_COMM_SELF, model, structures.front(), wanted);
    residual = basis.residuals.maxCoeff();
  }
  state.counters["dofs"] = static_cast<double>(structures.front().equations);
  state.counters["residual"] = residual;
}

BENCHMARK(modes_of_a_tube)
    ->Args({200, 20})
    ->Args({200, 100})
    ->Args({1000, 20})
    ->Args({1000, 100})
    ->Args({1000, 300})
    ->Args({10000, 20})
    ->Unit(benchmark::kMillisecond);

} // namespace

int main(int argc, char** argv) {
  const core::MpiSession mpi(argc, argv);
  const core::PetscSession petsc(MPI_COMM_WORLD);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
