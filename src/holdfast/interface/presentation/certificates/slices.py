"""Slices through a box of targets that show undecided parts, and the report of the proof."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.verifier import format_percent
from holdfast.certificates.verifier_parts.tree import Cell
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.certificates.pages import UNVERIFIED_NOTE, bind_percent_sign
from holdfast.interface.presentation.certificates.pages import write as write
from holdfast.interface.presentation.page_content import PageContent

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_AXIS_LABELS = ("x [m]", "y [m]", "z [m]")


def figures(proof: Proof | TolerantProof) -> dict[str, Figure]:
    """Draw slices through the middle and through the most undecided plane, over all locks, lock angles, and orientations."""
    box = proof.claim.box[:3]
    cells = _undecided_cells(proof)
    if len(box) == 2:
        return {"slices": _draw_slices(box, cells, [(0, 1, None)])}
    middle_slices = [(0, 2, (1, float(box[1].mean()))), (1, 2, (0, float(box[0].mean())))]
    worst_height = _find_worst_height(box, cells)
    return {"slices": _draw_slices(box, cells, [*middle_slices, (0, 1, (2, worst_height))])}


def _undecided_cells(proof: Proof | TolerantProof) -> FloatArray:
    """Return the parts of the box, as fractions of it (N, axes, 2), over which something is undecided."""
    parts = proof.parts if isinstance(proof, TolerantProof) else (proof,)
    count = min(3, len(proof.claim.box))
    cells: set[Cell] = {cell[:count] for part in parts for cell in documents.find_undecided_cells(part.document)}
    return np.array(
        [[(index / 2**halvings, (index + 1) / 2**halvings) for index, halvings in cell] for cell in sorted(cells)]
    ).reshape(-1, count, 2)


def _find_worst_height(box: FloatArray, cells: FloatArray) -> float:
    """Return the height z, m, of the plane in which the undecided cells cover most; cells may overlap."""
    fraction = 0.5
    if len(cells):
        areas = np.prod(cells[:, :2, 1] - cells[:, :2, 0], axis=1)
        heights = np.unique(cells[:, 2].mean(axis=1))
        covered = [areas[(cells[:, 2, 0] <= height) & (height < cells[:, 2, 1])].sum() for height in heights]
        fraction = float(heights[int(np.argmax(covered))])
    return float(box[2, 0] + fraction * (box[2, 1] - box[2, 0]))


def _draw_slices(box: FloatArray, cells: FloatArray, slices: list[tuple[int, int, tuple[int, float] | None]]) -> Figure:
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    from holdfast.interface.report.figures import EMPTY_COLOR, INK, SKY, WIDTH_IN, settle_layout, style

    with style():
        figure = Figure(figsize=(WIDTH_IN if len(slices) > 1 else WIDTH_IN / 2, 3.9), layout="constrained")
        for axes, (first_axis, second_axis, fixed_axis) in zip(np.ravel(figure.subplots(1, len(slices))), slices, strict=True):
            _draw_slice(axes, box, cells, (first_axis, second_axis), fixed_axis)
        patches = [
            Patch(facecolor=SKY, edgecolor=INK, linewidth=0.6, label="proved"),
            Patch(facecolor=EMPTY_COLOR, edgecolor=INK, hatch="////", linewidth=0.3, label="undecided"),
        ]
        figure.legend(handles=patches, loc="outside lower center", ncols=2)
        return settle_layout(figure)


def _draw_slice(
    axes: Axes, box: FloatArray, cells: FloatArray, across: tuple[int, int], fixed_axis: tuple[int, float] | None
) -> None:
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

    from holdfast.interface.report.figures import EMPTY_COLOR, INK, SKY

    lower, widths = box[:, 0], box[:, 1] - box[:, 0]
    axis_pair = list(across)
    if fixed_axis is not None and len(cells):
        axis, value = fixed_axis
        fraction = (value - lower[axis]) / (widths[axis] or 1.0)
        cells = cells[(cells[:, axis, 0] <= fraction) & (fraction < cells[:, axis, 1])]
    corner, size = lower[axis_pair], widths[axis_pair]
    axes.add_patch(Rectangle((corner[0], corner[1]), size[0], size[1], facecolor=SKY, edgecolor=INK, linewidth=0.8))
    rectangles = [
        Rectangle(tuple(corner + cell[axis_pair, 0] * size), *(np.diff(cell[axis_pair])[:, 0] * size)) for cell in cells
    ]
    axes.add_collection(PatchCollection(rectangles, facecolor=EMPTY_COLOR, edgecolor=INK, hatch="////", linewidth=0.15))
    axes.set(xlabel=_AXIS_LABELS[across[0]], ylabel=_AXIS_LABELS[across[1]])
    if fixed_axis is not None:
        axes.set_title(f"{'xyz'[fixed_axis[0]]} = {fixed_axis[1]:.3g} m")
    margin = 0.04 * size.max()
    axes.set(xlim=(corner[0] - margin, corner[0] + size[0] + margin), ylim=(corner[1] - margin, corner[1] + size[1] + margin))
    axes.set_aspect("equal")
    axes.grid(visible=False)


def story(proof: Proof | TolerantProof) -> PageContent:
    """Compose the report: the proved fraction, its meaning, and its limits."""
    tolerant = isinstance(proof, TolerantProof)
    arm = proof.claim.arm
    locked = -1 if isinstance(proof, TolerantProof) else proof.claim.locked
    object_text = "targets" if locked < 0 else f"targets and locked angles of {arm.joint_names[locked]}"
    fraction = proof.tolerant if isinstance(proof, TolerantProof) else proof.proved
    condition = " while healthy and whatever locks" if tolerant else ""
    answer = "Nothing is proved: all is undecided."
    if fraction:
        remainder = "the rest is undecided" if fraction < 1 else "nothing is undecided"
        answer = (
            f"Of the {object_text}, {bind_percent_sign(format_percent(fraction))} are proved to be "
            f"reached{condition}; {remainder}."
        )
    place_text = (
        "wherever a joint locks, and while healthy" if tolerant else "at every locked angle" if locked >= 0 else "within limits"
    )
    orientation_text = ", turned in every way" if len(proof.claim.box) > 3 else ""
    return PageContent(
        f"What is proved of {arm.name}",
        f"{answer} {UNVERIFIED_NOTE}",
        lines=proof.describe()[:1],
        facts=[
            (bind_percent_sign(format_percent(fraction)), f"of the {object_text}{condition}"),
            (f"{proof.leaves:,}", "boxes, each with one configuration"),
        ],
        figures={
            "slices": (
                "Where it is proved",
                f"Blue: every target{orientation_text} is proved {place_text}. Hatched: something is undecided, which "
                f"does not say that it is "
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
