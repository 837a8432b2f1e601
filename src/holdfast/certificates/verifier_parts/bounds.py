"""Verification of the leaves of upper and lower bounds of relative manipulability.

With the moments a_l of any wrench about the axes, relative manipulability after a lock of joint k is at most
sqrt(A / (A + a_k^2)), where A is the sum of the other a_l^2. In each leaf of a ceiling, a wrench that is affine in the joints
proves this for some k. The axes are expressed in the frame of a middle link, so the first and the last joint do not matter.

In each leaf of a floor there is a joint motion x = nu + N (q - q_c) + P s that keeps the tool still for some s (by Brouwer's
theorem). Relative manipulability after a lock of joint k is then at least |x_k| / |x|.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from .balls import (
    MIN_ROUNDING,
    ROUND_UP,
    Array,
    BallArray,
    Flags,
    bound_length,
    concatenate,
    cross_matrix,
    einsum,
    flint,
    round_up,
    solve_or_nan,
    stack_second,
)
from .chain import BallChain, Leaf, LeafVerifier, enclose_configuration, read_bisection
from .forms import NUMBER_PATTERN, TEXT_PATTERN, format_intervals, parse_hex, require, require_revolute
from .taylor import DerivativeEnclosure
from .tree import FIRST_LOCK_TOKEN, Cell

SCREW_ROWS = {"pose": [0, 1, 2, 3, 4, 5], "planar-pose": [2, 3, 4]}  # rows of a screw in the task


class ScrewEnclosure:
    """Enclosure of the axes, and of their moments about a point on the middle axis, in the frame of the middle link.

    Joints are ordered from the middle to the tool, then from the middle to the base. The derivative of screw l by a joint j
    that is nearer to the middle is the bracket of screws j and l, and so on for further derivatives. Before the middle the sign
    is opposite.
    """

    def __init__(self, arm: BallChain, joints: list[Array]) -> None:
        n, middle = arm.n, arm.n // 2
        self.order, kinematics = [*range(middle, n), *range(middle - 1, -1, -1)], arm.enclose_point(joints)
        self.half = np.stack([joints[joint][:, 2] for joint in self.order], 1)
        self.side = np.array([1.0] * (n - middle) + [-1.0] * middle)
        self.same_side = 1.0 * (self.side[:, None] == self.side)
        self.moves = np.tril(self.same_side, -1)  # derivative of axis l by joint j
        z, axis_points, previous = kinematics.axes[:, self.order], list[BallArray](), kinematics.tip
        links = np.zeros(self.half.shape)
        for index, joint in enumerate(self.order):  # any point of an axis is valid; a point near the previous one is chosen
            previous, points = axis_points[0] if index == n - middle else previous, kinematics.points[:, joint]
            axis_offset = np.nan_to_num(((previous.center - points.center) * z.center[:, index]).sum(axis=1))
            axis_points.append(points + einsum("n,na->na", axis_offset, z[:, index]))
            links[:, index], previous = bound_length((axis_points[index] + -previous).magnitude), axis_points[index]
        offsets = stack_second(axis_points) + -axis_points[0][:, None]
        moments = einsum("nlij,nlj->nli", cross_matrix(offsets), z)
        spin, shift, zeros = cross_matrix(z), cross_matrix(moments), BallArray(np.zeros((*z.center.shape, 3)))
        self.screws = concatenate(2, z, moments)
        self.operators = concatenate(2, concatenate(3, spin, zeros), concatenate(3, shift, spin))
        # (N, j, l, 6); the second derivative by i and j is the bracket with screw i.
        self.brackets = einsum("njab,nlb->njla", self.operators, self.screws).multiply_signs(self.moves.T[:, :, None])
        # A link on the path to an axis moves with the joints between the middle and the link.
        c = self.half @ self.moves.T
        first_sum, second_sum, third_sum = ((links * c**power) @ (self.moves + np.eye(n)).T for power in (1, 2, 3))
        distances = bound_length(offsets.magnitude, 2) + first_sum
        remainders = [
            (c**2, second_sum + 2 * first_sum * c + distances * c**2),
            (c**3 / 3, (third_sum + 3 * second_sum * c + 3 * first_sum * c**2 + distances * c**3) / 3),
        ]
        # Upper bounds (N, n, 6) of the terms after first order and after second order.
        self.second_remainder, self.third_remainder = (
            np.stack([axis_part] * 3 + [moment_part] * 3, 2) / 2 * ROUND_UP + MIN_ROUNDING
            for axis_part, moment_part in remainders
        )


class CeilingVerifier(LeafVerifier):
    """Verifier of an upper bound of relative manipulability; each leaf has a joint whose lock reduces it enough."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document, document["joint_box"])
        self.arm = BallChain(document["arm"], document["task"] == "planar-pose")
        self.threshold = parse_hex(document["threshold"])
        self.screw_rows = SCREW_ROWS[document["task"]]
        self.locks = document["locks"]

    def read_leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """Return the number of leaves, the undecided cells, and an iterator of leaves with their joint (0 for a floor)."""
        tokens = {FIRST_LOCK_TOKEN + lock for lock in self.locks} if document["kind"] == "ceiling" else {0}
        return read_bisection(document, self.arm.n, tokens)

    def verify_leaves(self, kind: int, leaves: list[Leaf]) -> Flags:
        """Return a mask of the leaves in which a lock of joint ``kind`` reduces relative manipulability enough."""
        screws, threshold = ScrewEnclosure(self.arm, self.enclose_centers(cell for cell, _ in leaves)), self.threshold
        position = screws.order.index(kind)
        half = screws.half
        moves = screws.brackets.multiply_signs(screws.side[:, None, None])
        y, wrench_rate = self.choose_wrench(screws, position)
        gradients = einsum("njla,na->nlj", moves, y) + einsum("nla,naj->nlj", screws.screws, wrench_rate)
        cross_terms = einsum("nai,njla->nlij", wrench_rate, moves)
        second_brackets = einsum("nib,njlb->nlij", einsum("niab,na->nib", screws.operators, y), screws.brackets).multiply_signs(
            screws.moves[:, :, None]
        )
        second = second_brackets.mirror_upper_triangle() + cross_terms + cross_terms.transpose(0, 1, 3, 2)
        form = DerivativeEnclosure(einsum("nla,na->nl", screws.screws, y), gradients, second)
        remainder = sum(
            (bound_length(wrench_rate[:, part]) * half).sum(axis=1)[:, None] * screws.second_remainder[:, :, part.start]
            + bound_length(y[:, part])[:, None] * screws.third_remainder[:, :, part.start]
            for part in (slice(0, 3), slice(3, 6))
        )
        moments = form.bound_magnitude(half, remainder)
        own_moment = np.maximum(
            np.nextafter(form.value.lower - (form.bound_decrease_and_increase(half)[0] + remainder) * ROUND_UP, -np.inf)[
                :, position
            ],
            0,
        )
        moments[:, position] = 0
        upper = (moments**2).sum(axis=1) * ((1 - threshold) * (1 + threshold)) * ROUND_UP
        lower = threshold**2 * own_moment**2 * (1 - 1e-12)
        return np.asarray((upper < lower) & (own_moment > 1e-100))

    def choose_wrench(self, screws: ScrewEnclosure, lock_position: int) -> tuple[Array, Array]:
        """Choose a wrench y (N, 6) and its derivatives (N, 6, n) by the joints, so that the other moments hardly change.

        Any choice is valid.
        """
        own_screw, other_screws = screws.screws.center[:, lock_position], np.delete(screws.screws.center, lock_position, axis=1)
        moving_half = (screws.half * screws.moves.any(axis=0)).max(axis=1)
        gram = np.einsum("nla,nlb->nab", other_screws, other_screws) + (0.01 * moving_half**2 + 1e-30)[:, None, None] * np.eye(
            6
        )
        y = solve_or_nan(gram, own_screw[:, :, None])[:, :, 0]
        y = y / (y * own_screw).sum(axis=1)[:, None]
        gradients = np.einsum("njla,na->nlj", screws.brackets.center, y) * screws.side
        wrench_rate = -solve_or_nan(gram, np.einsum("nla,nlj->naj", other_screws, np.delete(gradients, lock_position, axis=1)))
        wrench_rate = (
            wrench_rate
            - y[:, :, None] * (np.einsum("na,naj->nj", own_screw, wrench_rate) + gradients[:, lock_position])[:, None]
        )
        return np.nan_to_num(y), np.nan_to_num(wrench_rate)

    def enclose_manipulability_at(self, q: list[str]) -> tuple[float, float]:
        """Enclose the least relative manipulability at a configuration, whose square is 1 - J_k' (JJ')^-1 J_k."""
        inside = all(
            parse_hex(a) <= parse_hex(x) <= parse_hex(b) for x, (a, b) in zip(q, self._document["joint_box"], strict=True)
        )
        require(inside, "the configuration that was found is outside of the box")
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            kinematics = self.arm.enclose_point(enclose_configuration(q))
            columns = concatenate(2, kinematics.axes, kinematics.columns)[0][:, self.screw_rows].transpose(1, 0)
            entries = [flint.arb(float(x), float(r)) for x, r in zip(columns.center.flat, columns.radius.flat, strict=True)]
            jacobian = flint.arb_mat(*columns.center.shape, entries)
            try:
                solution = (jacobian * jacobian.transpose()).solve(jacobian)
            except ZeroDivisionError:
                return 0.0, 1.0
            squares = [1 - sum(jacobian[i, k] * solution[i, k] for i in range(len(self.screw_rows))) for k in self.locks]
            lower, upper = max(0.0, -max(round_up(-x) for x in squares)), max(0.0, min(round_up(x) for x in squares))
        return math.sqrt(lower) * (1 - 1e-15), math.sqrt(upper) * (1 + 1e-15)


