"""The ledgers of runs whose histories are made up, so that what does not add up is known."""

from __future__ import annotations

import math
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison.ledger_figures import draw_ledgers  # noqa: E402
from comparison.ledgers import largest_rise, ledger_of  # noqa: E402
from comparison.study import Results  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

TIME = np.linspace(0.0, 2e-3, 201)
MASS = 1000 * math.pi / 4 * 1e-6  # of a round drop of 1 mm, kg/m
SPEED = 0.8


def write_run(folder: Path, columns: dict[str, np.ndarray], gravity: float = 0.0, shape: str = "round") -> Run:
    folder.mkdir(parents=True, exist_ok=True)
    columns = {"time": TIME, "unaccounted": 0 * TIME, "total": 0 * TIME, **columns}
    table = np.column_stack(list(columns.values()))
    header = ",".join(f"{name} [1]" for name in columns)
    np.savetxt(folder / "history.csv", table, fmt="%.17g", delimiter=",", header=header, comments="")
    (folder / "case.cfg").write_text(
        f'[fluid]\ndensity = 1000\n[drop]\nshape = "{shape}"\ndiameter = 1e-3\n[gravity]\nacceleration = [0, {gravity}]\n',
        encoding="utf-8")
    return Run(folder)


class Case(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Energy(Case):
    def test_shares_are_of_the_kinetic_energy_at_the_start(self) -> None:
        start = 0.5 * MASS * SPEED**2
        unaccounted = -0.03 * start * np.sin(2e3 * TIME)
        ledger = ledger_of(write_run(self.folder, {"kinetic_fluid": start * (1 - 400 * TIME), "unaccounted": unaccounted}))
        self.assertAlmostEqual(ledger.energy_scale, start)
        self.assertAlmostEqual(ledger.unaccounted, np.abs(unaccounted).max() / start)

    def test_from_rest_they_are_of_the_largest_change_of_one_energy(self) -> None:
        columns = {"kinetic_fluid": 1e-6 * np.sin(1e3 * TIME) ** 2, "surface": 3e-4 - 3e-5 * TIME / TIME[-1], "elastic": 2e-5 + 0 * TIME}
        ledger = ledger_of(write_run(self.folder, {**columns, "unaccounted": 6e-7 * TIME / TIME[-1]}))
        self.assertAlmostEqual(ledger.energy_scale, 3e-5)
        self.assertAlmostEqual(ledger.unaccounted, 0.02)

    def test_a_rise_counts_from_the_lowest_point_before_and_without_named_causes(self) -> None:
        self.assertAlmostEqual(largest_rise(np.array([5.0, 3.0, 4.0, 3.5, 1.0, 1.5])), 1.0)
        self.assertEqual(largest_rise(np.array([5.0, 3.0, 1.0])), 0.0)
        put_in = {"density_correction": 1e-5 * TIME / TIME[-1], "artificial_stress_work": 2e-5 * TIME / TIME[-1],
                  "reconnection": -1e-5 * TIME / TIME[-1]}
        total = 1e-4 + sum(put_in.values())
        columns = {"kinetic_fluid": 1e-4 + 0 * TIME, **put_in}
        self.assertAlmostEqual(ledger_of(write_run(self.folder / "a", {**columns, "total": total})).rise, 0.0)
        total = total + 4e-6 * TIME / TIME[-1]
        self.assertAlmostEqual(ledger_of(write_run(self.folder / "b", {**columns, "total": total})).rise, 0.04)


class Momentum(Case):
    def columns(self) -> dict[str, np.ndarray]:
        """A drop that is thrown back at (x, y) = (7 mm, 0.5 mm), and its impulse on the solid."""
        turned = TIME / TIME[-1]
        y = -MASS * SPEED + 1.5 * MASS * SPEED * turned
        return {"kinetic_fluid": 0.5 * y**2 / MASS, "momentum_fluid_y": y, "contact_impulse_y": y[0] - y,
                "angular_momentum_fluid": 7e-3 * y, "contact_angular_impulse": 7e-3 * (y[0] - y)}

    def test_balanced_exchange_leaves_nothing(self) -> None:
        ledger = ledger_of(write_run(self.folder, self.columns()))
        self.assertAlmostEqual(ledger.momentum_scale, MASS * SPEED)
        self.assertLess(ledger.momentum_mismatch, 1e-14)
        self.assertLess(ledger.angular_mismatch, 1e-13)

    def test_what_is_lost_is_a_share_of_that_at_the_start(self) -> None:
        columns = self.columns()
        columns["contact_impulse_y"] = columns["contact_impulse_y"] + 0.03 * MASS * SPEED * TIME / TIME[-1]
        columns["contact_impulse_x"] = -0.04 * MASS * SPEED * TIME / TIME[-1]
        columns["contact_angular_impulse"] = columns["contact_angular_impulse"] - 0.02 * MASS * SPEED * 1e-3 * TIME / TIME[-1]
        ledger = ledger_of(write_run(self.folder, columns))
        self.assertAlmostEqual(ledger.momentum_mismatch, 0.05)
        self.assertAlmostEqual(ledger.angular_mismatch, 0.02)

    def test_gravity_is_accounted_for(self) -> None:
        g = -9.81
        y = MASS * (-SPEED + g * TIME)
        centre = 2e-3 + 0 * TIME
        columns = {"kinetic_fluid": 0.5 * y**2 / MASS, "momentum_fluid_y": y, "drop_centre_x": centre, "angular_momentum_fluid": centre * y}
        ledger = ledger_of(write_run(self.folder / "with", columns, gravity=g))
        self.assertLess(ledger.momentum_mismatch, 1e-14)
        self.assertLess(ledger.angular_mismatch, 1e-13)
        ledger = ledger_of(write_run(self.folder / "without", columns))
        self.assertAlmostEqual(ledger.momentum_mismatch, 9.81 * TIME[-1] / SPEED)
        self.assertAlmostEqual(ledger.angular_mismatch, 2 * 9.81 * TIME[-1] / SPEED)

    def test_without_a_drop_there_is_none(self) -> None:
        nothing = np.full_like(TIME, math.nan)
        ledger = ledger_of(write_run(self.folder, {"kinetic_solid": 1e-5 + 0 * TIME, "drop_centre_x": nothing}, shape="none"))
        self.assertTrue(math.isnan(ledger.momentum_mismatch))
        self.assertEqual(ledger.energy_scale, 1e-5)


class Figures(Case):
    def test_one_large_and_small_ones_for_all(self) -> None:
        columns = Momentum.columns(self)
        write_run(self.folder / "first", columns)
        write_run(self.folder / "second", {"kinetic_solid": 1e-5 + 0 * TIME}, shape="none")
        results = Results({name: self.folder / name for name in ("first", "second")}, "short")
        drawings = draw_ledgers(results, self.folder)
        self.assertEqual([drawing.path.name for drawing in drawings], ["ledger.png", "ledgers.png"])
        for drawing in drawings:
            self.assertGreater(drawing.path.stat().st_size, 10_000)
        self.assertIn("first", drawings[0].caption)
        self.assertEqual(len(draw_ledgers(Results({"second": self.folder / "second"}, "short"), self.folder)), 1)


if __name__ == "__main__":
    unittest.main()
