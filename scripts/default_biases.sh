#!/usr/bin/env bash
# default_biases.sh [MODELS]: measures five biases over six built-in scenes, and over six models in a folder (by default
# ../shared/models), at 640x360 with all other settings by default. Prints the tables of docs/accuracy.md: wrong
# pixels with acne among them, and mean errors. Takes some minutes. PROGRAM names the program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${PROGRAM:-build/release/shadow-inspector}
models=${1:-../shared/models}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sweep() {  # sweep SCENE FOLDER OPTION...: one line per case, "wrong acne mae"
  local folder=$work/$2
  "$program" sweep "$1" --no-time --size 640x360 "${@:3}" -o "$folder" >/dev/null 2>&1
  awk -F, -v counted="$(grep -m1 -o '"counted": *[0-9]*' "$folder/results.json" | tr -dc 0-9)" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { printf "%.0f %.0f %.4f\n", ($at["error.false_shadow"] + $at["error.false_light"]) * counted,
             $at["error.acne"] * counted, $at["error.mae"] }' "$folder/results.csv"
}

cells() { awk '{ printf " %d (%d) |", $1, $2 }'; }

scenes=(stage boxes teapot figures landscape relief)
for model in kaykit_graveyard/kaykit_graveyard.glb kenney_city/kenney_city.glb godot_living_room/living_room.glb \
  khr_Fox/glTF-Binary/Fox.glb khr_Suzanne/glTF/Suzanne.gltf godot_tree/scene.gltf; do
  if [ -f "$models/$model" ]; then scenes+=("$models/$model"); fi
done
head() {
  echo "| scene | \`slope\`, normal 3 | \`slope\`, normal 1.5 | \`receiver-plane\` | \`adaptive\` | \`receiver-plane-derivatives\` |"
  echo "|---|--:|--:|--:|--:|--:|"
}

head
for scene in "${scenes[@]}"; do
  name=${scene#"$models"/}
  name=${name%%/*}
  {
    sweep "$scene" "$name-slope" --set bias.kind=slope --vary bias.normal=3,1.5
    sweep "$scene" "$name" --vary bias.kind=receiver-plane,adaptive,receiver-plane-derivatives
  } >"$work/lines"
  echo "| $name |$(cells <"$work/lines")"
  awk '{ print NR, $0 }' "$work/lines" >>"$work/all"
  awk -v name="$name" 'BEGIN { printf "| %s |", name } { printf " %s |", $3 } END { print "" }' "$work/lines" >>"$work/means"
done
awk '{ wrong[$1] += $2; acne[$1] += $3 }
  END { printf "| **all** |"; for (i = 1; i <= 5; ++i) printf " **%d** (%d) |", wrong[i], acne[i]; print "" }' "$work/all"
echo
head
cat "$work/means"
