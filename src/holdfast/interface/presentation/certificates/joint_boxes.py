"""Presentation of proofs about boxes of configurations: unreachable targets, and bounds on manipulability."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, partial
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import verifier
from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.exclusion import joint_ranges
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.tree import UNDECIDED_TOKEN
from holdfast.certificates.verifier import format_percent
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.interface import report
from holdfast.interface.presentation.certificates.verification import (
    SCOPE_NOTE,
    add_legend,
    build_entries,
    find_proved_fraction,
    present_proof,
)
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec
from holdfast.interface.report.palette import BLUE, EMPTY_COLOR, FAINT, INK, ORANGE, SKY

Found = Refutation | ManipulabilityBound

_MAX_DRAWN_HALVINGS = 7  # bisections of an axis that a figure shows
_HARDEST_ROWS = 5


def to_dict(proof: Found) -> dict[str, Any]:
    """Return fractions as exact rationals and as numbers, cell counts, the witness or the extreme, and seconds."""
    if isinstance(proof, Refutation):
        return build_entries(proof, witness=None if proof.witness is None else proof.witness.tolist())
    return build_entries(proof, extreme=proof.extreme.tolist(), value=proof.value)


def present(proof: Found, **options: Any) -> Presentation:
    """Present the proved fraction, its meaning, and its limits; the options are those of :func:`present_proof`."""
    return _present_refutation(proof, **options) if isinstance(proof, Refutation) else _present_bound(proof, **options)


def _describe_fraction(fraction: Fraction, object_text: str) -> str:
    """Describe the result of a search that found no witness."""
    if not fraction:
        return "Nothing is proved: everything is undecided."
    remainder = "nothing is undecided" if fraction == 1 else "the rest is undecided, which does not mean that it is false"
    return f"{format_percent(fraction)} of {object_text}; {remainder}."


def _present_refutation(proof: Refutation, check: CertificateCheck | None = None, **options: Any) -> Presentation:
    claim, fraction = proof.claim, find_proved_fraction(proof, check)
    lock = f" with {claim.arm.joint_names[claim.locked]} locked" if claim.locked >= 0 else ""
    answer = _describe_fraction(fraction, "the pairs of a target and a configuration are excluded")
    if proof.witness is not None:
        position = _format_configuration(proof.witness, proof)
        answer = f"Refuted by a witness. The claim is false: at {position}, the tool is in the box."
    elif fraction == 1:
        answer = "No target of the box is reached: every pair of a target and a configuration is excluded."
    lemma_count, largest = len(proof.document["lemmas"]), _find_largest_lemma(proof.document)
    other_axes, lemma_text = "all other joints and targets", ""
    if largest is not None:
        base_text = "the base" if largest["link"] == 0 else f"the link of {claim.arm.joint_names[largest['link'] - 1]}"
        other_axes, lemma_text = "all others", f"Boxes of the largest lemma, about the joints behind {base_text}. "
    proof_text = "a bisection tree of boxes of configurations and targets; a bound on one distance excludes the targets of each"
    if lemma_count:
        count_text = "one of these bounds is a lemma" if lemma_count == 1 else f"{lemma_count} of these bounds are lemmas"
        proof_text += f"; {count_text} about the joints behind one point only, with a separate tree"
    return present_proof(
        proof,
        title=f"Targets that {claim.arm.name}{lock} cannot reach",
        answer=answer,
        fraction_phrase="of the pairs of a target and a configuration are excluded",
        cell_phrase="boxes, each proved by one inequality",
        list_tables=partial(_list_tables, proof),
        figures=_list_figures(proof, other_axes, lemma_text),
        method=[("Proof", proof_text), ("Not claimed", f"{SCOPE_NOTE}; targets outside the box")],
        check=check,
        **options,
    )


def _present_bound(proof: ManipulabilityBound, check: CertificateCheck | None = None, **options: Any) -> Presentation:
    claim, is_upper_bound, fraction = proof.claim, proof.claim.kind == "ceiling", find_proved_fraction(proof, check)
    extreme_word, side = ("greatest", "above") if is_upper_bound else ("lowest", "below")
    occurrence = f"{proof.value:.6f} occurs at {_format_configuration(proof.extreme, proof)}"
    if proof.refuted:
        answer = f"Refuted by a witness. The claim is false: {occurrence}."
        caption = f"Orange: from the claimed {claim.kind} to a value that occurs, which refutes it."
    elif fraction == 1:
        lower_end, upper_end = sorted((proof.value, claim.threshold))
        answer = (
            f"The {extreme_word} value in the box is between {lower_end:.6g} and {upper_end:.6g}: {occurrence}, and no value "
            f"is {side} {claim.threshold:g}."
        )
        caption = (
            f"Blue: values {side} the {claim.kind}, which are proved not to occur in the box. Hatched: range of the "
            f"{extreme_word} value of the box."
        )
    else:
        answer = _describe_fraction(fraction, f"the box is proved to keep the {claim.kind} of {claim.threshold:g}")
        answer += f" {occurrence}."
        caption = f"Blue: values {side} the {claim.kind}, which occur at most in undecided boxes. Hatched: values between both."
    bound_text = "wrench bounds the index after a lock" if is_upper_bound else "series of an inverse bounds it after every lock"
    bound_figure = FigureSpec(partial(_draw_value_scale, proof), "The bound and an observed value", caption)
    return present_proof(
        proof,
        title=f"{'Upper' if is_upper_bound else 'Lower'} bound on relative manipulability of {claim.arm.name}",
        answer=answer,
        fraction_phrase=f"of the box keeps the {claim.kind} of {claim.threshold:g}",
        cell_phrase="boxes, each proved by one inequality",
        facts=[Fact("", proof.value, phrase="occurs in the box")],
        list_tables=partial(_list_tables, proof),
        figures={"bound": bound_figure, **_list_figures(proof, "all other joints")},
        method=[
            ("Proof", f"in each box of a bisection tree one {bound_text}"),
            ("Not claimed", f"{SCOPE_NOTE}; configurations outside the box"),
        ],
        check=check,
        **options,
    )


def _format_configuration(q: FloatArray, proof: Found) -> str:
    is_slide = proof.claim.arm.prismatic
    text = ", ".join(f"{position:.4g}" for position in _display_factors(~is_slide) * q)
    return f"({text}) {'deg and m' if is_slide.any() else 'deg'}"


def _list_figures(proof: Found, other_axes: str, lemma_text: str = "") -> dict[str, FigureSpec]:
    """List the figure of the boxes, or that of the configuration that refutes the claim."""
    if proof.refuted:
        caption = "Range of each joint in the claim (bar), and its position in the refuting configuration (dot)."
        return {"witness": FigureSpec(partial(_draw_witness, proof), "The refuting configuration", caption)}
    caption = (
        f"{lemma_text}Left: the two axes that were bisected most often, to scale, with the worst case over {other_axes}; "
        "darker areas needed smaller boxes, and hatched areas contain undecided boxes. Right: number of boxes by size."
    )
    if isinstance(proof, ManipulabilityBound):
        caption += " The dot is the configuration found closest to the bound."
    return {"boxes": FigureSpec(partial(_draw_boxes, proof), "Size of the boxes", caption)}


def _list_tables(proof: Found) -> list[TableSpec]:
    return [] if proof.refuted else [LeafBoxes.from_proof(proof).tabulate_hardest()]


# ---- figures -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class LeafBoxes:
    """Boxes at the leaves of the bisection tree.

    Attributes:
        axis_ranges: Ranges (A, 2) of the axes over the whole claim, rad and m.
        axis_names, is_angle: Names of the axes (A,), and True for those that are angles.
        cell_indices, depth: Index of each box (N, A) among the 2^depth parts of each axis, and the depth.
        undecided: (N,) True for undecided boxes.
    """

    axis_ranges: FloatArray
    axis_names: list[str]
    is_angle: NDArray[np.bool_]
    cell_indices: IndexArray
    depth: IndexArray
    undecided: NDArray[np.bool_]

    @classmethod
    def from_proof(cls, proof: Found) -> LeafBoxes:
        """Read the leaves of a proof, or those of its largest lemma if that has more boxes than the rest."""
        arm, document = proof.claim.arm, proof.document
        names, turns, packed_tree = list(arm.joint_names), ~arm.prismatic, document["tree"]
        if isinstance(proof, ManipulabilityBound):
            box, last_token, lock_token = proof.claim.joint_box, 2, verifier.FIRST_LOCK_TOKEN
        elif lemma := _find_largest_lemma(document):
            behind, last_token, lock_token = slice(lemma["link"], arm.n), 2, 256
            box, names, turns, packed_tree = joint_ranges(proof.claim)[behind], names[behind], turns[behind], lemma["tree"]
        else:
            box, axis_letters = np.vstack([joint_ranges(proof.claim), proof.claim.box]), document["target"]["axes"]
            last_token, lock_token = 2 + len(document["lemmas"]), 256
            names += [{"R": "roll", "P": "pitch", "Y": "yaw", "a": "yaw"}.get(axis, axis) for axis in axis_letters]
            turns = np.append(turns, [axis not in "xyz" for axis in axis_letters])
        return cls(box, names, turns, *_unpack_leaves(packed_tree, len(box), last_token, lock_token))

    @property
    def halvings(self) -> IndexArray:
        """Number of bisections of each box (N,)."""
        return np.asarray(self.depth.sum(axis=1))

    @property
    def most_halved_axes(self) -> tuple[int, int]:
        """The two axes that are bisected most often, in the order of the axes."""
        halving_counts = self.depth.sum(axis=0) + 1e-9 * (self.axis_ranges[:, 1] > self.axis_ranges[:, 0])
        lower_axis, upper_axis = sorted(np.argsort(-halving_counts, kind="stable")[:2].tolist())
        return lower_axis, upper_axis

    def describe_box(self, box_index: int) -> list[str]:
        """Return the number of bisections of a box, its middle, its half-widths, and its state as texts."""
        width = (self.axis_ranges[:, 1] - self.axis_ranges[:, 0]) * 0.5 ** self.depth[box_index]
        middle = self.axis_ranges[:, 0] + width * (self.cell_indices[box_index] + 0.5)
        scale = _display_factors(self.is_angle)
        texts = [", ".join(f"{value:.4g}" for value in scale * values) for values in (middle, width / 2)]
        return [str(self.halvings[box_index]), *texts, "undecided" if self.undecided[box_index] else "proved"]

    def tabulate_hardest(self) -> TableSpec:
        """Tabulate the smallest boxes, or the largest of the undecided ones."""
        order = np.lexsort((np.where(self.undecided, self.halvings, -self.halvings), ~self.undecided))[:_HARDEST_ROWS]
        units = "deg and m" if not self.is_angle.all() else "deg"
        columns = ["bisections", f"middle, {units}", f"half-widths, {units}", "proved or undecided"]
        return TableSpec(
            "Smallest boxes, or largest undecided boxes", columns, [self.describe_box(box_index) for box_index in order]
        )

    def project_onto(self, axes: tuple[int, int]) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Project the boxes onto two axes (2^7, 2^7): the largest number of halvings over the other axes, and the undecided
        area.
        """
        max_halvings = np.zeros((1 << _MAX_DRAWN_HALVINGS,) * 2)
        undecided_area = max_halvings > 0
        excess_halvings = np.maximum(self.depth[:, axes] - _MAX_DRAWN_HALVINGS, 0)
        cell_indices, depth = self.cell_indices[:, axes] >> excess_halvings, self.depth[:, axes] - excess_halvings
        for depths in np.unique(depth, axis=0):
            box_rows = np.flatnonzero((depth == depths).all(axis=1))
            grid_halvings, grid_index = np.zeros((1 << depths).tolist()), tuple(cell_indices[box_rows].T)
            is_open = grid_halvings > 0
            np.maximum.at(grid_halvings, grid_index, self.halvings[box_rows])
            np.logical_or.at(is_open, grid_index, self.undecided[box_rows])
            pixel_block = np.ones((1 << (_MAX_DRAWN_HALVINGS - depths)).tolist(), dtype=bool)
            max_halvings = np.maximum(max_halvings, np.kron(grid_halvings, pixel_block))
            undecided_area |= np.kron(is_open, pixel_block).astype(bool)
        return max_halvings, undecided_area


