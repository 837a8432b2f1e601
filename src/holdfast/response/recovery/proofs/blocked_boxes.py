"""Boxes of joints in which the arm certainly collides, for a proof that a pose has no collision-free configuration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import casadi as ca
import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.machine import ArmData
from holdfast.model.collision.capsules import BASE_LINK
from holdfast.model.collision.changes import pair_lipschitz_bounds
from holdfast.model.collision.clearance import Clearance

if TYPE_CHECKING:
    from holdfast.model.collision.exact.narrow_phase import ArmBody


_ROUNDING_SLACK_M = 1e-9  # rounding error of distances, m
_CONTACT_TOLERANCE_M = 2e-6  # penetration of two links that the exact sign may miss, m
_MAX_HALF_WIDTH = 0.08  # rad and m: if half of the joints move more, hardly any link is in contact over the whole box


class BlockedBoxes:
    """Test whether boxes are blocked: at the middle, one body is deeper in another one than the joints can move it.

    The test with objects uses a ball within a link. From the link inwards, a point of the link is no farther from axis k than
    the link's origin plus the ball that encloses the link plus the motion by joints beyond k. The test of two links uses their
    capsules if the collision model has only these, else balls within the two bodies, and the largest change of their distance
    by each joint (:func:`holdfast.model.collision.changes.pair_lipschitz_bounds`).

    Args:
        clearance: Collision model of an arm, with or without a cell.
        margin: Clearance in addition to the margins of the cell's objects, m.
        limits: (n,) and (n,) limits that contain all boxes, rad and m. Default: the arm's limits.
    """

    def __init__(self, clearance: Clearance, margin: float, limits: tuple[FloatArray, FloatArray] | None = None) -> None:
        obstacles, (self._inner_model, solids) = clearance.obstacles, clearance.exactness.inner_objects_and_sources
        self._arm, self._object_names, self._blockers = clearance.arm, [solid.name for solid in solids], set[str]()
        self._margins = np.array([margin + obstacles.cell.margin_of(solid) for solid in solids]) if obstacles else np.zeros(0)
        balls = self._inner_model.spheres
        self._links = np.unique(balls.link[balls.link > BASE_LINK])
        extents = np.linalg.norm(balls.center, axis=1) + balls.radius
        link_extents = np.array([extents[balls.link == link].max() for link in self._links])
        if self._links.size and self._margins.size:
            self._motion_kernel = _link_motion_kernel(self._arm, self._links, link_extents)
        self._self_clearance, self._margin = clearance.self_only, margin
        self._self_pairs = _find_self_pairs(clearance, limits or sampling_limits(self._arm))

    def __call__(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where every configuration within ``half_widths`` (N, n) of q (N, n) is blocked."""
        is_blocked = np.zeros(len(q), dtype=bool)
        indices = np.flatnonzero((half_widths < _MAX_HALF_WIDTH).sum(axis=1) > half_widths.shape[1] // 2)
        if self._self_pairs:
            is_blocked[indices] = self.are_boxes_self_colliding(q[indices], half_widths[indices])
        if self._links.size and self._margins.size:
            indices = indices[~is_blocked[indices]]
            is_blocked[indices] = self._are_boxes_hitting_objects(q[indices], half_widths[indices])
        return is_blocked

    def are_boxes_self_colliding(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where every configuration within ``half_widths`` (N, n) of q (N, n) is blocked by the arm alone."""
        is_blocked, distances = np.zeros(len(q), dtype=bool), self._self_clearance.by_pair(q)
        near = np.flatnonzero((distances < self._margin).any(axis=1))
        distances, frames = distances[near], self._arm.frames(q[near])
        for pair in self._self_pairs:
            indices = np.flatnonzero((distances[:, pair.columns].min(axis=1) < self._margin) & ~is_blocked[near])
            if not indices.size:
                continue
            max_distances = self._margin - _CONTACT_TOLERANCE_M - half_widths[near[indices]] @ pair.lipschitz_bounds.T
            is_deep = pair.are_nearer(frames[indices], distances[indices], max_distances)
            is_blocked[near[indices]] = is_deep
            if is_deep.any():
                self._blockers.add(pair.name)
        return is_blocked

    def _are_boxes_hitting_objects(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        is_blocked = np.zeros(len(q), dtype=bool)
        indices = np.flatnonzero(self._inner_model.smallest_distance(q) < self._margins.max() - _ROUNDING_SLACK_M)
        margins = self._inner_model.link_distances(q[indices]) - self._margins
        nearest, least_margins = margins.argmin(axis=2), margins.min(axis=2)
        max_motions = self._motion_kernel.rows(q[indices], half_widths[indices])
        is_deep = least_margins + max_motions < -_ROUNDING_SLACK_M
        is_blocked[indices] = is_deep.any(axis=1)
        self._blockers |= {self._object_names[index] for index in np.unique(nearest[is_deep])}
        return is_blocked

    @property
    def blocker_names(self) -> str:
        """Names of the objects and the pairs of links that blocked a box so far."""
        return ", ".join(sorted(self._blockers))


@cached_kernel
def _link_motion_kernel(arm: ArmData, links: IndexArray, extents: FloatArray) -> Kernel:
    """Compile the largest motion of each of ``links``, m, within half widths (n,) around a configuration (n,).

    Args:
        arm: Arm model.
        links: (L,) index from 0 of the joint that moves each link.
        extents: (L,) largest distance of a point of each link from its frame, m.
    """
    q, half_widths = kinematics.joint_symbols(arm), ca.SX.sym("half_widths", arm.n)
    frames, _ = kinematics.body_and_joint_frames(arm, kinematics.joint_transforms(arm, q))
    axes = [frames[index + 1][0] @ kinematics.constant_matrix(joint.axis) for index, joint in enumerate(arm.joints)]
    motions = []
    for link, extent in zip(links.tolist(), extents.tolist(), strict=True):
        motion = ca.SX(0.0)
        for index in range(link, -1, -1):
            offset = ca.cross(frames[link + 1][1] - frames[index + 1][1], axes[index])
            radius = 1.0 if arm.joints[index].prismatic else ca.norm_2(offset) + extent + motion
            motion = motion + radius * half_widths[index]
        motions.append(motion)
    return Kernel("largest motions of links", [q, half_widths], [ca.vertcat(*motions)])


@dataclass(frozen=True, eq=False)
class _SelfCollisionPair:
    """Two links of the arm.

    Attributes:
        name: Name of their first pair.
        columns: Indices of their pairs in the collision model.
        lipschitz_bounds: (K, n) largest change of each of K distances per rad or m of each joint.
        balls: Indices of both links, (K,) sums of the radii of two balls within them, and (17, K) weights of the squared
            distances of their centers (:func:`_squared_distance_weights`); None if the distances are those of the pairs.
    """

    name: str
    columns: list[int]
    lipschitz_bounds: FloatArray
    balls: tuple[int, int, FloatArray, FloatArray] | None = None

    def are_nearer(self, frames: FloatArray, pair_distances: FloatArray, max_distances: FloatArray) -> BoolArray:
        """Return (N,) True where a distance is below its maximum (N, K), from frames of links and distances of pairs (N, P)."""
        if self.balls is None:
            return np.asarray((pair_distances[:, self.columns] < max_distances).any(axis=1))
        first_link, second_link, radii, weights = self.balls
        first, second = frames[:, first_link + 1], frames[:, second_link + 1]
        rotation = second[:, :3, :3].transpose(0, 2, 1) @ first[:, :3, :3]
        position = (first[:, None, :3, 3] - second[:, None, :3, 3]) @ second[:, :3, :3]
        features = [rotation, position @ rotation, position, position @ position.transpose(0, 2, 1), np.ones((len(frames), 1))]
        squared_distances = np.concatenate([part.reshape(len(frames), -1) for part in features], axis=1) @ weights
        max_distances = max_distances + radii
        return np.asarray(((max_distances > 0) & (squared_distances < max_distances * max_distances)).any(axis=1))


def _squared_distance_weights(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the weights (17, K) of ``|R a + t - b|^2`` for a, b (K, 3): of R, R't, t, |t|^2, and 1."""
    products = -2 * second[:, :, None] * first[:, None, :]
    constant = np.square(first).sum(axis=1) + np.square(second).sum(axis=1)
    return np.concatenate([products.reshape(-1, 9).T, 2 * first.T, -2 * second.T, np.ones((1, len(first))), constant[None]])


def _find_self_pairs(clearance: Clearance, limits: tuple[FloatArray, FloatArray]) -> list[_SelfCollisionPair]:
    """Return the links that may touch each other, with balls that are certainly inside them."""
    self_pairs, arm, capsules = [], clearance.arm, clearance.capsules
    if capsules.shape is None:
        lipschitz_bounds, arm_capsule_count = clearance.self_only.lipschitz_bounds(*limits), len(capsules) - capsules.held
        parts_known = clearance.exactness.are_all_shapes_known
        indices = [index for index, pair in enumerate(clearance.pairs) if parts_known and max(pair) < arm_capsule_count]
        return [_SelfCollisionPair(clearance.pair_names[index], [index], lipschitz_bounds[[index]]) for index in indices]
    parts = clearance.exactness.parts
    for columns, bodies in clearance.exactness.self_collision_pairs:
        ball_pairs = [
            (*first_ball, *second_ball)
            for a, b in bodies
            if columns and parts[a].known and parts[b].known and not (parts[a].held or parts[b].held)
            for first_ball in _list_inner_balls(parts[a])
            for second_ball in _list_inner_balls(parts[b])
        ]
        if ball_pairs:
            first_centers, first_radii, second_centers, second_radii = map(np.array, zip(*ball_pairs, strict=True))
            links = parts[bodies[0][0]].link, parts[bodies[0][1]].link
            distances = np.linalg.norm([first_centers, second_centers], axis=2).T
            lipschitz_bounds = pair_lipschitz_bounds(arm, np.tile(links, (len(distances), 1)), distances, *limits)
            balls = (*links, first_radii + second_radii, _squared_distance_weights(first_centers, second_centers))
            self_pairs.append(_SelfCollisionPair(clearance.pair_names[columns[0]], columns, lipschitz_bounds, balls))
    return self_pairs


def _list_inner_balls(part: ArmBody) -> list[tuple[FloatArray, float]]:
    """Return the centers (3,) in the frame of the link and the radii, m, of balls inside a body."""
    centers, radii = part.body.inner_spheres
    centers = centers @ part.body.pose[:3, :3].T + part.body.pose[:3, 3]
    return list(zip(centers, radii.tolist(), strict=True))
