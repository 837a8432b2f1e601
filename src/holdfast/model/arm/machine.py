"""Checked, immutable data of an arm: joints, links, tool, base, gravity, and payload."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, fields
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import ArmError, InputError
from holdfast.core.files.reading import is_unicode
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.model.arm.poses import joint_motion

JointType = Literal["revolute", "continuous", "prismatic"]
GRAVITY = (0.0, 0.0, -9.81)
JOINT_NUMBERS = ("lower", "upper", "velocity", "effort", "friction", "armature")
DRY_FRICTION = ("coulomb_friction", "stiction")
"""Numbers of a joint that are stored only if they are not 0, so that files of earlier versions keep their digests."""
FARTHEST_LIMIT_RAD = 200 * np.pi
FARTHEST_LIMIT_M = 1000.0
_MAX_ABSOLUTE_VALUE = 1e12  # of any number, so that products stay finite
_MAX_PRODUCT_ERRORS = 1e-6 + 1e-5 * np.eye(3)  # of a rotation times its transpose
_LAST_ROW = np.array([0.0, 0.0, 0.0, 1.0])  # of a pose


@check_constructor
@dataclass(frozen=True, eq=False)
class Joint:
    """One degree of freedom: its frame is at ``origin`` in the previous link frame, and it moves about or along ``axis``.

    Attributes:
        name: Name, unique in the arm.
        type: ``revolute``, ``continuous`` (revolute without limits) or ``prismatic``.
        origin: (4, 4) pose of the joint frame at q = 0 in the frame of the previous link (or base).
        axis: (3,) unit vector in the joint frame.
        lower, upper: Position limits, rad or m; infinite if there are none. A limit of more than 100 turns or 1 km becomes
            infinite, because many files use such a number for "no limit".
        velocity: Largest speed, rad/s or m/s; infinite if not given.
        effort: Largest torque or force, N m or N; infinite if not given.
        friction: Viscous friction, N m s/rad or N s/m.
        armature: Rotor inertia at the joint, kg m^2 or kg.
        coulomb_friction: Dry friction of the moving joint, N m or N.
        stiction: Dry friction of the joint at rest, N m or N, at least ``coulomb_friction``; 0 if the same.
    """

    name: str
    type: JointType
    origin: FloatArray
    _: KW_ONLY
    axis: FloatArray
    lower: float = -np.inf
    upper: float = np.inf
    velocity: float = np.inf
    effort: float = np.inf
    friction: float = 0.0
    armature: float = 0.0
    coulomb_friction: float = 0.0
    stiction: float = 0.0

    def __post_init__(self) -> None:
        if self.type not in ("revolute", "continuous", "prismatic"):
            raise ArmError(f"joint '{self.name}' has type '{self.type}'; use revolute, continuous or prismatic")
        if not is_unicode(self.name):
            raise ArmError(f"the joint name {self.name!a} holds half of a surrogate pair; give a name of whole characters")
        object.__setattr__(self, "origin", check_transform(self.origin, f"origin of joint '{self.name}'"))
        axis = _as_float_array(self.axis, f"axis of joint '{self.name}'")
        length = float(np.linalg.norm(axis)) if axis.shape == (3,) and np.abs(axis).max() < _MAX_ABSOLUTE_VALUE else 0.0
        if not (np.isfinite(length) and length > 1e-9):
            raise ArmError(f"axis of joint '{self.name}' is {axis.tolist()}; it must be 3 finite numbers below 1e12, not all 0")
        # An axis that is a unit vector already keeps its bits, so that an arm read back is the same arm.
        object.__setattr__(self, "axis", _as_read_only(snap_rounding_noise(axis if abs(length - 1) < 4e-15 else axis / length)))
        for field_name in (*JOINT_NUMBERS, *DRY_FRICTION):
            value = float(getattr(self, field_name))
            sign = "" if field_name in ("lower", "upper") else " of 0 or more"
            if np.isnan(value) or (value < 0 and field_name not in ("lower", "upper")):
                raise ArmError(f"{field_name} of joint '{self.name}' is {value:g}; it must be a number{sign}")
            if np.isinf(value) and field_name in DRY_FRICTION:
                raise ArmError(f"{field_name} of joint '{self.name}' is infinite; give a finite number, N m or N")
            object.__setattr__(self, field_name, value)
        if 0 < self.stiction < self.coulomb_friction:
            raise ArmError(
                f"stiction of joint '{self.name}' is {self.stiction:g}, below its coulomb_friction {self.coulomb_friction:g}; "
                "give at least that, or 0 for the same"
            )
        farthest = FARTHEST_LIMIT_M if self.prismatic else FARTHEST_LIMIT_RAD
        for field_name in ("lower", "upper"):
            value = getattr(self, field_name)
            if abs(value) > farthest and self.lower <= self.upper:
                object.__setattr__(self, field_name, float(np.copysign(np.inf, value)))
        if self.lower > self.upper:
            raise ArmError(
                f"limits of joint '{self.name}' are reversed: lower {self.lower:g} is above upper {self.upper:g}; swap them"
            )

    @property
    def prismatic(self) -> bool:
        """True for a prismatic joint."""
        return self.type == "prismatic"

    @property
    def static_friction(self) -> float:
        """Largest dry friction of the joint at rest, N m or N."""
        return max(self.stiction, self.coulomb_friction)

    @property
    def unit(self) -> str:
        """Unit of the joint variable: rad or m."""
        return "m" if self.prismatic else "rad"

    @property
    def display_unit(self) -> tuple[float, str]:
        """Factor and unit for printing the joint variable: (1, "m") or (180/pi, "deg")."""
        return (1.0, "m") if self.prismatic else (180 / np.pi, "deg")

    def motion(self, value: float) -> FloatArray:
        """Return the pose (4, 4) of the moving link in the joint's own frame; ``value`` in rad or m."""
        return joint_motion(self.type, self.axis, value)


