"""Verification of path claims: after a lock at any instant, one continuous motion finishes the path of the tool.

The healthy motion follows straight segments from knot to knot. Whole numbers count its instants, 2^20 to a segment. A slab is
an interval of lock instants, and cells are intervals of the path, from the slab to the end. In a cell, g is the error of the
locked arm relative to the tool of the healthy arm, whose chain enters E = R(q) R(qh)' in reverse order. As for other claims,
e(S) <= S proves that for every lock instant of the slab and every point of the cell, g = 0 for some s. This alone does not
prove a motion, because solutions at successive points may be unrelated. Three further properties are therefore proved.

Unique: if the slopes of g - s contract a box of half widths T, it contains one such s, which is a continuous function.
Glue: on the face between two cells, the solution of the first lies in the box T of the second, so both solutions are the same.
Start: the configuration at the lock lies in the box T of the first cell, for every lock instant of the slab.

Near a singularity of the locked arm its motion is fast, like a square root. A cell can therefore be turned: it follows the
tangent of the motion, and the position on the tool path becomes a further variable of the section. For such a cell it is also
proved that this position only moves forward, so that the motion takes the tool along its path.

Redundant joints follow the healthy motion. For a tube, the offset of the target adds six numbers: its position, and the axial
part of its rotation, which determines a rotation by less than half a turn.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import accumulate, groupby
from typing import Any

import numpy as np

from .balls import MIN_ROUNDING, ROUND_UP, Array, BallArray, Flags, concatenate, einsum, flint, select_rows, solve_or_nan
from .chain import BallChain, enclose_sine_and_cosine, enclose_sines_and_cosines
from .forms import TASK_FORMS, parse_hex
from .paths import PATH_CENTER_UNIT, SEGMENT_INSTANTS, Ints, StoredSlab
from .taylor import InvariantSectionBoxes, TaskErrorEnclosure

BATCH_CELLS = 256  # cells
_UNIQUE_BOX_SIZES = 0.25 * 0.5 ** np.arange(27)  # sizes of section boxes, tried in this order


class HealthyMotion:
    """Exact healthy motion of a path along straight segments from knot to knot."""

    def __init__(self, document: dict[str, Any]) -> None:
        payloads = {"cells": "", "centres": "", "refutations": []}
        self._document = document | {"locks": [lock | payloads for lock in document["locks"]]}
        self.task = document["task"]
        self.knots = np.array([[parse_hex(number) for number in knot] for knot in document["knots"]])
        self._exact_knots = [[Fraction(number) for number in knot] for knot in self.knots.tolist()]

    def __reduce__(self) -> tuple[Any, ...]:  # to another process
        return type(self), (self._document,)

    def interpolate_joints(self, doubled_instant: int, segment: int) -> list[Fraction]:
        """Return the exact joint values at half of ``doubled_instant`` in a segment."""
        fraction = Fraction(doubled_instant, 2 * SEGMENT_INSTANTS) - segment
        return [start + (end - start) * fraction for start, end in zip(*self._exact_knots[segment : segment + 2], strict=True)]


class PathVerifier(HealthyMotion):
    """Verifier of the slabs of a path."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document)
        linear, turning, _ = TASK_FORMS[self.task]
        self.m, self.chain = linear + turning, BallChain(document["arm"], self.task == "planar-pose")
        self.n, self._cache = self.chain.n, dict[tuple[int, int], Array]()
        self.limits = np.array([[parse_hex(number) for number in pair] for pair in document["limits"]])
        metres, radians = (parse_hex(number) for number in document["tube"])
        self.tube = np.array([metres] * linear + [radians] * turning) if metres or radians else np.empty(0)
        self.driven = [[lock["joint"], *lock["followers"]] for lock in document["locks"]]

    def enclose_healthy_motion(self, doubled_instants: Ints, rate_instants: Ints) -> tuple[list[Array], BallArray]:
        """Return the joints of the healthy motion at middles, given as twice the instants, and their rates.

        The joints are rows of :func:`enclose_sine_and_cosine`, the rates those over the segments of ``rate_instants``.
        """
        segment, rows = (rate_instants - 1) // SEGMENT_INSTANTS, []
        for key in zip(segment.tolist(), doubled_instants.tolist(), strict=True):
            if key not in self._cache:
                self._cache[key] = np.array(
                    [enclose_sine_and_cosine(number) for number in self.interpolate_joints(key[1], key[0])]
                )
            rows.append(self._cache[key])
        return list(np.array(rows).transpose(1, 0, 2)), BallArray(self.knots[segment + 1]) + -self.knots[segment]

    def choose_motion_response(
        self, gradients: Array, rates: tuple[BallArray, BallArray], driven: list[int], is_tangent: Flags
    ) -> tuple[BallArray, BallArray]:
        """Choose D (N, 2n, 2 + tube + m), and the response (N, f + 1, ...) of the free joints and the path position.

        Any numbers are valid. A turned cell follows the tangent of the locked arm's motion, and the path position is a further
        variable of the section.
        """
        tube, free, (locked, path) = len(self.tube), [joint for joint in range(self.n) if joint not in driven], rates
        gradients = np.nan_to_num(gradients)
        lock_mask = np.arange(self.n) == driven[0]
        is_follower = np.isin(np.arange(2 * self.n), driven[1:])
        driven_rates = concatenate(1, path, path[:, ::-1]).multiply_signs(is_follower | (np.arange(2 * self.n) >= self.n))
        jacobian, drift = gradients[:, :, free], np.einsum("nmk,nk->nm", gradients[:, :, : self.n], locked.center * lock_mask)
        path_gradient = np.einsum("nmk,nk->nm", gradients, driven_rates.center)
        extended = np.concatenate([jacobian, path_gradient[:, :, None]], axis=2)
        is_regular = abs(np.linalg.det(jacobian)) > 1e-12
        pseudo_inverse = np.linalg.inv(np.where(is_regular[:, None, None], jacobian, np.eye(self.m)))
        tangent = np.pad(-np.einsum("nfm,nm->nf", pseudo_inverse, path_gradient), ((0, 0), (0, 1)), constant_values=1.0)
        pseudo_inverse = np.pad(pseudo_inverse, ((0, 0), (0, 1), (0, 0)))
        if is_tangent.any():
            pseudo_inverse[is_tangent] = np.linalg.pinv(extended[is_tangent])
            null_vectors = np.linalg.svd(extended[is_tangent])[2][:, -1]
            tangent[is_tangent] = null_vectors * np.where(null_vectors[:, -1:] < 0, -1.0, 1.0)
        lock_speed = is_tangent * ((tangent[:, :-1] * locked.center[:, free]).sum(axis=1) + tangent[:, -1])
        lock_response = tangent * lock_speed[:, None] - np.einsum("nfm,nm->nf", pseudo_inverse, drift)
        response = np.concatenate([np.stack([lock_response, tangent], 2), pseudo_inverse[:, :, :tube], pseudo_inverse], axis=2)
        response, free_motion = np.nan_to_num(response), np.zeros((len(gradients), 2 * self.n, response.shape[2]))
        free_motion[:, free] = response[:, :-1]
        motion = concatenate(1, locked.multiply_signs(lock_mask), path.multiply_signs(0))
        lock_motion = einsum("nk,c->nkc", motion, 1.0 * (np.arange(response.shape[2]) == 0))
        return einsum("nk,nc->nkc", driven_rates, response[:, -1]) + lock_motion + free_motion, BallArray(response)

    def bound_residual_gradients(self, cells: InvariantSectionBoxes, half: Array) -> Array:
        """Bound the gradients (N, m, 1 + m) of g - s with respect to the path and to s."""
        columns, error = [1, *range(half.shape[1] - self.m, half.shape[1])], cells.error
        joint_travel = np.einsum("nkc,nc->nk", cells.response, half) * ROUND_UP
        gradients = cells.form.gradient_magnitude[:, :, columns] + np.einsum(
            "nabk,nk->nab", cells.form.curvature_magnitude[:, :, columns], half
        )
        angle_gradient = np.zeros(gradients[:, 0].shape)
        chain_terms = zip(error.split_by_chain(joint_travel), error.split_by_chain(cells.response), strict=True)
        for (chain, slide_extent, travel), (_, _, responses) in chain_terms:
            response = responses[:, :, columns]
            c = np.cumsum(travel * ~chain.slides, axis=1) * ROUND_UP
            cumulative = np.cumsum(response * ~chain.slides[:, None], axis=1) * ROUND_UP
            slide_range = travel * chain.slides
            # The extent d of a prismatic joint enters at first order, as its slope by a rotation changes by d c for any c.
            weights = (chain.link_lengths + abs(slide_extent) * chain.slides) * c**2 + 2 * c * slide_range
            third = np.einsum("nk,nkb->nb", weights, cumulative) + np.einsum(
                "nk,nkb->nb", c**2, response * chain.slides[:, None]
            )
            gradients[:, : error.linear] += third[:, None] / 2
            angle_gradient += cumulative[:, -1]
        gradients[:, error.linear :] += (
            angle_gradient * cells.error.bound_remainder_and_angle(joint_travel)[1][:, None] ** 2 / 2
        )[:, None]
        return np.asarray(gradients * ROUND_UP * ROUND_UP + MIN_ROUNDING)

    def is_contraction(self, cells: InvariantSectionBoxes, section_box: Array) -> Flags:
        """Return a mask of cells in which s -> s - g moves any two points of the box closer to each other."""
        gradients = self.bound_residual_gradients(
            cells, np.concatenate([cells.half_widths[:, : -self.m], section_box], axis=1)
        )[:, :, 1:]
        return np.asarray(
            (np.einsum("nab,nb->na", gradients, section_box) * ROUND_UP + MIN_ROUNDING < 0.999 * section_box).all(axis=1)
        )

    def moves_forward(self, cells: InvariantSectionBoxes, response: BallArray, overshoot: Array) -> Flags:
        """Return a mask of tangent cells that only move forward on the path and end within their segment.

        ``overshoot`` (N,) is measured from the end of the segment. Motions begin in the segment, so they stay in it. If slopes
        by s are at most M, and by the path at most b, the solution moves by at most u if b + M u <= u.
        """
        gradients = self.bound_residual_gradients(cells, cells.half_widths)
        b, inner = gradients[:, :, 0], gradients[:, :, 1:]
        u = solve_or_nan(np.eye(self.m) - np.nan_to_num(inner), b[:, :, None])[:, :, 0] * 1.001 + 1e-12
        is_bounded = (u >= 0).all(axis=1) & (
            (b + np.einsum("nab,nb->na", inner, u) * ROUND_UP) * ROUND_UP + MIN_ROUNDING <= u
        ).all(axis=1)
        slowdown = np.einsum("nb,nb->n", abs(response.center[:, -1, -self.m :]), u) * ROUND_UP
        extent = np.einsum("nc,nc->n", abs(response.center[:, -1]), cells.half_widths) * ROUND_UP
        return np.asarray(is_bounded & (slowdown < response.center[:, -1, 1]) & (overshoot + extent * ROUND_UP < 0))

    def verify_cells(self, slabs: list[StoredSlab]) -> Flags:
        """Return a mask of the cells, in slabs of one lock, that continue the solution of the previous cell."""
        driven, counts, tube, m = self.driven[slabs[0][0]], [len(slab[3]) for slab in slabs], len(self.tube), self.m
        free = [joint for joint in range(self.n) if joint not in driven]
        begin, stop = np.repeat([slab[1] for slab in slabs], counts, axis=0).T
        starts, ends, half_width = np.concatenate([slab[2] for slab in slabs]).T
        is_first, is_tangent = np.concatenate([np.arange(count) == 0 for count in counts]), half_width > 0
        locked, lock_rate = self.enclose_healthy_motion(begin + stop, stop)
        healthy, path_rate = self.enclose_healthy_motion(starts + ends, ends)
        joints = [
            enclose_sines_and_cosines(values) for values in (np.concatenate([slab[3] for slab in slabs]) * PATH_CENTER_UNIT).T
        ]
        for joint in driven:
            joints[joint] = (locked if joint == driven[0] else healthy)[joint]
        error = TaskErrorEnclosure(self.task, self.chain, joints, self.chain, healthy)
        directions, response = self.choose_motion_response(
            error.slopes.center[:, :m], (lock_rate, path_rate), driven, is_tangent
        )
        offsets, half = np.zeros((m, 2 + tube + m)), np.zeros((len(ends), 2 + tube + m))
        offsets[:, 2 : 2 + tube] = np.eye(m)[:, :tube]
        half[:, 0], half[:, 2 : 2 + tube] = (stop - begin) / (2 * SEGMENT_INSTANTS), self.tube
        half[:, 1] = np.where(is_tangent, half_width * PATH_CENTER_UNIT, (ends - starts) / (2 * SEGMENT_INSTANTS))
        inclusion = InvariantSectionBoxes(error, directions, offsets, half)
        unique_box, unique = np.zeros((len(ends), m)), np.zeros(len(ends), dtype=bool)
        for size in _UNIQUE_BOX_SIZES:
            trial_box = np.where(unique[:, None], unique_box, half[:, -m:] + size)
            unique |= self.is_contraction(inclusion, trial_box)
            unique_box = np.where(unique[:, None], trial_box, unique_box)
            if unique.all():
                break
        middle, q, ones = (starts + ends) / (2 * SEGMENT_INSTANTS), _joint_values(joints), BallArray(np.ones((len(ends), 1)))
        is_valid = inclusion.is_proved & unique & inclusion.is_within_limits(q, self.limits, free)
        if is_tangent.any():
            is_valid &= ~is_tangent | self.moves_forward(inclusion, response, middle - (ends - 1) // SEGMENT_INSTANTS - 1)
        centers = concatenate(1, q[:, free], BallArray(middle[:, None]))
        instants = BallArray((begin + stop)[:, None] / (2 * SEGMENT_INSTANTS))
        lock_start = concatenate(1, _joint_values(locked)[:, free], instants), concatenate(1, lock_rate[:, free], ones)
        return is_valid & self.contains_previous_solution(centers, response, half, unique_box, lock_start, is_first, is_tangent)

    def contains_previous_solution(
        self,
        centers: BallArray,
        response: BallArray,
        half: Array,
        unique_box: Array,
        lock_start: tuple[BallArray, BallArray],
        is_first: Flags,
        is_tangent: Flags,
    ) -> Flags:
        """Return a mask of cells whose unique box contains the solution of the previous cell, or the configuration at the lock.

        The entry is a point of the free joints and of the path, in coordinates of the path and of the section.
        """
        m, columns = self.m, [0, *range(2, half.shape[1] - self.m)]
        previous_centers = _previous_rows(centers)
        previous_response = _previous_rows(response)
        previous_half = np.roll(half, 1, axis=0)
        predicted = previous_centers + einsum("nf,n->nf", previous_response[:, :, 1], BallArray(previous_half[:, 1]))
        offset = select_rows(is_first, lock_start[0], predicted) + -centers
        departure_spread = BallArray(np.zeros((*response.center.shape[:2], len(columns))))
        departure = lock_start[1] + -response[:, :, 0]
        departure_spread.center[:, :, 0] = departure.center
        departure_spread.radius = np.repeat(departure.radius[:, :, None], len(columns), axis=2)
        spread = select_rows(is_first, departure_spread, previous_response[:, :, columns] + -response[:, :, columns])
        section_spread = select_rows(
            is_first, BallArray(np.zeros((*response.center.shape[:2], m))), previous_response[:, :, -m:]
        )
        matrix = response[:, :, [1, *range(-m, 0)]]
        inverse = BallArray(solve_or_nan(matrix.center, np.eye(m + 1)[None]))
        inverse_error = (einsum("nab,nbc->nac", inverse, matrix) + -np.eye(m + 1)).magnitude
        # Between cells that are not turned the entry lies exactly on a face, and the diagonal where motions begin in the cell.
        on_face = ~is_tangent & (is_first | ~np.roll(is_tangent, 1))
        target_box = np.concatenate(
            [np.where(on_face, half[:, 1] * (1 + 1e-6) + 1e-12, half[:, 1])[:, None], unique_box], axis=1
        )
        bounds = einsum("nab,nb->na", inverse, offset).magnitude + np.einsum("nab,nb->na", inverse_error, target_box)
        bounds += np.einsum("nac,nc->na", einsum("nab,nbc->nac", inverse, spread).magnitude, half[:, columns])
        bounds += np.einsum("nac,nc->na", einsum("nab,nbc->nac", inverse, section_spread).magnitude, previous_half[:, -m:])
        return np.asarray(((bounds * ROUND_UP + MIN_ROUNDING) < target_box).all(axis=1))

    def check_leaves(self, chunk: list[StoredSlab]) -> tuple[int, list[tuple[StoredSlab, int]]]:
        """Check slabs, and return the number of cells, and the slabs that prove nothing with their number of rejected cells."""
        rejected, totals = list[tuple[StoredSlab, int]](), accumulate(len(slab[3]) for slab in chunk)
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for _, group in groupby(zip(chunk, totals, strict=True), lambda entry: (entry[0][0], entry[1] // BATCH_CELLS)):
                slabs = [slab for slab, _ in group]
                wrong = np.split(~self.verify_cells(slabs), np.cumsum([len(entry[3]) for entry in slabs])[:-1])
                rejected += [(entry, int(cells.sum())) for entry, cells in zip(slabs, wrong, strict=True) if cells.any()]
        return sum(len(slab[3]) for slab in chunk), rejected


def _previous_rows(x: BallArray) -> BallArray:
    """Return the rows of the previous cells."""
    return BallArray(np.roll(x.center, 1, axis=0), np.roll(x.radius, 1, axis=0))


def _joint_values(joints: list[Array]) -> BallArray:
    """Return the joint values (N, n) of rows of :func:`enclose_sine_and_cosine`."""
    values = np.stack([joint[:, :2] for joint in joints], 2)
    return BallArray(values[:, 0], values[:, 1])
