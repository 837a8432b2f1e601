"""The closed loop of a controller without fault information, with bodies and motors."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.law import Law
from holdfast.control.physics.plant import LOCK_TIME_TOLERANCE_S, MAX_PHYSICAL_SPEED, ServoPlant
from holdfast.control.physics.run import Ending, PhysicalRun, Why
from holdfast.control.physics.servos import Servos, max_reference_offsets
from holdfast.control.physics.surroundings import ContactLog
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
    works),
    and its joint rates go to the :class:`holdfast.Servos`. A locked joint is welded where it is, whatever its motor does; one
    that locks while it moves stops at once, and the jolt goes through the arm (an impact without rebound). The arm starts at
    rest. Joint limits do not stop it, and there is no sensor noise, dry friction, backlash or flexibility.

    The objects of a cell are in the way: the capsules of the arm's links, which weigh nothing, touch them and slide along them
    (a coefficient of friction of 1), and the motors go on pushing. A mesh is its convex hull here. What touches what, when
    first and how deep the contact gave way, is in ``contacts``; where nothing touches the motion is that without a cell.

    How it ends: at rest, where the law's command to the healthy joints (without the speed limit) and their true rates have
    both been below 1e-6 Ke for 0.1/Ke; *converged* if the error is below 1e-5 (rad, and of the arm's own
    length), *stuck* if not. *moving*, if the arm is under way at the time limit and repeats its motion: over the whole last
    period it was within a thousandth of the motion's extent of where it had been one period earlier, and so had the same
    velocity. *stuck*, and the reason is *contact*, where an object
    holds an arm that is still told to move. Else *undecided*: time_limit, where the arm is still moving at the time limit;
    singular, where the law has no answer; or unstable, where the physics left all bounds, as servos that are too stiff for
    their rate may make it.

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
    cell_clearance = None if checked_clearance is None or checked_clearance.cell is None else checked_clearance
    plant = ServoPlant(arm, start, np.zeros(arm.n), np.ones(arm.n, dtype=bool), chosen_servos, cell_clearance)
    contact_log = ContactLog(cell_clearance)
    contact_log.require_collision_free(plant.model)
    stiffness, damping = chosen_servos.gains(arm, plant.mujoco, plant.model, start=start)
    runs = simulate(law, q0, target, locked=locked, time=time, clearance=checked_clearance, stop_at_contact=stop_at_contact)
    if runs.code.ndim:
        raise InputError(f"physics is for one run at a time, and there are {len(runs)}; give one q0 and one target")
    samples, ending = _drive_loop(plant, law, runs, stiffness, damping, run_limit, contact_log)
    outcome, reason = ending or _classify_unfinished_run(samples.q, chosen_servos.rate, law.gain, ~arm.prismatic)
    return PhysicalRun(
        law=law,
        servos=chosen_servos,
        stiffness=stiffness,
        damping=damping,
        kinematic=runs,
        outcome=outcome,
        reason=reason,
        time=np.arange(len(samples.q)) / chosen_servos.rate,
        q=samples.q,
        reference=samples.reference,
        torque=samples.torque,
        x=arm.forward_kinematics(samples.q)[:, :3, 3],
        error=samples.error,
        contacts=contact_log.list_contacts(),
    )


@dataclass(frozen=True)
class _LoopSamples:
    """Values at each of T control cycles, as in :class:`holdfast.PhysicalRun`."""

    q: FloatArray
    reference: FloatArray
    torque: FloatArray
    error: FloatArray


def _drive_loop(
    plant: ServoPlant,
    law: Law,
    runs: Runs,
    stiffness: FloatArray,
    damping: FloatArray,
    time_limit: float,
    contact_log: ContactLog,
) -> tuple[_LoopSamples, tuple[Ending, Why] | None]:
    """Simulate the physical run next to a kinematic one, and return its ending if it ended before the time limit."""
    n, period = law.arm.n, 1 / plant.servos.rate
    command, inputs = _command_kernel(law).single_row(), np.concatenate([plant.start, *_target_pose(law, runs)])
    max_leads, rate_feed = max_reference_offsets(law.arm, stiffness), damping / stiffness
    reference, lock_time = plant.start.copy(), runs.lock_time
    healthy, next_lock = np.ones(n, dtype=bool), float(lock_time.min())
    plant.set_gains(stiffness, damping)
    rest_cycles, cycles_at_rest = int(np.ceil(REST_DURATION / law.gain / period)), 0
    cycles: list[FloatArray] = []
    ending: tuple[Ending, Why] | None = None
    for cycle in track("control cycles", range(int(np.ceil(time_limit / period - 1e-9)) + 1), most=True, every=100):
        if cycle * period >= next_lock - LOCK_TIME_TOLERANCE_S:
            healthy = lock_time > cycle * period + LOCK_TIME_TOLERANCE_S
            plant = plant.lock_all_except(healthy)
            plant.set_gains(stiffness, damping)
            next_lock = float(lock_time[healthy].min(initial=np.inf))
        inputs[:n] = q = plant.q
        outputs = command(inputs)
        rates, squared_error, scaled_error = outputs[:n], outputs[n + 1], outputs[n + 2]
        if not np.isfinite(squared_error + rates.sum()):
            ending = ("undecided", "singular" if np.isfinite(q).all() else "unstable")
            break
        reference = np.minimum(np.maximum(reference + period * rates, q - max_leads), q + max_leads)
        healthy_rates = rates[healthy]
        speed = float(np.sqrt(healthy_rates @ healthy_rates)) / outputs[n]
        plant.simulate_control_cycle(reference + rate_feed * rates)
        cycles.append(np.concatenate((q, reference, plant.torque, (squared_error,))))
        is_in_contact = plant.data.ncon > 0
        if is_in_contact:
            contact_log.record_contacts(plant.model, plant.data, (cycle + 1) * period)
        velocity = plant.data.qvel
        squared_speed = float(velocity @ velocity)
        if not squared_speed < MAX_PHYSICAL_SPEED**2:
            ending = ("undecided", "unstable")
            break
        # An arm that lies against an object is told to move as long as it lies there.
        cycles_at_rest = (
            cycles_at_rest + 1 if max(0.0 if is_in_contact else speed, np.sqrt(squared_speed)) < REST_SPEED * law.gain else 0
        )
        if cycles_at_rest > rest_cycles:
            ending = (
                ("converged", "none")
                if scaled_error < CONVERGENCE_TOLERANCE**2
                else ("stuck", "contact" if is_in_contact else "none")
            )
            break
    table = np.array(cycles).reshape(-1, 3 * n + 1)
    q, references, torque = (table[:, block * n : (block + 1) * n].copy() for block in range(3))
    return _LoopSamples(q, references, torque, np.sqrt(table[:, -1])), ending


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

    Args:
        q: (T, n) configurations at the control cycles.
        rate: Control cycles per second.
        gain: Ke, 1/s.
        is_revolute: (n,) joints of which the values count modulo whole turns.
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
        earlier = (
            previous[1] + shift * (previous[2] - previous[0]) / 2 + shift**2 * (previous[2] - 2 * previous[1] + previous[0]) / 2
        )
        return_error = float(np.linalg.norm(_wrap_angles(q[last_period] - earlier, is_revolute), axis=1).max())
        if return_error < DRIFT_FRACTION * extent * min(period / rate * gain, 1.0):
            return "moving", "none"
    return undecided


def _wrap_angles(q: FloatArray, is_revolute: BoolArray) -> FloatArray:
    return np.where(is_revolute, np.arctan2(np.sin(q), np.cos(q)), q)
