"""Figures of the designs: maps over the triangle of link lengths, and what nearly equal links cost."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.interface.report import BLUE, INK, ORANGE, SOFT, save_png, style

Array = NDArray[np.float64]

_PANELS = (
    ("pseudoinverse", "guaranteed", "Pseudoinverse:\ntargets guaranteed, % of the area"),
    ("pseudoinverse", "free", "Pseudoinverse:\nlocks that nothing can hold, %"),
    ("pseudoinverse", "converged", "Pseudoinverse:\nconverged, % of all locks"),
    ("damped", "free", "Damped, 0.1 m:\nlocks that nothing can hold, %"),
)


def design_map(shares: Array, maps: dict[str, dict[str, Array]], given: Array, best: Array, path: Path) -> None:
    """Four measures over shares (D, 3) of the reach, with the given and the best design."""
    from matplotlib.figure import Figure

    with style():
        figure = Figure(figsize=(11, 9.4), layout="constrained")
        axes = figure.subplots(2, 2, sharex=True, sharey=True)
        for ax, (law, name, title) in zip(axes.flat, _PANELS, strict=True):
            drawn = ax.scatter(
                100 * shares[:, 1], 100 * shares[:, 2], c=100 * maps[law][name], s=44, marker="s", cmap="cividis", linewidths=0
            )
            figure.colorbar(drawn, ax=ax, shrink=0.9)
            ax.plot([0, 50], [0, 50], color=INK, lw=0.7, ls=":")
            for sign in (1, -1):
                # l3 - l2 = l1 and the other way: half of the reach is one link.
                line = np.array([[0, 50], [50, 50]]) if sign > 0 else np.array([[50, 50], [0, 50]])
                ax.plot(*line, color=ORANGE, lw=1.2, ls="--")
            ax.plot(*(100 * given[1:]), "o", ms=9, mfc="none", mec=ORANGE, mew=2)
            ax.plot(*(100 * best[1:]), "*", ms=15, mfc="white", mec=BLUE, mew=1.4)
            ax.set(title=title, xlim=(0, 100), ylim=(0, 100), aspect="equal")
        for ax in axes[1]:
            ax.set_xlabel("link 2, % of the reach")
        for ax in axes[:, 0]:
            ax.set_ylabel("link 3, % of the reach")
        caption = (
            f"Planar 3R, {len(shares)} designs, 40 rings of targets each; link 1 is what is left to 100 %. Circle: three equal "
            "links. Star: the best found.\nDotted: links 2 and 3 equal. Dashed: their difference is link 1."
        )
        figure.supxlabel(caption, fontsize=9, color=SOFT)
        save_png(figure, path, 110)


def mismatch(off: Array, free: Array, path: Path) -> None:
    """What share of the locks nothing can hold, over the difference of links 2 and 3."""
    from matplotlib.figure import Figure

    with style():
        figure = Figure(figsize=(7, 3.6), layout="constrained")
        ax = figure.subplots()
        ax.plot(100 * off, 100 * free, "-o", ms=3, color=BLUE)
        ax.set(
            xlabel="link 3 - link 2, % of the reach",
            ylabel="locks that nothing\ncan hold, %",
            title="Pseudoinverse, link 1 a third of the reach",
        )
        caption = f"{off.size} designs, 40 rings of targets each, mean of the three joints"
        figure.supxlabel(caption, fontsize=9, color=SOFT)
        save_png(figure, path, 110)
