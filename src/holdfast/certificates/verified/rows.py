"""The rows of a task's error and their derivatives, for many configurations at once: arrays of balls.

Rows of a rotation are <W, E>, the sum of products of entries, with E the rotation from the target to the tool and W fixed
matrices: with a pose the axial part (E - E')/2, in the plane the third row of it; where only the tool's axis counts, two rows
t'E d with d the axis that is wanted and t across it. With a before b in the chain, E changes by [a]E, and twice by [a][b]E.
Between two chains t is fixed, and the rows are what the axis of the one goes along t less that of the other.
A last row is cos(angle) - 1 of what is left: the others are 0 for half a turn as well, and this one tells it from none.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .balls import Balls, crossed, joined, stacked, times
from .chain import Array, Moved, about, rotation

STRAIGHT = -0.05  # of the last row: what is left to turn is then at most 0.32 rad
MOST_TURNED = 1.5  # rad by which it may change: both together are less than half a turn
TASKS: dict[str, tuple[int, str]] = {  # by task and axes of the target: rows of the place, and which of the rotation
    "planar xy": (2, ""),
    "position xyz": (3, ""),
    "pose xyz": (3, "all"),
    "pose xyzRPY": (3, "all"),
    "planar-pose xya": (2, "plane"),
    "pointing xyz": (3, "axis"),
}


class Rows:
    """The rows of a task's error: of the place, then of the rotation, and their derivatives."""

    def __init__(self, document: dict[str, Any]) -> None:
        target = document["target"]
        self.linear, kind = TASKS[f"{document['task']} {target['axes']}"]
        self.turning = len(target["axes"]) - self.linear  # axes that turn the target
        self._yaw, self._wanted = kind == "plane", rotation(target["orientation"]) if target["orientation"] else None
        skew = np.zeros((3, 3, 3))
        for row in range(3):
            i, j = (row + 1) % 3, (row + 2) % 3
            skew[row, j, i], skew[row, i, j] = 0.5, -0.5
        self.rotated, self._less = bool(kind), 1.5  # what the last row of the weights gives where nothing is left to turn
        self._weights = Balls(np.concatenate([skew[2:] if kind == "plane" else skew, [np.eye(3) / 2]]))
        if kind == "axis" and self._wanted is not None:
            self._weights, self._less = times("ir,j->rij", self._wanted, self._wanted[:, 2]), 1.0
        self._axis = kind == "axis"
        self.m = self.linear + (2 if self._axis else (len(self._weights.at) - 1) * self.rotated)

    def error(self, moved: Moved, target: list[Array]) -> tuple[Balls, Balls, Balls]:
        """The rows (N, m), with that of the angle behind them where the tool's rotation counts, and two derivatives.

        Slopes (N, m, V) and second derivatives (N, m, V, V) are by joints, then by turns of the target. Axes of the target are
        each as :func:`turned` gives them.
        """
        count, none = len(moved.tip.at), np.zeros((len(moved.tip.at), self.turning, 3))
        middle = stacked([Balls(-x[:, 0], x[:, 1]) for x in target[: self.linear]], 1)
        error = moved.tip[:, : self.linear] + middle
        moves = Balls(np.concatenate([moved.columns.at, none], 1), np.concatenate([moved.columns.off, none], 1))
        spin = Balls(np.concatenate([moved.spin.at, none], 1), np.concatenate([moved.spin.off, none], 1))
        slopes, second = (x[:, : self.linear] for x in point_derivatives(spin, moves))
        if self.rotated:
            off, axes = self._left(moved.turn, target[self.linear :], count)
            return self._joined((error, slopes, second), off, under(moved.spin, axes))
        return error, slopes, second

    def between(self, moved: Moved, goal: Moved) -> tuple[Balls, Balls, Balls]:
        """The same rows of the tool of a chain from that of another, by the joints of the one, then of the other backwards."""
        linear, place = slice(self.linear), _both(moved, moved.columns, goal, goal.columns)
        form = (moved.tip + -goal.tip)[:, linear], place[0][:, linear], place[1][:, linear]
        if self._axis:  # fixed vectors across the axis that is wanted, and how far the tool's goes along them
            across, a, b = Balls(goal.turn.at[:, :, :2]), moved.turn[:, :, 2], goal.turn[:, :, 2]
            columns = (times("nkij,nj->nki", crossed(tool.spin), axis) for tool, axis in ((moved, a), (goal, b)))
            first, second = _both(moved, next(columns), goal, next(columns))
            less = stacked([times("ni,ni->n", a, b) + Balls(-np.ones(len(a.at)))], 1)
            error = joined(joined(form[0], times("nir,ni->nr", across, a + -b)), less)
            rows = times("nir,nij->nrj", across, first), times("nir,nijk->nrjk", across, second)
            return error, under(form[1], rows[0]), under(form[2], rows[1])
        if not self.rotated:
            return form
        off = times("nij,nkj->nik", moved.turn, goal.turn)
        back = -times("nij,nkj->nki", off, goal.spin)[:, ::-1]
        return self._joined(form, off, under(moved.spin, back))

    def _joined(self, form: tuple[Balls, Balls, Balls], off: Balls, spin: Balls) -> tuple[Balls, Balls, Balls]:
        """With the rows of a rotation (N, 3, 3), and two derivatives by turns about axes (N, V, 3), the outermost first."""
        value = times("rij,nij->nr", self._weights, off)
        value += Balls(np.append(np.zeros(len(self._weights.at) - 1), -self._less))
        first = times("nrl,nal->nra", _axial(times("rij,nkj->nrik", self._weights, off)), spin)
        later = times("nbik,nkj->nbij", crossed(spin), off)
        twice = times("nrbl,nal->nrab", _axial(times("rij,nbkj->nrbik", self._weights, later)), spin)
        return joined(form[0], value), under(form[1], first), under(form[2], mirrored(twice))

    def _left(self, turn: Balls, angles: list[Array], count: int) -> tuple[Balls, Balls]:
        """The rotation from target to tool (N, 3, 3), and the axes about which turns of the target turn it (N, t, 3)."""
        if self._wanted is not None:
            return times("nij,kj->nik", turn, self._wanted), Balls(np.zeros((count, 0, 3)))
        if self._yaw:
            return times("nij,nkj->nik", turn, about(2, angles[0])), Balls(np.broadcast_to([[[0.0, 0.0, -1.0]]], (count, 1, 3)))
        roll, pitch, yaw = (about(axis, angle) for axis, angle in enumerate(angles))
        both = times("nij,njk->nik", yaw, pitch)
        off = times("nij,nkj->nik", turn, times("nij,njk->nik", both, roll))
        fixed = Balls(np.broadcast_to([0.0, 0.0, 1.0], (count, 3)))
        return off, -times("nij,naj->nai", off, stacked([both[:, :, 0], yaw[:, :, 1], fixed], 1))


