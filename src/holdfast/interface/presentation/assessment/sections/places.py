"""Worst poses of a region, and maps of the average index."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.formatting import format_count, format_decimals, format_number
from holdfast.core.probability.distribution import Distribution
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.assessment.answer import EvaluatedPoses
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.commands import build_pose_command
from holdfast.interface.report.page import Block, Code, Picture, Table, Text
from holdfast.interface.report.views import choose_side_and_top_views
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.poses import zyx_angles

_MIN_POSES_FOR_MAP = 200


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the tables of the worst poses and the maps of the average index over the region."""
    poses = facts.poses
    if poses is None and not facts.distribution.reached:
        return []
    if poses is None:
        return [Text(f"The {facts.noun}s of this run were not stored (keep=False), so the report cannot list or map them.")]
    if not poses.reached.any():
        return []
    if facts.is_worst_everywhere:
        return [Text(f"Every {facts.noun} reached has the same, worst index, so none are listed or mapped.")]
    reached_samples = [
        (name, distribution, sampled)
        for name, distribution, sampled in facts.samples
        if sampled is not None and sampled.reached.any()
    ]
    blocks: list[Block] = [
        block
        for name, distribution, sampled in reached_samples
        for block in (_tabulate_worst_poses(facts, distribution, sampled, name), *_build_worst_commands(facts, sampled))
    ]
    views = choose_side_and_top_views(poses.position, ("Seen from the side", "Seen from above"))
    if int(poses.reached.sum()) < _MIN_POSES_FOR_MAP or not views:
        return blocks
    average = "Mean" if facts.larger_is_better else "Median"
    index_values = {
        name: np.where(sampled.reached, sampled.value, np.nan)
        for name, _, sampled in facts.samples
        if sampled is not None and sampled.reached.any()
    }
    figure = report.map_figure(
        poses.position,
        index_values,
        views,
        log=facts.is_logarithmic,
        smaller_is_better=not facts.larger_is_better,
        label=report.format_label(f"{average.lower()} {facts.index.name}"),
        weights=poses.weight,
    )
    text = (
        f"{average} index of the {facts.reached_noun} in each cell, over the whole depth of the region, with the number of "
        f"{'reached and of sampled poses' if facts.distribution.unreached else f'{facts.noun}s'} below, out of "
        f"{len(poses.value):,}."
    )
    if len(index_values) > 1:
        text += " Upper row: at the configurations found; lower row: at the best ones, on the same colour scale."
    if facts.assessment.region.kind == "joints":
        text += " Positions are tool positions."
    if facts.distribution.has_weights:
        text += f" Within a cell the {facts.noun}s are weighted; cells without weight are grey."
    return [*blocks, Picture(report.svg(figure, "map", "Average index over the region"), text)]


def _find_worst_poses(facts: AssessmentFacts, poses: EvaluatedPoses) -> NDArray[np.intp]:
    reached = np.flatnonzero(poses.reached)
    order = np.argsort(poses.value[reached] if facts.larger_is_better else -poses.value[reached], kind="stable")
    return np.asarray(reached[order[:10]])


def _build_worst_commands(facts: AssessmentFacts, poses: EvaluatedPoses) -> list[Block]:
    """Build the commands that search for the best configuration of each of the worst poses."""
    if facts.assessment.region.kind == "joints":
        return []
    matrices = np.tile(np.eye(4), (len(chosen := _find_worst_poses(facts, poses)), 1, 1))
    matrices[:, :3, 3], matrices[:, :3, :3] = poses.position[chosen], poses.rotation[chosen]
    commands = "\n".join(build_pose_command(facts.assessment.arm, matrix) for matrix in matrices)
    return [Code(commands, "Commands that search for the best configuration of these poses, in the same order:")]


def _tabulate_worst_poses(facts: AssessmentFacts, distribution: Distribution, poses: EvaluatedPoses, sample_name: str) -> Table:
    reached, chosen = np.flatnonzero(poses.reached), _find_worst_poses(facts, poses)
    labels = facts.failure_labels
    angles = np.rad2deg(_choose_rpy_angles(poses.rotation[chosen], facts.assessment.region))
    cells = []
    for index, rotation in zip(chosen, angles, strict=True):
        failure = labels[poses.worst[index]] if poses.worst[index] >= 0 else "singular"
        pose_cells = [
            *(format_decimals(coordinate, 3) for coordinate in poses.position[index]),
            *(format_decimals(coordinate, 1) for coordinate in rotation[::-1]),
        ]
        cells.append([f"{poses.number[index] + 1:,}", *pose_cells, format_number(float(poses.value[index])), failure])
    header = [facts.noun.capitalize(), "x, m", "y, m", "z, m", "roll, deg", "pitch, deg", "yaw, deg", "index", "worst failure"]
    suffix = f", {sample_name}" if facts.assessment.optimised is not None else ""
    caption = f"The {len(chosen)} worst of {len(reached):,} {facts.reached_noun}{suffix}; R = Rz(yaw) Ry(pitch) Rx(roll)."
    if distribution.unreached:
        caption += f" The {format_count(distribution.unreached, 'pose')} without a configuration are worse, and not listed."
    return Table(cells, header, frozenset(range(8)), caption=caption, wide=True)


def _choose_rpy_angles(rotations: FloatArray, region: Region) -> FloatArray:
    """Return roll, pitch, yaw of rotations, rad; among the equivalent triples, the one nearest to the centre of the region."""
    first = zyx_angles(rotations)
    center = np.array(region.center[3:]) if region.kind == "box" else np.zeros(3)
    equivalent = np.stack([first[:, 0] + np.pi, np.pi - first[:, 1], first[:, 2] + np.pi], axis=1)
    candidates = np.stack([first, equivalent])
    candidates = center + (candidates - center + np.pi) % (2 * np.pi) - np.pi
    nearest = np.linalg.norm(candidates - center, axis=2).argmin(axis=0)
    return np.asarray(candidates[nearest, np.arange(len(nearest))])
