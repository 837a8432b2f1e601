"""The compiled closed loop of one law, which simulates batches of runs and classifies their outcomes."""

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
from holdfast.kernels.compiled import expect_rows
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Tell
from holdfast.kernels.recall import cached_kernel
from holdfast.kernels.threads import in_pool, shared_pool, thread_count
from holdfast.notice import ProgressCount, ignore_count
from holdfast.simulation.cycles import SUBSTEPS_PER_CYCLE, CycleStepper
from holdfast.simulation.endless_motion import detect_periodic
from holdfast.simulation.residual import ErrorMinimiser
from holdfast.simulation.runge_kutta import FIRST_STEP_SIZE, MAX_STEP_TRAVEL_RAD, REST_SPEED, RungeKuttaStepper
from holdfast.simulation.runs import Reason, RunOutcome, RunPath, Runs, RunSettings
from holdfast.simulation.system import (
    LARGE_NUMBER,
    STATE_ARRIVED,
    STATE_AT_REST,
    STATE_COLLAPSED,
    STATE_PHASE_END,
    STATE_RUNNING,
    STATE_TIME_LIMIT,
    FailedArmSystem,
    scale_errors,
    split_errors,
    to_state_parts,
)
from holdfast.simulation.tableaus import CLASSIC_RK4, DOP853
from holdfast.solvers.inverse_kinematics import tool_error
from holdfast.typing import FloatArray

CONVERGENCE_TOLERANCE = 1e-5  # rad, and lengths in units of the arm's own: an error below it at rest counts as 0
MIN_ENDLESS_SPEED = 1e-3  # rad (and m) per 1/Ke: an arm that is always faster is not stopping
DECAY_RATIO = 0.99  # of the greatest speed, from one tenth of the time to the next: slowing down
HALF_TURN_TOLERANCE_RAD = 1e-3  # rad: this near to half a turn the shortest turn has no lasting direction
MAX_STEPS = 100_000
HALF_TURN_CHECK_STEPS = 500  # steps between two looks at runs that half a turn may have caught
HALF_TURN_CHECKS = 4  # as many stretches decide
LOOP_CALLS_PER_RUN = 1500  # of the loop, for each run (measured of several arms, tasks and laws: 900 to 11,000, once 130)
MAX_BLOCK_RUNS = 8192  # runs that one thread makes together
MIN_BLOCK_RUNS = 256  # no result depends on it


Advance = Callable[[FloatArray, FloatArray], tuple[FloatArray, NDArray[np.bool_]]]


