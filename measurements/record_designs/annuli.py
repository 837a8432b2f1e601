"""Failure-tolerant workspace of planar arms whose first two joints are unlimited: rings about the first joint."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray


def compute_tolerant_area(lengths: FloatArray, limits: FloatArray, samples: int = 25) -> FloatArray:
    """Return the area (P,), m^2, of the failure-tolerant workspace of planar arms of n revolute joints, n = 3 or more.

    The first two joints turn all the way. Links that others follow after a lock of joint k are one of length
    ``|l_(k-1) + l_k e^(iq)|``, and chains of free links reach a ring. A lock of joint 1 may have any direction: the others
    must reach all distances from ``|r - l1|`` to ``r + l1`` from the elbow.

    Args:
        lengths: (P, n) of the links, m.
        limits: (P, n - 2, 2) artificial limits of the link angles of joints 3 to n, rad; all joints turn all the way after a
            lock.
        samples: Of each range, for what the healthy arm reaches; the area is not overestimated by few.

    Source: derived here.
    """
    arm_count, n = lengths.shape
    first_length, second_length, other_lengths = lengths[:, 0], lengths[:, 1], lengths[:, 2:]
    # Healthy: the distances between joint 2 and the tool, then those from joint 1.
    fractions = np.linspace(0, 1, samples)
    tips = other_lengths[:, -1].astype(complex).reshape(arm_count, 1)
    for joint in range(n - 1, 1, -1):
        lower, upper = limits[:, joint - 2, 0], limits[:, joint - 2, 1]
        rotation = np.exp(1j * (lower[:, None] + (upper - lower)[:, None] * fractions))
        previous_length = second_length if joint == 2 else other_lengths[:, joint - 3]
        tips = (previous_length[:, None, None] + rotation[:, :, None] * tips[:, None, :]).reshape(arm_count, -1)
    distance = np.abs(tips)
    nearest, farthest = distance.min(axis=1), distance.max(axis=1)
    lower = np.maximum(np.maximum(first_length - farthest, nearest - first_length), 0.0)
    upper = first_length + farthest
    for joint in range(1, n):
        free_lengths = np.delete(lengths, [joint - 1, joint], axis=1)
        a, b = lengths[:, joint - 1], lengths[:, joint]
        if joint == 1:
            least_span, greatest_span = np.abs(a - b), a + b
        else:
            least_cosine, greatest_cosine = _find_cosine_range(limits[:, joint - 2])
            least_span, greatest_span = (
                np.sqrt(np.maximum(a * a + b * b + 2 * a * b * c, 0.0)) for c in (least_cosine, greatest_cosine)
            )
        total, longest = free_lengths.sum(axis=1), free_lengths.max(axis=1)
        upper = np.minimum(upper, least_span + total)
        lower = np.maximum(lower, np.maximum(greatest_span - total, 2 * longest - total - least_span))
    moving_lengths = lengths[:, 1:]
    upper = np.minimum(upper, moving_lengths.sum(axis=1) - first_length)
    inner_radius = np.maximum(2 * moving_lengths.max(axis=1) - moving_lengths.sum(axis=1), 0.0)

    def annulus_area(inner: FloatArray, outer: FloatArray) -> FloatArray:
        inner, outer = np.maximum(inner, 0), np.maximum(outer, 0)
        return np.asarray(np.pi * np.maximum(outer**2 - inner**2, 0))

    whole_area = annulus_area(lower, upper)
    split_area = annulus_area(lower, np.minimum(upper, first_length - inner_radius)) + annulus_area(
        np.maximum(lower, first_length + inner_radius), upper
    )
    return np.asarray(np.where(inner_radius > 0, split_area, whole_area))


def _find_cosine_range(limits: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the least and the largest cosine within ranges (P, 2), rad."""
    lower, upper = limits[:, 0], limits[:, 1]
    end_cosines = np.cos(limits)

    def contains_angle(angle: float) -> NDArray[np.bool_]:
        return np.asarray(angle + 2 * np.pi * np.ceil((lower - angle) / (2 * np.pi)) <= upper)

    return np.where(contains_angle(np.pi), -1.0, end_cosines.min(axis=1)), np.where(
        contains_angle(0.0), 1.0, end_cosines.max(axis=1)
    )
