// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stages.hpp"
#include "app/other_runs.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "modal/copies.hpp"
#include "modal/damping.hpp"
#include "modal/slepc_structures.hpp"
#include "modal/spans.hpp"
#include "results/whole_file.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <numbers>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

/// Nothing of what is no regular file: a pipe may have no end.
std::string file_bytes(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Of the stored modes: a limit that follows from the contacts is theirs too; a distributed structure differs in its last digits with the number of ranks.
std::string stored_key(MPI_Comm comm, const Inputs& inputs, const std::vector<fem::Structure>& structures) {
  const bool distributed =
      std::any_of(structures.begin(), structures.end(), [&](const fem::Structure& structure) {
        return modal::is_distributed(comm, structure, inputs.study.modes.distributed);
      });
  const study::Modes& modes = inputs.study.modes;
  return inputs.modes_key + (modes.accuracy ? fmt::format(" up to {:.17g} Hz", *modes.up_to_hz) : "") +
         (distributed ? fmt::format(" over {} ranks", core::size(comm)) : "");
}

} // namespace

Inputs read_inputs(const Request& request) {
  Inputs in;
  in.study = study::read(request.study, request.overrides);
  in.run_directory = request.directory.value_or(fs::path(in.study.file).replace_extension(".results"));
  in.directory = request.scratch.value_or(in.run_directory);
  in.mesh_file = in.study.mesh.file;
  core::check_input_file(in.mesh_file, fmt::format("mesh file \"{}\"", in.mesh_file.string()));
  if (!std::ifstream(in.mesh_file))
    throw core::Error(fmt::format(
        "mesh file \"{}\" cannot be read; check the path (relative paths start from the study's folder)",
        in.mesh_file.string()));
  return in;
}

void make_directory(const fs::path& directory) {
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (failure)
    throw core::Error(fmt::format("the results folder \"{}\" cannot be made ({}); give another with -o",
                                  directory.string(), failure.message()));
}

void refuse_to_replace_run(const Inputs& inputs) {
  if (inputs.keeps_run)
    throw core::Error(
        fmt::format("{} holds the results of a run that is not of this study as it stands (or of another "
                    "version, or damaged); give another folder with -o, or --force to replace it",
                    inputs.directory.string()));
}

void use_made_mesh(Inputs& inputs) {
  if (!mesh::is_msh(inputs.study.mesh.file))
    inputs.mesh_file = inputs.directory / "mesh.msh";
}

void make_mesh_file(MPI_Comm comm, Inputs& inputs) {
  if (mesh::is_msh(inputs.study.mesh.file))
    return;
  use_made_mesh(inputs);
  core::agree(comm, [&] {
    if (core::rank(comm) != 0)
      return;
    const std::string fresh = mesh::as_msh(inputs.study.mesh);
    if (fresh == file_bytes(inputs.mesh_file)) // nothing has changed: the file keeps its date
      return;
    refuse_to_replace_run(inputs);
    results::write_whole(inputs.mesh_file, {fresh});
  });
}

void make_keys(const Request& request, Inputs& inputs) {
  const auto text = [&](const std::vector<std::string>& tables) {
    return study::canonical_text(request.study, request.overrides, tables);
  };
  const std::string program = fmt::format("{} layout {}\n", FRETWORK_VERSION, results::file_layout);
  inputs.modes_key = core::sha256(program + file_bytes(inputs.mesh_file) +
                                  text({"mesh", "materials", "sections", "beams", "restraints", "masses",
                                        "springs", "ties", "modes", "flow"}));
  inputs.whole_key = core::sha256(
      inputs.modes_key +
      text({"title", "contacts", "flow_laws", "stability", "turbulence", "response", "loads", "gravity",
            "base_motion", "support_motion", "initial", "transient", "output", "wear", "gap_opening"}) +
      text_of(read_other_runs(inputs.study, inputs.run_directory)));
}

mesh::LineMesh mesh_stage(MPI_Comm comm, const Inputs& inputs) {
  mesh::Source source = inputs.study.mesh;
  if (source.file != inputs.mesh_file)
    source.element_size.reset(); // it has been obeyed
  source.file = inputs.mesh_file;
  mesh::LineMesh mesh;
  core::agree(comm, [&] { mesh = mesh::read(source); });
  return mesh;
}

