#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fuzzes each reader of files for some seconds: tests/fuzz/run.sh [SECONDS [TARGET ...]], by default 20 s each.
# Ends with status 1 at the first input that crashes, hangs or exhausts the memory; that input is left in build/fuzz/found.
# The inputs start from tests/fuzz/corpus and the examples; new ones are kept in build/fuzz/corpus, not in the sources.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-20}
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(mesh study table results)
tools/install_packages.sh clang-14 libclang-rt-14-dev
[ -e build/fuzz/CMakeCache.txt ] || cmake --preset fuzz >/dev/null
if ! cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}" >build/fuzz/build.log; then
  tail -n 60 build/fuzz/build.log
  exit 1
fi
mkdir -p build/fuzz/found build/fuzz/corpus/study_examples
for study in examples/*/*.toml; do
  cp "$study" "build/fuzz/corpus/study_examples/$(basename "$(dirname "$study")")_$(basename "$study")"
done
# the keys and the values of studies, as the document names them
grep -o '`"\?[a-z_]\+"\?`' doc/study-file.md | tr -d '`' | sort -u | sed 's/"/\\"/g; s/.*/"&"/' >build/fuzz/study.dict
printf '"$%s"\n' MeshFormat EndMeshFormat PhysicalNames EndPhysicalNames Entities EndEntities Nodes EndNodes Elements EndElements >build/fuzz/mesh.dict
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
printf '| reader | inputs | seconds | crashes, hangs |\n| --- | --- | --- | --- |\n'
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$target"
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$target-")
  [ ! -e "build/fuzz/$target.dict" ] || options+=(-dict="build/fuzz/$target.dict")
  more=()
  [ "$target" != study ] || more=(build/fuzz/corpus/study_examples)
  log=build/fuzz/$target.log
  if ! "build/fuzz/bin/fuzz_$target" "${options[@]}" "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" "${more[@]}" >"$log" 2>&1; then
    tail -n 60 "$log"
    exit 1
  fi
  printf '| %s | %s | %s | 0 |\n' "$target" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$seconds"
done
