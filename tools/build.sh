#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds a preset (default: release) in build/<preset>: tools/build.sh [PRESET [TARGET ...]].
# Without targets the program and its tests; with targets these alone, and where nothing was configured before, tests and benchmarks are
# left out (their packages are then not needed). Benchmarks: the target benchmarks, once all has been built. Ninja's counter shows how far the build is.
# Where CI=true warnings are errors.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
targets=("${@:2}")
options=(-DFRETWORK_TESTS=ON -DFRETWORK_BENCH=ON)
if [ ${#targets[@]} -gt 0 ]; then
  options=()
  [ -e "build/$preset/CMakeCache.txt" ] || options=(-DFRETWORK_TESTS=OFF -DFRETWORK_BENCH=OFF)
fi
[ "${CI:-}" != true ] || options+=(-DFRETWORK_WARNINGS_AS_ERRORS=ON)
cmake --preset "$preset" "${options[@]}" >/dev/null
export NINJA_STATUS="[%f/%t, %es] "
cmake --build --preset "$preset" ${targets:+--target "${targets[@]}"}