std::vector<fem::Structure> moving_structures(const fem::Model& model) {
  std::vector<fem::Structure> structures = fem::structures(model);
  // marks and fully restrained points are structures without equations: there is nothing to solve
  std::erase_if(structures, [](const fem::Structure& s) { return s.equations == 0; });
  if (structures.empty())
    throw core::Error("nothing in the model can move: every degree of freedom is restrained; release some in "
                      "[[restraints]]");
  return structures;
}

namespace {

/// @throws core::Error that says where the lowest mode of a structure is which has none up to the limit
[[noreturn]] void refuse_without_modes(const study::Modes& modes, const fem::Model& model,
                                       const fem::Structure& structure) {
  const std::string which = "structure that starts at node " +
                            fem::place(model.nodes[static_cast<std::size_t>(structure.nodes.front())]);
  const modal::Basis lowest =
      modal::solve_modes(MPI_COMM_SELF, model, structure, {.count = 1, .up_to_hz = std::nullopt});
  if (lowest.size() == 0)
    throw core::Error("the " + which +
                      " has no mode: nothing that moves has mass; give its material a density, or it a "
                      "[[masses]] entry");
  const std::string limit = modes.accuracy
                                ? fmt::format("{:.4g} Hz, as far as modes.accuracy = {:g} asks for",
                                              *modes.up_to_hz, *modes.accuracy)
                                : fmt::format("modes.up_to_hz = {:g}", *modes.up_to_hz);
  throw core::Error(
      fmt::format("the {} has no mode up to {}: its lowest is at {:.6g} Hz; {}, or, where it may "
                  "count as rigid, hold it by [[restraints]] with fixed = \"all\"",
                  which, limit, lowest.omega(0) / (2.0 * std::numbers::pi),
                  modes.accuracy ? "give modes.up_to_hz or modes.count" : "give a higher limit"));
}

} // namespace

std::vector<modal::Basis> compute_modes(MPI_Comm comm, const study::Modes& modes, const fem::Model& model,
                                        const std::vector<fem::Structure>& structures) {
  std::vector<modal::Basis> bases = modal::solve_structures(
      comm, model, structures,
      {.count = modes.count, .up_to_hz = modes.up_to_hz, .whole_groups = !modes.number_given},
      modes.distributed);
  core::agree(comm, [&] {
    for (std::size_t s = 0; s < bases.size(); ++s) {
      modal::apply_damping(bases[s], modes.damping);
      if (bases[s].size() == 0)
        refuse_without_modes(modes, model, structures[s]);
    }
  });
  return bases;
}

ModesStage modes_stage(MPI_Comm comm, const Inputs& inputs, const fem::Model& model,
                       const results::RunRecord& record, bool force) {
  ModesStage out;
  core::agree(comm, [&] {
    out.structures = moving_structures(model);
    out.warnings = modal::check_spans(model, out.structures);
  });
  const std::vector<std::size_t> original = modal::originals(model, out.structures);
  for (std::size_t s = 0; s < original.size(); ++s)
    out.different += original[s] == s ? 1 : 0;
  const std::string key = stored_key(comm, inputs, out.structures);
  const fs::path file = inputs.directory / "modes.h5";
  std::optional<std::vector<modal::Basis>> stored;
  if (!force) {
    results::FoundBases read = results::read_bases(file, key);
    stored = std::move(read.bases);
    if (!read.refusal.empty())
      out.notes.push_back(read.refusal);
  }
  int here_found = stored && stored->size() == out.structures.size() ? 1 : 0, found = 0;
  MPI_Allreduce(&here_found, &found, 1, MPI_INT, MPI_MIN, comm); // every rank reads it, or none
  if (found) {
    out.bases = std::move(*stored);
    return out;
  }
  out.computed = true;
  out.bases = compute_modes(comm, inputs.study.modes, model, out.structures);
  core::agree(comm, [&] {
    if (core::rank(comm) == 0)
      results::write_bases(file, record, out.bases, key);
  });
  return out;
}

} // namespace fretwork::app
