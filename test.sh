#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests: all in Release on the driver at hand; what draws once more on a
# second driver (zink over lavapipe); the unit tests and the drawing of each preset under AddressSanitizer and
# UndefinedBehaviorSanitizer. Besides, sources have to be as .clang-format wants them. Says at the end how long what took.
# Left out are the long ones: ctest --test-dir build/release -L long
# and the drawing tests under the sanitizers, some ten minutes: ./test.sh --memory
set -euo pipefail
case ${1:-} in
-h | --help)
  sed -n '2,/^set /s/^# //p' "${BASH_SOURCE[0]}"
  exit
  ;;
--memory | "") ;;
*)
  echo "$1 is no option: see ./test.sh --help" >&2
  exit 2
  ;;
esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/scripts/packages.sh"
require_packages "${build_packages[@]}" "${test_packages[@]}"
jobs=$(nproc)
log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed=() times=()

minutes() { printf '%4d:%02d min' $(($1 / 60)) $(($1 % 60)); }

# stage NAME COMMAND...: runs a command, and keeps how long it took and whether it failed.
stage() {
  local name=$1 start=$SECONDS
  shift
  say "== $name"
  "$@" || failed+=("$name")
  times+=("$(minutes $((SECONDS - start)))  $name")
}

# tests BUILD LABELS [LAUNCHER]: runs the tests that have one of the labels, and keeps how long each label took.
tests() {
  local passed=0 seconds what again=()
  # The leak sanitizer itself may crash where threads end; what it finds, it finds again.
  if [ "$1" = asan ]; then again=(--repeat until-pass:2); fi
  ${3:+"$3"} ctest --test-dir "$root/build/$1" -L "$2" -LE long --output-on-failure --no-tests=error "${again[@]}" -j "$jobs" |
    tee "$log" || passed=1
  while read -r seconds what; do
    times+=("$(minutes "$seconds")      on one core: $what")
  done < <(sed -nE 's/^([a-z]+) += +([0-9]+)[.0-9]* sec\*proc +(\(.*\))/\2 \1 \3/p' "$log")
  return $passed
}

build_release() {
  cmake -S "$root" --preset release -DSI_BUILD_TESTS=ON -DSI_BUILD_BENCH=ON &&
    cmake --build "$root/build/release" --parallel "$jobs"
}

# build_asan TARGET...
build_asan() {
  cmake -S "$root" --preset asan && cmake --build "$root/build/asan" --parallel "$jobs" --target "$@"
}

# What one front end and one plan decide on every driver: what compiles, what is kept, what is left out, what is told of
# measured errors.
decided_by_the_plan="ProgramsTest.*:RandomWalkTest.*:*CachedPicturesEqualFreshOnes*:*BusyStates*:FitsTest.What*"
decided_by_the_plan+=":IdleTest.*:WasteTest.*:SavingsTest.*:RestingSavingsTest.*:CuresTest.*:AdviceTest.*"
decided_by_the_plan+=":LookupSavingsTest.ForcedGives*:*EveryPassIsAnEffect*"
# That, and what compares the numbers of one thing drawn hundreds of times over: a driver's affair, not of our memory.
drawn_over_and_over="$decided_by_the_plan:*SavingsTest.*:LeastBiasTwins.*:*AreTheSameInCxxAndOnTheGpu*"
drawn_over_and_over+=":*PerTexelBiasesLeaveNoAcneOnPlanes*:*GatherAndShadowSamplerGiveOnePicture*"
drawn_over_and_over+=":*LeastBiasAndSlackAreThoseOfTheTheory*:*AgreesWithMeasureOnEveryPixel*"
drawn_over_and_over+=":*AreExactOverScenesAndLights*:*ProbeAgreesWithTheVisibilityPicture*:*EveryOverlayDrawsEveryLightType*"
drawn_over_and_over+=":SlabsTest.StandWhereTheStoredDepthLies:MapViewTest.ShowsTheCamerasOwnDepth:*TapsAddUpToWhatTheGpuFound"
drawn_over_and_over+=":ViewChoiceTest.*:ViewDepthsTest.*:WarpedMapsTest.*:LightMapTest.P*:LightMapTest.Fo*:LightRange.Probe*"
drawn_over_and_over+=":*FourMissLessThanOne*:*CascadesTest.TheProbeNamesThem:BlocksTest.*:SurfaceIdsTest.WhatIsSeenEdgeOn*"
drawn_over_and_over+=":FitsTest.*:MeasureTest.*:*GoldenTest.*:CausesTest.E*:LightCamera.C*:Moments.*:ShadowVolumesTest.*"
drawn_over_and_over+=":SectionTest.StepsAre*:FrameTest.Skipping*:FrameTest.Fused*:SourcesTest.Fused*:SourcesTest.TheTrue*"
drawn_over_and_over+=":CascadesTest.Nothing*:PagesTest.AreSharper*:PagesTest.AreTheWhole*:TapsTest.*:DriverTest.Compiles*"
drawn_over_and_over+=":SourcesTest.O*:SourcesTest.E*:FaceNormals*:LookTest.*:FramesApart.AProbeLeavesTheFrame*:GroundTest.Models*"
# And what the unit tests compute as often, or read of the sources.
computed_over_and_over="Travel.MapsStay*:SettingsIdle.Every*:CastersFit.*:WarpedFit.*:ViewFit.*:CaseSessionsTest.AnAxis*:Recipes.*"

