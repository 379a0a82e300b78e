#!/usr/bin/env bash
# From a bare Debian 12 to the results of a drop falling on a cantilever: installs, builds, simulates, draws.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/quickstart.sh [--again] [--no-install]
Installs what is missing, builds sphdrop, lets a drop fall on a cantilever (cases/quickstart, about a minute) and draws
the figures. What is already done is not done again.
  --again       run the simulation anew even if its results are there
  --no-install  use the tools and libraries that are there
TEXT
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
program=$build/src/sphdrop
case_file=$root/cases/quickstart/case.cfg
results=$root/results/quickstart
ranks=2
time_limit=1h

again=false
install=true
for argument in "$@"; do
  case $argument in
    --again) again=true ;;
    --no-install) install=false ;;
    --help | -h) usage && exit 0 ;;
    *)
      usage >&2
      printf 'quickstart.sh: there is no option %q\n' "$argument" >&2
      exit 2
      ;;
  esac
done

step='starting'
announce() {
  step=$1
  printf '\n== %s\n' "$step"
}
explain_failure() {
  local code=$?
  ((code == 0)) || printf '\nquickstart.sh: failed at "%s" (exit code %d); the messages above say why.\n' "$step" "$code" >&2
}
trap explain_failure EXIT
trap 'printf "\n"; exit 130' INT
trap 'exit 143' TERM

# A build folder that was copied or moved along with the sources still names the old ones.
is_configured() {
  [[ -f $build/build.ninja && -f $build/CMakeCache.txt ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"
}

build_program() {
  cd "$root"
  # A tree already configured, perhaps with its tests, stays as it is and is brought up to date by the build itself.
  if ! is_configured; then
    # Were this to fail half-way, an old build.ninja would pass for a configured tree the next time.
    rm -f "$build/build.ninja"
    cmake --preset release --fresh -DSPHDROP_TESTS=OFF
  fi
  cmake --build --preset release --target sphdrop --parallel "$(nproc)"
}

# What the results hang on and the results themselves: the sums fail as soon as one of these files has changed.
record_results() {
  sha256sum "$program" "$case_file" "$results"/{case.cfg,run.json,history.csv,snapshots.vtkhdf.series} >"$results/complete.sha256"
}
results_are_there() {
  [[ -f $results/complete.sha256 ]] && sha256sum --check --status "$results/complete.sha256" 2>/dev/null
}

simulate() {
  local launcher
  launcher=$(sed -n 's/^MPIEXEC_EXECUTABLE:[^=]*=//p' "$build/CMakeCache.txt")
  # One machine, shared memory alone: no network is looked for, and copying through the kernel, which containers forbid,
  # is not tried. Bound to no core, since others may be bound to the same; and a rank that waits lets others go first,
  # without which two ranks on a busy machine crawl.
  local options=(-n "$ranks" --bind-to none --use-hwthread-cpus
    --mca mpi_yield_when_idle 1 --mca pml ob1 --mca btl self,vader --mca btl_vader_single_copy_mechanism none)
  if (($(nproc) < ranks)); then
    options+=(--oversubscribe)
  fi
  if ((EUID == 0)); then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
  rm -f "$results/complete.sha256"
  timeout --foreground --kill-after=10 "$time_limit" "$launcher" "${options[@]}" \
    "$program" "$case_file" --output "$results" </dev/null
  grep -q '"status": *"completed"' "$results/run.json"
  record_results
}

draw_figures() {
  # Debian's Python, whose numpy, h5py and matplotlib were installed above; a virtual environment may lack them.
  PYTHONPATH='' MPLBACKEND=Agg /usr/bin/python3 "$root/cases/figures.py" "$results"
}

if $install; then
  announce 'Installing packages'
  "$root/jobs/install_packages.sh"
fi

announce 'Building sphdrop'
build_program

announce "Simulating a drop on a cantilever, on $ranks ranks"
if ! $again && results_are_there; then
  printf 'The results are there already; --again runs the simulation anew.\n'
else
  simulate
fi

announce 'Drawing the figures'
draw_figures

for file in history.csv snapshots.vtkhdf.series picture.png strip.png history.png; do
  if [[ ! -s $results/$file ]]; then
    printf '%s is missing.\n' "$results/$file" >&2
    exit 1
  fi
done

printf '\nDone. The results are in %s:\n' "$results"
printf '  %-24s %s\n' \
  history.csv 'history: width of the drop, deflection of the beam, energies, ... over time' \
  snapshots.vtkhdf.series 'all particles over time, for ParaView: File, Open' \
  picture.png 'the widest drop on the bent beam' \
  strip.png 'the impact from beginning to end' \
  history.png 'the history, drawn'
