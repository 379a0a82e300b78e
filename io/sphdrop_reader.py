"""Reads the results of a run; io/FORMAT.md describes the files.

    run = Run("results/cantilever")
    run.history["drop_width"]            # array over time, m
    run.history.unit("drop_width")       # "m"
    for snapshot in run.snapshots:
        snapshot.time, snapshot["position"], snapshot["pressure"][snapshot.fluid]
"""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, overload

import h5py
import numpy as np
from numpy.typing import NDArray

__all__ = ["History", "ResultError", "Run", "Snapshot", "SnapshotSequence"]


class ResultError(Exception):
    """Results that are missing or not what they should be; the text says which and why."""


class Snapshot:
    """One state of the particles. Arrays are read when asked for and kept."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self._arrays: dict[str, NDArray[Any]] = {}
        with self._open() as file:
            try:
                self.time = float(file.attrs["time"])
                self.step = int(file.attrs["step"])
                self.state_hash = _text(file.attrs["state_hash"])
                self.case_name = _text(file.attrs["name"])
                self.version = _text(file.attrs["version"])
                self.particle_count = int(file["VTKHDF/NumberOfPoints"][0])
                data = file["VTKHDF/PointData"]
            except KeyError as error:
                raise ResultError(f"{self.path}: is no snapshot of sphdrop: {error.args[0]}") from error
            self._units = {name: _text(dataset.attrs["unit"]) for name, dataset in data.items()}
            self._descriptions = {name: _text(dataset.attrs["description"]) for name, dataset in data.items()}
        self._units["position"] = "m"
        self._descriptions["position"] = "position"

    def _open(self) -> h5py.File:
        try:
            return h5py.File(self.path, "r")
        except OSError as error:
            raise ResultError(f"{self.path}: cannot be read as HDF5: {error}") from error

    @property
    def names(self) -> list[str]:
        """The names of all arrays, "position" among them."""
        return sorted(self._units)

    def __contains__(self, name: object) -> bool:
        return name in self._units

    def __getitem__(self, name: str) -> NDArray[Any]:
        """An array in the order of the particles' ids: shape [N], or [N, 2] for vectors."""
        if name not in self._units:
            raise ResultError(f"{self.path}: there is no '{name}'; there are {', '.join(self.names)}")
        if name not in self._arrays:
            with self._open() as file:
                values = file["VTKHDF/Points" if name == "position" else f"VTKHDF/PointData/{name}"][...]
            self._arrays[name] = values[:, :2] if values.ndim == 2 else values
        return self._arrays[name]

    def unit(self, name: str) -> str:
        if name not in self._units:
            raise ResultError(f"{self.path}: there is no '{name}'; there are {', '.join(self.names)}")
        return self._units[name]

    def description(self, name: str) -> str:
        self.unit(name)
        return self._descriptions[name]

    @property
    def fluid(self) -> NDArray[np.bool_]:
        """Mask [N] of the liquid's particles."""
        return self["material"] == 0

    @property
    def solid(self) -> NDArray[np.bool_]:
        """Mask [N] of the solid's particles."""
        return self["material"] == 1

    def __repr__(self) -> str:
        return f"<snapshot {self.path.name}: t = {self.time} s, {self.particle_count} particles>"


class SnapshotSequence(Sequence[Snapshot]):
    """The snapshots of a run in the order of time; each is opened when it is first asked for."""

    def __init__(self, paths: Sequence[Path]) -> None:
        self.paths = list(paths)
        self._opened: dict[int, Snapshot] = {}

    def __len__(self) -> int:
        return len(self.paths)

    @overload
    def __getitem__(self, index: int) -> Snapshot: ...
    @overload
    def __getitem__(self, index: slice) -> list[Snapshot]: ...
    def __getitem__(self, index: int | slice) -> Snapshot | list[Snapshot]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        number = range(len(self))[index]
        if number not in self._opened:
            self._opened[number] = Snapshot(self.paths[number])
        return self._opened[number]

    @property
    def times(self) -> NDArray[np.float64]:
        return np.array([snapshot.time for snapshot in self])

    def at(self, time: float) -> Snapshot:
        """The snapshot nearest to a time in s."""
        if not self.paths:
            raise ResultError("there are no snapshots")
        return self[int(np.argmin(np.abs(self.times - time)))]


class History(Mapping[str, NDArray[np.float64]]):
    """The watched quantities over time: an array for each name."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        try:
            with self.path.open(newline="", encoding="utf-8") as stream:
                rows = list(csv.reader(stream))
        except OSError as error:
            raise ResultError(f"{self.path}: cannot be read: {error.strerror}") from error
        if not rows:
            raise ResultError(f"{self.path}: is empty")
        self._units: dict[str, str] = {}
        for cell in rows[0]:
            match = re.fullmatch(r"(\w+) \[(.+)\]", cell)
            if match is None:
                raise ResultError(f"{self.path}: the header's cell '{cell}' is not of the form 'name [unit]'")
            self._units[match[1]] = match[2]
        for number, row in enumerate(rows[1:], start=2):
            if len(row) != len(self._units):
                raise ResultError(f"{self.path}: line {number} has {len(row)} values, not {len(self._units)}")
        try:
            table = np.array(rows[1:], dtype=np.float64).reshape(-1, len(self._units))
        except ValueError as error:
            raise ResultError(f"{self.path}: {error}") from error
        self._columns = {name: table[:, k].copy() for k, name in enumerate(self._units)}

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self._columns:
            raise ResultError(f"{self.path}: there is no '{name}'; there are {', '.join(self._columns)}")
        return self._columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def unit(self, name: str) -> str:
        self[name]
        return self._units[name]


class Run:
    """The results in a directory. What is not there raises ResultError when it is asked for, not before."""

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)
        if not self.directory.is_dir():
            raise ResultError(f"{self.directory}: is not a directory")
        known = [self._index_path, self.directory / "history.csv", self.directory / "run.json"]
        if not any(path.exists() for path in known) and not self._snapshot_files():
            raise ResultError(f"{self.directory}: holds no results of sphdrop (no run.json, history.csv or snapshots)")
        self._history: History | None = None
        self._snapshots: SnapshotSequence | None = None

    @property
    def _index_path(self) -> Path:
        return self.directory / "snapshots.vtkhdf.series"

    def _snapshot_files(self) -> list[Path]:
        return sorted(path for path in self.directory.glob("snapshot_*.vtkhdf"))

    def _read_json(self, path: Path) -> dict[str, Any]:
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise ResultError(f"{path}: cannot be read: {error.strerror}") from error
        except ValueError as error:
            raise ResultError(f"{path}: is not JSON: {error}") from error

    @property
    def history(self) -> History:
        if self._history is None:
            self._history = History(self.directory / "history.csv")
        return self._history

    @property
    def snapshots(self) -> SnapshotSequence:
        """Those in the index; without an index, all there are."""
        if self._snapshots is None:
            if self._index_path.exists():
                files = self._read_json(self._index_path).get("files", [])
                paths = [self.directory / entry["name"] for entry in files]
            else:
                paths = self._snapshot_files()
            self._snapshots = SnapshotSequence(paths)
        return self._snapshots

    @property
    def info(self) -> dict[str, Any]:
        """run.json."""
        return self._read_json(self.directory / "run.json")

    @property
    def case_text(self) -> str:
        """The case as it was run, every parameter included (case.cfg)."""
        path = self.directory / "case.cfg"
        try:
            return path.read_text(encoding="utf-8")
        except OSError as error:
            raise ResultError(f"{path}: cannot be read: {error.strerror}") from error


def _text(value: Any) -> str:
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)
