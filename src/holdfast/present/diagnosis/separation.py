"""Which locks a motion tells apart, as a map of pairs."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from holdfast.diagnosis.foresight.observability import Observability
from holdfast.diagnosis.foresight.probe import Probe
from holdfast.diagnosis.foresight.separation import LIKELY
from holdfast.report import figures as style

_LONG = 24  # letters of a name


def figures(found: Observability | Probe) -> dict[str, Figure]:
    """A square for each pair of explanations."""
    joints = found.suspects if isinstance(found, Probe) else range(found.arm.n)
    ids = [0, *(i + 1 for i in joints)]
    names = ["none", *(style.plain(found.arm.joint_names[i], _LONG) for i in joints)]
    apart = found.separation[np.ix_(ids, ids)]
    count = len(ids)
    with style.style():
        drawn = Figure(figsize=(2.6 + 0.75 * count, 1.6 + 0.5 * count))
        axes = drawn.subplots()
        shown = np.ma.masked_array(np.minimum(apart, 3 * LIKELY), np.eye(count, dtype=bool))
        picture = axes.pcolormesh(np.arange(count + 1), np.arange(count + 1), shown, cmap="Blues", vmin=0, vmax=3 * LIKELY)
        for i, j in zip(*np.nonzero(~np.eye(count, dtype=bool)), strict=True):
            weak = not apart[i, j] > LIKELY
            colour = style.ORANGE if weak else "white" if apart[i, j] > 2 * LIKELY else style.INK
            text = "> 999" if apart[i, j] >= 1000 else f"{apart[i, j]:.3g}" if apart[i, j] >= 0.01 else "0"
            axes.text(
                j + 0.5, i + 0.5, text, ha="center", va="center", color=colour, fontsize=8, weight="bold" if weak else None
            )
        axes.set_xticks(np.arange(count) + 0.5, names, rotation=35, ha="right")
        axes.set_yticks(np.arange(count) + 0.5, names)
        axes.invert_yaxis()
        axes.grid(visible=False)
        axes.set(title="Locked joint against locked joint", xlim=(0, count))
        drawn.colorbar(picture, ax=axes, label="nats")
        return {"separation": style.finished(drawn)}
