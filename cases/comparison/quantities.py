"""What is measured of a run: contact, spreading and rebound of a drop, its fragments and clumps, periods and decay.

Everything is in SI units. A quantity that a run does not have (no contact, a drop that has not left) is NaN.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from comparison.study import Run  # which puts io/ on the path, and so goes first
from sphdrop_reader import Snapshot

Array = NDArray[np.float64]

# A shorter time without contact does not part drop and solid: the program's own limit for a gap (particles chatter).
GAP_LIMIT = 20e-6  # s


def contact_interval(run: Run) -> tuple[float, float] | None:
    """The first and the last time in s with a liquid particle in contact, None if there is none.

    As exact as the history's interval. A row counts too if the impulse has changed since the one before: a touch between
    two rows, when no particle happened to be in contact at either.
    """
    times, count, impulse = (run.history[name] for name in ("time", "contact_count", "contact_impulse_y"))
    in_contact = count > 0
    in_contact[1:] |= impulse[1:] != impulse[:-1]
    rows = np.flatnonzero(in_contact)
    return (float(times[rows[0]]), float(times[rows[-1]])) if rows.size else None


def has_left(run: Run) -> bool:
    """Whether the drop has touched and left before the run's end."""
    interval = contact_interval(run)
    return interval is not None and run.history["time"][-1] - interval[1] > GAP_LIMIT


def contact_time(run: Run) -> float:
    """From the first to the last contact, s; NaN if the drop has not left."""
    interval = contact_interval(run)
    return interval[1] - interval[0] if interval is not None and has_left(run) else math.nan


def impulse_time(run: Run, share: float = 0.99) -> float:
    """Time since the first contact by which `share` of the final vertical impulse was given, s; NaN if the drop has not left."""
    interval = contact_interval(run)
    if interval is None or not has_left(run):
        return math.nan
    times, impulse = run.history["time"], run.history["contact_impulse_y"]
    given = impulse / impulse[-1] if impulse[-1] != 0 else np.zeros_like(impulse)
    row = int(np.argmax(given >= share))
    if given[row] < share:
        return math.nan
    if row == 0:
        return 0.0
    between = (share - given[row - 1]) / (given[row] - given[row - 1])
    return float(times[row - 1] + between * (times[row] - times[row - 1]) - interval[0])


def highest_point(times: Array, values: Array) -> tuple[float, float]:
    """Time and value of the maximum, refined by the parabola through it and its neighbours."""
    k = int(np.nanargmax(values))
    if k in (0, len(values) - 1):
        return float(times[k]), float(values[k])
    # Newton's divided differences, for rows need not be evenly spaced.
    rise = (values[k] - values[k - 1]) / (times[k] - times[k - 1])
    bend = ((values[k + 1] - values[k]) / (times[k + 1] - times[k]) - rise) / (times[k + 1] - times[k - 1])
    if not bend < 0:
        return float(times[k]), float(values[k])
    slope = rise + bend * (times[k] - times[k - 1])  # at row k
    return float(times[k] - slope / (2 * bend)), float(values[k] - slope**2 / (4 * bend))


def largest_width(run: Run) -> tuple[float, float]:
    """The time in s at which the drop is widest, and that width D_max in m."""
    return highest_point(run.history["time"], run.history["drop_width"])


def restitution(run: Run) -> float:
    """Speed of the drop's mass centre away from the solid after the contact over that towards it before; NaN if the drop
    has not left."""
    interval = contact_interval(run)
    if interval is None or not has_left(run):
        return math.nan
    times, velocity = run.history["time"], run.history["drop_velocity_y"]
    before = velocity[max(0, int(np.searchsorted(times, interval[0])) - 1)]
    after = velocity[np.searchsorted(times, interval[1])]
    return float(-after / before) if before != 0 else math.nan


def shape_at_leaving(run: Run) -> float:
    """Width over height of the drop at the last contact: above 1 a pancake, below a pear; NaN if it has not left."""
    interval = contact_interval(run)
    if interval is None or not has_left(run):
        return math.nan
    row = np.searchsorted(run.history["time"], interval[1])
    return float(run.history["drop_width"][row] / run.history["drop_height"][row])


def spacing(snapshot: Snapshot) -> float:
    """Mean spacing sqrt(m/rho) of the liquid's particles, m: as many to an area as on a square lattice of that spacing."""
    liquid = snapshot.fluid
    return float(np.sqrt(snapshot["mass"][liquid] / snapshot["density"][liquid]).mean())


def close_pairs(position: Array, radius: float) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """Every pair i, j of points [N, 2] nearer to each other than `radius`, once, with their distances.

    Points are sorted into cells as wide as the radius; a pair is in the same cell or in neighbouring ones.
    """
    cell = np.floor((position - position.min(axis=0)) / radius).astype(np.int64) + 1
    width = int(cell[:, 1].max()) + 2
    key = cell[:, 0] * width + cell[:, 1]
    order = np.argsort(key, kind="stable")
    sorted_key = key[order]
    found_i, found_j = [], []
    for shift in (0, 1, width - 1, width, width + 1):
        start, end = (np.searchsorted(sorted_key, key + shift, side=side) for side in ("left", "right"))
        count = end - start
        i = np.repeat(np.arange(len(key)), count)
        within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        j = order[np.repeat(start, count) + within]
        chosen = i < j if shift == 0 else np.ones(len(i), dtype=bool)
        found_i.append(i[chosen])
        found_j.append(j[chosen])
    i, j = np.concatenate(found_i), np.concatenate(found_j)
    distance = np.hypot(*(position[i] - position[j]).T)
    near = distance < radius
    return i[near], j[near], distance[near]