@lru_cache(maxsize=1)  # a report has both a table and a figure of them
def _unpack_leaves(
    packed_tree: str, axes: int, last_token: int, lock_token: int
) -> tuple[IndexArray, IndexArray, NDArray[np.bool_]]:
    """Unpack the leaves of a tree: cell index and depth along each axis (N, A), and whether each is undecided (N,)."""
    tree, tokens = verifier.decompress_payload(packed_tree, 2 * verifier.MAX_LEAVES, "tree"), list[int]()

    def stream_numbers() -> Any:
        for token, cell in verifier.iterate_cells(tree, axes, last_token, lock_token):
            tokens.append(token)
            yield from chain.from_iterable(cell)

    cell_numbers = np.fromiter(stream_numbers(), dtype=np.int64).reshape(-1, axes, 2)
    return cell_numbers[:, :, 0], cell_numbers[:, :, 1], np.isin(tokens, (1, UNDECIDED_TOKEN))


def _display_factors(is_angle: NDArray[np.bool_]) -> FloatArray:
    """Return the factors for display: angles are shown in degrees, prismatic joints in metres."""
    return np.where(is_angle, 180 / np.pi, 1.0)


def _find_largest_lemma(document: dict[str, Any]) -> dict[str, Any] | None:
    """Return the lemma with the most boxes, if it has more than the main proof."""
    trees = [*document["lemmas"], document]
    sizes = [len(verifier.decompress_payload(proof_tree["tree"], 2 * verifier.MAX_LEAVES, "tree")) for proof_tree in trees]
    largest = trees[int(np.argmax(sizes))]
    return None if largest is document else largest


