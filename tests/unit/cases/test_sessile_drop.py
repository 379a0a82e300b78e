"""What the wetting drop's plot.py works out by itself: outlines, fitted caps, contact times, added mass."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison.study import CASES, Results, Study  # noqa: E402

import numpy as np  # noqa: E402

study: Any = Study(CASES / "sessile_drop").module()
SPACING = 0.05
SUPPORT = 2.4 * SPACING


def lattice(inside: Any) -> np.ndarray:
    """Particles of a square lattice where inside(x, y), a little irregular."""
    x, y = np.meshgrid(np.arange(-1.5, 1.5, SPACING), np.arange(0.5 * SPACING, 2.5, SPACING))
    points = np.column_stack((x.ravel(), y.ravel())) + np.random.default_rng(1).uniform(-0.02, 0.02, (x.size, 2)) * SPACING
    return points[inside(points[:, 0], points[:, 1])]


class Outline(unittest.TestCase):
    def test_of_a_block_is_its_rim(self) -> None:
        block = lattice(lambda x, y: (np.abs(x) < 0.51) & (y < 0.51))
        rim = set(study.boundary_particles(block, SUPPORT).tolist())
        low, high = block.min(axis=0) + 0.5 * SPACING, block.max(axis=0) - 0.5 * SPACING
        expected = {k for k, p in enumerate(block) if not np.all((low < p) & (p < high))}
        self.assertEqual(rim, expected)

    def test_a_hole_has_a_rim_too(self) -> None:
        ring = lattice(lambda x, y: (np.hypot(x, y - 1) < 0.8) & (np.hypot(x, y - 1) > 0.3))
        distance = np.hypot(*(ring[study.boundary_particles(ring, SUPPORT)] - (0, 1)).T)
        self.assertTrue(np.all((distance < 0.3 + 1.5 * SPACING) | (distance > 0.8 - 1.5 * SPACING)))
        self.assertGreater(np.sum(distance < 0.5), 20)

    def test_a_lone_particle_and_a_pair_are_boundary(self) -> None:
        self.assertEqual(study.boundary_particles(np.zeros((1, 2)), 1.0).tolist(), [0])
        self.assertEqual(study.boundary_particles(np.array([[0.0, 0.0], [0.5, 0.0]]), 1.0).tolist(), [0, 1])


class FittedCap(unittest.TestCase):
    def test_of_rings_cut_by_the_wall_is_theirs(self) -> None:
        for angle in (40.0, 90.0, 135.0):
            radius, height = 1.0, -math.cos(math.radians(angle))
            rings = []
            for ring in np.arange(0.5 * SPACING, radius, SPACING):
                turn = np.arange(0, 2 * math.pi, SPACING / ring)
                rings.append(np.column_stack((ring * np.cos(turn), height + ring * np.sin(turn))))
            liquid = np.concatenate(rings)
            liquid = liquid[liquid[:, 1] > 0]
            snapshot = {"position": liquid}
            cap = study.fitted_cap(Snapshot(snapshot, np.ones(len(liquid), dtype=bool)), SPACING, SUPPORT)
            self.assertAlmostEqual(math.degrees(cap.angle), angle, delta=1.5)
            self.assertAlmostEqual(cap.radius, radius, delta=0.02)

    def test_area_of_caps(self) -> None:
        self.assertAlmostEqual(study.segment_area(math.pi), math.pi)
        self.assertAlmostEqual(study.cap_radius(math.pi / 2, math.pi / 2), 1.0)


class Snapshot(dict[str, np.ndarray]):
    def __init__(self, columns: dict[str, np.ndarray], fluid: np.ndarray) -> None:
        super().__init__(columns)
        self.fluid = fluid


class Times(unittest.TestCase):
    def run_of(self, touches: np.ndarray) -> Any:
        times = np.linspace(0, 5e-3, 501)
        return SimpleNamespace(history={"time": times, "base_width": np.where(touches, 1e-4, 0.0),
                                        "contact_count": touches.astype(float)})

    def test_a_drop_leaves_with_its_base(self) -> None:
        index = np.arange(501)
        self.assertAlmostEqual(study.leaving_time(self.run_of((index >= 10) & (index <= 340))), 3.3e-3)
        self.assertAlmostEqual(study.last_push(self.run_of((index >= 10) & (index <= 340))), 3.3e-3)
        self.assertTrue(math.isnan(study.leaving_time(self.run_of(index >= 10))))


class Beam(unittest.TestCase):
    def test_a_mass_at_the_end_counts_whole(self) -> None:
        self.assertAlmostEqual(float(study.bending_mode(np.array([1.0]))[0]), 1.0)
        self.assertAlmostEqual(float(study.bending_mode(np.array([0.5]))[0]), 0.3395, delta=1e-4)
        snapshot = Snapshot({"position": np.array([[8e-3, 0.0]]), "mass": np.array([1.5e-3])}, np.array([True]))
        snapshot.time = 1.0  # type: ignore[attr-defined]
        run = SimpleNamespace(case_text="[solid]\nlength = 8e-3\nthickness = 0.25e-3\ndensity = 1000.0\n", snapshots=[snapshot])
        self.assertAlmostEqual(study.added_mass_factor(run, 0.0), math.sqrt(1 + 1.5 / 0.5))


class Expectations(unittest.TestCase):
    def test_rows_have_a_value_and_a_tolerance(self) -> None:
        for level in ("paper", "quick", "short"):
            rows = Study(CASES / "sessile_drop").expected(level)
            self.assertTrue(rows)
            for row in rows:
                self.assertTrue(math.isfinite(row.ours) and row.tolerance > 0, f"{level}: {row.quantity}")

    def test_no_runs_give_nothing(self) -> None:
        self.assertEqual(study.measure(Results({}, "paper")), {})
        self.assertEqual(study.draw(Results({}, "paper"), Path("/nonexistent")), [])


if __name__ == "__main__":
    unittest.main()
