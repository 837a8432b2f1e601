"""Arms from URDF files: one chain of a tree of links, everything else folded into it.

Only ``<link>`` (with its ``<inertial>``) and ``<joint>`` are read here; transmissions and simulator tags are skipped, shapes
are read when they are asked for (:mod:`holdfast.shapes`). The only other file that is opened is an SRDF file, for the
configurations that it names.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.machine import Link, Machine
from holdfast.arm.poses import cos_sin
from holdfast.arm.tree import LIMITED, MOVING, Tree, TreeJoint, chain
from holdfast.errors import ArmError
from holdfast.files import reading

Array = NDArray[np.float64]
_LARGEST = 64 << 20  # bytes
TYPES = (*MOVING, "fixed", "floating", "planar")
XACRO_DEFINITIONS = ("property", "arg", "macro")  # what makes nothing by itself, so that a leftover does no harm
XACRO_TERM = re.compile(r"\$[{(]")


@checked
def load(
    path: str | Path,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
    gravity: Sequence[float] | None = None,
    srdf: str | Path | None = None,
    meshes: str | Path | None = None,
) -> Machine:
    """The serial arm from link ``base`` down to link ``tip`` of a URDF file.

    Fixed joints are folded away. Bodies that hang on the chain without being part of it (tools, covers, grippers, whatever
    follows the tip) become part of the link they hang on, with their own joints held still. What hangs on
    the base does not move and is left out.

    ``links[i]`` is given in the URDF frame of the child link of joint i, and ``tool`` is the frame of ``tip``. Angles
    within 1e-9 rad of a quarter turn are taken as exact. A ``velocity`` or ``effort`` of 0, like a missing one, means 'not
    given' (infinite), because many files carry 0 as a placeholder; ``<dynamics damping>`` is the friction. A missing
    ``<inertial>`` gives None in ``links``, unless a body with one hangs on that link; a mass of 0 is kept.

    Args:
        path: The file.
        base: Name of the link on which the arm is mounted; the root if not given.
        tip: Name of the link whose frame is the tool; may be left out if only one link carries nothing, the fingers of a
            gripper left off.
        hold: Value, rad or m, at which joints are held, on the chain or beside it; those on the chain are then no joints of the
            arm. By default all on the chain move, and those beside it are held at 0, or the limit nearest to it. A joint with
            ``<mimic>`` follows its master unless it is named here; one that mimics a held joint is held too.
        name: Name of the arm; the file's robot name if not given.
        gravity: (3,) acceleration, m/s^2, in the frame of ``base``; by default 9.81 m/s^2 down along z of the file's root,
            whatever ``base`` is.
        srdf: File whose ``<group_state>`` become ``states``, those that name every joint of the arm, and whose
            ``<disable_collisions>`` are pairs of links that its shape leaves unchecked; if not given, the file of the same name
            that ends in ``.srdf``, where there is one.
        meshes: Folder in which the files of meshes are looked for before the usual places
            (``package://``, ``ROS_PACKAGE_PATH``), once the shape of the arm is asked for.

    Returns:
        What :meth:`holdfast.Arm.from_urdf` makes an arm of; its ``base`` is the identity, its ``source`` the name of the file.

    Raises:
        ArmError: The file cannot be read, is not a sound URDF tree, or has no single serial chain from base to tip.
    """
    path = Path(path)
    try:
        tree = read_tree(robot_element(path), path.stem)
        arm = chain(tree, base, tip, hold or {}, name or tree.name, gravity, path.name)
        beside = path.with_suffix(".srdf")
        file = beside if srdf is None and beside.is_file() else None if srdf is None else Path(srdf)
        whole, folder, pairs = ("" if x is None else str(Path(x).absolute()) for x in (path, meshes, file))
        arm = replace(arm, chain=arm.chain and replace(arm.chain, file=whole, meshes=folder, srdf=pairs))
        return arm if file is None else replace(arm, states=_states(file, arm))
    except ArmError as error:
        raise ArmError(f"{path.name}: {error}", tip=error.tip) from error


# ---- the file ----------------------------------------------------------------------------------------------------


def robot_element(path: Path) -> ElementTree.Element:
    """The outermost element of a URDF file.

    Raises:
        ArmError: The file cannot be read, or is not a URDF.
    """
    robot = _element(path, "URDF")
    left = next(_unexpanded(robot), None)
    if left is not None:
        raise ArmError(f"the file has xacro macros that are not expanded ({left}); {expand_first(path)}")
    return robot


def expand_first(path: Path) -> str:
    """How a file with xacro macros becomes a URDF file, for a sentence."""
    stem = path.name.partition(".")[0]
    target = f"{stem}.urdf" if path.suffix == ".xacro" else f"{stem}.expanded.urdf"
    return f"expand it first: xacro {path.name} > {target} ('xacro' comes with ROS, or by pip install xacro)"


def _element(path: Path, kind: str) -> ElementTree.Element:
    """The ``<robot>`` of a file; prefixes of tags are left as they are, declared or not, as the readers of ROS do."""
    with reading.guarded(advice=f"give the path of a {kind} file", kind=ArmError):
        content = reading.raw(path, _LARGEST)
    builder, parser = ElementTree.TreeBuilder(), expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = builder.start, builder.end, builder.data
    # The only place where an XML file can define entities that blow up or reach other files.
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.buffer_text = True
    try:
        parser.Parse(content, True)
        robot = builder.close()
    # An unknown encoding in the XML declaration surfaces as LookupError or ValueError.
    except (expat.ExpatError, LookupError, ValueError, AssertionError) as error:
        if isinstance(error, ArmError):
            raise
        raise ArmError(f"this is not valid XML ({error}); give a {kind} file") from error
    if robot.tag != "robot":
        raise ArmError(f"the outermost element is <{robot.tag}>; a {kind} file has <robot>")
    return robot


def _refuse_doctype(*_: object) -> None:
    raise ArmError("the file has a DOCTYPE, which a URDF never needs and which can hide harmful entities; remove it")


def _unexpanded(robot: ElementTree.Element) -> Iterator[str]:
    """Calls of xacro macros and terms that xacro would replace; unused definitions do not count."""
    prefixes = {"xacro"} | {key.partition(":")[2] for key, value in robot.attrib.items() if "xacro" in value}
    waiting = [(robot, False)]
    while waiting:
        element, kept = waiting.pop()
        prefix, colon, local = element.tag.rpartition(":")
        if colon and prefix in prefixes:
            if local not in XACRO_DEFINITIONS:
                yield f"<{element.tag}>"
            continue
        kept = kept or element.tag in ("link", "joint")
        if kept:
            yield from (value for value in element.attrib.values() if XACRO_TERM.search(value))
        waiting += [(child, kept) for child in reversed(element)]


def disabled_pairs(path: Path) -> frozenset[tuple[str, str]]:
    """Pairs of links, each in alphabetical order, between which an SRDF file disables collisions.

    Raises:
        ArmError: The file cannot be read.
    """
    found = (
        sorted(_attribute(x, key, "<disable_collisions>") for key in ("link1", "link2"))
        for x in _element(path, "SRDF").iter("disable_collisions")
    )
    return frozenset((a, b) for a, b in found)


def _states(path: Path, arm: Machine) -> dict[str, Array]:
    """Configurations of an SRDF file that name every joint of the arm."""
    found: dict[str, Array] = {}
    for state in _element(path, "SRDF").iter("group_state"):
        where = f"{path.name}: state '{state.get('name', '')}'"
        values = {joint.get("name"): joint.get("value", "") for joint in state.findall("joint")}
        if all(name in values for name in arm.joint_names) and state.get("name"):
            q = [_numbers(values[name], 1, f"{where}: {name}")[0] for name in arm.joint_names]
            found.setdefault(state.get("name", ""), np.array(q))
    return found


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
    tied = {name for joint in joints.values() if joint.mimic for name in (joint.name, joint.mimic[0])}
    return Tree(robot.get("name") or stem, bodies, joints, tied=frozenset(tied))


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
    return Link(kilograms, np.zeros(3), inertia, name=label).moved(read_origin(inertial, where))


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
            raise ArmError(f"{where}: its limits are reversed, lower {lower:g} is above upper {upper:g}; swap them")
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
