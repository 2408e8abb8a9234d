#!/usr/bin/env bash
# beside_bare.sh [ROUNDS]: the least program that draws the agreed scene (../shared/perf/bare) and ours, in turns (3 unless
# told), as a table: medians and quartiles of the rounds, 1.00 = bare PCF 3x3 by a shadow sampler of the same round.
# Both draw ../shared/perf/scene100k.glb anew in each frame, 1280x720 with a map of 2048 texels a side; ours as near to
# bare as settings make it: no sky, no curve, no ground but the scene's, a map of all of the scene. It encodes sRGB
# still. "finished" are whole frames by the clock, as bare times its own, with all of our light (bench, shared_scene/);
# "passes" the sum that `measure --cost forced` tells, lit by Lambert.
# PROGRAM and BENCH name ours (default below build/release), FRAMES how many a round has (30).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1:-} in
-h | --help)
  sed -n '2,/^set /s/^# //p' "scripts/${BASH_SOURCE[0]##*/}"
  exit
  ;;
esac
rounds=${1:-3}
if ! [[ $rounds =~ ^[1-9][0-9]{0,3}$ ]]; then
  echo "beside_bare.sh: ROUNDS is a number from 1 to 9999, not \"$rounds\"" >&2
  exit 2
fi
perf=../shared/perf
scene=$perf/scene100k.glb
if [ ! -d "$perf/bare" ] || [ ! -f "$scene" ]; then
  echo "beside_bare.sh: $perf with bare/ and scene100k.glb is not there; nothing is measured" >&2
  exit 1
fi
program=${PROGRAM:-build/release/shadow-inspector}
bench=${BENCH:-build/release/tests/bench}
frames=${FRAMES:-30}
for needed in "$program" "$bench"; do
  [ -x "$needed" ] && continue
  echo "$needed: there is no such program; build it with cmake --build --preset release" >&2
  exit 1
done

folder=$(mktemp -d)
trap 'if [ $? != 0 ] && [ -f "$folder/err" ]; then cat "$folder/err" >&2; fi; rm -rf "$folder"' EXIT
cp "$perf"/bare/* "$folder/"
make -s -C "$folder" raw >&2
times=$folder/times # NAME, tab, milliseconds; a line a round
reference='bare  PCF 3x3 by sampler'

# take NAME: keeps the one number that stands in the input.
take() {
  local ms
  ms=$(head -n 1)
  if ! [[ $ms =~ ^[0-9.]+(e[+-]?[0-9]+)?$ ]]; then
    echo "beside_bare.sh: no time of \"$1\"" >&2
    exit 1
  fi
  printf '%s\t%s\n' "$1" "$ms" >>"$times"
}

# bare NAME FILTER
bare() {
  "$folder/raw" "$scene" --size 2048 --filter "$2" --draw batch --frames "$frames" 2>"$folder/err" |
    sed -n 's/.*"median_ms":\([0-9.e+-]*\).*/\1/p' | take "bare  $1"
}

# finished NAME ROW
finished() {
  SI_BENCH_ROUNDS=$frames "$bench" --benchmark_filter="^shared_scene/$2/" --benchmark_format=json 2>"$folder/err" |
    sed -n 's/.*"ours_ms": *\([0-9.e+-]*\).*/\1/p' | take "ours  $1, finished"
}

# passes NAME KERNEL SIZE
passes() {
  "$program" measure "$scene" --json --cost forced --size 1280x720 --set map.resolution=2048 \
    --set filter.kernel="$2" --set filter.size="$3" --set light.fit=scene --set scene.ground=off \
    --set shading.specular=0 --set shading.sky=plain --set shading.curve=plain 2>"$folder/err" |
    sed -n '/"total_ms"/,/}/s/.*"median": *\([0-9.e+-]*\).*/\1/p' | take "ours  $1, passes"
}

# rows: all of them once, bare and ours in turns.
rows() {
  bare 'hard' hard
  finished 'hard' hard
  passes 'hard' hard 3
  bare 'PCF 3x3 by sampler' pcf3
  finished 'PCF 3x3' pcf3
  bare 'PCF 3x3 by gather' gather3
  passes 'PCF 3x3' pcf 3
  bare 'PCF 5x5 by sampler' pcf5
  finished 'PCF 5x5' pcf5
  bare 'PCF 5x5 by gather' gather5
  passes 'PCF 5x5' pcf 5
}

for ((round = 1; round <= rounds; ++round)); do
  echo "round $round of $rounds" >&2
  rows
done

awk -F '\t' -v reference="$reference" '
  function at(values, n, share,   i, j, v, sorted) { # as Quartiles of tests/bench/rounds.h
    for (i = 1; i <= n; ++i) {
      v = values[i]
      for (j = i; j > 1 && sorted[j - 1] > v; --j) sorted[j] = sorted[j - 1]
      sorted[j] = v
    }
    return sorted[int(n * share) + 1]
  }
  !($1 in count) { order[++rows] = $1 }
  { ms[$1, ++count[$1]] = $2 + 0 }
  END {
    printf "%-28s %-25s %s\n", "", "share of " substr(reference, 7), "ms a frame"
    for (r = 1; r <= rows; ++r) {
      name = order[r]
      n = count[name]
      for (i = 1; i <= n; ++i) {
        time[i] = ms[name, i]
        share[i] = ms[name, i] / ms[reference, i]
      }
      printf "%-28s %5.2f (%.2f to %.2f)      %7.2f (%.2f to %.2f)\n", name, at(share, n, 0.5), at(share, n, 0.25),
             at(share, n, 0.75), at(time, n, 0.5), at(time, n, 0.25), at(time, n, 0.75)
    }
  }' "$times"
