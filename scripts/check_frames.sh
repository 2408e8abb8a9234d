#!/bin/sh
# Checks every bundle, capture and model of a folder against limits, for continuous integration (docs/ci.md).
# Usage: check_frames.sh FRAMES REPORTS [BASELINES] [OPTION of check]...
# Writes REPORTS/NAME.xml for each frame. BASELINES/NAME.json is used where it exists.
# Prints the names of other files, except of parts of models: .bin, .mtl, .json and images.
# Ends with 2 if a folder is missing, else with 1 if a frame could not be checked, else with 3 if a limit is exceeded,
# else with 0.
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
for folder in "$frames" ${baselines:+"$baselines"}; do
    [ -d "$folder" ] && continue
    echo "$0: $folder: no such folder; make it, or name another one" >&2
    exit 2
done
mkdir -p "$reports" || exit 1
unchecked=0 exceeded=0 checked=0 left_out=0
for frame in "$frames"/*; do
    [ -e "$frame" ] || continue
    name=$(basename "$frame")
    case $name in
        *.*) extension=$(printf %s "${name##*.}" | tr '[:upper:]' '[:lower:]') ;;
        *) extension= ;;
    esac
    case $extension in
        gltf | glb | vrm | bundle | zip | obj | fbx | dae | zae | ply | stl | 3ds | x3d | off | x | 3mf | ac | amf | \
        ase | b3d | blend | cob | dxf | hmp | ifc | iqm | irr | lwo | lws | lxo | md2 | md3 | mdc | mdl | ms3d | nff | \
        ogex | md5mesh | pmx | q3o | sib | smd | ter | xgl | rdc) ;;
        bin | mtl | json | png | jpg | jpeg | webp | ktx2 | dds | tga | bmp | gif | tif | tiff | hdr | exr | pfm | raw)
            continue
            ;;
        *)
            echo "== $name: left out: no extension of a frame"
            left_out=$((left_out + 1))
            continue
            ;;
    esac
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
[ $left_out -eq 0 ] || echo "== $left_out files left out"
[ $checked -gt 0 ] && [ $unchecked -eq 0 ] || exit 1
[ $exceeded -eq 0 ] || exit 3
