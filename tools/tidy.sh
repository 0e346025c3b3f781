#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# clang-tidy 14 over our own sources, with the commands of the release build.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
git ls-files '*.cpp' | grep -vE '^(tests|bench)/' | xargs -P "$(nproc)" -n 1 clang-tidy -p build/release --quiet
