#!/usr/bin/env bash
# on_zink.sh COMMAND...: runs a command with OpenGL by Mesa's zink over lavapipe, the second driver that Debian brings for
# machines without a GPU (package mesa-vulkan-drivers). Tests fail where they find themselves on another one.
set -euo pipefail
driver=(/usr/share/vulkan/icd.d/lvp_icd.*.json)
if [ ! -e "${driver[0]}" ]; then
  echo "${driver[0]}: there is no lavapipe; install the package mesa-vulkan-drivers" >&2
  exit 1
fi
if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
  XDG_RUNTIME_DIR=$(mktemp -d)
  trap 'rm -rf "$XDG_RUNTIME_DIR"' EXIT
fi
export XDG_RUNTIME_DIR VK_ICD_FILENAMES=${driver[0]} VK_DRIVER_FILES=${driver[0]}
export MESA_LOADER_DRIVER_OVERRIDE=zink LIBGL_ALWAYS_SOFTWARE=1 SI_TEST_DRIVER=zink
"$@"
