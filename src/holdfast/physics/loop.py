"""The closed loop of a controller that does not know of a locked joint, with bodies and motors."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.mjcf import quiet
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.control.law import Law
from holdfast.errors import InputError
from holdfast.failures import Locked
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.notice import each, says
from holdfast.physics.plant import BURST, EARLY, Plant
from holdfast.physics.run import Ending, PhysicalRun, Why
from holdfast.physics.servos import Servos, leads
from holdfast.physics.surroundings import Touches
from holdfast.simulation.batch import ARRIVES
from holdfast.simulation.closed_loop import simulate
from holdfast.simulation.runs import Runs
from holdfast.simulation.system import System

Array = NDArray[np.float64]

REST = 1e-6  # rad (and m) per 1/Ke, of the command and of the joints
STILL_FOR = 0.1  # 1/Ke: for so long, without a break
TIME_LIMIT = 200.0  # 1/Ke
NEAR = 0.1  # of the motion's extent: a return that misses by more is none
DRIFT_FRACTION = 1e-3  # of the motion's extent: what the last period may differ from the one before it by
LEAST_EXTENT = 1e-3  # rad (and m): a smaller motion is not taken for a repeated one


@checked
@quiet()
@says("simulating the physics")
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
    """One run of the closed loop on MuJoCo, beside the kinematic one (needs ``holdfast[physics]``).

    :func:`holdfast.simulation.simulate` lets healthy joints do what they are told. Here they have bodies and motors: at every
    control cycle the law, which knows of no failure, is given the measured configuration (the failed joint's sensor works),
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
        target: (m,) or (4, 4), as for :func:`holdfast.simulation.simulate`.
        locked: Joints that lock where they are, ``{joint: None}`` or the joints alone, by name or index from 0.
        servos: Of the joints; :class:`holdfast.Servos` as they come if not given.
        time_limit: s; 200/Ke if not given.
        time: When the joints lock, s, each at the next control cycle: one time, or one for each of them.
        clearance: The shape of the arm, with a cell or beside one.
        cell: Objects around the arm, or their file.
        stop_at_contact: Of the kinematic run, see :func:`holdfast.simulation.simulate`; the physical one meets the objects.

    Returns:
        A :class:`holdfast.PhysicalRun`, which holds the kinematic run and how far they are apart.

    Raises:
        InputError: Wrong shapes, joints or options, more than one run, a start within an object, or a cloud of points.
        ArmError: Inertial data are missing or impossible, or a joint carries no mass.
        HoldfastError: MuJoCo is not installed.
    """
    limit = TIME_LIMIT / law.gain if time_limit is None else float(time_limit)
    if not (np.isfinite(limit) and limit > 0):
        raise InputError(f"time_limit is {limit:g}; it must be a finite number above 0")
    chosen, arm = Servos() if servos is None else servos, law.arm
    start = arm.check_configurations(q0).reshape(-1, arm.n)[0]
    looked = chosen_clearance(arm, clearance or False, cell, looks=False)
    around = None if looked is None or looked.cell is None else looked
    plant = Plant(arm, start, np.zeros(arm.n), np.ones(arm.n, dtype=bool), chosen, around)
    touches = Touches(around)
    touches.require_clear(plant.model)
    stiffness, damping = chosen.gains(arm, plant.mujoco, plant.model, start=start)
    runs = simulate(law, q0, target, locked=locked, time=time, clearance=looked, stop_at_contact=stop_at_contact)
    if runs.code.ndim:
        raise InputError(f"physics is for one run at a time, and there are {len(runs)}; give one q0 and one target")
    notes, end = _drive(plant, law, runs, stiffness, damping, limit, touches)
    outcome, reason = end or _verdict(notes.q, chosen.rate, law.gain, ~arm.prismatic)
    return PhysicalRun(
        law=law,
        servos=chosen,
        stiffness=stiffness,
        damping=damping,
        kinematic=runs,
        outcome=outcome,
        reason=reason,
        time=np.arange(len(notes.q)) / chosen.rate,
        q=notes.q,
        reference=notes.reference,
        torque=notes.torque,
        x=arm.forward_kinematics(notes.q)[:, :3, 3],
        error=notes.error,
        contacts=touches.contacts(),
    )


@dataclass(frozen=True)
class _Notes:
    """Values at each of T control cycles, as in :class:`holdfast.PhysicalRun`."""

    q: Array
    reference: Array
    torque: Array
    error: Array


def _drive(
    plant: Plant, law: Law, runs: Runs, stiffness: Array, damping: Array, limit: float, touches: Touches
) -> tuple[_Notes, tuple[Ending, Why] | None]:
    """The physical run beside a kinematic one, and how it ended if it did before the time limit."""
    n, period = law.arm.n, 1 / plant.servos.rate
    asked, row = _command(law).single(), np.concatenate([plant.start, *_goal(law, runs)])
    lead, feed = leads(law.arm, stiffness), damping / stiffness
    reference, lock_time = plant.start.copy(), runs.lock_time
    healthy, next_lock = np.ones(n, dtype=bool), float(lock_time.min())
    plant.tune(stiffness, damping)
    patience, still = int(np.ceil(STILL_FOR / law.gain / period)), 0
    cycles: list[Array] = []
    end: tuple[Ending, Why] | None = None
    for k in each("control cycles", range(int(np.ceil(limit / period - 1e-9)) + 1), most=True, every=100):
        if k * period >= next_lock - EARLY:
            healthy = lock_time > k * period + EARLY
            plant = plant.locked(healthy)
            plant.tune(stiffness, damping)
            next_lock = float(lock_time[healthy].min(initial=np.inf))
        row[:n] = q = plant.q
        out = asked(row)
        rates, square, scaled = out[:n], out[n + 1], out[n + 2]
        if not np.isfinite(square + rates.sum()):
            end = ("undecided", "singular" if np.isfinite(q).all() else "unstable")
            break
        reference = np.minimum(np.maximum(reference + period * rates, q - lead), q + lead)
        obeyed = rates[healthy]
        speed = float(np.sqrt(obeyed @ obeyed)) / out[n]
        plant.follow(reference + feed * rates)
        cycles.append(np.concatenate((q, reference, plant.torque, (square,))))
        held = plant.data.ncon > 0
        if held:
            touches.note(plant.model, plant.data, (k + 1) * period)
        velocity = plant.data.qvel
        moving = float(velocity @ velocity)
        if not moving < BURST**2:
            end = ("undecided", "unstable")
            break
        # An arm that lies against an object is told to move as long as it lies there.
        still = still + 1 if max(0.0 if held else speed, np.sqrt(moving)) < REST * law.gain else 0
        if still > patience:
            end = ("converged", "none") if scaled < ARRIVES**2 else ("stuck", "contact" if held else "none")
            break
    table = np.array(cycles).reshape(-1, 3 * n + 1)
    q, references, torque = (table[:, i * n : (i + 1) * n].copy() for i in range(3))
    return _Notes(q, references, torque, np.sqrt(table[:, -1])), end


@recalled
def _command(law: Law) -> Kernel:
    """``(q, p, R) -> rates`` (n,) as commanded, how far they are slowed, and squared errors, in m and in the arm's own unit."""
    system = System(law)
    e, _ = system.error(system.q)
    v, share = system.command(e)
    rates = law.rates(system.q, v) * law.gain
    known = ca.vertcat(rates, share, ca.sumsqr(e), ca.sumsqr(system.scaled_error(system.q)[0]))
    return Kernel("command in physics", [system.q, system.target, system.rotation], [known])


def _goal(law: Law, runs: Runs) -> tuple[Array, Array]:
    """Position (3,) and rotation (9,), row by row, of the target."""
    if runs.target.ndim == 2:
        return runs.target[:3, 3], runs.target[:3, :3].ravel()
    return runs.target @ law.task.rows[:, :3], np.eye(3).ravel()


def _verdict(q: Array, rate: float, gain: float, turning: NDArray[np.bool_]) -> tuple[Ending, Why]:
    """Return how a run ended that was under way at the time limit: it repeats its motion, or it is undecided.

    It repeats its motion if over a whole last period it was where it had been one period earlier, and so had the same velocity.

    Args:
        q: (T, n) configurations at the control cycles.
        rate: Control cycles per second.
        gain: Ke, 1/s.
        turning: (n,) joints of which the values count modulo whole turns.
    """
    undecided: tuple[Ending, Why] = ("undecided", "time_limit")
    away = _wrap_angles(q[-1] - q, turning)
    distance = np.linalg.norm(away, axis=1)[::-1]  # backwards in time, from 0
    extent = float(distance.max())
    far = int(np.argmax(distance > NEAR * extent))
    if extent < LEAST_EXTENT or not far:
        return undecided
    near = np.flatnonzero((distance[1:-1] <= distance[:-2]) & (distance[1:-1] < distance[2:])) + 1
    for period in near[(near > far) & (distance[near] < NEAR * extent)].tolist():
        if 2 * period + 2 > len(q):
            break
        # The return falls between two cycles: there the motion is a parabola.
        around = away[[-period - 2, -period - 1, -period]]
        speed = (around[2] - around[0]) / 2
        shift = -float(around[1] @ speed) / max(float(speed @ speed), np.finfo(np.float64).tiny)
        last = np.arange(len(q) - period, len(q))
        before = q[last - period - 1], q[last - period], q[np.minimum(last - period + 1, len(q) - 1)]
        earlier = before[1] + shift * (before[2] - before[0]) / 2 + shift**2 * (before[2] - 2 * before[1] + before[0]) / 2
        missed = float(np.linalg.norm(_wrap_angles(q[last] - earlier, turning), axis=1).max())
        if missed < DRIFT_FRACTION * extent * min(period / rate * gain, 1.0):
            return "moving", "none"
    return undecided


def _wrap_angles(q: Array, turning: NDArray[np.bool_]) -> Array:
    return np.where(turning, np.arctan2(np.sin(q), np.cos(q)), q)
