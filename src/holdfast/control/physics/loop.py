"""Closed loop of a controller without fault information, with bodies and motors."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.law import Law
from holdfast.control.physics.robot import MAX_PHYSICAL_SPEED, ServoRobot
from holdfast.control.physics.run import Ending, PhysicalRun, Why
from holdfast.control.physics.servos import Servos
from holdfast.control.simulation.batch import CONVERGENCE_TOLERANCE
from holdfast.control.simulation.closed_loop import simulate
from holdfast.control.simulation.runs import Runs
from holdfast.control.simulation.system import FailedArmSystem
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm.formats.mjcf import silence_mujoco
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.failure_modes import Locked

REST_SPEED = 1e-6  # rad (and m) per 1/Ke, of the command and of the joints
REST_DURATION = 0.1  # 1/Ke: uninterrupted duration of rest that ends a run
TIME_LIMIT = 200.0  # 1/Ke
RETURN_TOLERANCE = 0.1  # fraction of the motion's extent by which a return may miss
DRIFT_FRACTION = 1e-3  # fraction of the motion's extent by which the last two periods may differ
MIN_EXTENT = 1e-3  # rad (and m): a smaller motion does not count as a repeated one


@check_arguments
@silence_mujoco()
@reports_progress("simulating the physics")
def simulate_physics(
    law: Law,
    q0: ArrayLike,
    target: ArrayLike,
    *,
    locked: Locked = (),
    servos: Servos | None = None,
    time_limit: float | None = None,
    time: ArrayLike = 0.0,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    stop_at_contact: bool = False,
) -> PhysicalRun:
    """Simulate one run of the closed loop on MuJoCo, next to the kinematic one (needs ``holdfast-arms[physics]``).

    In :func:`holdfast.control.simulation.simulate`, healthy joints follow their commands exactly. Here they have bodies and
    motors. At every control cycle the law, which has no fault information, receives the measured configuration (the failed
    joint's sensor works), and its joint rates go to the :class:`holdfast.Servos`. A locked joint is welded at its value,
    whatever its motor does. A joint that locks while it moves stops at once, and the impact (without rebound) propagates
    through the arm. The arm starts at rest. Joint limits do not stop it, and there is no sensor noise, dry friction, backlash
    or flexibility.

    The objects of a cell are obstacles: massless capsules of the arm's links touch them and slide along them (a coefficient of
    friction of 1), and the motors keep pushing. A mesh is its convex hull here. ``contacts`` lists the pairs in contact, with
    the time of the first contact and its depth. Without contact the motion is the same as without a cell.

    A run is at rest when the law's command to the healthy joints (without the speed limit) and their true rates have both been
    below 1e-6 Ke for 0.1/Ke. It is *converged* if the error is below 1e-5 (rad, and of the arm's own length), otherwise
    *stuck*. It is also *stuck*, for the reason *contact*, if an object holds an arm that is still commanded to move. It is
    *moving* if the arm still moves at the time limit and repeats its motion: over the whole last period it was within a
    thousandth of the motion's extent of its position one period earlier, and so had the same velocity. Otherwise it is
    *undecided*, for the reason time_limit (the arm still moves at the time limit), singular (the law has no answer), or
    unstable (the physics diverged, for example because the servos are too stiff for their rate).

    Args:
        law: The control law, with its arm, task, gain ``Ke`` and speed limit. The arm needs inertial data.
        q0: (n,) configuration at the start, rad and m.
        target: (m,) position or (4, 4) pose, m, as for :func:`holdfast.control.simulation.simulate`.
        locked: Joints that lock at their current values, as ``{joint: None}`` or the joints alone, by name or index from 0.
        servos: Servos of the joints. Default: ``Servos()``.
        time_limit: Simulated time limit, s. Default: 200/Ke.
        time: Time of the locks, s, rounded up to the next control cycle: one time, or one for each joint.
        clearance: Collision model of the arm, used with a cell, which it may contain. None: the default model.
        cell: Objects around the arm, or their file.
        stop_at_contact: True if the kinematic run stops at the first contact; the physical run always meets the objects.

    Returns:
        A :class:`holdfast.PhysicalRun`, which contains the kinematic run and the distance between both.

    Raises:
        InputError: Wrong shapes, joints or options, more than one run, a start within an object, or a point cloud.
        ArmError: Inertial data are missing or impossible, or a joint carries no mass.
        HoldfastError: MuJoCo is not installed.
    """
    run_limit = TIME_LIMIT / law.gain if time_limit is None else float(time_limit)
    if not (np.isfinite(run_limit) and run_limit > 0):
        raise InputError(f"time_limit is {run_limit:g}; it must be a finite number above 0")
    chosen_servos, arm = Servos() if servos is None else servos, law.arm
    start = arm.check_configurations(q0).reshape(-1, arm.n)[0]
    checked_clearance = chosen_clearance(arm, clearance or False, cell, looks=False)
    robot = ServoRobot(arm, start, chosen_servos, checked_clearance)
    runs = simulate(law, q0, target, locked=locked, time=time, clearance=checked_clearance, stop_at_contact=stop_at_contact)
    if runs.code.ndim:
        raise InputError(f"q0 and target give {len(runs)} runs; physics simulates one, so give one q0 and one target")
    robot.schedule_locks(runs.lock_time)
    cycles, ending = _run_cycles(robot, law, _target_pose(law, runs), run_limit)
    q, reference, torque = (np.reshape([cycle[part] for cycle in cycles], (-1, arm.n)) for part in range(3))
    outcome, reason = ending or _classify_unfinished_run(q, chosen_servos.rate, law.gain, ~arm.prismatic)
    return PhysicalRun(
        law=law,
        servos=chosen_servos,
        stiffness=robot.stiffness,
        damping=robot.damping,
        kinematic=runs,
        outcome=outcome,
        reason=reason,
        time=np.arange(len(q)) / chosen_servos.rate,
        q=q,
        reference=reference,
        torque=torque,
        x=arm.forward_kinematics(q)[:, :3, 3],
        error=np.sqrt([squared_error for *_, squared_error in cycles]),
        contacts=robot.contacts.list_contacts(),
    )


def _run_cycles(
    robot: ServoRobot, law: Law, target: tuple[FloatArray, FloatArray], time_limit: float
) -> tuple[list[tuple[FloatArray, FloatArray, FloatArray, float]], tuple[Ending, Why] | None]:
    """Run the control cycles towards a target, its position (3,) and rotation (9,).

    Returns:
        Configuration (n,), reference (n,), torque (n,), and squared error of each cycle; and the outcome and reason of a run
        that ended before the time limit.
    """
    n, period, reference = law.arm.n, 1 / robot.servos.rate, robot.q
    command, inputs = _command_kernel(law).single_row(), np.concatenate([reference, *target])
    rest_cycles, cycles_at_rest = int(np.ceil(REST_DURATION / law.gain / period)), 0
    cycles: list[tuple[FloatArray, FloatArray, FloatArray, float]] = []
    for cycle in track("control cycles", range(int(np.ceil(time_limit / period - 1e-9)) + 1), most=True, every=100):
        robot.lock_due_joints(cycle * period)
        inputs[:n] = q = robot.q
        outputs = command(inputs)
        rates, (speed_fraction, squared_error, scaled_error) = outputs[:n], outputs[n:]
        if not np.isfinite(squared_error + rates.sum()):
            return cycles, ("undecided", "singular" if np.isfinite(q).all() else "unstable")
        reference = robot.limit_reference(reference + period * rates, q)
        healthy_rates = rates[robot.free]
        speed = float(np.sqrt(healthy_rates @ healthy_rates)) / speed_fraction
        robot.simulate_cycle(reference + robot.rate_feed * rates, (cycle + 1) * period)
        cycles.append((q, reference, robot.torque, squared_error))
        velocity, is_in_contact = robot.data.qvel, robot.data.ncon > 0
        squared_speed = float(velocity @ velocity)
        if not squared_speed < MAX_PHYSICAL_SPEED**2:
            return cycles, ("undecided", "unstable")
        # An arm that lies against an object is commanded to move as long as it lies there.
        is_at_rest = max(0.0 if is_in_contact else speed, np.sqrt(squared_speed)) < REST_SPEED * law.gain
        cycles_at_rest = cycles_at_rest + 1 if is_at_rest else 0
        if cycles_at_rest > rest_cycles:
            if scaled_error < CONVERGENCE_TOLERANCE**2:
                return cycles, ("converged", "none")
            return cycles, ("stuck", "contact" if is_in_contact else "none")
    return cycles, None


@cached_kernel
def _command_kernel(law: Law) -> Kernel:
    """Return the kernel ``(q, p, R) -> rates`` (n,), their speed fraction, and squared errors in m and in the arm's unit."""
    system = FailedArmSystem(law)
    error, _ = system.error_and_jacobian(system.q)
    velocity, speed_fraction = system.compute_limited_velocity(error)
    rates = law.rates(system.q, velocity) * law.gain
    outputs = ca.vertcat(rates, speed_fraction, ca.sumsqr(error), ca.sumsqr(system.scaled_error_and_jacobian(system.q)[0]))
    return Kernel("command in physics", [system.q, system.target, system.rotation], [outputs])


def _target_pose(law: Law, runs: Runs) -> tuple[FloatArray, FloatArray]:
    """Return the position (3,) and rotation (9,), row by row, of the target."""
    if runs.target.ndim == 2:
        return runs.target[:3, 3], runs.target[:3, :3].ravel()
    return runs.target @ law.task.rows[:, :3], np.eye(3).ravel()


def _classify_unfinished_run(q: FloatArray, rate: float, gain: float, is_revolute: BoolArray) -> tuple[Ending, Why]:
    """Classify a run that still moved at the time limit as one that repeats its motion, or as undecided.

    A run repeats its motion if its last period equals the period before it, so that the velocities are equal, too. The
    configurations (T, n) are those at the control cycles; values of revolute joints (n,) count modulo full turns.
    """
    undecided: tuple[Ending, Why] = ("undecided", "time_limit")
    displacement = _wrap_angles(q[-1] - q, is_revolute)
    distance = np.linalg.norm(displacement, axis=1)[::-1]  # backwards in time, from 0
    extent = float(distance.max())
    first_far = int(np.argmax(distance > RETURN_TOLERANCE * extent))
    if extent < MIN_EXTENT or not first_far:
        return undecided
    minima = np.flatnonzero((distance[1:-1] <= distance[:-2]) & (distance[1:-1] < distance[2:])) + 1
    for period in minima[(minima > first_far) & (distance[minima] < RETURN_TOLERANCE * extent)].tolist():
        if 2 * period + 2 > len(q):
            break
        # The return falls between two cycles, where the motion is interpolated by a parabola.
        neighbours = displacement[[-period - 2, -period - 1, -period]]
        speed = (neighbours[2] - neighbours[0]) / 2
        shift = -float(neighbours[1] @ speed) / max(float(speed @ speed), np.finfo(np.float64).tiny)
        last_period = np.arange(len(q) - period, len(q))
        previous = q[last_period - period - 1], q[last_period - period], q[np.minimum(last_period - period + 1, len(q) - 1)]
        before, middle, after = previous
        earlier = middle + shift * (after - before) / 2 + shift**2 * (after - 2 * middle + before) / 2
        return_error = float(np.linalg.norm(_wrap_angles(q[last_period] - earlier, is_revolute), axis=1).max())
        if return_error < DRIFT_FRACTION * extent * min(period / rate * gain, 1.0):
            return "moving", "none"
    return undecided


def _wrap_angles(q: FloatArray, is_revolute: BoolArray) -> FloatArray:
    return np.where(is_revolute, np.arctan2(np.sin(q), np.cos(q)), q)
