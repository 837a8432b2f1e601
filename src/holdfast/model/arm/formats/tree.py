"""Tree of bodies read from a file, and the chain of the tree that is the arm."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import get_args

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.formatting import list_names, suggest_name
from holdfast.core.typing import FloatArray
from holdfast.model.arm.machine import GRAVITY, ArmData, Chain, Joint, JointType, Link
from holdfast.model.arm.poses import joint_motion

MOVING_TYPES = get_args(JointType)
LIMITED_TYPES = ("revolute", "prismatic")
FINGER_PATTERN = re.compile("finger|thumb|pinky|knuckle|jaw|claw", re.IGNORECASE)
GRIPPER_PATTERN = re.compile("grip", re.IGNORECASE)
TOOL_PATTERN = re.compile("tool|tcp|flange|grip|grasp|effector", re.IGNORECASE)
TIP_ADVICE = "name one with --tip (tip= in Python)"


@dataclass(frozen=True)
class TreeJoint:
    """Moving or fixed joint that carries one link of the tree; types that no arm can have keep the name of the file."""

    name: str
    type: str
    parent: str
    child: str
    origin: FloatArray
    axis: FloatArray
    lower: float
    upper: float
    velocity: float
    effort: float
    friction: float
    mimic: tuple[str, float, float] | None = None  # master, multiplier, offset
    armature: float = 0.0
    coulomb_friction: float = 0.0
    rest: float = 0.0  # value next to the chain, within its limits

    @property
    def is_moving(self) -> bool:
        """False for a fixed joint."""
        return self.type != "fixed"

    def child_pose(self, value: float) -> FloatArray:
        """Return the pose (4, 4) of the child link in the parent link at a joint value, rad or m."""
        return self.origin @ joint_motion(self.type, self.axis, value)


def fixed_joint(child: str, parent: str, origin: FloatArray) -> TreeJoint:
    """Return the fixed joint that places link ``child`` at the pose ``origin`` (4, 4) of link ``parent``."""
    no_limit = np.inf
    return TreeJoint(
        f"{child} (fixed)", "fixed", parent, child, origin, np.zeros(3), -no_limit, no_limit, no_limit, no_limit, 0.0
    )


@dataclass
class LinkTree:
    """Links and the joints that carry them; raises an error unless they form one tree."""

    name: str
    bodies: dict[str, Link | None]
    joints: dict[str, TreeJoint]
    limits_required: bool = True  # the format requires limits of revolute and prismatic joints
    tied: frozenset[str] = frozenset()  # joints coupled to others, such as fingers
    looped: frozenset[str] = frozenset()  # joints of closed loops, such as those of a four-bar gripper
    joint_above: dict[str, TreeJoint] = field(default_factory=dict)  # link -> joint that carries it
    joints_below: dict[str, list[TreeJoint]] = field(default_factory=dict)  # link -> joints attached to it

    def __post_init__(self) -> None:
        if not self.bodies:
            raise ArmError("the robot has no <link>; it needs at least two links and a joint")
        self.joints_below = {link: [] for link in self.bodies}
        for joint in self.joints.values():
            for role, link in (("parent", joint.parent), ("child", joint.child)):
                if link not in self.bodies:
                    raise ArmError(
                        f"joint '{joint.name}' names the {role} link '{link}', which the file does not define; "
                        "correct the name or add the link"
                    )
            if joint.child in self.joint_above:
                other = self.joint_above[joint.child].name
                raise ArmError(
                    f"link '{joint.child}' is the child of both '{other}' and '{joint.name}'; a tree gives each link one parent"
                )
            self.joint_above[joint.child] = joint
            self.joints_below[joint.parent].append(joint)
        roots = [link for link in self.bodies if link not in self.joint_above]
        if len(roots) > 1:
            raise ArmError(f"the links {list_names(roots)} have no parent; a tree has one root, so connect them with joints")
        reached = {link for root in roots for link in self.links_from(root)}
        unreached = [link for link in self.bodies if link not in reached]
        if unreached:
            raise ArmError(f"the links {list_names(unreached)} are joined in a loop; a URDF must be a tree")
        self.root = roots[0]

    def links_from(self, link: str) -> Iterator[str]:
        """Yield the link and all its descendants."""
        pending = [link]
        while pending:
            current = pending.pop()
            yield current
            pending += [joint.child for joint in reversed(self.joints_below[current])]

    def joint_path(self, base: str, tip: str) -> list[TreeJoint]:
        """Return the joints from base down to tip.

        Raises:
            ArmError: The tip is not a descendant of the base.
        """
        joints: list[TreeJoint] = []
        link = tip
        while link != base:
            if link not in self.joint_above:
                bases = possible_bases(self, tip)
                advice = f", which is {list_names(bases)}" if bases else ""
                raise ArmError(
                    f"tip link '{tip}' does not hang on base link '{base}'; choose a base on the way from the root to the tip"
                    f"{advice}"
                )
            joints.insert(0, self.joint_above[link])
            link = joints[0].parent
        return joints

    def is_fixed(self, joint: TreeJoint, hold: Mapping[str, float]) -> bool:
        """Return whether the joint is fixed, held at a value, or mimics such a joint, so that its value never changes."""
        followers: set[str] = set()
        while joint.is_moving and joint.name not in hold and joint.name not in followers:
            followers.add(joint.name)
            if joint.mimic is None or joint.mimic[0] not in self.joints:
                return False
            joint = self.joints[joint.mimic[0]]
        return not joint.is_moving or joint.name in hold


# ---- possible ends of the chain ----------------------------------------------------------------------------------


def require_single_tip(tree: LinkTree, base: str) -> str:
    """Return the tip if there is only one candidate.

    Raises:
        ArmError: There are several candidates, which are listed, or none.
    """
    candidates = possible_tips(tree, base)
    if len(candidates) == 1:
        return candidates[0]
    if candidates:
        raise ArmError(f"the arm could end at {list_names(candidates)}; {TIP_ADVICE}", tip=likely_tip(tree, base, candidates))
    moving = [joint.child for joint in _descendant_joints(tree, base) if joint.is_moving]
    if moving:
        farthest = max(moving, key=lambda link: len(tree.joint_path(base, link)))
        raise ArmError(f"only the fingers of a gripper move on '{base}' ({list_names(moving)}); {TIP_ADVICE}", tip=farthest)
    raise ArmError(f"no moving joint hangs on '{base}'; an arm needs at least one")


def possible_tips(tree: LinkTree, base: str) -> list[str]:
    """Return the links at which an arm mounted on ``base`` could end, the farthest from the base first.

    These are the links without descendants, except fingers, and links that carry a possible finger. A flange and the frames
    next to it rank as the end of the longest chain. A free-floating object is no end.
    """
    only_fingers_below: dict[
        str, tuple[bool, bool]
    ] = {}  # link: whether at most fingers, or at most possible fingers, move beyond it
    for link in reversed(list(tree.links_from(base))):
        only_fingers_below[link] = (
            all(
                only_fingers_below[child_joint.child][0] and (not child_joint.is_moving or _is_finger(child_joint))
                for child_joint in tree.joints_below[link]
            ),
            all(
                only_fingers_below[child_joint.child][1]
                and (not child_joint.is_moving or _is_finger(child_joint) or _may_be_finger(tree, child_joint))
                for child_joint in tree.joints_below[link]
            ),
        )
    moving_joint_counts = {base: 0}  # link: number of joints that move it, without fingers
    tips: dict[str, int] = {}
    for link in tree.links_from(base):
        if link not in moving_joint_counts:
            continue
        followed_joints = [
            child_joint
            for child_joint in tree.joints_below[link]
            if not (child_joint.is_moving and _is_finger(child_joint) and only_fingers_below[child_joint.child][0])
        ]
        moving_joint_counts.update({joint.child: moving_joint_counts[link] + joint.is_moving for joint in followed_joints})
        may_end_here = any(
            joint.is_moving and only_fingers_below[joint.child][1] and _may_be_finger(tree, joint) for joint in followed_joints
        )
        if moving_joint_counts[link] and (not followed_joints or may_end_here):
            tips[link] = moving_joint_counts[link]
    drivable_tips = [link for link in tips if any(joint.type in MOVING_TYPES for joint in tree.joint_path(base, link))]
    return sorted(drivable_tips or tips, key=lambda link: -tips[link])


def likely_tip(tree: LinkTree, base: str, candidates: Sequence[str]) -> str:
    """Return the candidate that most resembles a tool.

    Independent joints on its path count first, then its name, then the fewest fingers on its path, then its distance.
    """

    def rank_tip(link: str) -> tuple[bool, bool, int]:
        moving = [joint for joint in tree.joint_path(base, link) if joint.is_moving]
        is_dependent = any(joint.name in tree.tied | tree.looped for joint in moving)
        fingers = sum(_is_finger(joint) or _may_be_finger(tree, joint) for joint in moving)
        return is_dependent, not TOOL_PATTERN.search(link), fingers

    return min(candidates, key=rank_tip)


def _is_finger(joint: TreeJoint) -> bool:
    names = f"{joint.name} {joint.child}"
    return bool(FINGER_PATTERN.search(names) or (joint.type == "prismatic" and GRIPPER_PATTERN.search(names)))


def _may_be_finger(tree: LinkTree, joint: TreeJoint) -> bool:
    """Return whether a joint may be a finger: by name, in a closed loop, or with siblings if coupled or one of two slides."""
    siblings = [sibling for sibling in tree.joints_below[joint.parent] if sibling is not joint]
    has_prismatic_sibling = joint.type == "prismatic" and any(sibling.type == "prismatic" for sibling in siblings)
    is_coupled = joint.name in tree.looped or (siblings and joint.name in tree.tied)
    return bool(has_prismatic_sibling or is_coupled or GRIPPER_PATTERN.search(f"{joint.name} {joint.child}"))


def _descendant_joints(tree: LinkTree, base: str) -> Iterator[TreeJoint]:
    for link in tree.links_from(base):
        yield from tree.joints_below[link]


def possible_bases(tree: LinkTree, tip: str | None) -> list[str]:
    """Return the links on which an arm could be mounted: with a moving joint before ``tip``, or below them without a tip."""
    if tip is None:
        bases: set[str] = set()
        for joint in tree.joints.values():
            link = joint.parent
            while joint.is_moving and link not in bases:
                bases.add(link)
                link = tree.joint_above[link].parent if link in tree.joint_above else link
        return [link for link in tree.bodies if link in bases]
    path = tree.joint_path(tree.root, tip)
    last_moving = max((index for index, joint in enumerate(path) if joint.is_moving), default=-1)
    return [joint.parent for joint in path[: last_moving + 1]]


# ---- the chain ---------------------------------------------------------------------------------------------------


def resolve_base_and_tip(tree: LinkTree, base: str | None, tip: str | None) -> tuple[str, str]:
    """Return base and tip; the defaults are the root and the only end.

    Raises:
        ArmError: There is no such link, or more than one end.
    """
    if base is not None and base not in tree.bodies:
        possible_links = list_names(possible_bases(tree, tip if tip in tree.bodies else None))
        raise ArmError(
            f"there is no base link '{base}'; {suggest_name(base, tree.bodies)}an arm could be mounted on {possible_links}"
        )
    base = tree.root if base is None else base
    if tip is not None and tip not in tree.bodies:
        possible_links = list_names(possible_tips(tree, base))
        raise ArmError(f"there is no tip link '{tip}'; {suggest_name(tip, tree.bodies)}the arm could end at {possible_links}")
    return base, require_single_tip(tree, base) if tip is None else tip


def build_chain(
    tree: LinkTree,
    base: str | None,
    tip: str | None,
    hold: Mapping[str, float],
    name: str,
    gravity: Sequence[float] | None,
    source: str,
    in_world: bool = False,
) -> ArmData:
    """Build the arm from link ``base`` to link ``tip``, and merge every body that does not move relative to a link into that
    link.

    Args:
        tree: Links and joints of the file.
        base: Link on which the arm is mounted; default: the root.
        tip: Link whose frame is the tool; optional if there is only one end.
        hold: Values, rad or m, of joints that are held, on the chain or next to it; held joints are no joints of the arm.
        name: Name of the arm.
        gravity: (3,) acceleration in the world, m/s^2; None: that of the earth, down along z of the file's root.
        source: Origin of the tree.
        in_world: True if the root of the tree is the world, so that the base link keeps its pose in it; otherwise this pose
            is the identity.

    Raises:
        ArmError: There is no single serial chain from base to tip.
    """
    base, tip = resolve_base_and_tip(tree, base, tip)
    path = tree.joint_path(base, tip)
    moving = [joint for joint in path if not tree.is_fixed(joint, hold)]
    if not moving:
        other_tips = [other_tip for other_tip in possible_tips(tree, base) if other_tip != tip]
        advice = f", such as the tip {list_names(other_tips)}" if other_tips else ""
        raise ArmError(
            f"no moving joint lies between '{base}' and '{tip}'; choose a base and tip with joints in between that are not "
            f"held{advice}"
        )
    for joint in moving:
        if joint.type not in MOVING_TYPES:
            raise ArmError(
                f"joint '{joint.name}' on the chain is {joint.type}; a serial arm needs {', '.join(MOVING_TYPES)}"
                f"{_advise_base(moving)}"
            )
        if joint.mimic:
            raise ArmError(
                f"joint '{joint.name}' on the chain mimics '{joint.mimic[0]}', so it is not a degree of freedom; "
                "choose a base and tip with independent joints in between"
            )
        # Next to the chain such a joint has no effect, because it is held at 0.
        if tree.limits_required and joint.type in LIMITED_TYPES and not np.isfinite(joint.lower):
            remedy = "; if it has no limits, continuous is the right type" if joint.type == "revolute" else ""
            raise ArmError(f"joint '{joint.name}' is {joint.type} and has no <limit> with lower and upper; give them{remedy}")
    locked_joints = LockedJoints(tree, {joint.name for joint in moving}, hold)
    _reject_mimic_joints(tree, base, locked_joints)

    joints: list[Joint] = []
    links: list[Link | None] = []
    pending = np.eye(4)  # frame of the current link, in the last joint's moving frame
    on_path = {joint.name for joint in moving}
    for joint in path:
        if joint.name not in on_path:
            pending = pending @ joint.child_pose(locked_joints.joint_value(joint))
            continue
        joints.append(_to_arm_joint(joint, pending @ joint.origin))
        links.append(_merge_rigid_descendants(tree, joint.child, on_path, locked_joints))
        pending = np.eye(4)
    return ArmData(
        name,
        tuple(joints),
        tuple(links),
        base=locked_joints.link_pose(base) if in_world else np.eye(4),
        tool=pending,
        gravity=locked_joints.link_pose(base)[:3, :3].T @ GRAVITY if gravity is None else np.array(gravity, dtype=np.float64),
        source=source,
        chain=Chain(base, tip, tuple(sorted((name, float(value)) for name, value in hold.items()))),
    )


def _advise_base(moving: Sequence[TreeJoint]) -> str:
    """Return advice for a chain with unsupported joints: the link after the last of them, if joints follow."""
    last_unsupported = max(index for index, joint in enumerate(moving) if joint.type not in MOVING_TYPES)
    is_followed = last_unsupported < len(moving) - 1
    return f"; mount the arm on the link after it: --base {moving[last_unsupported].child}" if is_followed else ""


def _reject_mimic_joints(tree: LinkTree, base: str, locked_joints: LockedJoints) -> None:
    """Reject joints next to the chain that mimic joints of the chain, all of them in one error message."""
    masters = {
        joint.name: joint.mimic[0]
        for joint in _descendant_joints(tree, base)
        if joint.mimic and joint.name not in locked_joints.on_path | locked_joints.hold.keys()
    }
    followers = {name: master for name, master in masters.items() if master in locked_joints.on_path}
    if followers:
        follower_texts = ", ".join(f"joint '{name}' mimics '{master}'" for name, master in followers.items())
        options = " ".join(f"--hold {name}=0" for name in followers)
        raise ArmError(
            f"{follower_texts}, which moves on the chain, so it cannot be held still; choose another tip, or freeze it all the "
            f"same: {options} (hold= in Python)"
        )


def _to_arm_joint(joint: TreeJoint, origin: FloatArray) -> Joint:
    joint_type: JointType = (
        "prismatic" if joint.type == "prismatic" else "revolute" if joint.type == "revolute" else "continuous"
    )
    return Joint(
        joint.name,
        joint_type,
        origin,
        axis=joint.axis,
        lower=joint.lower,
        upper=joint.upper,
        velocity=joint.velocity,
        effort=joint.effort,
        friction=joint.friction,
        armature=joint.armature,
        coulomb_friction=joint.coulomb_friction,
    )


def _merge_rigid_descendants(tree: LinkTree, link: str, on_path: set[str], locked_joints: LockedJoints) -> Link | None:
    """Merge a link with all descendants that do not move relative to it, in the link's frame."""
    bodies: list[Link] = []
    pending = [(link, np.eye(4))]
    while pending:
        current, pose = pending.pop()
        body = tree.bodies[current]
        if body is not None:
            bodies.append(body.in_frame(pose))
        pending += [
            (joint.child, pose @ joint.child_pose(locked_joints.joint_value(joint)))
            for joint in tree.joints_below[current]
            if joint.name not in on_path
        ]
    if len(bodies) == 1 and tree.bodies[link] is not None:
        return tree.bodies[link]  # unchanged, also if a mass of 0 makes the centre of mass meaningless
    return Link.merge(bodies, link) if bodies else None


