"""Evaluation of designs pose by pose, at the best configuration of every design and pose, in one batch.

The search for configurations has the steps of :func:`holdfast.optimise`, compiled once for all designs. It needs few random
starts, because a design starts from the results of neighbouring designs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.compiled import expect_row_count
from holdfast.kinematics.solvers.optimum import FIRST_STEPS, INITIAL_RADIUS, LAST_STEPS, default_starts, largest_per_group
from holdfast.model.arm.configurations import replace_infinite_limits
from holdfast.studies.designs.family import Family

POSE_TOLERANCE = 1e-6  # m and rad; proportionally less for an arm that is shorter than 1 m
_IK_STEPS = 40
_KEPT_CONFIGURATIONS = 2  # configurations of a design and pose from which the next designs start
_START_DIVISOR = 8  # a design with neighbours has the number of random starts divided by this, plus those of the neighbours
_IK_RESTARTS = 24  # more starts of inverse kinematics if nothing was found
_POOL_SIZE = 1 << 12
# Odd strides, with which each pose passes through the whole pool of starts.
_POSE_STRIDE = 2654435761
_START_STRIDE = 40503
# Steps for each design and pose (measured: 519 and 113).
_IK_ROWS = 500
_ASCENT_ROWS = 100
_BATCH_ROWS = 1 << 16  # starts that are computed together; no result depends on it


@dataclass(frozen=True, kw_only=True)
class Evaluated:
    """Result of evaluating D designs at P poses.

    Attributes:
        values: (D, k) designs, rad and m.
        q: (D, P, n) best configuration that was found, rad and m, or the nearest one for a pose that is not reached.
        value: (D, P) index at this configuration; 0 for a pose that is not reached.
        reached: (D, P) True if a configuration within the limits was found.
        miss: (D, P) norm of the least task error, m and rad, for a pose that is not reached; 0 for a reached pose.
        kept: (D, P, K, n) configurations from which neighbouring designs start, best first, filled up with NaN.
    """

    values: FloatArray
    q: FloatArray
    value: FloatArray
    reached: BoolArray
    miss: FloatArray
    kept: FloatArray

    def take(self, designs: Any) -> Evaluated:
        """Return the evaluation of the ``designs`` with these indices."""
        return Evaluated(**{name: getattr(self, name)[designs] for name in self.__dataclass_fields__})

    @staticmethod
    def concatenate(parts: list[Evaluated]) -> Evaluated:
        """Concatenate the evaluations in ``parts``."""
        return Evaluated(**{name: np.concatenate([getattr(x, name) for x in parts]) for name in Evaluated.__dataclass_fields__})

    @property
    def signed_index(self) -> FloatArray:
        """(D, P) index, or for a pose that is not reached, minus the pose error of the end effector, one per m and rad.

        A negative value guides a search towards poses that a design does not reach yet.
        """
        return np.where(self.reached, self.value, -self.miss)


class Evaluator:
    """Evaluator of designs at fixed poses; equal designs result in equal bits for any number of threads.

    Args:
        family: Family of the designs, with the index and the task.
        poses: (P, 4, 4) tool poses in the world, m.
        seed: Seed of the random starts.

    Attributes:
        family, poses: Family and poses of the evaluator.
        starts: Number of random starts of a design without neighbours, that of :func:`holdfast.optimise`.
    """

    def __init__(self, family: Family, poses: FloatArray, seed: int = 0) -> None:
        self.family, self.poses = family, poses
        self.starts = default_starts(family.arm, family.task)
        self._tolerance = POSE_TOLERANCE * min(family.space.arm.length_unit, 1.0)
        self._targets = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(len(poses), 9)], axis=1)
        self._pool = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(4,))).random((_POOL_SIZE, family.arm.n))

    def __call__(self, values: FloatArray, near: Evaluated | None = None, fresh: int | None = None) -> Evaluated:
        """Evaluate designs.

        Args:
            values: (D, k) designs, rad and m.
            near: Evaluated designs, of which the nearest two provide configurations as starts for each new design. Default: the
                first design is searched from many random starts, and the others start from its results, in rounds of twice as
                many designs.
            fresh: Number of additional random starts of each design and pose. Default: an eighth of ``starts``.
        """
        fresh = self.starts // _START_DIVISOR if fresh is None else fresh
        for steps, kernel in ((_IK_ROWS, "inverse"), (_ASCENT_ROWS, "ascent")):
            with expect_row_count(len(values) * len(self.poses) * steps):
                getattr(self.family, kernel)
        if near is not None:
            return self._search_near(values, near, fresh)
        if not len(values):
            return self._empty_result()
        results = [self._search_configurations(values[:1], np.empty((1, len(self.poses), 0, self.family.arm.n)), self.starts)]
        start = 1
        while start < len(values):
            end, rounds = min(2 * start, len(values)), int(start).bit_length()
            results.append(
                self._search_near(values[start:end], Evaluated.concatenate(results), max(fresh, self.starts >> rounds))
            )
            start = end
        return Evaluated.concatenate(results)

    def _empty_result(self) -> Evaluated:
        pose_count, n, parameter_count = len(self.poses), self.family.arm.n, len(self.family.space.parameters)
        no_values, no_flags = np.empty((0, pose_count)), np.empty((0, pose_count), dtype=bool)
        return Evaluated(
            values=np.empty((0, parameter_count)),
            q=np.empty((0, pose_count, n)),
            value=no_values,
            reached=no_flags,
            miss=no_values,
            kept=np.empty((0, pose_count, _KEPT_CONFIGURATIONS, n)),
        )

    def _search_near(self, values: FloatArray, neighbours: Evaluated, random_count: int) -> Evaluated:
        space = self.family.space
        width = space.upper - space.lower
        distance = np.linalg.norm((values[:, None] - neighbours.values) / width, axis=2)
        nearest = np.argsort(distance, axis=1, kind="stable")[:, :2]
        starts = np.moveaxis(neighbours.kept[nearest], 1, 2)  # (D, P, 2, K, n)
        starts = starts.reshape(*starts.shape[:2], -1, starts.shape[-1])
        block_size = max(1, _BATCH_ROWS // (len(self.poses) * (starts.shape[2] + random_count)))
        parts = [
            self._search_configurations(values[first : first + block_size], starts[first : first + block_size], random_count)
            for first in range(0, len(values), block_size)
        ]
        return Evaluated.concatenate(parts) if parts else self._empty_result()

    # ---- configurations ----------------------------------------------------------------------------------------------

    def _search_configurations(self, values: FloatArray, given_starts: FloatArray, random_count: int) -> Evaluated:
        """Find the best configurations from given starts (D, P, S, n), filled up with NaN, and from some random starts."""
        design_count, pose_count, n = len(values), len(self.poses), self.family.arm.n
        all_rows = np.arange(design_count * pose_count)
        is_finite = np.isfinite(given_starts).all(axis=-1)  # (D, P, S)
        owners = [np.repeat(all_rows, is_finite.reshape(design_count * pose_count, -1).sum(axis=1))]
        starts = [given_starts.reshape(-1, n)[is_finite.reshape(-1)]]
        if random_count:
            owners.append(np.repeat(all_rows, random_count))
            starts.append(self._sample_starts(values, owners[-1], np.tile(np.arange(random_count), design_count * pose_count)))
        rows, q = np.concatenate(owners), np.concatenate(starts)
        nearest, pose_errors = np.full((design_count * pose_count, n), np.nan), np.full(design_count * pose_count, np.inf)
        rows, q = self._solve_inverse_kinematics(values, rows, q, nearest, pose_errors)
        unsolved = np.setdiff1d(all_rows, rows)
        if unsolved.size:
            retry_rows = np.repeat(unsolved, _IK_RESTARTS)
            start_numbers = np.tile(np.arange(random_count, random_count + _IK_RESTARTS), unsolved.size)
            retry_rows, retry_q = self._solve_inverse_kinematics(
                values, retry_rows, self._sample_starts(values, retry_rows, start_numbers), nearest, pose_errors
            )
            rows, q = np.concatenate([rows, retry_rows]), np.concatenate([q, retry_q])
        rows, q, value = self._maximise_index(values, rows, q)
        best_rows = largest_per_group(rows, value, _KEPT_CONFIGURATIONS)
        rows, q, value = rows[best_rows], q[best_rows], value[best_rows]
        kept_q = np.full((design_count * pose_count, _KEPT_CONFIGURATIONS, n), np.nan)
        is_first = np.r_[True, rows[1:] != rows[:-1]] if rows.size else np.zeros(0, dtype=bool)
        rank = np.arange(rows.size) - np.maximum.accumulate(np.where(is_first, np.arange(rows.size), 0)) if rows.size else rows
        kept_q[rows, rank] = q
        reached = np.zeros(design_count * pose_count, dtype=bool)
        reached[rows[is_first]] = True
        best_values = np.zeros(design_count * pose_count)
        best_values[rows[is_first]] = value[is_first]
        nearest[rows[is_first]] = q[is_first]
        # For a pose that is not reached, the nearest configuration is kept.
        kept_q[~reached, 0] = nearest[~reached]
        pose_errors = np.where(reached, 0.0, pose_errors)
        shape = (design_count, pose_count)
        return Evaluated(
            values=values,
            q=nearest.reshape(*shape, n),
            value=best_values.reshape(shape),
            reached=reached.reshape(shape),
            miss=pose_errors.reshape(shape),
            kept=kept_q.reshape(*shape, _KEPT_CONFIGURATIONS, n),
        )

    def _sample_starts(self, values: FloatArray, owner: IndexArray, start_number: IndexArray) -> FloatArray:
        """Return start ``start_number`` of each design and pose; its fractions of the joint ranges depend only on the pose."""
        design, pose = np.divmod(owner, len(self.poses))
        lower, upper = self.finite_limits(values)
        fractions = self._pool[(pose * _POSE_STRIDE + start_number * _START_STRIDE) % _POOL_SIZE]
        return np.asarray(lower[design] + fractions * (upper - lower)[design])

    def finite_limits(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the lower and upper limits (D, n), rad and m, between which to sample for designs ``values`` (D, k)."""
        return replace_infinite_limits(*self.family.limits(values), self.family.prismatic)

    def _solve_inverse_kinematics(
        self, values: FloatArray, owner: IndexArray, q: FloatArray, nearest: FloatArray, pose_errors: FloatArray
    ) -> tuple[IndexArray, FloatArray]:
        """Return the converged results of inverse kinematics from starts q (R, n), and record the nearest end of the others."""
        design, pose = np.divmod(owner, len(self.poses))
        lower, upper = self.family.limits(values)
        parameters = np.concatenate([self._targets[pose], values[design]], axis=1)
        run = self.family.inverse.run(np.clip(q, lower[design], upper[design]), parameters, self._tolerance**2, _IK_STEPS)
        error_sizes = np.sqrt(np.where(np.isnan(run.residual), np.inf, run.residual))
        best_rows = largest_per_group(owner, -error_sizes, 1)
        best_rows = best_rows[error_sizes[best_rows] < pose_errors[owner[best_rows]]]
        nearest[owner[best_rows]], pose_errors[owner[best_rows]] = run.state[best_rows], error_sizes[best_rows]
        return owner[run.done], run.state[run.done]

    def _maximise_index(
        self, values: FloatArray, owner: IndexArray, q: FloatArray
    ) -> tuple[IndexArray, FloatArray, FloatArray]:
        """Move q along the poses to the best configurations; return owners, configurations, and values of those on a pose."""
        if not owner.size:
            return owner, q, np.empty(0)
        q, radius = self._ascend_index(values, owner, q, FIRST_STEPS, np.full(len(q), INITIAL_RADIUS))
        best_rows = largest_per_group(owner, self.value(values, owner, q), 2 * _KEPT_CONFIGURATIONS)
        owner, q, radius = owner[best_rows], q[best_rows], radius[best_rows]
        q, _ = self._ascend_index(values, owner, q, LAST_STEPS, radius)
        design, pose = np.divmod(owner, len(self.poses))
        parameters = np.concatenate([self._targets[pose], values[design]], axis=1)
        q = self.family.inverse.run(q, parameters, (1e-3 * self._tolerance) ** 2, _IK_STEPS).state
        q = np.where(self.family.turning, np.arctan2(np.sin(q), np.cos(q)), q)
        is_valid = self.on_pose(values, owner, q)
        return owner[is_valid], q[is_valid], self.value(values, owner[is_valid], q[is_valid])

    def _ascend_index(
        self, values: FloatArray, owner: IndexArray, q: FloatArray, steps: int, radius: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        n = self.family.arm.n
        design, pose = np.divmod(owner, len(self.poses))
        position, rotation, design_values = self._targets[pose, :3], self._targets[pose, 3:].reshape(-1, 3, 3), values[design]
        state = np.concatenate([q, radius[:, None], np.zeros_like(q)], axis=1)
        if n <= self.family.task.m:
            return q, radius
        for _ in range(steps):
            before = state
            state = self.family.ascent.rows(state[:, :n], state[:, n], state[:, n + 1 :], position, rotation, design_values)
            is_invalid = ~np.isfinite(state).all(axis=1)  # reject a step that divided by zero (a singular configuration)
            state[is_invalid] = before[is_invalid]
        return state[:, :n], state[:, n]

    # ---- properties of rows ------------------------------------------------------------------------------------------

    def value(self, values: FloatArray, owner: IndexArray, q: FloatArray) -> FloatArray:
        """Return the index (R,) of rows ``owner`` (R,), which is design times P plus pose, at ``q`` (R, n); 0 if singular.

        ``values`` (D, k) are the designs.
        """
        index_values = self.family.value.rows(q, values[owner // len(self.poses)])
        return np.asarray(np.nan_to_num(index_values.min(axis=1), nan=0.0, posinf=0.0, neginf=0.0))

    def on_pose(self, values: FloatArray, owner: IndexArray, q: FloatArray) -> BoolArray:
        """Return a mask of rows ``owner`` (R,) of ``values`` (D, k) whose ``q`` (R, n) is on its pose within the limits."""
        design, pose = np.divmod(owner, len(self.poses))
        lower, upper = self.family.limits(values)
        position, rotation = self._targets[pose, :3], self._targets[pose, 3:].reshape(-1, 3, 3)
        errors = self.family.errors.rows(q, position, rotation, values[design])
        inside = ((q >= lower[design]) & (q <= upper[design])).all(axis=1)
        return np.asarray(inside & (errors <= self._tolerance).all(axis=1))

    def rows(self, owner: IndexArray, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return position (R, 3), rotation (R, 3, 3), and design (R, k) of rows ``owner`` (R,) of designs ``values`` (D, k)."""
        design, pose = np.divmod(owner, len(self.poses))
        return self._targets[pose, :3], self._targets[pose, 3:].reshape(-1, 3, 3), values[design]
