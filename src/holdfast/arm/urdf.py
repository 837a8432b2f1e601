"""Arms from URDF files: one chain of a tree of links, everything else folded into it.

Only ``<link>`` (with its ``<inertial>``) and ``<joint>`` are read; meshes, transmissions and simulator tags are skipped,
so no file other than the URDF itself is ever opened.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from holdfast import reading
from holdfast.arm.model import GRAVITY, Arm, Link
from holdfast.arm.tree import LIMITED, MOVING, Tree, TreeJoint, chain, cos_sin
from holdfast.errors import ArmError

Array = NDArray[np.float64]
_LARGEST = 64 << 20  # bytes
TYPES = (*MOVING, "fixed", "floating", "planar")


def load(
    path: str | Path,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
    gravity: Sequence[float] = GRAVITY,
) -> Arm:
    """The serial arm from link ``base`` down to link ``tip`` of a URDF file.

    Fixed joints are folded away. Bodies that hang on the chain without being part of it (tools, covers, grippers, whatever
    follows the tip) become part of the link they hang on, with their own moving joints standing still. What hangs on
    the base does not move and is left out.

    ``links[i]`` is given in the URDF frame of the child link of joint i, and ``tool`` is the frame of ``tip``. Angles
    within 1e-9 rad of a quarter turn are taken as exact. A ``velocity`` or ``effort`` of 0, like a missing one, means 'not
    given' (infinite), because many files carry 0 as a placeholder; ``<dynamics damping>`` is the friction. A missing
    ``<inertial>`` gives None in ``links``, unless a body with one hangs on that link; a mass of 0 is kept.

    Args:
        path: The file.
        base: Name of the link on which the arm stands; the root if not given.
        tip: Name of the link whose frame is the tool; may be left out if there is only one end.
        hold: Value, rad or m, at which joints beside the chain stand; by default 0, or the limit nearest to it. A joint
            with ``<mimic>`` follows its master unless it is named here.
        name: Name of the arm; the file's robot name if not given.
        gravity: (3,) acceleration, m/s^2, in the frame of ``base``.

    Returns:
        The arm; its ``base`` is the identity, its ``source`` the name of the file.

    Raises:
        ArmError: The file cannot be read, is not a sound URDF tree, or has no single serial chain from base to tip.
    """
    path = Path(path)
    try:
        tree = read_tree(robot_element(path), path.stem)
        return chain(tree, base, tip, hold or {}, name or tree.name, gravity, path.name)
    except ArmError as error:
        raise ArmError(f"{path.name}: {error}") from error


# ---- the file ----------------------------------------------------------------------------------------------------


class _NoEntities(ElementTree.TreeBuilder):
    """Stops at a DOCTYPE, the only place where an XML file can define entities that blow up or reach other files."""

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        raise ArmError("the file has a DOCTYPE, which a URDF never needs and which can hide harmful entities; remove it")


def robot_element(path: Path) -> ElementTree.Element:
    """The outermost element of a URDF file.

    Raises:
        ArmError: The file cannot be read, or is no URDF.
    """
    try:
        content = reading.raw(path, _LARGEST)
    except OSError as error:
        raise ArmError(f"the file cannot be read ({error.strerror}); give the path of a URDF file") from error
    try:
        robot = ElementTree.fromstring(content, ElementTree.XMLParser(target=_NoEntities()))
    # An unknown encoding in the XML declaration surfaces as LookupError or ValueError.
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        if isinstance(error, ArmError):
            raise
        raise ArmError(f"this is not sound XML ({error}); give a URDF file") from error
    if robot.tag != "robot":
        raise ArmError(f"the outermost element is <{robot.tag}>; a URDF file has <robot>")
    if any("/xacro}" in element.tag for element in robot.iter()):
        raise ArmError("the file still has xacro macros; expand it with the xacro tool first")
    return robot


def read_tree(robot: ElementTree.Element, stem: str) -> Tree:
    """Links and joints of a ``<robot>``; ``stem`` is its name if it has none.

    Raises:
        ArmError: It is not a sound tree.
    """
    bodies: dict[str, Link | None] = {}
    for element in robot.findall("link"):
        label = _attribute(element, "name", "a <link>")
        if label in bodies:
            raise ArmError(f"the link name '{label}' is used more than once; names must be unique")
        bodies[label] = _body(element, label)
    joints: dict[str, TreeJoint] = {}
    for element in robot.findall("joint"):
        joint = _joint(element)
        if joint.name in joints:
            raise ArmError(f"the joint name '{joint.name}' is used more than once; names must be unique")
        joints[joint.name] = joint
    return Tree(robot.get("name") or stem, bodies, joints)


def _body(element: ElementTree.Element, label: str) -> Link | None:
    inertial = element.find("inertial")
    if inertial is None:
        return None
    where = f"link '{label}'"
    mass, moments = inertial.find("mass"), inertial.find("inertia")
    if mass is None or moments is None:
        raise ArmError(f"{where}: its <inertial> has no <{'mass' if mass is None else 'inertia'}>; it needs both")
    xx, yy, zz, xy, xz, yz = (
        _numbers(_attribute(moments, key, f"{where}: <inertia>"), 1, f"{where}: {key}")[0]
        for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    )
    kilograms = _numbers(_attribute(mass, "value", f"{where}: <mass>"), 1, f"{where}: mass")[0]
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return Link(kilograms, np.zeros(3), inertia, label).moved(read_origin(inertial, where))


def _joint(element: ElementTree.Element) -> TreeJoint:
    name = _attribute(element, "name", "a <joint>")
    where = f"joint '{name}'"
    kind = _attribute(element, "type", where)
    if kind not in TYPES:
        raise ArmError(f"{where} has type '{kind}'; URDF knows {', '.join(TYPES)}")
    ends = {}
    for role in ("parent", "child"):
        end = element.find(role)
        if end is None:
            raise ArmError(f'{where} has no <{role}>; it needs <{role} link="..."/>')
        ends[role] = _attribute(end, "link", f"{where}: <{role}>")
    axis = np.array([1.0, 0.0, 0.0])  # the default of the format
    stated = element.find("axis")
    if kind in MOVING and stated is not None:
        axis = np.array(_numbers(_attribute(stated, "xyz", f"{where}: <axis>"), 3, f"{where}: axis"))
        if np.linalg.norm(axis) < 1e-9:
            raise ArmError(f"{where} has the axis 0 0 0; give the direction about or along which it moves")
        axis = axis / np.linalg.norm(axis)
    lower, upper, velocity, effort = _limits(element, kind, where)
    dynamics, mimic = element.find("dynamics"), element.find("mimic")
    return TreeJoint(
        name=name,
        type=kind,
        parent=ends["parent"],
        child=ends["child"],
        origin=read_origin(element, where),
        axis=axis,
        lower=lower,
        upper=upper,
        velocity=velocity,
        effort=effort,
        friction=0.0 if dynamics is None else _size(dynamics, "damping", where),
        mimic=None
        if mimic is None
        else (
            _attribute(mimic, "joint", f"{where}: <mimic>"),
            _numbers(mimic.get("multiplier", "1"), 1, f"{where}: multiplier")[0],
            _numbers(mimic.get("offset", "0"), 1, f"{where}: offset")[0],
        ),
    )


def _limits(element: ElementTree.Element, kind: str, where: str) -> tuple[float, float, float, float]:
    """Lower, upper, velocity and effort of a joint; infinite where there is none."""
    limit = element.find("limit")
    if limit is None:
        return -np.inf, np.inf, np.inf, np.inf
    lower, upper = -np.inf, np.inf
    if kind in LIMITED and (limit.get("lower") is not None or limit.get("upper") is not None):
        # The format says that the one left out is 0.
        lower, upper = (_numbers(limit.get(key, "0"), 1, f"{where}: {key}")[0] for key in ("lower", "upper"))
        if lower > upper:
            raise ArmError(f"{where}: its limits are upside down, lower {lower:g} is above upper {upper:g}; swap them")
    return lower, upper, _size(limit, "velocity", where) or np.inf, _size(limit, "effort", where) or np.inf


def _size(element: ElementTree.Element, key: str, where: str) -> float:
    value = _numbers(element.get(key, "0"), 1, f"{where}: {key}")[0]
    if value < 0:
        raise ArmError(f"{where}: {key} is {value:g}; it must be 0 or more")
    return value


def read_origin(element: ElementTree.Element, where: str) -> Array:
    """(4, 4) from the ``<origin xyz rpy>`` of an element; ``where`` is what an error calls it."""
    pose = np.eye(4)
    origin = element.find("origin")
    if origin is None:
        return pose
    pose[:3, 3] = _numbers(origin.get("xyz", "0 0 0"), 3, f"{where}: origin xyz")
    pose[:3, :3] = rpy_rotation(_numbers(origin.get("rpy", "0 0 0"), 3, f"{where}: origin rpy"))
    return pose


def rpy_rotation(rpy: Sequence[float]) -> Array:
    """(3, 3) rotation from roll, pitch, yaw (3,), rad, about the fixed x, y, z axes in turn: ``Rz(yaw) Ry(pitch) Rx(roll)``."""
    (cr, sr), (cp, sp), (cy, sy) = (cos_sin(angle) for angle in rpy)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x)


def _attribute(element: ElementTree.Element, key: str, where: str) -> str:
    value = element.get(key)
    if not value:
        raise ArmError(f"{where} has no attribute '{key}'; the format requires it")
    return value


def _numbers(text: str, count: int, where: str) -> list[float]:
    try:
        values = [float(part) for part in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not np.isfinite(values).all():
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise ArmError(f"{where} is '{text}'; it must be {wanted}")
    return values
