"""The rows of one block of a plan: its poses solved, evaluated, and tried again with joints locked."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.assessment.plan import CLEAR_RESTARTS, CLEAR_STEPS, LOCK_RESTARTS, Plan, Rows
from holdfast.indices.index import Evaluation, WorstCase
from holdfast.solvers.inverse_kinematics import Accept, solver
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
        _apart(plan, np.zeros((1, plan.arm.n)))


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
            direct |= _apart(plan, samples)[0]
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
        if plan.cell is not None:
            rows["blocked_by"] = _other(plan, best.blocked_by)
    if plan.clearance is not None:
        apart, enough = _apart(plan, rows["q"])
        rows |= apart
    q, usable = reach.q, reach.success
    if plan.cell is not None:
        q, usable = _clear(plan, poses, q, enough, reach.success, number)
        rows["clear"] = np.where(reach.success, usable, -1).astype(np.int8)
    if plan.weighted:
        rows["weight"] = plan.region.weights(samples)
    if plan.locks:
        rows["survives"], rows["lock_angle"] = _survival(plan, poses, q, usable, number)
    return rows


def _apart(plan: Plan, q: Array) -> tuple[Rows, NDArray[np.bool_]]:
    """How far the arm is from itself and its cell at q (N, n), and whether that is enough (N,)."""
    clearance = plan.clearance
    assert clearance is not None
    own = clearance.alone(q)
    around = clearance.obstacles
    if around is None:
        return {"clearance": own}, np.asarray(own >= plan.margin)
    apart = around.distances(q)
    objects = apart.reshape(len(q), -1, len(around.cell)).min(axis=1)
    each = np.column_stack([own, objects]) if clearance.pairs else objects
    enough = (own >= plan.margin) & ((apart - around.margins).min(axis=1) >= plan.margin)
    return {"clearance": each.min(axis=1), "from_each": each}, enough


def _other(plan: Plan, pair: NDArray[np.int64]) -> NDArray[np.int16]:
    """Position in ``plan.others`` of what a pair of the clearance is with; -1 for none."""
    assert plan.clearance is not None
    assert plan.cell is not None
    own = len(plan.clearance.pairs)
    thing = np.where(pair < own, 0, (pair - own) % len(plan.cell) + bool(own))
    return np.where(pair < 0, -1, thing).astype(np.int16)


def _accept(plan: Plan) -> Accept | None:
    """Which configurations count where the cell is kept clear of."""
    clearance = plan.clearance
    if clearance is None or plan.cell is None:
        return None
    return lambda q: np.asarray(clearance.room(q) >= plan.margin)


def _clear(
    plan: Plan, poses: Array, q: Array, enough: NDArray[np.bool_], reached: NDArray[np.bool_], number: int
) -> tuple[Array, NDArray[np.bool_]]:
    """The configurations q (N, n) of the poses that are reached, and others of those where q is not clear enough."""
    engine, some = solver(plan.arm, plan.index.task), np.flatnonzero(reached & ~enough)
    around = None if plan.clearance is None else plan.clearance.obstacles
    if around is not None and plan.index.task.m == 6:
        some = some[~around.never_clear(poses[some], plan.margin)]
    seed = np.random.SeedSequence(plan.seed, spawn_key=(4, number))
    tolerance, accept = engine.within(TOLERANCE), _accept(plan)
    found = engine.solve(poses[some], seed, CLEAR_RESTARTS, tolerance, accept=accept, steps=CLEAR_STEPS)
    q, clear = q.copy(), reached & enough
    q[some], clear[some] = found.q, found.success
    return q, clear


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
        poses[np.repeat(rows, asked.size)], locked, angles[:, asked].ravel(), starts, LOCK_RESTARTS, TOLERANCE, _accept(plan)
    )
    result[np.ix_(rows, asked)] = found.reshape(-1, asked.size)
    where[np.ix_(rows, asked)] = angles[:, asked]
    return result, where


def _worst(result: Evaluation | WorstCase) -> NDArray[np.int16]:
    """Worst failure; none at a singular configuration, where all are equally bad."""
    worst = result.worst.astype(np.int16)
    worst[result.status != Status.OK] = -1
    return worst
