"""The standard Denavit-Hartenberg table of any serial arm, from where its joint axes are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.dh import DH
from holdfast.arm.machine import Link, snapped
from holdfast.arm.model import Arm

Array = NDArray[np.float64]

# Axes this near to parallel, rad, count as parallel: where a file says 3.14159 for pi their common normal is kilometres away.
_PARALLEL = 1e-5
_SAME = 1e-9  # lengths, m, and cosines that count as equal


@dataclass(frozen=True, eq=False)
class DHTable:
    """A standard Denavit-Hartenberg table: ``base``, then ``Rz(theta) Tz(d) Tx(a) Rx(alpha)`` for each row, then ``tool``.

    Attributes:
        rows: One :class:`holdfast.DH` per joint, with its limits, in rad and m.
        base: (4, 4) pose of the first row's frame in the world.
        tool: (4, 4) pose of the tool in the last row's frame.
    """

    rows: tuple[DH, ...]
    base: Array
    tool: Array

    def arm(self, **options: Any) -> Arm:
        """The arm of the table; ``options`` (``name``, ``gravity``, ``source``) go to :meth:`holdfast.Arm.from_dh`."""
        return Arm.from_dh(self.rows, base=self.base, tool=self.tool, **options)


def dh_table(arm: Arm) -> DHTable:
    """The standard Denavit-Hartenberg table of an arm, whatever it was read from.

    The joint variables stay what they are: the same q, sign and limits. Masses are not in a table.

    Where the geometry leaves a choice:

    - The first frame is the arm's base if the first axis is its z; else it sits at the first joint, and ``base`` takes up the
      rest.
    - Between skew or crossing axes x lies along the common normal. It points as the x of the joint's own frame does where that
      lies along the normal too, so that an arm made by :meth:`holdfast.Arm.from_dh` gives its own rows back; else so that a is
      positive; and where the axes cross, so that theta is at most a quarter turn.
    - Between parallel axes the normal is the one through the next joint's origin. Along one and the same axis x is that of the
      joint's own frame, or else the one before.
    - A prismatic joint has a direction and no place: its axis is taken through its origin.
    - The last frame is that of the arm's own last row, or the last joint's own frame; ``tool`` takes up the rest.

    Args:
        arm: Any serial arm.

    Returns:
        The table. Its arm has the same forward kinematics to 1e-12, unless two neighbouring axes are parallel but for less
        than 1e-5 rad, as where a URDF file says 3.14159 for pi: their normal is then that of parallel axes, which may move the
        tool by that angle times the length of the arm.

    Source: Denavit and Hartenberg 1955; the choices above are ours.
    """
    seen = arm.with_base(np.eye(4))
    joints, z = seen.frames_at_zero[:-1], seen.axes_at_zero
    p = [t[:3, 3] for t in joints]
    # The x axes that from_dh gave; a URDF joint may have any.
    own = [t[:3, 0] if joint.axis[2] == 1.0 else None for t, joint in zip(joints, arm.joints, strict=True)]

    first = _first(z[0], p[0])
    frames = [first]
    for k in range(arm.n - 1):
        frames.append(_next(frames[-1], p[k], z[k + 1], p[k + 1], own[k]))
    frames.append(_last(arm, frames[-1], joints[-1], z[-1]))
    rows = tuple(_row(arm, k, frames[k], frames[k + 1]) for k in range(arm.n))
    tool = _inverse(frames[-1]) @ joints[-1] @ arm.tool
    return DHTable(rows, arm.base @ first, _clean(tool))


def table_bodies(arm: Arm, table: DHTable) -> tuple[list[Link | None], Link | None]:
    """Express the links and the payload of an arm in the frames of the rows of its table."""
    q = np.zeros(arm.n)
    own, theirs = arm.frames(q), table.arm().frames(q)
    rows = [theirs[k + 1] @ Arm.from_dh([row]).flange for k, row in enumerate(table.rows)]
    moved = [_inverse(row) @ own[k + 1] for k, row in enumerate(rows)]
    links = arm.links or (None,) * arm.n
    found = [None if link is None else link.moved(_clean(pose)) for link, pose in zip(links, moved, strict=True)]
    return found, None if arm.payload is None else arm.payload.moved(_clean(moved[-1]))


def _first(z: Array, p: Array) -> Array:
    if z[2] > 1 - 1e-15 and np.hypot(p[0], p[1]) < _SAME:
        return np.eye(4)
    # The base's x, or its y if the axis points along x, as far as it is across the axis.
    side = np.eye(3)[0 if abs(z[0]) < 0.9 else 1]
    return _frame(side, z, p)


def _next(frame: Array, p: Array, z_next: Array, p_next: Array, own: Array | None) -> Array:
    """The frame on the next axis, after a joint whose frame and point on the axis are given."""
    x, z, between = frame[:3, 0], frame[:3, 2], p_next - p
    normal = np.cross(z, z_next)
    sine = float(np.linalg.norm(normal))
    if sine < _PARALLEL:
        origin = p_next
        across = between - (between @ z) * z
        along = across if np.linalg.norm(across) > _SAME else x if own is None else own
        along = along / np.linalg.norm(along)
    else:
        along = normal / sine
        # Where the next axis comes nearest to this one.
        origin = p_next + (np.cross(between, z) @ normal / sine**2) * z_next
    return _frame(_signed(along, float(between @ along), x, own), z_next, origin)


def _signed(normal: Array, length: float, x: Array, own: Array | None) -> Array:
    """The common normal, pointing the way that :func:`dh_table` says."""
    if own is not None and abs(own @ normal) > 1 - _SAME:
        positive = bool(own @ normal > 0)
    elif abs(length) > _SAME:
        positive = length > 0
    else:
        positive = bool(normal @ x > -_SAME)
    return normal if positive else -normal


def _last(arm: Arm, frame: Array, joint: Array, z: Array) -> Array:
    if arm.joints[-1].axis[2] != 1.0:
        return _frame(frame[:3, 0], z, joint[:3, 3])
    # Of the form Tz(d) Tx(a) Rx(alpha), or no part of the table.
    fits = abs(arm.flange[0, 0] - 1) < _SAME and abs(arm.flange[1, 3]) < _SAME
    return joint @ arm.flange if fits else joint


def _row(arm: Arm, k: int, frame: Array, after: Array) -> DH:
    joint, step = arm.joints[k], after[:3, 3] - frame[:3, 3]
    return DH(
        a=_length(float(step @ after[:3, 0])),
        alpha=_turn(frame[:3, 2], after[:3, 2], after[:3, 0]),
        d=_length(float(step @ frame[:3, 2])),
        theta=_turn(frame[:3, 0], after[:3, 0], frame[:3, 2]),
        type="prismatic" if joint.prismatic else "revolute",
        lower=None if np.isinf(joint.lower) else joint.lower,
        upper=None if np.isinf(joint.upper) else joint.upper,
        name=joint.name,
        velocity=None if np.isinf(joint.velocity) else joint.velocity,
        effort=None if np.isinf(joint.effort) else joint.effort,
        friction=joint.friction,
        armature=joint.armature,
    )


def _frame(x: Array, z: Array, origin: Array) -> Array:
    """The frame with the given z, and with x as far as it is across z."""
    out = np.eye(4)
    across: Array = x - (x @ z) * z
    across /= np.linalg.norm(across)
    out[:3, 0], out[:3, 1], out[:3, 2], out[:3, 3] = across, np.cross(z, across), z, origin
    return out


def _inverse(t: Array) -> Array:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = t[:3, :3].T, -t[:3, :3].T @ t[:3, 3]
    return out


def _turn(a: Array, b: Array, about: Array) -> float:
    """The angle, rad, from a to b about an axis across both; 90 and the like without the noise of rounding."""
    degrees = float(np.rad2deg(np.arctan2(np.cross(a, b) @ about, a @ b)))
    near = round(degrees, 9)
    degrees = near if abs(degrees - near) < 1e-12 else degrees
    return float(np.deg2rad(180.0 if degrees == -180 else degrees)) + 0.0


def _length(value: float) -> float:
    near = round(value, 12) + 0.0  # no -0
    return near if abs(value - near) < 1e-14 else value


def _clean(transform: Array) -> Array:
    out = transform.copy()
    out[:3, :3] = snapped(out[:3, :3])
    out[:3, 3] = [_length(x) for x in out[:3, 3]]
    return out
