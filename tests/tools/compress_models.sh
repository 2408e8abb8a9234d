#!/usr/bin/env bash
# Makes tests/data/compressed: small own scenes, compressed by gltf-transform, each beside its twin.
# Usage: compress_models.sh PROGRAM FOLDER, with gltf-transform (npm: @gltf-transform/cli, made with 4.5.1) in PATH.
set -euo pipefail
program=$1
folder=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

transform() { gltf-transform "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }; }

# make NAME SCENE STEP...: exports a scene, applies steps, each a command of gltf-transform with its options, and writes
# NAME.glb and NAME.twin.glb. The twin is the compressed file with everything decoded: the same quantised values.
make() {
  local name=$1 scene=$2 step
  shift 2
  "$program" export "$scene" -o "$work/in.glb" >/dev/null
  for step in "$@"; do
    local words=()
    read -ra words <<<"$step"
    transform "${words[0]}" "$work/in.glb" "$work/out.glb" "${words[@]:1}"
    mv "$work/out.glb" "$work/in.glb"
  done
  cp "$work/in.glb" "$folder/$name.glb"
  transform copy "$work/in.glb" "$work/twin.glb"
  if grep -aq WEBP "$work/twin.glb"; then
    transform png "$work/twin.glb" "$work/png.glb" --formats webp
    mv "$work/png.glb" "$work/twin.glb"
  fi
  mv "$work/twin.glb" "$folder/$name.twin.glb"
}

make draco-boxes boxes draco
make draco-sequential hard/grazing "draco --method sequential"
make draco-mirrored hard/mirrored "draco --quantize-position 11"
make draco-plane plane "draco --method sequential --quantize-position 16"
make meshopt-instances hard/snapping "meshopt --level medium"
make meshopt-spheres hard/thin-caster "meshopt --level high"
make meshopt-planes hard/edge-on-planes "meshopt --level high"
make webp-mask hard/alpha "webp --lossless true"
make webp-lossy-draco hard/alpha "webp --quality 60" draco
make webp-meshopt hard/alpha webp "meshopt --level high"
