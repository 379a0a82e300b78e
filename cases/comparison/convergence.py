"""The observed order of convergence, and what the values tend to as the spacing goes to zero."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LOWEST_ORDER, HIGHEST_ORDER = 0.05, 8.0


@dataclass(frozen=True)
class Fit:
    """f(d) = limit + coefficient d^order. Where no order can be named, it is NaN and `text` says why."""

    order: float
    limit: float            # Richardson's value, in the unit of the values
    residual: float         # root mean square of fit minus values, in their unit
    text: str               # in words, for a caption
    coefficient: float = math.nan

    def __call__(self, spacing: float | Array) -> float | Array:
        """The fitted value at a spacing."""
        return self.limit + self.coefficient * spacing**self.order


def fit_order(spacings: Sequence[float], values: Sequence[float]) -> Fit:
    """Least squares over order, limit and coefficient through three or more spacings in any order and of any ratio.

    With three it is Richardson's extrapolation: the curve passes through them.
    """
    d, f = _sorted(spacings, values)
    problem = _why_no_order(d, f)
    if problem:
        limit = float(f[-1]) if problem == UNCHANGED else math.nan
        return Fit(math.nan, limit, math.nan, problem)
    if len(d) == 3:
        return _through_three(d, f)
    order = _least_squares_order(d, f)
    if math.isnan(order):
        return Fit(math.nan, math.nan, math.nan, f"no order between {LOWEST_ORDER} and {HIGHEST_ORDER:g} fits")
    limit, coefficient, residual = _linear_fit(d, f, order)
    share = 100 * residual / np.ptp(f)
    text = f"order {order:.2f}, limit {limit:.4g} ({len(d)} spacings, residual {share:.2g} % of the span)"
    return Fit(order, limit, residual, text, coefficient)


def richardson(spacings: Sequence[float], values: Sequence[float]) -> Fit:
    """Through the finest three only."""
    d, f = _sorted(spacings, values)
    return fit_order(d[-3:], f[-3:])


UNCHANGED = "the value does not change with the spacing"


def _sorted(spacings: Sequence[float], values: Sequence[float]) -> tuple[Array, Array]:
    """Coarsest first, without those whose value is missing."""
    d, f = np.asarray(spacings, dtype=float), np.asarray(values, dtype=float)
    if d.shape != f.shape or d.ndim != 1:
        raise ValueError(f"spacings and values must be two lists of one length, not {d.shape} and {f.shape}")
    if np.any(~(d > 0)) or len(np.unique(d)) != len(d):
        raise ValueError("spacings must be positive and differ from each other")
    known = np.isfinite(f)
    d, f = d[known], f[known]
    order = np.argsort(-d)
    return d[order], f[order]


def _why_no_order(d: Array, f: Array) -> str:
    if len(d) < 3:
        return f"an order takes three spacings, not {len(d)}"
    steps = np.diff(f)
    if np.all(np.abs(steps) <= 1e-12 * np.abs(f).max()):
        return UNCHANGED
    if not (np.all(steps > 0) or np.all(steps < 0)):
        return "not monotone: no order"
    return ""


def _through_three(d: Array, f: Array) -> Fit:
    """(f1 - f2)/(f2 - f3) = (d1^p - d2^p)/(d2^p - d3^p), whose right side grows with p: bisection."""
    wanted = (f[0] - f[1]) / (f[1] - f[2])

    def excess(p: float) -> float:
        a, b = (d[0] / d[1]) ** p, (d[2] / d[1]) ** p
        return (a - 1) / (1 - b) - wanted

    if excess(LOWEST_ORDER) > 0:
        return Fit(math.nan, math.nan, math.nan, "the differences do not shrink with the spacing: no order")
    if excess(HIGHEST_ORDER) < 0:
        return Fit(math.nan, float(f[-1]), math.nan, f"the differences shrink faster than order {HIGHEST_ORDER:g}: no order")
    low, high = LOWEST_ORDER, HIGHEST_ORDER
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    order = 0.5 * (low + high)
    coefficient = (f[1] - f[2]) / (d[1] ** order - d[2] ** order)
    limit = f[2] - coefficient * d[2] ** order
    return Fit(order, float(limit), 0.0, f"order {order:.2f}, limit {limit:.4g} (through three spacings)", float(coefficient))


def _linear_fit(d: Array, f: Array, order: float) -> tuple[float, float, float]:
    """Limit, coefficient and residual for a given order."""
    scale = d[0] ** order
    columns = np.column_stack([np.ones_like(d), d**order / scale])
    solution = np.linalg.lstsq(columns, f, rcond=None)[0]
    residual = math.sqrt(float(np.mean((columns @ solution - f) ** 2)))
    return float(solution[0]), float(solution[1] / scale), residual


def _least_squares_order(d: Array, f: Array) -> float:
    """The order of the least residual: a scan, then golden sections; NaN if it lies at the range's edge."""
    orders = np.geomspace(LOWEST_ORDER, HIGHEST_ORDER, 200)
    best = int(np.argmin([_linear_fit(d, f, p)[2] for p in orders]))
    if best in (0, len(orders) - 1):
        return math.nan
    low, high = orders[best - 1], orders[best + 1]
    golden = (math.sqrt(5) - 1) / 2
    for _ in range(80):
        left, right = high - golden * (high - low), low + golden * (high - low)
        if _linear_fit(d, f, left)[2] < _linear_fit(d, f, right)[2]:
            high = right
        else:
            low = left
    return float(0.5 * (low + high))
