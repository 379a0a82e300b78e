#!/usr/bin/env bash
# Submits a table of runs to Slurm, and the job that collects their results into one table.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/sweep.sh TABLE CASE FOLDER [options of sbatch]
Submits, from the root of the repository, a job array with one task for each row of TABLE (see jobs/sweep_table.csv),
which runs CASE with that row's parameters into FOLDER/run_000, FOLDER/run_001, ..., and a job that writes
FOLDER/sweep.csv when they have ended: parameters, contact time, largest width and deflection, restitution, state hash.
The options, such as --ntasks=4 --time=4:00:00 --account=NAME, are those of each run. What is finished is not run again.
TEXT
}

fail() {
  printf 'sweep.sh: %s\n' "$1" >&2
  exit 2
}

case ${1:-} in
  --help | -h) usage && exit 0 ;;
  -*) usage >&2 && fail "there is no option '$1' before TABLE" ;;
esac
(($# > 2)) || { usage >&2 && fail 'TABLE, CASE and FOLDER are needed'; }
table=$1 case_file=$2 folder=$3
shift 3
[[ -f jobs/sweep.sbatch ]] || fail 'it must be started in the root of the repository'
[[ -f $case_file ]] || fail "there is no case $case_file"
command -v sbatch >/dev/null || fail 'there is no sbatch: this takes a computer with Slurm'

# A Python 3.11 with numpy and h5py.
python=${SPHDROP_PYTHON:-/usr/bin/python3}
count=$("$python" cases/sphdrop-sweep count "$table")
mkdir -p "$folder"
array=$(sbatch --parsable --array="0-$((count - 1))" --output="$folder/sphdrop_%A_%a.log" "$@" \
  jobs/sweep.sbatch "$table" "$case_file" "$folder")
array=${array%%;*}
# Last of all, and not for the lack of one run; it says which are missing.
printf -v collect '%q ' "$python" cases/sphdrop-sweep collect "$table" "$folder"
collecting=$(sbatch --parsable "$@" --dependency="afterany:$array" --nodes=1 --ntasks=1 --time=0:10:00 \
  --job-name=sphdrop_collect --output="$folder/collect_%j.log" --wrap "$collect")
printf 'Submitted %d runs as job %s, and job %s to collect them in %s/sweep.csv\n' \
  "$count" "$array" "${collecting%%;*}" "$folder"
