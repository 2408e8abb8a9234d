#!/usr/bin/env bash
# Draws jobs in Babylon.js: run.sh JOB... writes mask.pgm and facts.json into each folder.
exec "$(dirname "${BASH_SOURCE[0]}")/../browser/run.sh" babylon "$@"
