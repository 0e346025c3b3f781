#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# clang-tidy 14 over our own sources, or those that are given: tools/tidy.sh [FILE ...]. The commands are those of a release build of one source
# at a time without precompiled headers, which clang cannot read from g++.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset release -B build/tidy -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DFRETWORK_UNITY=OFF \
  -DFRETWORK_TESTS=OFF -DFRETWORK_BENCH=OFF >/dev/null
files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(git ls-files '*.cpp' | grep -vE '^(tests|bench|doc|examples)/')
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet
