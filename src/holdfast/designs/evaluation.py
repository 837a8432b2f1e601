"""Designs evaluated pose by pose: the best configuration of every design and pose, in one batch.

The search for configurations is that of :func:`holdfast.optimise` (same steps, compiled once for all designs), but most of its
random starts are spared: a design begins where a design near it has ended.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import made_finite
from holdfast.designs.family import Family
from holdfast.kernels.compiled import expecting
from holdfast.solvers.optimum import FIRST_STEPS, LAST_STEPS, RADIUS, best_of_each, default_starts

Array = NDArray[np.float64]
Index = NDArray[np.intp]

TOLERANCE = 1e-6  # of the pose, m and rad; of an arm that is shorter than 1 m as much less
_IK_STEPS = 40
_KEPT = 2  # configurations of a design and pose that the next designs begin from
_FEW = 8  # of a design with neighbours: the given number of random starts by this, besides what the neighbours found
_RESTARTS = 24  # more starts of inverse kinematics where nothing was found
_POOL = 1 << 12
_BY_POSE, _BY_START = 2654435761, 40503  # odd: each pose walks through the whole pool of starts
_IK_ROWS, _ASCENT_ROWS = 500, 100  # steps for each design and pose (measured: 519 and 113)
_ROWS = 1 << 16  # starts side by side; no result depends on it


@dataclass(frozen=True, kw_only=True)
class Evaluated:
    """D designs at P poses.

    Attributes:
        values: (D, k) the designs.
        q: (D, P, n) the best configuration found, rad and m; where the pose is not reached the one that comes nearest.
        value: (D, P) the index there; 0 where the pose is not reached.
        reached: (D, P) a configuration within the limits was found.
        miss: (D, P) how near the end effector came where it was not: length of the task's error, m and rad; 0 where it was.
        kept: (D, P, K, n) configurations to begin from nearby, best first; NaN where there are fewer.
    """

    values: Array
    q: Array
    value: Array
    reached: NDArray[np.bool_]
    miss: Array
    kept: Array

    def take(self, designs: Any) -> Evaluated:
        """Some of the designs."""
        return Evaluated(**{name: getattr(self, name)[designs] for name in self.__dataclass_fields__})

    @staticmethod
    def joined(parts: list[Evaluated]) -> Evaluated:
        """Several, one after the other."""
        return Evaluated(**{name: np.concatenate([getattr(x, name) for x in parts]) for name in Evaluated.__dataclass_fields__})

    @property
    def extended(self) -> Array:
        """(D, P) the index; where the pose is not reached, less than 0 by how far the end effector stays away, as one per m and
        rad.

        So that a search is drawn towards poses that a design does not reach yet.
        """
        return np.where(self.reached, self.value, -self.miss)


class Evaluator:
    """Designs at fixed poses; the same designs give the same bits, whatever the number of threads.

    Args:
        family: The designs and what is asked of them.
        poses: (P, 4, 4) in the world.
        seed: Of the random starts.

    Attributes:
        family, poses: The same.
        starts: Random starts of a design that has no neighbours, as :func:`holdfast.optimise` takes.
    """

    def __init__(self, family: Family, poses: Array, seed: int = 0) -> None:
        self.family, self.poses = family, poses
        self.starts = default_starts(family.arm, family.task)
        self._tolerance = TOLERANCE * min(family.space.arm.length_unit, 1.0)
        self._targets = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(len(poses), 9)], axis=1)
        self._pool = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(4,))).random((_POOL, family.arm.n))

    def __call__(self, values: Array, near: Evaluated | None = None, fresh: int | None = None) -> Evaluated:
        """Evaluate designs.

        Args:
            values: (D, k).
            near: Designs evaluated before: each new one begins from the configurations of the nearest two of them. If not
                given, the first design is searched from many random starts, and the others grow from it, each round twice as
                many as the one before.
            fresh: Random starts of each design and pose besides; an eighth of ``starts`` if not given.
        """
        fresh = self.starts // _FEW if fresh is None else fresh
        for steps, kernel in ((_IK_ROWS, "inverse"), (_ASCENT_ROWS, "ascent")):
            with expecting(len(values) * len(self.poses) * steps):
                getattr(self.family, kernel)
        if near is not None:
            return self._grown(values, near, fresh)
        if not len(values):
            return self._empty()
        done = [self._searched(values[:1], np.empty((1, len(self.poses), 0, self.family.arm.n)), self.starts)]
        start = 1
        while start < len(values):
            stop, rounds = min(2 * start, len(values)), int(start).bit_length()
            done.append(self._grown(values[start:stop], Evaluated.joined(done), max(fresh, self.starts >> rounds)))
            start = stop
        return Evaluated.joined(done)

    def _empty(self) -> Evaluated:
        p, n, k = len(self.poses), self.family.arm.n, len(self.family.space.parameters)
        nothing, none = np.empty((0, p)), np.empty((0, p), dtype=bool)
        return Evaluated(
            values=np.empty((0, k)),
            q=np.empty((0, p, n)),
            value=nothing,
            reached=none,
            miss=nothing,
            kept=np.empty((0, p, _KEPT, n)),
        )

    def _grown(self, values: Array, near: Evaluated, fresh: int) -> Evaluated:
        space = self.family.space
        width = space.upper - space.lower
        distance = np.linalg.norm((values[:, None] - near.values) / width, axis=2)
        pick = np.argsort(distance, axis=1, kind="stable")[:, :2]
        starts = np.moveaxis(near.kept[pick], 1, 2)  # (D, P, 2, K, n)
        starts = starts.reshape(*starts.shape[:2], -1, starts.shape[-1])
        block = max(1, _ROWS // (len(self.poses) * (starts.shape[2] + fresh)))
        parts = [self._searched(values[a : a + block], starts[a : a + block], fresh) for a in range(0, len(values), block)]
        return Evaluated.joined(parts) if parts else self._empty()

    # ---- configurations ----------------------------------------------------------------------------------------------

    def _searched(self, values: Array, given: Array, fresh: int) -> Evaluated:
        """The best configurations from the given starts (D, P, S, n), NaN where there is none, and some random ones."""
        d, p, n = len(values), len(self.poses), self.family.arm.n
        owner = np.arange(d * p)
        some = np.isfinite(given).all(axis=-1)  # (D, P, S)
        owners = [np.repeat(owner, some.reshape(d * p, -1).sum(axis=1))]
        starts = [given.reshape(-1, n)[some.reshape(-1)]]
        if fresh:
            owners.append(np.repeat(owner, fresh))
            starts.append(self._random(values, owners[-1], np.tile(np.arange(fresh), d * p)))
        rows, q = np.concatenate(owners), np.concatenate(starts)
        nearest, miss = np.full((d * p, n), np.nan), np.full(d * p, np.inf)
        rows, q = self._arrived(values, rows, q, nearest, miss)
        left = np.setdiff1d(owner, rows)
        if left.size:
            more = np.repeat(left, _RESTARTS)
            number = np.tile(np.arange(fresh, fresh + _RESTARTS), left.size)
            more, found = self._arrived(values, more, self._random(values, more, number), nearest, miss)
            rows, q = np.concatenate([rows, more]), np.concatenate([q, found])
        rows, q, value = self._climbed(values, rows, q)
        keep = best_of_each(rows, value, _KEPT)
        rows, q, value = rows[keep], q[keep], value[keep]
        kept = np.full((d * p, _KEPT, n), np.nan)
        first = np.r_[True, rows[1:] != rows[:-1]] if rows.size else np.zeros(0, dtype=bool)
        place = np.arange(rows.size) - np.maximum.accumulate(np.where(first, np.arange(rows.size), 0)) if rows.size else rows
        kept[rows, place] = q
        reached = np.zeros(d * p, dtype=bool)
        reached[rows[first]] = True
        best = np.zeros(d * p)
        best[rows[first]] = value[first]
        nearest[rows[first]] = q[first]
        # A pose that is not reached hands on where the arm came nearest.
        kept[~reached, 0] = nearest[~reached]
        miss = np.where(reached, 0.0, miss)
        shape = (d, p)
        return Evaluated(
            values=values,
            q=nearest.reshape(*shape, n),
            value=best.reshape(shape),
            reached=reached.reshape(shape),
            miss=miss.reshape(shape),
            kept=kept.reshape(*shape, _KEPT, n),
        )

    def _random(self, values: Array, owner: Index, number: Index) -> Array:
        """Start ``number`` of each design and pose: a share of the joint ranges that depends on the pose alone."""
        design, pose = np.divmod(owner, len(self.poses))
        low, high = self.finite_limits(values)
        unit = self._pool[(pose * _BY_POSE + number * _BY_START) % _POOL]
        return np.asarray(low[design] + unit * (high - low)[design])

    def finite_limits(self, values: Array) -> tuple[Array, Array]:
        """(D, n) limits to draw between; see ``holdfast.arm.configurations.finite_limits``."""
        return made_finite(*self.family.limits(values), self.family.prismatic)

    def _arrived(self, values: Array, owner: Index, q: Array, nearest: Array, miss: Array) -> tuple[Index, Array]:
        """Inverse kinematics from starts q (R, n): those that converged. Where the others ended is noted if it is nearest."""
        design, pose = np.divmod(owner, len(self.poses))
        low, high = self.family.limits(values)
        parameters = np.concatenate([self._targets[pose], values[design]], axis=1)
        run = self.family.inverse.run(np.clip(q, low[design], high[design]), parameters, self._tolerance**2, _IK_STEPS)
        size = np.sqrt(np.where(np.isnan(run.residual), np.inf, run.residual))
        top = best_of_each(owner, -size, 1)
        top = top[size[top] < miss[owner[top]]]
        nearest[owner[top]], miss[owner[top]] = run.state[top], size[top]
        return owner[run.done], run.state[run.done]

    def _climbed(self, values: Array, owner: Index, q: Array) -> tuple[Index, Array, Array]:
        """From q on the poses to the best configurations: owners, configurations, values; only those that kept the pose."""
        if not owner.size:
            return owner, q, np.empty(0)
        q, radius = self._ascended(values, owner, q, FIRST_STEPS, np.full(len(q), RADIUS))
        keep = best_of_each(owner, self.value(values, owner, q), 2 * _KEPT)
        owner, q, radius = owner[keep], q[keep], radius[keep]
        q, _ = self._ascended(values, owner, q, LAST_STEPS, radius)
        design, pose = np.divmod(owner, len(self.poses))
        parameters = np.concatenate([self._targets[pose], values[design]], axis=1)
        q = self.family.inverse.run(q, parameters, (1e-3 * self._tolerance) ** 2, _IK_STEPS).state
        q = np.where(self.family.turning, np.arctan2(np.sin(q), np.cos(q)), q)
        good = self.on_pose(values, owner, q)
        return owner[good], q[good], self.value(values, owner[good], q[good])

    def _ascended(self, values: Array, owner: Index, q: Array, steps: int, radius: Array) -> tuple[Array, Array]:
        n = self.family.arm.n
        design, pose = np.divmod(owner, len(self.poses))
        p, r, x = self._targets[pose, :3], self._targets[pose, 3:].reshape(-1, 3, 3), values[design]
        state = np.concatenate([q, radius[:, None], np.zeros_like(q)], axis=1)
        if n <= self.family.task.m:
            return q, radius
        for _ in range(steps):
            before = state
            state = self.family.ascent.rows(state[:, :n], state[:, n], state[:, n + 1 :], p, r, x)
            bad = ~np.isfinite(state).all(axis=1)  # a step that divided by zero (a singular configuration) is not taken
            state[bad] = before[bad]
        return state[:, :n], state[:, n]

    # ---- facts -------------------------------------------------------------------------------------------------------

    def value(self, values: Array, owner: Index, q: Array) -> Array:
        """The index (R,) of rows ``owner`` (design times P plus pose) at q (R, n); 0 where the arm is singular."""
        found = self.family.value.rows(q, values[owner // len(self.poses)])
        return np.asarray(np.nan_to_num(found.min(axis=1), nan=0.0, posinf=0.0, neginf=0.0))

    def on_pose(self, values: Array, owner: Index, q: Array) -> NDArray[np.bool_]:
        """(R,) True where q is on its pose and within the limits of its design."""
        design, pose = np.divmod(owner, len(self.poses))
        low, high = self.family.limits(values)
        p, r = self._targets[pose, :3], self._targets[pose, 3:].reshape(-1, 3, 3)
        errors = self.family.errors.rows(q, p, r, values[design])
        inside = ((q >= low[design]) & (q <= high[design])).all(axis=1)
        return np.asarray(inside & (errors <= self._tolerance).all(axis=1))

    def rows(self, owner: Index, values: Array) -> tuple[Array, Array, Array]:
        """Position (R, 3), rotation (R, 3, 3) and design (R, k) of rows."""
        design, pose = np.divmod(owner, len(self.poses))
        return self._targets[pose, :3], self._targets[pose, 3:].reshape(-1, 3, 3), values[design]
