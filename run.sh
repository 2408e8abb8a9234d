#!/usr/bin/env bash
# Installs what is missing, builds the program (Release) and runs it with the arguments given.
# Without arguments: the editor, or, without a display, pictures of everything in out/ and a table of times.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/scripts/packages.sh"
require_packages "${build_packages[@]}"

build=$root/build/release
program=$build/shadow-inspector
log=$root/build/run.log
mkdir -p "$root/build"

# Standard output is the program's alone, so that `./run.sh list settings --json` can be piped.
quietly() {
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    exit 1
  fi
}
if [ ! -f "$build/build.ninja" ]; then
  say "Configuring $build"
  quietly cmake -S "$root" --preset release -DSI_BUILD_TESTS=OFF -DSI_BUILD_BENCH=OFF
fi
# How far it is, in place on a terminal and now and then in a file; nothing where there is nothing to build.
show_percent() {
  local line percent shown=-10
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$log"
    [[ $line == *Re-checking* ]] && continue  # whether files came or went, each time
    [[ $line =~ ^\[\ *([0-9]+)%\] ]] || continue
    percent=${BASH_REMATCH[1]}
    if [ -t 2 ]; then
      printf '\rBuilding: %3d %%' "$percent" >&2
    elif ((percent >= shown + 10 || (percent == 100 && shown < 100))); then
      say "Building: $percent %"
      shown=$percent
    fi
  done
  if [ -t 2 ] && [ -n "${percent:-}" ]; then printf '\n' >&2; fi
}
[ -x "$program" ] || say "Building (some minutes the first time)"
: >"$log"
if ! NINJA_STATUS='[%p] ' cmake --build "$build" --target shadow-inspector 2>&1 | show_percent; then
  cat "$log" >&2
  exit 1
fi
exec "$program" "$@"
