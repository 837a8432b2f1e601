"""Differential equations of a failed arm, and the values that are recorded along a motion.

The controller has no fault information. It commands ``G(q) Ke e``, and locked joints do not follow. With ``mask`` 0 for a
locked joint and 1 for a healthy one, ``q' = mask G(q) Ke e(q)``.

Time is in units of ``1/Ke`` here, so that thresholds have no units.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (3), (6), (7).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kinematics.solvers.inverse_kinematics import scaled_error_and_jacobian, task_error_and_jacobian
from holdfast.model.arm import kinematics

LARGE_NUMBER = 1e300  # stands for "never" in kernels, which turn infinity into NaN
MAX_UNROLLED_OPERATIONS = 12_000  # operations in one call, about


@dataclass(frozen=True)
class StateRates:
    """Rates at one configuration, with time in units of ``1/Ke``."""

    rates: SX  # (n,) joint rates, 0 for locked joints
    tool_speed: SX  # tool speed, m
    speed_fraction: SX  # fraction to which the speed limit reduces the command; 1 if it does not act
    squared_error: SX  # squared error of the task's rows, m and rad
    squared_error_rate: SX  # time derivative of the squared error


class FailedArmSystem:
    """Symbols of a law and its target, and the differential equation of the failed arm."""

    def __init__(self, law: Law) -> None:
        self.law = law
        self.q = kinematics.joint_symbols(law.arm)
        self.mask = ca.SX.sym("mask", law.arm.n)
        self.target, self.rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        self.parameters = [self.target, self.rotation, self.mask]
        self._uses_orientation = law.task.angular or law.task.frame != "base"
        self.made_of = law
        # The motion does not need an orientation if no row of the task has one.
        rotation = {"rotation": self.rotation} if self._uses_orientation else {}
        self.inputs = {"target": self.target, **rotation, "mask": self.mask}

    def target_input_values(self, target: FloatArray) -> dict[str, FloatArray]:
        """Return targets, poses (N, 4, 4) or task components (N, m), as values (N, ...) of ``inputs`` except the mask."""
        if target.ndim == 2:
            return {"target": np.asarray(target @ self.law.task.rows[:, :3])}
        rotation = {"rotation": target[:, :3, :3].reshape(-1, 9)} if self._uses_orientation else {}
        return {"target": target[:, :3, 3], **rotation}

    def error_and_jacobian(self, q: SX) -> tuple[SX, SX]:
        """Return the error (m,) of the task's components, m and rad, and its Jacobian (m, n)."""
        return task_error_and_jacobian(self.law.arm, self.law.task, q, self.target, self.rotation)

    def scaled_error_and_jacobian(self, q: SX) -> tuple[SX, SX]:
        """Return the error and Jacobian with lengths in units of the arm's length, for thresholds."""
        return scaled_error_and_jacobian(self.law.arm, self.law.task, q, self.target, self.rotation)

    def compute_limited_velocity(self, error: SX) -> tuple[SX, SX]:
        """Return the commanded task velocity (m,) per ``1/Ke``, and the fraction to which the speed limit reduces it."""
        velocity = self.law.command(error) / self.law.gain
        if self.law.speed_limit is None:
            return velocity, ca.SX(1)
        squared_error, is_off = ca.sumsqr(error), ca.sumsqr(error) > 0
        return velocity, ca.if_else(is_off, ca.dot(velocity, error) / ca.if_else(is_off, squared_error, 1.0), 1.0)

    def compute_rates(self, q: SX, velocity: SX) -> SX:
        """Return the joint rates (n,) of the failed arm for a command v."""
        return self.mask * self.law.rates(q, velocity)

    def compute_tool_speed(self, q: SX, rates: SX) -> SX:
        """Return the speed of the tool point, m."""
        return ca.sqrt(ca.sumsqr(kinematics.world_jacobian(self.law.arm, q)[:3, :] @ rates))

    @cached_property
    def rates_function(self) -> ca.Function:
        """Function behind :meth:`evaluate_state_rates`, built once because the expressions of a law take a second."""
        q = self.q
        error, jacobian = self.error_and_jacobian(q)
        velocity, speed_fraction = self.compute_limited_velocity(error)
        rates = self.compute_rates(q, velocity)
        # Exact also for rotations: the norm of log R changes with the component of the angular velocity along it.
        squared_error_rate = -2 * ca.dot(error, jacobian @ rates)
        outputs = [rates, self.compute_tool_speed(q, rates), speed_fraction, ca.sumsqr(error), squared_error_rate]
        return ca.Function("at", [q, *self.inputs.values()], outputs, {"cse": True})

    def evaluate_state_rates(self, q: SX) -> StateRates:
        """Evaluate the rates at a configuration q (n,)."""
        return StateRates(*self.rates_function(q, *self.inputs.values()))