@check_constructor
@dataclass(frozen=True, eq=False)
class Link:
    """Inertial data of a rigid body.

    Attributes:
        mass: Mass, kg, 0 or more.
        com: (3,) centre of mass in the link's frame, m. For a DH arm this is the frame of its table row (the distal frame in
            the standard convention); for a URDF arm the URDF link frame.
        inertia: (3, 3) inertia about the centre of mass, in the axes of the link's frame, kg m^2.
        name: Name for messages.
    """

    mass: float
    com: FloatArray
    inertia: FloatArray
    _: KW_ONLY
    name: str | None = None

    def __post_init__(self) -> None:
        label = f"link '{self.name}'" if self.name else "link"
        com, inertia = _as_float_array(self.com, f"com of {label}"), _as_float_array(self.inertia, f"inertia of {label}")
        if com.shape != (3,) or inertia.shape != (3, 3):
            raise ArmError(f"{label}: com has shape {com.shape} and inertia {inertia.shape}; they must be (3,) and (3, 3)")
        if not (np.isfinite(self.mass) and np.isfinite(com).all() and np.isfinite(inertia).all()):
            raise ArmError(f"{label}: mass, com and inertia must be finite numbers")
        if self.mass < 0:
            raise ArmError(f"{label}: mass is {self.mass:g} kg; it must be 0 or more")
        if max(self.mass, float(np.abs(com).max()), float(np.abs(inertia).max())) > _MAX_ABSOLUTE_VALUE:
            raise ArmError(f"{label}: a mass, com or inertia is beyond {_MAX_ABSOLUTE_VALUE:g}; give kg, m and kg m^2")
        if not np.allclose(inertia, inertia.T, atol=1e-9 * max(1.0, float(np.abs(inertia).max()))):
            raise ArmError(f"{label}: the inertia matrix is not symmetric")
        object.__setattr__(self, "mass", float(self.mass))
        object.__setattr__(self, "com", _as_read_only(com))
        object.__setattr__(self, "inertia", _as_read_only((inertia + inertia.T) / 2))

    def in_frame(self, transform: ArrayLike) -> Link:
        """Return the same body in another frame: ``transform`` (4, 4) is the pose of the present frame in the new frame, m."""
        pose = np.asarray(transform, dtype=np.float64)
        rotation = pose[:3, :3]
        return Link(self.mass, rotation @ self.com + pose[:3, 3], rotation @ self.inertia @ rotation.T, name=self.name)

    @staticmethod
    def merge(bodies: Sequence[Link], name: str | None = None) -> Link:
        """Return rigidly connected ``bodies``, all in one frame, as one body with a ``name`` (parallel axis theorem)."""
        mass = sum(body.mass for body in bodies)
        if mass <= 0:
            inertia_sum = np.sum([body.inertia for body in bodies], axis=0) if bodies else np.zeros((3, 3))
            return Link(0.0, np.zeros(3), inertia_sum, name=name)
        com = np.sum([body.mass * body.com for body in bodies], axis=0) / mass
        inertia = np.zeros((3, 3))
        for body in bodies:
            offset = body.com - com
            inertia += body.inertia + body.mass * (offset @ offset * np.eye(3) - np.outer(offset, offset))
        return Link(mass, com, inertia, name=name)


