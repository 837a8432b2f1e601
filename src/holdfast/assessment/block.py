"""The rows of one block of a plan: its poses solved, evaluated, and tried again with joints locked."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.assessment.plan import LOCK_RESTARTS, Plan, Rows
from holdfast.indices.index import Evaluation, WorstCase
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.optimum import Ascent, default_starts, objective_ascent
from holdfast.status import Status

Array = NDArray[np.float64]

TOLERANCE = 1e-6  # of the pose, m and rad


def compile_for(plan: Plan) -> None:
    """Compile in this thread, once, instead of in every worker at the same time."""
    plan.index.evaluate(np.zeros((1, plan.arm.n)))
    if plan.region.kind != "joints":
        solver(plan.arm, plan.index.task)
    if plan.optimise:
        _ascent(plan)
    if plan.clearance is not None:
        plan.clearance(np.zeros((1, plan.arm.n)))


def _ascent(plan: Plan) -> Ascent:
    return objective_ascent(plan.index, None, plan.clearance, plan.margin)


def evaluate(plan: Plan, samples: Array, number: int) -> Rows:
    """The rows of block ``number``."""
    from scipy.spatial.transform import Rotation

    count = len(samples)
    if plan.region.kind == "joints":
        result = plan.index.evaluate(samples)
        direct: Rows = {
            "q": samples,
            "status": result.status,
            "index": result.value,
            "by_failure": result.by_failure,
            "worst": _worst(result),
        }
        if plan.clearance is not None:
            direct["clearance"] = plan.clearance(samples)
        return direct
    poses = plan.region.poses(samples)
    engine = solver(plan.arm, plan.index.task)
    drawn = np.random.SeedSequence(plan.seed, spawn_key=(1, number))
    reach = engine.solve(poses, drawn, plan.restarts, engine.within(TOLERANCE))
    ok = np.flatnonzero(reach.success)
    value, by_failure = np.full(count, np.nan), np.full((count, len(plan.index.failures)), np.nan)
    worst, status = np.full(count, -1, dtype=np.int16), reach.status.copy()
    if ok.size:
        result = plan.index.evaluate(reach.q[ok])
        value[ok], by_failure[ok], worst[ok], status[ok] = result.value, result.by_failure, _worst(result), result.status
    rows: Rows = {
        "position": poses[:, :3, 3],
        "quaternion": Rotation.from_matrix(poses[:, :3, :3]).as_quat(),
        "q": np.where(reach.success[:, None], reach.q, np.nan),
        "status": status,
        "index": value,
        "by_failure": by_failure,
        "worst": worst,
    }
    if plan.optimise:
        others = np.random.SeedSequence(plan.seed, spawn_key=(2, number))
        starts = default_starts(plan.arm, plan.index.task)
        best = _ascent(plan).solve(poses, reach, others, starts, engine.within(TOLERANCE))
        best_worst = np.full(count, -1, dtype=np.int16)
        good = np.flatnonzero(best.success)
        if good.size:
            best_worst[good] = _worst(plan.index.evaluate(best.q[good]))
        rows |= {
            "optimised_q": best.q,
            "optimised_index": best.value,
            "optimised_worst": best_worst,
            "agreeing": best.agreeing,
        }
        if plan.clearance is not None:
            rows |= {"optimised_status": best.status, "blocked": best.blocked.astype(np.int8)}
    if plan.clearance is not None:
        rows["clearance"] = plan.clearance(rows["q"])
    if plan.weighted:
        rows["weight"] = plan.region.weights(samples)
    if plan.locks:
        rows["survives"], rows["lock_angle"] = _survival(plan, poses, reach.q, reach.success, number)
    return rows


def worst_cases(plan: Plan, configurations: Array) -> Rows:
    """Of a region of joints, from the rows of :meth:`evaluate`, only those that are counted: no failure but the worst."""
    found = plan.index.worst_case(configurations)
    return {"status": found.status, "index": found.value, "worst": _worst(found)}


def _survival(plan: Plan, poses: Array, q: Array, reached: NDArray[np.bool_], number: int) -> tuple[NDArray[np.int8], Array]:
    """For each reached pose and each joint asked for: is it still reached once the joint has locked, and where it locked.

    It locks at the angle given, or at one drawn from those in use: where it was at another reached pose of the block.
    """
    n = plan.arm.n
    result, where = np.full((len(poses), n), -1, dtype=np.int8), np.full((len(poses), n), np.nan)
    rows = np.flatnonzero(reached)
    if not rows.size:
        return result, where
    seed = np.random.SeedSequence(plan.seed, spawn_key=(3, number))
    draw, starts = seed.spawn(2)
    generator = np.random.default_rng(draw)
    angles = np.stack([q[rows[generator.integers(rows.size, size=rows.size)], k] for k in range(n)], axis=1)
    for k, angle in plan.lock_at:
        angles[:, k] = angle
    asked = np.array(list(plan.locks))
    locked = np.tile(asked, rows.size)
    engine = solver(plan.arm, plan.index.task)
    found = engine.reaches_locked(
        poses[np.repeat(rows, asked.size)], locked, angles[:, asked].ravel(), starts, LOCK_RESTARTS, TOLERANCE
    )
    result[np.ix_(rows, asked)] = found.reshape(-1, asked.size)
    where[np.ix_(rows, asked)] = angles[:, asked]
    return result, where


def _worst(result: Evaluation | WorstCase) -> NDArray[np.int16]:
    """Worst failure; none at a singular configuration, where all are equally bad."""
    worst = result.worst.astype(np.int16)
    worst[result.status != Status.OK] = -1
    return worst
