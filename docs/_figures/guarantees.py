"""Figure of the guarantees of a failure-tolerant control law."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, ORANGE, SKY, settle_layout, style

WIDTH_IN = 8.6


def draw_angular_deviation() -> Figure:
    """Draw the peak angular deviation over the peak velocity error, with the curve that bounds it below an error of 1."""
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0)] * 3, name="3R")
    law = hf.control.failure_tolerant(arm, "planar", pre_failure_error=0.5)
    rng = np.random.default_rng(0)
    result = law.deviations(rng.uniform(-np.pi, np.pi, (1500, 3)), rng.normal(size=(1500, 2)))
    errors, angles = result.peak_velocity_error, np.degrees(result.peak_angular_deviation)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.6))
        axes = figure.subplots()
        axes.plot(errors, angles, ".", ms=2, color=SKY)
        bounded = np.linspace(0, 1, 200)
        axes.plot(bounded, np.degrees(np.arcsin(bounded)), color=BLUE, label="arcsin(PKE): bound below PKE = 1")
        axes.axhline(30, color=ORANGE, linestyle=(0, (4, 2)), label="30°: bound of the healthy arm only")
        axes.axvline(1, color=GREEN, lw=1, linestyle=(0, (1, 2)))
        axes.set(xlabel="peak velocity error (PKE)", ylabel="peak angular deviation (PAD), deg")
        axes.set(xlim=(0, 2.5), ylim=(0, 180), yticks=range(0, 181, 30))
        axes.set_title("Planar arm with three joints, undetected lock of the worst joint")
        axes.legend(loc="upper right")
        return settle_layout(figure)
