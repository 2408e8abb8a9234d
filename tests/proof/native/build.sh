#!/usr/bin/env bash
# Compiles an engine program in C++ where it has changed: build.sh NAME PACKAGE FLAGS... prints its path. Exit code 77: a
# package is missing, which the last line names.
set -euo pipefail
name=$1
package=$2
shift 2
for command in g++ xvfb-run; do
  if ! command -v "$command" >/dev/null; then
    echo "lacks $command" >&2
    exit 77
  fi
done
if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
  echo "lacks the Debian package $package" >&2
  exit 77
fi
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${SI_PROOF_FOLDER:-$source/../../build/proof}/$name
mkdir -p "$folder"
program=$folder/$name
if [ ! -x "$program" ] || [ "$source/$name/$name.cpp" -nt "$program" ] || [ "$source/native/job.h" -nt "$program" ]; then
  g++ -std=c++20 -O1 -w -I"$source" "$source/$name/$name.cpp" -o "$program" "$@"
fi
echo "$program"
