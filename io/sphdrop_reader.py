"""Reads the results of a run; io/FORMAT.md describes the files.

    run = Run("results/cantilever")
    run.history["drop_width"]            # array over time, m
    run.history.unit("drop_width")       # "m"
    for snapshot in run.snapshots:
        snapshot.time, snapshot["position"], snapshot["pressure"][snapshot.fluid]
    checkpoint = Checkpoint(run.checkpoints[0])
    checkpoint.tables["fluid"]["density"]
"""

from __future__ import annotations

import csv
import ctypes
import functools
import json
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, overload

import h5py
import numpy as np
from numpy.typing import NDArray

__all__ = ["Checkpoint", "CheckpointGroup", "CheckpointTable", "History", "ResultError", "Run", "Snapshot", "SnapshotSequence"]


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
        try:
            text = Path(path).read_text(encoding="utf-8")
        except OSError as error:
            raise ResultError(f"{path}: cannot be read: {error.strerror}") from error
        self._take(path, text)

    @classmethod
    def of_text(cls, path: str | Path, text: str) -> History:
        """From the file's text, or its first lines, while the run still writes it."""
        history = cls.__new__(cls)
        history._take(path, text)
        return history

    def _take(self, path: str | Path, text: str) -> None:
        self.path = Path(path)
        rows = list(csv.reader(text.splitlines()))
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


class CheckpointGroup(Mapping[str, NDArray[np.float64]]):
    """Named arrays of a checkpoint, each read when asked for."""

    def __init__(self, path: Path, group: h5py.Group) -> None:
        self._path, self._group = path, group.name
        self._units = {name: _text(dataset.attrs["unit"]) for name, dataset in group.items()}
        self._descriptions = {name: _text(dataset.attrs["description"]) for name, dataset in group.items()}

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        self.unit(name)
        with h5py.File(self._path, "r") as file:
            return file[f"{self._group}/{name}"][...]

    def __contains__(self, name: object) -> bool:
        return name in self._units

    def __iter__(self) -> Iterator[str]:
        return iter(self._units)

    def __len__(self) -> int:
        return len(self._units)

    def unit(self, name: str) -> str:
        if name not in self._units:
            raise ResultError(f"{self._path}:{self._group}: there is no '{name}'; there are {', '.join(self._units)}")
        return self._units[name]

    def description(self, name: str) -> str:
        self.unit(name)
        return self._descriptions[name]


class CheckpointTable(CheckpointGroup):
    """The columns of a table; row k belongs to the particle with the id first_id + k."""

    def __init__(self, path: Path, group: h5py.Group) -> None:
        super().__init__(path, group)
        self.row_count = int(group.attrs["rows"])
        self.first_id = int(group.attrs["first_id"])

    @property
    def ids(self) -> NDArray[np.int64]:
        return np.arange(self.first_id, self.first_id + self.row_count)


