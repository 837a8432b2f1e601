"""The compiled motion of one law: batches of runs and how they ended."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.errors import InputError
from holdfast.kernels.compiled import expecting
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Tell
from holdfast.kernels.recall import recalled
from holdfast.kernels.threads import in_pool, pool, thread_count
from holdfast.notice import Count, unheard
from holdfast.simulation.cycles import SUBSTEPS, Cycles
from holdfast.simulation.endless_motion import find_endless
from holdfast.simulation.residual import Nearest
from holdfast.simulation.runge_kutta import FIRST, REST_SPEED, TURN, Steps
from holdfast.simulation.runs import Outcome, Path, Reason, Runs, Setting
from holdfast.simulation.system import (
    ARRIVED,
    COLLAPSE,
    FAR,
    PHASE,
    REST,
    RUNNING,
    TIME,
    System,
    known_at,
    own_units,
    split_errors,
)
from holdfast.simulation.tableaus import CLASSIC, DOP853
from holdfast.solvers.inverse_kinematics import tool_error

Array = NDArray[np.float64]

ARRIVES = 1e-5  # rad, and lengths in units of the arm's own: an error below it at rest counts as 0
MOVES = 1e-3  # rad (and m) per 1/Ke: an arm that is always faster is not stopping
DECAYS = 0.99  # of the greatest speed, from one tenth of the time to the next: slowing down
FLIPS = 1e-3  # rad: this near to half a turn the shortest turn has no lasting direction
MOST_STEPS = 100_000
LOOK, LOOKS = 500, 4  # steps between two looks at runs that half a turn may have caught; as many stretches decide
CALLS = 1500  # of the loop, for each run (measured of several arms, tasks and laws: 900 to 11,000, once 130)
BLOCK, LEAST_BLOCK = 8192, 256  # runs that one thread makes together; no result depends on it


Advance = Callable[[Array, Array], tuple[Array, NDArray[np.bool_]]]


class Motion:
    """The compiled motion of one law under one method."""

    def __init__(self, law: Law, method: str) -> None:
        self.law, self.cycles, self.fixed = law, method == "cycles", method == "rk4"
        self._system = System(law)
        self._steps: Steps | Cycles = (
            Cycles(self._system) if self.cycles else Steps(self._system, CLASSIC if self.fixed else DOP853)
        )
        self.made_of = law, method

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, which compiles its own
        return Motion, self.made_of

    @cached_property
    @recalled
    def _at(self) -> Kernel:
        s = self._system
        return Kernel("start of a motion", [s.q, *s.given], [ca.vertcat(*known_at(s.at(s.q)).values())])

    @cached_property
    def _nearest(self) -> Nearest:
        return Nearest(self._system)

    @cached_property
    @recalled
    def _hand(self) -> Kernel:
        """What the task prescribes of the tool point."""
        place = kinematics.chain(self.law.arm, self._system.q).position
        return Kernel("hand", [self._system.q], [ca.SX(ca.DM(self.law.task.rows[:, :3])) @ place])

    @cached_property
    @recalled
    def _turn(self) -> Kernel:
        """The angle of the shortest turn that the task asks for, rad."""
        s, law = self._system, self.law
        chain = kinematics.chain(law.arm, s.q)
        error = tool_error(law.task, chain.position, chain.rotation, s.target, s.rotation)
        return Kernel("turn", [s.q, s.target, s.rotation], [ca.norm_2(error[3:])])

    def run(self, q0: Array, target: Array, lock_time: Array, setting: Setting) -> Runs:
        """Runs from q0 (N, n) to target (N, 4, 4) or (N, m), with joints that lock at (N, n), s or cycles.

        A few thousand at a time, so that everything about them is done while they are in the cache, and by every thread.
        """
        rows, workers = len(q0), 1 if in_pool() else thread_count()
        with expecting(rows * CALLS):
            _ = self._steps.loop  # the first time it is made here: the threads do not know how many runs there are
        each = -(-rows // max(workers, 1))
        block = max(-(-each // max(-(-each // BLOCK), 1)), LEAST_BLOCK)
        blocks = [slice(k, min(k + block, rows)) for k in range(0, max(rows, 1), block)]

        # The last runs of a block take longest: only of several blocks one after the other the pace is even.
        with Count("runs", rows, whole=len(blocks) > 4 * workers) as over:

            def work(some: slice) -> dict[str, NDArray[Any]]:
                return self._block(q0[some], target[some], lock_time[some], setting, over)

            done = [work(b) for b in blocks] if workers == 1 or len(blocks) == 1 else list(pool().map(work, blocks))
        ends: dict[str, Any] = {name: np.concatenate([d[name] for d in done]) for name in done[0]} if done[1:] else done[0]
        return Runs(
            law=self.law, q0=q0, target=target, lock_time=lock_time, cycles=self.cycles, **ends, _motion=self, _setting=setting
        )

    def _block(self, q0: Array, target: Array, lock_time: Array, setting: Setting, tell: Tell) -> dict[str, NDArray[Any]]:
        """Fields of :class:`Runs`."""
        numbers = self._system.numbers(target)
        good = np.isfinite(q0).all(axis=1) & np.isfinite(target).all(axis=tuple(range(1, target.ndim)))
        chosen: slice | NDArray[np.int64] = slice(None) if good.all() else np.flatnonzero(good)
        flips = target.ndim == 3 and self.law.task.angular
        # A run whose joints lock later ends at each lock, and goes on.
        later = bool(((lock_time > 0) & np.isfinite(lock_time)).any())
        over = unheard if later else tell

        def advance(states: Array, parameters: Array) -> tuple[Array, NDArray[np.bool_]]:
            if flips and not self.cycles:
                return self._until_caught(states, parameters, over)
            result = self._steps.loop.run(states, parameters, 0.0, -(-MOST_STEPS // self._steps.loop.times), over=over)
            return result.state, result.done

        states = self._phases(q0[chosen], numbers[chosen], lock_time[chosen], setting, advance)
        if later:
            tell(len(q0))
        if not good.all():
            states, known = np.full((len(q0), states.shape[1]), np.nan), states
            states[chosen] = known
        parts = self._steps.state.values(states)
        q, low, high = (parts[name].copy() for name in ("q", "low", "high"))
        error = np.sqrt(parts["error"][:, 0])
        if target.ndim == 2:
            hand = self._hand.rows(q)
        else:
            hand = np.full(target.shape, np.nan)
            hand[chosen] = self.law.arm.forward_kinematics(q[chosen])
        code, reason, lively = self._verdict(own_units(self.law, error, hand, target), parts)
        code[~good], reason[~good], lively[~good] = Outcome.UNDECIDED, Reason.BAD_INPUT, False
        if flips:
            # A tight tolerance shrinks the steps to nothing there, as a singular configuration does.
            rows = np.flatnonzero(np.isin(reason, (Reason.STEPS, Reason.SINGULAR)))
            reason[rows[self._half_turn(q[rows], target[rows, :3, 3], target[rows, :3, :3])]] = Reason.HALF_TURN
        if isinstance(self._steps, Steps):
            rows = np.flatnonzero((reason == Reason.STEPS) | lively)
            given = self._parameters(numbers[rows], setting)
            given[:, -self.law.arm.n - 3 : -3] = lock_time[rows] * self._unit > parts["time"][rows]
            endless = rows[find_endless(self._steps, states[rows], given, ~self.law.arm.prismatic, MOVES)]
            code[endless], reason[endless] = Outcome.MOVING, Reason.NONE
        return {
            "code": code,
            "reason": reason,
            "q_final": q,
            "x_final": hand,
            "error": error,
            "closest": np.sqrt(parts["closest"][:, 0]),
            "path_length": parts["path"][:, 0].copy(),
            "q_low": low,
            "q_high": high,
            "limits_passed": (low < self.law.arm.lower) | (high > self.law.arm.upper),
            "time": parts["time"][:, 0] / self._unit,
        }

    def _half_turn(self, q: Array, place: Array, rotation: Array) -> NDArray[np.bool_]:
        """(N,) True where the end effector is half a turn from its target: there the orientation's error jumps."""
        return np.asarray(self._turn.rows(q, place, rotation)[:, 0] > np.pi - FLIPS)

    def _until_caught(self, states: Array, parameters: Array, over: Tell) -> tuple[Array, NDArray[np.bool_]]:
        """As the loop itself, but rows that half a turn has caught are given up while they still run.

        Where the motion on either side of half a turn leads to it, steps across it shrink until next to nothing is left of
        them: a row is caught if it is half a turn away at the ends of a few stretches, one after the other, at whose pace it
        would not finish. Of 4,000 runs of a Panda half a turn caught 270; 4 of them would have got away later.
        """
        done, left, states = np.zeros(len(states), dtype=bool), np.arange(len(states)), states.copy()
        parts = self._steps.state.values(states)
        seen = np.zeros(len(states), dtype=np.int64)  # looks one after the other that found the row half a turn away
        span = LOOK * self._steps.calls
        for looks_left in reversed(range(MOST_STEPS // span)):
            before = parts["time"][left, 0]
            result = self._steps.loop.run(states[left], parameters[left], 0.0, -(-span // self._steps.loop.times), over=over)
            states[left], done[left] = result.state, result.done
            on, left = ~result.done, left[~result.done]
            if not left.size:
                break
            given = parameters[left]
            time = parts["time"][left, 0]
            hopeless = time + looks_left * (time - before[on]) < np.minimum(given[:, -3], given[:, -2])
            turned = self._half_turn(parts["q"][left], *self._inputs(given)[:2])
            seen[left] = np.where(turned, np.where(hopeless, seen[left], 0) + 1, 0)
            caught = seen[left] > LOOKS
            over(int(np.count_nonzero(caught)))
            left = left[~caught]
        return states, done

    @property
    def _unit(self) -> float:
        """Units of time of a state in one second or cycle."""
        return 1.0 if self.cycles else self.law.gain

    def _verdict(
        self, scaled: Array, parts: dict[str, Array]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.bool_]]:
        """Outcomes and reasons, and which runs are fast enough at the time limit to look for a limit cycle."""
        codes = parts["code"][:, 0]
        slowest, early, late = (parts[name][:, 0] for name in ("slowest", "early", "late"))
        lively = (codes == TIME) & (slowest > MOVES) & (early > 0) & (late >= DECAYS * early)
        converged = (codes == ARRIVED) | ((codes == REST) & (scaled < ARRIVES) & (not self.cycles))
        stuck = (codes == REST) & ~converged
        outcome = np.select([converged, stuck], [Outcome.CONVERGED, Outcome.STUCK], Outcome.UNDECIDED)
        reason = np.select(
            [codes == COLLAPSE, codes == TIME, codes == RUNNING], [Reason.SINGULAR, Reason.TIME_LIMIT, Reason.STEPS], 0
        )
        return outcome.astype(np.uint8), reason.astype(np.uint8), lively

    def _phases(self, q0: Array, target: Array, lock_time: Array, setting: Setting, advance: Advance) -> Array:
        """States at the end. Between two locks nothing changes: such a phase is one loop."""
        rows, layout, unit, n = len(q0), self._steps.state, self._unit, self.law.arm.n
        states = np.zeros((rows, layout.size))
        parts = layout.values(states)
        parts["q"][:] = parts["low"][:] = parts["high"][:] = q0
        parts["slowest"][:] = parts["closest"][:] = FAR
        if not self.cycles:
            parts["h"][:] = setting.step * unit if self.fixed else FIRST
        parameters = self._parameters(target, setting)
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

    def _parameters(self, target: Array, setting: Setting) -> Array:
        """Parameters of rows; which joints are healthy, and until when, is to be filled in."""
        parameters, n = np.empty((len(target), target.shape[1] + self.law.arm.n + 3)), self.law.arm.n
        parameters[:, : -n - 3], parameters[:, -2], parameters[:, -1] = target, setting.limit * self._unit, setting.accuracy
        return parameters

    def _enter(self, states: Array, rows: slice | NDArray[np.int64], parameters: Array) -> None:
        """What is known where a phase begins."""
        parts, n = self._steps.state.values(states), self.law.arm.n
        known = self._known(states[rows], parameters)
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

    def _known(self, states: Array, parameters: Array) -> Array:
        """Rates, speed of the end effector, share, squared error and its slope where these states are, (N, n + 4)."""
        layout = self._steps.state
        if not self._steps.staged:
            return self._at.rows(layout.values(states)["q"], *self._inputs(parameters)[:-3])
        # A stage before the first: the law is not compiled a second time.
        before = states.copy()
        parts = layout.values(before)
        parts["stage"][:], parts["code"][:], parts["rates"][:] = -1, RUNNING, 0.0
        after = layout.values(self._once(before, parameters))
        return np.concatenate([after[name] for name in ("rates", "hand", "share", "error", "slope")], axis=1)

    def _inputs(self, parameters: Array) -> list[Array]:
        """Parameters in rows as the inputs of a kernel."""
        shapes = [p.shape for p in self._steps.parameters]
        ends = np.cumsum([rows * columns for rows, columns in shapes])[:-1]
        blocks = np.split(parameters, ends, axis=1)
        return [b.reshape(-1, *shape) if shape[1] > 1 else b for b, shape in zip(blocks, shapes, strict=True)]

    # ---- on demand -----------------------------------------------------------------------------------------------

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> tuple[Array, Array]:
        """Find the least error (N,) that each arm can have, and a configuration (N, n) that has it; NaN for bad input."""
        q, poses = np.atleast_2d(runs.q_final), self._poses(runs)
        mask = (np.atleast_2d(runs.lock_time) > np.atleast_1d(runs.time)[:, None]).astype(np.float64)
        good = np.isfinite(q).all(axis=1)
        least, nearest = np.full(len(q), np.nan), np.full(q.shape, np.nan)
        parameters = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9), mask], axis=1)
        least[good], nearest[good] = self._nearest.search(q[good], parameters[good], restarts, generator)
        return least, nearest

    def _poses(self, runs: Runs) -> Array:
        """Targets (N, 4, 4)."""
        if runs.target.shape[-2:] == (4, 4):
            return runs.target.reshape(-1, 4, 4)
        rows = np.atleast_2d(runs.target)
        poses = np.tile(np.eye(4), (len(rows), 1, 1))
        poses[:, :3, 3] = rows @ self.law.task.rows[:, :3]
        return poses

    def path(self, runs: Runs, k: int, samples: int, until: float | None) -> Path:
        """See :meth:`Runs.path`."""
        end = float(np.atleast_1d(runs.time)[k])
        if until is not None:
            if not (np.isfinite(until) and until > 0):
                raise InputError(f"until is {until:g}; it must be a finite number above 0")
            end = min(end, float(until))
        return self.sample_path(runs, k, self.recorded(runs, k, end)[1], np.linspace(0.0, end, samples))

    def sample_path(self, runs: Runs, k: int, at: Callable[[Array], Array], time: Array) -> Path:
        """Sample run k, as the run was replayed, at times (T,)."""
        q = at(time)
        position, angle = self.errors(runs, k, q)
        locked = time[:, None] >= np.atleast_2d(runs.lock_time)[k]
        tool = self.law.arm.forward_kinematics(q)[:, :3, 3]
        return Path(time, q, tool, error=np.hypot(position, angle), position_error=position, angle_error=angle, locked=locked)

    def errors(self, runs: Runs, k: int | NDArray[np.bool_], q: Array) -> tuple[Array, Array]:
        """Compute position errors (T,), m, and angle errors (T,), rad, of configurations (T, n) for the target of run k.

        Where k is a mask of runs, the configurations are one for each of them.
        """
        target = np.broadcast_to(self._poses(runs)[k], (len(q), 4, 4))
        return split_errors(self.law, self._nearest.errors(q, target), self.law.arm.forward_kinematics(q), target)

    def recorded(self, runs: Runs, k: int, end: float) -> tuple[Array, Callable[[Array], Array]]:
        """Run k again up to a time, s or cycles: when its steps began (S,), and the motion (T, n) at any times (T,)."""
        noted: list[tuple[Array, Array]] = []

        def advance(states: Array, parameters: Array) -> tuple[Array, NDArray[np.bool_]]:
            parts = self._steps.state.values(states)
            for _ in range(MOST_STEPS):
                noted.append((states[0].copy(), parameters[0].copy()))  # the next phase writes into both
                if parts["code"][0, 0] != RUNNING or parts["time"][0, 0] > end * self._unit:
                    break
                states = self._stepped(states, parameters)
                parts = self._steps.state.values(states)
            return states, np.array([parts["code"][0, 0] != RUNNING])

        numbers = self._system.numbers(self._poses(runs)[k][None])
        self._phases(np.atleast_2d(runs.q0)[k : k + 1], numbers, runs.held_from[k : k + 1], runs._setting, advance)
        states, parameters = (np.array(rows) for rows in zip(*noted, strict=True))
        parts = self._steps.state.values(states)
        if self.cycles:
            when = parts["time"][:, 0] + parts["substep"][:, 0] / SUBSTEPS
            return when, lambda time: np.stack([np.interp(time, when, column) for column in parts["q"].T], axis=1)

        def at(time: Array) -> Array:
            # From the step's beginning by a step of its own, as good as the integrator's; its accuracy is beyond doubt.
            here = np.searchsorted(parts["time"][:, 0], time * self._unit, side="right") - 1
            given = parameters[here]
            given[:, -3], given[:, -1] = time * self._unit, 1.0
            return self._steps.state.values(self._stepped(states[here], given))["q"]

        return parts["time"][:, 0] / self._unit, at

    def _stepped(self, states: Array, parameters: Array) -> Array:
        """States after one step."""
        for _ in range(self._steps.calls):
            states = self._once(states, parameters)
        return states

    def _once(self, states: Array, parameters: Array) -> Array:
        """States after one call of the step: that of the loop, which is compiled already, where it takes one at a time."""
        loop = self._steps.loop
        single = loop.step if loop.times == 1 else self._steps.single
        return single.rows(states, *self._inputs(parameters))[:, : self._steps.state.size]


@lru_cache(maxsize=16)
def motion_of(law: Law, method: str) -> Motion:
    """The motion of a law, compiled once."""
    return Motion(law, method)
