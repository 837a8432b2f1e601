"""One step of many arms in the kinematic closed loop with faults: a kernel in which each row has the faults of its episode.

The faults are in the program, not around it, so that rows with different faults make one call, on the processor or on a GPU.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.control.law import Law
from holdfast.errors import InputError
from holdfast.faults.batch import FaultBatch
from holdfast.faults.entry import KINDS, TORQUE_KINDS
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import cached_kernel
from holdfast.solvers.inverse_kinematics import task_error
from holdfast.typing import FloatArray

KERNEL_INFINITY = 1e300  # kernels turn infinity into NaN
TIME_TOLERANCE_S = 1e-9  # s: what begins at a step's time is there
STATE_PARTS = ("q", "told", "place", "shown", "command")  # (n,) each, see `step_kernel`
GOAL_NUMBERS = 12  # numbers of an episode besides 7 n: its goal


@cached_kernel
def build_step_kernel(law: Law) -> Kernel:
    """Build the kernel ``(state, is_over, episode, action, noise, limits, setting) -> state, is_over, observation, reward,
    terminated, truncated``.

    A state holds where the joints are, what their sensors tell, where each was when its fault began, what the sensor before
    a slipping clutch shows, the command of the last step, and the time. The law sees what is told; the action, (n,) rates in
    units of the velocity limits, is added to its rates. An episode is where it starts, its goal, place before rotation, and its
    faults; where ``is_over`` is 1 the row begins that in place of a step. ``limits`` are lower, upper and velocity, (3 n,);
    ``setting`` is period, horizon and the two tolerances.
    """
    arm, task, n = law.arm, law.task, law.arm.n
    state, is_over, episode = (
        ca.SX.sym("state", len(STATE_PARTS) * n + 1),
        ca.SX.sym("over"),
        ca.SX.sym("episode", GOAL_NUMBERS + 7 * n),
    )
    action, noise = ca.SX.sym("action", n), ca.SX.sym("noise", n)
    limits, setting = ca.SX.sym("limits", 3 * n), ca.SX.sym("setting", 4)
    period, horizon, position_tolerance, orientation_tolerance = ca.vertsplit(setting)
    q_start, target_position, target_rotation, code, onset, end, parameters = ca.vertsplit(
        episode, np.cumsum([0, n, 3, 9, n, n, n, 3 * n]).tolist()
    )
    target_rotation = ca.reshape(target_rotation, 3, 3).T
    first_parameter, second_parameter, third_parameter = (parameters[part::3] for part in range(3))
    lower, upper, max_speeds = (limits[part * n : (part + 1) * n] for part in range(3))
    is_new = is_over > 0
    *positions, last_command = (state[part * n : (part + 1) * n] for part in range(len(STATE_PARTS)))
    q, q_measured, q_onset, q_clutch = (ca.if_else(is_new, q_start, value) for value in positions)
    time_before, last_command, time_step = (ca.if_else(is_new, 0.0, value) for value in (state[-1], last_command, period))
    time_after = time_before + time_step

    def is_active(kind: str, time: SX) -> SX:
        """Return (n,) 1 where a fault of the kind is active."""
        return _all_true(code == KINDS.index(kind), onset <= time + TIME_TOLERANCE_S, time < end - TIME_TOLERANCE_S)

    error, _ = task_error(arm, task, q_measured, target_position, target_rotation)
    rates = law.inverse(law.jacobian(q_measured), law.scale_velocity(law.command(error)))
    rates = ca.if_else(ca.sumsqr(rates) < KERNEL_INFINITY, rates, ca.SX.zeros(n))  # where the law has no answer: none
    commanded_rates = _clip(rates + _clip(action, -1.0, 1.0) * max_speeds, -max_speeds, max_speeds)
    command = ca.if_else(ca.logic_or(is_active("command_dropout", time_before), is_new), last_command, commanded_rates)
    speed_limits = ca.if_else(is_active("reduced_speed", time_before), _minimum(first_parameter, max_speeds), max_speeds)
    is_locked = is_active("locked", time_before) + is_active("slipping_clutch", time_before)
    q_next = q + time_step * ca.if_else(is_locked > 0, 0.0, _clip(command, -speed_limits, speed_limits))
    is_reduced = is_active("reduced_range", time_before)
    lower_stop = ca.if_else(first_parameter < 0, q_onset + first_parameter, _minimum(second_parameter, q_onset))
    upper_stop = ca.if_else(
        _all_true(first_parameter > 0, first_parameter < KERNEL_INFINITY),
        q_onset + first_parameter,
        _maximum(third_parameter, q_onset),
    )
    lower_stop, upper_stop = (
        ca.if_else(is_reduced, stop_with_fault, stop_without_fault)
        for stop_with_fault, stop_without_fault in ((_maximum(lower_stop, lower), lower), (_minimum(upper_stop, upper), upper))
    )
    q_next = ca.if_else(is_new, q, _clip(q_next, lower_stop, upper_stop))

    begins = _all_true(onset > time_before + TIME_TOLERANCE_S, onset <= time_after + TIME_TOLERANCE_S)
    q_onset = ca.if_else(begins, q_next, q_onset)
    q_clutch = ca.if_else(begins, q_next, q_clutch + time_step * command)
    q_measured = q_next + ca.if_else(is_active("sensor_bias", time_after), first_parameter, 0.0)
    q_measured += ca.if_else(is_active("sensor_drift", time_after), first_parameter * (time_after - onset), 0.0)
    q_measured += ca.if_else(is_active("sensor_noise", time_after), first_parameter * noise, 0.0)
    q_measured = ca.if_else(is_active("sensor_freeze", time_after), q_onset, q_measured)
    q_measured = ca.if_else(is_active("slipping_clutch", time_after), q_clutch, q_measured)
    measured_error, _ = task_error(arm, task, q_measured, target_position, target_rotation)
    true_error, _ = task_error(arm, task, q_next, target_position, target_rotation)
    position_error, orientation_error = (
        ca.norm_2(ca.SX(ca.DM(task.rows[:, columns].T)) @ true_error) for columns in (slice(0, 3), slice(3, 6))
    )
    terminated = _all_true(is_over <= 0, position_error <= position_tolerance, orientation_error <= orientation_tolerance)
    truncated = _all_true(is_over <= 0, ca.logic_not(terminated), time_after >= horizon - TIME_TOLERANCE_S)
    reward = ca.if_else(is_new, 0.0, -(position_error + orientation_error))
    return Kernel(
        "step with faults",
        [state, is_over, episode, action, noise, limits, setting],
        [
            ca.vertcat(q_next, q_measured, q_onset, q_clutch, command, time_after),
            ca.logic_or(terminated, truncated),
            ca.vertcat(q_measured, measured_error, command),
            reward,
            terminated,
            truncated,
        ],
    )


def make_kernel_rows(batch: FaultBatch) -> FloatArray:
    """Return the kernel's rows (N, 6 n) of episodes: code, onset, end, and parameters.

    Raises:
        InputError: A fault of a motor's torque, or a lock at an angle, which a loop of rates alone does not have.
    """
    for events in batch.episodes:
        for event in events:
            if event.kind in TORQUE_KINDS or event.parameters.get("at", "here") != "here":
                raise InputError(
                    f"'{event.sentence()}' needs bodies and motors, and this loop has rates alone; use "
                    "holdfast.simulate_faults or a FaultWrapper"
                )
    parameters = batch.parameter.copy()
    is_range = batch.kind == KINDS.index("reduced_range")
    no_limits = np.array([KERNEL_INFINITY, -KERNEL_INFINITY, KERNEL_INFINITY])  # no travel, no lower, no upper stop
    parameters = np.where(np.isnan(parameters), np.where(is_range[..., None], no_limits, 0.0), parameters)
    onsets, ends = (np.where(np.isfinite(times), times, KERNEL_INFINITY) for times in (batch.onset, batch.end))
    return np.concatenate([batch.kind, onsets, ends, parameters.reshape(len(batch), -1)], axis=1)


def _all_true(*conditions: SX) -> SX:
    conjunction = conditions[0]
    for condition in conditions[1:]:
        conjunction = ca.logic_and(conjunction, condition)
    return conjunction


def _minimum(a: SX, b: SX) -> SX:
    return ca.if_else(a < b, a, b)


def _maximum(a: SX, b: SX) -> SX:
    return ca.if_else(a > b, a, b)


def _clip(value: SX, lower: SX, upper: SX) -> SX:
    return _minimum(_maximum(value, lower), upper)
