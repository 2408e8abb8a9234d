#!/usr/bin/env bash
# Draws the golden picture and the documentation of one technique; all other rows stay as they are.
# usage: scripts/document_technique.sh [--programs DIR] KEY=CHOICE
#   KEY=CHOICE        a row of a table of techniques, as --set takes it: filter.kernel=tent3
#   --programs DIR    takes shadow-inspector and draw_golden from DIR instead of building them in build/release
# It writes tests/golden/TABLE-CHOICE.png, the row's line and picture in docs/techniques.md and docs/techniques/
# (where that page has a table of KEY), and docs/settings.md. Look at the pictures before you commit them.
# Exit code: 0 done, 1 a command failed, 2 the row or an option is unknown.
set -euo pipefail

usage_error() {
  echo "document_technique.sh: $1 (see scripts/document_technique.sh --help)" >&2
  exit 2
}

programs="" row=""
while [ $# -gt 0 ]; do
  case $1 in
  -h | --help)
    sed -n '2,/^set /s/^# //p' "${BASH_SOURCE[0]}"
    exit
    ;;
  --programs)
    [ $# -gt 1 ] || usage_error "--programs needs a folder"
    programs=$(realpath -- "$2")
    shift
    ;;
  -*) usage_error "no option $1" ;;
  *)
    [ -z "$row" ] || usage_error "more than one row: $row and $1"
    row=$1
    ;;
  esac
  shift
done
[ -n "$row" ] || usage_error "which row? For example filter.kernel=tent3"
[[ $row == ?*=?* ]] || usage_error "a row is KEY=CHOICE, not $row"

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# The golden pictures and the page's numbers are llvmpipe's.
export LIBGL_ALWAYS_SOFTWARE=1
if [ -z "$programs" ]; then
  build=build/release
  cmake -S . --preset release -DSI_BUILD_TESTS=ON >/dev/null || exit 1
  cmake --build "$build" --target shadow-inspector draw_golden || exit 1
  golden=$build/tests/draw_golden
  program=$build/shadow-inspector
else
  golden=$programs/draw_golden
  program=$programs/shadow-inspector
fi
for file in "$golden" "$program"; do
  [ -x "$file" ] || usage_error "there is no program $file"
done

"$golden" -o tests/golden "$row"
"$program" docs settings -o docs/settings.md
echo "docs/settings.md"
if grep -qF "\`${row%%=*}\`. " docs/techniques.md; then
  "$program" docs techniques -o docs/techniques.md --only "$row"
  echo "docs/techniques.md"
fi
