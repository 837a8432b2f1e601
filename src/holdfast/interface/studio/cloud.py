"""Region of an assessment as points, each of which represents a configuration."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.extras import guard_imports
from holdfast.interface.studio.machine import CompiledArm, to_plain
from holdfast.interface.studio.state import State
from holdfast.kinematics.regions.region import Region, rpy_from_rotation
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.run import assess, load

MAX_POINTS = 2500  # largest number of drawn points
REGION_POSES = 1200  # number of poses in a region around the end effector
_MAX_TURN_RAD = np.radians(30)  # of the orientations in such a region
_GREY_LEVEL = 150  # colour of a pose without a configuration, 0 to 255


def find_region_cloud(machine: CompiledArm, state: State, progress: Callable[[int, int], None]) -> dict[str, Any]:
    """Return the ``Cloud`` of the state's results folder, or of poses around the end effector.

    These poses are displaced along each axis by at most a quarter of the arm's length, and rotated by at most 30 degrees.

    Raises:
        StoreError: The folder is not a results folder.
        HoldfastError: The results are of another arm, or the arm has no such index.
    """
    if state.region is not None:
        assessment = load(state.region)
        if assessment.arm.fingerprint != machine.arm.fingerprint:
            raise InputError(
                f"'{state.region}' is an assessment of '{assessment.arm.name}', not of '{machine.arm.name}'; open that arm"
            )
        return make_cloud(assessment, state.region)
    index, tool_pose = machine.get_index(state.index), machine.tool_pose(np.array(state.q))
    extent, turns = np.full(3, 0.5 * machine.size), np.full(3, 2 * _MAX_TURN_RAD)
    region = Region.box(tool_pose[:3, 3], extent, rpy_from_rotation(tool_pose[:3, :3]), turns, order="abdi")
    assessment = assess(machine.arm, region, index, poses=REGION_POSES, restarts=20, progress=progress, keep=True)
    label = f"{REGION_POSES} poses within {100 * 0.25 * machine.size:.0f} cm and 30 deg of the end effector"
    return make_cloud(assessment, label)


def make_cloud(assessment: Assessment, label: str) -> dict[str, Any]:
    """Make a ``Cloud`` of the stored poses of an assessment, at most 2500 of them; dark is bad, bright is good."""
    with guard_imports("the colours of a region"):
        from holdfast.interface.report.scenes import Scale

    columns = assessment.columns
    q, values = np.asarray(columns["q"][:], dtype=np.float64), np.asarray(columns["index"][:], dtype=np.float64)
    selected = np.unique(np.linspace(0, len(q) - 1, min(MAX_POINTS, len(q))).astype(int))
    q, values = q[selected], values[selected]
    has_configuration: NDArray[np.bool_] = np.asarray(np.isfinite(q).all(axis=1))
    if "position" in columns:
        points = np.asarray(columns["position"][:], dtype=np.float64)[selected]
    else:  # only the points of configurations are known
        q, values, has_configuration = q[has_configuration], values[has_configuration], has_configuration[has_configuration]
        points = assessment.arm.forward_kinematics(q)[:, :3, 3] if len(q) else np.zeros((0, 3))
    scale = Scale.from_values(values[has_configuration], smaller_is_better=assessment.index.better == "smaller")
    colors = np.full((len(q), 3), _GREY_LEVEL, dtype=np.uint8)
    if has_configuration.any():
        colors[has_configuration] = (255 * scale.colors(values[has_configuration])[:, :3]).astype(np.uint8)
    return {
        "label": f"{label}: {assessment.index.name} from {scale.low:.3g} (dark) to {scale.high:.3g} (bright)",
        "points": points.tolist(),
        "colors": colors.tolist(),
        "q": [row.tolist() if found else None for row, found in zip(q, has_configuration, strict=True)],
        "values": to_plain(values),
    }