class LockedJoints:
    """Values of the joints that are no degrees of freedom of the arm."""

    def __init__(self, tree: LinkTree, on_path: set[str], hold: Mapping[str, float]) -> None:
        movable_names = [tree_joint.name for tree_joint in tree.joints.values() if tree_joint.type in MOVING_TYPES]
        for name, value in hold.items():
            if name not in movable_names:
                raise ArmError(
                    f"hold names '{name}', which is not a moving joint of this file; those are {list_names(movable_names)}"
                )
            joint = tree.joints[name]
            lower, upper = sorted((joint.lower, joint.upper))
            if not (np.isfinite(value) and lower <= value <= upper):
                raise ArmError(
                    f"hold puts joint '{name}' at {value:g}; "
                    f"it must be a finite number within its limits {lower:g} to {upper:g}"
                )
        self.tree, self.on_path, self.hold = tree, on_path, hold

    def link_pose(self, link: str) -> FloatArray:
        """Return the pose (4, 4) of a link in the root of the file."""
        pose = np.eye(4)
        for joint in self.tree.joint_path(self.tree.root, link):
            pose = pose @ joint.child_pose(self.joint_value(joint))
        return pose

    def joint_value(self, joint: TreeJoint, mimic_trail: tuple[str, ...] = ()) -> float:
        """Return the value of a joint, rad or m; meaningless for joints that neither slide nor rotate about one axis."""
        if joint.name in mimic_trail:
            raise ArmError(
                f"the joints {list_names(mimic_trail)} mimic each other in a circle; one of them must be independent"
            )
        if joint.name in self.hold:
            return float(self.hold[joint.name])
        if joint.mimic:
            master, multiplier, offset = joint.mimic
            if master in self.on_path:
                raise ArmError(f"joint '{joint.name}' mimics '{master}', which moves on the chain; freeze it with hold")
            if master not in self.tree.joints:
                raise ArmError(
                    f"joint '{joint.name}' mimics '{master}', which the file does not define; correct the name, or freeze the "
                    f"joint: --hold {joint.name}=0 (hold= in Python)"
                )
            return multiplier * self.joint_value(self.tree.joints[master], (*mimic_trail, joint.name)) + offset
        lower, upper = sorted((joint.lower, joint.upper))  # a file may have them reversed
        return float(min(max(joint.rest, lower), upper))
