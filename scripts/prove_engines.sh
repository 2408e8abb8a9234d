#!/usr/bin/env bash
# Draws the same scenes in real engines and in this program, compares them, and writes docs/engines.md and its pictures.
# Engines as arguments, else all. An engine whose packages are missing keeps its last results in build/proof.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$root/build/proof/results
proof=$root/tests/proof
engines=("$@")
if [ $# -eq 0 ]; then
  mapfile -t engines < <(cd "$proof" && /usr/bin/python3 -c 'import engines; print("\n".join(engines.ENGINES))')
fi
export SI_PROOF_FOLDER=$root/build/proof
/usr/bin/python3 "$proof/prove.py" "${engines[@]}" -o "$out" || code=$?
/usr/bin/python3 "$proof/page.py" "$out" "$root/docs/engines.md"
exit "${code:-0}"
