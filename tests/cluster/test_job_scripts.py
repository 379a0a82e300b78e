"""What the job scripts do by themselves: start, stop, requeue or not. With stand-ins for Slurm, mpirun and the program."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Takes the place of mpirun: notes its arguments, leaves a checkpoint if it is told to, waits for a signal, and ends as told.
LAUNCHER = """#!/bin/bash
echo "$*" >> "$LOG"
while [[ $# -gt 0 && $1 != --output ]]; do shift; done
[[ -z ${CHECKPOINT:-} ]] || touch "$2/checkpoint_$CHECKPOINT.h5"
if [[ -n ${WAIT:-} ]]; then
  trap 'echo "got USR1" >> "$LOG"; touch "$2/checkpoint_000000000099.h5"; sleep 0.2; exit 5' USR1
  touch "$2/waiting"
  for ((i = 0; i < 400; i++)); do sleep 0.05; done
fi
exit "${CODE:-0}"
"""
SCONTROL = """#!/bin/bash
echo "scontrol $*" >> "$LOG"
exit "${SCONTROL_CODE:-0}"
"""


class JobScripts(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.results = self.folder / "results with space"
        self.results.mkdir()
        self.log = self.folder / "log"
        for name, text in (("launcher", LAUNCHER), ("scontrol", SCONTROL), ("program", "#!/bin/sh\n")):
            (self.folder / name).write_text(text, encoding="utf-8")
            (self.folder / name).chmod(0o755)

    def start(self, script: str, *arguments: str | Path, **environment: str) -> subprocess.Popen[str]:
        variables = {
            "PATH": f"{self.folder}:{os.environ['PATH']}", "LOG": str(self.log), "SLURM_JOB_ID": "7", "SLURM_NTASKS": "3",
            "SPHDROP_LAUNCHER": str(self.folder / "launcher"), "SPHDROP_PROGRAM": str(self.folder / "program"), **environment,
        }
        # As Slurm does, from a copy elsewhere.
        copy = self.folder / "slurm_script"
        copy.write_text((ROOT / "jobs" / script).read_text(encoding="utf-8"), encoding="utf-8")
        return subprocess.Popen(["bash", str(copy), *map(str, arguments)], cwd=ROOT, env=variables, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def outcome(self, script: str, *arguments: str | Path, **environment: str) -> tuple[int, str, str]:
        """Exit code, what the script said, and what launcher and Slurm were asked for."""
        job = self.start(script, *arguments, **environment)
        said, _ = job.communicate(timeout=60)
        return job.returncode, said, self.log.read_text(encoding="utf-8") if self.log.exists() else ""

    def requeue(self, **environment: str) -> tuple[int, str, str]:
        return self.outcome("requeue.sbatch", "a case", self.results, "--until", "1e-3", **environment)

    def test_a_finished_run_ends_the_job(self) -> None:
        code, said, asked = self.requeue()
        self.assertEqual(code, 0, said)
        self.assertEqual(
            asked, f"-n 3 {self.folder}/program a case --output {self.results} --restart auto --until 1e-3\n")

    def test_a_stopped_run_is_requeued(self) -> None:
        for lost in ("5", "137", "205"):
            with self.subTest(code=lost):
                self.log.unlink(missing_ok=True)
                code, said, asked = self.requeue(CODE=lost, CHECKPOINT=f"0000000000{lost:0>2}")
                self.assertIn("scontrol requeue 7\n", asked, said)
                self.assertEqual(code, 0, said)

    def test_a_mistake_is_not_requeued(self) -> None:
        for mistake in ("1", "2", "3", "4"):
            with self.subTest(code=mistake):
                self.log.unlink(missing_ok=True)
                code, _, asked = self.requeue(CODE=mistake, CHECKPOINT=f"00000000000{mistake}")
                self.assertEqual(code, int(mistake))
                self.assertNotIn("scontrol", asked)

    def test_without_progress_there_is_no_requeue(self) -> None:
        (self.results / "checkpoint_000000000010.h5").touch()
        for kept in ({}, {"CHECKPOINT": "000000000010"}):
            code, said, asked = self.requeue(CODE="5", **kept)
            self.assertEqual(code, 5)
            self.assertIn("no new checkpoint", said)
            self.assertNotIn("scontrol", asked)

    def test_it_says_so_if_slurm_does_not_requeue(self) -> None:
        code, said, _ = self.requeue(CODE="5", CHECKPOINT="000000000001", SCONTROL_CODE="1")
        self.assertNotEqual(code, 0)
        self.assertIn("Submit the same job again", said)

    def signalled(self, which: signal.Signals) -> tuple[int, str, str]:
        job = self.start("requeue.sbatch", "a case", self.results, WAIT="1")
        end = time.monotonic() + 20
        while not (self.results / "waiting").exists():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)
        job.send_signal(which)
        said, _ = job.communicate(timeout=20)
        return job.returncode, said, self.log.read_text(encoding="utf-8")

    def test_the_warning_reaches_the_ranks(self) -> None:
        code, said, asked = self.signalled(signal.SIGUSR1)
        self.assertIn("got USR1\n", asked, said)
        self.assertIn("scontrol requeue 7\n", asked, said)
        self.assertEqual(code, 0)

    def test_a_cancelled_job_is_stopped_and_not_requeued(self) -> None:
        code, said, asked = self.signalled(signal.SIGTERM)
        self.assertIn("got USR1\n", asked, said)
        self.assertNotIn("scontrol", asked)
        self.assertEqual(code, 5)

    def test_one_run_gets_all_arguments(self) -> None:
        code, said, asked = self.outcome("run.sbatch", "a case", "--output", self.results, CODE="3")
        self.assertEqual(code, 3, said)
        self.assertEqual(asked, f"-n 3 {self.folder}/program a case --output {self.results}\n")

    def test_a_task_of_a_sweep_runs_its_row(self) -> None:
        (self.results / "run_001").mkdir()
        table = self.folder / "table.csv"
        table.write_text('solid.length,drop.velocity\n8e-3,"[0, -1]"\n9e-3,"[0, -2]"\n', encoding="utf-8")
        code, said, asked = self.outcome("sweep.sbatch", table, "a case", self.results, SLURM_ARRAY_TASK_ID="1")
        self.assertEqual(code, 0, said)
        self.assertIn(f"--output {self.results}/run_001 --restart auto --set=solid.length=9e-3 --set=drop.velocity=[0, -2]\n", asked)
        code, said, _ = self.outcome("sweep.sbatch", table, "a case", self.results, SLURM_ARRAY_TASK_ID="2")
        self.assertEqual(code, 2)
        self.assertIn("there is no run 2; there are 0 to 1", said)

    def test_all_explain_how_they_are_used(self) -> None:
        scripts = sorted(path.name for path in (ROOT / "jobs").glob("*.sbatch"))
        self.assertEqual(len(scripts), 5)
        for script in scripts:
            with self.subTest(script=script):
                code, said, asked = self.outcome(script)
                self.assertEqual(code, 2)
                self.assertIn(f"Usage: sbatch ", said)
                self.assertIn(f"jobs/{script}", said)
                self.assertEqual(asked, "")
                self.assertIn(f"jobs/{script}", (ROOT / "jobs" / script).read_text(encoding="utf-8").partition("#SBATCH")[0])

    def test_a_missing_program_is_named(self) -> None:
        for script in ("run.sbatch", "requeue.sbatch"):
            code, said, _ = self.outcome(script, "a case", self.results, SPHDROP_PROGRAM="build/nowhere/sphdrop")
            self.assertEqual(code, 2)
            self.assertIn("there is no program", said)
            self.assertIn("build/nowhere/sphdrop", said)


if __name__ == "__main__":
    unittest.main()
