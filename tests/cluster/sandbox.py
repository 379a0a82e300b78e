"""A corner of the machine of the tests' own: processes, network, host name, temporary files and shared memory.

What is started in it ends with it, however the test ends, even if it is killed; a Slurm or a network that the machine has is
neither seen nor touched. Linux's namespaces do that; they take root.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

# CTest takes this exit code for a skipped test (SKIP_RETURN_CODE).
SKIPPED = 77
HOST_NAME = "node"
ADDRESS = "192.0.2.1"  # kept for examples: nobody's
FOLDER = Path("/run/sphdrop")  # on a file system of the sandbox's own
_INSIDE = "SPHDROP_SANDBOX"
_UNSHARE = ("unshare", "--pid", "--fork", "--kill-child=SIGKILL", "--mount", "--mount-proc", "--net", "--uts", "--ipc")


def skip(reason: str) -> NoReturn:
    print(f"skipped: {reason}", flush=True)
    sys.exit(SKIPPED)


def run_tests_inside(tools: Sequence[str]) -> NoReturn:
    """Runs the tests of the program's file inside, and ends. Where that is impossible, or a tool is missing, it says so and
    ends as skipped; so it does if all tests are skipped."""
    if _INSIDE not in os.environ:
        if os.geteuid() != 0:
            skip("takes root, for namespaces")
        missing = [tool for tool in ("unshare", "nsenter", "ip", "mount", *tools) if shutil.which(tool) is None]
        if missing:
            skip(f"{', '.join(missing)} missing; jobs/install_packages.sh --tests installs what it takes")
        tried = subprocess.run([*_UNSHARE, "mount", "-t", "tmpfs", "sphdrop", "/run"], capture_output=True, text=True, check=False)
        if tried.returncode != 0:
            skip(f"no namespaces here: {tried.stderr.strip()}")
        sys.stdout.flush()
        # The first process of the namespace is a shell, which takes care of orphans; when it ends all others do.
        os.execvpe(_UNSHARE[0], [*_UNSHARE, "bash", "-c", '"$@"; exit $?', "init", sys.executable, "-B", *sys.argv],
                   {**os.environ, _INSIDE: "1"})
    _furnish()
    program = unittest.main(exit=False)
    result = program.result
    if result.wasSuccessful() and (result.testsRun == 0 or len(result.skipped) >= result.testsRun):
        skip("; ".join(sorted({reason for _, reason in result.skipped})))
    sys.exit(0 if result.wasSuccessful() else 1)


def _furnish() -> None:
    for folder in ("/run", "/dev/shm"):
        call("mount", "-t", "tmpfs", "-o", "mode=1777", "sphdrop", folder)
    FOLDER.mkdir(mode=0o755)
    temporary = FOLDER / "tmp"
    temporary.mkdir()
    os.environ["TMPDIR"] = str(temporary)
    call("hostname", HOST_NAME)
    hosts = FOLDER / "hosts"
    hosts.write_text(f"127.0.0.1 localhost\n{ADDRESS} {HOST_NAME}\n", encoding="utf-8")
    call("mount", "--bind", hosts, "/etc/hosts")
    call("ip", "link", "set", "lo", "up")
    # Neither Slurm nor Open MPI starts on a machine that has loopback alone.
    call("ip", "link", "add", "here", "type", "veth", "peer", "name", "there")
    call("ip", "address", "add", f"{ADDRESS}/24", "dev", "here")
    for end in ("here", "there"):
        call("ip", "link", "set", end, "up")


def call(*command: str | Path, timeout: float = 60, **options: object) -> str:
    """What a command prints; RuntimeError with all it said if it fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=timeout, stdin=subprocess.DEVNULL,
                          **options)  # type: ignore[call-overload]
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(words)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return str(done.stdout)
