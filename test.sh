#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests by stages; prints at the end how long each took. Options:
#   (none)         format, build in Release, and all that draws or computes without a window, on the driver at hand
#   --all          besides: windows, engines of others, full products, zink (a second driver), the sanitizers
#   --only STAGE   one stage, with the build that it needs; may be repeated
#   --also STAGE   the default stages and one more; may be repeated
#   -h, --help     this text
# A stage whose packages are missing and cannot be installed is skipped and counted; with SI_REQUIRE_ALL=1 that fails.
# What takes longer still: ctest --test-dir build/release -L long
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/scripts/packages.sh"

# STAGE:what it does, in the order in which they run.
default_stages=(
  "format:sources are as .clang-format says"
  "build:the program and the tests in Release"
  "unit:what computes"
  "gl:what draws"
  "glsl:shaders by the reference compiler"
  "hard:hard cases against rays"
  "invariant:invariants of all rows, two choices at a time"
  "cli:commands"
  "ui:panels, without a window"
  "recipe:the recipe for a filter kernel, followed by its page"
)
more_stages=(
  "slow:tests that take longer than three seconds each"
  "frames:frames of other programs that RenderDoc captured"
  "window:the editor in windows of its own"
  "engines:engines of others: bundles of three.js, and shadows of every engine of tests/proof against this program's"
  "package:the Debian package, checked, installed in a clean root, run there and removed"
  "products:full products of what tests take in part, and tests that take minutes"
  "zink:drawing tests on zink over lavapipe"
  "asan:the build under AddressSanitizer and UndefinedBehaviorSanitizer; unit tests, each preset drawn"
)
# By hand alone: ten minutes more each.
other_stages=(
  "strict:a build by clang, each source by itself, warnings are errors; not run"
  "panels:panels under the sanitizers"
  "memory:drawing tests under the sanitizers"
)

names() { printf '%s\n' "${@%%:*}"; }
list_stages() {
  local stage
  for stage in "${default_stages[@]}" "${more_stages[@]}" "${other_stages[@]}"; do
    printf '  %-10s %s\n' "${stage%%:*}" "${stage#*:}"
  done
}

chosen=() also=()
while [ $# -gt 0 ]; do
  case $1 in
  -h | --help)
    sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    echo "Stages:"
    list_stages
    exit
    ;;
  --all) mapfile -t chosen < <(names "${default_stages[@]}" "${more_stages[@]}") ;;
  --memory) chosen+=(memory) ;;
  --only | --also)
    if ! names "${default_stages[@]}" "${more_stages[@]}" "${other_stages[@]}" | grep -qx -- "${2:-}"; then
      { echo "${2:-} is no stage; there are"; list_stages; } >&2
      exit 2
    fi
    if [ "$1" = --only ]; then chosen+=("$2"); else also+=("$2"); fi
    shift
    ;;
  *)
    echo "$1 is no option: see ./test.sh --help" >&2
    exit 2
    ;;
  esac
  shift
