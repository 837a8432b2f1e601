"""Cells of joint space, all of the same size, that an object, the arm itself, or a tool constraint certainly blocks."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.arm.model import Arm
from holdfast.model.cell.solids import PrimitiveSolid
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.response.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.response.recovery.space import FreeSpace

if TYPE_CHECKING:
    from holdfast.model.collision.exact.narrow_phase import ArmBody

_ROUNDING_SLACK = 1e-9  # rounding error, m and rad
_SQUARE_ROOT_SLACK_M = 1e-7  # rounding error of a square root where two squares cancel, m
_BALLS_PER_BODY = 24  # balls along a body
_SAMPLED_CONFIGURATIONS = 64  # random configurations
_MAX_PENETRATION_M = 0.15  # hardly any ball is deeper in an object, m


@dataclass(frozen=True)
class LinkPoints:
    """Points that move with the links of an arm.

    Attributes:
        link: (P,) index of the joint that moves each point, from 0.
        local_positions: (P, 3) positions in the frame of the joint, m.
    """

    link: IndexArray
    local_positions: FloatArray

    def world_positions(self, frames: FloatArray) -> FloatArray:
        """Return the positions (N, P, 3) in the world, m."""
        positions = np.empty((len(frames), len(self.link), 3))
        for link in np.unique(self.link):
            on_link, pose = self.link == link, frames[:, link + 1]
            positions[:, on_link] = self.local_positions[on_link] @ pose[:, :3, :3].transpose(0, 2, 1) + pose[:, None, :3, 3]
        return positions

    def bound_motion(
        self, arm: Arm, frames: FloatArray, half_widths: FloatArray, positions: FloatArray | None = None
    ) -> FloatArray:
        """Return (N, P) upper bounds of the motion of each point where joints move by up to ``half_widths`` (n,), m.

        From the tool inwards, a point is no farther from axis k than its present distance plus its motion by joints beyond k.
        """
        positions = self.world_positions(frames) if positions is None else positions
        motion_bounds = np.zeros((len(frames), len(self.link)))
        for joint_index in range(arm.n - 1, -1, -1):
            moved_points = np.flatnonzero(self.link >= joint_index)
            if half_widths[joint_index] == 0 or not moved_points.size:
                continue
            if arm.prismatic[joint_index]:
                motion_bounds[:, moved_points] += half_widths[joint_index]
                continue
            offsets = positions[:, moved_points] - frames[:, joint_index + 1, None, :3, 3]
            axial_components = offsets @ (frames[:, joint_index + 1, :3, :3] @ arm.joints[joint_index].axis)[..., None]
            axis_distances = (
                np.sqrt(np.maximum(np.square(offsets).sum(axis=2) - axial_components[..., 0] ** 2, 0.0)) + _SQUARE_ROOT_SLACK_M
            )
            motion_bounds[:, moved_points] += (axis_distances + motion_bounds[:, moved_points]) * half_widths[joint_index]
        return motion_bounds


class BlockedCells:
    """Test whether cells are certainly blocked."""

    def __init__(self, space: FreeSpace) -> None:
        from holdfast.model.collision.exact.bodies import inner_primitives  # imports scipy

        self._space = space
        obstacles = None if space.clearance is None else space.clearance.obstacles
        parts: Sequence[ArmBody] = [] if obstacles is None or space.clearance is None else space.clearance.exactness.parts
        ball_rows = [
            (part.link, *ball) for part in parts if part.link > BASE_LINK and part.known for ball in _list_body_balls(part)
        ]
        self._radii = np.array([radius for _, _, radius in ball_rows])
        self._points = LinkPoints(
            np.array([link for link, _, _ in ball_rows]), np.array([centre for _, centre, _ in ball_rows]).reshape(-1, 3)
        )
        self._objects: list[tuple[PrimitiveSolid, float, BoolArray]] = []
        for index, solid in enumerate(() if obstacles is None else obstacles.cell):
            assert obstacles is not None
            is_ignored = obstacles.may_touch[self._points.link + 1, index] if len(ball_rows) else np.zeros(0, dtype=bool)
            self._objects += [(inner, obstacles.cell.margin_of(solid), is_ignored) for inner in inner_primitives(solid)]
        clearance = space.clearance
        self.self_blocked = None if clearance is None else BlockedBoxes(clearance, space.margin, (space.low, space.high))

    def restrict_to_joints(self, joints: IndexArray) -> BlockedCells:
        """Return this test without the balls that the other joints always move too far for a proof."""
        space, half_widths = self._space, (self._space.high - self._space.low) / 2
        half_widths[joints] = 0.0
        frames = space.arm.frames(space.sample(_SAMPLED_CONFIGURATIONS, np.random.default_rng(0)))
        is_useful = self._points.bound_motion(space.arm, frames, half_widths).min(axis=0) < self._radii + _MAX_PENETRATION_M
        restricted = copy(self)
        restricted._points = LinkPoints(self._points.link[is_useful], self._points.local_positions[is_useful])
        restricted._radii = self._radii[is_useful]
        restricted._objects = [(solid, margin, is_ignored[is_useful]) for solid, margin, is_ignored in self._objects]
        return restricted

    def are_blocked_without_objects(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where tool constraints or the arm itself block every configuration of cells, as in a call."""
        manifold, self_blocked, is_blocked = self._space.manifold, self.self_blocked, np.zeros(len(q), dtype=bool)
        if manifold is not None and len(q):
            is_blocked = manifold.exclude_boxes(q, half_widths[0])
        if self_blocked is not None:
            is_blocked[~is_blocked] = self_blocked.are_boxes_self_colliding(q[~is_blocked], half_widths[~is_blocked])
        return is_blocked

    def __call__(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where every configuration within ``half_widths`` (N, n), all rows equal, of q (N, n) is blocked."""
        space, is_blocked = self._space, self.are_blocked_without_objects(q, half_widths)
        if not self._objects or not len(self._radii):
            return is_blocked
        frames = space.arm.frames(q)
        positions = self._points.world_positions(frames)
        reach_bounds = self._points.bound_motion(space.arm, frames, half_widths[0], positions) - self._radii
        for solid, margin, is_ignored in self._objects:
            distances = np.where(is_ignored, np.inf, solid.signed_distance(positions) + reach_bounds)
            is_blocked |= distances.min(axis=1) < margin + space.margin - _ROUNDING_SLACK
        return is_blocked


def _list_body_balls(part: ArmBody) -> list[tuple[FloatArray, float]]:
    """Return centers (3,) in the frame of the link and radii, m, of balls inside a body, closer together in round bodies."""
    body = part.body
    centers, radii = body.inner_spheres
    if body.kind in ("capsule", "cylinder") and len(radii) > 1:
        centers = np.linspace(centers[0], centers[-1], _BALLS_PER_BODY)
        radii = np.full(_BALLS_PER_BODY, radii[0])
    return [
        (body.pose[:3, :3] @ center + body.pose[:3, 3], float(radius)) for center, radius in zip(centers, radii, strict=True)
    ]
