#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests with assertions under the address and undefined-behaviour sanitizers of clang, whose warnings are errors, in build/fuzz: the readers are
# fuzzed with the same objects (tests/fuzz/run.sh): tests/sanitize.sh [FOLDER ... | all], by default the units of all folders; `all`: every test.
# Left out: limits of memory, which sanitized children do not have, searches in 10 000 facets, and the installed libraries, which the system's
# compiler cannot link.
set -euo pipefail
cd "$(dirname "$0")/.."
folders=("$@")
[ ${#folders[@]} -gt 0 ] || folders=(core signals kernels vibration mesh fem modal flow contact wear transient post study results)
if [ "${folders[0]}" = all ]; then
  targets=(all)
  label=''
else
  targets=("${folders[@]/%/_tests}")
  label="^($(IFS='|'; echo "${folders[*]}"))_tests$"
fi
tools/install_packages.sh clang-14 libclang-rt-14-dev
cmake --preset fuzz >/dev/null
# Also of the build, which asks tests for their names; what leaks are MPI's and the libraries' own.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export NINJA_STATUS="[%f/%t, %es] "
cmake --build --preset fuzz --target "${targets[@]}"
ctest --test-dir build/fuzz -j "$(nproc)" --output-on-failure -L "$label" -E '^(FacetIndex|FacetCells|Memory|ChildProcess.LimitsMemory|prefix_of_installation)'
