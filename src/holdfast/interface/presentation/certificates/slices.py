"""Slices through a box of targets that show undecided parts, and the report of the proof."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.verifier import format_percent
from holdfast.certificates.verifier_parts.tree import Cell
from holdfast.interface.presentation.certificates.pages import SCOPE_NOTE, UNVERIFIED_NOTE, add_legend, bind_percent_sign
from holdfast.interface.presentation.certificates.pages import write as write
from holdfast.interface.presentation.page_content import PageContent

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from holdfast.core.typing import FloatArray

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

    from holdfast.interface.report.figures import SKY, WIDTH_IN, settle_layout, style

    with style():
        figure = Figure(figsize=(WIDTH_IN if len(slices) > 1 else WIDTH_IN / 2, 3.9), layout="constrained")
        for axes, (first_axis, second_axis, fixed_axis) in zip(np.ravel(figure.subplots(1, len(slices))), slices, strict=True):
            _draw_slice(axes, box, cells, (first_axis, second_axis), fixed_axis)
        add_legend(figure, {"proved": SKY})
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
    arm, place_text, condition = proof.claim.arm, "within limits", ""
    object_text, fraction = "targets", proof.proved
    if isinstance(proof, TolerantProof):
        fraction, condition = proof.tolerant, " while healthy and whatever locks"
        place_text = "wherever a joint locks, and while healthy"
    elif proof.claim.locked >= 0:
        place_text, object_text = "at every locked angle", f"targets and locked angles of {arm.joint_names[proof.claim.locked]}"
    answer = "Nothing is proved: all is undecided."
    if fraction:
        remainder = "the rest is undecided" if fraction < 1 else "nothing is undecided"
        percent = bind_percent_sign(format_percent(fraction))
        answer = f"Of the {object_text}, {percent} are proved to be reached{condition}; {remainder}."
    orientation_text = ", turned in every way" if len(proof.claim.box) > 3 else ""
    caption = f"Blue: every target{orientation_text} is proved {place_text}. Hatched: something is undecided, which does not "
    caption += "say that it is out of reach. Through the middle of the box, and where most is undecided."
    return PageContent(
        f"What is proved of {arm.name}",
        f"{answer} {UNVERIFIED_NOTE}",
        lines=proof.describe()[:1],
        facts=[
            (bind_percent_sign(format_percent(fraction)), f"of the {object_text}{condition}"),
            (f"{proof.leaves:,}", "boxes, each with one configuration"),
        ],
        figures={"slices": ("Where it is proved", caption)},
        method=[
            ("Proof", "a bisection tree of boxes and a configuration for each; a box is proved by one inequality, by Brouwer"),
            ("Not said", SCOPE_NOTE.replace("speed", "speed, the way there")),
        ],
        arm=arm,
    )
