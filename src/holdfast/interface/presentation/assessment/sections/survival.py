"""Fraction of the poses of the region that are still reached after a joint has locked."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.formatting import format_interval, format_percent
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.tables import describe_lock, tabulate_survival
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.report.page import Block, Picture, Text
from holdfast.interface.report.views import View, choose_side_and_top_views
from holdfast.model.collision.exact.exact_clearance import ExactClearance
from holdfast.studies.assessment.plan import LOCK_RESTARTS

_MIN_POSES_FOR_MAP = 200


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the figure and the table of the poses that are still reached after each lock, if the run tested locks."""
    survivors = facts.assessment.survivors
    if survivors is None or not facts.distribution.samples:
        return []
    fractions, locks = facts.assessment.survival(), facts.assessment.plan.locks
    worst = min(fractions, key=lambda name: fractions[name].value)
    names = facts.assessment.arm.joint_names
    worst_position = describe_lock(facts, worst, facts.assessment.locks[worst])
    positions = {
        joint: "" if angle is None else f" {describe_lock(facts, names[joint], angle).partition(' (')[0]}"
        for joint, angle in locks.items()
    }
    bar_labels = [f"{joint + 1} {names[joint]}{position}" for joint, position in positions.items()]
    total = facts.distribution.total_weight() if facts.distribution.has_weights else facts.distribution.samples
    axis_label = f"{'weight of ' if facts.distribution.has_weights else ''}poses still reached after a lock of the joint"
    figure = report.bar_figure(bar_labels, survivors[list(locks)].tolist(), axis_label, total=total, stress="least")
    collision_free = ""
    if facts.assessment.clear is not None:
        share = format_interval(facts.assessment.reached_clear())
        collision_free = f", and at least {share} of all poses without collision with {facts.avoided_objects}"
    is_specified = [angle is not None for angle in locks.values()]
    place = "at its position for another pose of the region, chosen at random"
    if all(is_specified):
        place = "at the given position"
    elif any(is_specified):
        place = f"at the given position, or otherwise {place}"
    blocks: list[Block] = [
        Text(
            f"The healthy arm reaches {format_percent(1 - facts.distribution.unreached_share)} of "
            f"{'the weight of ' if facts.distribution.has_weights else ''}the {facts.distribution.samples:,} "
            f"poses{collision_free}. The most costly lock is that of {worst}, {worst_position}. The "
            f"fraction of the poses reached after it is {format_interval(fractions[worst])}."
        ),
        Picture(
            report.svg(figure, "survival", "Poses still reached once each joint has locked"),
            f"Each joint is locked {place}. A pose counts as reached if inverse kinematics with the locked joint finds a "
            f"configuration from one of {LOCK_RESTARTS} starts{_describe_clearance_method(facts)}, so the fractions are lower "
            f"bounds.",
        ),
    ]
    blocks += _build_map_blocks(facts, facts.assessment.arm.joint_index(worst), worst_position)
    table = tabulate_survival(facts)
    return blocks if table is None else [*blocks, build_table_block(table.texts())]


def _describe_clearance_method(facts: AssessmentFacts) -> str:
    clearance = facts.assessment.plan.clearance
    if facts.assessment.clear is None or clearance is None:
        return ""
    distance_kind = f"exact where small, {clearance.exact_by}" if isinstance(clearance, ExactClearance) else "lower bounds"
    return f" without collision with {facts.avoided_objects} (distances: {distance_kind})"


def _build_map_blocks(facts: AssessmentFacts, joint: int, position: str) -> list[Block]:
    """Map the poses that the arm reaches when healthy and after the most costly lock."""
    poses = facts.poses
    if poses is None or len(poses.reached) < _MIN_POSES_FOR_MAP:
        return []
    views = choose_side_and_top_views(poses.position, ("seen from the side", "seen from above"))
    if not views:
        return []
    view = views[0]
    remaining = facts.assessment.columns["survives"][:][poses.number, joint] == 1
    healthy = poses.reached if facts.assessment.clear is None else facts.assessment.columns["clear"][:][poses.number] == 1
    name = facts.assessment.arm.joint_names[joint]
    figure = draw_before_and_after(poses.position, healthy, remaining, view, f"{name} locked", poses.weight)
    total = len(remaining)
    text = (
        f"Fraction of the poses in each cell that are reached, over the whole depth of the region {view.title}, with the "
        f"number of poses of the cell below. Left: the healthy arm reaches {int(healthy.sum()):,} of {total:,} poses"
        f"{_describe_clearance_method(facts)}. Right: with {name} locked {position}, {int(remaining.sum()):,} of {total:,}."
    )
    if facts.distribution.has_weights:
        text += " The fractions are weighted; these numbers are not."
    return [Picture(report.svg(figure, "survival-map", f"Where poses are reached before and after {name} locks"), text)]


def draw_before_and_after(
    position: FloatArray,
    healthy: NDArray[np.bool_],
    remaining: NDArray[np.bool_],
    view: View,
    locked_title: str,
    weights: FloatArray | None = None,
) -> report.Figure:
    """Map the fraction of positions (N, 3), m, that are reached (N,) before and after a failure, weighted by (N,) if given."""
    panels = [("Healthy", healthy), (report.format_label(locked_title, 37), remaining)]
    return report.share_figure(position, panels, view, label="fraction of the poses reached", weights=weights)
