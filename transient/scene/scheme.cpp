// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/scene/scheme.hpp"

namespace fretwork::transient {

std::string name_of(SchemeKind kind) {
  switch (kind) {
  case SchemeKind::splitting:
    return "splitting";
  case SchemeKind::collocation:
    return "collocation";
  case SchemeKind::euler:
    return "euler";
  case SchemeKind::energy_conserving:
    return "energy_conserving";
  case SchemeKind::devogelaere:
    return "devogelaere";
  case SchemeKind::runge_kutta_54:
    return "runge_kutta_54";
  }
  return {};
}

std::string name_of(StepFailure failure) {
  switch (failure) {
  case StepFailure::none:
    return "no failure";
  case StepFailure::tolerance:
    return "no step that the time can resolve meets the tolerance; give a larger tolerance, or take another "
           "scheme";
  case StepFailure::contacts:
    return "the equations of the contacts were not solved, however small the step; take another scheme";
  }
  return {};
}

} // namespace fretwork::transient
