"""Shape of a link, and the joint of an arm that moves the link."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm.formats.tree import LinkTree, LockedJoints
from holdfast.model.arm.model import Arm

Kind = Literal["box", "cylinder", "capsule", "sphere", "ellipsoid", "mesh", "half space"]
Purpose = Literal["visual", "collision"]
Place = Callable[[str], tuple[int, FloatArray] | None]  # of a link: its joint (-1: none), and its pose (4, 4) there

_POSE_TOLERANCE = 1e-9  # m and rad: tolerance between two readings of one file


@dataclass(frozen=True, eq=False, kw_only=True)
class Piece:
    """Shape that moves with a link.

    Attributes:
        link: Index from 0 of the joint that moves it; -1 for the base.
        owner: Name of the link in the file.
        kind: Kind of the shape.
        name: Name of its mesh in the file, or its kind.
        size: Size, m. A box: (3,) full sizes. A cylinder or capsule along z: radius and length, for a capsule between the
            centres of its ends. A sphere: its radius. An ellipsoid: (3,) half axes. A mesh, or a half space below its z: empty.
        pose: (4, 4) pose in the frame that moves with the joint; for the base, in the base frame, m.
        vertices: (V, 3) vertices of a mesh in its own frame, scaled, m; (0, 3) otherwise.
        faces: (F, 3) row numbers of the corners.
        rgba: Color, each number from 0 to 1, if the file gives one.
        label: Its own name in the file, if that is unique; else empty.
    """

    link: int
    owner: str
    kind: Kind
    name: str
    size: tuple[float, ...]
    pose: FloatArray
    vertices: FloatArray
    faces: IndexArray
    rgba: tuple[float, ...] | None = None
    label: str = ""


class Missing(NamedTuple):
    """Shape that could not be read.

    Attributes:
        link: Index from 0 of the joint that moves it; -1 for the base.
        what: Name of the shape, and the reason.
        is_present: True if its file was found, so that its content is the reason.
    """

    link: int
    what: str
    is_present: bool = False


class LinkCarriers:
    """Map from links of the file's kinematic tree to the joints of an arm that move them.

    Links attached next to the chain by a moving joint are where the arm's mass data assume them.

    Args:
        tree: All links and joints of the file.
        arm: Arm model.
        hold: Values of joints next to the chain that differ from those of the arm, rad or m.

    Raises:
        ArmError: The arm does not belong to this tree, because joints have other names or positions.
    """

    def __init__(self, tree: LinkTree, arm: Arm, hold: Mapping[str, float] | None = None) -> None:
        self.tree, self.arm = tree, arm
        chain = arm.chain
        self.base = tree.root if chain is None else chain.base
        held = {**({} if chain is None else dict(chain.held)), **(hold or {})}
        self.still = LockedJoints(tree, set(arm.joint_names), held)
        self._numbers: dict[str, int] = {name: k for k, name in enumerate(arm.joint_names)}
        for k, joint in enumerate(arm.joints):
            there = tree.joints.get(joint.name)
            place = None if there is None else self.locate_link(there.parent)
            same = place is not None and there is not None and place[0] == k - 1
            if not (same and np.allclose(place[1] @ there.origin, joint.origin, atol=_POSE_TOLERANCE)):  # type: ignore[index, union-attr]
                raise ArmError(f"joint '{joint.name}' of '{arm.name}' differs from the file of the arm")

    def locate_link(self, link: str) -> tuple[int, FloatArray] | None:
        """Return the joint that moves a link (-1: none) and its pose (4, 4) there; None if not attached to the base."""
        pose = np.eye(4)
        while link != self.base:
            if link not in self.tree.joint_above:
                return None
            joint = self.tree.joint_above[link]
            if joint.name in self._numbers:
                return self._numbers[joint.name], pose
            pose = joint.child_pose(self.still.joint_value(joint)) @ pose
            link = joint.parent
        return -1, pose
