"""Computation of the rows of one block of a plan: its poses are solved, evaluated, and tested with joints locked."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.status import Status
from holdfast.core.typing import FloatArray, Rows
from holdfast.kinematics.indices.index import IndexEvaluation, WorstCase
from holdfast.kinematics.solvers.inverse_kinematics import Accept, solver
from holdfast.kinematics.solvers.optimum import Ascent, default_starts, get_cached_ascent
from holdfast.studies.assessment.plan import CLEAR_RESTARTS, CLEAR_STEPS, LOCK_RESTARTS, AssessmentPlan

POSE_TOLERANCE = 1e-6  # m and rad


def compile_plan(plan: AssessmentPlan) -> None:
    """Compile all kernels of a plan in this thread, once, instead of in every worker at the same time."""
    plan.index.evaluate(np.zeros((1, plan.arm.n)))
    if plan.region.kind != "joints":
        solver(plan.arm, plan.index.task)
    if plan.optimise:
        _make_ascent(plan)
    if plan.clearance is not None:
        _measure_clearance(plan, np.zeros((1, plan.arm.n)))


def _make_ascent(plan: AssessmentPlan) -> Ascent:
    return get_cached_ascent(plan.index, None, plan.clearance, plan.margin)


def evaluate_block(plan: AssessmentPlan, samples: FloatArray, number: int) -> Rows:
    """Return the rows of block ``number``."""
    from scipy.spatial.transform import Rotation

    count = len(samples)
    if plan.region.kind == "joints":
        result = plan.index.evaluate(samples)
        direct: Rows = {
            "q": samples,
            "status": result.status,
            "index": result.value,
            "by_failure": result.by_failure,
            "worst": _find_worst_failures(result),
        }
        if plan.clearance is not None:
            direct |= _measure_clearance(plan, samples)[0]
        return direct
    poses = plan.region.poses(samples)
    pose_solver = solver(plan.arm, plan.index.task)
    start_seed = np.random.SeedSequence(plan.seed, spawn_key=(1, number))
    solutions = pose_solver.solve(poses, start_seed, plan.restarts, pose_solver.scale_tolerance(POSE_TOLERANCE))
    solved = np.flatnonzero(solutions.success)
    value, by_failure = np.full(count, np.nan), np.full((count, len(plan.index.failures)), np.nan)
    worst, status = np.full(count, -1, dtype=np.int16), solutions.status.copy()
    if solved.size:
        result = plan.index.evaluate(solutions.q[solved])
        value[solved] = result.value
        by_failure[solved] = result.by_failure
        worst[solved] = _find_worst_failures(result)
        status[solved] = result.status
    rows: Rows = {
        "position": poses[:, :3, 3],
        "quaternion": Rotation.from_matrix(poses[:, :3, :3]).as_quat(),
        "q": np.where(solutions.success[:, None], solutions.q, np.nan),
        "status": status,
        "index": value,
        "by_failure": by_failure,
        "worst": worst,
    }
    if plan.optimise:
        optimiser_seed = np.random.SeedSequence(plan.seed, spawn_key=(2, number))
        starts = default_starts(plan.arm, plan.index.task)
        best = _make_ascent(plan).solve(poses, solutions, optimiser_seed, starts, pose_solver.scale_tolerance(POSE_TOLERANCE))
        best_worst = np.full(count, -1, dtype=np.int16)
        optimised = np.flatnonzero(best.success)
        if optimised.size:
            best_worst[optimised] = _find_worst_failures(plan.index.evaluate(best.q[optimised]))
        rows |= {"optimised_q": best.q, "optimised_index": best.value, "optimised_worst": best_worst, "agreeing": best.agreeing}
        if plan.clearance is not None:
            rows |= {"optimised_status": best.status, "blocked": best.blocked.astype(np.int8)}
        if plan.cell is not None:
            rows["blocked_by"] = _find_collision_partner(plan, best.blocked_by)
    if plan.clearance is not None:
        clearance_rows, is_clear = _measure_clearance(plan, rows["q"])
        rows |= clearance_rows
    q, usable = solutions.q, solutions.success
    if plan.cell is not None:
        q, usable = _replace_colliding_configurations(plan, poses, q, is_clear, solutions.success, number)
        rows["clear"] = np.where(solutions.success, usable, -1).astype(np.int8)
    if plan.has_weights:
        rows["weight"] = plan.region.weights(samples)
    if plan.locks:
        rows["survives"], rows["lock_angle"] = _test_reach_after_locks(plan, poses, q, usable, number)
    return rows


def _measure_clearance(plan: AssessmentPlan, q: FloatArray) -> tuple[Rows, NDArray[np.bool_]]:
    """Return the distances of the arm from itself and its cell at q (N, n), and whether they are sufficient (N,)."""
    clearance = plan.clearance
    assert clearance is not None
    own_distance = clearance.self_only(q)
    obstacles = clearance.obstacles
    if obstacles is None:
        return {"clearance": own_distance}, np.asarray(own_distance >= plan.margin)
    distances = obstacles.pair_distances(q)
    object_distances = distances.reshape(len(q), -1, len(obstacles.cell)).min(axis=1)
    all_distances = np.column_stack([own_distance, object_distances]) if clearance.pairs else object_distances
    is_clear = (own_distance >= plan.margin) & ((distances - obstacles.margins).min(axis=1) >= plan.margin)
    return {"clearance": all_distances.min(axis=1), "from_each": all_distances}, is_clear


def _find_collision_partner(plan: AssessmentPlan, pair: NDArray[np.int64]) -> NDArray[np.int16]:
    """Return the position in ``plan.collision_partners`` of the partner in a pair of the clearance; -1 for none."""
    assert plan.clearance is not None
    assert plan.cell is not None
    own_pairs = len(plan.clearance.pairs)
    partner = np.where(pair < own_pairs, 0, (pair - own_pairs) % len(plan.cell) + bool(own_pairs))
    return np.where(pair < 0, -1, partner).astype(np.int16)


def _make_clearance_test(plan: AssessmentPlan) -> Accept | None:
    """Return the test of acceptable configurations if the arm must be free of collisions with a cell, or None."""
    clearance = plan.clearance
    if clearance is None or plan.cell is None:
        return None
    return lambda q: np.asarray(clearance.margin_left(q) >= plan.margin)


def _replace_colliding_configurations(
    plan: AssessmentPlan, poses: FloatArray, q: FloatArray, is_clear: NDArray[np.bool_], reached: NDArray[np.bool_], number: int
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Return the configurations q (N, n) of the reached poses, replaced by collision-free ones where q is too close."""
    pose_solver, unclear = solver(plan.arm, plan.index.task), np.flatnonzero(reached & ~is_clear)
    obstacles = None if plan.clearance is None else plan.clearance.obstacles
    if obstacles is not None and plan.index.task.m == 6:
        unclear = unclear[~obstacles.are_poses_always_colliding(poses[unclear], plan.margin)]
    seed = np.random.SeedSequence(plan.seed, spawn_key=(4, number))
    tolerance, accept = pose_solver.scale_tolerance(POSE_TOLERANCE), _make_clearance_test(plan)
    solutions = pose_solver.solve(poses[unclear], seed, CLEAR_RESTARTS, tolerance, accept=accept, steps=CLEAR_STEPS)
    q, collision_free = q.copy(), reached & is_clear
    q[unclear], collision_free[unclear] = solutions.q, solutions.success
    return q, collision_free


