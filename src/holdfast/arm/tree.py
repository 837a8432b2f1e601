"""A tree of bodies and the one chain of it that is an arm, whatever the file it was read from."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.machine import GRAVITY, Chain, Joint, JointType, Link, Machine
from holdfast.arm.poses import motion
from holdfast.errors import ArmError
from holdfast.words import list_names, suggest_name

Array = NDArray[np.float64]
MOVING = get_args(JointType)
LIMITED = ("revolute", "prismatic")
FINGER = re.compile("finger|thumb|knuckle|jaw|claw", re.IGNORECASE)
GRIPPER = re.compile("grip", re.IGNORECASE)
TOOL = re.compile("tool|tcp|flange|grip|grasp|effector", re.IGNORECASE)
ASK = "name one with --tip (tip= in Python)"


@dataclass(frozen=True)
class TreeJoint:
    """What carries one link of the tree: a moving or fixed joint; types that no arm can have keep the file's name."""

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
    mimic: tuple[str, float, float] | None = None  # master, multiplier, offset
    armature: float = 0.0
    rest: float = 0.0  # where it is beside the chain, as far as its limits allow

    @property
    def moving(self) -> bool:
        """False for a joint that only says where its child sits."""
        return self.type != "fixed"

    def at(self, value: float) -> Array:
        """(4, 4) pose of the child link in the parent link."""
        return self.origin @ motion(self.type, self.axis, value)


@dataclass
class Tree:
    """Links and the joints that carry them; refuses what is not one tree."""

    name: str
    bodies: dict[str, Link | None]
    joints: dict[str, TreeJoint]
    limits_required: bool = True  # the format wants limits of every revolute and prismatic joint
    tied: frozenset[str] = frozenset()  # joints that move together with others, as fingers do
    above: dict[str, TreeJoint] = field(default_factory=dict)  # link -> joint that carries it
    below: dict[str, list[TreeJoint]] = field(default_factory=dict)  # link -> joints that hang on it

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
            raise ArmError(f"the links {list_names(roots)} have no parent; a tree has one root, so connect them with joints")
        reached = {link for root in roots for link in self.links_from(root)}
        loop = [link for link in self.bodies if link not in reached]
        if loop:
            raise ArmError(f"the links {list_names(loop)} are joined in a loop; a URDF must be a tree")
        self.root = roots[0]

    def links_from(self, link: str) -> Iterator[str]:
        """The link and all that hangs on it."""
        waiting = [link]
        while waiting:
            here = waiting.pop()
            yield here
            waiting += [joint.child for joint in reversed(self.below[here])]

    def path(self, base: str, tip: str) -> list[TreeJoint]:
        """Joints from base down to tip.

        Raises:
            ArmError: The tip does not hang on the base.
        """
        joints: list[TreeJoint] = []
        link = tip
        while link != base:
            if link not in self.above:
                bases = possible_bases(self, tip)
                where = f", which is {list_names(bases)}" if bases else ""
                raise ArmError(
                    f"tip link '{tip}' does not hang on base link '{base}'; choose a base on the way from the root to the tip"
                    f"{where}"
                )
            joints.insert(0, self.above[link])
            link = joints[0].parent
        return joints

    def stands(self, joint: TreeJoint, hold: Mapping[str, float]) -> bool:
        """The joint is fixed or held, or mimics one that is: its value never changes."""
        followers: set[str] = set()
        while joint.moving and joint.name not in hold and joint.name not in followers:
            followers.add(joint.name)
            if joint.mimic is None or joint.mimic[0] not in self.joints:
                return False
            joint = self.joints[joint.mimic[0]]
        return not joint.moving or joint.name in hold


# ---- where the chain may begin and end ---------------------------------------------------------------------------


def only_tip(tree: Tree, base: str) -> str:
    """The tip, if there is only one candidate.

    Raises:
        ArmError: There are several, which are listed, or none.
    """
    candidates = possible_tips(tree, base)
    if len(candidates) == 1:
        return candidates[0]
    if candidates:
        raise ArmError(f"the arm could end at {list_names(candidates)}; {ASK}", tip=likely_tip(tree, base, candidates))
    moving = [joint.child for joint in _hanging(tree, base) if joint.moving]
    if moving:
        raise ArmError(f"only the fingers of a gripper move on '{base}' ({list_names(moving)}); {ASK}")
    raise ArmError(f"no moving joint hangs on '{base}'; an arm needs at least one")


