#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The unit tests with assertions under the address and undefined-behaviour sanitizers of clang, whose warnings are errors, in build/fuzz: the
# readers are fuzzed with the same objects (tests/fuzz/run.sh): tests/sanitize.sh [FOLDER ...], by default all folders of units.
# Left out: what starts gmsh, for which the confined child's limit of memory leaves the sanitizers no room, and searches in 10 000 facets.
set -euo pipefail
cd "$(dirname "$0")/.."
folders=("$@")
[ ${#folders[@]} -gt 0 ] || folders=(core mesh fem modal flow contact wear transient post study results)
tools/install_packages.sh clang-14 libclang-rt-14-dev
cmake --preset fuzz >/dev/null
export NINJA_STATUS="[%f/%t, %es] "
cmake --build --preset fuzz --target "${folders[@]/%/_tests}"
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
ctest --test-dir build/fuzz -j "$(nproc)" --output-on-failure --timeout 600 \
  -L "^($(IFS='|'; echo "${folders[*]}"))_tests$" -E '^(Geometry|Conversion|FacetIndex|FacetCells|Memory)'
