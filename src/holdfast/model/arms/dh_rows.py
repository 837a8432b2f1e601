"""Derive the standard Denavit-Hartenberg table of any serial arm from its joint axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.dh import DH
from holdfast.model.arm.machine import Link, snap_rounding_noise
from holdfast.model.arm.model import Arm

# Axes whose angle is smaller than this, rad, count as parallel: with 3.14159 for pi their common normal is kilometres away.
_PARALLEL_SINE = 1e-5
_EQUALITY_TOLERANCE = 1e-9  # lengths, m, and cosines that differ by less are equal


@dataclass(frozen=True, eq=False)
class DHTable:
    """Standard Denavit-Hartenberg table: ``base``, then ``Rz(theta) Tz(d) Tx(a) Rx(alpha)`` for each row, then ``tool``.

    Attributes:
        rows: One :class:`holdfast.DH` per joint, with its limits, in rad and m.
        base: (4, 4) pose of the first row's frame in the world, m.
        tool: (4, 4) pose of the tool in the last row's frame, m.
    """

    rows: tuple[DH, ...]
    base: FloatArray
    tool: FloatArray

    def arm(self, **options: Any) -> Arm:
        """Return the arm of the table; ``options`` (``name``, ``gravity``, ``source``) go to :meth:`holdfast.Arm.from_dh`."""
        return Arm.from_dh(self.rows, base=self.base, tool=self.tool, **options)


def dh_table(arm: Arm) -> DHTable:
    """Return the standard Denavit-Hartenberg table of any serial arm.

    The joint variables are unchanged: q has the same zero, sign and limits. A table contains no masses.

    If the geometry leaves a choice:

    - The first frame is the arm's base if the first axis is its z; else it is at the first joint, and ``base`` contains the
      rest.
    - Between skew or intersecting axes x lies along the common normal. It has the sign of the x axis of the joint's own frame
      if that is along the normal, so that an arm made by :meth:`holdfast.Arm.from_dh` returns its own rows; else the sign that
      makes a positive; and for intersecting axes the sign that makes theta at most a quarter turn.
    - Between parallel axes the normal passes through the next joint's origin. For coincident axes x is that of the joint's own
      frame, or else the previous x.
    - A prismatic joint has a direction and no position, so its axis passes through its origin.
    - The last frame is that of the arm's own last row, or the last joint's own frame; ``tool`` contains the rest.

    Args:
        arm: Serial arm.

    Returns:
        The table. Its arm has the same forward kinematics to 1e-12, unless two neighbouring axes are almost parallel, within
        1e-5 rad, for example because a URDF file has 3.14159 for pi. Their normal is then that of parallel axes, which may move
        the tool by that angle times the length of the arm.

    Source: Denavit and Hartenberg 1955; the choices above are ours.
    """
    arm_at_origin = arm.with_base(np.eye(4))
    joints, axes = arm_at_origin.frames_at_zero[:-1], arm_at_origin.axes_at_zero
    points = [joint_frame[:3, 3] for joint_frame in joints]
    # The x axes of from_dh; a URDF joint may have any.
    own_x_axes = [frame[:3, 0] if joint.axis[2] == 1.0 else None for frame, joint in zip(joints, arm.joints, strict=True)]

    first_frame = _first_frame(axes[0], points[0])
    frames = [first_frame]
    for index in range(arm.n - 1):
        frames.append(_next_frame(frames[-1], points[index], axes[index + 1], points[index + 1], own_x_axes[index]))
    frames.append(_last_frame(arm, frames[-1], joints[-1], axes[-1]))
    rows = tuple(_dh_row_between(arm, index, frames[index], frames[index + 1]) for index in range(arm.n))
    tool = _invert_pose(frames[-1]) @ joints[-1] @ arm.tool
    return DHTable(rows, arm.base @ first_frame, _snap_pose(tool))


def bodies_in_row_frames(arm: Arm, table: DHTable) -> tuple[list[Link | None], Link | None]:
    """Express the links and the payload of an arm in the frames of the rows of its table."""
    q = np.zeros(arm.n)
    link_frames, row_motions = arm.frames(q), table.arm().frames(q)
    row_frames = [row_motions[index + 1] @ Arm.from_dh([row]).flange for index, row in enumerate(table.rows)]
    link_poses = [_invert_pose(row) @ link_frames[index + 1] for index, row in enumerate(row_frames)]
    links = arm.links or (None,) * arm.n
    row_links = [link and link.in_frame(_snap_pose(pose)) for link, pose in zip(links, link_poses, strict=True)]
    return row_links, None if arm.payload is None else arm.payload.in_frame(_snap_pose(link_poses[-1]))


def _first_frame(z: FloatArray, p: FloatArray) -> FloatArray:
    if z[2] > 1 - 1e-15 and np.hypot(p[0], p[1]) < _EQUALITY_TOLERANCE:
        return np.eye(4)
    # The component, perpendicular to the axis, of the base's x, or of its y if the axis is along x.
    reference_axis = np.eye(3)[0 if abs(z[0]) < 0.9 else 1]
    return _frame_from_axes(reference_axis, z, p)


def _next_frame(
    frame: FloatArray, p: FloatArray, z_next: FloatArray, p_next: FloatArray, own_x_axis: FloatArray | None
) -> FloatArray:
    """Return the frame on the next axis, after a joint with the given frame and a point on the axis."""
    x, z, displacement = frame[:3, 0], frame[:3, 2], p_next - p
    normal = np.cross(z, z_next)
    sine_of_twist = float(np.linalg.norm(normal))
    if sine_of_twist < _PARALLEL_SINE:
        origin = p_next
        perpendicular = displacement - (displacement @ z) * z
        x_axis = (
            perpendicular if np.linalg.norm(perpendicular) > _EQUALITY_TOLERANCE else x if own_x_axis is None else own_x_axis
        )
        x_axis = x_axis / np.linalg.norm(x_axis)
    else:
        x_axis = normal / sine_of_twist
        # The point of the next axis that is closest to this one.
        origin = p_next + (np.cross(displacement, z) @ normal / sine_of_twist**2) * z_next
    return _frame_from_axes(_orient_normal(x_axis, float(displacement @ x_axis), x, own_x_axis), z_next, origin)


def _orient_normal(normal: FloatArray, signed_length: float, x: FloatArray, own_x_axis: FloatArray | None) -> FloatArray:
    """Return the common normal with the sign that :func:`dh_table` defines."""
    if own_x_axis is not None and abs(own_x_axis @ normal) > 1 - _EQUALITY_TOLERANCE:
        keeps_sign = bool(own_x_axis @ normal > 0)
    elif abs(signed_length) > _EQUALITY_TOLERANCE:
        keeps_sign = signed_length > 0
    else:
        keeps_sign = bool(normal @ x > -_EQUALITY_TOLERANCE)
    return normal if keeps_sign else -normal


def _last_frame(arm: Arm, frame: FloatArray, joint: FloatArray, z: FloatArray) -> FloatArray:
    if arm.joints[-1].axis[2] != 1.0:
        return _frame_from_axes(frame[:3, 0], z, joint[:3, 3])
    # Either of the form Tz(d) Tx(a) Rx(alpha), or not part of the table.
    has_row_form = abs(arm.flange[0, 0] - 1) < _EQUALITY_TOLERANCE and abs(arm.flange[1, 3]) < _EQUALITY_TOLERANCE
    return joint @ arm.flange if has_row_form else joint


def _dh_row_between(arm: Arm, k: int, frame: FloatArray, next_frame: FloatArray) -> DH:
    joint, displacement = arm.joints[k], next_frame[:3, 3] - frame[:3, 3]
    return DH(
        a=_snap_length(float(displacement @ next_frame[:3, 0])),
        alpha=_signed_angle(frame[:3, 2], next_frame[:3, 2], next_frame[:3, 0]),
        d=_snap_length(float(displacement @ frame[:3, 2])),
        theta=_signed_angle(frame[:3, 0], next_frame[:3, 0], frame[:3, 2]),
        type="prismatic" if joint.prismatic else "revolute",
        lower=None if np.isinf(joint.lower) else joint.lower,
        upper=None if np.isinf(joint.upper) else joint.upper,
        name=joint.name,
        velocity=None if np.isinf(joint.velocity) else joint.velocity,
        effort=None if np.isinf(joint.effort) else joint.effort,
        friction=joint.friction,
        armature=joint.armature,
        coulomb_friction=joint.coulomb_friction,
        stiction=joint.stiction,
    )


def _frame_from_axes(x: FloatArray, z: FloatArray, origin: FloatArray) -> FloatArray:
    """Return the frame with the given z axis and with the component of x perpendicular to z."""
    frame = np.eye(4)
    x_axis: FloatArray = x - (x @ z) * z
    x_axis /= np.linalg.norm(x_axis)
    frame[:3, 0], frame[:3, 1], frame[:3, 2], frame[:3, 3] = x_axis, np.cross(z, x_axis), z, origin
    return frame


def _invert_pose(pose: FloatArray) -> FloatArray:
    inverse = np.eye(4)
    inverse[:3, :3], inverse[:3, 3] = pose[:3, :3].T, -pose[:3, :3].T @ pose[:3, 3]
    return inverse


def _signed_angle(a: FloatArray, b: FloatArray, axis: FloatArray) -> float:
    """Return the angle, rad, from a to b about an axis perpendicular to both; multiples of 90 degrees are exact."""
    degrees = float(np.rad2deg(np.arctan2(np.cross(a, b) @ axis, a @ b)))
    rounded = round(degrees, 9)
    degrees = rounded if abs(degrees - rounded) < 1e-12 else degrees
    return float(np.deg2rad(180.0 if degrees == -180 else degrees)) + 0.0


def _snap_length(value: float) -> float:
    rounded = round(value, 12) + 0.0  # no -0
    return rounded if abs(value - rounded) < 1e-14 else value


def _snap_pose(transform: FloatArray) -> FloatArray:
    clean = transform.copy()
    clean[:3, :3] = snap_rounding_noise(clean[:3, :3])
    clean[:3, 3] = [_snap_length(coordinate) for coordinate in clean[:3, 3]]
    return clean
