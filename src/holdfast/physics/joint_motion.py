"""A timed joint motion carried out by servos in MuJoCo, with joints that lock on the way."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.mjcf import quiet
from holdfast.arm.model import Arm
from holdfast.arm.poses import check_poses
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError
from holdfast.failures import Degraded, Locked, degraded_at, read_locks
from holdfast.keep.labels import KeepLike, all_kept
from holdfast.notice import each, says
from holdfast.physics.execution import Ended, Execution
from holdfast.physics.plant import BURST, EARLY, Plant
from holdfast.physics.servos import Servos, leads
from holdfast.physics.surroundings import Touches

Array = NDArray[np.float64]

SAME = 1e-6  # rad and m: a joint this near to where it is said to be locked is there
AT_REST = 1e-3  # rad/s and m/s
LONGEST = 3600.0  # s


@checked
@quiet()
@says("executing the motion")
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
    """Carry out a timed joint motion in MuJoCo with servos, and judge it (needs ``holdfast[physics]``).

    Bodies, motors and locks are those of :func:`holdfast.simulate_physics`: a joint that locks while it moves stops at once,
    and the jolt goes through the arm. The arm starts at rest where the motion begins. Until a lock is noticed the other joints
    follow the motion as before; then it is run through ever more slowly, to a standstill, and ``at`` and ``degraded`` of the
    result are what :func:`holdfast.recover` begins with. What it finds is carried out with ``locked=answer.degraded``. Joint
    limits do not stop the arm; whether they were kept is in the result.

    Args:
        arm: The arm, with inertial data.
        q: (S, n) configurations, rad and m, straight in joint space from each to the next.
        time: (S,) when they are to be met, s, each after the one before.
        locked: Joints that lock where they are, ``{joint: None}`` or the joints alone, by name or index from 0; or a
            :class:`holdfast.Degraded`, whose ranges and speeds are looked at from the first lock on.
        lock_time: When they lock, s from the start, each at the next control cycle: one time, or one for each of them.
        notice: s from the first lock until the controller knows of it and slows down; None: never, which is
            also right for a motion that was planned for the lock.
        stop: s that slowing down takes; the references stay on the motion.
        goal: (4, 4) pose, or (3,) place, of the tool at the end, m, world.
        keep: What the tool should keep at every instant; see :func:`holdfast.recover`. "At the start" is where ``q`` begins.
        servos: Of the joints; :class:`holdfast.Servos` as they come if not given.
        settle: s that are simulated after the end of the motion, or after the arm has been stopped.
        error_limit: Largest allowed distance of a joint from the motion, rad and m; ``exceeded`` of the result contains the
            first joint that is farther off.
        clearance: The shape of the arm, with a cell or beside one.
        cell: Objects around the arm, or their file, which it touches and pushes against.

    Returns:
        An :class:`holdfast.Execution`: where the tool got to, what was kept, and the motion as it was measured.

    Raises:
        InputError: Wrong shapes, joints or options, times that do not rise, a start within an object, or a cloud of points.
        ArmError: Inertial data are missing or impossible, or a joint carries no mass.
        HoldfastError: MuJoCo is not installed.
    """
    way, seconds = _motion(arm, q, time)
    for name, number in (("notice", notice or 0.0), ("stop", stop), ("settle", settle)):
        if not 0 <= number <= LONGEST:
            raise InputError(f"{name} is {number:g} s; it must be from 0 to {LONGEST:g} s")
    degraded = degraded_at(arm, locked, way[0])
    order = [arm.joint_names[k] for k in read_locks(arm, locked)] if not isinstance(locked, Degraded) else list(locked.locked)
    locks = _lock_times(arm, degraded, order, lock_time, way[0])
    if error_limit is not None and not (len(error_limit) == 2 and all(limit > 0 for limit in error_limit)):
        raise InputError(f"error_limit is {error_limit}; give two numbers above 0, in rad and m")
    if notice is not None and not np.isfinite(locks).any():
        raise InputError("notice has nothing to notice: no joint locks; give locked")
    noticed = np.inf if notice is None else float(locks.min()) + notice
    chosen = Servos() if servos is None else servos
    looked = chosen_clearance(arm, clearance or False, cell, looks=False)
    around = None if looked is None or looked.cell is None else looked
    plant = Plant(arm, way[0], np.zeros(arm.n), np.ones(arm.n, dtype=bool), chosen, around)
    touches = Touches(around)
    touches.require_clear(plant.model)
    stiffness, damping = chosen.gains(arm, plant.mujoco, plant.model, start=way[0])
    wanted, over = _references(way, seconds, 1 / chosen.rate, noticed, stop, settle)
    notes, stable = _drive(plant, wanted, locks, stiffness, damping, touches)
    resting = float(np.abs(notes.rates[-1]).max()) < AT_REST
    outcome: Ended = "unstable" if not stable else "moving" if not resting else "finished" if over else "stopped"
    if degraded is not None:
        now = {name: float(notes.q[-1, arm.joint_index(name)]) for name in degraded.locked}
        degraded = replace(degraded, locked=now)
    return Execution(
        arm=arm,
        degraded=degraded,
        servos=chosen,
        stiffness=stiffness,
        damping=damping,
        lock_time=locks,
        noticed=np.inf if over else noticed,
        outcome=outcome,
        time=np.arange(len(notes.q)) / chosen.rate,
        q=notes.q,
        rates=notes.rates,
        reference=notes.reference,
        planned=wanted[: len(notes.q)],
        torque=notes.torque,
        goal=_goal(goal),
        keep=all_kept(keep, arm.forward_kinematics(way[0])),
        contacts=touches.contacts(),
        cell=None if around is None else around.cell,
        error_limit=error_limit,
    )


def _motion(arm: Arm, q: ArrayLike, time: ArrayLike) -> tuple[Array, Array]:
    """The configurations (S, n), and times (S,) from 0 on."""
    way = np.atleast_2d(arm.check_configurations(q))
    seconds = real_numbers(time, "time", "a number for each configuration, s")
    if seconds.shape != (len(way),) or len(way) < 2:
        raise InputError(
            f"time has shape {seconds.shape} and there are {len(way)} configurations; give two or more, and a time for each"
        )
    if not (np.isfinite(way).all() and np.isfinite(seconds).all()):
        raise InputError("the motion holds NaN or infinity; give finite numbers")
    if (np.diff(seconds) <= 0).any():
        k = int((np.diff(seconds) <= 0).argmax()) + 1
        raise InputError(f"time {k} is {seconds[k]:g} s, after {seconds[k - 1]:g} s; every time must be after the one before")
    if seconds[-1] - seconds[0] > LONGEST:
        raise InputError(f"the motion takes {seconds[-1] - seconds[0]:g} s; it must take {LONGEST:g} s or less")
    return way, seconds - seconds[0]


def _lock_times(arm: Arm, degraded: Degraded | None, order: list[str], lock_time: ArrayLike, start: Array) -> Array:
    """When each joint locks (n,), s, of times in an order of names; infinite for joints that do not."""
    times = np.full(arm.n, np.inf)
    if degraded is None:
        return times
    for name, value in degraded.locked.items():
        k = arm.joint_index(name)
        if value is not None and abs(value - start[k]) > SAME:
            raise InputError(
                f"joint '{name}' is said to be locked at {value:.6g} and the motion begins with it at {start[k]:.6g} "
                f"{arm.joints[k].unit}; a joint locks where it is"
            )
    given = real_numbers(lock_time, "lock_time", "one time, or one for each locked joint, s")
    if given.shape not in ((), (len(degraded.locked),)) or not np.isfinite(given).all() or (given < 0).any():
        raise InputError(
            f"lock_time is {given.tolist()}; give one time of 0 s or more, or {len(degraded.locked)}, one for each joint "
            "that locks"
        )
    for name, when in zip(order, np.broadcast_to(given, len(degraded.locked)), strict=True):
        times[arm.joint_index(name)] = when
    return times


def _goal(goal: ArrayLike | None) -> Array | None:
    if goal is None:
        return None
    given = real_numbers(goal, "goal", "a pose (4, 4) or a place (3,), m")
    if given.shape not in ((4, 4), (3,)) or not np.isfinite(given).all():
        raise InputError(f"goal has shape {given.shape}; give a pose (4, 4) or a place (3,) of finite numbers, m")
    return given if given.ndim == 1 else np.asarray(check_poses(given)[0])


def _references(way: Array, seconds: Array, period: float, noticed: float, stop: float, settle: float) -> tuple[Array, bool]:
    """(K + 1, n) where the servos are to be at each control cycle, and whether that leads to the end of the motion."""
    end = float(seconds[-1])
    over = not noticed + stop / 2 < end  # slowing down takes it half as far as full speed
    last = end if noticed >= end else noticed + stop
    time = np.arange(int(np.ceil((last + settle) / period - 1e-9)) + 1) * period
    slowing = np.clip(time - noticed, 0.0, stop)
    lost = slowing**2 / (2 * stop) if stop else 0.0
    clock = np.minimum(np.minimum(time, noticed) + slowing - lost, end)
    return np.stack([np.interp(clock, seconds, column) for column in way.T], axis=1), over


@dataclass(frozen=True)
class _Notes:
    """Noted at each of T control cycles, (T, n), as in :class:`holdfast.Execution`."""

    q: Array
    rates: Array
    reference: Array
    torque: Array


def _drive(
    plant: Plant, wanted: Array, lock_time: Array, stiffness: Array, damping: Array, touches: Touches
) -> tuple[_Notes, bool]:
    """The motion as it is measured, and whether the physics stayed within bounds."""
    period, feed, lead = 1 / plant.servos.rate, damping / stiffness, leads(plant.arm, stiffness)
    healthy = np.ones(plant.arm.n, dtype=bool)
    plant.tune(stiffness, damping)
    cycles: list[tuple[Array, Array, Array, Array]] = []
    for k in each("control cycles", range(len(wanted)), most=True, every=100):
        left = lock_time > k * period + EARLY
        if not left.all() and (left != healthy).any():
            healthy = left
            plant = plant.locked(healthy)
            plant.tune(stiffness, damping)
        q, rates = plant.q, plant.rates
        following = wanted[min(k + 1, len(wanted) - 1)]
        reference = np.clip(following, q - lead, q + lead)
        cycles.append((q, rates, reference, plant.torque))
        if not float(rates @ rates) < BURST**2:
            break
        plant.follow(reference + feed * (following - wanted[k]) / period)
        if plant.data.ncon > 0:
            touches.note(plant.model, plant.data, (k + 1) * period)
    notes = _Notes(*(np.array(column) for column in zip(*cycles, strict=True)))
    return notes, len(cycles) == len(wanted)
