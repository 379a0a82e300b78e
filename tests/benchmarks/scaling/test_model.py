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

    def test_the_rank_with_most_is_at_the_surface(self) -> None:
        for row in model.counted_traffic():
            if row["particles"] / row["ranks"] < 250:
                continue
            with self.subTest(particles=row["particles"], ranks=row["ranks"]):
                predicted = model.traffic(row["particles"], int(row["ranks"]))
                self.assertLess(abs(predicted.surface_size / row["most_bytes"] - 1), 0.4)
                self.assertLess(abs(predicted.surface_messages / row["most_messages"] - 1), 0.6)

    def test_every_rank_holds_all_contributions(self) -> None:
        for row in model.counted_traffic():
            known = model.CONTRIBUTION_BYTES * model.dealt_out_cells(row["particles"], int(row["ranks"]))
            with self.subTest(particles=row["particles"], ranks=row["ranks"]):
                # Cells at the surface are partly empty; new owners and counts go to all too.
                self.assertGreater(row["redistribution_collective_bytes"], known)
                self.assertLess(row["redistribution_collective_bytes"], 3 * known + 20_000)

    def test_cells_are_as_many_as_ranks_need(self) -> None:
        for particles in (1e4, 1e6, 1e9):
            for ranks in (1, 7, 1000):
                cells = model.dealt_out_cells(particles, ranks)
                if cells < particles / model.LIST_REACH**2:
                    self.assertGreaterEqual(cells / ranks, 64)
                self.assertLess(cells / ranks, 256)

    def test_the_fit_finds_the_perimeter_it_was_given(self) -> None:
        counted = [(n, p, model.traffic(n, p, 4.3).size) for n in (1e4, 1e6) for p in (16, 32, 64)]
        self.assertAlmostEqual(model.fit_perimeter(counted), 4.3, places=9)
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

    def test_the_surface_is_dealt_out_but_for_the_ends_of_its_pieces(self) -> None:
        costs = replace(FREE, particle=50e-9, curve_point=100e-9)
        self.assertGreater(model.efficiency(1e8, 1000, costs, INSTANT), 0.999)
        many = model.step_time(1e6, 10_000, costs, INSTANT)
        self.assertAlmostEqual(many.surface, 100e-9 * (model.curve_points(1e6) / 10_000 + model.TWICE))

    def test_what_every_rank_does_for_all_cells_does_not_scale(self) -> None:
        costs = replace(FREE, list_cell=1e-6, partition_cell=2e-6)
        cells = model.dealt_out_cells(1e6, 100)
        as_it_is = model.step_time(1e6, 100, costs, INSTANT)
        self.assertAlmostEqual(as_it_is.redistribution, 1e-6 * cells)
        self.assertAlmostEqual(as_it_is.partition, 2e-6 * cells)
        shared = model.step_time(1e6, 100, costs, INSTANT, Design(shared_cells=True))
        self.assertAlmostEqual(shared.redistribution + shared.partition, 3e-8 * cells)

    def test_nor_does_what_it_does_for_all_arcs(self) -> None:
        costs = replace(FREE, joined_arc=1e-6)
        self.assertAlmostEqual(model.step_time(1e6, 100, costs, INSTANT).joining, 1e-6 * model.curve_points(1e6))
        shared = model.step_time(1e6, 100, costs, INSTANT, Design(shared_arcs=True)).joining
        self.assertAlmostEqual(shared, 1e-6 * model.curve_points(1e6) / model.parts_at_surface(100))

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
    def test_a_rank_holds_its_own_and_the_table_of_cells(self) -> None:
        costs = replace(FREE, particle_bytes=400, set_up_bytes=40, cell_bytes=100)
        self.assertAlmostEqual(model.memory(1e6, 1, costs)[0], 440e6)
        set_up, in_a_step = model.memory(1e9, 1000, costs)
        self.assertAlmostEqual(set_up, 440e6)
        table = 100 * model.dealt_out_cells(1e9, 1000)
        self.assertAlmostEqual(in_a_step, 400 * (1e6 + model.traffic(1e9, 1000).halo_rows) + table)
        self.assertAlmostEqual(model.memory(1e9, 1000, costs, Design(shared_cells=True))[1], in_a_step - 0.999 * table, delta=1)

    def test_all_particles_are_gone_through_on_every_rank(self) -> None:
        costs = replace(FREE, set_up_particle=1e-6, walked_particle=1e-8)
        self.assertAlmostEqual(model.set_up_time(1e6, 100, costs), 0.02)
        self.assertAlmostEqual(model.set_up_time(1e6, 100, costs, Design(shared_walk=True)), 0.01)


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
