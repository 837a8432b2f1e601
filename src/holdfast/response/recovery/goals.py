"""Search for configurations of a goal, and for the rows to relax if there is none."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.progress import track
from holdfast.core.typing import FloatArray
from holdfast.response.recovery.space import FreeSpace, JointMetric
from holdfast.response.recovery.task_rows import RowSolver, list_subsets, relaxed_rows_sort_key

_MAX_CONFIGURATIONS = 48  # configurations of a goal that are kept, the nearest ones
_SELF_MOTION_STEPS = 25
_DUPLICATE_TOLERANCE = 1e-4  # rad and m
_STARTS_PER_SET = 96
_SLSQP_OPTIONS: Any = {"ftol": 1e-12, "maxiter": 100}  # the tolerance is a fraction of the squared error at the start
_POLISHED_CONFIGURATIONS = 4  # of the best configurations of a set, each another one


@dataclass(frozen=True)
class RelaxedRows:
    """Rows without which the rest of the goal is met, none of which can be met in addition to the others.

    Attributes:
        names: As people call them: ``about tool z``, ``x``, or a joint.
        misses: (k,) by how much each misses, absolute, m or rad: at the configurations found at which their norm is least.
        units: ``m`` or ``rad`` of each.
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


def find_goal_configurations(
    solver: RowSolver,
    space: FreeSpace,
    metric: JointMetric,
    pose: FloatArray,
    q_start: FloatArray,
    start_count: int,
    rng: np.random.Generator,
) -> FloatArray:
    """Return configurations (K, n) that meet every row of a pose (4, 4), the nearest to ``q_start`` first; maybe none.

    From random starts and from ``q_start``; each is then moved along the self-motion of the pose towards ``q_start``.
    """
    q = solve_pose(
        solver,
        space,
        pose,
        np.concatenate([q_start[None], solver.sample_configurations(start_count, q_start, space.free, rng)]),
    )
    q = q_start + space.shortest_difference(q, q_start)
    poses, row_masks = np.repeat(pose[None], len(q), axis=0), np.ones((len(q), solver.rows.m))
    moving = np.arange(len(q))
    for _ in range(_SELF_MOTION_STEPS):
        current = q[moving]
        trial = solver.solve(
            current + 0.3 * space.shortest_difference(q_start, current), poses[moving], row_masks[moving], space.free, 20
        )
        trial = project_onto_constraints(solver, space, trial, poses[moving], row_masks[moving])
        nearer = metric.measure_length(trial - q_start) < metric.measure_length(current - q_start) * (1 - 1e-6)
        nearer &= _are_valid(solver, space, trial, poses[moving], row_masks[moving])
        q[moving[nearer]] = trial[nearer]
        moving = moving[nearer]
        if not moving.size:
            break
    return _remove_duplicates(q[np.argsort(metric.measure_length(q - q_start), kind="stable")])


def solve_pose(solver: RowSolver, space: FreeSpace, pose: FloatArray, initial_configurations: FloatArray) -> FloatArray:
    """Return valid configurations (K, n) that meet every row of a pose (4, 4), from initial configurations (N, n)."""
    poses, row_masks = (
        np.repeat(pose[None], len(initial_configurations), axis=0),
        np.ones((len(initial_configurations), solver.rows.m)),
    )
    q = project_onto_constraints(
        solver, space, solver.solve(initial_configurations, poses, row_masks, space.free), poses, row_masks
    )
    return np.asarray(q[_are_valid(solver, space, q, poses, row_masks)])


def project_onto_constraints(
    solver: RowSolver, space: FreeSpace, q: FloatArray, poses: FloatArray, row_masks: FloatArray
) -> FloatArray:
    """Project q (N, n) so that the rows whose mask (N, m) is above 0 and the tool constraints are met together."""
    indices = np.zeros(0, dtype=np.intp) if space.manifold is None else np.flatnonzero(~space.manifold.is_satisfied(q))
    if space.manifold is None or not indices.size:
        return q

    def goal_rows(trial: FloatArray, trial_indices: NDArray[np.intp]) -> tuple[FloatArray, FloatArray]:
        is_active, pose = row_masks[indices[trial_indices]] > 0, poses[indices[trial_indices]]
        return solver.compute_errors(trial, pose) * is_active, -solver.compute_jacobian(trial, pose) * is_active[:, :, None]

    q = q.copy()
    q[indices] = space.manifold.project(q[indices], goal_rows)
    return q


