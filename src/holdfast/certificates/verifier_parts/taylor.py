"""Enclosures of numbers over boxes, from exact first and second derivatives at the center, for all claims except structural
zeros.

For most claims the numbers are the error between the tool and the tool of another chain: position rows, then rotation rows. The
rows of a rotation are <W, E>, the sum of products of entries, where E is the rotation from the other tool to the first and W
are fixed matrices. For a pose the rows are the axial part (E - E')/2, in the plane its third row. If only the tool's axis
matters, they are the differences of both axes along two fixed transverse vectors. With axis a before b in the chain, the first
derivatives of E are [a]E, and the second ones [a][b]E; the joints of the other chain enter in reverse order.
A last row is cos(angle) - 1 of the remaining rotation. The other rows are 0 for half a turn as well, and this row excludes it.

Let the columns of D describe how joints follow the position in a box and a section variable s. This bounds |g - s|, with the
rows g, by e(S) over the box and a section box of half widths S. If e(S) <= S, the map s -> s - g maps the section box into
itself, so by Brouwer's theorem g = 0 for some s. Any D is valid, but D decides whether e(S) <= S.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from .balls import MIN_ROUNDING, ROUND_UP, Array, BallArray, Flags, concatenate, cross_matrix, einsum
from .chain import BallChain, PointKinematics
from .forms import TASK_FORMS

MIN_COSINE_ROW = -0.05  # least value of the last row, for which the remaining angle is at most 0.32 rad
MAX_ROTATION_CHANGE_RAD = 1.5  # rad: largest change of this angle; their sum is less than half a turn
CROSS_MATRICES = np.cross(np.eye(3)[:, None], np.eye(3)).transpose(0, 2, 1)  # [e_l], (3, 3, 3)


class DerivativeEnclosure:
    """Enclosure of numbers (N, a), their gradients (N, a, V) and their symmetric second derivatives (N, a, V, V)."""

    def __init__(self, value: BallArray, slopes: BallArray, second: BallArray) -> None:
        self.value, self.slopes, self.second = value, slopes, second

    def select(self, key: Any) -> DerivativeEnclosure:
        """Select some of the numbers."""
        return DerivativeEnclosure(self.value[:, key], self.slopes[:, key], self.second[:, key])

    def substitute_columns(self, columns: BallArray, offsets: Array) -> DerivativeEnclosure:
        """Substitute columns D (N, V, C) for the variables, and subtract ``offsets`` (a, C) from the gradients."""
        second = einsum("nki,nakj->naij", columns, einsum("nakl,nlj->nakj", self.second, columns))
        return DerivativeEnclosure(self.value, einsum("nak,nkc->nac", self.slopes, columns) + -offsets, second)

    def combine_rows(self, weights: BallArray) -> DerivativeEnclosure:
        """Combine the numbers with weights e (N, a) into one number."""
        value, gradients = einsum("na,na->n", weights, self.value), einsum("na,nak->nk", weights, self.slopes)
        return DerivativeEnclosure(value[:, None], gradients[:, None], einsum("na,najk->njk", weights, self.second)[:, None])

    @cached_property
    def gradient_magnitude(self) -> Array:
        """Upper bounds of the absolute gradients."""
        return self.slopes.magnitude

    @cached_property
    def curvature_magnitude(self) -> Array:
        """Upper bounds of the absolute second derivatives."""
        return self.second.magnitude

    @cached_property
    def mixed_curvature(self) -> Array:
        """Upper bounds of the absolute mixed second derivatives, each pair once."""
        return np.triu(self.curvature_magnitude, 1)

    @cached_property
    def own_curvature(self) -> tuple[Array, Array]:
        """Lower bounds of the second derivatives by a single variable, and of their negatives."""
        lower, upper = (np.diagonal(balls.lower, axis1=2, axis2=3) for balls in (self.second, -self.second))
        return lower, upper

    def bound_decrease_and_increase(self, half: Array) -> list[Array]:
        """Bound the decrease and the increase of the numbers within half widths (N, V), to second order."""
        h, changes = half[:, None], list[Array]()
        mixed_terms = ((self.mixed_curvature @ h[..., None])[..., 0] * h).sum(axis=2)
        for curvature in self.own_curvature:
            slopes = self.gradient_magnitude
            own_terms = np.where(slopes < curvature * h, slopes**2 / (2 * curvature), slopes * h - curvature * h**2 / 2)
            changes.append((own_terms.sum(axis=2) + mixed_terms) * ROUND_UP + MIN_ROUNDING)
        return changes

    def bound_magnitude(self, half: Array, remainder: Array) -> Array:
        """Bound the absolute values of the numbers, with the remainder after second order."""
        (decrease, increase), value = (
            ((change + remainder) * ROUND_UP for change in self.bound_decrease_and_increase(half)),
            self.value,
        )
        upper = np.nextafter(value.center + value.radius, np.inf) + increase
        lower = np.nextafter(value.radius - value.center, np.inf) + decrease
        return np.nextafter(np.maximum(upper, lower), np.inf) + MIN_ROUNDING


class TaskErrorEnclosure(DerivativeEnclosure):
    """Task rows of the tool of one chain relative to the tool of another.

    The variables are the joints of the first chain, then those of the second in reverse order.
    """

    def __init__(self, task: str, arm: BallChain, joints: list[Array], goal: BallChain, places: list[Array]) -> None:
        self.linear, turning, _ = TASK_FORMS[task]
        self.m, self.uses_rotation = self.linear + turning, turning > 0
        arm_point, goal_point = arm.enclose_point(joints), goal.enclose_point(places)
        self.chains = [(x, np.stack([joint[:, 0] for joint in values], 1)) for x, values in ((arm, joints), (goal, places))]
        arm_vectors, goal_vectors = ((x, x.columns, x.tip) for x in (arm_point, goal_point))
        parts = [enclose_difference(*arm_vectors, *goal_vectors).select(slice(self.linear))]
        if turning == 2:
            arm_axis, goal_axis = arm_point.rotation[:, :, 2], goal_point.rotation[:, :, 2]
            columns = (
                einsum("nkij,nj->nki", cross_matrix(tool.spin_axes), axis)
                for tool, axis in ((arm_point, arm_axis), (goal_point, goal_axis))
            )
            axis = enclose_difference(arm_point, next(columns), arm_axis, goal_point, next(columns), goal_axis)
            transverse = goal_point.rotation.center
            gradients = einsum("nir,nij->nrj", transverse, axis.slopes)
            second = einsum("nir,nijk->nrjk", transverse, axis.second)
            parts.append(DerivativeEnclosure(einsum("nir,ni->nr", transverse, axis.value), gradients, second))
        elif turning:
            rotation = einsum("nij,nkj->nik", arm_point.rotation, goal_point.rotation)
            spin_axes = concatenate(1, arm_point.spin_axes, -einsum("nij,nkj->nki", rotation, goal_point.spin_axes)[:, ::-1])
            weights = np.concatenate([CROSS_MATRICES[3 - turning :] / 2, [np.eye(3) / 2]])
            moves = np.einsum("lik,rij->rlkj", CROSS_MATRICES, weights)  # the product of this with E is <W, [e_l]E>
            value = einsum("rij,nij->nr", weights, rotation) + -np.append(np.zeros(turning), 1.5)
            second_map = einsum("rlkj,nbkj->nrbl", moves, einsum("nbik,nkj->nbij", cross_matrix(spin_axes), rotation))
            gradients = einsum("nrl,nal->nra", einsum("rlkj,nkj->nrl", moves, rotation), spin_axes)
            parts.append(
                DerivativeEnclosure(value, gradients, einsum("nrbl,nal->nrab", second_map, spin_axes).mirror_upper_triangle())
            )
        super().__init__(*(concatenate(1, *[getattr(x, key) for x in parts]) for key in ("value", "slopes", "second")))

    def split_by_chain(self, values: Array) -> list[tuple[BallChain, Array, Array]]:
        """Split values for each variable (N, V, ...) into those of the joints of each chain, and return them with the chain."""
        n = self.chains[0][0].n
        travels = values[:, :n], values[:, : n - 1 : -1]
        return [(chain, slide_extent, part) for (chain, slide_extent), part in zip(self.chains, travels, strict=True)]

    def bound_remainder_and_angle(self, joint_travel: Array) -> tuple[Array, Array]:
        """Bound the remainder of each row after second order, and the rotation angle, for a joint travel (N, V)."""
        parts = self.split_by_chain(joint_travel)
        third = (
            sum(chain.bound_derivative(3, travel, chain.link_lengths, slide_extent) for chain, slide_extent, travel in parts)
            / 6
            * ROUND_UP
        )
        angle = sum((travel * ~chain.slides).sum(axis=1) for chain, _, travel in parts) * ROUND_UP
        rotation_rows = self.value.center.shape[1] - self.linear
        return np.stack([third] * self.linear + [angle**3 / 6 * ROUND_UP] * rotation_rows, axis=1), angle


class InvariantSectionBoxes:
    """Boxes of positions and sections with half widths (N, C), whose last m, the section, s -> s - g maps into itself."""

    def __init__(self, error: TaskErrorEnclosure, d: BallArray, column_offsets: Array, half_widths: Array) -> None:
        self.error, self.half_widths, self.response, self.m = error, half_widths, d.magnitude, error.m
        offsets = column_offsets.copy()
        offsets[:, -self.m :] += np.eye(self.m)
        self.form, s = error.select(slice(self.m)).substitute_columns(d, offsets), half_widths[:, -self.m :]
        for _ in range(38):
            closed = self.update_bounds()
            if closed.all():
                break
            s[:] = np.where(closed[:, None], s, 1.05 * self.excess + 1e-9)
        for _ in range(8):  # e grows with S, so slightly more than e(S) is tried as the next box
            self.update_bounds()
            if (self.excess[closed] > 0.999999 * s[closed]).all():
                break
            s[:] = np.where(closed[:, None], np.minimum(s, self.excess * (1 + 1e-9)), s)
        is_regular = (error.value.lower[:, -1] > MIN_COSINE_ROW) & (self.angle < MAX_ROTATION_CHANGE_RAD)
        self.is_proved = closed & self.update_bounds() & (is_regular | (not error.uses_rotation))

    def update_bounds(self) -> Flags:
        """Update e(S), the joint travel and the rotation of the tool, rounded up, and return the mask of e(S) <= S."""
        self.joint_travel = np.einsum("nkc,nc->nk", self.response, self.half_widths) * ROUND_UP
        remainder, self.angle = self.error.bound_remainder_and_angle(self.joint_travel)
        self.excess, s = self.form.bound_magnitude(self.half_widths, remainder[:, : self.m]), self.half_widths[:, -self.m :]
        return np.asarray(((self.excess <= s) & (s < 1e3)).all(axis=1))

    def is_within_limits(self, q: BallArray, limits: Array, free: list[int]) -> Flags:
        """Return a mask of the boxes in which the free joints stay within limits (n, 2), starting from the middles (N, n)."""
        joint_travel = self.joint_travel[:, : q.center.shape[1]]
        lower, upper = np.nextafter(q.lower - joint_travel, -np.inf), np.nextafter(-(-q).lower + joint_travel, np.inf)
        return np.asarray(((lower >= limits[:, 0]) & (upper <= limits[:, 1]))[:, free].all(axis=1))


def enclose_difference(
    point: PointKinematics,
    columns: BallArray,
    vector: BallArray,
    other_point: PointKinematics,
    other_columns: BallArray,
    other_vector: BallArray,
) -> DerivativeEnclosure:
    """Enclose the difference (N, 3) of vectors of two chains, by the joints of the first, then the second in reverse order."""
    (gradients, second), (other_gradients, other_second) = (
        vector_derivatives(*vectors) for vectors in ((point.spin_axes, columns), (other_point.spin_axes, other_columns))
    )
    n, v = columns.center.shape[1], columns.center.shape[1] + other_columns.center.shape[1]
    arrays = [np.zeros((len(vector.center), 3, v, v)) for _ in range(2)]
    for array, own_block, other_block in (
        (arrays[0], second.center, -other_second.center),
        (arrays[1], second.radius, other_second.radius),
    ):
        array[:, :, :n, :n], array[:, :, n:, n:] = own_block, other_block[:, :, ::-1, ::-1]
    return DerivativeEnclosure(
        vector + -other_vector, concatenate(2, gradients, -other_gradients[:, :, ::-1]), BallArray(*arrays)
    )


def vector_derivatives(spin_axes: BallArray, columns: BallArray) -> tuple[BallArray, BallArray]:
    """Return the gradients (N, 3, V) of a vector and its second derivatives (N, 3, V, V), z_a x J_b for a and a later b."""
    return columns.transpose(0, 2, 1), einsum("nari,nbi->nrab", cross_matrix(spin_axes), columns).mirror_upper_triangle()
