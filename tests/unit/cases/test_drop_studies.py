"""What the drops' plot.py files work out by themselves: theory, outlines, gaps and zigzag."""

from __future__ import annotations

import importlib.util
import math
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison.study import CASES, Results, Study  # noqa: E402

import numpy as np  # noqa: E402

STUDIES = ("square_droplet", "oscillating_droplet", "rigid_wall", "artificial_stress", "lobed_droplet")


def module(name: str) -> Any:
    return Study(CASES / name).module()


class Expectations(unittest.TestCase):
    def test_rows_are_of_quantities_with_a_value_and_a_tolerance(self) -> None:
        for name in STUDIES:
            for level in ("paper", "quick", "short"):
                rows = Study(CASES / name).expected(level)
                self.assertTrue(rows, f"{name}, {level}")
                self.assertEqual(len(rows), len({row.quantity for row in rows}), f"{name}, {level}")
                for row in rows:
                    if math.isfinite(row.ours) or level == "short":
                        self.assertTrue(math.isfinite(row.ours) and row.tolerance > 0, f"{name}, {level}: {row.quantity}")
                    self.assertEqual(math.isfinite(row.goal), math.isfinite(row.goal_tolerance), row.quantity)

    def test_no_runs_give_no_quantities_and_no_pictures(self) -> None:
        for name in STUDIES:
            self.assertEqual(module(name).measure(Results({}, "paper")), {})
            self.assertEqual(module(name).draw(Results({}, "paper"), Path("/nonexistent")), [])


class MadeUpSnapshot(dict[str, Any]):
    """Of liquid alone."""

    @property
    def fluid(self) -> Any:
        return np.ones(len(self["mass"]), dtype=bool)


class LobedDrop(unittest.TestCase):
    drop = module("lobed_droplet")
    case_text = ("[drop]\ndiameter = 1e-3\n[fluid]\ndensity = 1000.0\nviscosity = 0.001\n"
                 "[surface_tension]\ncoefficient = 0.072\n")

    def test_theory(self) -> None:
        run = SimpleNamespace(case_text=self.case_text)
        for mode, period, decay in ((2, 3.3798e-3, 62.5e-3), (3, 1.6899e-3, 20.83e-3), (4, 1.0688e-3, 10.42e-3)):
            self.assertAlmostEqual(self.drop.ideal_period(run, mode), period, delta=1e-7)
            self.assertAlmostEqual(self.drop.ideal_decay_time(run, mode), decay, delta=1e-5)

    def test_the_files_are_what_the_script_writes_and_have_their_mode(self) -> None:
        folder = CASES / "lobed_droplet"
        found = importlib.util.spec_from_file_location("make_drops", folder / "make_drops.py")
        script = importlib.util.module_from_spec(found)
        found.loader.exec_module(script)
        with tempfile.TemporaryDirectory() as name:
            script.write(Path(name))
            for mode in script.MODES:
                own = np.loadtxt(folder / f"mode_{mode}.csv", delimiter=",", skiprows=2)
                new = np.loadtxt(Path(name) / f"mode_{mode}.csv", delimiter=",", skiprows=2)
                np.testing.assert_allclose(own, new, rtol=0, atol=2e-6)
                particles = {"position": own[:, :2] * 1e-3 + [1e-3, -2e-3], "mass": own[:, 2] * 1e-6}
                whole = MadeUpSnapshot(particles)
                for n in (2, 3, 4):
                    # Of a square of the amplitude there is a little in other modes.
                    self.assertAlmostEqual(self.drop.amplitude(whole, n, 0.5e-3), 0.05 if n == mode else 0.0,
                                           delta=5e-4 if n == mode else 6e-3)
                self.assertAlmostEqual(particles["mass"].sum() / (1000 * math.pi * 0.25e-6), 1.0, delta=1e-5)

    def test_measures_a_made_up_swing_that_is_not_about_zero(self) -> None:
        times = np.linspace(0, 3.6e-3, 91)
        values = 0.05 * np.exp(-50 * times) * np.cos(2 * math.pi * times / 1.7e-3) + 0.002
        self.assertAlmostEqual(self.drop.period(times, values), 1.7e-3, delta=2e-6)
        self.assertAlmostEqual(self.drop.decay_time(times, values), 1 / 50, delta=4e-4)


