"""The model of how a step scales: against what was counted, against limits worked out by hand, and its page."""

from __future__ import annotations

import csv
import math
import unittest
from dataclasses import fields, replace
from pathlib import Path

import model
from model import Costs, Design, Network

FREE = Costs(**{field.name: 0.0 for field in fields(Costs)} | {
    "steps_between_detections": 1.0, "steps_between_redistributions": 1.0, "redistributions_between_partitions": 1.0,
})
INSTANT = Network(latency=0.0, bandwidth=math.inf)


class TrafficTest(unittest.TestCase):
    def test_a_rank_alone_writes_to_nobody(self) -> None:
        alone = model.traffic(1e5, 1)
        self.assertEqual([getattr(alone, field.name) for field in fields(alone)], [0] * len(fields(alone)))

    def test_mean_bytes_are_near_those_counted(self) -> None:
        rows = model.counted_of_many()
        self.assertGreaterEqual(len(rows), 12)
        self.assertGreaterEqual(max(ranks for _, ranks, _ in rows), 32)
        for particles, ranks, size in rows:
            with self.subTest(particles=particles, ranks=ranks):
                self.assertLess(abs(model.traffic(particles, ranks).size / size - 1), 0.15)

    def test_the_owner_is_the_rank_with_most(self) -> None:
        for row in model.counted_traffic():
            if row["particles"] / row["ranks"] < 250:
                continue
            with self.subTest(particles=row["particles"], ranks=row["ranks"]):
                predicted = model.traffic(row["particles"], int(row["ranks"]))
                self.assertLess(abs(predicted.owner_size / row["most_bytes"] - 1), 0.3)
                self.assertLess(abs(predicted.owner_messages / row["most_messages"] - 1), 0.6)

    def test_every_rank_holds_all_contributions(self) -> None:
        for row in model.counted_traffic():
            known = model.CONTRIBUTION_BYTES * model.occupied_cells(row["particles"])
            with self.subTest(particles=row["particles"], ranks=row["ranks"]):
                # Cells at the surface are partly empty; new owners and counts go to all too.
                self.assertGreater(row["redistribution_collective_bytes"], known)
                self.assertLess(row["redistribution_collective_bytes"], 3 * known + 12_000)

    def test_the_fit_finds_the_perimeter_it_was_given(self) -> None:
        counted = [(n, p, model.traffic(n, p, 5.5).size) for n in (1e4, 1e6) for p in (2, 8, 64)]
        self.assertAlmostEqual(model.fit_perimeter(counted), 5.5, places=9)
        self.assertAlmostEqual(model.fit_perimeter(model.counted_of_many()), model.PERIMETER, places=2)

    def test_bytes_of_a_rank_fall_with_the_root_of_the_ranks(self) -> None:
        few, many = model.traffic(1e8, 100), model.traffic(1e8, 10_000)
        self.assertAlmostEqual(few.halo_rows / many.halo_rows, 10, delta=1)