@dataclass(frozen=True)
class Chain:
    """Part of a file that defines an arm.

    Attributes:
        base: Link on which the arm is mounted.
        tip: Link whose frame is the tool; None if another tool was set.
        held: Joints of the file that are held, with their values, rad or m.
        file: Path of the file with the shapes of the links; empty if unknown.
        meshes: Folder that is searched first for the meshes of the file; empty for none.
        srdf: SRDF file of the arm; empty for none.
    """

    base: str
    tip: str | None
    held: tuple[tuple[str, float], ...] = ()
    file: str = field(default="", compare=False, repr=False, kw_only=True)
    meshes: str = field(default="", compare=False, repr=False, kw_only=True)
    srdf: str = field(default="", compare=False, repr=False, kw_only=True)

    def __str__(self) -> str:
        tip = [] if self.tip is None else [f"tip '{self.tip}'"]
        return ", ".join([f"base '{self.base}'", *tip, *(f"'{name}' held at {value:g}" for name, value in self.held)])


@dataclass(frozen=True, eq=False)
class ArmData:
    """Geometry, limits, and inertial data of a serial arm.

    Poses are 4x4 arrays in the *world* frame, in which ``base`` is given. Joints are indexed from 0 in Python.

    Attributes:
        name: Name for people and files.
        joints: Joints from base to tip; at least one.
        links: One body per joint, moving with it, each in the joint's moving frame; None if its data are unknown.
        base: (4, 4) pose of the arm's base in the world.
        tool: (4, 4) pose of the tool in the last joint's moving frame. The tool point is its origin, the tool axis its z.
        flange: (4, 4) pose of the last link's own frame in the last joint's moving frame: the last row's frame of a DH table,
            the identity for a URDF file. Tools and payloads are given in it.
        gravity: (3,) gravity acceleration in the world, m/s^2 (downward vector).
        payload: Body held by the end effector, in the last joint's moving frame.
        source: Origin of the description, for reports.
        chain: Links of the file that are base and tip; None for a DH table.
        states: Named configurations (n,), rad and m, such as ``home``.
    """

    name: str
    joints: tuple[Joint, ...]
    links: tuple[Link | None, ...] = ()
    _: KW_ONLY
    base: FloatArray = field(default_factory=lambda: np.eye(4))
    tool: FloatArray = field(default_factory=lambda: np.eye(4))
    gravity: FloatArray = field(default_factory=lambda: np.array(GRAVITY))
    payload: Link | None = None
    source: str = ""
    flange: FloatArray = field(default_factory=lambda: np.eye(4))
    chain: Chain | None = None
    states: Mapping[str, FloatArray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not is_unicode(self.name):
            raise ArmError(f"the arm's name {self.name!a} holds half of a surrogate pair; give a name of whole characters")
        joints = tuple(self.joints)
        if not joints:
            raise ArmError(f"arm '{self.name}' has no joints; it needs at least one")
        names = [joint.name for joint in joints]
        double = sorted({joint_name for joint_name in names if names.count(joint_name) > 1})
        if double:
            raise ArmError(f"arm '{self.name}': the joint name '{double[0]}' is used more than once; names must be unique")
        links = tuple(self.links) or (None,) * len(joints)
        if len(links) != len(joints):
            raise ArmError(f"arm '{self.name}' has {len(joints)} joints and {len(links)} links; it needs one link per joint")
        gravity = _as_float_array(self.gravity, f"gravity of arm '{self.name}'")
        if gravity.shape != (3,) or not np.isfinite(gravity).all():
            raise ArmError(f"arm '{self.name}': gravity must be 3 finite numbers, m/s^2, for example {GRAVITY}")
        object.__setattr__(self, "joints", joints)
        object.__setattr__(self, "links", links)
        object.__setattr__(self, "base", check_transform(self.base, f"base of arm '{self.name}'"))
        object.__setattr__(self, "tool", check_transform(self.tool, f"tool of arm '{self.name}'"))
        object.__setattr__(self, "flange", check_transform(self.flange, f"flange of arm '{self.name}'"))
        object.__setattr__(self, "gravity", _as_read_only(gravity))
        # An arm made by replace() may have other joints than the states.
        states = {
            name: _as_read_only(configuration)
            for name, configuration in self.states.items()
            if np.shape(configuration) == (len(joints),)
        }
        object.__setattr__(self, "states", states)

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.joints)

    @cached_property
    def lower(self) -> FloatArray:
        """Lower limits (n,), rad or m; -inf for no limit."""
        return _as_read_only(np.array([j.lower for j in self.joints]))

    @cached_property
    def upper(self) -> FloatArray:
        """Upper limits (n,), rad or m; inf for no limit."""
        return _as_read_only(np.array([j.upper for j in self.joints]))

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """Joint names from base to tip."""
        return tuple(j.name for j in self.joints)

    @cached_property
    def prismatic(self) -> BoolArray:
        """Array (n,) that is True for prismatic joints."""
        is_prismatic = np.array([j.prismatic for j in self.joints])
        is_prismatic.setflags(write=False)
        return is_prismatic

    def joint_index(self, joint: str | int) -> int:
        """Return the index from 0 of a joint given by name or index from 0.

        Raises:
            InputError: There is no such joint; the message lists all joints.
        """
        if isinstance(joint, (int, np.integer)) and not isinstance(joint, bool):
            if 0 <= joint < self.n:
                return int(joint)
            raise InputError(f"joint index {joint} is out of range; '{self.name}' has joints 0 to {self.n - 1}")
        if isinstance(joint, str) and joint in self.joint_names:
            return self.joint_names.index(joint)
        raise InputError(f"'{self.name}' has no joint '{joint}'; its joints are {', '.join(self.joint_names)}")

    def joint_indices(self, joints: Iterable[str | int]) -> tuple[int, ...]:
        """Return the sorted indices from 0 of joints given by name or index from 0; see :meth:`joint_index`."""
        return tuple(sorted(self.joint_index(joint) for joint in joints))

    @cached_property
    def frames_at_zero(self) -> FloatArray:
        """World poses (n + 1, 4, 4) of the joint frames and of the tool with all joints at 0."""
        frames, pose = [], self.base
        for joint in self.joints:
            pose = pose @ joint.origin
            frames.append(pose)
        return _as_read_only(np.array([*frames, pose @ self.tool]))

    @cached_property
    def axes_at_zero(self) -> FloatArray:
        """World unit vectors (n, 3) of the joint axes with all joints at 0."""
        return _as_read_only(np.array([t[:3, :3] @ j.axis for t, j in zip(self.frames_at_zero, self.joints, strict=False)]))

    @cached_property
    def length_unit(self) -> float:
        """Length scale of the arm, m: the sum of its link lengths and the tool, rounded to a power of two; 1 m without lengths.

        Errors are divided by it before they are compared with a threshold. Division by a power of two has no rounding error, so
        copies of an arm whose sizes differ by a power of two give the same bits.
        """
        size = self.end_to_end
        return float(2.0 ** np.round(np.log2(size))) if size > 0 else 1.0

    @property
    def end_to_end(self) -> float:
        """Upper bound of the distance from the first joint to the tool, m.

        It sums link lengths after the first joint, the tool, and the limited travel of prismatic joints.
        """
        size = sum(float(np.linalg.norm(joint.origin[:3, 3])) for joint in self.joints[1:])
        size += float(np.linalg.norm(self.tool[:3, 3]))
        travels = [max(abs(j.lower), abs(j.upper)) for j in self.joints if j.prismatic]
        return size + sum(x for x in travels if np.isfinite(x))

    @property
    def down(self) -> FloatArray:
        """Unit vector (3,) along gravity in the world; minus z without gravity."""
        norm = float(np.linalg.norm(self.gravity))
        return self.gravity / norm if norm > 0 else np.array([0.0, 0.0, -1.0])

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of the numbers that define the arm, without its name and source; equal arms have equal fingerprints."""
        data: dict[str, Any] = {
            "joints": [
                [j.name, j.type, j.origin.tolist(), j.axis.tolist(), *(getattr(j, key) for key in JOINT_NUMBERS)]
                for j in self.joints
            ],
            "links": [body and [body.mass, body.com.tolist(), body.inertia.tolist()] for body in (*self.links, self.payload)],
            "frames": [self.base.tolist(), self.tool.tolist(), self.gravity.tolist(), self.flange.tolist()],
        }
        dry_friction = [[getattr(j, key) for key in DRY_FRICTION] for j in self.joints]
        if np.any(dry_friction):
            data["dry friction"] = dry_friction
        return hashlib.sha256(json.dumps(data).encode()).hexdigest()

    def check_configurations(self, q: ArrayLike) -> FloatArray:
        """Return ``q`` as float64, ``(n,)`` or ``(N, n)``.

        Raises:
            InputError: The number of joint values is wrong, or they are not numbers.
        """
        array = require_real_numbers(q, f"q for '{self.name}'", f"numbers, {self.n} per configuration")
        if array.ndim > 2:
            raise InputError(f"q for '{self.name}' has the shape {array.shape}; it must be ({self.n},) or (N, {self.n})")
        if array.ndim == 0 or array.shape[-1] != self.n:
            value_count = array.shape[-1] if array.ndim else 0
            raise InputError(
                f"q for '{self.name}' has {value_count} values per configuration; it must have {self.n}, one per joint"
            )
        return array

    def __getstate__(self) -> dict[str, Any]:
        """Return only the fields, because compiled kernels cannot be sent to another process."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}, {self.n} joints)"