def possible_tips(tree: Tree, base: str) -> list[str]:
    """Links at which an arm mounted on ``base`` could end, the farthest from the base first.

    Those are the links that carry nothing, fingers being left off, and a link that carries what may be a finger. A flange
    and the frames beside it are as good as the end of the longest chain. An object that only floats is no end.
    """
    below: dict[str, tuple[bool, bool]] = {}  # link: whether fingers at most, or what may be fingers at most, move behind it
    for link in reversed(list(tree.links_from(base))):
        below[link] = (
            all(below[j.child][0] and (not j.moving or _is_finger(j)) for j in tree.below[link]),
            all(below[j.child][1] and (not j.moving or _is_finger(j) or _may_be_finger(tree, j)) for j in tree.below[link]),
        )
    moved = {base: 0}  # link: how many joints move it, fingers left off
    found: dict[str, int] = {}
    for link in tree.links_from(base):
        if link not in moved:
            continue
        kept = [j for j in tree.below[link] if not (j.moving and _is_finger(j) and below[j.child][0])]
        moved.update({j.child: moved[link] + j.moving for j in kept})
        doubtful = any(j.moving and below[j.child][1] and _may_be_finger(tree, j) for j in kept)
        if moved[link] and (not kept or doubtful):
            found[link] = moved[link]
    driven = [link for link in found if any(joint.type in MOVING for joint in tree.path(base, link))]
    return sorted(driven or found, key=lambda link: -found[link])


def likely_tip(tree: Tree, base: str, candidates: Sequence[str]) -> str:
    """The candidate that looks most like a tool: by its name, then with the fewest fingers on its way, then the farthest."""

    def rank(link: str) -> tuple[bool, int]:
        moving = [joint for joint in tree.path(base, link) if joint.moving]
        return not TOOL.search(link), sum(_is_finger(j) or _may_be_finger(tree, j) for j in moving)

    return min(candidates, key=rank)


def _is_finger(joint: TreeJoint) -> bool:
    names = f"{joint.name} {joint.child}"
    return bool(FINGER.search(names) or (joint.type == "prismatic" and GRIPPER.search(names)))


def _may_be_finger(tree: Tree, joint: TreeJoint) -> bool:
    """It is named after a gripper, or is not alone on its link and tied to another joint or one of two that slide."""
    beside = [j for j in tree.below[joint.parent] if j is not joint]
    twin = joint.type == "prismatic" and any(j.type == "prismatic" for j in beside)
    return bool(twin or (beside and joint.name in tree.tied) or GRIPPER.search(f"{joint.name} {joint.child}"))


def _hanging(tree: Tree, base: str) -> Iterator[TreeJoint]:
    for link in tree.links_from(base):
        yield from tree.below[link]


def possible_bases(tree: Tree, tip: str | None) -> list[str]:
    """Links on which an arm could be mounted: with a moving joint between them and ``tip``, or behind them without one."""
    if tip is None:
        carrying: set[str] = set()
        for joint in tree.joints.values():
            link = joint.parent
            while joint.moving and link not in carrying:
                carrying.add(link)
                link = tree.above[link].parent if link in tree.above else link
        return [link for link in tree.bodies if link in carrying]
    path = tree.path(tree.root, tip)
    last = max((k for k, joint in enumerate(path) if joint.moving), default=-1)
    return [joint.parent for joint in path[: last + 1]]


# ---- the chain ---------------------------------------------------------------------------------------------------


def check_ends(tree: Tree, base: str | None, tip: str | None) -> tuple[str, str]:
    """Base and tip, those not named being the root and the only end.

    Raises:
        ArmError: There is no such link, or more than one end.
    """
    if base is not None and base not in tree.bodies:
        known = list_names(possible_bases(tree, tip if tip in tree.bodies else None))
        raise ArmError(f"there is no base link '{base}'; {suggest_name(base, tree.bodies)}an arm could be mounted on {known}")
    base = tree.root if base is None else base
    if tip is not None and tip not in tree.bodies:
        known = list_names(possible_tips(tree, base))
        raise ArmError(f"there is no tip link '{tip}'; {suggest_name(tip, tree.bodies)}the arm could end at {known}")
    return base, only_tip(tree, base) if tip is None else tip


def chain(
    tree: Tree,
    base: str | None,
    tip: str | None,
    hold: Mapping[str, float],
    name: str,
    gravity: Sequence[float] | None,
    source: str,
    mount: Array | None = None,
) -> Machine:
    """The arm from link ``base`` down to link ``tip``, with everything that does not move against a link folded into it.

    Args:
        tree: The links and joints of the file.
        base: The root if not given.
        tip: May be left out if there is only one end.
        hold: Value, rad or m, at which joints are held, on the chain or beside it; those are then no joints of the arm.
        name: Name of the arm.
        gravity: (3,) acceleration in the world, m/s^2; None: that of the earth, down along z of the file's root.
        source: Where the tree comes from.
        mount: (4, 4) pose of the base link in the world; the identity if not given.

    Raises:
        ArmError: There is no single serial chain from base to tip.
    """
    base, tip = check_ends(tree, base, tip)
    path = tree.path(base, tip)
    moving = [joint for joint in path if not tree.stands(joint, hold)]
    if not moving:
        ends = [x for x in possible_tips(tree, base) if x != tip]
        where = f", such as the tip {list_names(ends)}" if ends else ""
        raise ArmError(
            f"no moving joint lies between '{base}' and '{tip}'; choose a base and tip with joints in between that are not "
            f"held{where}"
        )
    for joint in moving:
        if joint.type not in MOVING:
            raise ArmError(
                f"joint '{joint.name}' on the chain is {joint.type}; a serial arm needs {', '.join(MOVING)}"
                f"{_base_behind(moving)}"
            )
        if joint.mimic:
            raise ArmError(
                f"joint '{joint.name}' on the chain mimics '{joint.mimic[0]}', so it is not a degree of freedom; "
                "choose a base and tip with independent joints in between"
            )
        # Beside the chain such a joint is harmless: it is held at 0.
        if tree.limits_required and joint.type in LIMITED and not np.isfinite(joint.lower):
            remedy = "; if it has no limits, continuous is the right type" if joint.type == "revolute" else ""
            raise ArmError(f"joint '{joint.name}' is {joint.type} and has no <limit> with lower and upper; give them{remedy}")
    still = Held(tree, {joint.name for joint in moving}, hold)
    _refuse_followers(tree, base, still)

    joints: list[Joint] = []
    links: list[Link | None] = []
    pending = np.eye(4)  # frame of the link reached so far, in the last joint's moving frame
    on_path = {joint.name for joint in moving}
    for joint in path:
        if joint.name not in on_path:
            pending = pending @ joint.at(still.value(joint))
            continue
        joints.append(_model_joint(joint, pending @ joint.origin))
        links.append(_folded(tree, joint.child, on_path, still))
        pending = np.eye(4)
    return Machine(
        name,
        tuple(joints),
        tuple(links),
        base=np.eye(4) if mount is None else mount,
        tool=pending,
        gravity=still.pose(base)[:3, :3].T @ GRAVITY if gravity is None else np.array(gravity, dtype=np.float64),
        source=source,
        chain=Chain(base, tip, tuple(sorted((name, float(value)) for name, value in hold.items()))),
    )


