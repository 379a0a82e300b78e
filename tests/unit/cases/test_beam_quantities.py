"""cases/comparison/beam_quantities.py and beam_frequency.py on synthetic runs whose answers are known."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path
from typing import Any

import numpy as np

CASES = Path(__file__).resolve().parents[3] / "cases"
sys.path[:0] = [str(CASES), str(CASES.parent / "io")]
from comparison import beam_frequency, beam_quantities  # noqa: E402
from comparison.exact_beam import Array, Beam  # noqa: E402

SPACING, LENGTH, ROWS = 6.25e-5, 8e-3, 4
CASE = f"""
[resolution]
spacing = {SPACING}
[fluid]
density = 1000
[drop]
shape = "round"
diameter = 1e-3
velocity = [0, -0.8]
[solid]
kind = "cantilever"
length = {LENGTH}
thickness = 0.25e-3
youngs_modulus = 300e6
poisson_ratio = 0.3
density = 1000
"""


class SnapshotStub(dict[str, Any]):
    """Arrays by name, as a Snapshot gives them."""

    def __init__(self, time: float, position: Array, velocity: Array, is_fixed: Array) -> None:
        super().__init__(position=position, velocity=velocity, is_fixed=is_fixed)
        self.time = time
        self.solid = np.ones(len(position), dtype=bool)
        self.fluid = ~self.solid


class SnapshotsStub(list[SnapshotStub]):
    @property
    def times(self) -> Array:
        return np.array([snapshot.time for snapshot in self])


class RunStub:
    def __init__(self, history: dict[str, Array], snapshots: SnapshotsStub | None = None) -> None:
        self.history, self.snapshots, self.case_text = history, snapshots or SnapshotsStub(), CASE


def lattice() -> tuple[Array, Array]:
    """Positions of a beam with two columns in its clamp, and of the clamp's fixed layers; which are fixed."""
    columns, rows = np.meshgrid(np.arange(-2, round(LENGTH / SPACING)), np.arange(-1, ROWS + 1), indexing="ij")
    is_fixed = (rows < 0) | (rows >= ROWS)
    there = (columns < 0) | ~is_fixed
    position = (np.stack([columns, rows], axis=-1)[there] + 0.5) * SPACING
    return position, is_fixed[there].astype(int)


def snapshot(time: float, amplitude: float = 0.0, rate: float = 0.0) -> SnapshotStub:
    """The beam in its first mode."""
    position, is_fixed = lattice()
    beam = Beam(LENGTH, 0.25e-3, 300e6, 0.3, 1000.0, True)
    shape = np.where(position[:, 0] > 0, beam.shapes(1, position[:, 0])[0], 0.0)
    vertical = np.stack([np.zeros_like(shape), shape], axis=-1)
    return SnapshotStub(time, position + amplitude * vertical, rate * vertical, is_fixed)


class Deflection(unittest.TestCase):
    def test_the_lowest_point_of_a_parabola_between_rows(self) -> None:
        times = np.array([0.0, 1.0, 2.2, 3.0, 4.0])
        time, lowest = beam_quantities.lowest_point(times, 0.5 * (times - 2.4) ** 2 - 3.0)
        self.assertAlmostEqual(time, 2.4)
        self.assertAlmostEqual(lowest, -3.0)

    def test_a_beam_that_still_sinks_has_none(self) -> None:
        times = np.linspace(0.0, 1.0, 11)
        run = RunStub({"time": times, "deflection": -times})
        self.assertTrue(all(math.isnan(value) for value in beam_quantities.deepest_deflection(run)))  # type: ignore[arg-type]

    def test_depth_is_positive_downwards(self) -> None:
        times = np.linspace(0.0, 2 * math.pi, 1001)
        time, depth = beam_quantities.deepest_deflection(RunStub({"time": times, "deflection": -2e-3 * np.sin(times)}))  # type: ignore[arg-type]
        self.assertAlmostEqual(time, 0.5 * math.pi, places=5)
        self.assertAlmostEqual(depth, 2e-3, places=9)

    def test_deviation_from_proportion(self) -> None:
        self.assertAlmostEqual(beam_quantities.deviation_from_proportion([1, 2, 4], [3, 6, 12]), 0.0)
        # Least squares: s = (1 * 1 + 1 * 1.2) / 2 = 1.1.
        self.assertAlmostEqual(beam_quantities.deviation_from_proportion([1, 1], [1, 1.2]), 0.1 / 1.1)


