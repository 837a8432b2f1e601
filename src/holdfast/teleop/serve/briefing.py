"""Description of the experiment for the page: ``/experiment.json``."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.session import find_training_scenario
from holdfast.teleop.serve.texts import Texts

EXPERIMENT_FORMAT = 1
_PARALLEL_TOLERANCE = 1e-9


def describe_experiment(protocol: Protocol, texts: Texts, tlx: bool = False) -> dict[str, Any]:
    """Return the experiment as JSON data that do not reveal the compared laws to the subject, not even by the protocol's name.

    Args:
        protocol: Protocol of the experiment.
        texts: Texts of the page.
        tlx: True to ask for the NASA task load index.
    """
    from holdfast.teleop.protocol.printed_arm import number_scenario_laws  # defines the indices of the laws in /arm.js

    center, workspace_radius = compute_planar_workspace(protocol.arm, protocol.rows)
    training = protocol.training
    return {
        "format": EXPERIMENT_FORMAT,
        "joints": protocol.arm.n,
        "axes": protocol.rows.m,
        "rate": protocol.rate,
        "stick": {"limit": protocol.stick.limit, "dead_zone": protocol.stick.dead_zone},
        "radius": protocol.radius,
        "cycle_limit": protocol.cycle_limit,
        "rating": list(protocol.rating),
        "training": {
            "at_least": training.at_least,
            "in_a_row": training.in_a_row,
            "limit": training.limit,
            "most": training.most,
        },
        "training_law": number_scenario_laws(protocol)[find_training_scenario(protocol)],
        "reach": workspace_radius,
        "centre": center,
        "views": describe_views(protocol),
        "texts": dict(texts.strings),
        "forms": list(texts.forms),
        "tlx": tlx,
    }


def describe_views(protocol: Protocol) -> list[dict[str, Any]]:
    """Describe the windows on the arm: each shows points of the base frame on two axes.

    A planar task with two rows has one window; a task with three rows has views from above and from the side.
    """
    rows = protocol.rows.rows[:, :3]
    if len(rows) == 1:
        unit_vector = np.eye(3)[int(np.argmin(np.abs(rows[0])))]
        second_axis = unit_vector - (unit_vector @ rows[0]) * rows[0] / (rows[0] @ rows[0])
        pairs = [np.stack([rows[0], second_axis])]
    elif len(rows) == 2:
        pairs = [rows]
    else:
        pairs = [rows[[0, 1]], rows[[0, 2]]]
    return [{"label": ", ".join(_axis_name(row) for row in pair), "rows": pair.tolist()} for pair in pairs]


def compute_planar_workspace(arm: Arm, task: Task) -> tuple[list[float], float | None]:
    """Return the centre and radius, m, of the boundary of a planar arm's workspace: its stretched length about the first joint.

    The radius is None for an arm that is not planar, or that has prismatic joints. Joint limits are ignored.
    """
    center = arm.frames_at_zero[0, :3, 3].tolist()
    rows = task.rows[:, :3]
    if arm.prismatic.any() or len(rows) != 2:
        return center, None
    normal = np.cross(*rows)
    if np.abs(np.cross(arm.axes_at_zero, normal)).max() > _PARALLEL_TOLERANCE:
        return center, None
    projected = arm.frames_at_zero[:, :3, 3] @ rows.T
    return center, float(np.linalg.norm(np.diff(projected, axis=0), axis=1).sum())


def _axis_name(row: FloatArray) -> str:
    index = int(np.argmax(np.abs(row)))
    return ("" if row[index] > 0 else "-") + "xyz"[index]
