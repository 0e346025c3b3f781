#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Style: formatting (clang-format 14), licence headers, the words and includes that may not be there. --fix formats.
set -euo pipefail
cd "$(dirname "$0")/.."
sources=$(git ls-files '*.cpp' '*.hpp')
if [ "${1:-}" = --fix ]; then
  clang-format -i $sources
else
  clang-format --dry-run -Werror $sources
fi
fail=0
for file in $(git ls-files '*.cpp' '*.hpp' '*.py' '*.sh' '*.cmake' '*CMakeLists.txt'); do
  head -n 3 "$file" | grep -q 'SPDX-License-Identifier: GPL-3.0-or-later' || { echo "$file: no SPDX licence header" >&2; fail=1; }
done
outside() { # $1: what, $2: pattern of includes, $3: files allowed
  local found
  found=$(git grep -lE "$2" -- '*.cpp' '*.hpp' | grep -vE "$3" || true)
  [ -z "$found" ] || { echo "$1 outside its files: $found" >&2; fail=1; }
}
outside "MPI, PETSc or SLEPc" '#include <(mpi|petsc|slepc)' '^(core/(mpi|petsc)|fem/petsc|modal/slepc|app/|tests/|bench/)'
outside "gmsh" '#include <gmsh' '^(mesh/gmsh|tests/)'
outside "HDF5" '#include <hdf5' '^(results/|tests/)'
exit $fail
