"""Presentation of a proof that a path can be finished after locks at given instants."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np

from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.tool_paths.cells import SEGMENT_INSTANTS, LockSlab
from holdfast.certificates.tool_paths.proof import LockedPath, PathProof
from holdfast.certificates.verifier import format_percent
from holdfast.interface import report
from holdfast.interface.presentation.certificates.verification import (
    add_legend,
    build_entries,
    build_fraction_entry,
    find_proved_fraction,
    present_proof,
)
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation
from holdfast.interface.report.palette import BLUE, EMPTY_COLOR, INK, ORANGE, SKY

_MAX_PANEL_COLUMNS = 4  # panels in a row


def to_dict(proof: PathProof) -> dict[str, Any]:
    """Return the fractions of lock instants as exact rationals and as numbers, for all locks together and for each; cells,
    seconds.
    """
    parts: dict[str, Any] = {}
    for part in proof.parts:
        parts[_joint_name(proof, part)] = {
            **{key: build_fraction_entry(getattr(part, key)) for key in ("proved", "refuted", "undecided")},
            "undecided_between_knots": [[begin / SEGMENT_INSTANTS, end / SEGMENT_INSTANTS] for begin, end in proof.gaps(part)],
            "followers": [proof.claim.arm.joint_names[joint] for joint in part.followers],
            **{key: getattr(part, key) for key in ("leaves", "nodes", "finished", "seconds")},
        }
    entries = build_entries(proof, ("proved", "refuted", "undecided", "tolerant"), deviation=proof.claim.deviation)
    return entries | {"parts": parts}


def _joint_name(proof: PathProof, part: LockedPath) -> str:
    return proof.claim.arm.joint_names[part.joint]


def present(proof: PathProof, check: CertificateCheck | None = None, **options: Any) -> Presentation:
    """Present the proved fraction, its meaning, and its limits; the options are those of :func:`present_proof`."""
    claim, fraction = proof.claim, find_proved_fraction(proof, check)
    tolerance_text = f" within {1000 * claim.tube[0]:g} mm" if claim.tube.any() else ""
    complete_joints = [_joint_name(proof, part) for part in proof.parts if part.proved == 1]
    undecided_text = "undecided or refuted" if proof.refuted else "undecided"
    answer = f"Nothing is proved for all locks: at every instant some lock is {undecided_text}."
    if fraction:
        remainder = "nothing is undecided" if fraction == 1 else "the rest is undecided for some lock"
        if refuted_joints := [_joint_name(proof, part) for part in proof.parts if part.refuted]:
            remainder = f"part of the rest is refuted, for locks of {', '.join(refuted_joints)}"
        answer = (
            f"At {format_percent(fraction)} of the instants, the arm is proved to finish the {claim.task} path{tolerance_text} "
            f"whichever joint locks; {remainder}."
        )
    elif complete_joints:
        answer = (
            f"At no instant is the path proved to be finished for all locks. For locks of {', '.join(complete_joints)} it is "
            f"proved at every instant; at every instant, some lock of another joint is {undecided_text}."
        )
    caption = (
        "Blue: after a lock at this instant, one continuous motion takes the tool to the end of the path. Lines are the faces "
        "at which cells are matched; dark blue cells are rotated, because of a singular configuration. Orange: refuted, "
        "because no configuration within the limits reaches some later pose of the path. Hatched: undecided, which does not "
        "mean that the path cannot be finished. Nothing is claimed about the path before the lock."
    )
    proof_text = (
        "cells of the path after intervals of lock instants; each cell contains one solution, and neighbouring cells share it "
        "on their common face. Refutations use boxes of joint values that cannot close the chain of arm, tool and base"
    )
    scope = (
        "collisions, torques, speed, the origin of the healthy motion. Assumptions: links are rigid, the geometry is that of "
        "the file, locks do not slip, and the path consists of straight segments in joint space"
    )
    return present_proof(
        proof,
        title=f"Path that {claim.arm.name} finishes after a lock",
        answer=answer,
        fraction_phrase="of the lock instants, whichever joint locks",
        cell_phrase="cells, matched or empty",
        facts=[
            Fact("refuted for the worst joint", format_percent(proof.refuted)),
            Fact("largest distance of the segments from the given motion", 1000 * claim.deviation, "mm", digits=2),
        ],
        gaps=[_format_undecided_intervals(proof, part) for part in proof.parts],
        figures={"slices": FigureSpec(partial(_draw, proof), "Lock instants after which the path is finished", caption)},
        method=[("Proof", proof_text), ("Not claimed", scope)],
        check=check,
        **options,
    )


def _format_undecided_intervals(proof: PathProof, part: LockedPath) -> str:
    """List the undecided intervals, or the widest two of them."""
    gaps = sorted(proof.gaps(part), key=lambda gap: gap[0] - gap[1])
    texts = [f"{begin / SEGMENT_INSTANTS:.4g} to {end / SEGMENT_INSTANTS:.4g}" for begin, end in gaps]
    return ", ".join(texts[:2]) + (f" and {len(texts) - 2} more" if len(texts) > 2 else "")


def _draw(proof: PathProof) -> report.Figure:
    """Draw the lock instants against the path, one panel for each lock."""
    column_count = min(_MAX_PANEL_COLUMNS, len(proof.parts))
    row_count = -(-len(proof.parts) // column_count)
    width = report.WIDTH_IN * column_count / _MAX_PANEL_COLUMNS + 0.6 * (column_count < _MAX_PANEL_COLUMNS)
    with report.styled_figure(width, 2.7 * row_count + 0.7) as figure:
        panels = np.ravel(figure.subplots(row_count, column_count, sharex=True, sharey=True, squeeze=False))
        for panel, part in zip(panels, proof.parts, strict=False):
            _draw_panel(panel, proof, part)
        for panel in panels[len(proof.parts) :]:
            panel.set_visible(False)
        for index, panel in enumerate(panels[: len(proof.parts)]):
            is_last = index + column_count >= len(proof.parts)
            panel.set_xlabel("path [knots]" if is_last else "")
            panel.xaxis.set_tick_params(labelbottom=is_last)
        for axes in panels[::column_count]:
            axes.set_ylabel("lock [knots]")
        add_legend(figure, {"proved to be finished": SKY, "proved with rotated cells": BLUE, "refuted": ORANGE})
    return figure


def _draw_panel(axes: report.Axes, proof: PathProof, part: LockedPath) -> None:
    from matplotlib.collections import LineCollection, PolyCollection

    path_end = proof.claim.segments

    def fill(outlines: list[Any], color: str, **style: Any) -> None:
        axes.add_collection(PolyCollection(outlines, facecolor=color, **{"edgecolor": "face", "linewidth": 0.2} | style))

    def outline_intervals(spans: list[tuple[int, int]]) -> list[list[tuple[float, float]]]:
        """Return the outlines of the path that follows intervals of lock instants."""
        ends = ((first / SEGMENT_INSTANTS, last / SEGMENT_INSTANTS) for first, last in spans)
        return [[(a, a), (path_end, a), (path_end, b), (b, b)] for a, b in ends]

    rotated, faces = list[Any](), list[Any]()
    for slab in part.slabs:
        begin, stop = slab.begin / SEGMENT_INSTANTS, slab.stop / SEGMENT_INSTANTS
        instants = [instant / SEGMENT_INSTANTS for instant in slab.ends[:-1] if instant > 0]
        faces += [[(instant, begin), (instant, stop)] for instant in instants]
        rotated += [[(a, begin), (b, begin), (b, stop), (a, stop)] for a, b in _rotated_intervals(slab, part.joint)]
    fill(outline_intervals(part.proved_lock_intervals), SKY)
    fill(rotated, BLUE)
    fill(outline_intervals(part.refuted_lock_intervals), ORANGE)
    fill(outline_intervals(proof.gaps(part)), EMPTY_COLOR, edgecolor=INK, hatch="////", linewidth=0.3)
    axes.add_collection(LineCollection(faces, colors=INK, linewidths=0.1))
    axes.plot([0, path_end], [0, path_end], color=INK, linewidth=0.8)
    axes.set(
        xlim=(0, path_end), ylim=(0, path_end), title=f"{_joint_name(proof, part)}: {math.floor(1000 * part.proved) / 10:g} %"
    )
    axes.set_aspect("equal")
    axes.grid(visible=False)


def _rotated_intervals(slab: LockSlab, joint: int) -> list[tuple[float, float]]:
    """Return the intervals of the path, in segments, over which the cells of a slab are rotated."""
    intervals, position, run_start = [], slab.begin, -1
    for end, center in zip(slab.ends, slab.centers, strict=True):
        if end < 0:
            run_start = position if run_start < 0 else run_start
            continue
        if run_start >= 0:
            last = position // SEGMENT_INSTANTS + int(center[joint]) / SEGMENT_INSTANTS
            intervals.append((run_start / SEGMENT_INSTANTS, last))
        position, run_start = end, -1
    return intervals
