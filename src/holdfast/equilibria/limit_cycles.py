"""What a run that never stops does instead: a limit cycle, or joints that turn forever.

A run that ends moving has had its whole time limit to approach what attracts it. From its end the motion is followed until
it comes near itself again, modulo whole turns; the return is then made exact by shooting (Newton on the state and the
period, with the variational equations), whose matrix gives the Floquet multipliers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import check_poses
from holdfast.arm.task import target_poses
from holdfast.equilibria.system import RestSystem, wrapped
from holdfast.errors import InputError
from holdfast.result import Result
from holdfast.simulation.runs import Outcome
from holdfast.simulation.system import tool_errors

if TYPE_CHECKING:
    from holdfast.simulation.runs import Runs

Array = NDArray[np.float64]

_SAMPLES = 4000
_NEAR = 0.1  # of the extent of the motion: nearer to its start, it may have come round
_TRIES, _NEWTON = 6, 8
_CLOSED = 1e-8  # rad (and m)
_ACCURACY: dict[str, Any] = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12}


@dataclass(frozen=True, eq=False, kw_only=True)
class Orbit(Result):
    """The motion at the end of one run.

    Attributes:
        label: ``limit cycle``, ``turning`` (a joint turns forever) or ``unknown``.
        period: s (without the speed limit of the law, which changes no path); NaN where the motion did not close.
        amplitude: (n,) greatest less least value of each joint over a period, rad (or m); over the window where there is none.
        windings: (n,) whole turns of each joint in a period; 0 where there is none.
        multipliers: Floquet multipliers, without the 1 along the orbit; empty where there is no period.
        rates: (n,) mean rates, rad/s (or m/s).
        q: (n,) a configuration of the orbit.
        position_error: Least and greatest distance of the tool point from the target in the directions of the task, m.
        angle_error: Least and greatest angle of the end effector from the target in the directions of the task, rad.
        largest_times: Times after ``q`` at which the distance and the angle are greatest, s.
    """

    label: str
    period: float
    amplitude: Array
    windings: NDArray[np.int64]
    multipliers: NDArray[np.complex128]
    rates: Array
    q: Array
    position_error: tuple[float, float]
    angle_error: tuple[float, float]
    largest_times: tuple[float, float]

    @property
    def stable(self) -> bool:
        """Whether it attracts: a closed orbit of which every multiplier is inside the unit circle."""
        return self.multipliers.size > 0 and bool((np.abs(self.multipliers) < 1).all())

    def describe(self) -> list[str]:
        """A phrase for people."""
        return [self.label if np.isnan(self.period) else f"{self.label} (period {self.period:.4g} s)"]


def orbit(runs: Runs, k: int = 0, window: float = 400.0) -> Orbit:
    """What run k, which ended moving, does forever.

    Args:
        runs: Of :func:`holdfast.simulation.simulate`, in continuous time.
        k: Which run, from 0.
        window: How long to look for a return, in units of 1/Ke.

    Raises:
        InputError: No such run, or one that did not end moving.
    """
    codes = np.atleast_1d(runs.code)
    if not 0 <= k < codes.size:
        raise InputError(f"there is no run {k}; runs are 0 to {codes.size - 1}")
    if codes[k] != Outcome.MOVING or runs.cycles:
        raise InputError(f"run {k} did not end moving in continuous time, so that it has no orbit")
    locks, end = np.atleast_2d(runs.lock_time)[k], np.atleast_1d(runs.time)[k]
    joints = tuple(int(i) for i in np.flatnonzero(locks <= end))
    target = runs.target
    poses = check_poses(target) if target.shape[-2:] == (4, 4) else target_poses(runs.law.task, target)[0]
    return _Shooting(RestSystem(runs.law, poses[min(k, len(poses) - 1)], joints)).orbit(np.atleast_2d(runs.q_final)[k], window)


class _Shooting:
    def __init__(self, system: RestSystem) -> None:
        self.system = system
        self.moving = np.flatnonzero(system.healthy)
        self._field = system.linear.field(system.pose, system.healthy)

    def orbit(self, q: Array, window: float) -> Orbit:
        from scipy.integrate import solve_ivp

        for length in (window / 16, window / 4, window):
            run: Any = solve_ivp(lambda _, x: self._field(x), (0, length), q, dense_output=True, **_ACCURACY)
            time = np.linspace(0, length, _SAMPLES)
            path = run.sol(time).T
            for guess in self._returns(path, time):
                found = self._closed(q, guess)
                if found is not None:
                    state, period, matrix, windings = found
                    once: Any = solve_ivp(lambda _, x: self._field(x), (0, period), state, dense_output=True, **_ACCURACY)
                    return self._made(once.sol(np.linspace(0, period, _SAMPLES)).T, period, windings, matrix)
        return self._made(path, float("nan"), np.zeros(len(q), dtype=np.int64), np.empty((0, 0)), window)

    def _returns(self, path: Array, time: Array) -> Sequence[float]:
        """Times at which the motion is nearest to its start, once it has left it."""
        away = np.linalg.norm(wrapped(self.system.law.arm, path - path[0]), axis=1)
        left = int(np.argmax(away > _NEAR * away.max()))
        dip = np.flatnonzero((away[1:-1] <= away[:-2]) & (away[1:-1] < away[2:])) + 1
        dip = dip[(dip > left) & (away[dip] < _NEAR * away.max())]
        return [float(t) for t in time[dip[:_TRIES]]]

    def _closed(self, q: Array, period: float) -> tuple[Array, float, Array, NDArray[np.int64]] | None:
        """A state on the closed orbit near q, its period, the matrix of a return, and whole turns of each joint."""
        arm, moving, h = self.system.law.arm, self.moving, self.moving.size
        guess, plane = period, self._field(q)[moving]
        for _ in range(_NEWTON):
            end, matrix = self._flow(q, period)
            gap = wrapped(arm, end - q)[moving]
            if np.linalg.norm(gap) < _CLOSED:
                turns = np.where(arm.prismatic, 0, np.round((end - q) / (2 * np.pi)))
                return q, period, matrix, turns.astype(np.int64)
            bordered = np.zeros((h + 1, h + 1))
            bordered[:h, :h], bordered[:h, h], bordered[h, :h] = matrix - np.eye(h), self._field(end)[moving], plane
            try:
                step = np.linalg.solve(bordered, np.r_[-gap, 0.0])
            except np.linalg.LinAlgError:
                return None
            q, period = q.copy(), period + float(step[h])
            q[moving] += step[:h]
            if not 0.5 * guess < period < 2 * guess or np.linalg.norm(step[:h]) > 1.0:
                return None
        return None

    def _flow(self, q: Array, period: float) -> tuple[Array, Array]:
        """Where the motion is after a time, and its derivative by the start, (h, h)."""
        from scipy.integrate import solve_ivp

        system, n, h = self.system, self.system.law.arm.n, self.moving.size

        def field(_: float, x: Array) -> Array:
            slopes = system.linear.matrices(x[None, :n], system.pose, system.healthy)[0]
            return np.concatenate([self._field(x[:n]), (slopes @ x[n:].reshape(h, h)).ravel()])

        end = solve_ivp(field, (0, period), np.concatenate([q, np.eye(h).ravel()]), **_ACCURACY).y[:, -1]
        return end[:n], end[n:].reshape(h, h)

    def _made(
        self, path: Array, period: float, windings: NDArray[np.int64], matrix: Array, window: float | None = None
    ) -> Orbit:
        system, gain = self.system, self.system.law.gain
        travelled = path[-1] - path[0]
        turning = (np.abs(travelled) > 2 * np.pi - 1e-6) & ~system.law.arm.prismatic
        closed = window is None
        label = "turning" if (windings.any() if closed else turning.any()) else "limit cycle" if closed else "unknown"
        values = np.linalg.eigvals(matrix).astype(np.complex128) if matrix.size else np.empty(0, dtype=np.complex128)
        if values.size:
            values = np.delete(values, np.argmin(np.abs(values - 1)))
        _, norm, _ = system.linear.rates(path, system.pose)
        errors = tool_errors(system.law, path, norm, system.pose)
        step = (period if window is None else window) / gain / (len(path) - 1)
        return Orbit(
            label=label,
            period=period / gain,
            amplitude=np.ptp(path, axis=0),
            windings=windings,
            multipliers=values,
            rates=travelled / (period if closed else window) * gain,
            q=path[0],
            position_error=(float(errors[0].min()), float(errors[0].max())),
            angle_error=(float(errors[1].min()), float(errors[1].max())),
            largest_times=(step * int(errors[0].argmax()), step * int(errors[1].argmax())),
        )