class Contact(unittest.TestCase):
    def test_deviation_from_line(self) -> None:
        self.assertAlmostEqual(beam_quantities.deviation_from_line([1, 2, 4], [5, 8, 14]), 0.0)
        # The line through (0, 1), (1, 1), (2, 1) with its middle raised by 0.3 is 1.1.
        self.assertAlmostEqual(beam_quantities.deviation_from_line([0, 1, 2], [1, 1.3, 1]), 0.2 / 1.1)

    def setUp(self) -> None:
        """10 N/m evenly from 0.1 to 1.1 ms, chattering; again from 2 to 2.2 ms."""
        times = np.arange(301) * 1e-5
        touches = ((times > 0.995e-4) & (times < 1.1005e-3)) | ((times > 1.9995e-3) & (times < 2.2005e-3))
        count = np.where(touches & (np.arange(301) % 3 > 0), 2.0, 0.0)
        count[[10, 110, 200, 220]] = 1.0
        force = np.where(touches, -10.0, 0.0)
        impulse = np.concatenate([[0.0], np.cumsum(force[:-1]) * 1e-5])
        self.run_ = RunStub({"time": times, "contact_count": count, "contact_impulse_y": impulse, "drop_width": times * 2})

    def test_a_drop_that_is_caught_again_has_left_before(self) -> None:
        episodes = beam_quantities.contact_episodes(self.run_)  # type: ignore[arg-type]
        # The impulse still changes in the row after the last contact.
        np.testing.assert_allclose(episodes, [(0.1e-3, 1.11e-3), (2.0e-3, 2.21e-3)])
        self.assertAlmostEqual(beam_quantities.leaving_time(self.run_), 1.11e-3)  # type: ignore[arg-type]
        self.assertAlmostEqual(beam_quantities.contact_time(self.run_), 1.01e-3)  # type: ignore[arg-type]

    def test_the_impulse_is_that_until_they_part(self) -> None:
        self.assertAlmostEqual(beam_quantities.impulse_time(self.run_, 0.5), 0.505e-3, places=9)  # type: ignore[arg-type]
        self.assertAlmostEqual(beam_quantities.impulse_time(self.run_), 0.9999e-3, places=9)  # type: ignore[arg-type]

    def test_a_run_that_ends_in_contact_has_no_leaving(self) -> None:
        short = RunStub({name: values[:80] for name, values in self.run_.history.items()})
        for quantity in (beam_quantities.leaving_time, beam_quantities.contact_time, beam_quantities.impulse_time):
            self.assertTrue(math.isnan(quantity(short)))  # type: ignore[arg-type]
        untouched = RunStub({name: values * (name == "time") for name, values in self.run_.history.items()})
        self.assertEqual(beam_quantities.contact_episodes(untouched), [])  # type: ignore[arg-type]
        self.assertTrue(math.isnan(beam_quantities.contact_time(untouched)))  # type: ignore[arg-type]

    def test_the_history_between_rows(self) -> None:
        self.assertAlmostEqual(beam_quantities.history_at(self.run_, "drop_width", 1.234e-3), 2.468e-3)  # type: ignore[arg-type]
        self.assertTrue(math.isnan(beam_quantities.history_at(self.run_, "drop_width", math.nan)))  # type: ignore[arg-type]


class Theory(unittest.TestCase):
    def test_eqs_43_to_47(self) -> None:
        theory = beam_quantities.theory_of(RunStub({}))  # type: ignore[arg-type]
        omega = 3.5160152686 * math.sqrt(300e6 * 0.25e-3**3 / 12 / (1000 * 0.25e-3 * 8e-3 * 8e-3**3 * 0.91))
        self.assertAlmostEqual(theory.angular_frequency / omega, 1.0, places=9)
        self.assertAlmostEqual(theory.period, 2.760e-3, delta=1e-6)
        drop, beam = 1000 * math.pi * 1e-6 / 4, 2e-3
        self.assertAlmostEqual(theory.largest_deflection, theory.period * drop * 0.8 / (4 * (drop + beam / 2)), places=12)
        self.assertAlmostEqual(theory.relative_deflection, theory.largest_deflection / 8e-3)
        self.assertEqual(beam_quantities.rows_across(RunStub({})), ROWS)  # type: ignore[arg-type]


