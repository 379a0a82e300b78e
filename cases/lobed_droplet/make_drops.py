#!/usr/bin/python3
"""Writes mode_2.csv, mode_3.csv, mode_4.csv beside this: drops R(1 + a cos n theta), made of rings of particles.

    /usr/bin/python3 cases/lobed_droplet/make_drops.py [--folder DIR] [--spacing M]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

RADIUS, SPACING, AMPLITUDE = 0.5e-3, 2.5e-5, 0.05  # m, m, over the radius
DENSITY = 1000.0  # kg/m3
MODES = (2, 3, 4)


def disc(spacing: float) -> tuple[NDArray[np.complex128], NDArray[np.float64]]:
    """Places x + iy in m and areas in m2 of particles on concentric rings, each with its share of its annulus."""
    rings = round(RADIUS / spacing)
    width = RADIUS / rings
    places, areas = [], []
    for k in range(rings):
        count = round(np.pi * (2 * k + 1))
        turns = np.arange(count) / count + k * 0.3819660112501051  # the golden angle: no two rings line up
        places.append((k + 0.5) * width * np.exp(2j * np.pi * turns))
        areas.append(np.full(count, np.pi * (2 * k + 1) * width**2 / count))
    return np.concatenate(places), np.concatenate(areas)


def swung_out(places: NDArray[np.complex128], mode: int) -> NDArray[np.complex128]:
    """Moved by the potential flow of the mode, which keeps areas to first order: the rim becomes R(1 + a cos n theta)."""
    return places + AMPLITUDE * RADIUS * np.conj(places / RADIUS) ** (mode - 1)


def write(folder: Path, spacing: float = SPACING) -> None:
    places, areas = disc(spacing)
    folder.mkdir(parents=True, exist_ok=True)
    for mode in MODES:
        lines = [f"# R(1 + {AMPLITUDE:g} cos {mode} theta) with R = {RADIUS * 1e3:g} mm, {spacing * 1e3:g} mm apart; written by make_drops.py",
                 "x [mm],y [mm],mass [mg/m]"]
        lines += [f"{z.real * 1e3:.6f},{z.imag * 1e3:.6f},{DENSITY * area * 1e6:.6f}" for z, area in zip(swung_out(places, mode), areas)]
        (folder / f"mode_{mode}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=Path, default=Path(__file__).resolve().parent)
    parser.add_argument("--spacing", type=float, default=SPACING, help="m")
    chosen = parser.parse_args()
    write(chosen.folder, chosen.spacing)
