#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The pictures of reports in README.md and the manual, anew, from runs of the examples in a headless Chromium: tools/screenshots.sh [FRETWORK].
# Needs the packages chromium and python3-pil of Debian; look at the pictures before they are committed.
set -euo pipefail
cd "$(dirname "$0")/.."
fretwork=${1:-build/release/bin/fretwork}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for example in tube_study u_bend_flow; do
  "$fretwork" run "examples/$example/study.toml" -o "$work/$example" | tail -n 1
done
draw() { /usr/bin/python3 -B "doc/pictures/$1" "${@:2}"; }
draw draw_live_report.py "$work/tube_study/report.html" chromium doc/pictures
draw draw_report.py "$work/tube_study/report.html" chromium doc/tube_study.png 1055 "Along the tube" Orbits
draw draw_report.py "$work/u_bend_flow/report.html" chromium doc/pictures/u_bend_flow_stability.png 755 "Fluid-elastic stability"
ls -l doc/tube_study.png doc/pictures/report_*.png doc/pictures/u_bend_flow_stability.png