class OscillatingDrop(unittest.TestCase):
    drop = module("oscillating_droplet")

    def test_period_without_viscosity(self) -> None:
        self.assertAlmostEqual(2 * math.pi / self.drop.ideal_angular_frequency(0.5e-3), 3.3797e-3, delta=2e-7)

    def test_bessel_functions_are_the_tabulated_ones(self) -> None:
        for order, z, value in ((0, 1.0, 0.7651976866), (1, 2.0, 0.5767248078), (2, 3.0, 0.4860912606), (2, 10.0, 0.2546303137)):
            self.assertAlmostEqual(complex(self.drop.bessel(order, z)).real, value, places=9)
        # J_2(i x) = - I_2(x)
        self.assertAlmostEqual(complex(self.drop.bessel(2, 2j)).real, -0.6889484477, places=9)

    def test_little_viscosity_gives_the_known_limits(self) -> None:
        # 2 n (n - 1) nu/R^2, and the period of the ideal drop.
        period, rate = self.drop.viscous_swing(0.5e-3, 2e-6)
        self.assertAlmostEqual(rate / (4 * 2e-6 / 0.25e-6), 1.0, delta=0.06)
        self.assertAlmostEqual(period / (2 * math.pi / self.drop.ideal_angular_frequency(0.5e-3)), 1.0, delta=2e-3)

    def test_exact_dispersion(self) -> None:
        for viscosity, period, rate in ((1e-6, 3.3809e-3, 15.47), (3e-6, 3.3854e-3, 45.17), (10e-6, 3.4155e-3, 141.3)):
            found = self.drop.viscous_swing(0.5e-3, viscosity)
            self.assertAlmostEqual(found[0] / period, 1.0, delta=2e-5)
            self.assertAlmostEqual(found[1] / rate, 1.0, delta=5e-4)

    def test_measures_a_made_up_swing(self) -> None:
        times = np.linspace(0, 12e-3, 6001)
        values = 1e-8 * np.exp(-150 * times) * np.sin(2 * math.pi * times / 3.4e-3)
        run = SimpleNamespace(history={"time": times, "drop_elongation": values}, case_text="[drop]\ndiameter = 1e-3\n")
        found = self.drop.measure({"a": run})
        self.assertAlmostEqual(found["period_a"], 3.4e-3, delta=1e-7)
        # From the fourth crossing after the start, where the first row is no crossing.
        self.assertAlmostEqual(found["period_from_start_a"], 3.4e-3, delta=1e-7)
        self.assertAlmostEqual(found["decay_time_a"], 1 / 150, delta=1e-5)


class RigidWall(unittest.TestCase):
    wall = module("rigid_wall")

    def run_of(self, spacing: float, contact_time: float, width: float) -> Any:
        """In contact so long from 0.1 ms on under a constant force, as wide as `width` in mm at 1 ms."""
        times = np.arange(0.0, 6e-3, 1e-6)
        share = np.clip((times - 0.1e-3) / contact_time, 0, 1)
        history = {"time": times, "contact_count": (times >= 0.1e-3) & (times <= 0.1e-3 + contact_time + 1e-10),
                   "contact_impulse_y": -share, "drop_velocity_y": -0.8 + 1.2 * share, "drop_height": np.ones_like(times),
                   "drop_width": 1e-3 * (width - 1e5 * (times - 1e-3) ** 2)}
        return SimpleNamespace(history=history, case_text=f"[drop]\ndiameter = 1e-3\n[resolution]\nspacing = {spacing!r}\n")

    def test_order_and_limit_of_made_up_runs(self) -> None:
        # 4 ms - 10 d and 2 + (d/0.05 mm)^2: orders 1 and 2.
        runs = {name: self.run_of(d, 4e-3 - 10 * d, 2 + (d / 5e-5) ** 2)
                for name, d in (("spacing0.05", 5e-5), ("spacing0.0333", 3.2e-5), ("spacing0.0167", 1.6e-5))}
        base = self.run_of(2.5e-5, 3.75e-3, 2.25)
        runs["half_step"] = self.run_of(2.5e-5, 1.02 * 3.75e-3, 2.25)
        # "U0.8" asks for snapshots as well; here it has one particle.
        lone = {"position": np.zeros((2, 2)) + [[0, 0], [1, 0]], "mass": np.ones(2), "density": np.ones(2)}
        snapshot = type("Snapshot", (dict,), {"fluid": np.ones(2, dtype=bool)})(lone)
        base.snapshots = type("Snapshots", (list,), {"at": lambda self, time: self[0]})([snapshot, snapshot])
        found = self.wall.measure({**runs, "U0.8": base})
        self.assertEqual(found["swelling_U0.8"], 0.0)
        self.assertAlmostEqual(found["contact_time_order_spacing"], 1.0, delta=0.02)
        self.assertAlmostEqual(found["contact_time_limit_spacing"], 4e-3, delta=5e-6)
        self.assertAlmostEqual(found["spread_order_spacing"], 2.0, delta=0.01)
        self.assertAlmostEqual(found["spread_limit_spacing"], 2.0, delta=1e-3)
        self.assertAlmostEqual(found["contact_time_change_half_step"], 0.02, delta=5e-4)
        self.assertAlmostEqual(found["restitution_U0.8"], 0.5, delta=1e-9)
        self.assertAlmostEqual(found["widest_at_U0.8"], 1e-3, delta=1e-9)
        self.assertEqual(found["clumped_share_U0.8"], 0.0)
        self.assertNotIn("contact_time_order_same_viscosity", found)

    def test_speed_is_positive_downwards(self) -> None:
        self.assertEqual(self.wall.speed(SimpleNamespace(case_text="[drop]\nvelocity = [0, -0.7]\n")), 0.7)


