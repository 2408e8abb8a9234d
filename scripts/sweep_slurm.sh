#!/usr/bin/env bash
#SBATCH --job-name=shadow-sweep
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --signal=B:TERM@60
# One shard of a sweep as a task of a Slurm array. The arguments are those of `shadow-inspector sweep`:
#
#   id=$(sbatch --parsable --array=1-16 scripts/sweep_slurm.sh stage --vary filter.kernel='*' -o out/stage)
#   sbatch --dependency=afterok:"$id" --wrap "shadow-inspector merge out/stage/shard-* -o out/stage/whole"
#
# Shard I goes into DIR/shard-I. A task that was cut off goes on where it was when the same array is submitted again.
# SHADOW_INSPECTOR names the program; else it is looked for in PATH.
set -euo pipefail

program=${SHADOW_INSPECTOR:-shadow-inspector}
fail() {
  printf 'sweep_slurm.sh: %s\n' "$*" >&2
  exit 2
}
: "${SLURM_ARRAY_TASK_ID:?is not set; submit this script with sbatch --array=1-N}"
first=${SLURM_ARRAY_TASK_MIN:-1}
count=${SLURM_ARRAY_TASK_COUNT:?is not set; submit this script with sbatch --array=1-N}
[ "${SLURM_ARRAY_TASK_STEP:-1}" -eq 1 ] || fail "the array must have a step of 1"
# A part of the array submitted again has another count; SWEEP_SHARDS then says how many there are in all.
index=$((SLURM_ARRAY_TASK_ID - first + 1))
if [ -n "${SWEEP_SHARDS:-}" ]; then
  count=$SWEEP_SHARDS
  index=$SLURM_ARRAY_TASK_ID
fi

arguments=()
folder=
while [ $# -gt 0 ]; do
  case $1 in
    -o | --output)
      [ $# -ge 2 ] || fail "$1: a folder is missing"
      folder=$2
      shift
      ;;
    --output=*) folder=${1#--output=} ;;
    --shard | --shard=*) fail "--shard is chosen by the array" ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
[ -n "$folder" ] || fail "-o DIR is missing"
mkdir -p "$folder"
# Replaces this shell, so that Slurm's signal reaches the program, which then writes what it has.
exec "$program" sweep "${arguments[@]}" --shard "$index/$count" -o "$folder/shard-$index"