class TimeTest(unittest.TestCase):
    def test_sweeps_alone_scale_ideally(self) -> None:
        costs = replace(FREE, particle=50e-9)
        self.assertAlmostEqual(model.step_time(1e6, 1, costs, INSTANT).total, 0.05)
        self.assertAlmostEqual(model.efficiency(1e6, 1000, costs, INSTANT), 1.0)

    def test_an_imbalance_is_paid_by_all(self) -> None:
        self.assertAlmostEqual(model.efficiency(1e6, 4, replace(FREE, particle=50e-9, imbalance=0.25), INSTANT), 0.8)

    def test_the_owner_limits_ranks_to_the_root_of_the_particles(self) -> None:
        # Half of the time is the owner's where its own part costs as much as its curve.
        costs = replace(FREE, particle=50e-9, curve_point=100e-9)
        particles = 1e8
        ranks = round(particles * 50e-9 / (model.curve_points(particles) * 100e-9))
        alone = model.step_time(particles, 1, costs, INSTANT).total
        self.assertAlmostEqual(alone / ranks / model.step_time(particles, ranks, costs, INSTANT).total, 0.5, places=2)
        self.assertGreater(model.efficiency(particles, ranks, costs, INSTANT, Design(shared_interface=True)), 0.9)

    def test_others_do_the_sweep_of_what_the_owner_is_weighed_with(self) -> None:
        costs = replace(FREE, particle=50e-9, curve_point=75e-9, weighed_point=1.5)
        self.assertAlmostEqual(model.efficiency(1e6, 4, costs, INSTANT), 1.0)
        many = model.step_time(1e6, 1000, costs, INSTANT)  # 3545 points weigh more than 1000 particles
        self.assertAlmostEqual(many.owner, 75e-9 * model.curve_points(1e6) - 0.8 * 50e-9 * 1000)

    def test_what_every_rank_does_for_all_cells_does_not_scale(self) -> None:
        costs = replace(FREE, list_cell=1e-6, partition_cell=2e-6)
        cells = 1e6 / model.LIST_REACH**2
        as_it_is = model.step_time(1e6, 100, costs, INSTANT)
        self.assertAlmostEqual(as_it_is.redistribution, 1e-6 * cells)
        self.assertAlmostEqual(as_it_is.partition, 2e-6 * cells)
        shared = model.step_time(1e6, 100, costs, INSTANT, Design(shared_cells=True))
        self.assertAlmostEqual(shared.redistribution + shared.partition, 3e-8 * cells)

    def test_a_reduction_goes_up_and_down_a_tree(self) -> None:
        self.assertAlmostEqual(model.step_time(1e3, 8, FREE, Network(1e-6, math.inf)).reduction, 6e-6)

    def test_rare_events_are_spread_over_the_steps_between(self) -> None:
        costs = replace(FREE, detection_particle=1e-7, list_particle=1e-6, steps_between_detections=100, steps_between_redistributions=1000)
        step = model.step_time(1e4, 1, costs, INSTANT)
        self.assertAlmostEqual(step.detection, 1e-5)
        self.assertAlmostEqual(step.redistribution, 1e-5)

    def test_more_ranks_are_used_less(self) -> None:
        costs = model.read_costs()
        shares = [model.efficiency(1e7, 2**k, costs) for k in range(14)]
        self.assertEqual(shares, sorted(shares, reverse=True))
        self.assertEqual(shares[0], 1.0)
        useful = model.useful_ranks(1e7, costs)
        self.assertGreaterEqual(model.efficiency(1e7, useful, costs), 0.5)
        self.assertLess(model.efficiency(1e7, 2 * useful, costs), 0.5)


class MemoryTest(unittest.TestCase):
    def test_what_is_replicated_stays_on_many_ranks(self) -> None:
        costs = replace(FREE, particle_bytes=400, replicated_bytes=40, cell_bytes=100)
        set_up, in_a_step = model.memory(1e6, 1, costs)
        self.assertAlmostEqual(set_up, 440e6)
        self.assertAlmostEqual(in_a_step, 400e6 + 100e6 / model.LIST_REACH**2)
        self.assertGreater(model.memory(1e6, 1000, costs)[0], 40e6)
        self.assertAlmostEqual(model.memory(1e6, 1000, costs, Design(shared_set_up=True))[0], 440e3)

    def test_so_is_the_time_to_make_it(self) -> None:
        costs = replace(FREE, set_up_particle=1e-6)
        self.assertAlmostEqual(model.set_up_time(1e6, 100, costs), 1.0)
        self.assertAlmostEqual(model.set_up_time(1e6, 100, costs, Design(shared_set_up=True)), 0.01)


class PageTest(unittest.TestCase):
    maxDiff = None

    def test_every_cost_has_a_source(self) -> None:
        with (Path(model.__file__).parent / "costs.csv").open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([row["name"] for row in rows], [field.name for field in fields(Costs)])
        for row in rows:
            self.assertTrue(row["unit"] and len(row["source"]) > 20, row)

    def test_its_tables_are_those_of_the_model(self) -> None:
        text = model.PAGE.read_text(encoding="utf-8")
        self.assertEqual(text, model.page_with(text, model.tables(model.read_costs())), "write them anew: model.py page")
        self.assertIn("| as it is |", text)


if __name__ == "__main__":
    unittest.main()
