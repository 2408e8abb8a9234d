#!/usr/bin/env bash
# performance_curves.sh [JSON]: measures how times grow and draws docs/images/performance-curves.png. Takes some minutes.
# SI_BENCH_ROUNDS sets the rounds, SI_BENCH_LONG adds 10 million triangles, BENCH names the program. A JSON that is there
# is drawn as it is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bench=${BENCH:-build/release/tests/bench}
if [ ! -x "$bench" ]; then
  echo "$bench: there is no such program; build it with cmake --build --preset release --target bench" >&2
  exit 1
fi
json=${1:-}
if [ -z "$json" ]; then
  json=$(mktemp --suffix=.json)
  trap 'rm -f "$json"' EXIT
fi
if [ ! -s "$json" ]; then
  "$bench" --benchmark_filter=^curve/ --benchmark_out="$json" --benchmark_out_format=json
fi
"$bench" --draw-curves "$json" docs/images/performance-curves.png
