"""Arms from URDF files: one chain of a tree of links, everything else folded into it.

Only ``<link>`` (with its ``<inertial>``) and ``<joint>`` are read; meshes, transmissions and simulator tags are skipped,
so no file other than the URDF itself is ever opened.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import get_args
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import GRAVITY, Arm, Joint, JointType, Link
from holdfast.errors import ArmError

Array = NDArray[np.float64]
MOVING = get_args(JointType)
TYPES = (*MOVING, "fixed", "floating", "planar")
MOST_NAMES = 12  # in a sentence
LIMITED = ("revolute", "prismatic")
QUARTER_TURN_SLACK = 1e-9  # rad; files write pi/2 with 11 or more digits


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
        tree = _read(path)
        return _arm(tree, base, tip, dict(hold or {}), name or tree.name, gravity, path.name)
    except ArmError as error:
        raise ArmError(f"{path.name}: {error}") from error


# ---- the file ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _UrdfJoint:
    name: str
    type: str
    parent: str
    child: str
    origin: Array
    axis: Array
    lower: float
    upper: float
    velocity: float
    effort: float
    friction: float
    mimic: tuple[str, float, float] | None  # master, multiplier, offset

    @property
    def moving(self) -> bool:
        return self.type != "fixed"

    def at(self, value: float) -> Array:
        """(4, 4) pose of the child link in the parent link."""
        motion = np.eye(4)
        if self.type == "prismatic":
            motion[:3, 3] = self.axis * value
        elif self.type in ("revolute", "continuous"):
            motion[:3, :3] = _turn(self.axis, value)
        return self.origin @ motion


@dataclass
class _Tree:
    name: str
    bodies: dict[str, Link | None]
    joints: dict[str, _UrdfJoint]
    above: dict[str, _UrdfJoint] = field(default_factory=dict)  # link -> joint that carries it
    below: dict[str, list[_UrdfJoint]] = field(default_factory=dict)  # link -> joints that hang on it

    def __post_init__(self) -> None:
        if not self.bodies:
            raise ArmError("the robot has no <link>; it needs at least two links and a joint")
        self.below = {link: [] for link in self.bodies}
        for joint in self.joints.values():
            for role, link in (("parent", joint.parent), ("child", joint.child)):
                if link not in self.bodies:
                    raise ArmError(f"joint '{joint.name}' names the {role} link '{link}', which the file does not define")
            if joint.child in self.above:
                other = self.above[joint.child].name
                raise ArmError(
                    f"link '{joint.child}' is the child of both '{other}' and '{joint.name}'; a tree gives each link one parent"
                )
            self.above[joint.child] = joint
            self.below[joint.parent].append(joint)
        roots = [link for link in self.bodies if link not in self.above]
        if len(roots) > 1:
            raise ArmError(f"the links {_quoted(roots)} have no parent; a tree has one root, so connect them with joints")
        reached = {link for root in roots for link in self.links_from(root)}
        loop = [link for link in self.bodies if link not in reached]
        if loop:
            raise ArmError(f"the links {_quoted(loop)} are joined in a loop; a URDF must be a tree")
        self.root = roots[0]

    def links_from(self, link: str) -> Iterator[str]:
        """The link and all that hangs on it."""
        waiting = [link]
        while waiting:
            here = waiting.pop()
            yield here
            waiting += [joint.child for joint in reversed(self.below[here])]

    def path(self, base: str, tip: str) -> list[_UrdfJoint]:
        """Joints from base down to tip; raises ArmError if the tip does not hang on the base."""
        joints: list[_UrdfJoint] = []
        link = tip
        while link != base:
            if link not in self.above:
                raise ArmError(f"tip link '{tip}' does not hang on base link '{base}'; choose a base on the way to the root")
            joints.insert(0, self.above[link])
            link = joints[0].parent
        return joints

    def leaves(self, link: str) -> list[str]:
        return [x for x in self.links_from(link) if not self.below[x]]


class _NoEntities(ElementTree.TreeBuilder):
    """Stops at a DOCTYPE, the only place where an XML file can define entities that blow up or reach other files."""

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        raise ArmError("the file has a DOCTYPE, which a URDF never needs and which can hide harmful entities; remove it")


def _read(path: Path) -> _Tree:
    try:
        content = path.read_bytes()
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
    bodies: dict[str, Link | None] = {}
    for element in robot.findall("link"):
        label = _attribute(element, "name", "a <link>")
        if label in bodies:
            raise ArmError(f"the link name '{label}' is used more than once; names must be unique")
        bodies[label] = _body(element, label)
    joints: dict[str, _UrdfJoint] = {}
    for element in robot.findall("joint"):
        joint = _joint(element)
        if joint.name in joints:
            raise ArmError(f"the joint name '{joint.name}' is used more than once; names must be unique")
        joints[joint.name] = joint
    return _Tree(robot.get("name") or path.stem, bodies, joints)


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
    return Link(kilograms, np.zeros(3), inertia, label).moved(_origin(inertial, where))


def _joint(element: ElementTree.Element) -> _UrdfJoint:
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
    return _UrdfJoint(
        name=name,
        type=kind,
        parent=ends["parent"],
        child=ends["child"],
        origin=_origin(element, where),
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


def _origin(element: ElementTree.Element, where: str) -> Array:
    """(4, 4) from ``<origin xyz rpy>``."""
    pose = np.eye(4)
    origin = element.find("origin")
    if origin is None:
        return pose
    pose[:3, 3] = _numbers(origin.get("xyz", "0 0 0"), 3, f"{where}: origin xyz")
    pose[:3, :3] = rpy_rotation(_numbers(origin.get("rpy", "0 0 0"), 3, f"{where}: origin rpy"))
    return pose


def rpy_rotation(rpy: Sequence[float]) -> Array:
    """(3, 3) rotation from roll, pitch, yaw (3,), rad, about the fixed x, y, z axes in turn: ``Rz(yaw) Ry(pitch) Rx(roll)``."""
    (cr, sr), (cp, sp), (cy, sy) = (_cos_sin(angle) for angle in rpy)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x)


def _cos_sin(angle: float) -> tuple[float, float]:
    quarters = round(angle / (np.pi / 2))
    # Exact zeros make terms vanish from the generated code; the file's author meant them.
    if abs(angle - quarters * np.pi / 2) < QUARTER_TURN_SLACK:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarters % 4]
    return float(np.cos(angle)), float(np.sin(angle))


def _turn(axis: Array, angle: float) -> Array:
    """(3, 3) rotation about a unit axis (Rodrigues)."""
    c, s = _cos_sin(angle)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(c * np.eye(3) + s * cross + (1 - c) * np.outer(axis, axis))


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


def _quoted(names: Sequence[str]) -> str:
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    return ", ".join(f"'{x}'" for x in names[:MOST_NAMES]) + more


# ---- the chain ---------------------------------------------------------------------------------------------------


def _arm(
    tree: _Tree, base: str | None, tip: str | None, hold: dict[str, float], name: str, gravity: Sequence[float], source: str
) -> Arm:
    for role, link in (("base", base), ("tip", tip)):
        if link is not None and link not in tree.bodies:
            raise ArmError(f"there is no {role} link '{link}'; the links are {_quoted(list(tree.bodies))}")
    base = base or tree.root
    tip = tip or _only_tip(tree, base)
    path = tree.path(base, tip)
    moving = [joint for joint in path if joint.moving]
    if not moving:
        raise ArmError(f"no moving joint lies between '{base}' and '{tip}'; choose a base and tip with joints in between")
    for joint in moving:
        if joint.type not in MOVING:
            raise ArmError(f"joint '{joint.name}' on the chain is {joint.type}; a serial arm needs {', '.join(MOVING)}")
        if joint.mimic:
            raise ArmError(
                f"joint '{joint.name}' on the chain mimics '{joint.mimic[0]}', so it is not a degree of freedom; "
                "choose a base and tip with independent joints in between"
            )
        # Beside the chain such a joint is harmless: it stands at 0.
        if joint.type in LIMITED and not np.isfinite(joint.lower):
            remedy = "; if it has no limits, continuous is the right type" if joint.type == "revolute" else ""
            raise ArmError(f"joint '{joint.name}' is {joint.type} and has no <limit> with lower and upper; give them{remedy}")
    still = _Held(tree, {joint.name for joint in moving}, hold)

    joints: list[Joint] = []
    links: list[Link | None] = []
    pending = np.eye(4)  # frame of the link reached so far, in the last joint's moving frame
    on_path = {joint.name for joint in moving}
    for joint in path:
        pending = pending @ joint.origin
        if joint.moving:
            joints.append(_model_joint(joint, pending))
            links.append(_folded(tree, joint.child, on_path, still))
            pending = np.eye(4)
    return Arm(name, tuple(joints), tuple(links), tool=pending, gravity=np.array(gravity, dtype=np.float64), source=source)


def _model_joint(joint: _UrdfJoint, origin: Array) -> Joint:
    kind: JointType = "prismatic" if joint.type == "prismatic" else "revolute" if joint.type == "revolute" else "continuous"
    return Joint(joint.name, kind, origin, joint.axis, joint.lower, joint.upper, joint.velocity, joint.effort, joint.friction)


def _only_tip(tree: _Tree, base: str) -> str:
    """The tip, if the arm can have only one."""
    leaves = tree.leaves(base)
    if len(leaves) == 1:
        return leaves[0]
    ends = [
        link
        for link in tree.links_from(base)
        if link != base
        and tree.above[link].moving
        and not any(tree.above[below].moving for below in tree.links_from(link) if below != link)
    ]
    if not ends:
        raise ArmError(f"no moving joint hangs on '{base}'; an arm needs at least one")
    tips = [leaf for end in ends for leaf in tree.leaves(end)]
    if len(tips) == 1:
        return tips[0]
    # Fixed frames on the way (a flange with a gripper behind it) are as good a tip as the ends.
    candidates = [x for x in leaves if any(joint.moving for joint in tree.path(base, x))]
    raise ArmError(f"the arm could end at {_quoted(candidates)}; name one link as tip")


def _folded(tree: _Tree, link: str, on_path: set[str], still: _Held) -> Link | None:
    """The link with all that hangs on it and does not move relative to it, in the link's frame."""
    bodies: list[Link] = []
    waiting = [(link, np.eye(4))]
    while waiting:
        here, pose = waiting.pop()
        body = tree.bodies[here]
        if body is not None:
            bodies.append(body.moved(pose))
        waiting += [(j.child, pose @ j.at(still.value(j))) for j in tree.below[here] if j.name not in on_path]
    if len(bodies) == 1 and tree.bodies[link] is not None:
        return tree.bodies[link]  # untouched, also where a mass of 0 would make the centre of mass meaningless
    return Link.joined(bodies, link) if bodies else None


