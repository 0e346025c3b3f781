// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The stages before the transient. A stage keeps its product in the results folder with a key, the hash of
/// all that it was computed from; a stage whose key has not changed is read, not computed again.
#pragma once
#include "app/build_model.hpp"
#include "modal/basis.hpp"
#include "results/run_results.hpp"
#include <filesystem>
#include <mpi.h>

namespace fretwork::app {

/// What the user asked for on the command line.
struct Request {
  std::filesystem::path study;
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> directory; ///< default: the study's name with .results, beside it
  std::optional<std::filesystem::path> scratch;   ///< takes the files of a check in place of `directory`
  bool force = false;                             ///< compute every stage again
  bool report = true;
  bool quiet = false; ///< nothing on the terminal but errors
};

/// The study and what identifies its inputs.
struct Inputs {
  study::Study study;
  std::filesystem::path run_directory; ///< of the results of `run`
  std::filesystem::path directory;     ///< the same, or request.scratch
  std::filesystem::path mesh_file;     ///< the .msh that is read
  bool keeps_run = false;              ///< the folder holds a run that this command is not to replace
  std::string modes_key;               ///< hash of the mesh and of all that the modes depend on
  std::string whole_key;               ///< and of everything else: input_sha256
};

/// The study; keys not yet made.
/// @throws core::Error if the study, its mesh file or a table cannot be read
[[nodiscard]] Inputs read_inputs(const Request& request);

/// @throws core::Error where the folder holds a run that stays
void refuse_to_replace_run(const Inputs& inputs);

/// @throws core::Error if it cannot be made
void make_directory(const std::filesystem::path& directory);

/// Collective. Rank 0 turns a geometry or a foreign format into DIR/mesh.msh: every time, because such files may include others (it takes
/// a tenth of a second).
void make_mesh_file(MPI_Comm comm, Inputs& inputs);

/// What make_mesh_file has made is the mesh file.
void use_made_mesh(Inputs& inputs);

/// The keys, from the mesh as it is read and the study without its comments and formatting.
void make_keys(const Request& request, Inputs& inputs);

/// Collective. The mesh.
[[nodiscard]] mesh::LineMesh mesh_stage(MPI_Comm comm, const Inputs& inputs);

/// The structures of a model that have something to solve.
/// @throws core::Error where nothing can move, or a dof has neither mass nor restraint
[[nodiscard]] std::vector<fem::Structure> moving_structures(const fem::Model& model);

struct ModesStage {
  std::vector<fem::Structure> structures;
  std::vector<modal::Basis> bases; ///< by structure, the same bytes on every rank
  std::size_t different = 0;       ///< structures that are no copy of another: so many are solved
  std::vector<std::string> warnings, notes;
  bool computed = false; ///< false: read from DIR/modes.h5
};

/// Collective. The modes of every structure, computed, with the damping that the study gives in ratios.
/// @throws core::Error for a structure without a mode
[[nodiscard]] std::vector<modal::Basis> compute_modes(MPI_Comm comm, const study::Modes& modes,
                                                      const fem::Model& model,
                                                      const std::vector<fem::Structure>& structures);

/// Collective. The modes of every structure (modal/slepc_structures.hpp), their damping as the study says.
[[nodiscard]] ModesStage modes_stage(MPI_Comm comm, const Inputs& inputs, const fem::Model& model,
                                     const results::RunRecord& record, bool force);

} // namespace fretwork::app
