#!/usr/bin/env bash
# Draws jobs in OGRE 1.12: run.sh JOB... writes mask.pgm and facts.json into each folder.
set -euo pipefail
program=$("$(dirname "${BASH_SOURCE[0]}")/../native/build.sh" ogre libogre-1.12-dev \
  -I/usr/include/OGRE -I/usr/include/OGRE/RTShaderSystem -lOgreMain -lOgreRTShaderSystem)
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a "$program" "$@"
