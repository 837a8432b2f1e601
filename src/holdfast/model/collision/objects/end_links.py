"""Tool poses at which every configuration collides, because the pose alone fixes the last two links.

A pose fixes the last link, and leaves the link before it one degree of freedom, the last joint. While that joint rotates by at
most a from a checked angle, a sphere with its centre at distance d from the axis moves by at most d a. If it is closer to an
object than allowed by more than that, it is too close at all of these angles.
"""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.machine import ArmData, Joint
from holdfast.model.cell.solids import PrimitiveSolid
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.model.collision.object_kernels import FormulaObjects
from holdfast.model.collision.sphere_cover import SphereCover

_STAGE_ANGLES = (1, 3, 20)  # numbers of angles of the last joint; each stage refines what the previous one leaves undecided
_GOLDEN_FRACTION = (np.sqrt(5) - 1) / 2  # its multiples are spread around the circle for any number of them
_LAST_JOINT = 5  # joint that moves the last link here
_PREVIOUS_JOINT = 6  # joint that moves the link before it
# m: a configuration meets its pose to 1e-6 m and rad, so this additional distance decides.
_POSE_TOLERANCE_M = 1e-5


class EndLinks:
    """Last two links of an arm at the tool's pose, among objects with a distance formula.

    Args:
        arm: Arm model with two joints or more.
        spheres: Spheres that cover the arm.
        objects: F objects.
        offsets: (n, F) offset of the distance of each moving link from each object, m.
        margins: (F,) distance to keep from each object, m.
    """

    def __init__(
        self, arm: ArmData, spheres: SphereCover, objects: list[PrimitiveSolid], offsets: FloatArray, margins: FloatArray
    ) -> None:
        last_joint, count = arm.joints[-1], sum(_STAGE_ANGLES)
        lower, upper = (float(limits[-1]) for limits in sampling_limits(arm))
        step = (upper - lower) / count
        order = np.argsort(np.arange(count) * _GOLDEN_FRACTION % 1)
        self._angles = np.split(lower + step * (order + 0.5), np.cumsum(_STAGE_ANGLES)[:-1])
        self._from_tool, from_last_joint = np.linalg.inv(arm.tool), np.linalg.inv(last_joint.origin)
        end_spheres = np.flatnonzero((spheres.link >= arm.n - 2) & (spheres.link > BASE_LINK))[::-1]  # the last link's first
        center, on_previous = spheres.center[end_spheres], spheres.link[end_spheres] == arm.n - 2
        # Seen from the last link, and moved in the other direction.
        center[on_previous] = center[on_previous] @ from_last_joint[:3, :3].T + from_last_joint[:3, 3]
        axis_distance = (
            np.ones(len(end_spheres)) if last_joint.prismatic else np.linalg.norm(np.cross(center, last_joint.axis), axis=1)
        )
        radius = spheres.radius[end_spheres] - on_previous * axis_distance * step / 2
        end_cover = SphereCover(np.where(on_previous, _PREVIOUS_JOINT, _LAST_JOINT), center, radius, spheres.part[end_spheres])
        self._last = np.unique(end_cover.link) == _LAST_JOINT
        offsets = offsets[np.unique(spheres.link[end_spheres])[::-1]]
        self._objects, self._margins = FormulaObjects(_last_link_machine(last_joint), end_cover, objects, offsets), margins

    def are_poses_too_close(self, poses: FloatArray, margin: float) -> BoolArray:
        """Return (N,) True where every configuration of a pose (N, 4, 4), met to 1e-6, is proved closer than the margin, m.

        False is no proof.
        """
        if not (self._last.size and self._margins.size):
            return np.zeros(len(poses), dtype=np.bool_)
        coordinates = _pose_coordinates(poses @ self._from_tool)
        always_close, undecided = np.ones(len(poses), dtype=np.bool_), np.arange(len(poses))
        for angles in self._angles:
            q = np.column_stack([np.repeat(coordinates[undecided], len(angles), axis=0), -np.tile(angles, undecided.size)])
            margins_left = (self._objects.link_distances(q) - self._margins).min(axis=2, initial=np.inf)
            is_close = (margins_left < margin - _POSE_TOLERANCE_M).reshape(undecided.size, len(angles), len(self._last))
            always_close[undecided] = remains_close = is_close.any(axis=2).all(axis=1)
            undecided = undecided[remains_close & ~is_close[:, 0, self._last].any(axis=1)]
        return always_close


def _last_link_machine(last: Joint) -> ArmData:
    """Return a machine whose first six joints put the last link of an arm anywhere; the seventh is the arm's last, reversed."""
    slides = [Joint(f"along {name}", "prismatic", np.eye(4), axis=axis) for name, axis in zip("xyz", np.eye(3), strict=True)]
    turns = [
        Joint(f"about {axis_name}", "continuous", np.eye(4), axis=direction)
        for axis_name, direction in zip("zyx", np.eye(3)[::-1], strict=True)
    ]
    return ArmData("end links", (*slides, *turns, Joint("last", last.type, np.eye(4), axis=last.axis)))


def _pose_coordinates(poses: FloatArray) -> FloatArray:
    """Return positions, m, and angles about z, then y, then x, rad, of poses (N, 4, 4), together (N, 6)."""
    r = poses[:, :3, :3]
    yaw = np.arctan2(r[:, 1, 0], r[:, 0, 0])  # 0 at a quarter turn about y, where any yaw is valid
    cosine, sine = np.cos(yaw), np.sin(yaw)
    pitch = np.arctan2(-r[:, 2, 0], cosine * r[:, 0, 0] + sine * r[:, 1, 0])
    roll = np.arctan2(sine * r[:, 0, 2] - cosine * r[:, 1, 2], cosine * r[:, 1, 1] - sine * r[:, 0, 1])
    return np.column_stack([poses[:, :3, 3], yaw, pitch, roll])
