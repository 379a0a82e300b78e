"""Two hosts on one machine: network and host name of their own, joined by a switch, with nothing but TCP between them.

Inside the sandbox; they end with it.
"""

from __future__ import annotations

import os
import subprocess
import time
from pathlib import Path

from sandbox import FOLDER, call

NETWORK = "198.51.100"  # kept for examples: nobody's
NAMES = ("left", "right")

# What mpirun calls in place of ssh: the host's address, then a command for its shell.
AGENT = """#!/bin/bash
host=$1
shift
exec nsenter --target="$(cat "{folder}/$host")" --net --uts -- sh -c "$*"
"""


class TwoHosts:
    """Started when made."""

    def __init__(self) -> None:
        self._folder = FOLDER / "hosts_by_address"
        self._folder.mkdir()
        self._agent = self._folder / "agent"
        self._agent.write_text(AGENT.format(folder=self._folder), encoding="utf-8")
        self._agent.chmod(0o755)
        call("ip", "link", "add", "switch", "type", "bridge")
        call("ip", "link", "set", "switch", "up")
        self._hosts: list[subprocess.Popen[bytes]] = []
        self._session = 0
        self.addresses = [f"{NETWORK}.{number}" for number, _ in enumerate(NAMES, start=1)]
        for name, address in zip(NAMES, self.addresses):
            self._add(name, address)

    def _add(self, name: str, address: str) -> None:
        host = subprocess.Popen(["unshare", "--net", "--uts", "sleep", "infinity"])
        self._hosts.append(host)
        own = Path("/proc/self/ns/net").readlink()
        while Path(f"/proc/{host.pid}/ns/net").readlink() == own:
            time.sleep(0.01)
        (self._folder / address).write_text(str(host.pid), encoding="utf-8")
        call("ip", "link", "add", f"to_{name}", "master", "switch", "type", "veth", "peer", "name", "network", "netns", str(host.pid))
        call("ip", "link", "set", f"to_{name}", "up")
        inside = ("nsenter", f"--target={host.pid}", "--net", "--uts", "--")
        call(*inside, "hostname", name)
        for command in (f"address add {address}/24 dev network", "link set network up", "link set lo up"):
            call(*inside, "ip", *command.split())

    def cut_off(self, name: str) -> None:
        """As if the host's cable were pulled."""
        call("ip", "link", "set", f"to_{name}", "down")

    def reconnect(self, name: str) -> None:
        call("ip", "link", "set", f"to_{name}", "up")

    def mpirun(self, ranks_each: int, *command: str | Path) -> subprocess.Popen[str]:
        """Starts mpirun on the first host, with ranks on both."""
        # The daemon of a run that was cut off cleans up after itself a while later; a new one must not lose its folder to it,
        # for then mpirun would wait for it for ever.
        self._session += 1
        session = self._folder / f"session_{self._session}"
        session.mkdir()
        hosts = ",".join(f"{address}:{ranks_each}" for address in self.addresses)
        options = {
            "plm_rsh_agent": self._agent, "plm_rsh_no_tree_spawn": 1, "plm": "rsh", "pml": "ob1", "btl": "tcp,self,vader",
            "btl_tcp_if_include": f"{NETWORK}.0/24", "oob_tcp_if_include": f"{NETWORK}.0/24",
            "orte_tmpdir_base": session,
            # A host that does not answer is given up after 9 s.
            "oob_tcp_keepalive_time": 5, "oob_tcp_keepalive_intvl": 2, "oob_tcp_keepalive_probes": 2,
        }
        environment = {**os.environ, **{f"OMPI_MCA_{name}": str(value) for name, value in options.items()}}
        first = (self._folder / self.addresses[0]).read_text(encoding="utf-8")
        words = ["nsenter", f"--target={first}", "--net", "--uts", "--", os.environ["SPHDROP_MPIEXEC"], "--host", hosts,
                 "-n", str(ranks_each * len(self.addresses)), *map(str, command)]
        return subprocess.Popen(words, env=environment, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT)