class SquareDrop(unittest.TestCase):
    square = module("square_droplet")

    def disc(self, radius: float, spacing: float) -> Any:
        grid = np.arange(-radius, radius, spacing) + 0.5 * spacing
        points = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
        points = points[np.hypot(*points.T) < radius] + [3.0, -2.0]

        class Snapshot(dict):
            fluid = np.ones(len(points), dtype=bool)

        return Snapshot(position=points, mass=np.full(len(points), 1000 * spacing**2), density=np.full(len(points), 1000.0))

    def test_radius_of_a_disc(self) -> None:
        self.assertAlmostEqual(self.square.inertial_radius(self.disc(1.0, 0.01)), 1.0, delta=2e-3)

    def test_outline_is_half_a_spacing_outside_the_outermost_particles(self) -> None:
        angles = np.linspace(0, 2 * math.pi, 400, endpoint=False)
        ring = self.disc(1.0, 0.04)
        type(ring).fluid = np.ones(400, dtype=bool)
        ring.update(position=0.9 * np.column_stack([np.cos(angles), np.sin(angles)]), mass=np.full(400, 1.6),
                    density=np.full(400, 1000.0))
        np.testing.assert_allclose(self.square.outline(ring), 0.9 + 0.02)

    def test_outline_of_a_disc_and_of_an_ellipse(self) -> None:
        disc = self.disc(1.0, 0.01)
        radii = self.square.outline(disc)
        self.assertAlmostEqual(radii.mean(), 1.0, delta=0.01)
        self.assertLess(radii.std(), 0.005)
        disc["position"] = disc["position"] * [1.2, 1 / 1.2]
        self.assertAlmostEqual(self.square.outline(disc).max(), 1.2, delta=0.01)
        self.assertGreater(self.square.outline(disc).std(), 0.1)


class ArtificialStress(unittest.TestCase):
    beam = module("artificial_stress")
    spacing = 2.5e-5

    def lattice(self) -> Any:
        x, y = np.meshgrid(np.arange(-4, 200), np.arange(10), indexing="ij")
        start = (np.column_stack([x.ravel(), y.ravel()]) + 0.5) * self.spacing
        return self.beam.lattice_of(np.random.default_rng(0).permutation(start), self.spacing)

    def test_pairs_and_triples_of_a_lattice(self) -> None:
        lattice = self.lattice()
        self.assertEqual(len(lattice.pairs), 203 * 10 + 204 * 9)
        self.assertEqual(len(lattice.triples), 202 * 10 + 204 * 8)
        np.testing.assert_allclose(self.beam.gaps(lattice, lattice.start), 1.0)
        before, middle, after = lattice.triples.T
        np.testing.assert_allclose(lattice.start[before] + lattice.start[after], 2 * lattice.start[middle], atol=1e-15)

    def test_a_gap_near_the_clamp_is_found_and_one_far_off_is_not(self) -> None:
        lattice = self.lattice()
        for place, gap in ((0.5e-3, 1.3), (4e-3, 1.0)):
            opened = lattice.start + np.where(lattice.start[:, :1] > place, [[0.3 * self.spacing, 0.0]], 0.0)
            self.assertAlmostEqual(self.beam.largest_gap(lattice, opened), gap)

    def test_zigzag_of_known_amplitude(self) -> None:
        lattice = self.lattice()
        column = np.rint(lattice.start[:, 0] / self.spacing - 0.5)
        shaken = lattice.start.copy()
        shaken[:, 1] += 0.07 * self.spacing * (-1) ** column
        near = self.beam.is_near(lattice, lattice.triples)
        along = np.abs(np.diff(lattice.start[lattice.triples[near][:, :2], 1], axis=1)[:, 0]) < 0.5 * self.spacing
        self.assertAlmostEqual(self.beam.zigzag(lattice, shaken), 0.07 * math.sqrt(along.mean()), places=9)

    def test_a_bent_beam_has_next_to_no_zigzag(self) -> None:
        lattice = self.lattice()
        bent = lattice.start + np.column_stack([0 * lattice.start[:, 0], -20 * lattice.start[:, 0] ** 2])
        self.assertLess(self.beam.zigzag(lattice, bent), 1e-3)
        self.assertLess(self.beam.zigzag(lattice, bent @ np.array([[0.8, 0.6], [-0.6, 0.8]])), 1e-3)


if __name__ == "__main__":
    unittest.main()
