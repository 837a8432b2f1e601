"""Which cells of lock instants and path one configuration proves, and where one motion goes on from cell to cell.

The error of the locked arm is that of its tool from the tool of the healthy arm, so that both chains are expanded. Everything
here is doubles and may be wrong: the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.claims import ROWS
from holdfast.certificates.taylor import Chain
from holdfast.certificates.tool_paths.cells import SEGMENT, UNIT, Cells, Forms
from holdfast.certificates.tool_paths.tools import axial, onto, sideways, solved, swept, tangents, twice

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

_ROUNDS, _TIGHTER = 30, 6  # of the section box: wider until it does, then narrower
_MARGIN, _LEAST = 1.003, 1e-9  # of what the verifier must be able to show
_STRAIGHT, _TURN = 2.91, 1.19  # of rotations: the trace in the middle, and what is turned from there
_SIZES = 0.25 * 0.5 ** np.arange(27)  # of boxes with one solution, tried one after the other
_NEWTON, _MET = 6, 1e-10
_ROOM = 0.4  # of a box with one solution: so narrow must that be in which it is found, for the next cell to take it over
_FIRST, _STRIDE, _SLOWEST = SEGMENT >> 8, SEGMENT >> 1, SEGMENT >> 14  # instants, of the look ahead
_NEAR, _JUMP = 1e-6, 0.3  # m and rad
_NEVER = 10.0  # m and rad: no section box is so wide


class Following:
    """A locked arm that follows the tool of the healthy one.

    Args:
        chain: The arm.
        knots: (K + 1, n) of the healthy motion, rad.
        task: What of the tool follows.
        still: The locked joint, then those that go on with the healthy motion.
        tube: (m,) half widths, m and rad; or none, (0,).
        limits: (n, 2) rad and m.
        slides: (n,) which joints slide.
    """

    def __init__(
        self, chain: Chain, knots: Array, task: str, *, still: list[int], tube: Array, limits: Array, slides: Flags
    ) -> None:
        self.chain, self.knots, self.still, self.tube, self.limits = chain, knots, still, tube, limits
        self.n, self.slides, self._rows = knots.shape[1], slides, ROWS[task]
        self.m = len(self._rows)
        self.rotated, self._pointing = self._rows[-1] > 2, task == "pointing"
        self.free = [k for k in range(self.n) if k not in still]
        self._linear = sum(row < 3 for row in self._rows)
        self._turns = np.tile(~slides, 2).astype(float)

    def healthy(self, twice: Ints, end: Ints) -> tuple[Array, Array]:
        """Joints of the healthy motion at half of ``twice``, and rates over the segments that end there."""
        k = (end - 1) // SEGMENT
        rates = self.knots[k + 1] - self.knots[k]
        return self.knots[k] + rates * (twice / (2 * SEGMENT) - k)[:, None], rates

    def placed(self, q: Array, cells: Cells) -> Array:
        """Configurations (N, n) with the joints that are not free where they are in the middles of cells."""
        q = q.copy()
        q[:, self.still[0]] = self.healthy(cells.begin + cells.stop, cells.stop)[0][:, self.still[0]]
        q[:, self.still[1:]] = self.healthy(cells.start + cells.end, cells.end)[0][:, self.still[1:]]
        return q

    def solved(self, q: Array, cells: Cells) -> Array:
        """Newton from q (N, n) to the middles of cells, written in units of the file."""
        q, (goal, _) = self.placed(q, cells), self.healthy(cells.start + cells.end, cells.end)
        target = self.moved(goal)
        for _ in range(_NEWTON):
            at = self.moved(q)
            error, slope = self.missed(at, target)
            if np.abs(error).max(initial=0.0) < _MET:
                break
            q[:, self.free] -= np.clip(solved(slope[:, :, self.free], error[:, :, None])[:, :, 0], -0.5, 0.5)
        q[:, self.free] = np.round(q[:, self.free] / UNIT) * UNIT
        return q

    def forms(self, q: Array, cells: Cells) -> Forms:
        """Around centres q (N, n) of cells."""
        m, n, tube = self.m, self.n, len(self.tube)
        goal, along = self.healthy(cells.start + cells.end, cells.end)
        rate = self.healthy(cells.begin + cells.stop, cells.stop)[1]
        at, target = self.moved(q), self.moved(goal)
        error, ours = self.missed(at, target)
        slopes = np.concatenate([ours, self._theirs(at, target)], axis=2)
        turned, own = cells.width > 0, self._section(slopes, rate, along, cells.width > 0)
        d = np.zeros((len(q), 2 * n, 2 + tube + m))
        moved = along[:, :, None] * own[:, -1:]
        d[:, self.still[0], 0] = rate[:, self.still[0]]
        d[:, self.still[1:]], d[:, n:], d[:, self.free] = moved[:, self.still[1:]], moved, own[:, :-1]
        second = self._bent(at, target, d)
        left = np.abs(slopes @ d - np.concatenate([np.zeros((m, 2)), *[np.eye(m)] * (2 if tube else 1)], axis=1))
        half = np.concatenate([cells.half, np.tile(self.tube, (len(q), 1)), np.zeros((len(q), m))], axis=1)
        out = np.concatenate([q, goal], axis=1)
        given = _Bounds(error, np.abs(d), left, np.abs(second), np.einsum("nacc->nac", second), np.abs(out) * (1 - self._turns))
        closed, far, angle = self._closed(given, half)
        s = half[:, -m:]
        only, one = np.zeros_like(s), np.zeros(len(q), dtype=bool)
        for size in _SIZES:
            rows = np.flatnonzero(closed & ~one)
            if not rows.size:
                break
            wide = s[rows] + size
            found = self._contracts(given.take(rows), half[rows], wide)
            only[rows[found]], one[rows[found]] = wide[found], True
        low, high = self.limits[self.free].T
        reach = 1.001 * far[:, self.free] + 1e-7
        closed &= (s < _ROOM * only).all(axis=1)
        good = closed & one & ((q[:, self.free] - reach >= low) & (q[:, self.free] + reach <= high)).all(axis=1)
        if self.rotated:
            good &= (angle < _TURN) & (self.straight(at, target) > _STRAIGHT)
        place = (cells.start + cells.end) / (2 * SEGMENT)
        if (some := np.flatnonzero(turned)).size:
            left_over = (place - (cells.end - 1) // SEGMENT - 1)[some]
            good[some] &= self._forward(given.take(some), half[some], own[some], left_over)
        return Forms(q, place, turned, own, half, only, good)

    def _section(self, slopes: Array, rate: Array, along: Array, turned: Flags) -> Array:
        """How free joints, then the place on the path, follow coordinates (N, m + 1, columns), by slopes (N, m, 2n)."""
        m, n, tube = self.m, self.n, len(self.tube)
        jacobian, drift = slopes[:, :, self.free], slopes[:, :, self.still[0]] * rate[:, self.still[:1]]
        ahead = np.einsum("nmk,nk->nm", slopes[:, :, n:], along)
        ahead += np.einsum("nmk,nk->nm", slopes[:, :, self.still[1:]], along[:, self.still[1:]])
        inverse = solved(jacobian, np.broadcast_to(np.eye(m), jacobian.shape))
        own = np.zeros((len(slopes), m + 1, 2 + tube + m))
        own[:, -1, 1] = 1
        own[:, :-1, :2] = -inverse @ np.stack([drift, ahead], axis=2)
        own[:, :-1, 2:] = np.concatenate([inverse] * (2 if tube else 1), axis=2)
        if turned.any():
            tangent, across = tangents(np.concatenate([jacobian, ahead[:, :, None]], axis=2)[turned])
            # On the diagonal motions begin as the healthy arm goes: so much of its rates is along the tangent.
            beside = (tangent[:, :-1] * rate[turned][:, self.free]).sum(axis=1) + tangent[:, -1]
            own[turned, :, 0] = tangent * beside[:, None] - np.einsum("nkm,nm->nk", across, drift[turned])
            own[turned, :, 1], own[turned, :, 2:] = tangent, across
        return own

    def begins(self, forms: Forms, cells: Cells) -> Flags:
        """Whether configurations at all lock instants of slabs are the solutions of cells."""
        q, rate = (x[:, self.free] for x in self.healthy(cells.begin + cells.stop, cells.stop))
        start = np.column_stack([q, (cells.begin + cells.stop) / (2 * SEGMENT)])
        leaves = np.column_stack([rate, np.ones(len(q))])
        away = (leaves - forms.own[:, :, 0]) * forms.half[:, :1]
        return self._entered(start, away[:, :, None], forms, np.zeros(len(q), dtype=bool))

    def goes_on(self, before: Forms, forms: Forms) -> Flags:
        """Whether what is found in a cell is what was found in the one before it, where that ends."""
        end, place = self.end(before)
        kept = [k for k in range(before.half.shape[1] - self.m) if k != 1]
        moved = (before.own - forms.own)[:, :, kept] * before.half[:, None, kept]
        found = before.own[:, :, -self.m :] * before.half[:, None, -self.m :]
        point = np.column_stack([end[:, self.free], place])
        return self._entered(point, np.concatenate([moved, found], axis=2), forms, before.turned)

    def end(self, forms: Forms) -> tuple[Array, Array]:
        """Configurations (N, n) and places on the path (N,) where cells end, for the middles of their slabs."""
        q = forms.q.copy()
        q[:, self.free] += forms.own[:, :-1, 1] * forms.half[:, 1:2]
        return q, forms.place + forms.own[:, -1, 1] * forms.half[:, 1]

    def _entered(self, point: Array, away: Array, forms: Forms, turned: Flags) -> Flags:
        """Whether all that is so far from points (N, m + 1) is where cells have one solution; ``turned``: those before."""
        matrix = forms.own[:, :, [1, *range(-self.m, 0)]]
        here = np.column_stack([forms.q[:, self.free], forms.place])
        found = solved(matrix, np.concatenate([(point - here)[:, :, None], away], axis=2))
        most = _MARGIN * np.abs(found).sum(axis=2) + _LEAST
        inside = (most[:, 0] < forms.half[:, 1]) | ~(turned | forms.turned)
        return np.asarray((most[:, 1:] < forms.only).all(axis=1) & inside)

    def guessed(self, before: Forms, cells: Cells, middle: Array) -> Array:
        """(N, n) where to begin in cells, ``middle`` (N,) segments behind the middles of those before."""
        q = before.q.copy()
        q[:, self.free] += before.own[:, :-1, 1] * middle[:, None]
        return self.placed(q, cells)

    def ahead(self, q: Array, place: Array, base: Ints, by: Array) -> tuple[Array, Ints]:
        """From configurations (N, n) of motions at places of segments: along their tangents by (N,), and back onto them."""
        z, end, held = np.column_stack([q, place]), base + SEGMENT, q[:, self.still[0]]
        for k in range(_NEWTON):
            goal, along = self.healthy(np.rint(2 * SEGMENT * z[:, -1]), end)
            z[:, self.still[1:]] = goal[:, self.still[1:]]
            at, target = self.moved(z[:, :-1]), self.moved(goal)
            error, own = self.missed(at, target)
            slopes = np.concatenate([own, self._theirs(at, target)], axis=2)
            ahead = np.einsum("nmk,nk->nm", slopes[:, :, self.n :], along)
            ahead += np.einsum("nmk,nk->nm", own[:, :, self.still[1:]], along[:, self.still[1:]])
            wide = np.concatenate([own[:, :, self.free], ahead[:, :, None]], axis=2)
            back = wide.transpose(0, 2, 1)
            step = tangents(wide)[0] * by[:, None] if k == 0 else -(back @ solved(wide @ back, error[:, :, None]))[:, :, 0]
            z[:, [*self.free, -1]] += step
            z[:, -1] = np.rint(z[:, -1] * SEGMENT) / SEGMENT
        z[:, self.free] = np.round(z[:, self.free] / UNIT) * UNIT
        z[:, self.still[0]] = held
        return z[:, :-1], np.rint(z[:, -1] * SEGMENT).astype(np.int64)

    def finishes(self, locks: Ints) -> Flags:
        """Whether Newton's method follows the path from lock instants (N,) to its end, within the limits; a look ahead."""
        end = (len(self.knots) - 1) * SEGMENT
        q, (low, high) = self.healthy(2 * locks, np.maximum(locks, 1))[0], self.limits.T
        at, step, good = locks.copy(), np.full(len(locks), _FIRST), np.ones(len(locks), dtype=bool)
        while (some := np.flatnonzero(good & (at < end))).size:
            to = np.minimum(at[some] + step[some], end)
            goal, now = self.healthy(2 * to, to)[0], q[some]
            target = self.moved(goal)
            now[:, self.still[1:]] = goal[:, self.still[1:]]
            for _ in range(_NEWTON):
                error, slope = self.missed(self.moved(now), target)
                if np.abs(error).max(initial=0.0) < _NEAR:
                    break
                now[:, self.free] -= np.clip(solved(slope[:, :, self.free], error[:, :, None])[:, :, 0], -0.5, 0.5)
            met = (np.abs(error) < _NEAR).all(axis=1) & ((now >= low) & (now <= high)).all(axis=1)
            met &= (np.abs(now - q[some]) < _JUMP).all(axis=1)
            q[some[met]], at[some[met]] = now[met], to[met]
            step[some] = np.where(met, np.minimum(2 * step[some], _STRIDE), step[some] // 4)
            good[some] = step[some] >= _SLOWEST
        return good

    # ---- kinematics --------------------------------------------------------------------------------------------

    def moved(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Place and rotation of the tool, axes that turn it (N, n, 3), and how the place follows the joints (N, n, 3)."""
        count, sine, cosine = len(q), np.sin(q), np.cos(q)
        place, turn = np.zeros((count, 3)), np.tile(np.eye(3), (count, 1, 1))
        axes, points = np.empty((2, count, self.n, 3))
        for k in range(self.n):
            rows = turn.reshape(-1, 3)  # products of few large matrices are faster than of many small ones
            place = place + (rows @ self.chain.origins[k]).reshape(count, 3)
            x, y, z = (rows @ self.chain.rotations[k]).reshape(count, 3, 3).transpose(2, 0, 1)
            axes[:, k], points[:, k] = z, place
            s, c = sine[:, [k]], cosine[:, [k]]
            if self.slides[k]:
                place, s, c = place + z * q[:, [k]], np.zeros_like(s), np.ones_like(c)
            turn = np.empty((count, 3, 3))
            turn[:, :, 0], turn[:, :, 1], turn[:, :, 2] = c * x + s * y, c * y - s * x, z
        place = place + turn @ self.chain.origins[self.n]
        spin, along = axes * ~self.slides[:, None], axes * self.slides[:, None]
        return place, turn @ self.chain.rotations[self.n], spin, np.cross(spin, place[:, None] - points) + along

    def missed(self, at: tuple[Array, ...], target: tuple[Array, ...]) -> tuple[Array, Array]:
        """Error (N, m) and its slopes by the arm's joints (N, m, n)."""
        error, slope = at[0] - target[0], at[3].transpose(0, 2, 1)
        if self.rotated:
            off = at[1] @ target[1].transpose(0, 2, 1)
            turned = (sideways(target) @ at[1][:, :, 2:])[:, :, 0] if self._pointing else axial(off)
            error = np.concatenate([error, turned], axis=1)
            turns = sideways(target) @ swept(at) if self._pointing else onto(off) @ at[2].transpose(0, 2, 1)
            slope = np.concatenate([slope, turns], axis=1)
        return error[:, self._rows], slope[:, self._rows]

    def straight(self, at: tuple[Array, ...], target: tuple[Array, ...]) -> Array:
        """(N,) 1 + 2 cos of the angle by which tools are turned from what is wanted."""
        if self._pointing:
            return np.asarray(1 + 2 * np.einsum("ni,ni->n", at[1][:, :, 2], np.broadcast_to(target[1], at[1].shape)[:, :, 2]))
        return np.asarray(np.einsum("nij,nij->n", at[1], np.broadcast_to(target[1], at[1].shape)))

    def _theirs(self, at: tuple[Array, ...], target: tuple[Array, ...]) -> Array:
        """Slopes (N, m, n) by the healthy arm's joints."""
        slope = -target[3].transpose(0, 2, 1)
        if self.rotated:
            off = at[1] @ target[1].transpose(0, 2, 1)
            turns = sideways(target) @ swept(target) if self._pointing else onto(off) @ off @ target[2].transpose(0, 2, 1)
            slope = np.concatenate([slope, -turns], axis=1)
        return np.asarray(slope[:, self._rows])

    def _bent(self, at: tuple[Array, ...], target: tuple[Array, ...], d: Array) -> Array:
        """Second derivatives (N, m, c, c) along the columns of d."""
        n, ours, theirs = self.n, d[:, : self.n], d[:, self.n :]
        # Along a column, what joints before k turn moves the column of joint k; a sum over all pairs, each once.
        both = twice(at[2], at[3], ours) - twice(target[2], target[3], theirs)
        if self._pointing:
            turns = (twice(x[2], swept(x).transpose(0, 2, 1), moves) for x, moves in ((at, ours), (target, theirs)))
            rows = np.einsum("nri,nicd->nrcd", sideways(target), next(turns) - next(turns))
            both = np.concatenate([both, rows], axis=1)
        elif self.rotated:
            off = at[1] @ target[1].transpose(0, 2, 1)
            axes = np.concatenate([at[2], -(off[:, None] @ target[2][..., None])[..., 0][:, ::-1]], axis=1)
            moves = np.concatenate([ours, theirs[:, ::-1]], axis=1)
            before = np.cumsum(axes[:, :, None] * moves[..., None], axis=1)  # (N, 2n, c, 3)
            last = before - axes[:, :, None] * moves[..., None] / 2  # a joint with itself counts half
            turned = np.cross(axes[:, :, None, :], off.transpose(0, 2, 1)[:, None])  # rows: z x each column of off
            later = onto(turned.transpose(0, 1, 3, 2).reshape(-1, 3, 3)).reshape(len(off), 2 * n, 3, 3)
            half = np.einsum("nkri,nkai,nkb->nrab", later, last, moves, optimize=True)
            both = np.concatenate([both, half + half.transpose(0, 1, 3, 2)], axis=1)
        return np.asarray(both[:, self._rows])

    # ---- bounds ------------------------------------------------------------------------------------------------

    def _third(self, far: Array, out: Array) -> Array:
        """(N, m) what is left behind the second order; ``out`` (N, 2n): how far slides are."""
        place, slid = np.zeros(len(far)), far * (1 - self._turns)
        for chain in (slice(0, self.n), slice(self.n, None)):
            c, most = np.cumsum((far * self._turns)[:, chain], axis=1), self.chain.lengths + (out + slid)[:, chain]
            place += (c**3 * most + 3 * c**2 * slid[:, chain]).sum(axis=1) / 6
        turn = (far @ self._turns) ** 3 / 6
        return np.stack([place] * self._linear + [turn] * (self.m - self._linear), axis=1)

    def _closed(self, given: _Bounds, half: Array) -> tuple[Flags, Array, Array]:
        """Whether section boxes, put into half, are mapped into themselves; how far joints go then, and turn the tool."""
        count, s = len(half), half[:, -self.m :]
        closed, far, angle = np.zeros(count, dtype=bool), np.full((count, 2 * self.n), _NEVER), np.full(count, _NEVER)
        rows = np.arange(count)
        for k in range(_ROUNDS + _TIGHTER):
            if not rows.size and k < _ROUNDS:  # each is closed, or never will be
                continue
            rows = np.flatnonzero(closed) if k >= _ROUNDS else rows
            e, far[rows], angle[rows] = self._excess(given.take(rows), half[rows])
            done = (_MARGIN * e + _LEAST <= s[rows]).all(axis=1) & (s[rows] < 1).all(axis=1)
            closed[rows] = done
            if k < _ROUNDS:
                rows = rows[~done]
                s[rows] = np.clip(np.nan_to_num(1.05 * e[~done] + 2 * _LEAST, nan=_NEVER), 0, _NEVER)
                rows = rows[(s[rows] < 1).all(axis=1)]
            else:
                s[rows] = _MARGIN * e + 1.01 * _LEAST
        return closed, far[:, : self.n], angle

    def _excess(self, given: _Bounds, half: Array) -> tuple[Array, Array, Array]:
        """How far the error may be from the section, how far joints go, and by how much they turn the tool."""
        far, square = (given.reach @ half[:, :, None])[:, :, 0], half**2
        rest = self._third(far, given.out) + (given.left @ half[:, :, None])[:, :, 0]
        mixed = ((given.second @ half[:, None, :, None])[..., 0] * half[:, None]).sum(axis=2)
        rest += (mixed - (np.abs(given.own) @ square[:, :, None])[:, :, 0]) / 2
        high, low = (rest + (np.maximum(x, 0) @ square[:, :, None])[:, :, 0] / 2 for x in (given.own, -given.own))
        return np.maximum(given.error + high, low - given.error), far, far @ self._turns

    def _slopes(self, given: _Bounds, half: Array) -> Array:
        """(N, m, 1 + m) above the slopes of the error less the section by the path and by the section."""
        last = [1, *range(half.shape[1] - self.m, half.shape[1])]
        far = (given.reach @ half[:, :, None])[:, :, 0]
        slope = given.left[:, :, last] + (given.second @ half[:, None, :, None])[:, :, last, 0]
        turn, slid = np.zeros((len(half), 1 + self.m)), far * (1 - self._turns)
        by = given.reach[:, :, last]
        for chain in (slice(0, self.n), slice(self.n, None)):
            turns = self._turns[chain]
            c, own = np.cumsum(far[:, chain] * turns, axis=1), np.cumsum(by[:, chain] * turns[:, None], axis=1)
            most = (self.chain.lengths + (given.out + slid)[:, chain]) * c**2 + 2 * c * slid[:, chain]
            slope[:, : self._linear] += (most[:, None] @ own + (c**2 * (1 - turns))[:, None] @ by[:, chain]) / 2
            turn += own[:, -1]
        slope[:, self._linear :] += (turn * (far @ self._turns)[:, None] ** 2 / 2)[:, None]
        return np.asarray(slope)

    def _contracts(self, given: _Bounds, half: Array, wide: Array) -> Flags:
        """Whether there is at most one solution in section boxes (N, m)."""
        slope = self._slopes(given, np.concatenate([half[:, : -self.m], wide], axis=1))[:, :, 1:]
        return np.asarray((_MARGIN * (slope @ wide[:, :, None])[:, :, 0] < 0.998 * wide).all(axis=1))

    def _forward(self, given: _Bounds, half: Array, own: Array, place: Array) -> Flags:
        """Whether turned cells only go forward on the path, and end within the segment, ``place`` (N,) from the end of that."""
        slope = self._slopes(given, half)
        moves = solved(np.eye(self.m) - slope[:, :, 1:], slope[:, :, :1])[:, :, 0]
        slower = (np.abs(own[:, -1, -self.m :]) * moves).sum(axis=1)
        off = (np.abs(own[:, -1]) * half).sum(axis=1)
        fine = (moves >= 0).all(axis=1) & (_MARGIN * slower < own[:, -1, 1])
        return np.asarray(fine & (place + _MARGIN * off < 0))


@dataclass(frozen=True, eq=False)
class _Bounds:
    """Of cells: errors; sizes of what joints follow, of what is left of slopes, of second derivatives; their own; slides."""

    error: Array
    reach: Array
    left: Array
    second: Array
    own: Array
    out: Array

    def take(self, rows: Ints) -> _Bounds:
        """Of some of them."""
        return _Bounds(*(getattr(self, field.name)[rows] for field in fields(self)))