def _base_behind(moving: Sequence[TreeJoint]) -> str:
    """Return advice for a chain with joints that no arm can have: the link behind the last of them, if joints follow."""
    last = max(k for k, joint in enumerate(moving) if joint.type not in MOVING)
    return f"; mount the arm on the link behind it: --base {moving[last].child}" if last < len(moving) - 1 else ""


def _refuse_followers(tree: Tree, base: str, still: Held) -> None:
    """Refuse joints next to the chain that mimic joints of the chain, all of them in one sentence."""
    free = {j.name: j.mimic[0] for j in _hanging(tree, base) if j.mimic and j.name not in still.on_path | still.hold.keys()}
    followers = {name: master for name, master in free.items() if master in still.on_path}
    if followers:
        each = ", ".join(f"joint '{name}' mimics '{master}'" for name, master in followers.items())
        options = " ".join(f"--hold {name}=0" for name in followers)
        raise ArmError(
            f"{each}, which moves on the chain, so it cannot be held still; choose another tip, or freeze it all the same: "
            f"{options} (hold= in Python)"
        )


def _model_joint(joint: TreeJoint, origin: Array) -> Joint:
    kind: JointType = "prismatic" if joint.type == "prismatic" else "revolute" if joint.type == "revolute" else "continuous"
    return Joint(
        joint.name,
        kind,
        origin,
        axis=joint.axis,
        lower=joint.lower,
        upper=joint.upper,
        velocity=joint.velocity,
        effort=joint.effort,
        friction=joint.friction,
        armature=joint.armature,
    )


def _folded(tree: Tree, link: str, on_path: set[str], still: Held) -> Link | None:
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


class Held:
    """Where the joints that are not the arm's are held."""

    def __init__(self, tree: Tree, on_path: set[str], hold: Mapping[str, float]) -> None:
        free = [j.name for j in tree.joints.values() if j.type in MOVING]
        for name, value in hold.items():
            if name not in free:
                raise ArmError(f"hold names '{name}', which is not a moving joint of this file; those are {list_names(free)}")
            joint = tree.joints[name]
            if not (np.isfinite(value) and joint.lower <= value <= joint.upper):
                raise ArmError(
                    f"hold puts joint '{name}' at {value:g}; "
                    f"it must be a finite number within its limits {joint.lower:g} to {joint.upper:g}"
                )
        self.tree, self.on_path, self.hold = tree, on_path, hold

    def pose(self, link: str) -> Array:
        """Compute the pose (4, 4) of a link in the root of the file."""
        pose = np.eye(4)
        for joint in self.tree.path(self.tree.root, link):
            pose = pose @ joint.at(self.value(joint))
        return pose

    def value(self, joint: TreeJoint, followers: tuple[str, ...] = ()) -> float:
        """Value of a joint, rad or m; of no meaning for those that do not slide or turn about one axis."""
        if joint.name in followers:
            raise ArmError(f"the joints {list_names(followers)} mimic each other in a circle; one of them must be independent")
        if joint.name in self.hold:
            return float(self.hold[joint.name])
        if joint.mimic:
            master, multiplier, offset = joint.mimic
            if master in self.on_path:
                raise ArmError(f"joint '{joint.name}' mimics '{master}', which moves on the chain; freeze it with hold")
            if master not in self.tree.joints:
                raise ArmError(f"joint '{joint.name}' mimics '{master}', which the file does not define")
            return multiplier * self.value(self.tree.joints[master], (*followers, joint.name)) + offset
        return float(min(max(joint.rest, joint.lower), joint.upper))