class Sections(unittest.TestCase):
    def test_displacement_at_a_place(self) -> None:
        deformed = snapshot(1e-3)
        slope, lift = 0.02, 3e-4
        # Linear in x, and opposite in the rows, so that a section's mean is that of its middle.
        deformed["position"] = deformed["position"] + np.stack(
            [slope * (deformed["position"][:, 1] - ROWS * SPACING / 2), slope * deformed["position"][:, 0] + lift], axis=-1)
        run = RunStub({}, SnapshotsStub([snapshot(0.0), deformed]))
        times, found = beam_quantities.section_displacement(run, 5.013e-3)  # type: ignore[arg-type]
        np.testing.assert_allclose(times, [0.0, 1e-3])
        np.testing.assert_allclose(found, [[0.0, 0.0], [0.0, slope * 5.013e-3 + lift]], atol=1e-15)

    def test_neighbours_of_a_lattice(self) -> None:
        i, j = beam_quantities.reference_neighbours(np.array([[0.0, 0], [1, 0], [0, 1], [1, 1], [0, 3]]), 1.0)
        self.assertEqual({frozenset(pair) for pair in zip(i.tolist(), j.tolist())},
                         {frozenset(pair) for pair in ((0, 1), (2, 3), (0, 2), (1, 3))})
        position, _ = lattice()
        i, j = beam_quantities.reference_neighbours(position, SPACING)
        np.testing.assert_allclose(np.hypot(*(position[i] - position[j]).T), SPACING)
        columns = round(LENGTH / SPACING)
        inner = columns * (ROWS - 1) + (columns - 1) * ROWS
        in_clamp = 2 * (ROWS + 1) + (ROWS + 2) + ROWS  # two columns, between them, and to the first free one
        self.assertEqual(len(i), inner + in_clamp)

    def test_a_crack_is_the_largest_gap(self) -> None:
        cracked = snapshot(1e-3)
        right = cracked["position"][:, 0] > 1e-3
        cracked["position"] = cracked["position"] + np.where(right[:, None], [0.3 * SPACING, 0.0], 0.0)
        run = RunStub({}, SnapshotsStub([snapshot(0.0), cracked]))
        self.assertAlmostEqual(beam_quantities.largest_gap(run, run.snapshots[0]), 1.0)  # type: ignore[arg-type]
        self.assertAlmostEqual(beam_quantities.largest_gap_of_run(run), 1.3)  # type: ignore[arg-type]
        places, stretch = beam_quantities.gaps(run, cracked)  # type: ignore[arg-type]
        np.testing.assert_allclose(places[stretch > 1.1, 0], 1e-3, atol=1e-12)
        self.assertEqual(np.count_nonzero(stretch > 1.1), ROWS)


    def test_the_strain_of_the_outermost_rows_is_that_of_a_beam_bent_to_an_arc(self) -> None:
        """Sections stay plane and turn by x/radius; the centre line is stretched by 1 %."""
        radius, stretch = 5e-3, 0.01
        bent = snapshot(1e-3)
        x, y = bent["position"][:, 0], bent["position"][:, 1] - ROWS * SPACING / 2
        angle = (1 + stretch) * x / radius
        arc = np.stack([(radius - y) * np.sin(angle), radius - (radius - y) * np.cos(angle) + ROWS * SPACING / 2], axis=-1)
        bent["position"] = np.where((x > 0)[:, None], arc, bent["position"])
        run = RunStub({}, SnapshotsStub([snapshot(0.0), bent]))
        # The mean of a section's particles is its middle, whose stretch is 1 %; curvature is angle over reference length.
        expected = stretch + (1 + stretch) / radius * (ROWS - 1) / 2 * SPACING
        self.assertAlmostEqual(beam_quantities.largest_row_strain(run), expected, delta=1e-3 * expected)  # type: ignore[arg-type]
        gap = beam_quantities.largest_gap_of_run(run) - 1  # type: ignore[arg-type]
        self.assertAlmostEqual(gap / expected, 1.0, delta=0.01)
        free = bent["position"][:, 0] > 4e-3
        bent["position"] = bent["position"] + np.where(free[:, None], [0.3 * SPACING, 0.0], 0.0)
        cracked = beam_quantities.largest_gap_of_run(run) - 1  # type: ignore[arg-type]
        self.assertGreater(cracked / beam_quantities.largest_row_strain(run), 2)  # type: ignore[arg-type]


