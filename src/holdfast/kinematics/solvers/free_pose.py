"""Best configuration of an arm within its limits, without a prescribed pose.

Many optima are kinks where several failures are equally bad, each with a small basin. Therefore a large number of starts, the
best of even more random configurations, take a few steps of the linearised problem, and the best of them take many.
"""

from __future__ import annotations

import numpy as np

from holdfast.core.errors import HoldfastError
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.optimum import Ascent, Optimum

FREE_STARTS = 10_000
_SAMPLES_PER_START = 20  # random configurations for each start
_CHECKED_PER_START = 8  # number of these, for each start, that are checked for collisions
_FIRST_STEPS = 8  # steps of every start
_LAST_STEPS = 80  # steps of the starts that are refined
_REFINED_FRACTION = 0.05  # of the starts
_VALUE_TOLERANCE = 1e-7  # values that differ by less are equal: nothing is optimised, and nothing is compiled


def optimise_without_pose(ascent: Ascent, seed: np.random.SeedSequence, starts: int) -> Optimum:
    """Find the best configuration, as the optimum of the one pose that it has.

    ``start_q`` of the result is the best random configuration; ``starts`` counts the refined starts.

    Args:
        ascent: Free ascent.
        seed: Seed of the samples.
        starts: Number of random configurations from which an ascent starts.

    Raises:
        HoldfastError: No random configuration has a value, or none is collision-free.
    """
    engine = ascent.engine
    q = engine.sample_starts(_SAMPLES_PER_START * starts, np.random.default_rng(seed))
    values = ascent.values_to_maximise(q)
    values = np.where(np.isfinite(values), values, -np.inf)
    ranking = np.argsort(-values, kind="stable")[: _CHECKED_PER_START * starts]
    if ascent.clearance is not None:
        ranking = ranking[ascent.is_collision_free(q[ranking])]
    ranking = ranking[values[ranking] > -np.inf][:starts]
    if not ranking.size:
        raise HoldfastError(
            f"none of {len(q)} random configurations has a value of {ascent.objective.name}"
            + ("" if ascent.clearance is None else f" without collision: the arm {ascent.clearance.too_close(ascent.margin)}")
        )
    start_q, start_value = q[ranking[0]], values[ranking[0]]
    end_q, end_values = q[ranking], values[ranking]
    if np.ptp(values[np.isfinite(values)]) > _VALUE_TOLERANCE:
        end_q, end_values = _ascend_starts(ascent, end_q, max(1, round(_REFINED_FRACTION * starts)))
    best_index = int(end_values.argmax())
    best_q, best_value = (
        (end_q[best_index], end_values[best_index]) if end_values[best_index] > start_value else (start_q, start_value)
    )
    agrees = end_values >= best_value - max(1e-3 * abs(best_value), _VALUE_TOLERANCE)
    sign = 1.0 if ascent.objective.better == "larger" else -1.0
    status = ascent.objective.row_statuses(best_q[None])
    return Optimum(
        q=best_q[None],
        value=np.array([sign * best_value]),
        start_value=np.array([sign * start_value]),
        start_q=start_q[None],
        status=np.where(np.isin(status, (Status.SINGULAR, Status.UNDEFINED)), status, Status.OK).astype(np.uint8),
        position_error=np.zeros(1),
        rotation_error=np.zeros(1),
        starts=np.array([len(ranking)]),
        agreeing=np.array([agrees.mean()]),
        blocked=np.zeros(1, dtype=bool),
        blocked_by=np.full(1, -1),
    )


def _ascend_starts(ascent: Ascent, q: FloatArray, retained: int) -> tuple[FloatArray, FloatArray]:
    """Ascend from the best starts q (N, n); return the ends (retained, n) and their values, -inf for a collision."""
    has_clearance = ascent.clearance is not None

    def evaluate_worth(q: FloatArray) -> FloatArray:
        value = ascent.values_to_maximise(q)
        return np.where(np.isfinite(value) & (ascent.is_collision_free(q) if has_clearance else True), value, -np.inf)

    dummy_poses = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    q, radius = ascent.ascend(has_clearance, q, dummy_poses, _FIRST_STEPS)
    best_indices = np.argsort(-evaluate_worth(q), kind="stable")[:retained]
    q, _ = ascent.ascend(has_clearance, q[best_indices], dummy_poses[best_indices], _LAST_STEPS, radius[best_indices])
    q = joint_space.wrap_joints(ascent.arm, q)
    return q, evaluate_worth(q)
