#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The main job on a fresh Debian 12 machine: installs what the program needs, builds the program alone, and runs a steam generator tube from its
# geometry and its flow to its years, with summary and report.
set -euo pipefail
cd "$(dirname "$0")/.."
study=examples/tube_study/study.toml
echo "1 of 3: packages of Debian that are missing (a minute or two where none is there)"
tools/install_packages.sh
echo "2 of 3: the program (two to three minutes on two cores; [steps done/steps, seconds])"
tools/build.sh release fretwork
echo "3 of 3: $study, some seconds"
build/release/bin/fretwork run "$study" "$@"
results=${study%.toml}.results
echo
echo "Look at the report with a browser:  xdg-open $PWD/$results/report.html"
echo "All figures, for scripts:           $results/summary.json"
