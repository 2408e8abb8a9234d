#!/usr/bin/env bash
# Draws jobs in Godot 3: run.sh JOB... writes mask.pgm and facts.json into each folder. Exit code 77: a package is
# missing, which the last line names.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for command in godot3-runner xvfb-run; do
  if ! command -v "$command" >/dev/null; then
    echo "lacks $command" >&2
    exit 77
  fi
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The size of the map is read when the engine starts, so jobs of one size share a run.
declare -A jobs
for job in "$@"; do
  [[ $(<"$job/job.json") =~ \"map_resolution\":\ *([0-9]+) ]] || { echo "$job/job.json: no map_resolution" >&2; exit 1; }
  size=${BASH_REMATCH[1]}
  rm -f "$job/mask.pgm" "$job/facts.json"
  jobs[$size]+=${jobs[$size]:+:}$(realpath "$job")
done
for size in "${!jobs[@]}"; do
  mkdir "$work/$size"
  cp "$here"/{project.godot,main.tscn,main.gd} "$work/$size"
  echo "quality/directional_shadow/size=$size" >>"$work/$size/project.godot"
  (
    export LIBGL_ALWAYS_SOFTWARE=1 HOME=$work XDG_DATA_HOME=$work XDG_CONFIG_HOME=$work XDG_CACHE_HOME=$work
    xvfb-run -a -s '-screen 0 640x480x24' godot3-runner --audio-driver Dummy --path "$work/$size" \
      "--jobs=${jobs[$size]}"
  ) >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
done
for job in "$@"; do
  if [ ! -s "$job/mask.pgm" ] || [ ! -s "$job/facts.json" ]; then
    cat "$work/log" >&2
    echo "$job: Godot drew nothing" >&2
    exit 1
  fi
done