done
if [ ${#chosen[@]} -eq 0 ]; then mapfile -t chosen < <(names "${default_stages[@]}"); fi
chosen+=("${also[@]}")

require_packages "${build_packages[@]}" "${test_packages[@]}"
# Installing may fail without a network; what then lacks is found below.
(require_packages "${stage_packages[@]}") || true
jobs=$(nproc)
log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed=() skipped=() lacking=() times=() built=" "

minutes() { printf '%4d:%02d min' $(($1 / 60)) $(($1 % 60)); }

# stage NAME COMMAND...: runs a command, and keeps how long it took and whether it failed.
stage() {
  local name=$1 start=$SECONDS
  shift
  say "== $name"
  "$@" || failed+=("$name")
  times+=("$(minutes $((SECONDS - start)))  $name")
}

# tests BUILD LABEL...: runs the tests of labels at once, and keeps how long those of each took on one core, which failed,
# and how many were skipped.
tests() {
  local build=$root/build/$1 passed=0 seconds what label again=() labels
  for label in "${@:2}"; do
    if ! ctest --test-dir "$build" -N -L "^$label\$" -LE long --no-tests=error >/dev/null; then
      say "no test has the label $label"
      passed=1
    fi
  done
  labels=$(IFS='|' && echo "${*:2}")
  # The leak sanitizer itself may crash where threads end; what it finds, it finds again.
  if [ "$1" = asan ]; then again=(--repeat until-pass:2); fi
  ctest --test-dir "$build" -L "^($labels)\$" -LE long --output-on-failure --no-tests=error "${again[@]}" -j "$jobs" |
    tee "$log" || passed=1
  while read -r seconds what; do
    times+=("$(minutes "$seconds")      on one core: $what")
  done < <(sed -nE 's/^([a-z]+) += +([0-9]+)[.0-9]* sec\*proc +(\(.*\))/\2 \1 \3/p' "$log")
  while read -r what; do
    failed+=("$what")
  done < <(sed -nE 's/^[[:space:]]+[0-9]+ - (.* \((Failed|Timeout|Not Run|SEGFAULT|Subprocess.*|.*Exception.*)\)).*/\1/p' "$log")
  # Lines that tests leave which lack something from outside the repository: a name, "lacks", and what.
  while read -r _ _ what; do
    lacking+=("$what")
  done < <(cat "$build"/test-output/lacking-*.txt 2>/dev/null)
  rm -f "$build"/test-output/lacking-*.txt
  return $passed
}

# once BUILD: makes a build if this run has not.
once() {
  case $built in *" $1 "*) return ;; esac
  built+="$1 "
  stage "build: $1" "build_$1"
}

build_release() {
  cmake -S "$root" --preset release -DSI_BUILD_TESTS=ON -DSI_BUILD_BENCH=ON &&
    cmake --build "$root/build/release" --parallel "$jobs"
}
build_asan() {
  cmake -S "$root" --preset asan &&
    cmake --build "$root/build/asan" --parallel "$jobs" --target test_unit draw_presets
}
build_panels() { cmake -S "$root" --preset asan && cmake --build "$root/build/asan" --parallel "$jobs" --target test_ui; }
build_memory() { cmake -S "$root" --preset asan && cmake --build "$root/build/asan" --parallel "$jobs" --target test_gl; }
build_strict() { cmake -S "$root" --preset strict && cmake --build "$root/build/strict" --parallel "$jobs"; }

# By clang-format of Debian 12, whose version decides what is well formed.
format() {
  find "$root"/{app,renderer,ui,tests} \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 -P "$jobs" -n 64 clang-format --dry-run -Werror
}

zink() {
  "$root/scripts/on_zink.sh" "$root/build/release/shadow-inspector" info && tests release zink
}

# run_stage NAME
run_stage() {
  case $1 in
  format) stage format format ;;
  build) once release ;;
  zink) once release && stage zink zink ;;
  asan)
    once asan
    local label
    for label in unit presets; do stage "asan: $label" tests asan "$label"; done
    ;;
  package) once release && stage package "$root/scripts/test_package.sh" ;;
  panels) once panels && stage panels tests asan ui ;;
  memory) once memory && stage memory tests asan gl ;;
  strict) once strict ;;
  *) once release && stage "$1" tests release "$1" ;;
  esac
}

# lacks NAME: the command that a stage needs and the machine has not.
lacks() {
  local command
  case $1 in
  format) command=clang-format ;;
  strict) command=clang++ ;;
  window) command=xdotool ;;
  package)
    "$root/scripts/test_package.sh" --lacks
    return
    ;;
  *) return 1 ;;
  esac
  ! command -v "$command" >/dev/null
}

# Tests of these labels run at once, since between two stages a core would wait for the last test of the first. The programs
# of the stage recipe write to the same folders as the tests, so it runs by itself.
run_labels() {
  if [ ${#labels_at_once[@]} -eq 0 ]; then return; fi
  once release
  stage "${labels_at_once[*]}" tests release "${labels_at_once[@]}"
  labels_at_once=()
}

labels_at_once=()
for name in "${chosen[@]}"; do
  case $name in
  unit | gl | glsl | hard | invariant | cli | ui | slow | frames)
    labels_at_once+=("$name")
    continue
    ;;
  esac
  run_labels
  if lacks "$name"; then
    skipped+=("$name")
    say "== $name is skipped: a package is missing"
    continue
  fi
  run_stage "$name"
done
run_labels

say "== Times"
printf '%s\n' "${times[@]}" >&2
say "$(minutes $SECONDS)  altogether"
if [ ${#skipped[@]} -gt 0 ]; then
  say "Stages skipped (${#skipped[@]}):"
  printf '  %s\n' "${skipped[@]}" >&2
  if [ -n "${SI_REQUIRE_ALL:-}" ]; then failed+=("stages that were skipped"); fi
fi
if [ ${#lacking[@]} -gt 0 ]; then
  say "Tests skipped that lack something from outside the repository (${#lacking[@]}):"
  printf '  %s\n' "${lacking[@]}" | sort | uniq -c >&2
fi
if [ ${#failed[@]} -gt 0 ]; then
  printf 'Failed: %s\n' "${failed[@]}" >&2
  exit 1
fi