def _draw_witness(proof: Found) -> report.Figure:
    """Draw the configuration that refutes a claim: the position of each joint within its range."""
    arm = proof.claim.arm
    if isinstance(proof, ManipulabilityBound):
        spans, q = proof.claim.joint_box, proof.extreme
    else:
        assert proof.witness is not None
        spans, q = joint_ranges(proof.claim), proof.witness
    scale = _display_factors(~arm.prismatic)
    with report.styled_figure(report.WIDTH_IN, 0.9 + 0.3 * arm.n) as figure:
        axes = figure.subplots()
        rows = np.arange(arm.n)
        axes.hlines(rows, *(spans * scale[:, None]).T, color=FAINT, linewidth=7)
        axes.plot(q * scale, rows, "o", color=ORANGE, markersize=7)
        axes.set(yticks=rows, yticklabels=[report.format_label(name) for name in arm.joint_names], ylim=(arm.n - 0.5, -0.5))
        axes.set_xlabel("deg" if not arm.prismatic.any() else "deg and m")
    return figure


def _draw_value_scale(proof: ManipulabilityBound) -> report.Figure:
    """Draw a line of values: a value that occurs, the bound, and the values that are proved not to occur."""
    claim, is_upper_bound = proof.claim, proof.claim.kind == "ceiling"
    bound, value = claim.threshold, proof.value
    axis_end = min(claim.most, 1.6 * max(bound, value))
    with report.styled_figure(report.WIDTH_IN, 1.9) as figure:
        axes = figure.subplots()
        excluded_range = (bound, axis_end) if is_upper_bound else (0.0, bound)
        if proof.refuted:
            axes.axvspan(*sorted((bound, value)), color=ORANGE, alpha=0.55, linewidth=0)
        else:
            axes.axvspan(*excluded_range, color=SKY, linewidth=0)
            axes.axvspan(*sorted((bound, value)), facecolor=EMPTY_COLOR, edgecolor=INK, hatch="////", linewidth=0)
        for position, color, label, is_left in (
            (value, INK, f"{value:.4g} occurs", is_upper_bound != proof.refuted),
            (bound, BLUE, f"{claim.kind} {bound:.4g}", is_upper_bound == proof.refuted),
        ):
            axes.axvline(position, color=color, linewidth=1.6)
            place = {"xycoords": ("data", "axes fraction"), "ha": "right" if is_left else "left", "va": "bottom"}
            axes.annotate(label, (position, 1.03), color=color, **place)
        axes.set(xlim=(0, axis_end), ylim=(0, 1), yticks=[], xlabel="least relative manipulability after one lock")
        axes.grid(visible=False)
    return figure