def prescribed_offset(law: Law, tool: FloatArray, target: FloatArray) -> FloatArray:
    """Return the offsets (N, 3), m, from tools to targets, poses (N, 4, 4), in the directions that the task prescribes."""
    linear = law.task.rows[:, :3]
    projector = linear.T @ linear
    offset = target[:, :3, 3] - tool[:, :3, 3]
    if law.task.frame == "base":
        return np.asarray(offset @ projector)
    rotation = tool[:, :3, :3]
    return np.asarray(np.einsum("nij,jk,nlk,nl->ni", rotation, projector, rotation, offset))


def split_error_norms(law: Law, error: FloatArray, tool: FloatArray, target: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Split norms (N,) of the task's error into position errors (N,), m, and angle errors (N,), rad.

    If the task has no angular row, the angle errors are 0, and the tools and targets (N, 4, 4) are not used.
    """
    if not law.task.angular:
        return np.asarray(error), np.zeros(np.shape(error))
    linear = np.linalg.norm(prescribed_offset(law, tool, target), axis=1)
    return linear, np.sqrt(np.maximum(error**2 - linear**2, 0.0))


def position_and_angle_errors(law: Law, q: FloatArray, error: FloatArray, target: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Compute position errors (N,), m, and angle errors (N,), rad, at q (N, n) with error norms (N,), for a target or N."""
    return split_error_norms(law, error, law.arm.forward_kinematics(q), np.broadcast_to(target, (len(q), 4, 4)))


def scale_errors(law: Law, error: FloatArray, tool: FloatArray, target: FloatArray) -> FloatArray:
    """Return norms of errors (N,), m and rad, with lengths in units of the arm's length; tools and targets are in m."""
    linear, angular = split_error_norms(law, error, tool, target)
    return np.asarray(np.hypot(linear / law.arm.length_unit, angular))


def configuration_state_parts(state_rates: StateRates) -> dict[str, SX]:
    """Return the parts of a state that belong to its configuration."""
    return {
        "rates": state_rates.rates,
        "hand": state_rates.tool_speed,
        "share": state_rates.speed_fraction,
        "error": state_rates.squared_error,
        "slope": state_rates.squared_error_rate,
    }


class ColumnLayout:
    """Layout of named scalars and vectors, one after the other, in rows such as the states of a loop."""

    def __init__(self, **sizes: int) -> None:
        self.slices: dict[str, slice] = {}
        offset = 0
        for name, size in sizes.items():
            self.slices[name] = slice(offset, offset + size)
            offset += size
        self.size = offset

    def split_symbol(self, state: SX) -> dict[str, SX]:
        """Return the parts of a state symbol by name."""
        return {name: state[span] for name, span in self.slices.items()}

    def view_parts(self, state: FloatArray) -> dict[str, FloatArray]:
        """Return the parts of states (N, s) by name, each (N, size), as views."""
        return {name: state[:, span] for name, span in self.slices.items()}

    def join_parts(self, parts: dict[str, SX]) -> SX:
        """Return a state from its parts."""
        return ca.vertcat(*[parts[name] for name in self.slices])


class ParameterLayout(ColumnLayout):
    """Layout of the parameters of a loop in rows, in which a matrix is stored row by row.

    Attributes:
        symbols: Symbols of the parameters, in the order of their columns.
    """

    def __init__(self, **symbols: SX) -> None:
        super().__init__(**{name: symbol.numel() for name, symbol in symbols.items()})
        self.symbols = list(symbols.values())

    def make_rows(self, count: int, **values: FloatArray | float) -> FloatArray:
        """Return rows (count, p) with these values; the columns of all other parameters are not set yet."""
        rows = np.empty((count, self.size))
        parts = self.view_parts(rows)
        for name, value in values.items():
            parts[name][:] = value
        return rows

    def split_inputs(self, rows: FloatArray) -> dict[str, FloatArray]:
        """Return the parameters of rows (N, p) by name as inputs of a kernel: vectors (N, size) and matrices (N, r, c)."""
        shapes = [symbol.shape for symbol in self.symbols]
        return {
            name: part.reshape(-1, *shape) if shape[1] > 1 else part
            for (name, part), shape in zip(self.view_parts(rows).items(), shapes, strict=True)
        }


def elementwise_min(a: SX, b: SX) -> SX:
    """Return the elementwise minimum, without fmin."""
    return ca.if_else(a < b, a, b)


def elementwise_max(a: SX, b: SX) -> SX:
    """Return the elementwise maximum, without fmax."""
    return ca.if_else(a > b, a, b)


def value_at_turning_point(start: SX, end: SX, start_rate: SX, end_rate: SX) -> SX:
    """Return the value at which a derivative (per step) changes sign between two ends, or ``end`` if it does not.

    The position is that of a parabola, and the value that of the cubic. The cubic is flat there, so the value is accurate.
    """
    changes_sign = start_rate * end_rate < 0
    x = ca.if_else(changes_sign, start_rate / ca.if_else(changes_sign, start_rate - end_rate, 1.0), 1.0)
    y = 1 - x
    return end + y * (y * ((1 + 2 * x) * (start - end) + x * start_rate) - x * x * end_rate)


def choose_parts(condition: SX, if_true: dict[str, SX], if_false: dict[str, SX]) -> dict[str, SX]:
    """Choose each part from the first or the second set by a condition."""
    return {name: ca.if_else(condition, value, if_false[name]) for name, value in if_true.items()}


# Codes in the state of a loop, which tell whether and how a motion has ended.
STATE_RUNNING = 0
STATE_AT_REST = 1
STATE_COLLAPSED = 2
STATE_TIME_LIMIT = 3
STATE_PHASE_END = 4
STATE_ARRIVED = 5
END_WINDOW_FRACTION = 0.8  # fraction of the time limit from which the speeds near the end are recorded, in two halves
LATE_WINDOW_FRACTION = 0.9


def track_final_speeds(parts: dict[str, SX], speed: SX, clock: SX, limit: SX) -> dict[str, SX]:
    """Update the speeds near the end of the time limit: the least, and the greatest of the first and the second half."""
    is_in_window, is_late = clock >= END_WINDOW_FRACTION * limit, clock >= LATE_WINDOW_FRACTION * limit
    is_early = ca.logic_and(is_in_window, ca.logic_not(is_late))
    return {
        "slowest": ca.if_else(is_in_window, elementwise_min(parts["slowest"], speed), parts["slowest"]),
        "early": ca.if_else(is_early, elementwise_max(parts["early"], speed), parts["early"]),
        "late": ca.if_else(is_late, elementwise_max(parts["late"], speed), parts["late"]),
    }


def make_state_loop(
    name: str, step: Callable[[dict[str, SX]], dict[str, SX]], state: ColumnLayout, parameters: Sequence[SX], max_steps: int
) -> Loop:
    """Return a loop that repeats a step until the state has a code; a call combines several cheap steps.

    A step does not change a state with a code. One call takes at most ``max_steps``; ``times`` of the loop is their number.
    """
    symbol = ca.SX.sym("state", state.size)
    next_state = state.join_parts(step(state.split_symbol(symbol)))
    times = 1
    if max_steps > 1:
        step_function = ca.Function("step", [symbol, *parameters], [next_state], {"cse": True})
        times = max(1, min(max_steps, MAX_UNROLLED_OPERATIONS // int(step_function.n_instructions())))
        for _ in range(times - 1):
            next_state = step_function(next_state, *parameters)
    is_running = ca.if_else(state.split_symbol(next_state)["code"] == STATE_RUNNING, 1.0, 0.0)
    return Loop(name, symbol, parameters, next_state=next_state, residual=is_running, ahead=True, times=times)
