"""Simulation of the closed loop of a controller without fault information whose joints lock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.laws.law import Law
from holdfast.control.simulation.batch import compiled_simulator
from holdfast.control.simulation.runs import Reason, Runs, RunSettings
from holdfast.control.simulation.tableaus import CLASSIC_RK4
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.task import target_poses
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.collision.contacts import Contact, find_first_contacts
from holdfast.model.failure_modes import Degraded, Locked, read_locks

Method = Literal["adaptive", "rk4"]


@runtime_checkable
class LockSchedule(Protocol):
    """Faults that determine when joints lock."""

    def times_of(self, joints: Sequence[str]) -> FloatArray:
        """Return the times (n,), or (N, n) for N runs, at which these joints lock, infinite for never."""
        ...


TIME_LIMIT = 3000.0  # 1/Ke
CYCLE_LIMIT = 1000.0  # cycles
TARGET_RADIUS_M = 0.1  # m
DEFAULT_TOLERANCE = 1e-9
MAX_TOLERANCE = 1e-6
MIN_TOLERANCE = 1e-13
_END_FIELDS = ("code", "q_final", "x_final", "error", "closest", "path_length", "q_low", "q_high", "limits_passed", "time")


@check_arguments
@reports_progress("simulating motions")
def simulate(
    law: Law,
    q0: ArrayLike,
    target: ArrayLike,
    *,
    locked: Locked | NDArray[np.int64] | FloatArray = (),
    cycles: bool = False,
    method: Method = "adaptive",
    time_limit: float | None = None,
    tolerance: float = DEFAULT_TOLERANCE,
    step: float | None = None,
    radius: float = TARGET_RADIUS_M,
    time: ArrayLike = 0.0,
    faults: LockSchedule | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    stop_at_contact: bool = False,
) -> Runs:
    """Simulate an arm whose joints lock while its controller has no fault information.

    The motion is ``q' = mask G(q) Ke e(q)`` with mask 0 for locked joints, the law's inverse G at the true configuration with
    all columns, and the error ``e = (p_d - p; log(R_d R'))`` of the task's rows in the world. Joint limits are not enforced,
    only reported.

    In continuous time a run ends as follows. Speeds are norms of the healthy joints' rates without the speed limit, which
    changes no path, and times are counted without it, too.

    * A run is at rest if its speed falls below 1e-8 Ke. It is *converged* if the error is below 1e-5, otherwise *stuck*. The
      error is in rad, and in m for an arm of about 1 m; lengths are in the arm's own unit (its links end to end, rounded to a
      power of two), so that an arm and its scaled copy end alike.
    * A run is *moving* if it was found to repeat its motion (a limit cycle, or joints that rotate forever). At the time limit,
      or after 100,000 steps, the motion is simulated for some thousand further steps. It must return to the same configuration,
      modulo full turns, so accurately that over 100,000/Ke it would drift by less than a hundredth of its extent. At the time
      limit this is checked only if the speed was never below 1e-3 Ke during the last 20 % of the time and did not decay, which
      means that its greatest value in the last tenth is at least 0.99 of that in the tenth before.
    * Otherwise a run is *undecided*, for one of these reasons: *time_limit* (it still moves and was not found to repeat its
      motion; a longer limit may decide it and contradicts no shorter one), *singular* (the steps shrink to zero, or the law has
      no answer), *steps* (100,000 steps, as close to a singularity), *half turn* (100,000 steps with the end effector half a
      turn from its target, where the shortest rotation, and with it the command, is discontinuous; such a run is stopped as
      soon as it would not finish at the pace of its last 2,000 steps), or *bad input*.

    These rules do not depend on the size of the steps.

    In cycles the command is held for a cycle, and the arm follows the law in 10 explicit Euler sub-steps. A run is *converged*
    if the error is at most ``radius`` at the beginning of a cycle. It is *stuck* if for 50 consecutive cycles the end effector
    moved less than 2e-5 of the distance that the speed limit allows (without a limit: 1e-6 m for an arm of 1 m). At the limit
    it is *undecided*, because a motion in steps returns to no configuration exactly.

    With a cell, ``contacts`` lists the contacts of each run, with the time of the first contact and its depth. They change no
    run unless ``stop_at_contact`` is True. The distance is a lower bound, so a contact may be reported slightly early, and none
    is missed. The motion is checked at instants at most 0.05 rad (and m) apart, and between them until the distance can change
    by no more than half a millimetre. If a run repeats its motion, its first 200/Ke are checked.

    Args:
        law: The control law, with its arm, task, gain ``Ke`` and speed limit (per second, or per cycle).
        q0: (n,) configuration or (N, n) configurations at the start, rad and m.
        target: (m,) or (N, m) task rows of the target's tool point, m, for tasks without angular rows. For any task, (4, 4) or
            (N, 4, 4) tool poses in the world, m.
        locked: Joints that lock at their current values in every run, as ``{joint: None}`` or the joints alone, by name or
            index from 0; or a :class:`holdfast.Degraded` that contains only locks, at the values in ``q0``. For different locks
            in each run, an array: (N,) index of one joint, -1 for none; or (N, n) lock times, s or cycles, infinite for never.
        cycles: True for discrete control cycles in place of continuous time.
        method: ``adaptive`` (DOP853, order 8) or ``rk4`` (classic Runge-Kutta, fixed step).
        time_limit: Time limit of each run, s or cycles. Default: 3000/Ke, or 1000 cycles.
        tolerance: Local error of a step of the adaptive method, rad (and m), 1e-13 to 1e-6.
        step: Step of ``rk4``, s. Default: 0.1/Ke.
        radius: Radius of the target in cycles, m (and rad).
        time: Lock times, s or cycles: one time, or one for each joint in ``locked``.
        faults: Sampled locks in place of ``locked`` and ``time``: those of one episode
            (:class:`holdfast.response.faults.FaultEvents`), or of one episode for each run
            (:class:`holdfast.response.faults.FaultBatch`). Other faults need the bodies and motors of
            :func:`holdfast.simulate_faults`.
        clearance: Collision model of the arm, which may contain a cell; True also checks for self-contact with capsules of an
            assumed radius. None: no self-contact.
        cell: Objects around the arm, or their file. Safety margins are ignored.
        stop_at_contact: True to stop a run at its first contact, where all joints are held (in cycles from the next cycle on).
            The run is *converged* if it is at its target, otherwise *stuck*, and its reason is *contact*.

    Returns:
        A :class:`holdfast.Runs`. A row with NaN is undecided.

    Raises:
        InputError: Wrong shapes, joints or options, or a single start with NaN.

    Source: Goel et al. 2005, eq. (3) to (7); Goel et al. 2003, section 4, for cycles. The rules for the end are ours.
    """
    starts, is_single = as_configurations(law.arm, q0)
    poses, target_components = target_poses(law.task, target)
    targets = poses if target_components is None else target_components
    lock_times, is_shared = (
        _read_lock_times(law, locked, time, starts) if faults is None else _read_scheduled_lock_times(law, faults, locked)
    )
    counts = {"q0": len(starts), "target": len(targets), "locked": len(lock_times)}
    run_count = max(counts.values()) if min(counts.values()) else 0
    for input_name, count in counts.items():
        if count not in (1, run_count):
            raise InputError(
                f"{input_name} has {count} rows, another input has {run_count}; give the same number, or one for all"
            )
    if method not in ("adaptive", "rk4"):
        raise InputError(f"method '{method}' is not known; use adaptive or rk4")
    if cycles and (method != "adaptive" or step is not None):
        raise InputError("method or step is given with cycles, which have a fixed method; leave out method and step")
    if step is not None and method != "rk4":
        raise InputError("step belongs to method='rk4'; the adaptive method takes a tolerance")
    run_limit = time_limit if time_limit is not None else CYCLE_LIMIT if cycles else TIME_LIMIT / law.gain
    step_size = step if step is not None else 0.1 / law.gain
    for input_name, value in (("time_limit", run_limit), ("step", step_size), ("radius", radius)):
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"{input_name} is {value:g}; it must be a finite number above 0")
    if not MIN_TOLERANCE <= tolerance <= MAX_TOLERANCE:
        raise InputError(
            f"tolerance is {tolerance:g}; it must be between {MIN_TOLERANCE:g} and {MAX_TOLERANCE:g} to detect rest"
        )
    if step_size * law.gain > CLASSIC_RK4.longest_step:
        raise InputError(
            f"step is {step_size:g} s; above {CLASSIC_RK4.longest_step:g}/Ke, {CLASSIC_RK4.longest_step / law.gain:g} s, "
            f"the method is not stable"
        )
    checked_clearance = chosen_clearance(law.arm, clearance or False, cell, looks=False)
    if stop_at_contact and checked_clearance is None:
        raise InputError("stop_at_contact has nothing to stop at; give a cell, or a clearance")
    settings = RunSettings(float(run_limit), float(radius if cycles else tolerance), float(step_size))
    runs = compiled_simulator(law, "cycles" if cycles else method).run(
        np.broadcast_to(starts, (run_count, law.arm.n)),
        np.broadcast_to(targets, (run_count, *targets.shape[1:])),
        np.broadcast_to(lock_times, (run_count, law.arm.n)),
        settings,
    )
    if checked_clearance is not None:
        runs = _add_contacts(runs, checked_clearance, stop_at_contact)
    if is_single and is_shared and np.ndim(target) == targets.ndim - 1:
        arrays = {name: value[0] for name, value in vars(runs).items() if isinstance(value, np.ndarray)}
        return replace(runs, **arrays)
    return runs


# ---- input -------------------------------------------------------------------------------------------------------


def _read_lock_times(law: Law, locked: Locked | NDArray[Any], time: ArrayLike, start: FloatArray) -> tuple[FloatArray, bool]:
    """Return the time (M, n) at which each joint locks, infinite for never, and whether all runs share it."""
    arm = law.arm
    if isinstance(locked, np.ndarray):
        if locked.ndim == 2:
            return _check_lock_times(law, locked), False
        if locked.ndim != 1 or not np.issubdtype(locked.dtype, np.integer):
            raise InputError(
                f"locked has shape {locked.shape} and type {locked.dtype}; an array holds one joint index for each run, (N,) "
                f"whole numbers, -1 for none, or lock times, (N, {arm.n})"
            )
        invalid = np.flatnonzero((locked < -1) | (locked >= arm.n))
        if invalid.size:
            raise InputError(
                f"locked[{invalid[0]}] is {locked[invalid[0]]}; '{arm.name}' has joints 0 to {arm.n - 1}, and -1 means none"
            )
        times = np.full((len(locked), arm.n), np.inf)
        rows = np.flatnonzero(locked >= 0)
        times[rows, locked[rows]] = 0.0
        return times, False
    joints = read_locks(arm, locked)
    is_degraded = isinstance(locked, Degraded)
    for joint, value in joints.items():
        if value is not None and not (is_degraded and (start[:, joint] == value).all()):
            joint_name = arm.joint_names[joint]
            raise InputError(
                f"locked has {value:g} for '{joint_name}'; a joint locks where it is: give None, and its value in q0"
            )
    lock_times = require_real_numbers(time, "time")
    if lock_times.shape not in ((), (len(joints),)):
        raise InputError(
            f"time has shape {lock_times.shape} and locked names {len(joints)} joints; give one time, or one for each"
        )
    if not (np.isfinite(lock_times) & (lock_times >= 0)).all():
        raise InputError(f"time is {time!r}; a joint locks at a finite time of 0 or more")
    times = np.full((1, arm.n), np.inf)
    times[0, list(joints)] = lock_times
    return times, True


def _read_scheduled_lock_times(law: Law, faults: LockSchedule, locked: Any) -> tuple[FloatArray, bool]:
    """Return the lock times of sampled faults, and whether all runs share them."""
    if not hasattr(faults, "times_of"):
        raise InputError(f"faults is {faults!r}; give sampled faults: those of one episode by draw, or of many by batch")
    if np.size(locked):
        raise InputError("locked is given with faults, which already determine the locks; leave one of them out")
    times = faults.times_of(law.arm.joint_names)
    return np.atleast_2d(times), times.ndim == 1


def _check_lock_times(law: Law, locked: NDArray[Any]) -> FloatArray:
    arm = law.arm
    if locked.shape[1] != arm.n or not np.issubdtype(locked.dtype, np.number):
        raise InputError(
            f"locked has shape {locked.shape} and type {locked.dtype}; lock times are numbers (N, {arm.n}), one for each run "
            "and joint"
        )
    lock_times = np.array(locked, dtype=np.float64)
    invalid = np.argwhere(~(lock_times >= 0))
    if invalid.size:
        run, joint = invalid[0]
        raise InputError(
            f"locked[{run}, {joint}] is {lock_times[run, joint]:g}; a lock time is 0 or more, and infinite for a joint "
            f"that never locks"
        )
    return lock_times


# ---- contacts ----------------------------------------------------------------------------------------------------


def _add_contacts(runs: Runs, clearance: Clearance, stop: bool) -> Runs:
    """Return the runs with their contacts, stopped at the first contact if required, and otherwise unchanged.

    The runs are simulated again, one at a time. If a run repeats its motion, its first 200/Ke are checked.
    """
    contacts: list[Contact] = []
    for run in track("runs checked for contacts", range(len(runs))):
        if runs.reason[run] != Reason.BAD_INPUT:
            end_time = runs.checked_until(run)
            time, motion = runs._simulator.replay_run(runs, run, end_time)
            time = np.unique(np.minimum(time, end_time))
            contacts += [replace(contact, run=run) for contact in find_first_contacts(clearance, time, motion(time), motion)]
    runs = replace(runs, clearance=clearance, contacts=tuple(contacts))
    return _stop_at_contacts(runs, clearance) if stop else runs


def _stop_at_contacts(runs: Runs, clearance: Clearance) -> Runs:
    """Return runs that end at their first contact, from which on all joints are locked."""
    stop_times = np.array([np.inf if contact is None else contact.time for contact in runs.first_contacts])
    stop_times = np.ceil(stop_times) if runs.cycles else stop_times
    runs = replace(runs, stopped=stop_times)
    rows = np.flatnonzero(np.isfinite(stop_times))
    if rows.size:
        stopped_runs = runs._simulator.run(runs.q0[rows], runs.target[rows], runs.held_from[rows], runs._settings)
        fields = {name: getattr(runs, name).copy() for name in (*_END_FIELDS, "reason")}
        for name in _END_FIELDS:
            fields[name][rows] = getattr(stopped_runs, name)
        fields["reason"][rows], fields["time"][rows] = Reason.CONTACT, stop_times[rows]
        runs = replace(runs, **fields)
    contacts = [touch for touch in runs.contacts or () if touch.time <= stop_times[touch.run]]
    depths = -clearance.by_pair(runs.q_final[[touch.run for touch in contacts]])
    pair_columns = {name: column for column, name in enumerate(clearance.pair_names)}
    return replace(
        runs,
        contacts=tuple(
            replace(touch, depth=max(float(row[pair_columns[f"{touch.link} & {touch.object}"]]), 0.0))
            for touch, row in zip(contacts, depths, strict=True)
        ),
    )