class FloorVerifier(CeilingVerifier):
    """Verifier of a lower bound of relative manipulability; each leaf has a motion that keeps the tool in place."""

    def verify_leaves(self, kind: int, leaves: list[Leaf]) -> Flags:
        """Return a mask of the leaves in which the bound holds after all locks."""
        screws = ScrewEnclosure(self.arm, self.enclose_centers(cell for cell, _ in leaves))
        positions, n = [screws.order.index(position) for position in self.locks], self.arm.n
        jacobian = np.nan_to_num(screws.screws.center[:, :, self.screw_rows].transpose(0, 2, 1))
        inverse = np.nan_to_num(np.linalg.pinv(jacobian))
        if n - len(self.screw_rows) == 1:
            return self.verify_null_motion(screws, np.linalg.svd(jacobian)[2][:, -1], inverse, positions)
        null_projector = np.eye(n) - inverse @ jacobian
        masks = [self.verify_null_motion(screws, null_projector[:, :, x], inverse, [x]) for x in positions]
        return np.asarray(np.all(masks, axis=0))

    def verify_null_motion(self, screws: ScrewEnclosure, nu: Array, inverse: Array, positions: list[int]) -> Flags:
        """Return a mask of leaves in which nu + N (q - q_c) + P s keeps the tool still for some s, with large components."""
        nu, half, rows = np.nan_to_num(nu / bound_length(nu)[:, None]), screws.half, self.screw_rows
        moves, screw = screws.brackets.multiply_signs(screws.side[:, None, None])[..., rows], screws.screws[..., rows]
        motion_brackets = einsum("njlb,nl->njb", screws.brackets, nu)
        gradients = motion_brackets.multiply_signs(screws.side[:, None])[:, :, rows].transpose(0, 2, 1)
        response = np.nan_to_num(-np.einsum("nlb,nbj->nlj", inverse, gradients.center))
        cross_terms = einsum("njlb,nli->nbij", moves, response)
        second_brackets = (
            einsum("niab,njb->naij", screws.operators, motion_brackets)[:, rows]
            .multiply_signs(screws.same_side)
            .mirror_upper_triangle()
        )
        gradients = gradients + einsum("nlb,nlj->nbj", screw, response)
        second = second_brackets + cross_terms + cross_terms.transpose(0, 1, 3, 2)
        joint_travel = np.einsum("nlj,nj->nl", abs(response), half) * ROUND_UP
        remainder = np.einsum("nl,nlb->nb", abs(nu), screws.third_remainder[..., rows])
        remainder = remainder + np.einsum("nl,nlb->nb", joint_travel, screws.second_remainder[..., rows])
        residual = DerivativeEnclosure(einsum("nlb,nl->nb", screw, nu), gradients, second).bound_magnitude(
            half, remainder * ROUND_UP
        )
        identity_error = einsum("nlb,nlc->nbc", screw, inverse) + -np.eye(len(rows))
        contraction = identity_error.magnitude + np.einsum(
            "njbc,nj->nbc", einsum("njlb,nlc->njbc", moves, inverse).magnitude, half
        )
        contraction = (
            contraction + np.einsum("nlb,nlc->nbc", screws.second_remainder[..., rows], abs(inverse))
        ) * ROUND_UP + MIN_ROUNDING
        s = residual
        for _ in range(12):
            s = 1.02 * (residual + np.einsum("nbc,nc->nb", contraction, s)) + 1e-15
        # s -> s - J x maps its box into itself. As contraction s < s, J P is invertible everywhere, so nothing is singular.
        is_closed = ((residual + np.einsum("nbc,nc->nb", contraction, s)) * ROUND_UP < s).all(axis=1) & (s < 1e3).all(axis=1)
        shift = np.einsum("nlb,nb->nl", abs(inverse), s) * ROUND_UP
        norm_bound = (nu**2).sum(axis=1) + 2 * (einsum("nl,nlj->nj", nu, response).magnitude * half).sum(axis=1)
        norm_bound += (joint_travel**2).sum(axis=1)
        norm_bound = (np.sqrt(norm_bound * ROUND_UP) + bound_length(shift)) * ROUND_UP
        min_component = np.nextafter(abs(nu) - (joint_travel + shift) * ROUND_UP, -np.inf)[:, positions].min(axis=1)
        return np.asarray(is_closed & (min_component > 1e-100) & (min_component > self.threshold * norm_bound * ROUND_UP))


def bound_claim_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a ceiling or floor has in addition to the common ones."""
    require_revolute(document)
    require(document["task"] in SCREW_ROWS, f"a ceiling or floor needs the task {' or '.join(SCREW_ROWS)}")
    form = {"joint_box": [[NUMBER_PATTERN, 2], n], "threshold": NUMBER_PATTERN, "found": [NUMBER_PATTERN, n]}
    return form | {"locks": [range(n), ...], "tree": TEXT_PATTERN}


def describe_bound(document: dict[str, Any], names: list[str]) -> str:
    """Return the claim of a ceiling or floor as a sentence without its end."""
    text = f"For every configuration with {format_intervals(names, document['joint_box'])}, the least relative "
    text += f"manipulability of the {document['task']} after a lock of one of "
    text += f"{', '.join(names[lock] for lock in document['locks'])} is at "
    return f"{text}{'most' if document['kind'] == 'ceiling' else 'least'} {parse_hex(document['threshold'])!r}; angles in rad,"
