"""Map of the pairs of locks that a motion distinguishes."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.interface.report import figures as style
from holdfast.response.diagnosis.detectability.observability import Observability
from holdfast.response.diagnosis.detectability.probe import ProbingMotion
from holdfast.response.diagnosis.detectability.separation import LOG_LIKELIHOOD_THRESHOLD

_MAX_NAME_LETTERS = 24  # letters of a name


def figures(result: Observability | ProbingMotion) -> dict[str, Figure]:
    """Draw a square for each pair of explanations."""
    joints = result.suspects if isinstance(result, ProbingMotion) else range(result.arm.n)
    hypotheses = [0, *(row + 1 for row in joints)]
    names = ["none", *(style.format_label(result.arm.joint_names[row], _MAX_NAME_LETTERS) for row in joints)]
    separations = result.separation[np.ix_(hypotheses, hypotheses)]
    count = len(hypotheses)
    with style.style():
        figure = Figure(figsize=(2.6 + 0.75 * count, 1.6 + 0.5 * count))
        axes = figure.subplots()
        matrix = np.ma.masked_array(np.minimum(separations, 3 * LOG_LIKELIHOOD_THRESHOLD), np.eye(count, dtype=bool))
        mesh = axes.pcolormesh(
            np.arange(count + 1), np.arange(count + 1), matrix, cmap="Blues", vmin=0, vmax=3 * LOG_LIKELIHOOD_THRESHOLD
        )
        for row, column in zip(*np.nonzero(~np.eye(count, dtype=bool)), strict=True):
            is_weak = not separations[row, column] > LOG_LIKELIHOOD_THRESHOLD
            color = (
                style.ORANGE if is_weak else "white" if separations[row, column] > 2 * LOG_LIKELIHOOD_THRESHOLD else style.INK
            )
            label = (
                "> 999"
                if separations[row, column] >= 1000
                else f"{separations[row, column]:.3g}"
                if separations[row, column] >= 0.01
                else "0"
            )
            axes.text(
                column + 0.5,
                row + 0.5,
                label,
                ha="center",
                va="center",
                color=color,
                fontsize=8,
                weight="bold" if is_weak else None,
            )
        axes.set_xticks(np.arange(count) + 0.5, names, rotation=35, ha="right")
        axes.set_yticks(np.arange(count) + 0.5, names)
        axes.invert_yaxis()
        axes.grid(visible=False)
        axes.set(title="Locked joint against locked joint", xlim=(0, count))
        figure.colorbar(mesh, ax=axes, label="nats")
        return {"separation": style.settle_layout(figure)}