def _as_read_only(a: FloatArray) -> FloatArray:
    copied = np.array(a, dtype=np.float64)
    copied.setflags(write=False)
    return copied


def _as_float_array(value: ArrayLike, label: str) -> FloatArray:
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArmError(f"{label} must be numbers in an array of the right shape") from error


def snap_rounding_noise(a: FloatArray) -> FloatArray:
    """Replace rounding noise such as cos(pi/2) by exactly 0, 1, or -1, so that symbolic products vanish."""
    exact = a.copy()
    for value in (-1.0, 0.0, 1.0):
        exact[np.abs(exact - value) < 1e-15] = value
    return exact


def check_transform(value: ArrayLike, label: str) -> FloatArray:
    """Return a checked pose (4, 4) from a caller; ``label`` is its name in error messages."""
    pose = _as_float_array(value, label)
    if pose.shape != (4, 4) or not np.isfinite(pose).all():
        raise ArmError(f"{label} must be a 4x4 array of finite numbers, got shape {pose.shape}")
    if np.abs(pose).max() > _MAX_ABSOLUTE_VALUE:
        raise ArmError(f"{label} is beyond {_MAX_ABSOLUTE_VALUE:g} m; give lengths in metres")
    rotation = pose[:3, :3]
    if (np.abs(rotation @ rotation.T - np.eye(3)) > _MAX_PRODUCT_ERRORS).any() or np.linalg.det(rotation) < 0:
        raise ArmError(f"{label}: its upper left 3x3 block is not a rotation (orthonormal, determinant +1)")
    if (np.abs(pose[3] - _LAST_ROW) > 1e-8 + 1e-5 * _LAST_ROW).any():
        raise ArmError(f"{label}: its last row is {pose[3].tolist()}; it must be 0, 0, 0, 1")
    exact = pose.copy()
    exact[:3, :3] = snap_rounding_noise(rotation)
    return _as_read_only(exact)
