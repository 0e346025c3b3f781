// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpi.hpp"
#include "core/error.hpp"
#include "core/launcher.hpp"
#include <cstdint>
#include <cstdlib>

namespace fretwork::core {

void set_mpi_defaults() {
  setenv("OMP_NUM_THREADS", "1", 0);
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self,vader,tcp", 0);
  if (!launched_rank()) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    // isolated processes would all use one folder below the temporary one, and the first to end removes it
    // under the others
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
}

MpiSession::MpiSession(int& argc, char**& argv) {
  int running = 0;
  MPI_Initialized(&running);
  if (running)
    return;
  set_mpi_defaults();
  MPI_Init(&argc, &argv);
  owner_ = true;
}

MpiSession::~MpiSession() {
  if (owner_)
    MPI_Finalize();
}

bool is_first_process() {
  int running = 0, ended = 0;
  MPI_Initialized(&running);
  MPI_Finalized(&ended);
  return running && !ended ? rank(MPI_COMM_WORLD) == 0 : launched_rank().value_or(0) == 0;
}

int rank(MPI_Comm comm) {
  int value = 0;
  MPI_Comm_rank(comm, &value);
  return value;
}

int size(MPI_Comm comm) {
  int value = 1;
  MPI_Comm_size(comm, &value);
  return value;
}

void broadcast(MPI_Comm comm, int root, std::string& text) {
  auto length = static_cast<std::uint64_t>(text.size());
  MPI_Bcast(&length, 1, MPI_UINT64_T, root, comm);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root, comm);
}

void broadcast(MPI_Comm comm, int root, Eigen::MatrixXd& values) {
  std::int64_t shape[2] = {values.rows(), values.cols()};
  MPI_Bcast(shape, 2, MPI_INT64_T, root, comm);
  values.resize(shape[0], shape[1]);
  for (Eigen::Index j = 0; j < values.cols(); ++j) // a column at a time: counts stay within an int
    MPI_Bcast(values.col(j).data(), static_cast<int>(values.rows()), MPI_DOUBLE, root, comm);
}

void broadcast(MPI_Comm comm, int root, Eigen::VectorXd& values) {
  std::int64_t length = values.size();
  MPI_Bcast(&length, 1, MPI_INT64_T, root, comm);
  values.resize(length);
  MPI_Bcast(values.data(), static_cast<int>(length), MPI_DOUBLE, root, comm);
}

void agree(MPI_Comm comm, const std::function<void()>& work) {
  enum Kind : int { fine = 0, input = 1, computation = 2, interrupted = 3, other = 4 };
  int kind = fine;
  std::string message;
  try {
    work();
  } catch (const Error& e) {
    kind = input;
    message = e.what();
  } catch (const Interrupted& e) {
    kind = interrupted;
    message = e.what();
  } catch (const ComputationError& e) {
    kind = computation;
    message = e.what();
  } catch (const std::exception& e) {
    kind = other;
    message = e.what();
  }
  const int here = kind == fine ? size(comm) : rank(comm);
  int first = here;
  MPI_Allreduce(&here, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size(comm))
    return;
  MPI_Bcast(&kind, 1, MPI_INT, first, comm);
  broadcast(comm, first, message);
  if (kind == input)
    throw Error(message);
  if (kind == computation)
    throw ComputationError(message);
  if (kind == interrupted)
    throw Interrupted(message);
  throw std::runtime_error(message);
}

} // namespace fretwork::core