def covered_area(snapshot: Snapshot, cell: float) -> float:
    """The area in m^2 that the liquid's particles cover: squares of side `cell` (m) with a particle in them, and those between
    that are no farther than three squares from such on all sides."""
    position = snapshot["position"][snapshot.fluid]
    place = np.floor((position - position.min(axis=0)) / cell).astype(int) + 5
    covered = np.zeros(place.max(axis=0) + 6, dtype=bool)
    covered[place[:, 0], place[:, 1]] = True
    for _ in range(3):
        covered = _grown(covered)
    for _ in range(3):
        covered = ~_grown(~covered)
    return float(covered.sum()) * cell**2


def _grown(squares: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """With the four neighbours of each."""
    grown = squares.copy()
    grown[1:] |= squares[:-1]
    grown[:-1] |= squares[1:]
    grown[:, 1:] |= squares[:, :-1]
    grown[:, :-1] |= squares[:, 1:]
    return grown


def component_count(size: int, i: NDArray[np.int64], j: NDArray[np.int64]) -> int:
    """Connected components of `size` nodes with the links i-j: each takes the least label that reaches it."""
    label = np.arange(size)
    while True:
        least = np.minimum(label[i], label[j])
        lower = label.copy()
        np.minimum.at(lower, label[i], least)
        np.minimum.at(lower, label[j], least)
        lower = lower[lower]  # follow the chain of labels, so that long components take few rounds
        if np.array_equal(lower, label):
            return len(np.unique(label))
        label = lower


def fragments(snapshot: Snapshot) -> int:
    """Pieces of the liquid: particles nearer than two spacings are of one piece."""
    position = snapshot["position"][snapshot.fluid]
    i, j, _ = close_pairs(position, 2 * spacing(snapshot))
    return component_count(len(position), i, j)


def nearest_neighbour_distances(snapshot: Snapshot) -> Array:
    """For each liquid particle the distance to the nearest other, m."""
    position = snapshot["position"][snapshot.fluid]
    nearest = np.full(len(position), np.inf)
    i, j, distance = close_pairs(position, 2 * spacing(snapshot))
    np.minimum.at(nearest, i, distance)
    np.minimum.at(nearest, j, distance)
    for k in np.flatnonzero(np.isinf(nearest)):  # a lone particle
        others = np.hypot(*(np.delete(position, k, axis=0) - position[k]).T)
        nearest[k] = others.min() if others.size else np.inf
    return nearest


def clumped_share(snapshot: Snapshot, limit: float = 0.7) -> float:
    """Share of the liquid's particles whose nearest neighbour is nearer than `limit` mean spacings."""
    return float(np.mean(nearest_neighbour_distances(snapshot) < limit * spacing(snapshot)))


def zero_crossings(times: Array, values: Array, noise: float = 0.02) -> Array:
    """Times at which the values change their sign, linearly between rows, s.

    A crossing counts if the values have swung beyond `noise` of their largest before it and after it.
    """
    level = noise * np.abs(values).max()
    side = np.where(values > level, 1, np.where(values < -level, -1, 0))
    rows = np.flatnonzero(side)
    found = []
    for before, after in zip(rows[:-1], rows[1:]):
        if side[before] == side[after]:
            continue
        section = np.arange(before, after + 1)
        k = section[:-1][np.signbit(values[section[:-1]]) != np.signbit(values[section[1:]])]
        # Noise can cross several times within the band: their mean is the crossing.
        found.append(np.mean(times[k] - values[k] * (times[k + 1] - times[k]) / (values[k + 1] - values[k])))
    return np.array(found)


def oscillation_periods(times: Array, values: Array, noise: float = 0.02) -> Array:
    """The periods of values that swing about zero: from each zero crossing to the second next, s."""
    crossings = zero_crossings(times, values, noise)
    return crossings[2:] - crossings[:-2]


def decay_rate(times: Array, values: Array, noise: float = 0.02) -> float:
    """lambda in 1/s of a swing that dies out as exp(-lambda t): a line through the logarithms of its extrema between
    zero crossings; NaN with fewer than two extrema."""
    crossings = zero_crossings(times, values, noise)
    peaks = []
    for start, end in zip(crossings[:-1], crossings[1:]):
        rows = np.flatnonzero((times >= start) & (times <= end))
        if rows.size >= 3:
            peaks.append(highest_point(times[rows], np.abs(values[rows])))
    if len(peaks) < 2:
        return math.nan
    when, size = np.array(peaks).T
    return float(-np.polyfit(when, np.log(size), 1)[0])
