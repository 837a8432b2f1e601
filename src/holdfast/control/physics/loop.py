"""The closed loop of a controller without fault information, with bodies and motors."""

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
from holdfast.model.arm.mjcf import silence_mujoco
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.failure_modes import Locked

REST_SPEED = 1e-6  # rad (and m) per 1/Ke, of the command and of the joints
REST_DURATION = 0.1  # 1/Ke: for so long, without a break
TIME_LIMIT = 200.0  # 1/Ke
RETURN_TOLERANCE = 0.1  # of the motion's extent: a return that misses by more is none
DRIFT_FRACTION = 1e-3  # of the motion's extent: what the last period may differ from the one before it by
MIN_EXTENT = 1e-3  # rad (and m): a smaller motion is not taken for a repeated one


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

    :func:`holdfast.control.simulation.simulate` lets healthy joints do what they are told. Here they have bodies and motors: at
    every control cycle the law, which knows of no failure, is given the measured configuration (the failed joint's sensor
    works), and its joint rates go to the :class:`holdfast.Servos`. A locked joint is welded where it is, whatever its motor
    does; one that locks while it moves stops at once, and the jolt goes through the arm (an impact without rebound). The arm
    starts at rest. Joint limits do not stop it, and there is no sensor noise, dry friction, backlash or flexibility.

    The objects of a cell are in the way: the capsules of the arm's links, which weigh nothing, touch them and slide along them
    (a coefficient of friction of 1), and the motors go on pushing. A mesh is its convex hull here. What touches what, when
    first and how deep the contact gave way, is in ``contacts``; where nothing touches the motion is that without a cell.

    How it ends: at rest, where the law's command to the healthy joints (without the speed limit) and their true rates have both
    been below 1e-6 Ke for 0.1/Ke; *converged* if the error is below 1e-5 (rad, and of the arm's own length), *stuck* if not.
    *moving*, if the arm is under way at the time limit and repeats its motion: over the whole last period it was within a
    thousandth of the motion's extent of where it had been one period earlier, and so had the same velocity. *stuck*, and the
    reason is *contact*, where an object holds an arm that is still told to move. Else *undecided*: time_limit, where the arm is
    still moving at the time limit; singular, where the law has no answer; or unstable, where the physics left all bounds, as
    servos that are too stiff for their rate may make it.

    Args:
        law: The control law, with its arm, task, gain ``Ke`` and speed limit. The arm needs inertial data.
        q0: (n,) configuration at the start, rad and m.
        target: (m,) or (4, 4), as for :func:`holdfast.control.simulation.simulate`.
        locked: Joints that lock where they are, ``{joint: None}`` or the joints alone, by name or index from 0.
        servos: Of the joints; :class:`holdfast.Servos` as they come if not given.
        time_limit: s; 200/Ke if not given.
        time: When the joints lock, s, each at the next control cycle: one time, or one for each of them.
        clearance: The shape of the arm, with a cell or beside one.
        cell: Objects around the arm, or their file.
        stop_at_contact: Of the kinematic run, see :func:`holdfast.control.simulation.simulate`; the physical one meets the
            objects.

    Returns:
        A :class:`holdfast.PhysicalRun`, which holds the kinematic run and how far they are apart.

    Raises:
        InputError: Wrong shapes, joints or options, more than one run, a start within an object, or a cloud of points.
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
        raise InputError(f"physics is for one run at a time, and there are {len(runs)}; give one q0 and one target")
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
        Configuration (n,), reference (n,), torque (n,), and squared error of each cycle; and the ending of a run that ended
        before the time limit.
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
        # An arm that lies against an object is told to move as long as it lies there.
        is_at_rest = max(0.0 if is_in_contact else speed, np.sqrt(squared_speed)) < REST_SPEED * law.gain
        cycles_at_rest = cycles_at_rest + 1 if is_at_rest else 0
        if cycles_at_rest > rest_cycles:
            if scaled_error < CONVERGENCE_TOLERANCE**2:
                return cycles, ("converged", "none")
            return cycles, ("stuck", "contact" if is_in_contact else "none")
    return cycles, None


@cached_kernel
def _command_kernel(law: Law) -> Kernel:
    """Return the kernel ``(q, p, R) -> rates`` (n,), their speed fraction, and squared errors, in m and in the
    arm's own unit.
    """
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
    """Classify a run that was under way at the time limit: it repeats its motion, or it is undecided.

    It repeats its motion if over a whole last period it was where it had been one period earlier, and so had the same velocity.
    The configurations (T, n) are those at the control cycles; values of revolute joints (n,) count modulo whole turns.
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
        # The return falls between two cycles: there the motion is a parabola.
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
