"""Figure of the certificates of relative manipulability."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import BLUE, ORANGE, SKY, settle_layout, style

WIDTH_IN = 8.6
CEILING, FLOOR = 0.07, 0.02


def draw_bounds_in_box() -> Figure:
    """Draw the sampled values of two boxes of configurations, with a proved ceiling and a proved floor."""
    arm = hf.arms.load("panda")
    index = hf.indices.relative_manipulability(arm)
    rng = np.random.default_rng(0)
    boxes = (
        (np.radians([-35, -45, 51, -111, -46, 84, -3]), np.radians(3), CEILING, "ceiling", hf.certificates.ceiling_claim),
        (np.radians([40, 20, -30, -90, 30, 120, 0]), np.radians(2), FLOOR, "floor", hf.certificates.floor_claim),
    )
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.0))
        for axes, (middle, half, level, name, claim) in zip(figure.subplots(1, 2), boxes, strict=True):
            proof = hf.certify(claim(arm, np.column_stack([middle - half, middle + half]), level))
            values = index(middle + rng.uniform(-half, half, (20_000, arm.n)))
            axes.hist(values, bins=40, color=SKY, ec="white", lw=0.4)
            axes.axvline(level, color=ORANGE, lw=2, label=f"{name} {level}, {float(proof.proved):.0%} proved")
            axes.axvline(values.max() if name == "ceiling" else values.min(), color=BLUE, lw=1.2, linestyle=(0, (4, 2)),
                         label="extreme value of the sample")  # fmt: skip
            axes.set(xlabel="relative manipulability, worst single lock", yticks=(), ylim=(0, 1.45 * axes.get_ylim()[1]))
            axes.set_title(f"A {name} in a box")
            axes.legend(loc="upper left" if name == "ceiling" else "upper right")
        return settle_layout(figure)
