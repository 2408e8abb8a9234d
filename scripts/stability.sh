#!/bin/sh
# Runs the tests of the hard cases on the driver at hand and on zink, and writes what they find into docs/lab/stability.md.
# usage: scripts/stability.sh [BUILD]      BUILD: where CMake built the tests, else build/release
set -eu
cd "$(dirname "$0")/.."
tests="${1:-build/release}/tests/test_hard_cases"
[ -x "$tests" ] || { echo "stability.sh: no $tests; build it with -DSI_BUILD_TESTS=ON" >&2; exit 1; }
export SI_UPDATE_ASSETS=1
rows='*HardCase1*:*HardCase2*:*HardCase3*:*HardCase4*:*HardCase5*:*HardCase6*:*HardCase7*:*HardCase8*:*HardCase9*'
status=0
"$tests" --gtest_brief=1 --gtest_filter="$rows" || status=1
scripts/on_zink.sh "$tests" --gtest_brief=1 --gtest_filter="$rows" || status=1
exit $status