def _draw_boxes(proof: Found) -> report.Figure:
    """Draw the sizes of the boxes, with the configuration found closest to a bound."""
    leaves, marked = LeafBoxes.from_proof(proof), None if isinstance(proof, Refutation) else proof.extreme
    with report.styled_figure(report.WIDTH_IN, 4.2) as figure:
        plane, bars = figure.subplots(1, 2)
        _draw_projection(plane, leaves, marked)
        proved, undecided = (np.bincount(leaves.halvings[selected]) for selected in (~leaves.undecided, leaves.undecided))
        bottom, bar_style = np.pad(proved, (0, len(undecided)))[: len(undecided)], {"width": 1.0, "edgecolor": INK}
        bars.bar(np.arange(len(proved)), proved, facecolor=SKY, linewidth=0.6, **bar_style)
        hatching = {"facecolor": EMPTY_COLOR, "hatch": "////", "linewidth": 0.3}
        bars.bar(np.arange(len(undecided)), undecided, bottom=bottom, **hatching, **bar_style)
        bars.set(xlabel="bisections of the whole", ylabel="boxes", title="Number of boxes by size")
        bars.xaxis.get_major_locator().set_params(integer=True)
        add_legend(figure, {"proved (darker: smaller boxes)": SKY})
    return figure


def _draw_projection(axes: report.Axes, leaves: LeafBoxes, marked: FloatArray | None) -> None:
    """Draw the boxes over two axes, to scale; the worst box over all other axes counts."""
    from matplotlib.collections import PatchCollection
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.patches import Rectangle

    shown_axes = leaves.most_halved_axes
    scale = _display_factors(leaves.is_angle)[list(shown_axes)]
    lower, upper = (leaves.axis_ranges[list(shown_axes)] * scale[:, None]).T
    max_halvings, undecided_area = leaves.project_onto(shown_axes)
    colormap = LinearSegmentedColormap.from_list("halvings", [SKY, BLUE])
    extent = (lower[0], upper[0], lower[1], upper[1])
    axes.imshow(max_halvings.T, origin="lower", extent=extent, cmap=colormap, aspect="auto", interpolation="nearest")
    step, rectangles = (upper - lower) / len(undecided_area), []
    for column_index, column in enumerate(undecided_area):
        run_ends = np.flatnonzero(np.diff(np.concatenate([[False], column, [False]]).astype(int)))
        for begin, end in zip(run_ends[::2], run_ends[1::2], strict=True):
            rectangles.append(Rectangle(tuple(lower + step * [column_index, begin]), step[0], step[1] * (end - begin)))
    axes.add_collection(PatchCollection(rectangles, facecolor=EMPTY_COLOR, edgecolor="none"))
    axes.add_collection(PatchCollection(rectangles, facecolor="none", edgecolor=INK, hatch="////", linewidth=0))
    if marked is not None:
        position = marked[list(shown_axes)] * scale
        axes.plot(*position, "o", color=INK, markersize=7, markeredgecolor="white", clip_on=False)
    labels = [
        f"{report.format_label(leaves.axis_names[axis])} [{'deg' if leaves.is_angle[axis] else 'm'}]" for axis in shown_axes
    ]
    axes.set(xlabel=labels[0], ylabel=labels[1], title="Position of the small boxes")
    axes.grid(visible=False)
