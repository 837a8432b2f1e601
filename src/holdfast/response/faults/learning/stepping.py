"""One step of many arms in the kinematic closed loop with faults, as a kernel in which each row has the faults of its episode.

The kernel contains all faults, so that rows with different faults need only one call, on the processor or on a GPU.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kinematics.solvers.inverse_kinematics import task_error_and_jacobian
from holdfast.response.faults.batch import FaultBatch
from holdfast.response.faults.kind import MAX_PARAMETERS, FaultKind, fault_kinds, find_kind
from holdfast.response.faults.step_symbols import KERNEL_INFINITY, StepSymbols

TIME_TOLERANCE_S = 1e-9  # a fault that begins this close to the time of a step is active, s
STATE_PARTS = ("q", "told", "place", "shown", "command")  # (n,) each, see `build_step_kernel`
GOAL_NUMBERS = 12  # numbers of an episode in addition to 7 n: its goal


@cached_kernel
def build_step_kernel(law: Law) -> Kernel:
    """Build the kernel ``(state, is_over, episode, action, noise, limits, setting) -> state, is_over, observation, reward,
    terminated, truncated``.

    A state contains the joint positions, the sensor readings, the positions at the onsets of the faults, the readings of
    sensors before a slipping clutch, the commands of the last step, and the time. The law uses the sensor readings; the action,
    (n,) rates in units of the velocity limits, is added to its rates. An episode contains its start, its goal (position before
    rotation), and its faults; a row in which ``is_over`` is 1 begins this episode instead of a step. ``limits`` are lower,
    upper and velocity, (3 n,); ``setting`` contains period, horizon and the two tolerances.
    """
    arm, task, n = law.arm, law.task, law.arm.n
    sizes = {"state": len(STATE_PARTS) * n + 1, "over": 1, "episode": GOAL_NUMBERS + 7 * n, "action": n, "noise": n}
    inputs = [ca.SX.sym(name, size) for name, size in {**sizes, "limits": 3 * n, "setting": 4}.items()]
    state, is_over, episode, action, noise, limits, setting = inputs
    period, horizon, position_tolerance, orientation_tolerance = ca.vertsplit(setting)
    q_start, target_position, target_rotation, code, onset, end, parameters = ca.vertsplit(
        episode, np.cumsum([0, n, 3, 9, n, n, n, 3 * n]).tolist()
    )
    target_rotation = ca.reshape(target_rotation, 3, 3).T
    lower, upper, max_speeds = ca.vertsplit(limits, n)
    is_new = is_over > 0
    *positions, last_command = ca.vertsplit(state[:-1], n)
    q, q_measured, q_onset, q_clutch = (ca.if_else(is_new, q_start, value) for value in positions)
    time_before, last_command, time_step = (ca.if_else(is_new, 0.0, value) for value in (state[-1], last_command, period))
    time_after = time_before + time_step

    def is_active(kind: FaultKind, time: SX) -> SX:
        """Return (n,) 1 where a fault of the kind is active."""
        return StepSymbols.all_true(code == kind.code, onset <= time + TIME_TOLERANCE_S, time < end - TIME_TOLERANCE_S)

    error, _ = task_error_and_jacobian(arm, task, q_measured, target_position, target_rotation)
    rates = law.inverse(law.jacobian(q_measured), law.scale_velocity(law.command(error)))
    rates = ca.if_else(ca.sumsqr(rates) < KERNEL_INFINITY, rates, ca.SX.zeros(n))  # zero where the law has no solution
    commanded_rates = StepSymbols.clip(rates + StepSymbols.clip(action, -1.0, 1.0) * max_speeds, -max_speeds, max_speeds)
    step = StepSymbols(
        first=parameters[0::3],
        second=parameters[1::3],
        third=parameters[2::3],
        onset=onset,
        last_command=last_command,
        q_onset=q_onset,
        noise=noise,
        time=time_after,
        command=ca.if_else(is_new, last_command, commanded_rates),
        speed_limits=max_speeds,
        lower=lower,
        upper=upper,
    )
    is_held = ca.SX.zeros(n)
    for kind in fault_kinds().values():
        active = is_active(kind, time_before)
        kind.change_motion(step, active)
        if kind.holds_joint:
            is_held += active
    command = step.command
    q_next = q + time_step * ca.if_else(is_held > 0, 0.0, step.clip(command, -step.speed_limits, step.speed_limits))
    q_next = ca.if_else(is_new, q, step.clip(q_next, step.lower, step.upper))

    begins = step.all_true(onset > time_before + TIME_TOLERANCE_S, onset <= time_after + TIME_TOLERANCE_S)
    q_onset = step.q_onset = ca.if_else(begins, q_next, q_onset)
    q_clutch = step.q_motor = ca.if_else(begins, q_next, q_clutch + time_step * command)
    step.q_measured = q_next
    for kind in fault_kinds().values():
        kind.change_reading(step, is_active(kind, time_after))
    q_measured = step.q_measured
    measured_error, _ = task_error_and_jacobian(arm, task, q_measured, target_position, target_rotation)
    true_error, _ = task_error_and_jacobian(arm, task, q_next, target_position, target_rotation)
    position_error, orientation_error = (
        ca.norm_2(ca.SX(ca.DM(task.rows[:, columns].T)) @ true_error) for columns in (slice(0, 3), slice(3, 6))
    )
    terminated = step.all_true(is_over <= 0, position_error <= position_tolerance, orientation_error <= orientation_tolerance)
    truncated = step.all_true(is_over <= 0, ca.logic_not(terminated), time_after >= horizon - TIME_TOLERANCE_S)
    reward = ca.if_else(is_new, 0.0, -(position_error + orientation_error))
    next_state = ca.vertcat(q_next, q_measured, q_onset, q_clutch, command, time_after)
    observation, is_finished = ca.vertcat(q_measured, measured_error, command), ca.logic_or(terminated, truncated)
    return Kernel("step with faults", inputs, [next_state, is_finished, observation, reward, terminated, truncated])


def make_fault_rows(batch: FaultBatch) -> FloatArray:
    """Return the kernel's rows (N, 6 n) of episodes: code, onset, end, and parameters.

    Raises:
        InputError: A fault is one of a motor's torque, or a lock at an angle, which a loop of rates does not represent.
    """
    for events in batch.episodes:
        for event in events:
            kind = find_kind(event.kind)
            if kind.needs_torques or kind.is_delayed(event.parameters):
                raise InputError(
                    f"'{event.sentence()}' needs bodies and motors, and this loop contains only rates; use "
                    "holdfast.simulate_faults or a FaultWrapper"
                )
    absent = np.zeros((len(fault_kinds()) + 1, MAX_PARAMETERS))  # the last row: no fault
    for kind in fault_kinds().values():
        numbers = [parameter.absent for parameter in kind.parameters_by_name.values()]
        absent[kind.code, : len(numbers)] = np.clip(numbers, -KERNEL_INFINITY, KERNEL_INFINITY)
    parameters = np.where(np.isnan(batch.parameter), absent[batch.kind], batch.parameter)
    onsets, ends = (np.where(np.isfinite(times), times, KERNEL_INFINITY) for times in (batch.onset, batch.end))
    return np.concatenate([batch.kind, onsets, ends, parameters.reshape(len(batch), -1)], axis=1)