class ClosedLoopSimulator:
    """The compiled closed loop of one law under one integration method."""

    def __init__(self, law: Law, method: str) -> None:
        self.law, self.cycles, self.has_fixed_step = law, method == "cycles", method == "rk4"
        self._system = FailedArmSystem(law)
        self._stepper: RungeKuttaStepper | CycleStepper = (
            CycleStepper(self._system)
            if self.cycles
            else RungeKuttaStepper(self._system, CLASSIC_RK4 if self.has_fixed_step else DOP853)
        )
        self.made_of = law, method

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, which compiles its own
        return ClosedLoopSimulator, self.made_of

    @cached_property
    @cached_kernel
    def _start_kernel(self) -> Kernel:
        system = self._system
        return Kernel(
            "start of a motion", [system.q, *system.inputs], [ca.vertcat(*to_state_parts(system.evaluate(system.q)).values())]
        )

    @cached_property
    def _error_search(self) -> ErrorMinimiser:
        return ErrorMinimiser(self._system)

    @cached_property
    @cached_kernel
    def _tool_kernel(self) -> Kernel:
        """Kernel of the tool position in the directions that the task prescribes."""
        position = kinematics.kinematic_chain(self.law.arm, self._system.q).position
        return Kernel("hand", [self._system.q], [ca.SX(ca.DM(self.law.task.rows[:, :3])) @ position])

    @cached_property
    @cached_kernel
    def _angle_kernel(self) -> Kernel:
        """Kernel of the angle of the shortest rotation that the task prescribes, rad."""
        system, law = self._system, self.law
        tool_chain = kinematics.kinematic_chain(law.arm, system.q)
        error = tool_error(law.task, tool_chain.position, tool_chain.rotation, system.target, system.rotation)
        return Kernel("turn", [system.q, system.target, system.rotation], [ca.norm_2(error[3:])])

    def run(self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings) -> Runs:
        """Simulate runs from q0 (N, n) to target (N, 4, 4) or (N, m), with joints that lock at (N, n), s or cycles.

        A few thousand at a time, so that everything about them is done while they are in the cache, and by every thread.
        """
        run_count, workers = len(q0), 1 if in_pool() else thread_count()
        with expect_rows(run_count * LOOP_CALLS_PER_RUN):
            _ = self._stepper.loop  # the first time it is made here: the threads do not know how many runs there are
        runs_per_worker = -(-run_count // max(workers, 1))
        block_size = max(-(-runs_per_worker // max(-(-runs_per_worker // MAX_BLOCK_RUNS), 1)), MIN_BLOCK_RUNS)
        blocks = [slice(first, min(first + block_size, run_count)) for first in range(0, max(run_count, 1), block_size)]

        # The last runs of a block take longest: only of several blocks one after the other the pace is even.
        with ProgressCount("runs", run_count, whole=len(blocks) > 4 * workers) as progress:

            def run_rows(selection: slice) -> dict[str, NDArray[Any]]:
                return self._run_block(q0[selection], target[selection], lock_time[selection], setting, progress)

            block_results = (
                [run_rows(block_rows) for block_rows in blocks]
                if workers == 1 or len(blocks) == 1
                else list(shared_pool().map(run_rows, blocks))
            )
        fields: dict[str, Any] = (
            {name: np.concatenate([result[name] for result in block_results]) for name in block_results[0]}
            if block_results[1:]
            else block_results[0]
        )
        return Runs(
            law=self.law,
            q0=q0,
            target=target,
            lock_time=lock_time,
            cycles=self.cycles,
            **fields,
            _simulator=self,
            _settings=setting,
        )

    def _run_block(
        self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings, report: Tell
    ) -> dict[str, NDArray[Any]]:
        """Simulate one block of runs, and return the fields of :class:`Runs`."""
        target_values = self._system.target_values(target)
        is_finite = np.isfinite(q0).all(axis=1) & np.isfinite(target).all(axis=tuple(range(1, target.ndim)))
        finite_rows: slice | NDArray[np.int64] = slice(None) if is_finite.all() else np.flatnonzero(is_finite)
        has_orientation = target.ndim == 3 and self.law.task.angular
        # A run whose joints lock later ends at each lock, and goes on.
        locks_later = bool(((lock_time > 0) & np.isfinite(lock_time)).any())
        report_ended = ignore_count if locks_later else report

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
            if has_orientation and not self.cycles:
                return self._advance_until_trapped(states, parameters, report_ended)
            result = self._stepper.loop.run(
                states, parameters, 0.0, -(-MAX_STEPS // self._stepper.loop.times), report=report_ended
            )
            return result.state, result.done

        states = self._run_phases(q0[finite_rows], target_values[finite_rows], lock_time[finite_rows], setting, advance)
        if locks_later:
            report(len(q0))
        if not is_finite.all():
            states, finite_states = np.full((len(q0), states.shape[1]), np.nan), states
            states[finite_rows] = finite_states
        parts = self._stepper.layout.view_parts(states)
        q, lowest, highest = (parts[name].copy() for name in ("q", "low", "high"))
        error = np.sqrt(parts["error"][:, 0])
        if target.ndim == 2:
            tool = self._tool_kernel.rows(q)
        else:
            tool = np.full(target.shape, np.nan)
            tool[finite_rows] = self.law.arm.forward_kinematics(q[finite_rows])
        code, reason, may_be_endless = self._classify_endings(scale_errors(self.law, error, tool, target), parts)
        code[~is_finite], reason[~is_finite], may_be_endless[~is_finite] = RunOutcome.UNDECIDED, Reason.BAD_INPUT, False
        if has_orientation:
            # A tight tolerance shrinks the steps to nothing there, as a singular configuration does.
            rows = np.flatnonzero(np.isin(reason, (Reason.STEPS, Reason.SINGULAR)))
            reason[rows[self._is_half_turn_away(q[rows], target[rows, :3, 3], target[rows, :3, :3])]] = Reason.HALF_TURN
        if isinstance(self._stepper, RungeKuttaStepper):
            rows = np.flatnonzero((reason == Reason.STEPS) | may_be_endless)
            given = self._make_parameters(target_values[rows], setting)
            given[:, -self.law.arm.n - 3 : -3] = lock_time[rows] * self._time_scale > parts["time"][rows]
            endless = rows[detect_periodic(self._stepper, states[rows], given, ~self.law.arm.prismatic, MIN_ENDLESS_SPEED)]
            code[endless], reason[endless] = RunOutcome.MOVING, Reason.NONE
        return {
            "code": code,
            "reason": reason,
            "q_final": q,
            "x_final": tool,
            "error": error,
            "closest": np.sqrt(parts["closest"][:, 0]),
            "path_length": parts["path"][:, 0].copy(),
            "q_low": lowest,
            "q_high": highest,
            "limits_passed": (lowest < self.law.arm.lower) | (highest > self.law.arm.upper),
            "time": parts["time"][:, 0] / self._time_scale,
        }

    def _is_half_turn_away(self, q: FloatArray, position: FloatArray, rotation: FloatArray) -> NDArray[np.bool_]:
        """Return (N,) True where the end effector is half a turn from its target, where the orientation error jumps."""
        return np.asarray(self._angle_kernel.rows(q, position, rotation)[:, 0] > np.pi - HALF_TURN_TOLERANCE_RAD)

    def _advance_until_trapped(
        self, states: FloatArray, parameters: FloatArray, report_ended: Tell
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Advance the states as the loop does, but give up running rows that are trapped half a turn from their target.

        Where the motion on either side of half a turn leads to it, steps across it shrink until next to nothing is left of
        them: a row is caught if it is half a turn away at the ends of a few stretches, one after the other, at whose pace it
        would not finish. Of 4,000 runs of a Panda half a turn caught 270; 4 of them would have got away later.
        """
        done, active, states = np.zeros(len(states), dtype=bool), np.arange(len(states)), states.copy()
        parts = self._stepper.layout.view_parts(states)
        half_turn_counts = np.zeros(
            len(states), dtype=np.int64
        )  # looks one after the other that found the row half a turn away
        check_steps = HALF_TURN_CHECK_STEPS * self._stepper.calls_per_step
        for checks_left in reversed(range(MAX_STEPS // check_steps)):
            earlier_times = parts["time"][active, 0]
            result = self._stepper.loop.run(
                states[active], parameters[active], 0.0, -(-check_steps // self._stepper.loop.times), report=report_ended
            )
            states[active], done[active] = result.state, result.done
            is_running, active = ~result.done, active[~result.done]
            if not active.size:
                break
            active_parameters = parameters[active]
            time = parts["time"][active, 0]
            is_too_slow = time + checks_left * (time - earlier_times[is_running]) < np.minimum(
                active_parameters[:, -3], active_parameters[:, -2]
            )
            is_half_turn = self._is_half_turn_away(parts["q"][active], *self._split_parameters(active_parameters)[:2])
            half_turn_counts[active] = np.where(is_half_turn, np.where(is_too_slow, half_turn_counts[active], 0) + 1, 0)
            is_trapped = half_turn_counts[active] > HALF_TURN_CHECKS
            report_ended(int(np.count_nonzero(is_trapped)))
            active = active[~is_trapped]
        return states, done

    @property
    def _time_scale(self) -> float:
        """Units of time of a state in one second or cycle."""
        return 1.0 if self.cycles else self.law.gain

    def _classify_endings(
        self, scaled_errors: FloatArray, parts: dict[str, FloatArray]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.bool_]]:
        """Return outcomes and reasons, and the runs that are fast enough at the time limit to look for a limit cycle."""
        codes = parts["code"][:, 0]
        slowest, early_speed, late_speed = (parts[name][:, 0] for name in ("slowest", "early", "late"))
        may_be_endless = (
            (codes == STATE_TIME_LIMIT)
            & (slowest > MIN_ENDLESS_SPEED)
            & (early_speed > 0)
            & (late_speed >= DECAY_RATIO * early_speed)
        )
        converged = (codes == STATE_ARRIVED) | (
            (codes == STATE_AT_REST) & (scaled_errors < CONVERGENCE_TOLERANCE) & (not self.cycles)
        )
        stuck = (codes == STATE_AT_REST) & ~converged
        outcome = np.select([converged, stuck], [RunOutcome.CONVERGED, RunOutcome.STUCK], RunOutcome.UNDECIDED)
        reason = np.select(
            [codes == STATE_COLLAPSED, codes == STATE_TIME_LIMIT, codes == STATE_RUNNING],
            [Reason.SINGULAR, Reason.TIME_LIMIT, Reason.STEPS],
            0,
        )
        return outcome.astype(np.uint8), reason.astype(np.uint8), may_be_endless

    def _run_phases(
        self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings, advance: Advance
    ) -> FloatArray:
        """Return the states at the end of the runs. Nothing changes between two locks, so such a phase is one loop."""
        run_count, layout, time_scale, n = len(q0), self._stepper.layout, self._time_scale, self.law.arm.n
        states = np.zeros((run_count, layout.size))
        parts = layout.view_parts(states)
        parts["q"][:] = parts["low"][:] = parts["high"][:] = q0
        parts["slowest"][:] = parts["closest"][:] = LARGE_NUMBER
        if not self.cycles:
            parts["h"][:] = setting.step_size * time_scale if self.has_fixed_step else FIRST_STEP_SIZE
        parameters = self._make_parameters(target, setting)
        healthy_mask, phase_ends, clock_limit = parameters[:, -n - 3 : -3], parameters[:, -3], setting.time_limit * time_scale
        # Time and clock are the same where nothing slows the command: then the last step ends at the limit exactly.
        final_time = LARGE_NUMBER if self.law.speed_limit is not None and not self.cycles else clock_limit
        scaled_lock_times = lock_time * time_scale
        current_times, active = np.zeros(run_count), np.arange(run_count)
        while active.size:
            selection: slice | NDArray[np.int64] = slice(None) if active.size == run_count else active
            healthy = scaled_lock_times[selection] > current_times[selection, None]
            healthy_mask[selection] = healthy
            phase_ends[selection] = np.minimum(np.where(healthy, scaled_lock_times[selection], np.inf).min(axis=1), final_time)
            self._start_phase(states, selection, parameters[selection])
            states[selection], is_done = advance(states[selection], parameters[selection])
            codes, is_final = parts["code"][selection, 0], phase_ends[selection] >= clock_limit
            parts["code"][selection, 0] = np.where((codes == STATE_PHASE_END) & is_final, STATE_TIME_LIMIT, codes)
            active = active[is_done & (codes == STATE_PHASE_END) & ~is_final]
            current_times[active] = parts["time"][active, 0] = phase_ends[active]
        return states

    def _make_parameters(self, target: FloatArray, setting: RunSettings) -> FloatArray:
        """Return parameters of rows, in which the healthy joints and the end of the phase are still to be set."""
        parameters, n = np.empty((len(target), target.shape[1] + self.law.arm.n + 3)), self.law.arm.n
        parameters[:, : -n - 3], parameters[:, -2], parameters[:, -1] = (
            target,
            setting.time_limit * self._time_scale,
            setting.accuracy,
        )
        return parameters

    def _start_phase(self, states: FloatArray, rows: slice | NDArray[np.int64], parameters: FloatArray) -> None:
        """Set the parts of the states that are known where a phase begins."""
        parts, n = self._stepper.layout.view_parts(states), self.law.arm.n
        values = self._evaluate_states(states[rows], parameters)
        is_finite = np.isfinite(values).all(axis=1)
        code = np.where(is_finite, STATE_RUNNING, STATE_COLLAPSED)
        values[~is_finite] = np.where(np.isfinite(values[~is_finite]), values[~is_finite], 0.0)
        parts["error"][rows, 0] = values[:, n + 2]
        parts["closest"][rows, 0] = np.minimum(parts["closest"][rows, 0], values[:, n + 2])
        if not self.cycles:
            joint_speed = np.linalg.norm(values[:, :n], axis=1)
            code[(joint_speed < REST_SPEED * values[:, n + 1]) & is_finite] = STATE_AT_REST
            for name, column in (("hand", n), ("share", n + 1), ("slope", n + 3)):
                parts[name][rows, 0] = values[:, column]
            parts["rates"][rows] = values[:, :n]
            if not self.has_fixed_step:
                parts["h"][rows, 0] = np.minimum(
                    parts["h"][rows, 0], MAX_STEP_TRAVEL_RAD / np.maximum(joint_speed, MAX_STEP_TRAVEL_RAD)
                )
        parts["code"][rows, 0] = code

    def _evaluate_states(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return joint rates, tool speed, speed fraction, squared error, and its time derivative at the states, (N, n + 4)."""
        layout = self._stepper.layout
        if not self._stepper.is_staged:
            return self._start_kernel.rows(layout.view_parts(states)["q"], *self._split_parameters(parameters)[:-3])
        # A stage before the first: the law is not compiled a second time.
        entry_states = states.copy()
        parts = layout.view_parts(entry_states)
        parts["stage"][:], parts["code"][:], parts["rates"][:] = -1, STATE_RUNNING, 0.0
        entered_parts = layout.view_parts(self._call_step(entry_states, parameters))
        return np.concatenate([entered_parts[name] for name in ("rates", "hand", "share", "error", "slope")], axis=1)

    def _split_parameters(self, parameters: FloatArray) -> list[FloatArray]:
        """Split rows of parameters into the inputs of a kernel."""
        shapes = [parameter.shape for parameter in self._stepper.parameters]
        ends = np.cumsum([rows * columns for rows, columns in shapes])[:-1]
        blocks = np.split(parameters, ends, axis=1)
        return [block.reshape(-1, *shape) if shape[1] > 1 else block for block, shape in zip(blocks, shapes, strict=True)]

    # ---- on demand -----------------------------------------------------------------------------------------------

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        """Find the least error (N,) that each arm can have, and a configuration (N, n) that has it; NaN for bad input."""
        q, poses = np.atleast_2d(runs.q_final), self._target_poses(runs)
        healthy_mask = (np.atleast_2d(runs.lock_time) > np.atleast_1d(runs.time)[:, None]).astype(np.float64)
        is_finite = np.isfinite(q).all(axis=1)
        least_errors, nearest = np.full(len(q), np.nan), np.full(q.shape, np.nan)
        parameters = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9), healthy_mask], axis=1)
        least_errors[is_finite], nearest[is_finite] = self._error_search.search(
            q[is_finite], parameters[is_finite], restarts, generator
        )
        return least_errors, nearest

    def _target_poses(self, runs: Runs) -> FloatArray:
        """Return the target poses (N, 4, 4)."""
        if runs.target.shape[-2:] == (4, 4):
            return runs.target.reshape(-1, 4, 4)
        components = np.atleast_2d(runs.target)
        poses = np.tile(np.eye(4), (len(components), 1, 1))
        poses[:, :3, 3] = components @ self.law.task.rows[:, :3]
        return poses

    def path(self, runs: Runs, run: int, samples: int, until: float | None) -> RunPath:
        """Sample a run at equal times; see :meth:`Runs.path`."""
        end_time = float(np.atleast_1d(runs.time)[run])
        if until is not None:
            if not (np.isfinite(until) and until > 0):
                raise InputError(f"until is {until:g}; it must be a finite number above 0")
            end_time = min(end_time, float(until))
        return self.sample_path(runs, run, self.replay_run(runs, run, end_time)[1], np.linspace(0.0, end_time, samples))

    def sample_path(self, runs: Runs, run: int, motion: Callable[[FloatArray], FloatArray], time: FloatArray) -> RunPath:
        """Sample run k, as :meth:`replay_run` returned it, at times (T,)."""
        q = motion(time)
        position, angle = self.compute_errors(runs, run, q)
        locked = time[:, None] >= np.atleast_2d(runs.lock_time)[run]
        tool_points = self.law.arm.forward_kinematics(q)[:, :3, 3]
        return RunPath(
            time, q, tool_points, error=np.hypot(position, angle), position_error=position, angle_error=angle, locked=locked
        )

    def compute_errors(self, runs: Runs, run: int | NDArray[np.bool_], q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Compute position errors (T,), m, and angle errors (T,), rad, of configurations (T, n) for the target of run k.

        Where k is a mask of runs, the configurations are one for each of them.
        """
        target = np.broadcast_to(self._target_poses(runs)[run], (len(q), 4, 4))
        return split_errors(self.law, self._error_search.compute_errors(q, target), self.law.arm.forward_kinematics(q), target)

    def replay_run(self, runs: Runs, run: int, end: float) -> tuple[FloatArray, Callable[[FloatArray], FloatArray]]:
        """Simulate run k again up to a time, s or cycles; return the start times (S,) of its steps, and its motion: (T,) -> (T,
        n).
        """
        history: list[tuple[FloatArray, FloatArray]] = []

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
            parts = self._stepper.layout.view_parts(states)
            for _ in range(MAX_STEPS):
                history.append((states[0].copy(), parameters[0].copy()))  # the next phase writes into both
                if parts["code"][0, 0] != STATE_RUNNING or parts["time"][0, 0] > end * self._time_scale:
                    break
                states = self._advance_step(states, parameters)
                parts = self._stepper.layout.view_parts(states)
            return states, np.array([parts["code"][0, 0] != STATE_RUNNING])

        target_values = self._system.target_values(self._target_poses(runs)[run][None])
        self._run_phases(
            np.atleast_2d(runs.q0)[run : run + 1], target_values, runs.held_from[run : run + 1], runs._settings, advance
        )
        states, parameters = (np.array(values) for values in zip(*history, strict=True))
        parts = self._stepper.layout.view_parts(states)
        if self.cycles:
            substep_times = parts["time"][:, 0] + parts["substep"][:, 0] / SUBSTEPS_PER_CYCLE
            return substep_times, lambda time: np.stack(
                [np.interp(time, substep_times, column) for column in parts["q"].T], axis=1
            )

        def interpolate(time: FloatArray) -> FloatArray:
            # From the step's beginning by a step of its own, as good as the integrator's; its accuracy is beyond doubt.
            step_index = np.searchsorted(parts["time"][:, 0], time * self._time_scale, side="right") - 1
            step_parameters = parameters[step_index]
            step_parameters[:, -3], step_parameters[:, -1] = time * self._time_scale, 1.0
            return self._stepper.layout.view_parts(self._advance_step(states[step_index], step_parameters))["q"]

        return parts["time"][:, 0] / self._time_scale, interpolate

    def _advance_step(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return the states after one step."""
        for _ in range(self._stepper.calls_per_step):
            states = self._call_step(states, parameters)
        return states

    def _call_step(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return the states after one call of the step, with the compiled step of the loop where the loop takes
        single steps.
        """
        loop = self._stepper.loop
        single = loop.step if loop.times == 1 else self._stepper.single_step
        return single.rows(states, *self._split_parameters(parameters))[:, : self._stepper.layout.size]


@lru_cache(maxsize=16)
def compiled_simulator(law: Law, method: str) -> ClosedLoopSimulator:
    """Return the simulator of a law, compiled once."""
    return ClosedLoopSimulator(law, method)
