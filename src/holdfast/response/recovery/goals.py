"""Search for configurations of a goal, and for the rows to relax if there is none."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.response.recovery.space import FreeSpace, JointMetric
from holdfast.response.recovery.task_rows import RowSolver, list_subsets, relaxed_rows_sort_key

_MAX_CONFIGURATIONS = 48  # configurations of a goal that are kept, the nearest ones
_SELF_MOTION_STEPS = 12
_LARGEST_STEP = 0.6  # of the way to the start
_SMALLEST_STEP = 0.3  # the same, after a step that failed
_DUPLICATE_TOLERANCE = 1e-4  # rad and m
_STARTS_PER_SET = 96
_SLSQP_OPTIONS: Any = {"ftol": 1e-12, "maxiter": 100}  # the tolerance is a fraction of the squared error at the start
_POLISHED_CONFIGURATIONS = 4  # distinct best configurations of a set of rows that are refined


@dataclass(frozen=True)
class RelaxedRows:
    """Rows without which the rest of the goal is met, none of which can be met in addition to the others.

    Attributes:
        names: Names of the rows, such as ``about tool z`` or ``x``, or of joints.
        misses: (k,) absolute error of each row, m or rad, at the configurations found with the smallest norm of the errors.
        units: Unit of each error, ``m`` or ``rad``.
    """

    names: tuple[str, ...]
    misses: tuple[float, ...]
    units: tuple[str, ...]

    def __str__(self) -> str:
        parts = [
            f"{name} by {error:.4g} m" if unit == "m" else f"{name} by {np.rad2deg(error):.4g} deg"
            for name, error, unit in zip(self.names, self.misses, self.units, strict=True)
        ]
        return ", ".join(parts)

    def __add__(self, other: RelaxedRows) -> RelaxedRows:
        return RelaxedRows(self.names + other.names, self.misses + other.misses, self.units + other.units)


@dataclass(frozen=True)
class RelaxedGoal:
    """Set of rows to relax and configurations (K, n) that meet the others."""

    relaxed_rows: RelaxedRows
    q: FloatArray


@dataclass(frozen=True)
class PoseSearch:
    """Search for valid configurations that meet rows of poses.

    Attributes:
        solver: Solver of the rows.
        space: Valid configurations and motions.
        metric: Length of motions.
    """

    solver: RowSolver
    space: FreeSpace
    metric: JointMetric

    def make_row_masks(self, count: int, dropped_rows: tuple[int, ...] = ()) -> FloatArray:
        """Return masks (N, m) of all rows except the dropped ones."""
        row_masks = np.ones((count, self.solver.rows.m))
        row_masks[:, dropped_rows] = 0.0
        return row_masks

    def sample_starts(self, q_start: FloatArray, count: int, rng: np.random.Generator) -> FloatArray:
        """Return ``q_start`` (n,) and random configurations, (count + 1, n), with the locked joints as in ``q_start``."""
        return np.concatenate([q_start[None], self.solver.sample_configurations(count, q_start, self.space.free, rng)])

    def solve(self, q: FloatArray, poses: FloatArray, row_masks: FloatArray, **options: int) -> FloatArray:
        """Solve rows of poses (N, 4, 4) whose mask (N, m) is above 0 from q (N, n), and satisfy the tool constraints."""
        return self.project(self.solver.solve(q, poses, row_masks, self.space.free, **options), poses, row_masks)

    def project(self, q: FloatArray, poses: FloatArray, row_masks: FloatArray) -> FloatArray:
        """Project q (N, n) so that the rows whose mask (N, m) is above 0 and the tool constraints are met together."""
        manifold = self.space.manifold
        indices = np.zeros(0, dtype=np.intp) if manifold is None else np.flatnonzero(~manifold.is_satisfied(q))
        if manifold is None or not indices.size:
            return q

        def goal_rows(trial: FloatArray, trial_indices: IndexArray) -> tuple[FloatArray, FloatArray]:
            is_active, pose = row_masks[indices[trial_indices]] > 0, poses[indices[trial_indices]]
            jacobian = self.solver.compute_jacobian(trial, pose)
            return self.solver.compute_errors(trial, pose) * is_active, -jacobian * is_active[:, :, None]

        q = q.copy()
        q[indices] = manifold.project(q[indices], goal_rows)
        return q

    def meets_rows(self, q: FloatArray, poses: FloatArray, row_masks: FloatArray) -> BoolArray:
        """Return (N,) True where q (N, n) meets the rows whose mask (N, m) is above 0, within limits."""
        return self.solver.meets_rows(q, poses, row_masks, self.space.free)

    def are_valid(self, q: FloatArray, poses: FloatArray, row_masks: FloatArray) -> BoolArray:
        """Return (N,) True where q (N, n) meets the rows whose mask (N, m) is above 0, and is valid."""
        is_valid = self.meets_rows(q, poses, row_masks)
        is_valid[is_valid] = self.space.are_valid(q[is_valid])
        return is_valid

    def solve_pose(self, pose: FloatArray, starts: FloatArray) -> FloatArray:
        """Return valid configurations (K, n) that meet every row of a pose (4, 4), from starts (N, n)."""
        poses, row_masks = np.repeat(pose[None], len(starts), axis=0), self.make_row_masks(len(starts))
        q = self.solve(starts, poses, row_masks)
        return np.asarray(q[self.are_valid(q, poses, row_masks)])


def find_goal_configurations(
    search: PoseSearch, pose: FloatArray, q_start: FloatArray, start_count: int, rng: np.random.Generator
) -> FloatArray:
    """Return configurations (K, n) that meet every row of a pose (4, 4), the nearest to ``q_start`` first; maybe none.

    The search starts from random configurations and ``q_start``; results move along their self-motion towards ``q_start``.
    """
    q = search.solve_pose(pose, search.sample_starts(q_start, start_count, rng))
    q = q_start + search.space.shortest_difference(q, q_start)
    poses, row_masks = np.repeat(pose[None], len(q), axis=0), search.make_row_masks(len(q))
    fractions, has_self_motion = np.full(len(q), _LARGEST_STEP), int(search.space.free.sum()) > search.solver.rows.m
    for _ in range(_SELF_MOTION_STEPS if has_self_motion else 0):
        moving = np.flatnonzero(fractions >= _SMALLEST_STEP)
        if not moving.size:
            break
        current = q[moving]
        target = current + fractions[moving, None] * search.space.shortest_difference(q_start, current)
        trial = search.solve(target, poses[moving], row_masks[moving], max_steps=20)
        nearer = search.metric.measure_length(trial - q_start) < search.metric.measure_length(current - q_start) * (1 - 1e-6)
        nearer &= search.are_valid(trial, poses[moving], row_masks[moving])
        q[moving[nearer]] = trial[nearer]
        fractions[moving[~nearer]] /= 2
    return _remove_duplicates(q[np.argsort(search.metric.measure_length(q - q_start), kind="stable")])


def name_blocking_pair(search: PoseSearch, poses: FloatArray, q_start: FloatArray, seed: int) -> str:
    """Return the pair that most often is too close where one of poses (G, 4, 4) is met; empty if there is none."""
    rng = np.random.default_rng(seed)
    for pose in poses:
        starts = search.sample_starts(q_start, _STARTS_PER_SET - 1, rng)
        repeated_poses, row_masks = np.repeat(pose[None], len(starts), axis=0), search.make_row_masks(len(starts))
        q = search.solver.solve(starts, repeated_poses, row_masks, search.space.free)
        pair = search.space.name_closest_pair(q[search.meets_rows(q, repeated_poses, row_masks)])
        if pair:
            return pair
    return ""


def _remove_duplicates(q: FloatArray) -> FloatArray:
    """Return the first of configurations that are the same, up to the number that a goal keeps."""
    retained, is_new = list[int](), np.ones(len(q), dtype=np.bool_)
    while is_new.any() and len(retained) < _MAX_CONFIGURATIONS:
        retained.append(int(is_new.argmax()))
        is_new &= np.abs(q - q[retained[-1]]).max(axis=1) > _DUPLICATE_TOLERANCE
    return q[retained]


def find_relaxed_goals(
    search: PoseSearch, pose: FloatArray, q_start: FloatArray, rng: np.random.Generator
) -> list[RelaxedGoal]:
    """Return every minimal set found of rows to relax so that a pose is met: fewest rows first, orientations before positions.

    A row that is met anyway is not relaxed; the configurations of a set without a relaxed row meet the whole pose.
    """
    rows, configurations = search.solver.rows, dict[tuple[int, ...], FloatArray]()
    for size in range(1, rows.m):
        row_sets = list_subsets(rows.m, size, list(configurations))
        if not row_sets or search.space.is_time_over:
            break
        starts = search.sample_starts(q_start, _STARTS_PER_SET - 1, rng)
        set_indices = np.repeat(np.arange(len(row_sets)), len(starts))
        row_masks = np.concatenate([search.make_row_masks(len(starts), dropped_rows) for dropped_rows in row_sets])
        poses = np.repeat(pose[None], len(set_indices), axis=0)
        q = search.solver.solve_required_rows(np.tile(starts, (len(row_sets), 1)), poses, row_masks, search.space.free)
        q = search.project(q, poses, row_masks)
        is_valid = search.are_valid(q, poses, row_masks)
        pose_errors = np.linalg.norm(search.solver.compute_errors(q, poses), axis=1)
        for set_index, dropped_rows in enumerate(track("sets of rows", row_sets)):
            indices = np.flatnonzero(is_valid & (set_indices == set_index))
            indices = indices[np.argsort(pose_errors[indices], kind="stable")]
            if indices.size:
                for fewer_rows, solutions in _reduce_relaxed_rows(search, pose, q[indices], dropped_rows).items():
                    configurations[fewer_rows] = np.concatenate([configurations.get(fewer_rows, solutions[:0]), solutions])
        configurations = {
            row_set: q
            for row_set, q in configurations.items()
            if not any(set(other_set) < set(row_set) for other_set in configurations)
        }
    relaxed_goals = [(dropped, _select_least_error(search, pose, q_start, dropped, q)) for dropped, q in configurations.items()]
    relaxed_goals.sort(
        key=lambda entry: (*relaxed_rows_sort_key(rows, entry[0]), float(np.linalg.norm(entry[1].relaxed_rows.misses)))
    )
    return [row_set for _, row_set in relaxed_goals]


def _reduce_relaxed_rows(
    search: PoseSearch, pose: FloatArray, q: FloatArray, dropped_rows: tuple[int, ...]
) -> dict[tuple[int, ...], FloatArray]:
    """Return configurations by the rows that they violate, from some (N, n) that meet all rows except the relaxed ones.

    They are moved to the smallest error of the relaxed rows, and to where one of these rows is met too, if that is possible.
    """
    configurations, open_sets = dict[tuple[int, ...], FloatArray](), [(dropped_rows, q)]
    while open_sets:
        lost_rows, initial_configurations = open_sets.pop()
        polished = [
            _minimize_row_errors(search, pose, start, list(lost_rows))
            for start in _remove_duplicates(initial_configurations)[:_POLISHED_CONFIGURATIONS]
        ]
        candidates = np.concatenate([np.stack(polished), initial_configurations])
        is_missed = search.solver.find_violated_rows(candidates, np.repeat(pose[None], len(candidates), axis=0))
        for missed_rows in {tuple(np.flatnonzero(row).tolist()) for row in is_missed}:
            matching = candidates[(is_missed == np.isin(np.arange(search.solver.rows.m), missed_rows)).all(axis=1)]
            configurations[missed_rows] = np.concatenate([configurations.get(missed_rows, matching[:0]), matching])
        for row in lost_rows if len(lost_rows) > 1 else ():
            fewer_rows = tuple(index for index in lost_rows if index != row)
            row_masks = search.make_row_masks(len(polished), fewer_rows)
            poses = np.repeat(pose[None], len(polished), axis=0)
            nearer = search.solve(np.stack(polished), poses, row_masks)
            is_valid = search.are_valid(nearer, poses, row_masks)
            if is_valid.any() and not any(set(known_set) <= set(fewer_rows) for known_set in configurations):
                open_sets.append((fewer_rows, nearer[is_valid]))
    return configurations


def _select_least_error(
    search: PoseSearch, pose: FloatArray, q_start: FloatArray, dropped_rows: tuple[int, ...], q: FloatArray
) -> RelaxedGoal:
    """Select the configurations (N, n) with the least error of the relaxed rows, the nearest first."""
    rows = search.solver.rows
    row_errors = np.abs(search.solver.compute_errors(q, np.repeat(pose[None], len(q), axis=0))[:, dropped_rows])
    error_norms = np.linalg.norm(row_errors, axis=1)
    is_least = error_norms <= error_norms.min() * (1 + 1e-3) + 1e-6
    selected = q_start + search.space.shortest_difference(q[is_least], q_start)
    selected = _remove_duplicates(selected[np.argsort(search.metric.measure_length(selected - q_start), kind="stable")])
    names, units = ([labels[index] for index in dropped_rows] for labels in (rows.names, rows.units))
    return RelaxedGoal(RelaxedRows(tuple(names), tuple(row_errors[error_norms.argmin()].tolist()), tuple(units)), selected)


def _minimize_row_errors(search: PoseSearch, pose: FloatArray, q: FloatArray, lost_rows: list[int]) -> FloatArray:
    """Minimize the errors of the lost rows from q (n,), where the other rows are met."""
    from scipy.optimize import minimize

    solver, space = search.solver, search.space
    clearance, free = space.clearance, np.flatnonzero(space.free)
    met_rows = [index for index in range(solver.rows.m) if index not in lost_rows]
    lower, upper = solver.arm.lower[free], solver.arm.upper[free]

    def expand(x: FloatArray) -> FloatArray:
        full = q.copy()
        full[free] = x
        return full

    def errors(x: FloatArray) -> FloatArray:
        return np.asarray(solver.compute_errors(expand(x)[None], pose[None])[0])

    def jacobian(x: FloatArray) -> FloatArray:
        return np.asarray(solver.compute_jacobian(expand(x), pose)[:, free])

    scale = 1 / max(float(np.square(errors(q[free])[lost_rows]).sum()), 1e-300)
    constraints: list[Any] = [{"type": "eq", "fun": lambda x: errors(x)[met_rows], "jac": lambda x: jacobian(x)[met_rows]}]
    if clearance is not None:
        margin, gradient = clearance.margin_left, clearance.gradient  # the margin of an arm without pairs is infinite
        constraints.append(
            {
                "type": "ineq",
                "fun": lambda x: np.minimum(margin(expand(x)) - space.margin, 1.0),
                "jac": lambda x: gradient(expand(x))[free],
            }
        )
    with np.errstate(all="ignore"):
        minimum = minimize(  # type: ignore[call-overload]
            lambda x: scale * float(np.square(errors(x)[lost_rows]).sum()),
            q[free],
            jac=lambda x: 2 * scale * errors(x)[lost_rows] @ jacobian(x)[lost_rows],
            method="SLSQP",
            bounds=list(zip(lower, upper, strict=True)),
            constraints=constraints,
            options=_SLSQP_OPTIONS,
        ).x
    if not np.isfinite(minimum).all():
        return q
    row_mask = search.make_row_masks(1, tuple(lost_rows))
    projected = solver.solve(expand(np.clip(minimum, lower, upper))[None], pose[None], row_mask, space.free)
    is_better = np.linalg.norm(errors(projected[0, free])[lost_rows]) < np.linalg.norm(errors(q[free])[lost_rows])
    return np.asarray(projected[0] if is_better and search.are_valid(projected, pose[None], row_mask)[0] else q)
