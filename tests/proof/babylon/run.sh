#!/usr/bin/env bash
# Draws jobs in Babylon.js: run.sh JOB... writes mask.pgm and facts.json into each folder.
# Its shaders read maps by a sampler2D without a precision qualifier. Mesa's OpenGL ES then reads 16-bit floats, and
# needs up to 2^-11 of the depth range more bias. Its desktop OpenGL reads 32 bits, and needs an X display. Exit code 77:
# a package is missing.
set -euo pipefail
if ! command -v xvfb-run >/dev/null; then
  echo "lacks xvfb-run" >&2
  exit 77
fi
SI_PROOF_ANGLE=gl xvfb-run -a -s '-screen 0 1280x720x24' "$(dirname "${BASH_SOURCE[0]}")/../browser/run.sh" babylon "$@"
