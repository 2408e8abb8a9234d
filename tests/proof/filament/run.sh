#!/usr/bin/env bash
# Draws jobs in Filament 1.9: run.sh JOB... writes mask.pgm and facts.json into each folder.
set -euo pipefail
program=$("$(dirname "${BASH_SOURCE[0]}")/../native/build.sh" filament libfilament-dev \
  -I/usr/include/filament-1.9 -lfilament -lfilament_filamat -lfilament_geometry -lfilament_backend -lfilament_utils \
  -lpthread)
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a "$program" "$@"
