"""Path constraints: a line or plane of the tool point, a cone of a tool axis, or a fixed tool orientation."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.poses import check_poses, rotation_vectors

Frame = Literal["base", "tool"]

CONSTRAINT_TOLERANCE = (1e-3, float(np.deg2rad(0.5)))  # m and rad within which a row counts as met between the waypoints
_ROUNDING_M_RAD = 1e-8  # m and rad
_DOWN_DIRECTION = (0.0, 0.0, -1.0)
_TOOL_Z_AXIS = (0.0, 0.0, 1.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class ToolConstraint:
    """Fixed components of the end effector's pose along a motion; made by :func:`upright`, :func:`rail`, :func:`plane`.

    Attributes:
        name: ``upright``, ``rail`` or ``plane``.
        normals: (k, 3) orthonormal directions in which the tool point stays at ``pose``; k = 0: it is free.
        direction: (3,) unit vector with which the tool's axis is aligned; None: the axis is free.
        axis: (3,) unit vector of that axis in the tool's frame.
        angle: Half the opening of the cone about ``direction`` in which the axis stays, rad; 0: the axis is along it.
        turned: True if the whole orientation stays as in ``pose``.
        frame: Frame of normals and direction: ``base``, or ``tool`` at the start.
        pose: (4, 4) pose on the rail or plane, world, m; None: the tool's pose at the start.
        within: Allowed error of exact rows between two waypoints, m and rad.
    """

    name: str
    normals: FloatArray
    direction: FloatArray | None = None
    axis: FloatArray
    angle: float = 0.0
    turned: bool = False
    frame: Frame = "base"
    pose: FloatArray | None = None
    within: tuple[float, float] = CONSTRAINT_TOLERANCE

    def anchor(self, start: FloatArray) -> ToolConstraint:
        """Return the constraint in the base frame and through a pose, for ``start``, the tool's pose (4, 4) at the start, m."""
        rotation = start[:3, :3] if self.frame == "tool" else np.eye(3)
        return replace(
            self,
            normals=self.normals @ rotation.T,
            direction=None if self.direction is None else rotation @ self.direction,
            frame="base",
            pose=start if self.pose is None else self.pose,
        )

    @property
    def widest(self) -> float:
        """Largest tool rotation that satisfies the constraint, rad; infinite if the orientation is free."""
        if self.direction is None and not self.turned:
            return np.inf
        return self.angle or self.within[1]

    def distances(self, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the distances of tool ``poses`` (N, 4, 4) from the line or plane, (N,) m, and rotation errors, (N,) rad."""
        assert self.pose is not None, "not anchored"
        distance = np.linalg.norm((poses[:, :3, 3] - self.pose[:3, 3]) @ self.normals.T, axis=1)
        if self.turned:
            rotation_angle = np.linalg.norm(rotation_vectors(poses[:, :3, :3] @ self.pose[:3, :3].T), axis=1)
        elif self.direction is not None:
            tool_axis = poses[:, :3, :3] @ self.axis
            rotation_angle = np.arctan2(np.linalg.norm(np.cross(tool_axis, self.direction), axis=1), tool_axis @ self.direction)
        else:
            rotation_angle = np.zeros(len(poses))
        return distance, rotation_angle

    def farthest(self, poses: FloatArray) -> tuple[float, float]:
        """Return the largest values of :meth:`distances` at ``poses`` (N, 4, 4), m and rad."""
        distance, rotation_angle = self.distances(poses)
        return float(distance.max()), float(rotation_angle.max())

    def trouble(self, poses: FloatArray) -> str:
        """Return a phrase on the largest violation of the constraint at ``poses`` (N, 4, 4); empty if there is none."""
        distance, rotation_angle = self.farthest(poses)
        violations = []
        if distance > self.within[0] + _ROUNDING_M_RAD:
            violations.append(f"{distance:.4g} m off the {self.name}")
        if rotation_angle > self.widest + _ROUNDING_M_RAD:
            violations.append(f"rotated away by {np.rad2deg(rotation_angle):.4g} deg, beyond {np.rad2deg(self.widest):.4g} deg")
        return " and ".join(violations)

    def __str__(self) -> str:
        phrases = []
        if len(self.normals):
            locus = "line along" if len(self.normals) == 2 else "plane across"
            locus_direction = self.normals[0] if len(self.normals) == 1 else np.cross(*self.normals)
            phrases.append(f"the tool point on the {locus} ({_format_vector(locus_direction)})")
        if self.direction is not None:
            axis_phrase = (
                "the tool's z axis"
                if np.array_equal(self.axis, _TOOL_Z_AXIS)
                else f"the tool's axis ({_format_vector(self.axis)})"
            )
            phrases.append(f"{axis_phrase} within {np.rad2deg(self.widest):.4g} deg of ({_format_vector(self.direction)})")
        if self.turned:
            phrases.append("its orientation as it is")
        return f"{self.name}, {' and '.join(phrases)}" + " in the tool's axes at the start" * (self.frame == "tool")

    def to_dict(self) -> dict[str, Any]:
        """Return all fields of the constraint as JSON data."""
        values = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in values.items()}


@check_arguments
def upright(
    angle: float,
    *,
    axis: ArrayLike = _TOOL_Z_AXIS,
    direction: ArrayLike = _DOWN_DIRECTION,
    within: ArrayLike = CONSTRAINT_TOLERANCE,
) -> ToolConstraint:
    """Keep an axis of the tool in a cone, for example to hold a tray level, a cup upright, or a torch pointing down.

    Args:
        angle: Half the opening of the cone, rad, from 0 to below pi/2; with 0 the axis stays along the direction, up to
            ``within``.
        axis: (3,) vector in the tool's frame; default: its z axis.
        direction: (3,) vector in the world; default: straight down.
        within: (2,) allowed error between two waypoints, m and rad; only used with an angle of 0.

    Returns:
        Constraint for the argument ``keep`` of :func:`holdfast.recover` and :func:`holdfast.plan_motion`.

    Raises:
        InputError: The angle is out of range, or a direction has length 0.
    """
    return ToolConstraint(
        name="upright",
        normals=np.zeros((0, 3)),
        direction=_normalize_vector(direction, "direction"),
        axis=_normalize_vector(axis, "axis"),
        angle=_check_angle(angle),
        within=_check_tolerance(within),
    )


@check_arguments
def rail(
    direction: ArrayLike, *, frame: Frame = "base", pose: ArrayLike | None = None, within: ArrayLike = CONSTRAINT_TOLERANCE
) -> ToolConstraint:
    """Keep the tool on a straight line with its orientation, as for a drawer; only motion along the line is free.

    Args:
        direction: (3,) direction of the line.
        frame: Frame of the direction: ``base``, or ``tool`` at the start.
        pose: (4, 4) pose on the line, with the orientation to keep, m, world; default: the tool's pose at the start.
        within: (2,) allowed error between two waypoints, m and rad; at the waypoints it is 1e-6.

    Returns:
        Constraint for the argument ``keep`` of :func:`holdfast.recover` and :func:`holdfast.plan_motion`.

    Raises:
        InputError: The direction has length 0, or the pose or frame cannot be read.
    """
    along = _normalize_vector(direction, "direction")
    across = np.linalg.svd(along[None])[2][1:]
    return ToolConstraint(
        name="rail",
        normals=across,
        axis=np.array(_TOOL_Z_AXIS),
        turned=True,
        frame=_check_frame(frame),
        pose=_read_pose(pose),
        within=_check_tolerance(within),
    )


@check_arguments
def plane(
    normal: ArrayLike,
    *,
    angle: float | None = None,
    axis: ArrayLike = _TOOL_Z_AXIS,
    frame: Frame = "base",
    pose: ArrayLike | None = None,
    within: ArrayLike = CONSTRAINT_TOLERANCE,
) -> ToolConstraint:
    """Keep the tool point in a plane, as in wiping a board, and the tool towards it if an angle is given.

    Args:
        normal: (3,) normal vector of the plane, towards the side of the tool.
        angle: Largest angle, rad, from 0 to below pi/2, between the tool's axis and the direction opposite to the normal; None:
            the axis is free.
        axis: (3,) vector in the tool's frame; default: its z axis.
        frame: Frame of the normal: ``base``, or ``tool`` at the start.
        pose: (4, 4) pose or (3,) point in the plane, m, world; default: the tool's pose at the start.
        within: (2,) allowed error between two waypoints, m and rad; at the waypoints it is 1e-6.

    Returns:
        Constraint for the argument ``keep`` of :func:`holdfast.recover` and :func:`holdfast.plan_motion`.

    Raises:
        InputError: The angle is out of range, the normal has length 0, or the pose or frame cannot be read.
    """
    across = _normalize_vector(normal, "normal")
    return ToolConstraint(
        name="plane",
        normals=across[None],
        direction=None if angle is None else -across,
        axis=_normalize_vector(axis, "axis"),
        angle=0.0 if angle is None else _check_angle(angle),
        frame=_check_frame(frame),
        pose=_read_pose(pose),
        within=_check_tolerance(within),
    )


# ---- checked values ------------------------------------------------------------------------------------------------------


def _normalize_vector(value: ArrayLike, argument_name: str) -> FloatArray:
    vector = require_real_numbers(value, argument_name, "three numbers")
    if vector.shape != (3,) or not np.isfinite(vector).all() or np.linalg.norm(vector) < 1e-9:
        raise InputError(f"{argument_name} is {np.asarray(value).tolist()}; it must be three finite numbers, not all of them 0")
    return np.asarray(vector / np.linalg.norm(vector))


def _check_angle(angle: float) -> float:
    if not 0 <= angle < np.pi / 2:
        raise InputError(f"angle is {angle:g} rad; it must be from 0 to below pi/2 (90 deg)")
    return float(angle)


def _check_frame(frame: str) -> Frame:
    if frame not in ("base", "tool"):
        raise InputError(f"frame '{frame}' is not known; use 'base' or 'tool'")
    return frame  # type: ignore[return-value]


def _check_tolerance(within: ArrayLike) -> tuple[float, float]:
    tolerance = require_real_numbers(within, "within", "two numbers, m and rad")
    if tolerance.shape != (2,) or not np.isfinite(tolerance).all() or (tolerance < 1e-5).any() or tolerance[1] >= np.pi / 2:
        raise InputError(f"within is {np.asarray(within).tolist()}; it must be m and rad, each 1e-5 or more, below 90 deg")
    return float(tolerance[0]), float(tolerance[1])


def _read_pose(pose: ArrayLike | None) -> FloatArray | None:
    if pose is None:
        return None
    matrix = require_real_numbers(pose, "pose", "a pose (4, 4)")
    if matrix.shape == (3,):
        pose_matrix = np.eye(4)
        pose_matrix[:3, 3] = matrix
        matrix = pose_matrix
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise InputError(f"pose has shape {matrix.shape}; give (4, 4) finite numbers, m")
    return np.asarray(check_poses(matrix[None])[0])


def _format_vector(vector: FloatArray) -> str:
    return ", ".join(f"{component + 0.0:.4g}" for component in vector)
