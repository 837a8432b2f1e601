"""An arm as a stick figure: the directions in which to look at it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import plane_normal
from holdfast.report.animations import Projection

Array = NDArray[np.float64]


def projections(arm: Arm, chain: Array) -> list[Projection]:
    """Side and top view of ``arm.frames(q)[..., :3, 3]`` (F, n + 2, 3); of an arm that moves in a plane, that plane."""
    normal = plane_normal(arm)
    x, y, z = np.eye(3)
    if normal is None:
        size = np.ptp(chain.reshape(-1, 3), axis=0)
        side = (
            Projection(x, z, ("x, m", "z, m"), "Side view")
            if size[0] >= size[1]
            else Projection(y, z, ("y, m", "z, m"), "Side view")
        )
        return [side, Projection(x, y, ("x, m", "y, m"), "Top view")]
    up = -arm.gravity - normal * (normal @ -arm.gravity)
    if np.linalg.norm(up) < 1e-6 * max(float(np.linalg.norm(arm.gravity)), 1e-12):
        up = y - normal * normal[1] if abs(normal[1]) < 0.9 else x - normal * normal[0]
    up = up / np.linalg.norm(up)
    right = np.cross(up, normal)
    return [Projection(right, up, (f"{_axis(right)}, m", f"{_axis(up)}, m"), "In the plane of the arm")]


def _axis(direction: Array) -> str:
    """The name of a direction: of a world axis, or its numbers."""
    for name, axis in zip("xyz", np.eye(3), strict=True):
        if abs(direction @ axis) > 1 - 1e-9:
            return name if direction @ axis > 0 else f"-{name}"
    return "along (" + ", ".join(f"{x:.2f}" for x in direction) + ")"
