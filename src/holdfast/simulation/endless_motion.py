"""Motions that circle forever, and so fast that their steps run out long before the time limit.

Where a joint turns at tens of radians per time constant, no budget of steps lasts until the limit. Such a motion is told by
its return: once it is on its limit cycle it comes back to where it was, modulo whole turns, and by how little it misses says
how far it would have drifted at the limit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.simulation.runge_kutta import Steps
from holdfast.simulation.system import FAR, RUNNING

Array = NDArray[np.float64]

_CALLS = 1500  # of the compiled steps: a period is no longer
_NEWTON, _MOST = 6, 400  # corrections of the time of a return; calls in each
_ROWS = 32  # at a time, whose ways are kept
_DRIFT = 1e-2  # of the motion's extent: the most that it may drift until the limit


def circling(steps: Steps, states: Array, parameters: Array, turning: NDArray[np.bool_], slowest: float) -> NDArray[np.bool_]:
    """(N,) True where a motion circles, with a speed that never falls to ``slowest``.

    Args:
        steps: The compiled steps.
        states: (N, s) of runs that are under way.
        parameters: (N, p) of the steps; the limit of the clock is when the drift must still be small.
        turning: (n,) joints of which the values count modulo whole turns.
        slowest: rad (and m) per 1/Ke.
    """
    groups = [slice(k, k + _ROWS) for k in range(0, len(states), _ROWS)]
    found = [_circling(steps, states[g], parameters[g], turning, slowest) for g in groups]
    return np.concatenate([np.zeros(0, dtype=bool), *found])


def _circling(steps: Steps, states: Array, parameters: Array, turning: NDArray[np.bool_], slowest: float) -> NDArray[np.bool_]:
    layout, limit = steps.state, parameters[:, -2]
    going = parameters.copy()
    going[:, -3:-1] = FAR
    way = steps.loop.walk(states, going, _CALLS)
    out = np.zeros(len(states), dtype=bool)
    for row in range(len(states)):
        samples = layout.values(way[:, row])
        if (samples["code"] != RUNNING).any():
            continue
        speed = np.linalg.norm(samples["rates"], axis=1) / samples["share"][:, 0]
        away = _wrapped(samples["q"] - samples["q"][0], turning)
        ahead = away @ samples["rates"][0]
        extent = np.maximum.accumulate(np.linalg.norm(away, axis=1))
        for k in (np.flatnonzero((ahead[1:-1] < 0) & (ahead[2:] >= 0)) + 1).tolist():
            stride = np.linalg.norm(samples["q"][k + 1] - samples["q"][k])
            if np.linalg.norm(away[k]) > 2 * stride or not speed[: k + 2].min() > slowest:
                continue
            period, missed = _returned(steps, way[0, row], way[k, row], going[row], turning)
            if missed * (limit[row] - samples["clock"][0, 0]) < _DRIFT * extent[k] * period:
                out[row] = True
                break
    return out


def _returned(steps: Steps, start: Array, near: Array, parameters: Array, turning: NDArray[np.bool_]) -> tuple[float, float]:
    """What the clock of a motion that is ``near`` its start says when it passes that, and how far off; if it does, else far."""
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