def evaluate_worst_cases(plan: AssessmentPlan, configurations: FloatArray) -> Rows:
    """Return the rows of :func:`evaluate_block` that are counted for a region of joints: only those of the worst failure."""
    worst = plan.index.worst_case(configurations)
    return {"status": worst.status, "index": worst.value, "worst": _find_worst_failures(worst)}


def _test_reach_after_locks(
    plan: AssessmentPlan, poses: FloatArray, q: FloatArray, reached: NDArray[np.bool_], number: int
) -> tuple[NDArray[np.int8], FloatArray]:
    """Return whether each reached pose is still reached after a lock of each requested joint, and the locked values.

    A joint locks at its given value, or at its value for another, random reached pose of the block.
    """
    n = plan.arm.n
    result, lock_values = np.full((len(poses), n), -1, dtype=np.int8), np.full((len(poses), n), np.nan)
    reached_rows = np.flatnonzero(reached)
    if not reached_rows.size:
        return result, lock_values
    seed = np.random.SeedSequence(plan.seed, spawn_key=(3, number))
    angle_seed, start_seed = seed.spawn(2)
    generator = np.random.default_rng(angle_seed)
    angles = np.stack(
        [q[reached_rows[generator.integers(reached_rows.size, size=reached_rows.size)], joint] for joint in range(n)], axis=1
    )
    for joint, angle in plan.lock_at:
        angles[:, joint] = angle
    requested = np.array(list(plan.locks))
    locked = np.tile(requested, reached_rows.size)
    pose_solver = solver(plan.arm, plan.index.task)
    survives = pose_solver.is_reachable_with_lock(
        poses[np.repeat(reached_rows, requested.size)],
        locked,
        angles[:, requested].ravel(),
        start_seed,
        LOCK_RESTARTS,
        POSE_TOLERANCE,
        _make_clearance_test(plan),
    )
    result[np.ix_(reached_rows, requested)] = survives.reshape(-1, requested.size)
    lock_values[np.ix_(reached_rows, requested)] = angles[:, requested]
    return result, lock_values


def _find_worst_failures(result: IndexEvaluation | WorstCase) -> NDArray[np.int16]:
    """Return the worst failure; -1 at a singular configuration, where all failures are equally bad."""
    worst = result.worst.astype(np.int16)
    worst[result.status != Status.OK] = -1
    return worst
