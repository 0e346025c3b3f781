// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the programs that start MPI jobs put in the environment of each process: for what is decided before MPI is initialised.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::core {

/// Value of a variable of the environment; null: it is not set.
using Environment = std::function<const char*(const char* name)>;

/// Rank of this process in the MPI job that a launcher started; empty: no launcher has, or its value is no number.
/// Slurm is known by the variables of its MPI plug-ins. SLURM_PROCID alone is no rank: batch scripts have it, and processes that srun
/// starts with --mpi=none do not know each other.
[[nodiscard]] std::optional<int> launched_rank(const Environment& environment);
/// In this process.
[[nodiscard]] std::optional<int> launched_rank();

/// The environment of this process (`NAME=value`) without what mpirun, srun and other launchers put there: for a program that is to start
/// MPI for itself alone.
[[nodiscard]] std::vector<std::string> environment_without_launcher();

} // namespace fretwork::core
