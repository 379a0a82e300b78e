#!/usr/bin/env bash
# Installs what is needed, builds everything and runs every test, the sanitizers and the linters.
set -uo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/run.sh [--quick] [--no-install]
  --quick       only the tests of the release build: no sanitizers, no clang-format, no clang-tidy
  --no-install  use the tools and libraries that are there
The last line counts CTest's tests of all builds; a failure of anything else counts as one failed.
TEXT
}

quick=false
install=true
for argument in "$@"; do
  case $argument in
    --quick) quick=true ;;
    --no-install) install=false ;;
    --help | -h) usage && exit 0 ;;
    *)
      usage >&2
      printf 'run.sh: there is no option %q\n' "$argument" >&2
      exit 2
      ;;
  esac
done

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1
cores=$(nproc)
reports=$root/build/reports
passed=0
failed=0
summary=()

# stage NAME COMMAND...: runs it, takes its time and goes on whatever comes of it.
stage() {
  local name=$1 start=$SECONDS outcome=ok
  shift
  printf '\n== %s\n' "$name"
  if ! "$@"; then
    outcome=FAILED
    failed=$((failed + 1))
  fi
  summary+=("$(printf '%-34s %4d s  %s' "$name" $((SECONDS - start)) "$outcome")")
  [[ $outcome == ok ]]
}

# Adds what a CTest report counts; a test that could not be run is a failed one. Fails if there is no report, or if
# CTest complains of what its report does not show.
count() {
  local code=$1 report=$2 counts
  counts=$(python3 - "$report" <<'PYTHON'
import sys
import xml.etree.ElementTree as tree

passed = failed = 0
for case in tree.parse(sys.argv[1]).getroot().iter("testcase"):
    skipped = case.find("skipped")
    if case.get("status") == "run":
        passed += 1
    elif case.get("status") != "disabled" and (skipped is None or not skipped.get("message", "").startswith("SKIP_")):
        failed += 1
print(passed, failed)
PYTHON
  ) || return 1
  read -r report_passed report_failed <<<"$counts"
  printf '%s passed, %s failed here\n' "$report_passed" "$report_failed"
  passed=$((passed + report_passed))
  failed=$((failed + report_failed))
  ((report_passed > 0)) && ((code == 0 || report_failed > 0))
}

# tests NAME ARGUMENTS...: a stage that runs CTest. Its failed tests are counted, not the stage.
tests() {
  local name=$1 start=$SECONDS outcome=ok report code failed_before=$failed
  shift
  report=$reports/${name//[^a-z]/_}.xml
  rm -f "$report"
  printf '\n== %s\n' "$name"
  ctest "$@" --parallel "$cores" --output-on-failure --output-junit "$report"
  code=$?
  if ! count "$code" "$report"; then
    printf 'run.sh: CTest ended with %d and no report of its tests that explains it.\n' "$code" >&2
    failed=$((failed + 1))
  fi
  ((failed == failed_before)) || outcome=FAILED
  summary+=("$(printf '%-34s %4d s  %s' "$name" $((SECONDS - start)) "$outcome")")
}

check_format() {
  git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run --Werror
}

# Over all files of the program; what it says of each file that is clean is left out, and so are the colours. The analyzer
# looks at templates by themselves, not anew at every call: that would take half of all the time, most of it in libraries.
check_lint() {
  run-clang-tidy -quiet -j "$cores" -p build/release -extra-arg=-Wno-unknown-warning-option \
    -extra-arg=-Xclang -extra-arg=-analyzer-config -extra-arg=-Xclang -extra-arg=c++-template-inlining=false \
    "^$root/(src|decomposition|io)/" 2>&1 | sed -E 's/\x1b\[[0-9;]*m//g; /^clang-tidy /d; /^[0-9]+ warnings? generated\.$/d'
  return "${PIPESTATUS[0]}"
}

mkdir -p "$reports"
if $install; then
  stage 'install packages' jobs/install_packages.sh --tests
fi
if stage 'configure release' cmake --preset release; then
  if stage 'build release' cmake --build --preset release --parallel "$cores"; then
    tests 'test release' --preset release
  fi
fi
if ! $quick; then
  if stage 'configure sanitize' cmake --preset sanitize &&
    stage 'build sanitize' cmake --build --preset sanitize --parallel "$cores" --target sphdrop tests/unit/all tests/mpi/all; then
    tests 'unit tests sanitize' --test-dir build/sanitize/tests/unit
    tests 'mpi tests sanitize' --test-dir build/sanitize/tests/mpi
  fi
  stage 'clang-format' check_format
  stage 'clang-tidy' check_lint
fi

printf '\n'
printf '%s\n' "${summary[@]}"
printf '%-34s %4d s\n' total "$SECONDS"
printf '%d passed, %d failed\n' "$passed" "$failed"
((failed == 0 && passed > 0))
