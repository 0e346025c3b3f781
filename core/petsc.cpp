// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/petsc.hpp"
#include "core/error.hpp"
#include <string>

namespace fretwork::core {

PetscSession::PetscSession() {
  FW_PETSC(SlepcInitializeNoArguments());
  FW_PETSC(PetscPopSignalHandler()); // a crash is ours to report, and Ctrl-C ours to take
  FW_PETSC(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr)); // one message, ours
}

PetscSession::~PetscSession() { SlepcFinalize(); }

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