class _Held:
    """Where the joints beside the chain stand."""

    def __init__(self, tree: _Tree, on_path: set[str], hold: dict[str, float]) -> None:
        free = [j.name for j in tree.joints.values() if j.type in MOVING and j.name not in on_path]
        for name, value in hold.items():
            if name not in free:
                listed = f"those are {_quoted(free)}" if free else "this file has none"
                raise ArmError(f"hold names '{name}', which is not a moving joint beside the chain; {listed}")
            joint = tree.joints[name]
            if not (np.isfinite(value) and joint.lower <= value <= joint.upper):
                raise ArmError(
                    f"hold puts joint '{name}' at {value:g}; "
                    f"it must be a finite number within its limits {joint.lower:g} to {joint.upper:g}"
                )
        self.tree, self.on_path, self.hold = tree, on_path, hold

    def value(self, joint: _UrdfJoint, followers: tuple[str, ...] = ()) -> float:
        """Value of a joint, rad or m; 0 for fixed, floating and planar ones."""
        if joint.name in followers:
            raise ArmError(f"the joints {_quoted(followers)} mimic each other in a circle; one of them must be independent")
        if joint.name in self.hold:
            return float(self.hold[joint.name])
        if joint.mimic:
            master, multiplier, offset = joint.mimic
            if master in self.on_path:
                raise ArmError(
                    f"joint '{joint.name}' mimics '{master}', which moves on the chain, so it cannot stand still; "
                    "choose another tip, or name it in hold to freeze it all the same"
                )
            if master not in self.tree.joints:
                raise ArmError(f"joint '{joint.name}' mimics '{master}', which the file does not define")
            return multiplier * self.value(self.tree.joints[master], (*followers, joint.name)) + offset
        return float(min(max(0.0, joint.lower), joint.upper))
