"""Region of an assessment as points, each of which represents a configuration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.model import Arm
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.run import assess, load

MAX_POINTS = 2500  # largest number of drawn points
REGION_POSES = 1200  # number of poses in a region around the end effector


@dataclass(frozen=True)
class RegionCloud:
    """Poses of a region, coloured by the index of the configuration found for each.

    Attributes:
        label: Caption of the cloud.
        points: (N, 3) tool points, m.
        colors: (N, 3) RGB, 0 to 255; dark is bad, bright is good; grey: no configuration found.
        q: (N, n) configurations, rad and m; NaN where none was found.
        values: (N,) values of the index.
    """

    label: str
    points: FloatArray
    colors: NDArray[np.uint8]
    q: FloatArray
    values: FloatArray


def assess_around_tool(index: Index, tool_pose: FloatArray, size: float, progress: Callable[[int, int], None]) -> RegionCloud:
    """Assess a region of a quarter of the arm's length around the tool, with orientations within 30 degrees of its own."""
    from holdfast.kinematics.regions.region import rpy_from_rotation

    half_angle = np.radians(30)
    extent = np.r_[np.full(3, 0.5 * size), np.full(3, 2 * half_angle)]
    region = Region.box(tool_pose[:3, 3], extent[:3], rpy_from_rotation(tool_pose[:3, :3]), extent[3:], order="abdi")
    assessment = assess(index.arm, region, index, poses=REGION_POSES, restarts=20, progress=progress, keep=True)
    return make_cloud(assessment, f"{REGION_POSES} poses within {100 * 0.25 * size:.0f} cm and 30 deg of the end effector")


def read_cloud(arm: Arm, path: str) -> RegionCloud:
    """Read the region of a results folder of ``holdfast assess``.

    Raises:
        StoreError: The folder is not a results folder.
        InputError: The results are of another arm.
    """
    assessment = load(path)
    if assessment.arm.fingerprint != arm.fingerprint:
        raise InputError(f"'{path}' is an assessment of '{assessment.arm.name}', not of '{arm.name}'; open that arm")
    return make_cloud(assessment, f"{path}")


def make_cloud(assessment: Assessment, label: str) -> RegionCloud:
    """Make a cloud of the stored poses of an assessment, at most 2500 of them."""
    from holdfast.interface.report.scenes import Scale

    columns = assessment.columns
    q, values = np.asarray(columns["q"][:], dtype=np.float64), np.asarray(columns["index"][:], dtype=np.float64)
    selected = np.unique(np.linspace(0, len(q) - 1, min(MAX_POINTS, len(q))).astype(int))
    q, values = q[selected], values[selected]
    has_configuration: NDArray[np.bool_] = np.asarray(np.isfinite(q).all(axis=1))
    points = np.empty((len(q), 3))
    points[has_configuration] = (
        assessment.arm.forward_kinematics(q[has_configuration])[:, :3, 3] if has_configuration.any() else 0.0
    )
    if "position" in columns:
        points = np.asarray(columns["position"][:], dtype=np.float64)[selected]
    elif not has_configuration.all():
        points = points[has_configuration]
        q = q[has_configuration]
        values = values[has_configuration]
        has_configuration = has_configuration[has_configuration]
    scale = Scale.from_values(values[has_configuration], smaller_is_better=assessment.index.better == "smaller")
    colors = np.full((len(q), 3), 150, dtype=np.uint8)
    if has_configuration.any():
        colors[has_configuration] = (255 * scale.colors(values[has_configuration])[:, :3]).astype(np.uint8)
    caption = f"{label}: {assessment.index.name} from {scale.low:.3g} (dark) to {scale.high:.3g} (bright)"
    return RegionCloud(caption, points, colors, q, values)
