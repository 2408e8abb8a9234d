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
if [ -x "$program" ]; then
  quietly cmake --build "$build" --target shadow-inspector
else
  say "Building (some minutes the first time)"
  cmake --build "$build" --target shadow-inspector >&2
fi
exec "$program" "$@"
