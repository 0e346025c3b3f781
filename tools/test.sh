#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# All tests on a fresh Debian 12 machine: installs what is missing, builds, tests.
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck disable=SC2046 # a word a package
tools/install_packages.sh $(grep -v '^#' tools/packages_of_tests.txt)
tools/build.sh release
ctest --preset release -j "$(nproc)" "$@"
