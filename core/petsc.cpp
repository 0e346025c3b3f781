// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/petsc.hpp"
#include "core/error.hpp"
#include <cstdlib>
#include <string>

namespace fretwork::core {

PetscSession::PetscSession(MPI_Comm comm) : begun_(!SlepcInitializeCalled) {
  if (!begun_)
    return;
  // PETSc would take options, programs to start and files to write among them, from .petscrc of the current folder and from the environment
  for (const char* source : {"PETSC_OPTIONS", "PETSC_OPTIONS_YAML"})
    (void)unsetenv(source);
  char name[] = "fretwork", isolated[] = "-skip_petscrc";
  char* words[] = {name, isolated, nullptr};
  int count = 2;
  PETSC_COMM_WORLD = comm;
  char** arguments = words;
  FW_PETSC(SlepcInitialize(&count, &arguments, nullptr, nullptr));
  FW_PETSC(PetscPopSignalHandler()); // a crash is ours to report, and Ctrl-C ours to take
  FW_PETSC(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr)); // one message, ours
}

PetscSession::~PetscSession() {
  if (begun_)
    SlepcFinalize();
}

void check_petsc(PetscErrorCode code, const char* call, const char* file, int line) {
  if (code == 0)
    return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  std::string name(file);
  if (const auto slash = name.rfind('/'); slash != std::string::npos)
    name.erase(0, slash + 1);
  throw ComputationError("PETSc: " + std::string(text ? text : "error") + " (code " + std::to_string(code) +
                         ") in " + call + ", " + name + ":" + std::to_string(line));
}

} // namespace fretwork::core
