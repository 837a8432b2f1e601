"""Evidence that a motion repeats itself forever: it returns to the same configuration with the same velocity.

A motion under way at its time limit, or after its last step, may yet stop. It never stops if it is on a closed orbit. The
rates of a kinematic arm follow from its configuration, so a return to the same configuration, modulo whole turns, is a
return to the same velocity. The distance that remains between two passages measures how far the motion would drift later.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.simulation.runge_kutta import Steps
from holdfast.simulation.system import FAR, RUNNING

Array = NDArray[np.float64]

_STEPS = 1500  # of the integrator: a period is no longer
_ROUNDS = 3  # stretches of so many steps, one after the other: the motion may still be approaching its orbit
_NEWTON, _MOST = 6, 400  # corrections of the time of a return; calls in each
_ROWS = 32  # at a time, whose ways are kept
_NEAR = 0.1  # of the motion's extent: a return that misses by more is none
_DRIFT = 1e-2  # of the motion's extent: the most that it may drift within the horizon
HORIZON = 1e5  # 1/Ke, after the end of the run


def find_endless(
    steps: Steps, states: Array, parameters: Array, turning: NDArray[np.bool_], slowest: float
) -> NDArray[np.bool_]:
    """Find the motions that return to where they were, with a speed that never falls to ``slowest``.

    Args:
        steps: The compiled steps.
        states: (N, s) of runs that are under way.
        parameters: (N, p) of the steps.
        turning: (n,) joints of which the values count modulo whole turns.
        slowest: rad (and m) per 1/Ke.

    Returns:
        (N,) True where the drift from period to period, over :data:`HORIZON` or until the run's own limit if that is later,
        stays below a hundredth of the motion's extent.
    """
    groups = [slice(k, k + _ROWS) for k in range(0, len(states), _ROWS)]
    found = [_find_endless(steps, states[g], parameters[g], turning, slowest) for g in groups]
    return np.concatenate([np.zeros(0, dtype=bool), *found])


def _find_endless(
    steps: Steps, states: Array, parameters: Array, turning: NDArray[np.bool_], slowest: float
) -> NDArray[np.bool_]:
    layout = steps.state
    states, onward = states.copy(), parameters.copy()
    now = layout.values(states)
    now["code"][:] = RUNNING
    horizon = np.maximum(parameters[:, -2] - now["clock"][:, 0], HORIZON)
    onward[:, -3:-1] = FAR
    endless, rows = np.zeros(len(states), dtype=bool), np.arange(len(states))
    for _ in range(_ROUNDS):
        way = np.stack(_walk(steps, states[rows], onward[rows]))
        returning = np.zeros(len(rows), dtype=bool)
        for k, row in enumerate(rows):
            drift = _drift(steps, way[:, k], onward[row], turning, slowest)
            endless[row], returning[k] = drift * horizon[row] < _DRIFT, np.isfinite(drift)
        states[rows] = way[-1]
        rows = rows[returning & ~endless[rows]]
        if not rows.size:
            break
    return endless


def _walk(steps: Steps, states: Array, parameters: Array) -> list[Array]:
    """Return the states (N, s) after each step, the given ones first."""
    if steps.calls == 1:
        return list(steps.loop.walk(states, parameters, _STEPS))
    way = [states]
    for _ in range(_STEPS // steps.calls):
        way.append(steps.loop.walk(way[-1], parameters, steps.calls)[-1])
    return way


def _drift(steps: Steps, way: Array, parameters: Array, turning: NDArray[np.bool_], slowest: float) -> float:
    """Return the drift of a motion per 1/Ke, in units of its extent, by its first return; infinite where it does not return.

    Args:
        steps: The compiled steps.
        way: (T, s) states of the motion, one after the other.
        parameters: (p,) of the steps.
        turning: (n,) joints of which the values count modulo whole turns.
        slowest: rad (and m) per 1/Ke; a motion that falls to it may stop.
    """
    samples = steps.state.values(way)
    if (samples["code"] != RUNNING).any():
        return np.inf
    speed = np.linalg.norm(samples["rates"], axis=1) / samples["share"][:, 0]
    away = _wrapped(samples["q"] - samples["q"][0], turning)
    ahead = away @ samples["rates"][0]
    extent = np.maximum.accumulate(np.linalg.norm(away, axis=1))
    for k in (np.flatnonzero((ahead[1:-1] < 0) & (ahead[2:] >= 0)) + 1).tolist():
        stride = np.linalg.norm(samples["q"][k + 1] - samples["q"][k])
        if np.linalg.norm(away[k]) > 2 * stride + _NEAR * extent[k] or not speed[: k + 2].min() > slowest:
            continue
        period, missed = _returned(steps, way[0], way[k], parameters, turning)
        if missed < _NEAR * extent[k]:
            return float(missed / (extent[k] * period))
    return np.inf


def _returned(steps: Steps, start: Array, near: Array, parameters: Array, turning: NDArray[np.bool_]) -> tuple[float, float]:
    """Return when a motion that is ``near`` its start passes the start, and at which distance; infinite if it does not."""
    layout, parameters = steps.state, parameters[None].copy()
    first, before = layout.values(start[None]), near[None].copy()
    if steps.staged:
        layout.values(before)["stage"][:] = 0  # a step under way begins again, as its length will change
    along, then = first["rates"][0], layout.values(before)
    time = float(then["time"][0, 0])
    earliest, here = time, then
    for _ in range(_NEWTON):
        gap = _wrapped(here["q"][0] - first["q"][0], turning)
        pace = float(here["rates"][0] @ along)
        if not pace > 0:
            return np.inf, np.inf
        time = max(time - float(gap @ along) / pace, earliest)
        parameters[0, -3] = time
        here = layout.values(steps.loop.run(before, parameters, 0.0, _MOST).state)
    gap = _wrapped(here["q"][0] - first["q"][0], turning)
    return float(here["clock"][0, 0] - first["clock"][0, 0]), float(np.linalg.norm(gap))


def _wrapped(q: Array, turning: NDArray[np.bool_]) -> Array:
    return np.where(turning, np.arctan2(np.sin(q), np.cos(q)), q)
