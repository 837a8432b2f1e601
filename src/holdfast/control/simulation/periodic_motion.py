"""Detection of motions that repeat themselves forever, by a return to the same configuration with the same velocity.

A motion that has not stopped at its time limit, or after its last step, may still stop later. It never stops if it is on a
closed orbit. The rates of a kinematic arm follow from its configuration, so a return to the same configuration, modulo full
turns, is a return to the same velocity. The distance between two passages measures how far the motion would drift later.
"""

from __future__ import annotations

import numpy as np

from holdfast.control.simulation.runge_kutta import RungeKuttaStepper
from holdfast.control.simulation.system import LARGE_NUMBER, STATE_RUNNING
from holdfast.core.typing import BoolArray, FloatArray

_STEPS_PER_ROUND = 1500  # steps of the integrator in a round, the longest period that can be found
_MAX_STRETCHES = 3  # consecutive rounds, because the motion may still be approaching its orbit
_RETURN_TIME_STEPS = 6  # corrections of the time of a return
_MAX_CALLS = 400  # calls in each correction
_GROUP_RUNS = 32  # runs whose paths are kept at a time
_RETURN_TOLERANCE = 0.1  # fraction of the motion's extent by which a return may miss
_MAX_DRIFT = 1e-2  # fraction of the motion's extent by which it may drift within the horizon
DRIFT_HORIZON = 1e5  # 1/Ke, after the end of the run


def detect_periodic(
    stepper: RungeKuttaStepper, states: FloatArray, parameters: FloatArray, is_revolute: BoolArray, min_speed: float
) -> BoolArray:
    """Find the motions that return to an earlier configuration and are always faster than ``min_speed``.

    Args:
        stepper: The compiled steps.
        states: (N, s) states of runs that still move.
        parameters: (N, p) parameters of the steps.
        is_revolute: (n,) True for joints whose values count modulo full turns.
        min_speed: Speed below which a motion may stop, rad (and m) per 1/Ke.

    Returns:
        (N,) True if the drift from period to period, over :data:`DRIFT_HORIZON` or until the run's own limit if that is
        later, stays below a hundredth of the motion's extent.
    """
    groups = [slice(first, first + _GROUP_RUNS) for first in range(0, len(states), _GROUP_RUNS)]
    results = [_detect_periodic_group(stepper, states[group], parameters[group], is_revolute, min_speed) for group in groups]
    return np.concatenate([np.zeros(0, dtype=bool), *results])


def _detect_periodic_group(
    stepper: RungeKuttaStepper, states: FloatArray, parameters: FloatArray, is_revolute: BoolArray, min_speed: float
) -> BoolArray:
    states, unlimited_parameters = states.copy(), parameters.copy()
    state_parts, limits = stepper.layout.view_parts(states), stepper.parameters.view_parts(unlimited_parameters)
    state_parts["code"][:] = STATE_RUNNING
    horizon = np.maximum(limits["limit"] - state_parts["clock"], DRIFT_HORIZON)[:, 0]
    limits["until"][:] = limits["limit"][:] = LARGE_NUMBER
    is_periodic, active = np.zeros(len(states), dtype=bool), np.arange(len(states))
    for _ in range(_MAX_STRETCHES):
        trajectory = np.stack(_record_steps(stepper, states[active], unlimited_parameters[active]))
        returning = np.zeros(len(active), dtype=bool)
        for column, row in enumerate(active):
            drift = _measure_drift(stepper, trajectory[:, column], unlimited_parameters[row], is_revolute, min_speed)
            is_periodic[row], returning[column] = drift * horizon[row] < _MAX_DRIFT, np.isfinite(drift)
        states[active] = trajectory[-1]
        active = active[returning & ~is_periodic[active]]
        if not active.size:
            break
    return is_periodic


def _record_steps(stepper: RungeKuttaStepper, states: FloatArray, parameters: FloatArray) -> list[FloatArray]:
    """Return the states (N, s) after each step, the initial ones first."""
    if stepper.calls_per_step == 1:
        return list(stepper.loop.trace_states(states, parameters, _STEPS_PER_ROUND))
    trajectory = [states]
    for _ in range(_STEPS_PER_ROUND // stepper.calls_per_step):
        trajectory.append(stepper.loop.trace_states(trajectory[-1], parameters, stepper.calls_per_step)[-1])
    return trajectory


def _measure_drift(
    stepper: RungeKuttaStepper, trajectory: FloatArray, parameters: FloatArray, is_revolute: BoolArray, min_speed: float
) -> float:
    """Return the drift per 1/Ke of a motion with states (T, s) in units of its extent; infinite if it does not return."""
    samples = stepper.layout.view_parts(trajectory)
    if (samples["code"] != STATE_RUNNING).any():
        return np.inf
    speed = np.linalg.norm(samples["rates"], axis=1) / samples["share"][:, 0]
    displacement = _wrap_angles(samples["q"] - samples["q"][0], is_revolute)
    progress = displacement @ samples["rates"][0]
    extent = np.maximum.accumulate(np.linalg.norm(displacement, axis=1))
    for index in (np.flatnonzero((progress[1:-1] < 0) & (progress[2:] >= 0)) + 1).tolist():
        stride = np.linalg.norm(samples["q"][index + 1] - samples["q"][index])
        is_near = not np.linalg.norm(displacement[index]) > 2 * stride + _RETURN_TOLERANCE * extent[index]
        if not is_near or not speed[: index + 2].min() > min_speed:
            continue
        period, return_error = _find_return_time(stepper, trajectory[0], trajectory[index], parameters, is_revolute)
        if return_error < _RETURN_TOLERANCE * extent[index]:
            return float(return_error / (extent[index] * period))
    return np.inf


def _find_return_time(
    stepper: RungeKuttaStepper, start: FloatArray, nearby: FloatArray, parameters: FloatArray, is_revolute: BoolArray
) -> tuple[float, float]:
    """Return the time at which a motion that is ``nearby`` its start passes it, and the distance; infinite if it does not."""
    layout, parameters = stepper.layout, parameters[None].copy()
    start_parts, earlier = layout.view_parts(start[None]), nearby[None].copy()
    if stepper.is_staged:
        layout.view_parts(earlier)["stage"][:] = 0  # an unfinished step begins again, because its length will change
    direction, earlier_parts = start_parts["rates"][0], layout.view_parts(earlier)
    time = float(earlier_parts["time"][0, 0])
    earliest, current = time, earlier_parts
    for _ in range(_RETURN_TIME_STEPS):
        displacement = _wrap_angles(current["q"][0] - start_parts["q"][0], is_revolute)
        speed_along = float(current["rates"][0] @ direction)
        if not speed_along > 0:
            return np.inf, np.inf
        time = max(time - float(displacement @ direction) / speed_along, earliest)
        stepper.parameters.view_parts(parameters)["until"][:] = time
        current = layout.view_parts(stepper.loop.run(earlier, parameters, 0.0, _MAX_CALLS).state)
    displacement = _wrap_angles(current["q"][0] - start_parts["q"][0], is_revolute)
    return float(current["clock"][0, 0] - start_parts["clock"][0, 0]), float(np.linalg.norm(displacement))


def _wrap_angles(q: FloatArray, is_revolute: BoolArray) -> FloatArray:
    return np.where(is_revolute, np.arctan2(np.sin(q), np.cos(q)), q)
