"""The region of an assessment as points that stand for configurations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.assessment.assessment import Assessment
from holdfast.assessment.run import assess, load
from holdfast.errors import InputError
from holdfast.indices.index import Index
from holdfast.regions.region import Region

Array = NDArray[np.float64]
MOST = 2500  # points that are drawn
POSES = 1200  # of a region around the end effector


@dataclass(frozen=True)
class Cloud:
    """Poses of a region, coloured by the index of the configuration found there.

    Attributes:
        label: What it is, for people.
        points: (N, 3) tool points, m.
        colors: (N, 3) RGB, 0 to 255; dark is bad, bright is good; grey: no configuration found.
        q: (N, n) configurations, rad and m; NaN where none was found.
        values: (N,) of the index.
    """

    label: str
    points: Array
    colors: NDArray[np.uint8]
    q: Array
    values: Array


def around(index: Index, hand: Array, size: float, progress: Callable[[int, int], None]) -> Cloud:
    """A region of a quarter of the arm's length around the tool, orientations within 30 degrees of its own; assessed now."""
    from holdfast.regions.region import rpy_from_rotation

    half = np.radians(30)
    extent = np.r_[np.full(3, 0.5 * size), np.full(3, 2 * half)]
    region = Region.box(hand[:3, 3], extent[:3], rpy_from_rotation(hand[:3, :3]), extent[3:], order="abdi")
    found = assess(index.arm, region, index, poses=POSES, restarts=20, progress=progress, keep=True)
    return cloud_of(found, f"{POSES} poses within {100 * 0.25 * size:.0f} cm and 30 deg of the end effector")


def read_cloud(arm: Arm, path: str) -> Cloud:
    """The region of a results folder of ``holdfast assess``.

    Raises:
        StoreError: It is not one.
        InputError: It is of another arm.
    """
    found = load(path)
    if found.arm.fingerprint != arm.fingerprint:
        raise InputError(f"'{path}' is an assessment of '{found.arm.name}', not of '{arm.name}'; open that arm")
    return cloud_of(found, f"{path}")


def cloud_of(found: Assessment, label: str) -> Cloud:
    """The kept poses of an assessment, at most 2500 of them."""
    from holdfast.report.scenes import Scale

    data = found.columns
    q, values = np.asarray(data["q"][:], dtype=np.float64), np.asarray(data["index"][:], dtype=np.float64)
    pick = np.unique(np.linspace(0, len(q) - 1, min(MOST, len(q))).astype(int))
    q, values = q[pick], values[pick]
    sound: NDArray[np.bool_] = np.asarray(np.isfinite(q).all(axis=1))
    points = np.empty((len(q), 3))
    points[sound] = found.arm.forward_kinematics(q[sound])[:, :3, 3] if sound.any() else 0.0
    if "position" in data:
        points = np.asarray(data["position"][:], dtype=np.float64)[pick]
    elif not sound.all():
        points, q, values, sound = points[sound], q[sound], values[sound], sound[sound]
    scale = Scale.of(values[sound], smaller_is_better=found.index.better == "smaller")
    colors = np.full((len(q), 3), 150, dtype=np.uint8)
    if sound.any():
        colors[sound] = (255 * scale.colors(values[sound])[:, :3]).astype(np.uint8)
    text = f"{label}: {found.index.name} from {scale.low:.3g} (dark) to {scale.high:.3g} (bright)"
    return Cloud(text, points, colors, q, values)