class Checkpoint:
    """The state of a run to go on from. Its bytes are checked first."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self._check_bytes()
        try:
            with h5py.File(self.path, "r") as file:
                self.time = float(file.attrs["time"])
                self.step = int(file.attrs["step"])
                self.state_hash = _text(file.attrs["state_hash"])
                self.case_name = _text(file.attrs["name"])
                self.version = _text(file.attrs["version"])
                self.git_commit = _text(file.attrs["git_commit"])
                self.case_text = _text(file["case"][()])
                self.numbers = CheckpointGroup(self.path, file["run"])
                groups = {name: group for name, group in file.items() if isinstance(group, h5py.Group) and name != "run"}
                self.tables = {name: CheckpointTable(self.path, group) for name, group in groups.items()}
        except (OSError, KeyError) as error:
            raise ResultError(f"{self.path}: is no sound checkpoint: {error}") from error

    def _check_bytes(self) -> None:
        """io/FORMAT.md says what the first 512 bytes hold."""
        try:
            content = np.memmap(self.path, dtype=np.uint8, mode="r") if self.path.stat().st_size else np.empty(0, np.uint8)
        except OSError as error:
            raise ResultError(f"{self.path}: cannot be read: {error.strerror}") from error
        head = content[:_HEAD_BYTES].tobytes()
        begin = re.match(rb"sphdrop checkpoint (\d+)\n", head)
        if begin is None:
            raise ResultError(f"{self.path}: is no checkpoint of sphdrop")
        if len(head) < _HEAD_BYTES:
            raise ResultError(f"{self.path}: is truncated: {len(head)} of at least {_HEAD_BYTES} bytes are there")
        library = _xxh3_library()
        sealed, label, seal = head.partition(b"head_checksum ")
        if library is not None and label + seal != _seal_of(library, sealed):
            raise ResultError(f"{self.path}: is damaged: its first {_HEAD_BYTES} bytes do not match their own checksum")
        if int(begin[1]) != 1:
            raise ResultError(f"{self.path}: is of format {int(begin[1])}; this reader knows format 1")
        fields = dict(re.findall(r"^(\w+) (\w+)$", sealed.decode("ascii", errors="replace"), flags=re.MULTILINE))
        if not {"bytes", "block_bytes", "checksum"} <= set(fields):
            raise ResultError(f"{self.path}: is damaged: its first {_HEAD_BYTES} bytes lack what they should hold")
        if len(content) < int(fields["bytes"]):
            raise ResultError(f"{self.path}: is truncated: {len(content)} of {fields['bytes']} bytes are there")
        if len(content) > int(fields["bytes"]):
            raise ResultError(f"{self.path}: is damaged: it has {len(content)} bytes, not {fields['bytes']}")
        if library is None:
            warnings.warn(f"{self.path}: libxxhash is not there: the checksum was not checked", stacklevel=3)
            return
        step = int(fields["block_bytes"])
        blocks = (content[start : start + step].tobytes() for start in range(_HEAD_BYTES, len(content), step))
        checksum = _digest(library, b"".join(_digest(library, block) for block in blocks)).hex()
        if checksum != fields["checksum"]:
            raise ResultError(
                f"{self.path}: is damaged: the checksum of its bytes is {checksum}, not {fields['checksum']}"
            )

    def __repr__(self) -> str:
        return f"<checkpoint {self.path.name}: t = {self.time} s, {', '.join(self.tables)}>"


_HEAD_BYTES = 512


class _Hash128(ctypes.Structure):
    _fields_ = (("low", ctypes.c_uint64), ("high", ctypes.c_uint64))


@functools.cache
def _xxh3_library() -> ctypes.CDLL | None:
    """The library that the program itself takes its checksums with."""
    try:
        library = ctypes.CDLL("libxxhash.so.0")
        library.XXH3_128bits.restype = _Hash128
        library.XXH3_128bits.argtypes = (ctypes.c_char_p, ctypes.c_size_t)
    except (OSError, AttributeError):
        return None
    return library


def _digest(library: ctypes.CDLL, data: bytes) -> bytes:
    value = library.XXH3_128bits(data, len(data))
    return value.high.to_bytes(8, "big") + value.low.to_bytes(8, "big")


def _seal_of(library: ctypes.CDLL, sealed: bytes) -> bytes:
    """What must follow `sealed` at a checkpoint's start."""
    seal = b"head_checksum " + _digest(library, sealed).hex().encode() + b"\n"
    return seal.ljust(_HEAD_BYTES - len(sealed), b"\0")


class Run:
    """The results in a directory. What is not there raises ResultError when it is asked for, not before."""

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)
        if not self.directory.is_dir():
            raise ResultError(f"{self.directory}: is not a directory")
        known = [self._index_path, self.directory / "history.csv", self.directory / "run.json"]
        if not any(path.exists() for path in known) and not self._snapshot_files() and not self.checkpoints:
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
    def checkpoints(self) -> list[Path]:
        """The files, newest first; Checkpoint reads one."""
        found = (re.fullmatch(r"checkpoint_(\d{12,})\.h5", path.name) for path in self.directory.iterdir())
        steps = sorted((int(match[1]), match[0]) for match in found if match)
        return [self.directory / name for _, name in reversed(steps)]

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
