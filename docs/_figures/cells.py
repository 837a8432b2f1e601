"""Figures about the objects around an arm."""

from __future__ import annotations

import contextlib

import numpy as np
from concepts import WIDTH_IN
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import BLUE, INK, ORANGE, SOFT, settle_layout, style


def bench() -> hf.Cell:
    """Return the cell of the guide."""
    cell = hf.cell
    objects = [
        cell.Box("table", [0.8, 1.2, 0.04], pose=[0.5, 0, -0.03]),
        cell.Sphere("lamp", 0.12, pose=[0.45, 0.35, 0.8]),
        cell.Capsule("pipe", radius=0.04, length=0.6, pose=[0.5, -0.4, 0.5]),
        cell.HalfSpace("ground", pose=[0, 0, -0.8]),
    ]
    return hf.Cell(objects, may_touch=[("table", "base")])


def draw_clearance() -> Figure:
    """Draw the bound of the clearance and the exact clearance along a motion, with the nearest object."""
    arm = hf.arms.load("panda")
    clear = hf.Clearance(arm, cell=bench())
    start, end = np.array([-0.4, 0.0, 0.0, -1.9, 0.0, 2.1, 0.8]), np.array([0.34, 0.0, 0.0, -1.75, 0.0, 2.1, 0.8])
    steps = np.linspace(0, 1, 61)
    q = start + steps[:, None] * (end - start)
    bound, nearest = clear(q), clear.closest_pair(q)
    names = [clear.pair_names[int(pair)].split(" & ")[-1] for pair in nearest]
    names = ["the arm itself" if name.startswith("panda") else name for name in names]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.4))
        axes = figure.subplots()
        with contextlib.suppress(hf.HoldfastError):  # without a library for exact distances
            axes.plot(steps, 100 * clear.exact(q), color=ORANGE, label=f"exact ({clear.exact_by.split(',')[0]})")
        axes.plot(steps, 100 * bound, color=BLUE, label="lower bound")
        begin = 0
        for index in range(1, len(names) + 1):
            if index == len(names) or names[index] != names[begin]:
                if index - begin > 3:
                    middle = (begin + index - 1) // 2
                    axes.text(steps[middle], 1.0, names[begin], ha="center", color=INK)
                if index < len(names):
                    axes.axvline((steps[index - 1] + steps[index]) / 2, color=SOFT, lw=0.6, linestyle=(0, (2, 2)))
                begin = index
        axes.set(xlabel="fraction of the motion", ylabel="clearance, cm", xlim=(0, 1), ylim=(0, None))
        axes.legend(loc="upper right")
        return settle_layout(figure)
