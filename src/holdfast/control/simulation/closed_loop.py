"""The closed loop of a controller without fault information whose joints lock."""

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
    """Faults that state when joints lock."""

    def times_of(self, joints: Sequence[str]) -> FloatArray:
        """Return (n,), or (N, n) of N runs, the times at which these joints lock, infinite for never."""
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

    ``q' = mask G(q) Ke e(q)`` with mask 0 for locked joints, G the law's inverse at the true configuration with no column
    removed, and e the error ``(p_d - p; log(R_d R'))`` of the task's rows in the world. Joint limits are not heeded, only
    reported.

    How a run ends (continuous time; speeds are norms of the healthy joints' rates as they would be without the speed limit,
    which changes no path; times count likewise):

    * at rest, where the speed falls below 1e-8 Ke: *converged* if the error is below 1e-5, *stuck* if not (rad, and m for an
      arm of about 1 m: lengths count in units of the arm's own, its links end to end rounded to a power of two, so that an arm
      and its copy in another size end alike);
    * *moving*, if it was found to repeat its motion (a limit cycle, or joints that turn forever): at the time limit, or after
      100,000 steps, the motion is followed for some thousand steps more, and returns to the same configuration, modulo whole
      turns, so nearly that over 100,000/Ke it would drift by less than a hundredth of its extent. At the time limit this is
      looked for only where the speed was never below 1e-3 Ke during the last 20 % of the time and did not decay, because its
      greatest value in the last tenth is at least 0.99 of that in the tenth before;
    * *undecided*, with the reason: *time_limit* (still moving then, and not found to repeat its motion; a longer limit may
      decide it and contradicts no shorter one), *singular* (the steps shrink to
      nothing, or the law has no answer), *steps* (100,000 steps, as beside a singularity), *half turn* (likewise with
      the end effector
      half a turn from its target, where the shortest turn, and with it the command, is discontinuous; such a run is given up
      as soon as it would not finish at the pace of its last 2,000 steps), *bad input*.

    None of this looks at the steps that were taken, so that it does not depend on their size.

    In cycles the command is held for a cycle and the arm follows the law in 10 explicit Euler sub-steps. A run has *converged*
    when the error is at most ``radius`` as a cycle begins; it is *stuck* when for 50 cycles one after the other the end
    effector moved less than 2e-5 of what the speed limit lets it (without a limit: than 1e-6 m for an arm of 1 m); at the limit
    it is *undecided*, because a motion in steps returns to no configuration exactly.

    With a cell each run says what the arm touches on its way, when first and how deep (``contacts``); that changes nothing of
    the run, unless it is to stop there. The distance is a lower bound, so a contact may come a little early, and none is
    missed: the motion is looked at from instant to instant, at most 0.05 rad (and m) apart, and between them until half a
    millimetre is all that could change. Of a run that repeats its motion the first 200/Ke are checked.

    Args:
        law: The control law, with its arm, task, gain ``Ke`` and speed limit (per second, or per cycle).
        q0: (n,) or (N, n) configurations at the start, rad and m.
        target: (m,) or (N, m) for tasks without angular rows: the task's rows of the wanted tool point, m. For any task,
            (4, 4) or (N, 4, 4) tool poses in the world.
        locked: Joints that lock where they are in every run, ``{joint: None}`` or the joints alone, by name or index from 0; or
            a :class:`holdfast.Degraded` of locks alone, where ``q0`` has them. Or for each run of its own, as an array: (N,)
            the index of one joint, -1 for none; or (N, n) the time at which each joint locks, s or cycles, infinite for never.
        cycles: Discrete control cycles in place of continuous time.
        method: ``adaptive`` (DOP853, order 8) or ``rk4`` (classic Runge-Kutta, fixed step).
        time_limit: s or cycles; 3000/Ke, or 1000 cycles, if not given.
        tolerance: Of the adaptive method: the local error of a step, rad (and m), 1e-13 to 1e-6.
        step: Of ``rk4``, s; 0.1/Ke if not given.
        radius: Of the target in cycles, m (and rad).
        time: When the joints lock, s or cycles: one time, or one for each of them.
        faults: In place of ``locked`` and ``time``: locks that were drawn, of an episode
            (:class:`holdfast.response.faults.FaultEvents`) or, one for each run, of many
            (:class:`holdfast.response.faults.FaultBatch`). Other faults need bodies and motors:
            :func:`holdfast.simulate_faults`.
        clearance: The shape of the arm and what it may touch, maybe with a cell; True: also itself, by capsules of an assumed
            radius. If not given it does not touch itself.
        cell: Objects around the arm, or their file. Margins are not looked at.
        stop_at_contact: A run ends where the arm first touches something: all joints are held there (in cycles: as the next
            cycle begins). It has *converged* if it is at its target, else it is *stuck*, and its reason is *contact*.

    Returns:
        A :class:`holdfast.Runs`. A row with NaN is undecided; a single start with NaN raises.

    Raises:
        InputError: Wrong shapes, joints or options.

    Source: Goel et al. 2005, eq. (3) to (7); Goel et al. 2003, section 4, for cycles. The rule is ours.
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
        raise InputError("cycles have a method of their own; leave out method and step")
    if step is not None and method != "rk4":
        raise InputError("step belongs to method='rk4'; the adaptive method takes a tolerance")
    run_limit = time_limit if time_limit is not None else CYCLE_LIMIT if cycles else TIME_LIMIT / law.gain
    step_size = step if step is not None else 0.1 / law.gain
    for input_name, value in (("time_limit", run_limit), ("step", step_size), ("radius", radius)):
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"{input_name} is {value:g}; it must be a finite number above 0")
    if not MIN_TOLERANCE <= tolerance <= MAX_TOLERANCE:
        raise InputError(
            f"tolerance is {tolerance:g}; it must be between {MIN_TOLERANCE:g} and {MAX_TOLERANCE:g}, or rest cannot be seen"
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
    """Return the time at which each joint locks (M, n), infinite for never, and whether all runs share it."""
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
        raise InputError(f"faults is {faults!r}; give those of an episode, by draw, or of many, by batch")
    if np.size(locked):
        raise InputError("locked does not go with faults, which say what locks; leave one of them out")
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

    Every run is simulated again, one after the other; of one that repeats its motion the first 200/Ke are checked.
    """
    contacts: list[Contact] = []
    for run in track("runs looked at for contacts", range(len(runs))):
        if runs.reason[run] != Reason.BAD_INPUT:
            end_time = runs.checked_until(run)
            time, motion = runs._simulator.replay_run(runs, run, end_time)
            time = np.unique(np.minimum(time, end_time))
            contacts += [replace(contact, run=run) for contact in find_first_contacts(clearance, time, motion(time), motion)]
    runs = replace(runs, clearance=clearance, contacts=tuple(contacts))
    return _stop_at_contacts(runs, clearance) if stop else runs


def _stop_at_contacts(runs: Runs, clearance: Clearance) -> Runs:
    """Return runs that end at their first contact: all joints are locked from then on."""
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
