#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The long form of what the tests do shortly; prints the tables of doc/reliability.md: tests/faults/run_long.sh [SECONDS_OF_FUZZING [PART ...]].
# Parts: faults (every call, six kinds of faults, 1 000 damaged files of each kind, 50 kills), surroundings, grid (2 000 cells), mutations (300 studies that `check` and `run` agree on), compilers
# (g++ against clang), sanitizers (all tests), fuzzing (by default an hour for each reader). Some ten hours on two cores.
# Every part runs, whatever the others found; the status is 1 where one of them found something.
set -uo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-3600}
parts=("${@:2}")
[ ${#parts[@]} -gt 0 ] || parts=(faults surroundings grid mutations compilers sanitizers fuzzing)
program=$PWD/build/release/bin/fretwork
python=${FRETWORK_PYTHON:-/usr/bin/python3}
study=examples/straight_tube/study.toml

# The content of damaged files is that of the example that runs fastest: what is tried is that damage is found.
faults() {
  local library
  library=$(find "$PWD/build/release" -name 'libfailing_calls.so')
  "$python" -B tests/faults/faults_test.py "$program" "$library" $study --long --parts runs sweeps kills
  local found=$?
  "$python" -B tests/faults/faults_test.py "$program" "$library" examples/oscillator/study.toml --long --parts files checkpoints && return $found
}
surroundings() { "$python" -B tests/faults/surroundings_test.py "$program" $study mpirun; }
grid() { "$python" -B tests/faults/grid_test.py "$program" --cells 2000 --keep build/faults; }
mutations() { "$python" -B tests/faults/mutations_test.py "$program" examples --studies 300 --keep build/faults; }
compilers() {
  cmake -B build/clang -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 \
    -DFRETWORK_TESTS=OFF -DFRETWORK_BENCH=OFF >/dev/null && cmake --build build/clang --target fretwork >/dev/null &&
    "$python" -B tests/faults/golden_test.py "$program" examples --compare build/clang/bin/fretwork
}
sanitizers() { tests/sanitize.sh all; }
fuzzing() { tests/fuzz/run.sh "$seconds"; }

tools/build.sh release >/dev/null || exit 1
found=0
for part in "${parts[@]}"; do
  echo "== $part"
  "$part" || found=1
done
exit $found
