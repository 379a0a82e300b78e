#!/usr/bin/env bash
# Installs the Debian packages that sphdrop needs. Needs neither root nor network where all of them are there already.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: jobs/install_packages.sh [--packaging] [--tests] [--list]
Installs the Debian 12 packages needed to build and run sphdrop.
  --packaging  also those needed to make a Debian package of it
  --tests      also those needed to build and run the tests, of which making a package is one
  --list       only print the packages' names
TEXT
}

fail() {
  printf 'install_packages.sh: %s\n' "$1" >&2
  exit 1
}

packages=(
  g++ cmake ninja-build
  openmpi-bin libopenmpi-dev
  libhdf5-openmpi-dev hdf5-tools
  libmetis-dev libxxhash-dev libeigen3-dev libtoml11-dev libcli11-dev libfmt-dev
  python3 python3-numpy python3-h5py python3-matplotlib
)
packages_of_packaging=(file dpkg-dev)
packages_of_tests=("${packages_of_packaging[@]}" git libgtest-dev libbenchmark-dev clang libclang-rt-14-dev clang-format clang-tidy python3-vtk9 iproute2 valgrind)
# The tests start a Slurm of their own. Where there is one already, perhaps of another origin, nothing is added to it.
if ! command -v sbatch >/dev/null; then
  packages_of_tests+=(slurmctld slurmd slurm-client munge)
fi

list_only=false
for argument in "$@"; do
  case $argument in
    --packaging) packages+=("${packages_of_packaging[@]}") ;;
    --tests) packages+=("${packages_of_tests[@]}") ;;
    --list) list_only=true ;;
    --help | -h) usage && exit 0 ;;
    *) usage >&2 && fail "there is no option '$argument'" ;;
  esac
done
if $list_only; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this is no Debian system (dpkg-query and apt-get are missing). Install the equivalents of these packages by your
system's own means, then build as README.md says: ${packages[*]}"
fi

missing_packages() {
  local package status
  for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || printf '%s\n' "$package"
  done
}

mapfile -t missing < <(missing_packages)
if ((${#missing[@]} == 0)); then
  printf 'All %d packages needed are installed.\n' "${#packages[@]}"
  exit 0
fi
printf 'Installing: %s\n' "${missing[*]}"

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || fail "installing packages takes root, and there is no sudo. Have an administrator run:
  apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo)
  # Without a terminal a question for a password would never be answered.
  [[ -t 0 ]] || as_root+=(--non-interactive)
  "${as_root[@]}" true || fail "installing packages takes root, and sudo refuses it. Have an administrator run:
  apt-get install --no-install-recommends ${missing[*]}"
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes \
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" </dev/null
}

apt update || printf 'install_packages.sh: the package lists could not be brought up to date; trying with the old ones.\n' >&2
apt install --no-install-recommends "${missing[@]}" ||
  fail "apt-get could not install: ${missing[*]}. Its messages above say why."

mapfile -t missing < <(missing_packages)
((${#missing[@]} == 0)) || fail "still not installed: ${missing[*]}"
printf 'Installed.\n'
