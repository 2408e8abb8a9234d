#!/usr/bin/env bash
# Measures the same settings on several scenes: wrong pixels, acne among them, and mean error, a row a scene and their sums.
# usage: scripts/measure_scenes.sh [SCENE ...] [-- KEY=VALUE ...]
#   SCENE        a built-in scene or a file; without one: stage boxes teapot figures landscape relief
#   KEY=VALUE    settings, as --set takes them: bias.kind=adaptive bias.normal=0
# PROGRAM names the program (default build/release/shadow-inspector), SIZE the picture (default 640x360). Needs jq.
# Exit code: 0 done, 1 a scene could not be measured, 2 a tool is missing.
set -euo pipefail

case ${1:-} in
-h | --help)
  sed -n '2,/^set /s/^# //p' "${BASH_SOURCE[0]}"
  exit
  ;;
esac
program=${PROGRAM:-$(dirname "${BASH_SOURCE[0]}")/../build/release/shadow-inspector}
if [ ! -x "$program" ]; then
  echo "measure_scenes.sh: no program $program; build it with cmake --build --preset release" >&2
  exit 2
fi
command -v jq >/dev/null || { echo "measure_scenes.sh: jq is not installed" >&2; exit 2; }

scenes=() sets=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  scenes+=("$1")
  shift
done
[ $# -gt 0 ] && shift
for setting in "$@"; do sets+=(--set "$setting"); done
[ ${#scenes[@]} -gt 0 ] || scenes=(stage boxes teapot figures landscape relief)

for scene in "${scenes[@]}"; do
  "$program" measure "$scene" --size "${SIZE:-640x360}" --no-time --json "${sets[@]}" |
    jq -r --arg scene "${scene##*/}" '.error | [$scene, (.artefacts | del(.none) | add), .artefacts.acne, .mae] | @tsv'
done | awk -F '\t' '
  BEGIN { printf "%-28s %8s %8s %12s\n", "scene", "wrong", "acne", "mean error" }
  { printf "%-28s %8d %8d %12.5f\n", $1, $2, $3, $4; wrong += $2; acne += $3; error += $4 }
  END { printf "%-28s %8d %8d %12.5f\n", "sum", wrong, acne, error }'
