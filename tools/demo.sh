#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The main job on a fresh Debian 12 machine: installs what is missing, builds, and runs a steam generator tube from its geometry and
# its flow to its years, with summary and report.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install_packages.sh
tools/build.sh release
build/release/bin/fretwork run examples/tube_study/study.toml "$@"
