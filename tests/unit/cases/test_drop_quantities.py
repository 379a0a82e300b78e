"""What comparison/quantities.py measures, of made-up histories and particles whose answers are known."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison import quantities  # noqa: E402

import numpy as np  # noqa: E402


def run_of(**columns: Any) -> Any:
    """A run with that history."""
    return SimpleNamespace(history={name: np.asarray(values, dtype=float) for name, values in columns.items()})


class FakeSnapshot(dict):
    """Liquid particles at positions [N, 2] in m, of spacing 1 m unless told; and one of a solid far away."""

    def __init__(self, position: Any, spacing: float = 1.0) -> None:
        points = np.vstack([np.asarray(position, dtype=float), [[1e3, 1e3]]])
        mass = np.full(len(points), 1000.0 * spacing**2)
        mass[-1] = 1e6
        super().__init__(position=points, mass=mass, density=np.full(len(points), 1000.0))
        self.fluid = np.arange(len(points)) < len(points) - 1


def bounce(end: float = 1e-3) -> Any:
    """Touches from 0.1 to 0.5 ms under a constant force; falls at 2 m/s and leaves at 1 m/s, 1.5 times as wide as high."""
    times = np.arange(0.0, end + 1e-9, 1e-5)
    share = np.clip((times - 0.1e-3) / 0.4e-3, 0.0, 1.0)
    return run_of(time=times, contact_count=(times > 0.0999e-3) & (times < 0.5001e-3), contact_impulse_y=-7.0 * share,
                  drop_velocity_y=-2.0 + 3.0 * share, drop_width=np.where(times < 0.4e-3, 9.0, 3.0),
                  drop_height=np.full_like(times, 2.0))


class Contact(unittest.TestCase):
    def test_interval_and_time(self) -> None:
        first, last = quantities.contact_interval(bounce())
        self.assertAlmostEqual(first, 0.1e-3, places=12)
        self.assertAlmostEqual(last, 0.5e-3, places=12)
        self.assertAlmostEqual(quantities.contact_time(bounce()), 0.4e-3, places=12)

    def test_a_touch_between_two_rows_counts(self) -> None:
        run = run_of(time=[0, 1, 2, 3, 4], contact_count=[0, 1, 0, 0, 0], contact_impulse_y=[0, -1, -1, -1.5, -1.5])
        self.assertEqual(quantities.contact_interval(run), (1.0, 3.0))

    def test_a_drop_that_never_touches(self) -> None:
        run = run_of(time=[0, 1], contact_count=[0, 0], contact_impulse_y=[0, 0])
        self.assertIsNone(quantities.contact_interval(run))
        for quantity in (quantities.contact_time, quantities.impulse_time, quantities.restitution, quantities.shape_at_leaving):
            self.assertTrue(math.isnan(quantity(run)))

    def test_a_drop_that_has_not_left_has_no_contact_time(self) -> None:
        run = bounce(end=0.3e-3)
        self.assertIsNotNone(quantities.contact_interval(run))
        for quantity in (quantities.contact_time, quantities.impulse_time, quantities.restitution, quantities.shape_at_leaving):
            self.assertTrue(math.isnan(quantity(run)))

    def test_impulse_time_is_between_rows(self) -> None:
        self.assertAlmostEqual(quantities.impulse_time(bounce()), 0.99 * 0.4e-3, places=12)
        self.assertAlmostEqual(quantities.impulse_time(bounce(), 0.513), 0.513 * 0.4e-3, places=12)

    def test_impulse_time_with_a_late_return(self) -> None:
        # All of it at once, then back and forth: what counts is when the share is first reached.
        run = run_of(time=np.arange(6), contact_count=[0, 1, 1, 1, 0, 0], contact_impulse_y=[0, -2, -3, -2, -2, -2])
        self.assertAlmostEqual(quantities.impulse_time(run, 0.5), 0.5 - 1.0)

    def test_restitution_and_shape(self) -> None:
        self.assertAlmostEqual(quantities.restitution(bounce()), 0.5)
        self.assertAlmostEqual(quantities.shape_at_leaving(bounce()), 1.5)


class Peaks(unittest.TestCase):
    def test_a_parabola_is_found_exactly(self) -> None:
        times = np.array([0.0, 0.3, 0.5, 0.9, 1.0])
        time, value = quantities.highest_point(times, 4.0 - 3.0 * (times - 0.57) ** 2)
        self.assertAlmostEqual(time, 0.57)
        self.assertAlmostEqual(value, 4.0)

    def test_an_end_is_taken_as_it_is(self) -> None:
        self.assertEqual(quantities.highest_point(np.arange(3.0), np.array([1.0, 2.0, 5.0])), (2.0, 5.0))
        self.assertEqual(quantities.highest_point(np.arange(3.0), np.array([5.0, 2.0, 1.0])), (0.0, 5.0))

    def test_largest_width(self) -> None:
        times = np.linspace(0, 1, 11)
        time, width = quantities.largest_width(run_of(time=times, drop_width=2 - (times - 0.43) ** 2))
        self.assertAlmostEqual(time, 0.43)
        self.assertAlmostEqual(width, 2.0)


class Particles(unittest.TestCase):
    def grid(self, columns: int, rows: int) -> Any:
        return np.array([(x, y) for x in range(columns) for y in range(rows)], dtype=float)

    def test_close_pairs_are_all_pairs_by_brute_force(self) -> None:
        position = np.random.default_rng(3).uniform(-4, 5, (300, 2))
        i, j, distance = quantities.close_pairs(position, 0.9)
        all_distances = np.hypot(*(position[:, None] - position[None]).transpose(2, 0, 1))
        expected = {(a, b) for a, b in zip(*np.nonzero(all_distances < 0.9)) if a < b}
        found = [(min(a, b), max(a, b)) for a, b in zip(i, j)]
        self.assertEqual(len(found), len(set(found)))
        self.assertEqual(set(found), expected)
        np.testing.assert_allclose(distance, all_distances[i, j])

    def test_a_lattice_is_one_piece(self) -> None:
        self.assertEqual(quantities.fragments(FakeSnapshot(self.grid(7, 5))), 1)

    def test_pieces_part_beyond_two_spacings(self) -> None:
        left, right = self.grid(3, 3), self.grid(3, 3)
        for gap, pieces in ((1.99, 1), (2.01, 2)):
            self.assertEqual(quantities.fragments(FakeSnapshot(np.vstack([left, right + [2 + gap, 0]]))), pieces)
        lone = np.vstack([left, right + [40, 0], [[20, 0]], [[20, 30]]])
        self.assertEqual(quantities.fragments(FakeSnapshot(lone)), 4)

    def test_pieces_of_another_spacing(self) -> None:
        points = 1e-5 * np.vstack([self.grid(3, 3), self.grid(3, 3) + [4.5, 0]])
        self.assertEqual(quantities.fragments(FakeSnapshot(points, spacing=1e-5)), 2)

    def test_a_long_chain_is_one_piece_in_any_order(self) -> None:
        chain = np.column_stack([1.5 * np.arange(500), np.zeros(500)])
        self.assertEqual(quantities.fragments(FakeSnapshot(np.random.default_rng(1).permutation(chain))), 1)

    def test_nearest_neighbours(self) -> None:
        points = np.random.default_rng(5).uniform(0, 12, (150, 2))
        apart = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1)) + 1e9 * np.eye(150)
        np.testing.assert_allclose(quantities.nearest_neighbour_distances(FakeSnapshot(points)), apart.min(axis=0))
        snapshot = FakeSnapshot([(0, 0), (0.5, 0), (3, 0), (3, 1.2), (30, 40)])
        np.testing.assert_allclose(quantities.nearest_neighbour_distances(snapshot)[:4], [0.5, 0.5, 1.2, 1.2])
        self.assertAlmostEqual(quantities.nearest_neighbour_distances(snapshot)[4], math.hypot(27, 38.8))

    def test_clumped_share(self) -> None:
        snapshot = FakeSnapshot([(0, 0), (0.6, 0), (3, 0), (3, 0.8), (6, 0), (6, 1)])
        self.assertAlmostEqual(quantities.clumped_share(snapshot), 1 / 3)
        self.assertAlmostEqual(quantities.clumped_share(snapshot, 0.5), 0.0)
        self.assertAlmostEqual(quantities.clumped_share(snapshot, 0.9), 2 / 3)


class Swings(unittest.TestCase):
    times = np.linspace(0, 10, 2001)

    def test_periods_of_a_sine(self) -> None:
        periods = quantities.oscillation_periods(self.times, np.sin(2 * math.pi * (self.times - 0.1) / 1.7))
        self.assertEqual(len(periods), 10)
        np.testing.assert_allclose(periods, 1.7, rtol=1e-5)

    def test_noise_about_zero_makes_no_crossings(self) -> None:
        noise = 0.05 * np.random.default_rng(2).uniform(-1, 1, len(self.times))
        crossings = quantities.zero_crossings(self.times, np.cos(2 * math.pi * self.times / 2.0) + noise, 0.1)
        np.testing.assert_allclose(crossings, np.arange(0.5, 10.0, 1.0), atol=0.02)

    def test_decay_of_a_damped_swing(self) -> None:
        values = np.exp(-0.21 * self.times) * np.sin(2 * math.pi * self.times / 1.3)
        self.assertAlmostEqual(quantities.decay_rate(self.times, values), 0.21, delta=2e-4)

    def test_too_short_for_a_period(self) -> None:
        self.assertEqual(len(quantities.oscillation_periods(self.times, self.times + 1.0)), 0)
        self.assertTrue(math.isnan(quantities.decay_rate(self.times, self.times + 1.0)))


class Area(unittest.TestCase):
    def test_a_disc_of_particles_covers_its_area_and_grows_with_it(self) -> None:
        x, y = np.meshgrid(np.arange(-25, 26), np.arange(-25, 26))
        inside = x**2 + y**2 < 20.5**2
        disc = np.stack([x[inside], y[inside]], axis=-1) * 1e-5 + 0.5e-5

        def snapshot(stretch: float) -> object:
            class Liquid(dict):  # type: ignore[type-arg]
                fluid = np.ones(len(disc), dtype=bool)
            return Liquid(position=disc * stretch)
        start = quantities.covered_area(snapshot(1.0), 1e-5)  # type: ignore[arg-type]
        self.assertAlmostEqual(start, len(disc) * 1e-10, delta=0.05 * len(disc) * 1e-10)
        for stretch in (1.1, 1.5, 2.0):
            self.assertAlmostEqual(quantities.covered_area(snapshot(stretch), 1e-5) / start, stretch**2, delta=0.06 * stretch**2)  # type: ignore[arg-type]


if __name__ == "__main__":
    unittest.main()
