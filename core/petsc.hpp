// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// PETSc and SLEPc: their owner and the one check of their return codes.
#pragma once
#include <slepcsys.h>

#if defined(PETSC_USE_COMPLEX)
#error "Fretwork needs the real build of PETSc and SLEPc (libslepc-real-dev)"
#endif

namespace fretwork::core {

/// SlepcInitialize (and so PetscInitialize) on all processes of `comm` for the life of the object, or of the session around it; MPI must be
/// running. Neither a .petscrc file nor PETSC_OPTIONS is read: nothing but the study says what is computed.
class PetscSession {
public:
  explicit PetscSession(MPI_Comm comm);
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

private:
  bool begun_; ///< here, not by a session around this one
};

/// Throws core::ComputationError with PETSc's text for the code, the call, the file and the line.
void check_petsc(PetscErrorCode code, const char* call, const char* file, int line);

} // namespace fretwork::core

/// FW_PETSC(call): run a PETSc or SLEPc call, throw when it fails.
#define FW_PETSC(call) ::fretwork::core::check_petsc((call), #call, __FILE__, __LINE__)