def name_blocking_pair(solver: RowSolver, space: FreeSpace, poses: FloatArray, q_start: FloatArray, seed: int) -> str:
    """Return the pair that most often is too close where one of poses (G, 4, 4) is met; empty if there is none."""
    rng = np.random.default_rng(seed)
    for pose in poses:
        initial_configurations = np.concatenate(
            [q_start[None], solver.sample_configurations(_STARTS_PER_SET - 1, q_start, space.free, rng)]
        )
        repeated_poses, row_masks = (
            np.repeat(pose[None], len(initial_configurations), axis=0),
            np.ones((len(initial_configurations), solver.rows.m)),
        )
        q = solver.solve(initial_configurations, repeated_poses, row_masks, space.free)
        pair = space.name_closest_pair(q[solver.meets_rows(q, repeated_poses, row_masks, space.free)])
        if pair:
            return pair
    return ""


def _are_valid(
    solver: RowSolver, space: FreeSpace, q: FloatArray, poses: FloatArray, row_masks: FloatArray
) -> NDArray[np.bool_]:
    is_valid = solver.meets_rows(q, poses, row_masks, space.free)
    indices = np.flatnonzero(is_valid)
    is_valid[indices] = space.are_valid(q[indices])
    return is_valid


def _remove_duplicates(q: FloatArray) -> FloatArray:
    """Return the first of configurations that are the same, up to the number that a goal keeps."""
    retained: list[int] = []
    for candidate in range(len(q)):
        if all(np.abs(q[candidate] - q[other]).max() > _DUPLICATE_TOLERANCE for other in retained):
            retained.append(candidate)
        if len(retained) == _MAX_CONFIGURATIONS:
            break
    return q[retained]


def find_relaxed_goals(
    solver: RowSolver, space: FreeSpace, metric: JointMetric, pose: FloatArray, q_start: FloatArray, rng: np.random.Generator
) -> list[RelaxedGoal]:
    """Return every minimal set found of rows to relax so that a pose is met: fewest rows first, orientations before positions.

    A row that is met all the same is not given up; of a set without any row left the configurations meet the whole pose.
    """
    rows, configurations = solver.rows, dict[tuple[int, ...], FloatArray]()
    for size in range(1, rows.m):
        row_sets = list_subsets(rows.m, size, list(configurations))
        if not row_sets or space.is_time_over:
            break
        initial_configurations = np.concatenate(
            [q_start[None], solver.sample_configurations(_STARTS_PER_SET - 1, q_start, space.free, rng)]
        )
        set_indices = np.repeat(np.arange(len(row_sets)), len(initial_configurations))
        row_masks = np.ones((len(row_sets), rows.m))
        for row_set, dropped_rows in zip(row_masks, row_sets, strict=True):
            row_set[list(dropped_rows)] = 0.0
        poses = np.repeat(pose[None], len(set_indices), axis=0)
        q = solver.solve_required_rows(
            np.tile(initial_configurations, (len(row_sets), 1)), poses, row_masks[set_indices], space.free
        )
        q = project_onto_constraints(solver, space, q, poses, row_masks[set_indices])
        is_valid = _are_valid(solver, space, q, poses, row_masks[set_indices])
        pose_errors = np.linalg.norm(solver.compute_errors(q, poses), axis=1)
        for set_index, dropped_rows in enumerate(track("sets of rows", row_sets)):
            indices = np.flatnonzero(is_valid & (set_indices == set_index))
            indices = indices[np.argsort(pose_errors[indices], kind="stable")]
            if indices.size:
                for fewer_rows, solutions in _reduce_relaxed_rows(solver, space, pose, q[indices], dropped_rows).items():
                    configurations[fewer_rows] = np.concatenate([configurations.get(fewer_rows, solutions[:0]), solutions])
        configurations = {
            row_set: q
            for row_set, q in configurations.items()
            if not any(set(other_set) < set(row_set) for other_set in configurations)
        }
    relaxed_goals = [
        (dropped_rows, _select_least_error(solver, metric, space, pose, q_start, dropped_rows, q))
        for dropped_rows, q in configurations.items()
    ]
    relaxed_goals.sort(
        key=lambda entry: (*relaxed_rows_sort_key(rows, entry[0]), float(np.linalg.norm(entry[1].relaxed_rows.misses)))
    )
    return [row_set for _, row_set in relaxed_goals]


