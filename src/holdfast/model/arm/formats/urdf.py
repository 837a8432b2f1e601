"""Read arms from URDF files: one chain of a tree of links, with all other bodies merged into its links.

Only ``<link>`` (with its ``<inertial>``) and ``<joint>`` are read here. Transmissions and simulator tags are skipped, and
shapes are read on request (:mod:`holdfast.model.shapes`). The only other file that is opened is an SRDF file, for its named
configurations.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.files import reading
from holdfast.core.formatting import list_names
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.formats.tree import LIMITED_TYPES, MOVING_TYPES, LinkTree, TreeJoint, build_chain
from holdfast.model.arm.machine import ArmData, Link
from holdfast.model.arm.poses import cos_sin

_MAX_FILE_BYTES = 64 << 20  # bytes
JOINT_TYPES = (*MOVING_TYPES, "fixed", "floating", "planar")
XACRO_DEFINITIONS = ("property", "arg", "macro")  # elements that create nothing by themselves, so that leftovers have no effect
XACRO_TERM = re.compile(r"\$[{(]")


@check_arguments
def load_urdf(
    path: str | Path,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
    gravity: Sequence[float] | None = None,
    srdf: str | Path | None = None,
    meshes: str | Path | None = None,
    group: str | None = None,
    label: str | None = None,
) -> ArmData:
    """Return the serial arm from link ``base`` down to link ``tip`` of a URDF file.

    Fixed joints are merged. Bodies that are attached to the chain without being part of it (tools, covers, grippers, links
    after the tip) become part of the link to which they are attached, with their own joints held. Bodies attached to the base
    do not move and are left out.

    ``links[i]`` is given in the URDF frame of the child link of joint i, and ``tool`` is the frame of ``tip``. Angles within
    1e-9 rad of a quarter turn count as exact. A ``velocity`` or ``effort`` of 0, like a missing one, means 'not given'
    (infinite), because many files use 0 as a placeholder. ``<dynamics damping>`` is the viscous friction, and ``<dynamics
    friction>`` the Coulomb friction. A missing ``<inertial>`` gives None in ``links``, unless a body with one is attached to
    that link; a mass of 0 is kept.

    Args:
        path: URDF file.
        base: Name of the link on which the arm is mounted; default: the root.
        tip: Name of the link whose frame is the tool; optional if only one link, apart from the fingers of a gripper, has no
            descendants.
        hold: Values, rad or m, of joints that are held, on the chain or next to it; held joints on the chain are no joints of
            the arm. By default all joints on the chain move, and those next to it are held at 0, or the limit nearest to it. A
            joint with ``<mimic>`` follows its master unless it is named here; a joint that mimics a held joint is held too.
        name: Name of the arm; default: the robot name in the file.
        gravity: (3,) acceleration, m/s^2, in the frame of ``base``; default: 9.81 m/s^2 down along z of the file's root, for
            any ``base``.
        srdf: SRDF file. Its ``<group_state>`` that name every joint of the arm become ``states``, and its
            ``<disable_collisions>`` are pairs of links that the collision model does not check. Default: the file of the same
            name that ends in ``.srdf``, if it exists.
        meshes: Folder that is searched for mesh files before the usual locations (``package://``, ``ROS_PACKAGE_PATH``), once
            the shape of the arm is requested.
        group: Group of the SRDF file whose ``<chain>`` gives base and tip, unless they are given here.
        label: Name of the source in error messages and reports; default: the name of the file.

    Returns:
        Data for :meth:`holdfast.Arm.from_urdf`; ``base`` is the identity, ``source`` the name of the file.

    Raises:
        ArmError: The file cannot be read, is not a sound URDF tree, or has no single serial chain from base to tip.
    """
    path = Path(path)
    label = label or path.name
    default_srdf = path.with_suffix(".srdf")
    srdf_file = default_srdf if srdf is None and reading.path_exists(default_srdf) else None if srdf is None else Path(srdf)
    try:
        if group is not None:
            group_base, group_tip = _read_group(srdf_file, group)
            base, tip = base or group_base, tip or group_tip
        tree = read_tree(robot_element(path), path.stem)
        arm = build_chain(tree, base, tip, hold or {}, name or tree.name, gravity, label)
        urdf_path, mesh_folder, srdf_path = (
            "" if given_path is None else str(Path(given_path).absolute()) for given_path in (path, meshes, srdf_file)
        )
        arm = replace(arm, chain=arm.chain and replace(arm.chain, file=urdf_path, meshes=mesh_folder, srdf=srdf_path))
        return arm if srdf_file is None else replace(arm, states=_read_srdf_configurations(srdf_file, arm))
    except ArmError as error:
        raise ArmError(f"{label}: {error}", tip=error.tip) from error


# ---- the file ----------------------------------------------------------------------------------------------------


def robot_element(path: Path) -> ElementTree.Element:
    """Return the outermost element of a URDF file.

    Raises:
        ArmError: The file cannot be read, or is not a URDF.
    """
    robot = _parse_robot(path, "URDF")
    leftover = next(_find_xacro(robot), None)
    if leftover is not None:
        raise ArmError(f"the file has xacro macros that are not expanded ({leftover}); {xacro_advice(path)}")
    return robot


def xacro_advice(path: Path) -> str:
    """Return advice on how to turn a file with xacro macros into a URDF file, for an error message."""
    stem = path.name.partition(".")[0]
    target = f"{stem}.urdf" if path.suffix == ".xacro" else f"{stem}.expanded.urdf"
    return f"expand it first: xacro {path.name} > {target} ('xacro' comes with ROS, or by pip install xacro)"


def _parse_robot(path: Path, kind: str) -> ElementTree.Element:
    """Return the ``<robot>`` of a file; prefixes of tags stay unchanged, declared or not, as in the readers of ROS."""
    with reading.guard_reading(advice=f"give the path of a {kind} file", error_type=ArmError):
        content = reading.read_bytes(path, _MAX_FILE_BYTES)
    builder, parser = ElementTree.TreeBuilder(), expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = builder.start, builder.end, builder.data
    # Only here can an XML file define entities that expand without limit or read other files.
    parser.StartDoctypeDeclHandler = _reject_doctype
    parser.buffer_text = True
    try:
        parser.Parse(content.lstrip(), True)
        robot = builder.close()
    # An unknown encoding in the XML declaration surfaces as LookupError or ValueError.
    except (expat.ExpatError, LookupError, ValueError, AssertionError) as error:
        if isinstance(error, ArmError):
            raise
        raise ArmError(f"this is not valid XML ({error}); correct it there, or give another {kind} file") from error
    if robot.tag != "robot":
        raise ArmError(f"the outermost element is <{robot.tag}>; a {kind} file has <robot>")
    return robot


def _reject_doctype(*_: object) -> None:
    raise ArmError("the file has a DOCTYPE, which a URDF never needs and which can hide harmful entities; remove it")


def _find_xacro(robot: ElementTree.Element) -> Iterator[str]:
    """Yield calls of xacro macros and terms that xacro would replace; unused definitions do not count."""
    prefixes = {"xacro"} | {key.partition(":")[2] for key, value in robot.attrib.items() if "xacro" in value}
    pending = [(robot, False)]
    while pending:
        element, is_robot_part = pending.pop()
        prefix, colon, local_name = element.tag.rpartition(":")
        if colon and prefix in prefixes:
            if local_name not in XACRO_DEFINITIONS:
                yield f"<{element.tag}>"
            continue
        is_robot_part = is_robot_part or element.tag in ("link", "joint")
        if is_robot_part:
            # A file name does not change the mechanics; the reader of shapes reports it.
            yield from (value for key, value in element.attrib.items() if key != "filename" and XACRO_TERM.search(value))
        pending += [(child, is_robot_part) for child in reversed(element)]


def read_disabled_pairs(path: Path) -> frozenset[tuple[str, str]]:
    """Return the pairs of links, each in alphabetical order, between which an SRDF file disables collisions.

    Raises:
        ArmError: The file cannot be read.
    """
    pairs = (
        sorted(_require_attribute(element, key, "<disable_collisions>") for key in ("link1", "link2"))
        for element in _parse_robot(path, "SRDF").iter("disable_collisions")
    )
    return frozenset((first_link, second_link) for first_link, second_link in pairs)


def _read_group(path: Path | None, group: str) -> tuple[str, str]:
    """Return the base and tip of the chain of a group of an SRDF file."""
    if path is None:
        raise ArmError(f"group '{group}' stands in an SRDF file, and there is none beside the URDF file; name it with srdf")
    groups = {each.get("name", ""): each for each in _parse_robot(path, "SRDF").findall("group")}
    if group not in groups:
        raise ArmError(f"{path.name}: there is no group '{group}'; its groups are {list_names(list(groups)) or 'none'}")
    chain = groups[group].find("chain")
    if chain is None:
        raise ArmError(f"{path.name}: group '{group}' is a list of joints or links and has no <chain>; name base and tip")
    return _require_attribute(chain, "base_link", "<chain>"), _require_attribute(chain, "tip_link", "<chain>")


def _read_srdf_configurations(path: Path, arm: ArmData) -> dict[str, FloatArray]:
    """Return the configurations of an SRDF file that name every joint of the arm."""
    configurations: dict[str, FloatArray] = {}
    for state in _parse_robot(path, "SRDF").iter("group_state"):
        label = f"{path.name}: state '{state.get('name', '')}'"
        values = {joint.get("name"): joint.get("value", "") for joint in state.findall("joint")}
        if all(name in values for name in arm.joint_names) and state.get("name"):
            q = [_parse_numbers(values[name], 1, f"{label}: {name}")[0] for name in arm.joint_names]
            configurations.setdefault(state.get("name", ""), np.array(q))
    return configurations


def read_tree(robot: ElementTree.Element, default_name: str) -> LinkTree:
    """Return the links and joints of a ``<robot>``; ``default_name`` is its name if it has none.

    Raises:
        ArmError: The links and joints do not form a valid tree.
    """
    bodies: dict[str, Link | None] = {}
    for element in robot.findall("link"):
        label = _require_attribute(element, "name", "a <link>")
        if label in bodies:
            raise ArmError(f"the link name '{label}' is used more than once; names must be unique")
        bodies[label] = _read_body(element, label)
    joints: dict[str, TreeJoint] = {}
    for element in robot.findall("joint"):
        joint = _read_joint(element)
        if joint.name in joints:
            raise ArmError(f"the joint name '{joint.name}' is used more than once; names must be unique")
        joints[joint.name] = joint
    tied = {name for joint in joints.values() if joint.mimic for name in (joint.name, joint.mimic[0])}
    return LinkTree(robot.get("name") or default_name, bodies, joints, tied=frozenset(tied))


def _read_body(element: ElementTree.Element, label: str) -> Link | None:
    inertial = element.find("inertial")
    if inertial is None:
        return None
    link_label = f"link '{label}'"
    mass, moments = inertial.find("mass"), inertial.find("inertia")
    if mass is None or moments is None:
        raise ArmError(f"{link_label}: its <inertial> has no <{'mass' if mass is None else 'inertia'}>; it needs both")
    xx, yy, zz, xy, xz, yz = (
        _parse_numbers(_require_attribute(moments, key, f"{link_label}: <inertia>"), 1, f"{link_label}: {key}")[0]
        for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    )
    kilograms = _parse_numbers(_require_attribute(mass, "value", f"{link_label}: <mass>"), 1, f"{link_label}: mass")[0]
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return Link(kilograms, np.zeros(3), inertia, name=label).in_frame(read_origin(inertial, link_label))


def _read_joint(element: ElementTree.Element) -> TreeJoint:
    name = _require_attribute(element, "name", "a <joint>")
    label = f"joint '{name}'"
    joint_type = _require_attribute(element, "type", label)
    if joint_type not in JOINT_TYPES:
        raise ArmError(f"{label} has type '{joint_type}'; URDF knows {', '.join(JOINT_TYPES)}")
    link_names = {}
    for role in ("parent", "child"):
        end_element = element.find(role)
        if end_element is None:
            raise ArmError(f'{label} has no <{role}>; it needs <{role} link="..."/>')
        link_names[role] = _require_attribute(end_element, "link", f"{label}: <{role}>")
    axis = np.array([1.0, 0.0, 0.0])  # default of the format
    axis_element = element.find("axis")
    if joint_type in MOVING_TYPES and axis_element is not None:
        axis = np.array(_parse_numbers(_require_attribute(axis_element, "xyz", f"{label}: <axis>"), 3, f"{label}: axis"))
        if np.linalg.norm(axis) < 1e-9:
            raise ArmError(f"{label} has the axis 0 0 0; give the direction about or along which it moves")
        axis = axis / np.linalg.norm(axis)
    lower, upper, velocity, effort = _read_limits(element, joint_type, label)
    dynamics, mimic = element.find("dynamics"), element.find("mimic")
    return TreeJoint(
        name=name,
        type=joint_type,
        parent=link_names["parent"],
        child=link_names["child"],
        origin=read_origin(element, label),
        axis=axis,
        lower=lower,
        upper=upper,
        velocity=velocity,
        effort=effort,
        friction=0.0 if dynamics is None else _read_nonnegative(dynamics, "damping", label),
        coulomb_friction=0.0 if dynamics is None else _read_nonnegative(dynamics, "friction", label),
        mimic=None
        if mimic is None
        else (
            _require_attribute(mimic, "joint", f"{label}: <mimic>"),
            _parse_numbers(mimic.get("multiplier", "1"), 1, f"{label}: multiplier")[0],
            _parse_numbers(mimic.get("offset", "0"), 1, f"{label}: offset")[0],
        ),
    )


def _read_limits(element: ElementTree.Element, joint_type: str, label: str) -> tuple[float, float, float, float]:
    """Return lower limit, upper limit, velocity, and effort of a joint; infinite if not given."""
    limit = element.find("limit")
    if limit is None:
        return -np.inf, np.inf, np.inf, np.inf
    lower, upper = -np.inf, np.inf
    if joint_type in LIMITED_TYPES and (limit.get("lower") is not None or limit.get("upper") is not None):
        # According to the format a missing limit is 0.
        lower, upper = (_parse_numbers(limit.get(key, "0"), 1, f"{label}: {key}")[0] for key in ("lower", "upper"))
    velocity, effort = (_read_nonnegative(limit, key, label) or np.inf for key in ("velocity", "effort"))
    return lower, upper, velocity, effort


def _read_nonnegative(element: ElementTree.Element, key: str, label: str) -> float:
    value = _parse_numbers(element.get(key, "0"), 1, f"{label}: {key}")[0]
    if value < 0:
        raise ArmError(f"{label}: {key} is {value:g}; it must be 0 or more")
    return value


def read_origin(element: ElementTree.Element, label: str) -> FloatArray:
    """Return the pose (4, 4) of the ``<origin xyz rpy>`` of an element; ``label`` is its name in error messages."""
    pose = np.eye(4)
    origin = element.find("origin")
    if origin is None:
        return pose
    pose[:3, 3] = _parse_numbers(origin.get("xyz", "0 0 0"), 3, f"{label}: origin xyz")
    pose[:3, :3] = rpy_rotation(_parse_numbers(origin.get("rpy", "0 0 0"), 3, f"{label}: origin rpy"))
    return pose


def rpy_rotation(rpy: Sequence[float]) -> FloatArray:
    """Return the rotation (3, 3) from roll, pitch, yaw (3,), rad, about fixed x, y, z axes: ``Rz(yaw) Ry(pitch) Rx(roll)``."""
    (cos_roll, sin_roll), (cos_pitch, sin_pitch), (cos_yaw, sin_yaw) = (cos_sin(angle) for angle in rpy)
    about_x = np.array([[1, 0, 0], [0, cos_roll, -sin_roll], [0, sin_roll, cos_roll]])
    about_y = np.array([[cos_pitch, 0, sin_pitch], [0, 1, 0], [-sin_pitch, 0, cos_pitch]])
    about_z = np.array([[cos_yaw, -sin_yaw, 0], [sin_yaw, cos_yaw, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x)


def _require_attribute(element: ElementTree.Element, key: str, label: str) -> str:
    value = element.get(key)
    if not value:
        raise ArmError(f"{label} has no attribute '{key}'; the format requires it")
    return value


def _parse_numbers(text: str, count: int, label: str) -> list[float]:
    try:
        values = [float(part) for part in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not np.isfinite(values).all():
        requirement = "a finite number" if count == 1 else f"{count} finite numbers"
        raise ArmError(f"{label} is '{text}'; it must be {requirement}")
    return values
