"""The closed loop of a controller that does not know that a joint has locked."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.configurations import configurations
from holdfast.arm.poses import check_poses
from holdfast.control.law import Law
from holdfast.errors import InputError
from holdfast.kernels import Kernel
from holdfast.simulate.cycles import SUBSTEPS, Cycles
from holdfast.simulate.motion import ARRIVED, COLLAPSE, FAR, PHASE, REST, RUNNING, TIME, System
from holdfast.simulate.nearest import Nearest
from holdfast.simulate.runge_kutta import FIRST, REST_SPEED, TURN, Steps
from holdfast.simulate.runs import Outcome, Path, Reason, Runs
from holdfast.simulate.tableaus import CLASSIC, DOP853

Array = NDArray[np.float64]
Method = Literal["adaptive", "rk4"]
Locked = Sequence[str | int | tuple[str | int, float]] | NDArray[np.int64] | Array

ARRIVES = 1e-5  # m and rad: an error below it at rest is no error
MOVES = 1e-3  # rad (and m) per 1/Ke: an arm that is always faster is not coming to rest
DECAYS = 0.99  # of the greatest speed, from one tenth of the time to the next: slowing down
TIME_LIMIT, CYCLE_LIMIT = 3000.0, 1000.0  # 1/Ke, cycles
RADIUS = 0.1  # m
TOLERANCE, LOOSEST, TIGHTEST = 1e-9, 1e-6, 1e-13
MOST_STEPS = 100_000


def simulate(
    law: Law,
    q0: ArrayLike,
    target: ArrayLike,
    locked: Locked = (),
    cycles: bool = False,
    method: Method = "adaptive",
    time_limit: float | None = None,
    tolerance: float = TOLERANCE,
    step: float | None = None,
    radius: float = RADIUS,
) -> Runs:
    """What the arm does when joints lock and its controller goes on as if nothing had happened.

    ``q' = mask G(q) Ke e(q)`` with mask 0 for locked joints, G the law's inverse at the true configuration with no column
    removed, and e the error ``(p_d - p; log(R_d R'))`` of the task's rows in the world. Joint limits are not heeded, only
    reported.

    How a run ends (continuous time; speeds are norms of the healthy joints' rates as they would be without the speed limit,
    which changes no path; times count likewise):

    * at rest, where the speed falls below 1e-8 Ke: *converged* if the error is below 1e-5, *stuck* if not;
    * *moving*, if at the time limit the speed was never below 1e-3 Ke during the last 20 % of the time, and did not decay:
      its greatest value in the last tenth is at least 0.99 of that in the tenth before;
    * *undecided*, with the reason: *slow* (the time limit, but neither at rest nor moving), *singular* (the steps shrink to
      nothing, or the law has no answer), *steps* (100,000 steps, as beside a singularity), *bad input*.

    None of this looks at the steps that were taken, so that it does not depend on their size.

    In cycles the command is held for a cycle and the arm follows the law in 10 explicit Euler sub-steps. A run has
    *converged* when the error is at most ``radius`` as a cycle begins; it is *stuck* when the hand moved less than 1e-6 m
    per cycle for 50 cycles one after the other; at the limit it is *moving* or *undecided* as above.

    Args:
        law: The control law, with its arm, task, gain ``Ke`` and speed limit (per second, or per cycle).
        q0: (n,) or (N, n) configurations at the start, rad and m.
        target: (m,) or (N, m) for tasks without angular rows: the task's rows of the wanted tool point, m. For any task,
            (4, 4) or (N, 4, 4) tool poses in the world.
        locked: Joints, by name or index from 0, that stand from the start in every run; ``(joint, time)`` locks at that time,
            s or cycles. Or for each run of its own, as an array: (N,) the index of one joint, -1 for none; or (N, n) the time
            at which each joint locks, s or cycles, infinite for never.
        cycles: Discrete control cycles in place of continuous time.
        method: ``adaptive`` (Dormand-Prince 5(4)) or ``rk4`` (classic Runge-Kutta, fixed step).
        time_limit: s or cycles; 3000/Ke, or 1000 cycles, if not given.
        tolerance: Of the adaptive method: the local error of a step, rad (and m), 1e-13 to 1e-8.
        step: Of ``rk4``, s; 0.1/Ke if not given.
        radius: Of the target in cycles, m (and rad).

    Returns:
        A :class:`holdfast.Runs`. A row with NaN is undecided; a single start with NaN raises.

    Raises:
        InputError: Wrong shapes, joints or options.

    Source: Goel et al. 2005, eq. (3) to (7); Goel et al. 2003, section 4, for cycles. The rule is ours.
    """
    start, single = configurations(law.arm, q0)
    poses, wanted = _target(law, target)
    locks, shared = _locks(law, locked)
    counts = {"q0": len(start), "target": len(poses), "locked": len(locks)}
    rows = max(counts.values()) if min(counts.values()) else 0
    for what, count in counts.items():
        if count not in (1, rows):
            raise InputError(f"{what} has {count} rows, another input has {rows}; give the same number, or one for all")
    if method not in ("adaptive", "rk4"):
        raise InputError(f"method '{method}' is not known; use adaptive or rk4")
    if cycles and (method != "adaptive" or step is not None):
        raise InputError("cycles have a method of their own; leave out method and step")
    if step is not None and method != "rk4":
        raise InputError("step belongs to method='rk4'; the adaptive method takes a tolerance")
    limit = time_limit if time_limit is not None else CYCLE_LIMIT if cycles else TIME_LIMIT / law.gain
    first = step if step is not None else 0.1 / law.gain
    for what, value in (("time_limit", limit), ("step", first), ("radius", radius)):
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"{what} is {value:g}; it must be a finite number above 0")
    if not TIGHTEST <= tolerance <= LOOSEST:
        raise InputError(f"tolerance is {tolerance:g}; it must be between {TIGHTEST:g} and {LOOSEST:g}, or rest cannot be told")
    if first * law.gain > CLASSIC.longest:
        raise InputError(
            f"step is {first:g} s; above {CLASSIC.longest:g}/Ke, {CLASSIC.longest / law.gain:g} s, the method is not stable"
        )
    setting = Setting(float(limit), float(radius if cycles else tolerance), float(first))
    runs = _motion(law, "cycles" if cycles else method).run(
        np.broadcast_to(start, (rows, law.arm.n)),
        np.broadcast_to(poses, (rows, 4, 4)),
        np.broadcast_to(locks, (rows, law.arm.n)),
        setting,
        None if wanted is None else np.broadcast_to(wanted, (rows, law.task.m)),
    )
    if single and shared and np.ndim(target) == (2 if wanted is None else 1):
        arrays = {name: value[0] for name, value in vars(runs).items() if isinstance(value, np.ndarray)}
        return replace(runs, **arrays)
    return runs


# ---- input -------------------------------------------------------------------------------------------------------


def _target(law: Law, target: ArrayLike) -> tuple[Array, Array | None]:
    """Targets as poses (M, 4, 4), and as the task's rows (M, m) where they were given so."""
    task, given = law.task, np.asarray(target, dtype=np.float64)
    if given.ndim in (2, 3) and given.shape[-2:] == (4, 4):
        return check_poses(given), None
    if task.angular or task.frame != "base":
        raise InputError(f"the target has shape {given.shape}; task '{task.name}' needs tool poses, (4, 4) or (N, 4, 4) arrays")
    if given.ndim not in (1, 2) or given.shape[-1] != task.m:
        raise InputError(
            f"the target has shape {given.shape}; task '{task.name}' takes ({task.m},) or (N, {task.m}), the wanted tool "
            "point in m, or tool poses (4, 4)"
        )
    rows = np.atleast_2d(given)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, 3] = rows @ task.rows[:, :3]
    return poses, rows


def _locks(law: Law, locked: Locked) -> tuple[Array, bool]:
    """When each joint locks (M, n), infinite for never; and whether that is the same for all runs."""
    arm = law.arm
    if isinstance(locked, np.ndarray):
        if locked.ndim == 2:
            return _lock_times(law, locked), False
        if locked.ndim != 1 or not np.issubdtype(locked.dtype, np.integer):
            raise InputError(
                f"locked has shape {locked.shape} and type {locked.dtype}; an array holds one joint index for each run, (N,) whole "
                f"numbers, -1 for none, or lock times, (N, {arm.n})"
            )
        wrong = np.flatnonzero((locked < -1) | (locked >= arm.n))
        if wrong.size:
            raise InputError(
                f"locked[{wrong[0]}] is {locked[wrong[0]]}; '{arm.name}' has joints 0 to {arm.n - 1}, and -1 stands for none"
            )
        times = np.full((len(locked), arm.n), np.inf)
        rows = np.flatnonzero(locked >= 0)
        times[rows, locked[rows]] = 0.0
        return times, False
    if isinstance(locked, (str, int)):
        raise InputError(f"locked is {locked!r}; give a list, for example [{locked!r}]")
    times = np.full((1, arm.n), np.inf)
    for item in locked:
        joint, time = item if isinstance(item, tuple) else (item, 0.0)
        k = arm.joint_index(joint)
        if not (np.isfinite(time) and time >= 0):
            raise InputError(f"joint '{arm.joint_names[k]}' locks at {time:g}; the time must be a finite number of 0 or more")
        if np.isfinite(times[0, k]):
            raise InputError(f"locked names joint '{arm.joint_names[k]}' twice; a joint locks once")
        times[0, k] = time
    return times, True


def _lock_times(law: Law, locked: NDArray[Any]) -> Array:
    arm = law.arm
    if locked.shape[1] != arm.n or not np.issubdtype(locked.dtype, np.number):
        raise InputError(
            f"locked has shape {locked.shape} and type {locked.dtype}; lock times are numbers (N, {arm.n}), one for each run and joint"
        )
    times = np.array(locked, dtype=np.float64)
    wrong = np.argwhere(~(times >= 0))
    if wrong.size:
        k, joint = wrong[0]
        raise InputError(
            f"locked[{k}, {joint}] is {times[k, joint]:g}; a lock time is 0 or more, and infinite for a joint that never locks"
        )
    return times


# ---- the motion --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Setting:
    """How runs were made.

    Attributes:
        limit: s, or cycles.
        accuracy: Tolerance of a step, or radius of the target in cycles.
        step: Of the fixed-step method, s.
    """

    limit: float
    accuracy: float
    step: float


Advance = Callable[[Array, Array], tuple[Array, NDArray[np.bool_]]]


class Motion:
    """The compiled motion of one law under one method."""

    def __init__(self, law: Law, method: str) -> None:
        self.law, self.cycles, self.fixed = law, method == "cycles", method == "rk4"
        self._system = System(law)
        self._steps: Steps | Cycles = (
            Cycles(self._system) if self.cycles else Steps(self._system, CLASSIC if self.fixed else DOP853)
        )
        s = self._system
        here = s.at(s.q)
        known = ca.vertcat(here.rates, here.hand, here.share, here.squared_error, here.slope)
        self._at = Kernel("start of a motion", [s.q, *s.given], [known])

    @cached_property
    def _nearest(self) -> Nearest:
        return Nearest(self._system)

    @cached_property
    def _hand(self) -> Kernel:
        """What the task prescribes of the tool point."""
        place = kinematics.chain(self.law.arm, self._system.q).position
        return Kernel("hand", [self._system.q], [ca.SX(ca.DM(self.law.task.rows[:, :3])) @ place])

    @cached_property
    def _single(self) -> Kernel:
        steps = self._steps
        symbol = ca.SX.sym("state", steps.state.size)
        return Kernel("one step", [symbol, *steps.parameters], [steps.single()(symbol, *steps.parameters)])

    def run(self, q0: Array, poses: Array, lock_time: Array, setting: Setting, wanted: Array | None) -> Runs:
        """Runs from q0 (N, n) to poses (N, 4, 4) with joints that lock at (N, n), s or cycles."""
        good = np.isfinite(q0).all(axis=1) & np.isfinite(poses).all(axis=(1, 2))
        chosen = slice(None) if good.all() else np.flatnonzero(good)
        ended = np.full((len(q0), self._steps.state.size), np.nan)

        def advance(states: Array, parameters: Array) -> tuple[Array, NDArray[np.bool_]]:
            result = self._steps.loop.run(states, parameters, 0.0, -(-MOST_STEPS // self._steps.unrolled))
            return result.state, result.done

        if good.any():
            ended[chosen] = self._phases(q0[chosen], poses[chosen], lock_time[chosen], setting, advance)
        parts = self._steps.state.values(ended)
        q = parts["q"].copy()
        error = np.sqrt(parts["error"][:, 0])
        code, reason = self._verdict(error, parts)
        code[~good], reason[~good] = Outcome.UNDECIDED, Reason.BAD_INPUT
        if wanted is None:
            hand = np.full(poses.shape, np.nan)
            hand[chosen] = self.law.arm.forward_kinematics(q[chosen])
        else:
            hand = self._hand.rows(q)
        return Runs(
            law=self.law,
            q0=q0,
            target=poses if wanted is None else wanted,
            lock_time=lock_time,
            cycles=self.cycles,
            code=code,
            reason=reason,
            q_final=q,
            x_final=hand,
            error=error,
            closest=np.sqrt(parts["closest"][:, 0]),
            path_length=parts["path"][:, 0].copy(),
            q_low=parts["low"].copy(),
            q_high=parts["high"].copy(),
            limits_passed=(parts["low"] < self.law.arm.lower) | (parts["high"] > self.law.arm.upper),
            time=parts["time"][:, 0] / self._unit,
            _motion=self,
            _setting=setting,
        )

    @property
    def _unit(self) -> float:
        """Units of time of a state in one second or cycle."""
        return 1.0 if self.cycles else self.law.gain

    def _verdict(self, error: Array, parts: dict[str, Array]) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        codes = parts["code"][:, 0]
        slowest, early, late = (parts[name][:, 0] for name in ("slowest", "early", "late"))
        moving = (codes == TIME) & (slowest > MOVES) & (early > 0) & (late >= DECAYS * early)
        converged = (codes == ARRIVED) | ((codes == REST) & (error < ARRIVES) & (not self.cycles))
        stuck = (codes == REST) & ~converged
        outcome = np.select([converged, stuck, moving], [Outcome.CONVERGED, Outcome.STUCK, Outcome.MOVING], Outcome.UNDECIDED)
        reason = np.select(
            [codes == COLLAPSE, codes == TIME, codes == RUNNING], [Reason.SINGULAR, Reason.SLOW, Reason.STEPS], 0
        )
        reason[outcome != Outcome.UNDECIDED] = Reason.NONE
        return outcome.astype(np.uint8), reason.astype(np.uint8)

    def _phases(self, q0: Array, poses: Array, lock_time: Array, setting: Setting, advance: Advance) -> Array:
        """States at the end. Between two locks nothing changes: such a phase is one loop."""
        rows, layout, unit, n = len(q0), self._steps.state, self._unit, self.law.arm.n
        states = np.zeros((rows, layout.size))
        parts = layout.values(states)
        parts["q"][:] = parts["low"][:] = parts["high"][:] = q0
        parts["slowest"][:] = parts["closest"][:] = FAR
        if not self.cycles:
            parts["h"][:] = setting.step * unit if self.fixed else FIRST
        target = self._system.numbers(poses)
        parameters = np.empty((rows, target.shape[1] + n + 3))
        parameters[:, : -n - 3], parameters[:, -2], parameters[:, -1] = target, setting.limit * unit, setting.accuracy
        mask, until, limit = parameters[:, -n - 3 : -3], parameters[:, -3], setting.limit * unit
        # Time and clock are the same where nothing slows the command: then the last step ends at the limit exactly.
        last = FAR if self.law.speed_limit is not None and not self.cycles else limit
        locks = lock_time * unit
        now, left = np.zeros(rows), np.arange(rows)
        while left.size:
            some: slice | NDArray[np.int64] = slice(None) if left.size == rows else left
            healthy = locks[some] > now[some, None]
            mask[some] = healthy
            until[some] = np.minimum(np.where(healthy, locks[some], np.inf).min(axis=1), last)
            self._enter(states, some, parameters[some])
            states[some], done = advance(states[some], parameters[some])
            codes, over = parts["code"][some, 0], until[some] >= limit
            parts["code"][some, 0] = np.where((codes == PHASE) & over, TIME, codes)
            left = left[done & (codes == PHASE) & ~over]
            now[left] = parts["time"][left, 0] = until[left]
        return states

    def _enter(self, states: Array, rows: slice | NDArray[np.int64], parameters: Array) -> None:
        """What is known where a phase begins."""
        parts, n = self._steps.state.values(states), self.law.arm.n
        known = self._at.rows(parts["q"][rows], *self._inputs(parameters)[:-3])
        good = np.isfinite(known).all(axis=1)
        code = np.where(good, RUNNING, COLLAPSE)
        known[~good] = np.where(np.isfinite(known[~good]), known[~good], 0.0)
        parts["error"][rows, 0] = known[:, n + 2]
        parts["closest"][rows, 0] = np.minimum(parts["closest"][rows, 0], known[:, n + 2])
        if not self.cycles:
            rate = np.linalg.norm(known[:, :n], axis=1)
            code[(rate < REST_SPEED * known[:, n + 1]) & good] = REST
            for name, at in (("hand", n), ("share", n + 1), ("slope", n + 3)):
                parts[name][rows, 0] = known[:, at]
            parts["rates"][rows] = known[:, :n]
            if not self.fixed:
                parts["h"][rows, 0] = np.minimum(parts["h"][rows, 0], TURN / np.maximum(rate, TURN))
        parts["code"][rows, 0] = code

    def _inputs(self, parameters: Array) -> list[Array]:
        """Parameters in rows as the inputs of a kernel."""
        shapes = [p.shape for p in self._steps.parameters]
        ends = np.cumsum([rows * columns for rows, columns in shapes])[:-1]
        blocks = np.split(parameters, ends, axis=1)
        return [b.reshape(-1, *shape) if shape[1] > 1 else b for b, shape in zip(blocks, shapes, strict=True)]

    # ---- on demand -----------------------------------------------------------------------------------------------

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> Array:
        """See :meth:`Runs.least_error`."""
        q, poses = np.atleast_2d(runs.q_final), self._poses(runs)
        mask = (np.atleast_2d(runs.lock_time) > np.atleast_1d(runs.time)[:, None]).astype(np.float64)
        good = np.isfinite(q).all(axis=1)
        least = np.full(len(q), np.nan)
        parameters = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9), mask], axis=1)
        least[good] = self._nearest.search(q[good], parameters[good], restarts, generator)
        return least

    def _poses(self, runs: Runs) -> Array:
        target = runs.target
        return check_poses(target) if target.shape[-2:] == (4, 4) else _target(self.law, target)[0]

    def path(self, runs: Runs, k: int, samples: int, until: float | None) -> Path:
        """See :meth:`Runs.path`."""
        end = float(np.atleast_1d(runs.time)[k])
        if until is not None:
            if not (np.isfinite(until) and until > 0):
                raise InputError(f"until is {until:g}; it must be a finite number above 0")
            end = min(end, float(until))
        noted: list[tuple[Array, Array]] = []

        def advance(states: Array, parameters: Array) -> tuple[Array, NDArray[np.bool_]]:
            parts = self._steps.state.values(states)
            for _ in range(MOST_STEPS):
                noted.append((states[0].copy(), parameters[0]))
                if parts["code"][0, 0] != RUNNING or parts["time"][0, 0] > end * self._unit:
                    break
                states = self._stepped(states, parameters)
                parts = self._steps.state.values(states)
            return states, np.array([parts["code"][0, 0] != RUNNING])

        lock_time = np.atleast_2d(runs.lock_time)[k : k + 1]
        self._phases(np.atleast_2d(runs.q0)[k : k + 1], self._poses(runs)[k : k + 1], lock_time, runs._setting, advance)
        states, parameters = (np.array(rows) for rows in zip(*noted, strict=True))
        parts, time = self._steps.state.values(states), np.linspace(0.0, end, samples)
        if self.cycles:
            when = parts["time"][:, 0] + parts["substep"][:, 0] / SUBSTEPS
            q = np.stack([np.interp(time, when, column) for column in parts["q"].T], axis=1)
        else:
            # From the step's beginning by a step of its own, as good as the integrator's; its accuracy is beyond doubt.
            here = np.searchsorted(parts["time"][:, 0], time * self._unit, side="right") - 1
            given = parameters[here]
            given[:, -3], given[:, -1] = time * self._unit, 1.0
            q = self._steps.state.values(self._stepped(states[here], given))["q"]
        pose = self._poses(runs)[k]
        error = self._nearest.errors(q, np.broadcast_to(pose, (samples, 4, 4)))
        return Path(time, q, self.law.arm.forward_kinematics(q)[:, :3, 3], error, time[:, None] >= lock_time)

    def _stepped(self, states: Array, parameters: Array) -> Array:
        """States after one step."""
        for _ in range(self._steps.calls):
            states = self._single.rows(states, *self._inputs(parameters))
        return states


@lru_cache(maxsize=16)
def _motion(law: Law, method: str) -> Motion:
    return Motion(law, method)