class Frequency(unittest.TestCase):
    def test_a_damped_sinusoid_of_two_periods_about_another_place(self) -> None:
        times = np.linspace(0.0, 6e-3, 3001)
        values = 1e-5 + 5e-5 * np.exp(-40 * times) * np.sin(2000 * times + 0.3)
        fit = beam_frequency.fit_damped_sinusoid(times, values, 2276.0)
        self.assertAlmostEqual(fit.angular_frequency / 2000, 1.0, delta=1e-6)
        self.assertAlmostEqual(fit.decay / 40, 1.0, delta=1e-4)
        self.assertLess(fit.residual, 1e-6)
        self.assertAlmostEqual(fit.energy_loss_per_period, 1 - math.exp(-2 * 40 * 2 * math.pi / 2000), places=5)

    def test_half_a_period_is_enough_about_zero(self) -> None:
        times = np.linspace(0.0, 0.55 * math.pi / 1000, 301)
        fit = beam_frequency.fit_damped_sinusoid(times, np.exp(-30 * times) * np.cos(2000 * times), 1700.0)
        self.assertAlmostEqual(fit.angular_frequency / 2000, 1.0, delta=1e-4)

    def test_the_driven_oscillator_is_exact(self) -> None:
        omega, decay, mass, force = 2000.0, 60.0, 2e-3, 0.1
        times = np.linspace(0.0, 5e-3, 37)
        q, v = beam_frequency.driven_oscillator(times, force * times, mass, np.array([omega]), np.array([decay]))
        static = force / mass / (omega**2 + decay**2)
        fading = np.exp(-decay * times)
        np.testing.assert_allclose(
            q[:, 0], static * (1 - fading * (np.cos(omega * times) + decay / omega * np.sin(omega * times))), atol=1e-12 * static)
        np.testing.assert_allclose(v[:, 0], force / mass / omega * fading * np.sin(omega * times), atol=1e-12)

    def test_the_first_mode_of_a_beam_watched_for_a_third_of_a_period(self) -> None:
        """The second mode rings as well; the projection must not see it."""
        beam = Beam(LENGTH, 0.25e-3, 300e6, 0.3, 1000.0, True)
        times = np.linspace(0.0, 1.2e-3, 601)
        impulses = np.where(times < 0.5e-3, 1e-6, 0.0)
        impulses[0] = 0.0
        place = np.full(len(times), 7.5e-3)
        omega = 0.87 * beam.angular_frequencies(2)[0]
        drive = np.cumsum(impulses) * beam.shapes(1, place[:1])[0, 0]
        q, v = beam_frequency.driven_oscillator(times, drive, beam.mass, np.array([omega]), np.array([25.0]))
        snapshots = SnapshotsStub()
        for k in range(0, 601, 25):
            state = snapshot(times[k], q[k, 0], v[k, 0])
            shape = np.where(state["position"][:, 0] > 0, beam.shapes(2, lattice()[0][:, 0])[1], 0.0)
            state["position"][:, 1] += 2e-5 * math.sin(12000 * times[k]) * shape
            snapshots.append(state)
        moment = np.cumsum(impulses * place)
        run = RunStub({"time": times, "contact_impulse_y": np.cumsum(impulses), "contact_angular_impulse": moment}, snapshots)
        found_times, found_q, found_v = beam_frequency.first_mode_amplitude(run)  # type: ignore[arg-type]
        np.testing.assert_allclose(found_times, times[::25])
        np.testing.assert_allclose(found_q, q[::25, 0], atol=2e-3 * np.abs(q).max())
        np.testing.assert_allclose(found_v, v[::25, 0], atol=1e-9)
        fit = beam_frequency.first_mode(run)  # type: ignore[arg-type]
        self.assertAlmostEqual(fit.angular_frequency / omega, 1.0, delta=2e-3)
        self.assertAlmostEqual(fit.decay, 25.0, delta=10.0)


if __name__ == "__main__":
    unittest.main()
