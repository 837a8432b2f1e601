"""Execution of a timed joint motion by servos in MuJoCo, with joints that lock during the motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.physics.execution import Ended, Execution
from holdfast.control.physics.robot import MAX_PHYSICAL_SPEED, ServoRobot
from holdfast.control.physics.servos import Servos
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.tool_constraints.labels import KeepLike, anchor_constraints
from holdfast.model.arm.formats.mjcf import silence_mujoco
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import check_poses
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.failure_modes import Degraded, Locked, degraded_at, read_locks

LOCK_POSITION_TOLERANCE = 1e-6  # rad and m: largest distance of a joint from the value at which it is given as locked
REST_SPEED = 1e-3  # rad/s and m/s
MAX_DURATION_S = 3600.0  # s


@check_arguments
@silence_mujoco()
@reports_progress("executing the motion")
def execute(
    arm: Arm,
    q: ArrayLike,
    time: ArrayLike,
    *,
    locked: Locked = (),
    lock_time: ArrayLike = 0.0,
    notice: float | None = None,
    stop: float = 0.1,
    goal: ArrayLike | None = None,
    keep: KeepLike | None = None,
    servos: Servos | None = None,
    settle: float = 0.5,
    error_limit: tuple[float, float] | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> Execution:
    """Execute a timed joint motion in MuJoCo with servos, and evaluate it (needs ``holdfast-arms[physics]``).

    Bodies, motors and locks are those of :func:`holdfast.simulate_physics`: a joint that locks while it moves stops at once,
    and the impact propagates through the arm. The arm starts at rest at the first configuration. Until the lock is detected,
    the other joints follow the motion as before. Then the controller slows the motion down to a standstill. To recover, pass
    ``q_final`` and ``degraded`` of the result to :func:`holdfast.recover`, and execute its motion with
    ``locked=answer.degraded``. Joint limits do not stop the arm, but the result lists those that were exceeded.

    Args:
        arm: The arm, with inertial data.
        q: (S, n) configurations, rad and m, connected by straight lines in joint space.
        time: (S,) increasing times of the configurations, s.
        locked: Joints that lock at their current values, as ``{joint: None}`` or the joints alone, by name or index from 0;
            or a :class:`holdfast.Degraded`, whose ranges and speeds are checked from the first lock on.
        lock_time: Time of the locks, s from the start, rounded up to the next control cycle: one time, or one for each joint.
        notice: Time from the first lock until the controller detects it and slows down, s. None: never, which is also
            right for a motion that was planned for the lock.
        stop: Duration of slowing down, s; the references stay on the motion.
        goal: (4, 4) pose or (3,) position of the tool at the end, m, world.
        keep: Constraints on the tool at every instant; see :func:`holdfast.recover`. "At the start" refers to the first ``q``.
        servos: Servos of the joints. Default: ``Servos()``.
        settle: Simulated time after the end of the motion, or after the arm has been stopped, s.
        error_limit: Largest allowed distance of a joint from the motion, rad and m; ``first_excess`` of the result is the
            first joint beyond it.
        clearance: Collision model of the arm, used with a cell, which it may contain. None: the default model.
        cell: Objects around the arm, or their file; the arm touches them and pushes against them.

    Returns:
        An :class:`holdfast.Execution` with the tool error at the end, the violated constraints, and the measured motion.

    Raises:
        InputError: Wrong shapes, joints or options, times that do not increase, a start within an object, or a point cloud.
        ArmError: Inertial data are missing or impossible, or a joint carries no mass.
        HoldfastError: MuJoCo is not installed.
    """
    waypoints, seconds = _check_motion(arm, q, time)
    for joint_name, number in (("notice", notice or 0.0), ("stop", stop), ("settle", settle)):
        if not 0 <= number <= MAX_DURATION_S:
            raise InputError(f"{joint_name} is {number:g} s; it must be from 0 to {MAX_DURATION_S:g} s")
    degraded = degraded_at(arm, locked, waypoints[0])
    lock_order = (
        [arm.joint_names[k] for k in read_locks(arm, locked)] if not isinstance(locked, Degraded) else list(locked.locked)
    )
    lock_times = _make_lock_times(arm, degraded, lock_order, lock_time, waypoints[0])
    if error_limit is not None and not (len(error_limit) == 2 and all(limit > 0 for limit in error_limit)):
        raise InputError(f"error_limit is {error_limit}; give two numbers above 0, in rad and m")
    if notice is not None and not np.isfinite(lock_times).any():
        raise InputError(f"notice is {notice:g} s, but no joint locks; give locked, or no notice")
    detection_time = np.inf if notice is None else float(lock_times.min()) + notice
    chosen_servos = Servos() if servos is None else servos
    robot = ServoRobot(arm, waypoints[0], chosen_servos, chosen_clearance(arm, clearance or False, cell, looks=False))
    robot.schedule_locks(lock_times)
    references, reaches_end = _sample_servo_references(waypoints, seconds, 1 / chosen_servos.rate, detection_time, stop, settle)
    q, rates, reference, torque = _follow_references(robot, references)
    is_at_rest = float(np.abs(rates[-1]).max()) < REST_SPEED
    outcome: Ended = (
        "unstable" if len(q) < len(references) else "moving" if not is_at_rest else "finished" if reaches_end else "stopped"
    )
    if degraded is not None:
        degraded = replace(degraded, locked={name: float(q[-1, arm.joint_index(name)]) for name in degraded.locked})
    return Execution(
        arm=arm,
        degraded=degraded,
        servos=chosen_servos,
        stiffness=robot.stiffness,
        damping=robot.damping,
        lock_time=lock_times,
        noticed=np.inf if reaches_end else detection_time,
        outcome=outcome,
        time=np.arange(len(q)) / chosen_servos.rate,
        q=q,
        rates=rates,
        reference=reference,
        planned=references[: len(q)],
        torque=torque,
        goal=_check_goal(goal),
        keep=anchor_constraints(keep, arm.forward_kinematics(waypoints[0])),
        contacts=robot.contacts.list_contacts(),
        cell=robot.contacts.cell,
        error_limit=error_limit,
    )


def _check_motion(arm: Arm, q: ArrayLike, time: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return the checked configurations (S, n), and their times (S,) from 0 on."""
    waypoints = np.atleast_2d(arm.check_configurations(q))
    seconds = require_real_numbers(time, "time", "a number for each configuration, s")
    if seconds.shape != (len(waypoints),) or len(waypoints) < 2:
        raise InputError(
            f"time has shape {seconds.shape} and there are {len(waypoints)} configurations; give two or more, and a "
            f"time for each"
        )
    if not (np.isfinite(waypoints).all() and np.isfinite(seconds).all()):
        raise InputError("the motion holds NaN or infinity; give finite numbers")
    if (np.diff(seconds) <= 0).any():
        index = int((np.diff(seconds) <= 0).argmax()) + 1
        raise InputError(
            f"time {index} is {seconds[index]:g} s, after {seconds[index - 1]:g} s; every time must be after the one before"
        )
    if seconds[-1] - seconds[0] > MAX_DURATION_S:
        raise InputError(f"the motion takes {seconds[-1] - seconds[0]:g} s; it must take {MAX_DURATION_S:g} s or less")
    return waypoints, seconds - seconds[0]


