#!/usr/bin/env bash
# Draws docs/architecture/*.svg from the .dot files beside them. Needs graphviz.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../docs/architecture"
for source in *.dot; do
  dot -Tsvg "$source" -o "${source%.dot}.svg"
done