# What the program's own code decides, rays included, and variants of what is drawn there as well.
not_the_drivers="CasterSavingsTest.*:HeldTest.*:TroubleTest.*:GroundTest.Models*:MeasureTest.ErrorOfTheHardKernel*:SectionTest.*"
not_the_drivers+=":FramesApart.*:*EveryOverlayDrawsEveryLightType*:*PerTexelBiasesLeaveNoAcneOnPlanes*:DossierTest.AgreesWithMeasure*"
not_the_drivers+=":*EachFit.*:*EachSourceWithoutAMap.*:*large_indices:*GuidedPresets.*/light_map*"
not_the_drivers+=":*ReceiverPlaneBias.*_reversed:*ReceiverPlaneBias.*_d16"

# All that draws, but for the editor and the commands, which are the same on every driver; that both draw each preset
# alike is among the commands' tests.
tests_on_zink() {
  local zink=$root/scripts/on_zink.sh
  # That presets look alike on both is a test of commands. Settings by chance call for programs that this driver takes
  # long to compile: one group that shares them.
  local -x GTEST_FILTER="-$decided_by_the_plan:$not_the_drivers:HardCaseTable.PresetsOfFaultsShowThem:GuidedPresetFiles.*"
  local -x SI_RANDOM_SEEDS=25
  "$zink" "$root/build/release/shadow-inspector" info && tests release '^(gl|hard|invariant)$' "$zink"
}

tests_asan() {
  local -x GTEST_FILTER="-$computed_over_and_over"
  tests asan '^(unit|presets)$'
}

drawing_tests_asan() {
  local -x GTEST_FILTER="-$drawn_over_and_over"
  tests asan '^gl$'
}

# By clang-format of Debian 12, whose version decides what is well formed.
format() {
  find "$root"/{app,renderer,ui,tests} -name '*.h' -o -name '*.cpp' | xargs clang-format --dry-run -Werror
}

if [ "${1:-}" = --memory ]; then
  stage "build under AddressSanitizer and UndefinedBehaviorSanitizer" build_asan test_gl
  stage "drawing tests under AddressSanitizer and UndefinedBehaviorSanitizer" drawing_tests_asan
else
  stage "format" format
  stage "build in Release" build_release
  stage "tests" tests release .
  stage "drawing tests on zink over lavapipe" tests_on_zink
  stage "build under AddressSanitizer and UndefinedBehaviorSanitizer" build_asan test_unit draw_presets
  stage "tests under AddressSanitizer and UndefinedBehaviorSanitizer" tests_asan
fi

say "== Times"
printf '%s\n' "${times[@]}" >&2
if [ ${#failed[@]} -gt 0 ]; then
  printf 'Failed: %s\n' "${failed[@]}" >&2
  exit 1
fi
