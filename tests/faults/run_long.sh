#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The long form of the fault injection, on the release build: prints a table as in doc/reliability.md.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/release}
exec python3 tests/faults/faults_test.py "$build/bin/fretwork" "$(find "$build" -name 'libfailing_calls.so')" examples/straight_tube/study.toml --long
