#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests: all but the long ones in Release, then the unit tests and the
# drawing tests under AddressSanitizer and UndefinedBehaviorSanitizer. The long ones: ctest --test-dir build/release -L long
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/scripts/packages.sh"
require_packages "${build_packages[@]}" "${test_packages[@]}"
jobs=$(nproc)
failed=()

say "== Release"
cmake -S "$root" --preset release -DSI_BUILD_TESTS=ON -DSI_BUILD_BENCH=ON
cmake --build "$root/build/release" --parallel "$jobs"
ctest --test-dir "$root/build/release" -LE long --output-on-failure --no-tests=error -j "$jobs" || failed+=(release)

say "== AddressSanitizer and UndefinedBehaviorSanitizer"
cmake -S "$root" --preset asan
cmake --build "$root/build/asan" --parallel "$jobs" --target test_unit test_gl
ctest --test-dir "$root/build/asan" -L '^(unit|gl)$' -LE long --output-on-failure --no-tests=error -j "$jobs" ||
  failed+=(asan)

if [ ${#failed[@]} -gt 0 ]; then
  say "Failed: ${failed[*]}"
  exit 1
fi
