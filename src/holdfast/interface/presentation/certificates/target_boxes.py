"""Presentation of proofs about boxes of targets, with slices that show undecided parts."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.verifier import format_percent
from holdfast.certificates.verifier_parts.tree import Cell
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.certificates.verification import (
    SCOPE_NOTE,
    add_legend,
    build_entries,
    find_proved_fraction,
    present_proof,
)
from holdfast.interface.presentation.presentation import FigureSpec, Presentation
from holdfast.interface.report.palette import EMPTY_COLOR, INK, SKY

_AXIS_LABELS = ("x [m]", "y [m]", "z [m]")


def to_dict(proof: Proof | TolerantProof) -> dict[str, Any]:
    """Return fractions as exact rationals and as numbers, cell counts, and seconds; for a failure-tolerant box also
    its parts.
    """
    if isinstance(proof, Proof):
        return build_entries(proof)
    parts = {proof.part_label(part): to_dict(part) for part in proof.parts}
    return build_entries(proof, ("proved", "undecided", "tolerant")) | {"parts": parts}


def present(proof: Proof | TolerantProof, check: CertificateCheck | None = None, **options: Any) -> Presentation:
    """Present the proved fraction, its meaning, and its limits; the options are those of :func:`present_proof`."""
    arm, place_text, condition, object_text = proof.claim.arm, "within limits", "", "targets"
    if isinstance(proof, TolerantProof):
        place_text = "while healthy and after a lock of any one joint"
        condition = f" {place_text}"
    elif proof.claim.locked >= 0:
        place_text, object_text = "at every locked angle", f"targets and locked angles of {arm.joint_names[proof.claim.locked]}"
    answer, fraction = "Nothing is proved: everything is undecided.", find_proved_fraction(proof, check)
    if fraction:
        remainder = "the rest is undecided" if fraction < 1 else "nothing is undecided"
        answer = f"{format_percent(fraction)} of the {object_text} are proved to be reached{condition}; {remainder}."
    orientation_text = ", in every orientation of the box," if len(proof.claim.box) > 3 else ""
    caption = (
        f"Blue: every target{orientation_text} is proved to be reached {place_text}. Hatched: some box is undecided, which "
        "does not mean that its targets are out of reach. Slices: through the middle, and where most is undecided."
    )
    return present_proof(
        proof,
        title=f"Targets that {arm.name} is proved to reach",
        answer=answer,
        fraction_phrase=f"of the {object_text}{condition}",
        cell_phrase="boxes, each with one configuration",
        figures={"slices": FigureSpec(partial(_draw, proof), "Proved targets", caption)},
        method=[
            ("Proof", "a bisection tree of boxes with one configuration each; one inequality (Brouwer) proves each box"),
            ("Not claimed", SCOPE_NOTE.replace("speed", "speed, the motion to the target")),
        ],
        check=check,
        **options,
    )


def _draw(proof: Proof | TolerantProof) -> report.Figure:
    """Draw slices through the middle and through the most undecided plane, over all locks, lock angles, and orientations."""
    box = proof.claim.box[:3]
    cells = _undecided_cells(proof)
    if len(box) == 2:
        return _draw_slices(box, cells, [(0, 1, None)])
    middle_slices = [(0, 2, (1, float(box[1].mean()))), (1, 2, (0, float(box[0].mean())))]
    worst_height = _find_worst_height(box, cells)
    return _draw_slices(box, cells, [*middle_slices, (0, 1, (2, worst_height))])


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


def _draw_slices(box: FloatArray, cells: FloatArray, slices: list[tuple[int, int, tuple[int, float] | None]]) -> report.Figure:
    with report.styled_figure(report.WIDTH_IN if len(slices) > 1 else report.WIDTH_IN / 2, 3.9) as figure:
        for axes, (first_axis, second_axis, fixed_axis) in zip(np.ravel(figure.subplots(1, len(slices))), slices, strict=True):
            _draw_slice(axes, box, cells, (first_axis, second_axis), fixed_axis)
        add_legend(figure, {"proved": SKY})
    return figure


def _draw_slice(
    axes: report.Axes, box: FloatArray, cells: FloatArray, across: tuple[int, int], fixed_axis: tuple[int, float] | None
) -> None:
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle

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
