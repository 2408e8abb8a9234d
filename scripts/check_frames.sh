#!/bin/sh
# Checks every bundle, capture and model of a folder against limits, for continuous integration (docs/ci.md).
# Usage: check_frames.sh FRAMES REPORTS [BASELINES] [OPTION of check]...
# Writes REPORTS/NAME.xml for each frame. BASELINES/NAME.json is used where it exists.
# Ends with 1 if a frame could not be checked, else with 3 if a limit is exceeded, else with 0.
# SHADOW_INSPECTOR names the program.
program=${SHADOW_INSPECTOR:-shadow-inspector}
if [ $# -lt 2 ]; then
    echo "usage: $0 FRAMES REPORTS [BASELINES] [OPTION of check]..." >&2
    exit 2
fi
frames=$1 reports=$2 baselines=
shift 2
case ${1:---} in
    -*) ;;
    *) baselines=$1 && shift ;;
esac
mkdir -p "$reports" || exit 1
unchecked=0 exceeded=0 checked=0
for frame in "$frames"/*.bundle "$frames"/*.zip "$frames"/*.rdc "$frames"/*.glb "$frames"/*.gltf; do
    [ -e "$frame" ] || continue
    name=$(basename "$frame")
    baseline=$baselines/$name.json
    echo "== $name"
    if [ -n "$baselines" ] && [ -e "$baseline" ]; then
        "$program" check "$frame" --baseline "$baseline" --junit "$reports/$name.xml" "$@"
    else
        "$program" check "$frame" --junit "$reports/$name.xml" "$@"
    fi
    case $? in
        0) ;;
        3) exceeded=$((exceeded + 1)) ;;
        2) exit 2 ;;
        *) unchecked=$((unchecked + 1)) ;;
    esac
    checked=$((checked + 1))
done
echo "== $checked frames: $exceeded beyond a limit, $unchecked not checked"
[ $checked -gt 0 ] && [ $unchecked -eq 0 ] || exit 1
[ $exceeded -eq 0 ] || exit 3
