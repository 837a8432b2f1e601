"""Bounds of the distance between a point of a link and a target over boxes of joints and targets, in doubles, for batches.

Along any direction e the distance is at least e.(y - x). Its first and second derivatives at the centre of a box are exact, and
the lengths that joints carry bound the third. The greatest distance is bounded through half its square. The numbers here have
no error bounds; the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.certificates.taylor import CertificateChain, link_lengths
from holdfast.core.typing import BoolArray, FloatArray

_ON_AXIS_TOLERANCE_M = 1e-9  # m: largest distance of a point from an axis on which it lies


@dataclass(frozen=True, eq=False)
class ChainSegment:
    """Segment of k successive joints of a chain, from a link, in whose frame coordinates are given, to a point of a later link.

    Attributes:
        rotations: (k, 3, 3) rotation of each joint's frame in the previous frame.
        origins: (k, 3) origin of each joint's frame in the previous frame, m.
        end: (3,) point in the last of these frames, m.
        lengths: (k,) lengths, m, that each joint and the joints before it rotate, but the next one does not; for a prismatic
            joint without its value.
        slides: (k,) True for prismatic joints.
    """

    rotations: FloatArray
    origins: FloatArray
    end: FloatArray
    lengths: FloatArray
    slides: BoolArray

    @classmethod
    def from_chain(cls, chain: CertificateChain, first: int, last: int, end: FloatArray) -> ChainSegment:
        """Make the segment of the joints ``first`` to ``last - 1`` of a chain."""
        rotations, slides = chain.rotations[first:last], chain.slides[first:last]
        lengths = link_lengths(rotations, [*chain.origins[first + 1 : last], end], slides)
        return cls(rotations, chain.origins[first:last], np.asarray(end), lengths, slides)

    def point_axes_and_derivatives(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return point (N, 3), rotation axes (N, k, 3), 0 for prismatic joints, and point derivatives (N, k, 3) at q (N, k)."""
        tip, axes, origins = self.locate_point_and_axes(q)
        rotary_columns = np.cross(axes, tip[:, None] - origins)
        return tip, axes * ~self.slides[:, None], np.where(self.slides[:, None], axes, rotary_columns)

    def locate_point_and_axes(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the point (N, 3), the joint axes (N, k, 3) and points on these axes (N, k, 3) at q (N, k)."""
        count, joint_count = q.shape
        rotation, tip = np.broadcast_to(np.eye(3), (count, 3, 3)), np.zeros((count, 3))
        axes, origins = np.zeros((count, joint_count, 3)), np.zeros((count, joint_count, 3))
        cosines, sines = np.cos(q), np.sin(q)
        for joint in range(joint_count):
            tip = tip + rotation @ self.origins[joint]
            rotation = rotation @ self.rotations[joint]
            axes[:, joint], origins[:, joint] = rotation[:, :, 2], tip
            if self.slides[joint]:
                tip = tip + axes[:, joint] * q[:, joint, None]
                continue
            x, y = rotation[:, :, 0], rotation[:, :, 1]
            c, s = cosines[:, joint, None], sines[:, joint, None]
            rotation = np.stack([c * x + s * y, c * y - s * x, rotation[:, :, 2]], axis=2)
        tip = tip + rotation @ self.end
        return tip, axes, origins

    def count_leading_axes_through(self, point: FloatArray) -> int:
        """Return the number of first joints whose axes pass through a point (3,) and so do not change its distance."""
        rotation, origin = np.eye(3), np.zeros(3)
        for index in range(len(self.lengths)):
            origin = origin + rotation @ self.origins[index]
            rotation = rotation @ self.rotations[index]
            if self.slides[index] or np.linalg.norm(np.cross(rotation[:, 2], point - origin)) > _ON_AXIS_TOLERANCE_M:
                return index
        return len(self.lengths)

    def _derivative_bounds(self, q: FloatArray, half: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return bounds (3, N) of three derivatives of the point, and joint contributions (N, k) to the third."""
        c, slide_range = np.cumsum(half * ~self.slides, axis=1), half * self.slides
        max_lengths = self.lengths + np.abs(q) * self.slides + slide_range
        orders = np.array([(c**k * max_lengths + k * c ** (k - 1) * slide_range).sum(axis=1) for k in (1, 2, 3)])
        later = np.cumsum((3 * c**2 * max_lengths + 6 * c * slide_range)[:, ::-1], axis=1)[:, ::-1]  # with the joint itself
        return orders, np.where(self.slides, c**3 + 3 * c**2, later) * half

    def lower_distance_bound(
        self, q: FloatArray, half: FloatArray, targets: FloatArray, target_half: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Bound the distance of the point from targets x +- target_half (N, 3) from below, over q +- half (N, k).

        Returns:
            Bounds (N,) of the distance, lower bounds (N,) of the distance of the middles, and the reductions (N, k + 3) by each
            joint and target coordinate.
        """
        tip, axes, columns = self.point_axes_and_derivatives(q)
        v = tip - targets
        d = np.maximum(np.linalg.norm(v, axis=1), 1e-300)
        carried, third_costs = self._derivative_bounds(q, half)
        third = carried[2] / 6
        spans = columns * half[:, :, None]
        spread = np.einsum("nka,nkb->nab", spans, spans)
        spread[:, range(3), range(3)] += target_half**2 + 1e-6 * d[:, None] ** 2
        fisher = np.linalg.solve(spread, v[:, :, None])[:, :, 0]
        bounds = list[tuple[FloatArray, FloatArray, FloatArray]]()
        for direction in (v / d[:, None], fisher / np.maximum(np.linalg.norm(fisher, axis=1), 1e-300)[:, None]):
            gradient = np.abs(np.einsum("na,nka->nk", direction, columns))
            second = np.einsum("nja,nka->njk", np.cross(direction[:, None], axes), columns)
            own_costs, pair_costs = curvature_costs(gradient, second, half)
            target_costs = np.abs(direction) * target_half
            center_distance = np.einsum("na,na->n", direction, v)
            bound = center_distance - own_costs.sum(axis=1) - pair_costs.sum(axis=1) / 2 - third - target_costs.sum(axis=1)
            axis_costs = np.concatenate([own_costs + pair_costs + third_costs / 6, target_costs], axis=1)
            bounds.append((bound, center_distance, axis_costs))
        improved = bounds[1][0] > bounds[0][0]
        bound, center_distance = (np.where(improved, bounds[1][index], bounds[0][index]) for index in (0, 1))
        return bound, center_distance, np.where(improved[:, None], bounds[1][2], bounds[0][2])

    def upper_distance_bound(
        self, q: FloatArray, half: FloatArray, targets: FloatArray, target_half: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Bound the distance from above, with arguments and results in the form of :meth:`lower_distance_bound`."""
        tip, axes, columns = self.point_axes_and_derivatives(q)
        count, joint_count = q.shape
        v = tip - targets
        d = np.linalg.norm(v, axis=1)
        (v1, v2, v3), third_costs = self._derivative_bounds(q, half)
        v1 = v1 + np.linalg.norm(target_half, axis=1)
        third = (3 * v1 * v2 + (d + v1) * v3) / 6
        half_widths = np.concatenate([half, target_half], axis=1)
        all_columns = np.concatenate([columns, np.broadcast_to(-np.eye(3), (count, 3, 3))], axis=1)
        second = np.einsum("nja,nka->njk", all_columns, all_columns)
        second[:, :joint_count, :joint_count] += np.einsum("nja,nka->njk", np.cross(v[:, None], axes), columns)
        own_costs, pair_costs = curvature_costs(np.abs(np.einsum("na,nka->nk", v, all_columns)), -second, half_widths)
        bound = d**2 / 2 + own_costs.sum(axis=1) + pair_costs.sum(axis=1) / 2 + third
        axis_costs = own_costs + pair_costs
        axis_costs[:, :joint_count] += (d + v1)[:, None] * third_costs / 6
        return np.sqrt(2 * bound), d, axis_costs


def limit_to_one_turn(limits: FloatArray, slides: BoolArray) -> FloatArray:
    """Return limits (n, 2), rad and m, with ranges of revolute joints of at most one full turn."""
    half_turn, limits = np.nextafter(np.pi, 4), limits.copy()
    limits[~slides & (limits[:, 1] - limits[:, 0] >= 2 * np.pi)] = -half_turn, half_turn
    return limits


def find_axis_points(chain: CertificateChain, joints: FloatArray, rng: np.random.Generator) -> list[tuple[int, FloatArray]]:
    """Return pairs of a link and a point (3,) of the next axis that is closest to the axis behind it.

    If the next joint is prismatic, there is no such point, because the joint moves every point of its axis.
    """
    n, axis_points = len(chain.lengths), list[tuple[int, FloatArray]]()
    q, previous = rng.uniform(joints[:, 0], joints[:, 1], (8, n)), np.full((8, 3), np.inf)
    for joint in np.flatnonzero(~chain.slides).tolist():
        heights = chain.closest_points_on_axes(joint) if joint + 1 < n else None
        # For parallel axes, and for the last axis, take the height of the next frame.
        point = chain.origins[joint] + chain.rotations[joint][:, 2] * (heights[0] if heights else chain.origins[joint + 1][2])
        positions = ChainSegment.from_chain(chain, 0, joint, point).point_axes_and_derivatives(q[:, :joint])[0]
        if np.abs(positions - previous).max() > 1e-6:
            axis_points.append((joint, point))
        previous = positions
    return axis_points


def curvature_costs(gradient: FloatArray, second: FloatArray, half: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the cost (N, k) of gradient and own curvature of each variable, and its contribution (N, k) to all pairs.

    Half of the sum of the contributions is the cost of all pairs.

    Args:
        gradient: (N, k) magnitudes of the gradient.
        second: (N, k, k) second derivatives, of which those for j <= k are used.
        half: (N, k) half widths.
    """
    curvature = np.diagonal(second, axis1=1, axis2=2)
    at_end = gradient * half - curvature * half**2 / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        own_costs = np.where(gradient < curvature * half, gradient**2 / (2 * curvature), at_end)
    pair_costs = np.triu(np.abs(second), 1) * half[:, :, None] * half[:, None]
    return own_costs, pair_costs.sum(axis=1) + pair_costs.sum(axis=2)
