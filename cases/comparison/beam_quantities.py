"""What is measured of a beam: how deep it sinks, how its sections move, whether it cracks; and what theory says of it.

Everything is in SI units and per metre of depth. The reference state is the run's first snapshot.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from comparison.exact_beam import Array, Beam
from comparison.ledgers import drop_mass
from comparison.quantities import highest_point
from modal_beam import beam_of
from numpy.typing import NDArray
from sphdrop_reader import ResultError, Run, Snapshot


# Particles chatter, and single ones touch once more while the drop flies off; a longer time apart parts drop and beam.
PARTED = 1e-4  # s


def case_of(run: Run) -> dict[str, Any]:
    """The case as it was run, with every parameter."""
    return tomllib.loads(run.case_text)


def spacing_of(run: Run) -> float:
    """d at the start, m."""
    return float(case_of(run)["resolution"]["spacing"])


def rows_across(run: Run) -> int:
    """Rows of particles across the beam."""
    return round(float(case_of(run)["solid"]["thickness"]) / spacing_of(run))


def lowest_point(times: Array, values: Array) -> tuple[float, float]:
    """Time and value of the minimum, refined by the parabola through it and its neighbours; NaN, NaN if the minimum is
    the first or the last row: then it is none."""
    if not np.isfinite(values).any() or int(np.nanargmin(values)) in (0, len(values) - 1):
        return math.nan, math.nan
    time, height = highest_point(times, -values)
    return time, -height


def deepest_deflection(run: Run) -> tuple[float, float]:
    """When the watched section (free end or mid-span) lies deepest, s, and how deep, m, positive downwards; NaN, NaN
    while it is still sinking at the run's end."""
    time, lowest = lowest_point(run.history["time"], run.history["deflection"])
    return time, -lowest


def contact_episodes(run: Run) -> list[tuple[float, float]]:
    """First and last time in s of each contact; a time of more than PARTED without any ends one, as a beam can swing back
    and touch a drop that it has thrown off. Rows count as for quantities.contact_interval."""
    times, count, impulse = (run.history[name] for name in ("time", "contact_count", "contact_impulse_y"))
    in_contact = count > 0
    in_contact[1:] |= impulse[1:] != impulse[:-1]
    touched = times[in_contact]
    if touched.size == 0:
        return []
    last = np.flatnonzero(np.diff(touched) > PARTED)
    return list(zip(touched[np.append(0, last + 1)].tolist(), touched[np.append(last, touched.size - 1)].tolist()))


def leaving_time(run: Run) -> float:
    """When drop and beam first part, s; NaN if they do not."""
    episodes = contact_episodes(run)
    if not episodes or (len(episodes) == 1 and run.history["time"][-1] - episodes[0][1] <= PARTED):
        return math.nan
    return episodes[0][1]


def contact_time(run: Run) -> float:
    """From the first contact until drop and beam first part, s; NaN if they do not."""
    episodes = contact_episodes(run)
    return leaving_time(run) - episodes[0][0] if episodes else math.nan


def impulse_time(run: Run, share: float = 0.99) -> float:
    """Time since the first contact by which `share` of the vertical impulse until drop and beam part was given, s."""
    leaves = leaving_time(run)
    if not math.isfinite(leaves):
        return math.nan
    times, given = run.history["time"], np.maximum.accumulate(np.abs(run.history["contact_impulse_y"]))
    # The row after the last contact has what was given in between.
    row = min(int(np.searchsorted(times, leaves, side="right")), len(times) - 1)
    k = int(np.argmax(given >= share * given[row]))
    between = (share * given[row] - given[k - 1]) / (given[k] - given[k - 1])
    return float(times[k - 1] + between * (times[k] - times[k - 1]) - contact_episodes(run)[0][0])


def history_at(run: Run, column: str, time: float) -> float:
    """A column of the history at a time in s, linearly between rows; NaN at NaN."""
    return float(np.interp(time, run.history["time"], run.history[column]))


def deviation_from_proportion(x: Sequence[float], y: Sequence[float]) -> float:
    """Largest |y - s x| / (s x) from the straight line through the origin, s by least squares; a share."""
    a, b = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    line = (a @ b) / (a @ a) * a
    return float(np.max(np.abs(b / line - 1)))


def deviation_from_line(x: Sequence[float], y: Sequence[float]) -> float:
    """Largest |y - (c + s x)| / |c + s x| from the straight line of least squares, wherever it begins; a share."""
    a, b = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    slope, begin = np.polyfit(a, b, 1)
    return float(np.max(np.abs(b / (begin + slope * a) - 1)))


@dataclass(frozen=True)
class BeamTheory:
    """Eqs 43-47 for a run: rad/s, s, m and 1. Eqs 46 and 47 are a cantilever's under a drop; NaN elsewhere."""

    angular_frequency: float    # omega0 (43); of a beam clamped at both ends likewise, with the root 4.730
    period: float               # tau0 (44)
    largest_deflection: float   # delta_max (46)
    relative_deflection: float  # chi (47)


def largest_deflection_theory(beam: Beam, drop_mass: float, impact_speed: float) -> float:
    """delta_max = tau0 m U0 / (4 (m + M_b/2)), m (Eq 46)."""
    period = 2 * math.pi / float(beam.angular_frequencies(1)[0])
    return period * drop_mass * impact_speed / (4 * (drop_mass + beam.mass / 2))


