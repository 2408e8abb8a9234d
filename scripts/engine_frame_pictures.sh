#!/bin/sh
# Draws the pictures of docs/engine-frame.md, which show the frame of assets/bundle/examples/opengl.c.
# usage: scripts/engine_frame_pictures.sh [BUILD] [FOLDER] [--without-editor]
#        BUILD: where CMake built program and tests, else build/release; FOLDER: else docs/images/engine-frame
set -eu
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
folder=$(realpath "${2:-docs/images/engine-frame}")
editor=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$build/tests/bundle_opengl" sun.bundle --light sun --depth d32f

# draw PICTURE ARGUMENTS: the page has the same arguments.
draw() {
  picture=$1
  shift
  "$build/shadow-inspector" "$@" -o "$folder/$picture" 2>/dev/null
}
draw 1-frame.png render sun.bundle --size 512x288
draw 2-map.png render sun.bundle --view shadow-map --set view.map=linear --set view.face=1
draw 4-without-normal.png render sun.bundle --size 512x288 --set view.overlay=bias-slack --set bias.normal=0
draw 4-with-normal.png render sun.bundle --size 512x288 --set view.overlay=bias-slack
draw 5-causes.png render sun.bundle --size 512x288 --set view.overlay=artefacts
[ "$editor" = --without-editor ] ||
  "$build/shadow-inspector" edit sun.bundle --headless --screenshot "$folder/3-editor.png" --size 1120x640 \
    --probe 508,150 --tab pixel
