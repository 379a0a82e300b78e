"""A Slurm of one node, for as long as a test takes; inside the sandbox, whose other programs do not meet it."""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
import time
from pathlib import Path

from sandbox import ADDRESS, HOST_NAME, call

TOOLS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "scancel")

# Three cores whatever the machine has. Requeued jobs wait for the life of a credential, two minutes by default. RequeueExit is
# not set, as on most clusters.
CONFIGURATION = """
ClusterName=private
SlurmctldHost={host}({address})
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=bf_interval=1,sched_interval=1,batch_sched_delay=0
ReturnToService=2
KillWait=10
SlurmdTimeout=10
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr={address} CPUs=3 RealMemory=1000 State=UNKNOWN
PartitionName=tests Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
OVER = ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "OUT_OF_MEMORY", "BOOT_FAIL", "DEADLINE")


class SlurmError(Exception):
    """Slurm could not be started, or a job did not come to the state that was waited for; the text says what it said."""


class PrivateSlurm:
    """Started when made; it ends with the sandbox."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("", "munge", "state", "spool"):
            (folder / name).mkdir(mode=0o755)
        key = folder / "munge" / "key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(128))
        # Of a job in which the tests themselves may run.
        for name in [name for name in os.environ if name.startswith(("SLURM", "SBATCH_"))]:
            del os.environ[name]
        configuration = folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(host=HOST_NAME, address=ADDRESS, folder=folder), encoding="utf-8")
        os.environ["SLURM_CONF"] = str(configuration)
        self._daemons: list[subprocess.Popen[bytes]] = []
        self._start("munged", "--foreground", "--num-threads=2", f"--socket={folder}/munge/socket", f"--key-file={key}",
                    f"--pid-file={folder}/munge/pid", f"--seed-file={folder}/munge/seed")
        self._wait("munge", lambda: (folder / "munge" / "socket").exists())
        self._start("slurmctld", "-D", "-c")
        self._start("slurmd", "-D", "-N", HOST_NAME)
        self._wait("an idle node", lambda: "State=IDLE " in self._node())

    def _start(self, *command: str) -> None:
        with (self.folder / f"{command[0]}.out").open("wb") as stream:
            self._daemons.append(
                subprocess.Popen(command, stdout=stream, stderr=stream, stdin=subprocess.DEVNULL, start_new_session=True))

    def _node(self) -> str:
        done = subprocess.run(["scontrol", "--oneliner", "show", "node", HOST_NAME], capture_output=True, text=True, check=False)
        return done.stdout + " "

    def _wait(self, what: str, reached: object, timeout: float = 20) -> None:
        end = time.monotonic() + timeout
        while not reached():  # type: ignore[operator]
            if time.monotonic() > end or any(daemon.poll() is not None for daemon in self._daemons):
                raise SlurmError(f"Slurm did not start, {what} is missing:\n{self.logs()}")
            time.sleep(0.05)

    def logs(self) -> str:
        """The last lines of what the daemons said."""
        parts = []
        for path in sorted([*self.folder.glob("*.log"), *self.folder.glob("*.out")]):
            lines = path.read_text(encoding="utf-8", errors="replace").splitlines()[-12:]
            parts.append("\n".join([f"-- {path.name}", *lines]))
        return "\n".join(parts)

    def submit(self, *arguments: str | Path, **options: object) -> str:
        """The number of a job given to sbatch."""
        return call("sbatch", "--parsable", *arguments, **options).strip()

    def job(self, number: str) -> dict[str, str]:
        """What scontrol says of a job (of an array's first task)."""
        line = call("scontrol", "--oneliner", "show", "job", number).splitlines()[0]
        return dict(re.findall(r"(\S+?)=(\S*)", line))

    def warn(self, number: str) -> None:
        """Gives a job's script the signal that Slurm itself gives before the time limit, which it looks at twice a minute."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            # Of an array's task scancel does not notice that it has done its work, and would signal the next start too.
            subprocess.run(["scancel", "--batch", "--signal=USR1", number], capture_output=True, check=False, timeout=1)

    def wait_for_end(self, number: str, timeout: float) -> dict[str, str]:
        """The job when it is over, not only waiting for its next start."""
        end = time.monotonic() + timeout
        while True:
            job = self.job(number)
            if job["JobState"] in OVER:
                return job
            if time.monotonic() > end:
                raise SlurmError(f"job {number} is {job['JobState']} ({job['Reason']}) after {timeout:.0f} s:\n{self.logs()}")
            time.sleep(0.1)
