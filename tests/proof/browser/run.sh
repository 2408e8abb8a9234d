#!/usr/bin/env bash
# Draws jobs in an engine from npm in a headless browser: run.sh ENGINE JOB... Each JOB is a folder with job.json.
# Without a JOB it installs alone. Exit code 77: a package is missing, which the last line names.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
engine=$1
shift
for command in node npm chromium; do
  if ! command -v "$command" >/dev/null; then
    echo "lacks $command" >&2
    exit 77
  fi
done
folder=${SI_PROOF_FOLDER:-$here/../../../build/proof}/npm-$engine
mkdir -p "$folder"
lock=$here/../$engine/package-lock.json
if ! cmp -s "$lock" "$folder/installed.json"; then
  rm -f "$folder/installed.json"
  cp "$here/../$engine/package.json" "$lock" "$folder"
  if ! text=$(cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund 2>&1); then
    echo "$text" >&2
    # A lock that does not fit is an error, a registry that does not answer is not.
    if grep -qE 'EINTEGRITY|EUSAGE' <<<"$text"; then exit 1; fi
    echo "lacks $engine from npm" >&2
    exit 77
  fi
  cp "$lock" "$folder/installed.json"
fi
if [ $# -eq 0 ]; then exit; fi
profile=$(mktemp -d)
# The browser's last processes may still write there.
trap 'rm -rf "$profile" 2>/dev/null || true' EXIT
node "$here/serve.mjs" "$here/../$engine" "$folder/node_modules" "$profile" "$@"
