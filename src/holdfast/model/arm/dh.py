"""Build arms from Denavit-Hartenberg tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import ArmError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.model.arm.machine import ArmData, Joint, JointType, Link, check_transform, snap_rounding_noise


@check_constructor
@dataclass(frozen=True)
class DH:
    """One row of a Denavit-Hartenberg table.

    Attributes:
        a: Link length, m.
        alpha: Link twist, rad.
        d: Joint offset, m (added to the joint variable of a prismatic joint).
        theta: Joint angle, rad (added to the joint variable of a revolute joint).
        type: ``revolute`` or ``prismatic``.
        lower, upper: Limits of the joint variable, rad or m; None for no limit.
        name: Name of the joint; default: ``joint1``, ``joint2``, ...
        velocity, effort: Largest speed (rad/s, m/s) and torque or force (N m, N); None if not known.
        friction, armature: Viscous friction (N m s/rad or N s/m) and rotor inertia (kg m^2 or kg).
        coulomb_friction, stiction: Dry friction of the moving and of the resting joint, N m or N; see :class:`holdfast.Joint`.
    """

    a: float
    alpha: float
    d: float = 0.0
    theta: float = 0.0
    type: Literal["revolute", "prismatic"] = "revolute"
    lower: float | None = None
    upper: float | None = None
    name: str | None = None
    velocity: float | None = None
    effort: float | None = None
    friction: float = 0.0
    armature: float = 0.0
    coulomb_friction: float = 0.0
    stiction: float = 0.0


def _rotation_about_x(angle: float) -> FloatArray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return snap_rounding_noise(np.array([[1, 0, 0, 0], [0, cosine, -sine, 0], [0, sine, cosine, 0], [0, 0, 0, 1.0]]))


def _rotation_about_z(angle: float) -> FloatArray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return snap_rounding_noise(np.array([[cosine, -sine, 0, 0], [sine, cosine, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]))


def _translation(x: float, z: float) -> FloatArray:
    pose = np.eye(4)
    pose[0, 3], pose[2, 3] = x, z
    return pose


def build_from_rows(
    rows: Sequence[DH],
    links: Sequence[Link | None] | None,
    convention: str,
    base: ArrayLike | None,
    tool: ArrayLike | None,
    gravity: ArrayLike,
    payload: Link | None,
    name: str,
    source: str,
) -> ArmData:
    """Build the machine data of an arm from DH rows; see :meth:`holdfast.Arm.from_dh`.

    A row is a fixed transform, the joint's own motion about or along z, and another fixed transform. Between two motions the
    fixed transforms are multiplied; a link in the frame of its row moves with the preceding joint.
    """
    if convention not in ("standard", "modified"):
        raise ArmError(f"DH convention '{convention}' is not known; use 'standard' or 'modified'")
    if links is not None and len(links) != len(rows):
        raise ArmError(f"arm '{name}' has {len(rows)} DH rows and {len(links)} links; it needs one link per row")
    joints: list[Joint] = []
    bodies: list[Link | None] = []
    pending = np.eye(4)  # fixed transform since the last joint's moving frame
    row_frame = np.eye(4)  # row frame in the moving frame of its joint
    for row_index, row in enumerate(rows):
        label = row.name or f"joint{row_index + 1}"
        for field in ("a", "alpha", "d", "theta"):
            value = getattr(row, field)
            if not isinstance(value, (int, float, np.floating, np.integer)) or not np.isfinite(value):
                raise ArmError(f"DH row {row_index + 1} ('{label}'): {field} is {value!r}; it must be a finite number")
        if row.type not in ("revolute", "prismatic"):
            raise ArmError(f"DH row {row_index + 1} ('{label}') has type '{row.type}'; use revolute or prismatic")
        sliding = row.type == "prismatic"
        offset = _rotation_about_z(row.theta) @ _translation(0, row.d)  # rotation about z and translation along z commute
        along_x = _rotation_about_x(row.alpha) @ _translation(row.a, 0)
        if convention == "standard":
            # The constant part of the motion along the joint's own axis may be on either side of the motion.
            origin, row_frame = pending @ (_rotation_about_z(row.theta)), _translation(0, row.d) @ along_x
            if sliding:
                origin, row_frame = pending @ offset, along_x
        else:
            origin, row_frame = pending @ along_x @ offset, np.eye(4)
        limited = row.lower is not None or row.upper is not None
        kind: JointType = "prismatic" if sliding else ("revolute" if limited else "continuous")
        joints.append(
            Joint(
                name=label,
                type=kind,
                origin=origin,
                axis=np.array([0.0, 0.0, 1.0]),
                lower=-np.inf if row.lower is None else float(row.lower),
                upper=np.inf if row.upper is None else float(row.upper),
                velocity=np.inf if row.velocity is None else float(row.velocity),
                effort=np.inf if row.effort is None else float(row.effort),
                friction=float(row.friction),
                armature=float(row.armature),
                coulomb_friction=float(row.coulomb_friction),
                stiction=float(row.stiction),
            )
        )
        link = links[row_index] if links is not None else None
        bodies.append(None if link is None else link.in_frame(row_frame))
        pending = row_frame
    tool_frame = row_frame if tool is None else row_frame @ check_transform(tool, f"tool of arm '{name}'")
    return ArmData(
        name=name,
        joints=tuple(joints),
        links=tuple(bodies),
        base=np.eye(4) if base is None else np.asarray(base, dtype=np.float64),
        tool=tool_frame,
        gravity=np.asarray(gravity, dtype=np.float64),
        payload=None if payload is None else payload.in_frame(row_frame),
        source=source,
        flange=row_frame,
    )
