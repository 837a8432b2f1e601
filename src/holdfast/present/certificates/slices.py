"""Where in a box of targets something is undecided: slices, and what the page of a proof says."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.verified.tree import Cell
from holdfast.certificates.verifier import per_cent
from holdfast.present.certificates.pages import UNVERIFIED, kept
from holdfast.present.certificates.pages import write as write
from holdfast.present.story import Story

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_LABELS = ("x [m]", "y [m]", "z [m]")


def figures(found: Proof | TolerantProof) -> dict[str, Figure]:
    """Slices through the middle and through where most is undecided, whatever is locked and wherever, however it is turned."""
    box = found.claim.box[:3]
    cells = _shadow(found)
    if len(box) == 2:
        return {"slices": _drawn(box, cells, [(0, 1, None)])}
    across = [(0, 2, (1, float(box[1].mean()))), (1, 2, (0, float(box[0].mean())))]
    worst = _worst(box, cells)
    return {"slices": _drawn(box, cells, [*across, (0, 1, (2, worst))])}


def _shadow(found: Proof | TolerantProof) -> Array:
    """(N, axes, 2) the parts of the box, as shares of it, over which something is undecided."""
    parts = found.parts if isinstance(found, TolerantProof) else (found,)
    count = min(3, len(found.claim.box))
    cells: set[Cell] = {cell[:count] for part in parts for cell in documents.undecided(part.document)}
    return np.array([[(k / 2**d, (k + 1) / 2**d) for k, d in cell] for cell in sorted(cells)]).reshape(-1, count, 2)


def _worst(box: Array, cells: Array) -> float:
    """The z in whose plane cells cover most, m; they may overlap."""
    share = 0.5
    if len(cells):
        area = np.prod(cells[:, :2, 1] - cells[:, :2, 0], axis=1)
        planes = np.unique(cells[:, 2].mean(axis=1))
        covered = [area[(cells[:, 2, 0] <= z) & (z < cells[:, 2, 1])].sum() for z in planes]
        share = float(planes[int(np.argmax(covered))])
    return float(box[2, 0] + share * (box[2, 1] - box[2, 0]))


def _drawn(box: Array, cells: Array, slices: list[tuple[int, int, tuple[int, float] | None]]) -> Figure:
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    from holdfast.report.figures import INK, PALE, SKY, WIDTH, finished, style

    with style():
        figure = Figure(figsize=(WIDTH if len(slices) > 1 else WIDTH / 2, 3.9), layout="constrained")
        for axes, (i, j, held) in zip(np.ravel(figure.subplots(1, len(slices))), slices, strict=True):
            _slice(axes, box, cells, (i, j), held)
        patches = [
            Patch(facecolor=SKY, edgecolor=INK, linewidth=0.6, label="proved"),
            Patch(facecolor=PALE, edgecolor=INK, hatch="////", linewidth=0.3, label="undecided"),
        ]
        figure.legend(handles=patches, loc="outside lower center", ncols=2)
        return finished(figure)


def _slice(axes: Axes, box: Array, cells: Array, across: tuple[int, int], held: tuple[int, float] | None) -> None:
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    from holdfast.report.figures import INK, PALE, SKY

    low, width = box[:, 0], box[:, 1] - box[:, 0]
    sides = list(across)
    if held is not None and len(cells):
        axis, value = held
        share = (value - low[axis]) / (width[axis] or 1.0)
        cells = cells[(cells[:, axis, 0] <= share) & (share < cells[:, axis, 1])]
    corner, size = low[sides], width[sides]
    axes.add_patch(Rectangle((corner[0], corner[1]), size[0], size[1], facecolor=SKY, edgecolor=INK, linewidth=0.8))
    made = [Rectangle(tuple(corner + cell[sides, 0] * size), *(np.diff(cell[sides])[:, 0] * size)) for cell in cells]
    axes.add_collection(PatchCollection(made, facecolor=PALE, edgecolor=INK, hatch="////", linewidth=0.15))
    axes.set(xlabel=_LABELS[across[0]], ylabel=_LABELS[across[1]])
    if held is not None:
        axes.set_title(f"{'xyz'[held[0]]} = {held[1]:.3g} m")
    room = 0.04 * size.max()
    axes.set(xlim=(corner[0] - room, corner[0] + size[0] + room), ylim=(corner[1] - room, corner[1] + size[1] + room))
    axes.set_aspect("equal")
    axes.grid(visible=False)


def story(found: Proof | TolerantProof) -> Story:
    """How much is proved, and what that says and does not."""
    tolerant = isinstance(found, TolerantProof)
    arm = found.claim.arm
    locked = -1 if isinstance(found, TolerantProof) else found.claim.locked
    of = "targets" if locked < 0 else f"targets and locked angles of {arm.joint_names[locked]}"
    share = found.tolerant if isinstance(found, TolerantProof) else found.proved
    whatever = " while healthy and whatever locks" if tolerant else ""
    answer = "Nothing is proved: all is undecided."
    if share:
        rest = "the rest is undecided" if share < 1 else "nothing is undecided"
        answer = f"Of the {of}, {kept(per_cent(share))} are proved to be reached{whatever}; {rest}."
    where = (
        "wherever a joint locks, and while healthy" if tolerant else "at every locked angle" if locked >= 0 else "within limits"
    )
    turned = ", turned in every way" if len(found.claim.box) > 3 else ""
    return Story(
        f"What is proved of {arm.name}",
        f"{answer} {UNVERIFIED}",
        lines=found.describe()[:1],
        facts=[(kept(per_cent(share)), f"of the {of}{whatever}"), (f"{found.leaves:,}", "boxes, each with one configuration")],
        figures={
            "slices": (
                "Where it is proved",
                f"Blue: every target{turned} is proved {where}. Hatched: something is undecided, which does not say that it is "
                "out of reach. Through the middle of the box, and where most is undecided.",
            )
        },
        method=[
            ("Proof", "a bisection tree of boxes and a configuration for each; a box is proved by one inequality, by Brouwer"),
            (
                "Not said",
                "collisions, torques, speed, the way there; links are rigid, the geometry is the file's, locks do not slip",
            ),
        ],
        arm=arm,
    )