def point_derivatives(spin: Balls, columns: Balls) -> tuple[Balls, Balls]:
    """Slopes (N, 3, V) of a point, and its second derivatives (N, 3, V, V): z_a x J_b by a and a later b."""
    return columns.transposed(0, 2, 1), mirrored(times("nari,nbi->nrab", crossed(spin), columns))


def _both(moved: Moved, columns: Balls, goal: Moved, theirs: Balls) -> tuple[Balls, Balls]:
    """Derivatives of a vector of one chain less that of another, by the joints of both, those of the other backwards."""
    (slopes, second), (back, twice) = point_derivatives(moved.spin, columns), point_derivatives(goal.spin, theirs)
    n = slopes.at.shape[2]
    made = [np.zeros((*slopes.at.shape[:2], 2 * n, 2 * n)) for _ in range(2)]
    for whole, one, other in ((made[0], second.at, -twice.at), (made[1], second.off, twice.off)):
        whole[:, :, :n, :n], whole[:, :, n:, n:] = one, other[:, :, ::-1, ::-1]
    return joined(slopes, -back[:, :, ::-1]), Balls(*made)


def mirrored(made: Balls) -> Balls:
    """With what is above the diagonal below it as well."""
    upper = np.triu(np.ones(made.at.shape[-2:]))
    half, below = made.signed(upper), made.signed(np.triu(upper, 1)).transposed(0, 1, 3, 2)
    return Balls(half.at + below.at, half.off + below.off)


def _axial(x: Balls) -> Balls:
    """Of matrices (..., 3, 3) the vector whose product with a is that of the matrix [a] with x."""
    return stacked([x[..., 2, 1] + -x[..., 1, 2], x[..., 0, 2] + -x[..., 2, 0], x[..., 1, 0] + -x[..., 0, 1]], -1)


def under(a: Balls, b: Balls) -> Balls:
    """Rows after rows."""
    return Balls(np.concatenate([a.at, b.at], axis=1), np.concatenate([a.off, b.off], axis=1))
