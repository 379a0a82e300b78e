# shellcheck shell=bash
# What the job scripts of this folder share; they read it in. It looks at these variables, which sbatch passes on:
#   SPHDROP_PROGRAM   the program, if it is neither build/release/src/sphdrop nor the sphdrop of the path
#   SPHDROP_LAUNCHER  what starts the ranks, given -n and their number, if it is not "mpirun"; where Slurm has PMIx,
#                     "srun --mpi=pmix --kill-on-bad-exit=1" does as well
#   SPHDROP_PYTHON    a Python 3.11 with numpy and h5py, if it is not /usr/bin/python3

program=${SPHDROP_PROGRAM:-build/release/src/sphdrop}
[[ -x $program || -n ${SPHDROP_PROGRAM:-} ]] || program=$(command -v sphdrop || printf '%s' "$program")
ranks=${SLURM_NTASKS:-1}
read -ra launcher <<<"${SPHDROP_LAUNCHER:-mpirun}"

# For Open MPI 4, others do not look at them: a host that has fallen silent ends the run after 25 s instead of hanging it.
export OMPI_MCA_oob_tcp_keepalive_time=${OMPI_MCA_oob_tcp_keepalive_time:-10}
export OMPI_MCA_oob_tcp_keepalive_intvl=${OMPI_MCA_oob_tcp_keepalive_intvl:-5}
export OMPI_MCA_oob_tcp_keepalive_probes=${OMPI_MCA_oob_tcp_keepalive_probes:-3}

say() {
  printf 'sphdrop job %s: %s\n' "${SLURM_JOB_ID:-without number}" "$1"
}

fail() {
  say "$1" >&2
  exit 2
}

[[ -x $program ]] || fail "there is no program $program (in $PWD). Submit from the root of the repository, with the program
built there (cmake --preset release && cmake --build --preset release), or name it: SPHDROP_PROGRAM=... sbatch ..."

child=''
cancelled=false

# mpirun and srun pass SIGUSR1 on to all ranks at once; of SIGTERM they would make an end of their own.
stop_ranks() {
  say "SIG$1 came, stopping the run"
  [[ -z $child ]] || kill -s USR1 "$child" 2>/dev/null
}

# simulate ARGUMENTS...: runs the program on $ranks ranks and returns its exit code. Slurm's signal before the time limit
# comes to this shell alone; it has to be awake to pass it on, so the program runs in the background.
simulate() {
  trap 'stop_ranks USR1' USR1
  trap 'cancelled=true; stop_ranks TERM' TERM
  "${launcher[@]}" -n "$ranks" "$program" "$@" &
  child=$!
  # A signal ends the waiting, not the run.
  while kill -0 "$child" 2>/dev/null; do
    wait "$child"
  done
  wait "$child"
  local code=$?
  child=''
  return "$code"
}

# newest_checkpoint FOLDER: its name, which says the step; nothing if there is none.
newest_checkpoint() {
  local files=("$1"/checkpoint_*.h5)
  [[ ! -e ${files[-1]} ]] || printf '%s\n' "${files[-1]}"
}

# simulate_and_requeue CASE FOLDER ARGUMENTS...: goes on with the run in the folder, or begins it, and has Slurm put the
# job back into the queue if the run was stopped before its end. Ends the script.
simulate_and_requeue() {
  local before code after
  before=$(newest_checkpoint "$2")
  say "start number $((${SLURM_RESTART_COUNT:-0} + 1)) on $(hostname), from ${before:-the beginning}"
  simulate "$1" --output "$2" --restart auto "${@:3}"
  code=$?
  after=$(newest_checkpoint "$2")
  if $cancelled; then
    say "cancelled or out of time (exit code $code), not requeued; the newest checkpoint is ${after:-none}"
    exit "$code"
  fi
  # 5: stopped in good order. More than 128: a rank or a host was lost. The program's own refusals, 1 to 4, would only be
  # repeated.
  if ((code != 5 && code <= 128)); then
    say "ended with exit code $code"
    exit "$code"
  fi
  # Without this a job whose time limit is too short for even one checkpoint would come back for ever.
  if [[ $after == "$before" ]]; then
    say "exit code $code and no new checkpoint since the start: not requeued" >&2
    exit "$code"
  fi
  say "exit code $code, the newest checkpoint is $after: requeueing"
  # Slurm kills this script for it, as a rule before the next line.
  scontrol requeue "$SLURM_JOB_ID" || fail "Slurm does not requeue it. Submit the same job again: it goes on from there"
  exit 0
}

# measure_scaling CASE FOLDER ARGUMENTS...: runs the case on 1, 2, 4, ... ranks up to all, three times each as the fastest
# counts, and makes the table; beyond one rank with what settings_for CASE RANKS prints, given the first run's effective
# case. Ends the script.
measure_scaling() {
  local python=${SPHDROP_PYTHON:-/usr/bin/python3} most=$ranks lines settings code repeat
  # A rank stays on its core, and nothing but steps is measured: no snapshots between first and last, no checkpoints.
  export OMPI_MCA_hwloc_base_binding_policy=${OMPI_MCA_hwloc_base_binding_policy:-core}
  for ((ranks = 1; ; ranks = 2 * ranks < most ? 2 * ranks : most)); do
    lines=''
    if ((ranks > 1)); then
      lines=$(settings_for "$2/ranks_00001_1/case.cfg" "$ranks") || exit 2
    fi
    read -r -d '' -a settings <<<"$lines"
    for repeat in 1 2 3; do
      simulate "$1" --output "$2/ranks_$(printf '%05d' "$ranks")_$repeat" --fresh --quiet "${@:3}" \
        --set output.snapshot_interval=0 --set checkpoint.wall_interval=0 "${settings[@]}"
      code=$?
      ((code == 0)) || fail "the run on $ranks ranks ended with exit code $code"
    done
    ((ranks < most)) || break
  done
  "$python" jobs/scaling.py table "$2"
  exit
}
