"""Motion of a run that never stops: a limit cycle, or joints that rotate forever.

A run that ends moving has had its whole time limit to approach its attractor. From its end, the motion is integrated until it
approaches itself again, modulo full turns. Shooting (Newton's method on the state and the period, with the variational
equations) then makes the return exact, and its matrix yields the Floquet multipliers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.system import RestSystem, wrap_angles
from holdfast.control.simulation.runs import RunOutcome
from holdfast.control.simulation.system import position_and_angle_errors
from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm.poses import check_poses
from holdfast.model.arm.task import target_poses

if TYPE_CHECKING:
    from holdfast.control.simulation.runs import Runs


_ORBIT_SAMPLES = 4000
_RETURN_FRACTION = 0.1  # fraction of the motion's extent; a motion closer than this to its start may have returned
_MAX_GUESSES = 6
_NEWTON_STEPS = 8
_CLOSURE_TOLERANCE = 1e-8  # rad (and m)
_SOLVER_OPTIONS: dict[str, Any] = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12}


@dataclass(frozen=True, eq=False, kw_only=True)
class Orbit(Result):
    """Motion at the end of one run that never stops.

    Attributes:
        label: ``limit cycle``, ``turning`` (a joint rotates forever) or ``unknown``.
        period: Period, s, without the speed limit of the law, which changes no path; NaN if the motion did not close.
        amplitude: (n,) range of each joint over a period, rad (or m); over the window if there is no period.
        windings: (n,) full turns of each joint in a period; 0 if there is no period.
        multipliers: Floquet multipliers, without the 1 along the orbit; empty if there is no period.
        rates: (n,) mean joint rates, rad/s (or m/s).
        q: (n,) configuration on the orbit, rad and m.
        position_error: Least and greatest distance of the tool point from the target in the directions of the task, m.
        angle_error: Least and greatest angle of the end effector from the target in the directions of the task, rad.
        largest_times: Times after ``q`` at which the distance and the angle are greatest, s.
    """

    label: str
    period: float
    amplitude: FloatArray
    windings: IndexArray
    multipliers: NDArray[np.complex128]
    rates: FloatArray
    q: FloatArray
    position_error: tuple[float, float]
    angle_error: tuple[float, float]
    largest_times: tuple[float, float]

    @property
    def stable(self) -> bool:
        """True if the orbit attracts: it is closed, and every multiplier is inside the unit circle."""
        return self.multipliers.size > 0 and bool((np.abs(self.multipliers) < 1).all())


def orbit(runs: Runs, k: int = 0, window: float = 400.0) -> Orbit:
    """Find the motion that a run repeats forever after it ended moving.

    Args:
        runs: Runs of :func:`holdfast.control.simulation.simulate` in continuous time.
        k: Index of the run, from 0.
        window: Duration in which the motion must return, in units of 1/Ke.

    Raises:
        InputError: There is no such run, or it did not end moving.
    """
    codes = np.atleast_1d(runs.code)
    if not 0 <= k < codes.size:
        raise InputError(f"there is no run {k}; give an index from 0 to {codes.size - 1}")
    if codes[k] != RunOutcome.MOVING or runs.cycles:
        raise InputError(f"run {k} did not end moving in continuous time, so it has no orbit; give a run that did")
    lock_times, end_time = np.atleast_2d(runs.lock_time)[k], np.atleast_1d(runs.time)[k]
    joints = tuple(int(joint) for joint in np.flatnonzero(lock_times <= end_time))
    target = runs.target
    poses = check_poses(target) if target.shape[-2:] == (4, 4) else target_poses(runs.law.task, target)[0]
    return _ShootingMethod(RestSystem(runs.law, poses[min(k, len(poses) - 1)], joints)).find_orbit(
        np.atleast_2d(runs.q_final)[k], window
    )


class _ShootingMethod:
    def __init__(self, system: RestSystem) -> None:
        self.system = system
        self.moving_joints = np.flatnonzero(system.healthy)
        self._field = system.linear.field(system.pose, system.healthy)

    def find_orbit(self, q: FloatArray, window: float) -> Orbit:
        from scipy.integrate import solve_ivp

        for length in (window / 16, window / 4, window):
            solution: Any = solve_ivp(
                lambda _, state_vector: self._field(state_vector), (0, length), q, dense_output=True, **_SOLVER_OPTIONS
            )
            time = np.linspace(0, length, _ORBIT_SAMPLES)
            path = solution.sol(time).T
            for period_guess in self._find_returns(path, time):
                closed_orbit = self._close_orbit(q, period_guess)
                if closed_orbit is not None:
                    state, period, matrix, windings = closed_orbit
                    period_solution: Any = solve_ivp(
                        lambda _, state_vector: self._field(state_vector),
                        (0, period),
                        state,
                        dense_output=True,
                        **_SOLVER_OPTIONS,
                    )
                    return self._make_orbit(
                        period_solution.sol(np.linspace(0, period, _ORBIT_SAMPLES)).T, period, windings, matrix
                    )
        return self._make_orbit(path, float("nan"), np.zeros(len(q), dtype=np.int64), np.empty((0, 0)), window)

    def _find_returns(self, path: FloatArray, time: FloatArray) -> Sequence[float]:
        """Return the times at which the motion is nearest to its start after it has left it."""
        distance = np.linalg.norm(wrap_angles(self.system.law.arm, path - path[0]), axis=1)
        departure = int(np.argmax(distance > _RETURN_FRACTION * distance.max()))
        minima = np.flatnonzero((distance[1:-1] <= distance[:-2]) & (distance[1:-1] < distance[2:])) + 1
        minima = minima[(minima > departure) & (distance[minima] < _RETURN_FRACTION * distance.max())]
        return [float(return_time) for return_time in time[minima[:_MAX_GUESSES]]]

    def _close_orbit(self, q: FloatArray, period: float) -> tuple[FloatArray, float, FloatArray, IndexArray] | None:
        """Return a state on the closed orbit near q, its period, the matrix of a return, and the full turns of each joint."""
        arm, moving_joints, h = self.system.law.arm, self.moving_joints, self.moving_joints.size
        first_period, section_normal = period, self._field(q)[moving_joints]
        for _ in range(_NEWTON_STEPS):
            end_state, matrix = self._integrate_flow(q, period)
            return_error = wrap_angles(arm, end_state - q)[moving_joints]
            if np.linalg.norm(return_error) < _CLOSURE_TOLERANCE:
                full_turns = np.where(arm.prismatic, 0, np.round((end_state - q) / (2 * np.pi)))
                return q, period, matrix, full_turns.astype(np.int64)
            bordered = np.zeros((h + 1, h + 1))
            bordered[:h, :h] = matrix - np.eye(h)
            bordered[:h, h] = self._field(end_state)[moving_joints]
            bordered[h, :h] = section_normal
            try:
                step = np.linalg.solve(bordered, np.r_[-return_error, 0.0])
            except np.linalg.LinAlgError:
                return None
            q, period = q.copy(), period + float(step[h])
            q[moving_joints] += step[:h]
            if not 0.5 * first_period < period < 2 * first_period or np.linalg.norm(step[:h]) > 1.0:
                return None
        return None

    def _integrate_flow(self, q: FloatArray, period: float) -> tuple[FloatArray, FloatArray]:
        """Return the state after a period, and its derivative (h, h) with respect to the start."""
        from scipy.integrate import solve_ivp

        system, n, h = self.system, self.system.law.arm.n, self.moving_joints.size

        def variational_field(_: float, state_vector: FloatArray) -> FloatArray:
            jacobian = system.linear.matrices(state_vector[None, :n], system.pose, system.healthy)[0]
            return np.concatenate([self._field(state_vector[:n]), (jacobian @ state_vector[n:].reshape(h, h)).ravel()])

        end_state = solve_ivp(variational_field, (0, period), np.concatenate([q, np.eye(h).ravel()]), **_SOLVER_OPTIONS).y[
            :, -1
        ]
        return end_state[:n], end_state[n:].reshape(h, h)

    def _make_orbit(
        self, path: FloatArray, period: float, windings: IndexArray, matrix: FloatArray, window: float | None = None
    ) -> Orbit:
        system, gain = self.system, self.system.law.gain
        displacement = path[-1] - path[0]
        has_turned = (np.abs(displacement) > 2 * np.pi - 1e-6) & ~system.law.arm.prismatic
        is_closed = window is None
        label = "turning" if (windings.any() if is_closed else has_turned.any()) else "limit cycle" if is_closed else "unknown"
        multipliers = np.linalg.eigvals(matrix).astype(np.complex128) if matrix.size else np.empty(0, dtype=np.complex128)
        if multipliers.size:
            multipliers = np.delete(multipliers, np.argmin(np.abs(multipliers - 1)))
        _, error_norm, _ = system.linear.rates(path, system.pose)
        errors = position_and_angle_errors(system.law, path, error_norm, system.pose)
        time_step = (period if window is None else window) / gain / (len(path) - 1)
        return Orbit(
            label=label,
            period=period / gain,
            amplitude=np.ptp(path, axis=0),
            windings=windings,
            multipliers=multipliers,
            rates=displacement / (period if is_closed else window) * gain,
            q=path[0],
            position_error=(float(errors[0].min()), float(errors[0].max())),
            angle_error=(float(errors[1].min()), float(errors[1].max())),
            largest_times=(time_step * int(errors[0].argmax()), time_step * int(errors[1].argmax())),
        )