def _reduce_relaxed_rows(
    solver: RowSolver, space: FreeSpace, pose: FloatArray, q: FloatArray, dropped_rows: tuple[int, ...]
) -> dict[tuple[int, ...], FloatArray]:
    """Return configurations by the rows that they violate, from some (N, n) that meet all rows except the relaxed ones.

    Those are moved to where the rows given up are missed least, and to where one of them is met too, if that leads anywhere.
    """
    configurations, open_sets = dict[tuple[int, ...], FloatArray](), [(dropped_rows, q)]
    while open_sets:
        lost_rows, initial_configurations = open_sets.pop()
        polished = [
            _minimize_row_errors(solver, space, pose, start, list(lost_rows))
            for start in _remove_duplicates(initial_configurations)[:_POLISHED_CONFIGURATIONS]
        ]
        candidates = np.concatenate([np.stack(polished), initial_configurations])
        is_missed = solver.find_violated_rows(candidates, np.repeat(pose[None], len(candidates), axis=0))
        for missed_rows in {tuple(np.flatnonzero(row).tolist()) for row in is_missed}:
            matching = candidates[(is_missed == np.isin(np.arange(solver.rows.m), missed_rows)).all(axis=1)]
            configurations[missed_rows] = np.concatenate([configurations.get(missed_rows, matching[:0]), matching])
        for row in lost_rows if len(lost_rows) > 1 else ():
            fewer_rows = tuple(index for index in lost_rows if index != row)
            row_masks = np.ones((len(polished), solver.rows.m))
            row_masks[:, fewer_rows] = 0.0
            poses = np.repeat(pose[None], len(polished), axis=0)
            nearer = project_onto_constraints(
                solver, space, solver.solve(np.stack(polished), poses, row_masks, space.free), poses, row_masks
            )
            is_valid = _are_valid(solver, space, nearer, poses, row_masks)
            if is_valid.any() and not any(set(known_set) <= set(fewer_rows) for known_set in configurations):
                open_sets.append((fewer_rows, nearer[is_valid]))
    return configurations


def _select_least_error(
    solver: RowSolver,
    metric: JointMetric,
    space: FreeSpace,
    pose: FloatArray,
    q_start: FloatArray,
    dropped_rows: tuple[int, ...],
    q: FloatArray,
) -> RelaxedGoal:
    """Select the configurations (N, n) with the least error of the relaxed rows, the nearest first."""
    row_errors = np.abs(solver.compute_errors(q, np.repeat(pose[None], len(q), axis=0))[:, dropped_rows])
    error_norms = np.linalg.norm(row_errors, axis=1)
    is_least = error_norms <= error_norms.min() * (1 + 1e-3) + 1e-6
    selected = q_start + space.shortest_difference(q[is_least], q_start)
    selected = _remove_duplicates(selected[np.argsort(metric.measure_length(selected - q_start), kind="stable")])
    names, units = ([labels[index] for index in dropped_rows] for labels in (solver.rows.names, solver.rows.units))
    return RelaxedGoal(RelaxedRows(tuple(names), tuple(row_errors[error_norms.argmin()].tolist()), tuple(units)), selected)


def _minimize_row_errors(
    solver: RowSolver, space: FreeSpace, pose: FloatArray, q: FloatArray, lost_rows: list[int]
) -> FloatArray:
    """Minimize the errors of the lost rows from q (n,), where the other rows are met."""
    from scipy.optimize import minimize

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
    row_mask = np.ones((1, solver.rows.m))
    row_mask[0, lost_rows] = 0.0
    projected = solver.solve(expand(np.clip(minimum, lower, upper))[None], pose[None], row_mask, space.free)
    is_better = np.linalg.norm(errors(projected[0, free])[lost_rows]) < np.linalg.norm(errors(q[free])[lost_rows])
    return np.asarray(projected[0] if is_better and _are_valid(solver, space, projected, pose[None], row_mask)[0] else q)