def theory_of(run: Run) -> BeamTheory:
    """What theory says of the run's beam, in plane strain."""
    case, beam = case_of(run), beam_of(run)
    omega = float(beam.angular_frequencies(1)[0])
    depth = math.nan
    if beam.is_cantilever and case["drop"]["shape"] == "round":
        depth = largest_deflection_theory(beam, drop_mass(case), -case["drop"]["velocity"][1])
    return BeamTheory(omega, 2 * math.pi / omega, depth, depth / beam.length)


class BeamSections:
    """The columns of particles across the free part of a run's beam, as the first snapshot has them."""

    def __init__(self, run: Run) -> None:
        if len(run.snapshots) == 0:
            raise ResultError(f"{run.directory}: there are no snapshots: the beam's reference state is not known")
        self._run = run
        self._reference = run.snapshots[0]["position"]
        length = beam_of(run).length
        spacing = spacing_of(run)
        x = self._reference[:, 0]
        is_free = run.snapshots[0].solid & (run.snapshots[0]["is_fixed"] == 0) & (x > 0) & (x < length)
        self._particles = np.flatnonzero(is_free)
        column = np.rint(x[self._particles] / spacing - 0.5).astype(int)
        self._column = column - column.min()
        self._count = np.bincount(self._column)
        self.places: Array = np.bincount(self._column, x[self._particles]) / self._count

    def _mean(self, values: Array) -> Array:
        return np.stack([np.bincount(self._column, values[:, k]) / self._count for k in (0, 1)], axis=-1)

    def displacement(self, snapshot: Snapshot) -> Array:
        """Mean over each section's particles [section, 2], m."""
        return self._mean((snapshot["position"] - self._reference)[self._particles])

    def velocity(self, snapshot: Snapshot) -> Array:
        """Mean over each section's particles [section, 2], m/s."""
        return self._mean(snapshot["velocity"][self._particles])

    def displacement_at(self, place: float) -> tuple[Array, Array]:
        """Times of the snapshots and the displacement [time, 2] of the section at `place` (m, of the reference state),
        linearly between the columns; beyond the outermost column, that column's."""
        found = []
        for snapshot in self._run.snapshots:
            displacement = self.displacement(snapshot)
            found.append([np.interp(place, self.places, displacement[:, k]) for k in (0, 1)])
        return self._run.snapshots.times, np.array(found)


def section_displacement(run: Run, place: float) -> tuple[Array, Array]:
    """Times in s and the displacement [time, 2] in m of the beam's section at `place` (m); see BeamSections."""
    return BeamSections(run).displacement_at(place)


def largest_row_strain(run: Run) -> float:
    """The largest strain along the beam's outermost rows over all snapshots, by its centre line: stretch + curvature
    (H - d)/2, both over a stretch as long as the beam is thick. What neighbours part beyond it is not bending."""
    sections, spacing, rows = BeamSections(run), spacing_of(run), rows_across(run)
    reference = np.stack([sections.places, np.zeros_like(sections.places)], axis=-1)
    largest = 0.0
    for snapshot in run.snapshots:
        step = np.diff(reference + sections.displacement(snapshot), axis=0)
        angle = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
        curvature = (angle[rows:] - angle[:-rows]) / (rows * spacing)
        stretch = np.convolve(np.hypot(*step.T) / spacing - 1, np.full(rows + 1, 1 / (rows + 1)), "valid")
        largest = max(largest, float((stretch + np.abs(curvature) * 0.5 * (rows - 1) * spacing).max()))
    return largest


def reference_neighbours(position: Array, spacing: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of neighbours along the rows and columns of a square lattice [N, 2]."""
    cell = np.rint((position - position.min(axis=0)) / spacing).astype(np.int64)
    width = int(cell[:, 1].max()) + 2  # one empty row, so that the top of one column is not below the next one's bottom
    key = cell[:, 0] * width + cell[:, 1]
    order = np.argsort(key)
    found_i, found_j = [], []
    for shift in (1, width):
        at = np.minimum(np.searchsorted(key[order], key + shift), len(key) - 1)
        is_there = key[order][at] == key + shift
        found_i.append(np.flatnonzero(is_there))
        found_j.append(order[at][is_there])
    return np.concatenate(found_i), np.concatenate(found_j)


def gaps(run: Run, snapshot: Snapshot) -> tuple[Array, Array]:
    """Where [pair, 2], in the reference state in m, and by how much the distances of the beam's neighbours have grown:
    distance over that of the reference state [pair]. The beam's part between the clamps' strips counts too."""
    first = run.snapshots[0]
    beam = np.flatnonzero(first.solid & (first["is_fixed"] == 0))
    reference, present = first["position"][beam], snapshot["position"][beam]
    i, j = reference_neighbours(reference, spacing_of(run))
    before, now = (np.hypot(*(position[i] - position[j]).T) for position in (reference, present))
    return 0.5 * (reference[i] + reference[j]), now / before


def largest_gap(run: Run, snapshot: Snapshot) -> float:
    """The largest stretch of the distance between neighbouring particles of the beam: 1 at rest, far above it a crack."""
    return float(gaps(run, snapshot)[1].max())


def largest_gap_of_run(run: Run) -> float:
    """Over all snapshots."""
    return max(largest_gap(run, snapshot) for snapshot in run.snapshots)