def _make_lock_times(
    arm: Arm, degraded: Degraded | None, order: list[str], lock_time: ArrayLike, start: FloatArray
) -> FloatArray:
    """Return the lock time (n,) of each joint, s, from times in an order of names; infinite for healthy joints."""
    lock_times = np.full(arm.n, np.inf)
    if degraded is None:
        return lock_times
    for name, value in degraded.locked.items():
        joint = arm.joint_index(name)
        if value is not None and abs(value - start[joint]) > LOCK_POSITION_TOLERANCE:
            raise InputError(
                f"joint '{name}' is locked at {value:.6g}, but the motion begins with it at {start[joint]:.6g} "
                f"{arm.joints[joint].unit}; give the value at which the motion begins"
            )
    times_in_order = require_real_numbers(lock_time, "lock_time", "one time, or one for each locked joint, s")
    has_right_shape = times_in_order.shape in ((), (len(degraded.locked),))
    if not has_right_shape or not (np.isfinite(times_in_order) & (times_in_order >= 0)).all():
        raise InputError(
            f"lock_time is {times_in_order.tolist()}; give one time of 0 s or more, or {len(degraded.locked)}, one for each "
            "joint that locks"
        )
    for name, joint_time in zip(order, np.broadcast_to(times_in_order, len(degraded.locked)), strict=True):
        lock_times[arm.joint_index(name)] = joint_time
    return lock_times


def _check_goal(goal: ArrayLike | None) -> FloatArray | None:
    if goal is None:
        return None
    goal_array = require_real_numbers(goal, "goal", "a pose (4, 4) or a position (3,), m")
    if goal_array.shape not in ((4, 4), (3,)) or not np.isfinite(goal_array).all():
        raise InputError(f"goal has shape {goal_array.shape}; give a pose (4, 4) or a position (3,) of finite numbers, m")
    return goal_array if goal_array.ndim == 1 else np.asarray(check_poses(goal_array)[0])


def _sample_servo_references(
    waypoints: FloatArray,
    seconds: FloatArray,
    period: float,
    detection_time: float,
    stop_duration: float,
    settle_duration: float,
) -> tuple[FloatArray, bool]:
    """Return the servo references (K + 1, n) at each control cycle, and whether they lead to the end of the motion."""
    end_time = float(seconds[-1])
    reaches_end = not detection_time + stop_duration / 2 < end_time  # slowing down covers half the distance of full speed
    stop_end = end_time if detection_time >= end_time else detection_time + stop_duration
    time = np.arange(int(np.ceil((stop_end + settle_duration) / period - 1e-9)) + 1) * period
    slowing_time = np.clip(time - detection_time, 0.0, stop_duration)
    lost_time = slowing_time**2 / (2 * stop_duration) if stop_duration else 0.0
    clock = np.minimum(np.minimum(time, detection_time) + slowing_time - lost_time, end_time)
    return np.stack([np.interp(clock, seconds, column) for column in waypoints.T], axis=1), reaches_end


def _follow_references(robot: ServoRobot, references: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return measured configurations, rates, references, and torques, (T, n) each; T < K if the physics diverged."""
    period = 1 / robot.servos.rate
    cycles: list[tuple[FloatArray, FloatArray, FloatArray, FloatArray]] = []
    for cycle in track("control cycles", range(len(references)), most=True, every=100):
        robot.lock_due_joints(cycle * period)
        q, rates = robot.q, robot.rates
        next_reference = references[min(cycle + 1, len(references) - 1)]
        reference = robot.limit_reference(next_reference, q)
        cycles.append((q, rates, reference, robot.torque))
        if not float(rates @ rates) < MAX_PHYSICAL_SPEED**2:
            break
        goal = reference + robot.rate_feed * (next_reference - references[cycle]) / period
        robot.simulate_cycle(goal, (cycle + 1) * period)
    q, rates, reference, torque = (np.array(column) for column in zip(*cycles, strict=True))
    return q, rates, reference, torque
