"""Configurations, finite joint limits to sample between, frames along the axes, and bounds of distances from the axes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.machine import ArmData
from holdfast.model.arm.poses import rotation_to_axis

Length = TypeVar("Length", bound=Any)  # a number or a symbolic expression, m


def as_configurations(arm: ArmData, q: ArrayLike) -> tuple[FloatArray, bool]:
    """Return ``q`` as (N, n), and whether it was a single configuration, which must then be finite.

    Raises:
        InputError: The shape is wrong, or a single configuration contains NaN or infinity.
    """
    checked_q = arm.check_configurations(q)
    single = checked_q.ndim == 1
    if single and not np.isfinite(checked_q).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return np.atleast_2d(checked_q), single


def sampling_limits(arm: ArmData) -> tuple[FloatArray, FloatArray]:
    """Return (n,) lower and upper limits for sampling; a missing limit is pi rad or 1 m from 0, or from the other limit."""
    return replace_infinite_limits(arm.lower, arm.upper, arm.prismatic)


def replace_infinite_limits(lower: FloatArray, upper: FloatArray, prismatic: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Replace infinite limits (..., n), which need not belong to one arm, as :func:`sampling_limits` does."""
    default_bound = np.where(prismatic, 1.0, np.pi)
    finite_lower = np.where(np.isfinite(lower), lower, np.minimum(-default_bound, upper - default_bound))
    finite_upper = np.where(np.isfinite(upper), upper, np.maximum(default_bound, lower + default_bound))
    return finite_lower, finite_upper


@lru_cache(maxsize=64)
def align_joint_frames(arm: ArmData) -> tuple[FloatArray, FloatArray]:
    """Return the frames of all joints, rotated so that each joint's axis is z, and the poses of the links' own frames in them.

    Returns:
        (n, 4, 4) pose at q = 0 of each rotated frame in the previous one, the first in the world; and (n + 1, 4, 4) pose of the
        base's frame in the world, and of the frame of each link in its rotated frame, m.
    """
    frames, from_link, from_links = [], np.eye(4), [arm.base]
    for joint in arm.joints:
        to_axis = np.eye(4)
        to_axis[:3, :3] = rotation_to_axis(joint.axis)
        frames.append(from_link @ joint.origin @ to_axis)
        from_link = to_axis.T
        from_links.append(from_link)
    frames[0] = arm.base @ frames[0]
    return np.array(frames), np.array(from_links)


def bound_axis_distances(arm: ArmData, end_length: Length, extensions: Sequence[Length]) -> list[Length]:
    """Bound the distance of a point of the last link from the axis of each joint, m, by the lengths beyond the axis.

    Args:
        arm: Arm model.
        end_length: Distance of the point from the frame of the last joint, m.
        extensions: Largest extension of each prismatic joint, m; not read for revolute joints.
    """
    length, distances = end_length, list[Length]()
    for joint, extension in zip(reversed(arm.joints), reversed(extensions), strict=True):
        if joint.prismatic:
            length = length + extension
        distances.append(length)
        length = length + float(np.linalg.norm(joint.origin[:3, 3]))
    return distances[::-1]
