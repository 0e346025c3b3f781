// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The owner of MPI (and, through it, of PETSc and SLEPc), and what ranks do together.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <mpi.h>
#include <string>

namespace fretwork::core {

/// Settings that make a start fast and a run reproducible, made before MPI starts and never over a value the
/// user gave: the shared-memory transport without probing of network fabrics, no helper daemon for a run
/// without mpirun, one thread in BLAS.
void set_mpi_defaults();

/// MPI_Init for the life of the object (nothing where MPI is running already).
class MpiSession {
public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

private:
  bool owner_ = false;
};

/// Whether this process is the first of its MPI job, or the only one: by MPI while it is initialised, else by the launcher's environment.
[[nodiscard]] bool is_first_process();

[[nodiscard]] int rank(MPI_Comm comm);
[[nodiscard]] int size(MPI_Comm comm);

/// Collective. Runs `work` on this rank; if it threw on any rank, every rank throws what the lowest failing
/// rank threw (one of core/error.hpp, or std::runtime_error for anything else), so that no rank
/// waits for another.
void agree(MPI_Comm comm, const std::function<void()>& work);

/// Collective: the values of rank `root` on every rank, sizes included.
void broadcast(MPI_Comm comm, int root, std::string& text);
void broadcast(MPI_Comm comm, int root, Eigen::VectorXd& values);
void broadcast(MPI_Comm comm, int root, Eigen::MatrixXd& values);

} // namespace fretwork::core
