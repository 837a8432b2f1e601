"""Compiled closed loop of one law, which simulates batches of runs and classifies their outcomes."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.control.laws.law import Law
from holdfast.control.simulation.cycles import SUBSTEPS_PER_CYCLE, CycleStepper
from holdfast.control.simulation.half_turns import MAX_STEPS, HalfTurnTraps
from holdfast.control.simulation.periodic_motion import detect_periodic
from holdfast.control.simulation.residual import ErrorMinimiser
from holdfast.control.simulation.runge_kutta import FIRST_STEP_SIZE, MAX_STEP_TRAVEL_RAD, REST_SPEED, RungeKuttaStepper
from holdfast.control.simulation.runs import Reason, RunOutcome, RunPath, Runs, RunSettings
from holdfast.control.simulation.system import (
    LARGE_NUMBER,
    STATE_ARRIVED,
    STATE_AT_REST,
    STATE_COLLAPSED,
    STATE_PHASE_END,
    STATE_RUNNING,
    STATE_TIME_LIMIT,
    ColumnLayout,
    FailedArmSystem,
    configuration_state_parts,
    scale_errors,
    split_error_norms,
)
from holdfast.control.simulation.tableaus import CLASSIC_RK4, DOP853
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.progress import ProgressCount, ignore_count
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.compiled import expect_row_count
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Tell
from holdfast.kernels.threads import in_pool, shared_pool, thread_count
from holdfast.model.arm import kinematics

CONVERGENCE_TOLERANCE = 1e-5  # rad, and lengths in the arm's unit: a smaller error at rest counts as 0
MIN_ENDLESS_SPEED = 1e-3  # rad (and m) per 1/Ke: an arm that is always faster is not stopping
DECAY_RATIO = 0.99  # ratio of the greatest speeds in successive tenths of the time, below which an arm is slowing down
LOOP_CALLS_PER_RUN = 1500  # calls of the loop for each run (measured for several arms, tasks, laws: 900 to 11,000, once 130)
MAX_BLOCK_RUNS = 8192  # runs that one thread simulates together
MIN_BLOCK_RUNS = 256  # no result depends on it

Advance = Callable[[FloatArray, FloatArray], tuple[FloatArray, BoolArray]]


class ClosedLoopSimulator:
    """Compiled closed loop of one law under one integration method.

    A run is a sequence of phases. Nothing changes between two locks, so each phase is one loop over the states of all runs.

    Attributes:
        cycles: True for discrete control cycles.
    """

    def __init__(self, law: Law, method: str) -> None:
        self.law, self.made_of, self.cycles, self._has_fixed_step = law, (law, method), method == "cycles", method == "rk4"
        self._system = FailedArmSystem(law)
        self._stepper: RungeKuttaStepper | CycleStepper = (
            CycleStepper(self._system)
            if self.cycles
            else RungeKuttaStepper(self._system, CLASSIC_RK4 if self._has_fixed_step else DOP853)
        )
        self._time_scale = 1.0 if self.cycles else law.gain  # units of a state's time in one second or cycle
        self._half_turns = HalfTurnTraps(self._system, self._stepper)
        self._start_columns = ColumnLayout(rates=law.arm.n, hand=1, share=1, error=1, slope=1)

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, which compiles its own
        return ClosedLoopSimulator, self.made_of

    @cached_property
    def _error_search(self) -> ErrorMinimiser:
        return ErrorMinimiser(self._system)

    @cached_property
    @cached_kernel
    def _start_kernel(self) -> Kernel:
        """Kernel that computes the values at the start of a motion."""
        parts = self._start_columns.join_parts(configuration_state_parts(self._system.evaluate_state_rates(self._system.q)))
        return Kernel("start of a motion", [self._system.q, *self._system.inputs.values()], [parts])

    @cached_property
    @cached_kernel
    def _tool_kernel(self) -> Kernel:
        """Kernel that computes the tool position in the directions of the task."""
        position = kinematics.kinematic_chain(self.law.arm, self._system.q).position
        return Kernel("hand", [self._system.q], [ca.SX(ca.DM(self.law.task.rows[:, :3])) @ position])

    def run(self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings) -> Runs:
        """Simulate runs from q0 (N, n) to target (N, 4, 4) or (N, m) with joints that lock at times (N, n), s or cycles.

        Each thread simulates a few thousand runs at a time, so that their data stay in the processor's cache.
        """
        run_count, workers = len(q0), 1 if in_pool() else thread_count()
        with expect_row_count(run_count * LOOP_CALLS_PER_RUN):
            _ = self._stepper.loop  # compile here, because the threads do not have the number of runs
        runs_per_worker = -(-run_count // max(workers, 1))
        block_size = max(-(-runs_per_worker // max(-(-runs_per_worker // MAX_BLOCK_RUNS), 1)), MIN_BLOCK_RUNS)
        blocks = [slice(first, min(first + block_size, run_count)) for first in range(0, max(run_count, 1), block_size)]

        # The last runs of a block take longest, so the pace is even only over several consecutive blocks.
        with ProgressCount("runs", run_count, whole=len(blocks) > 4 * workers) as progress:

            def run_rows(selection: slice) -> dict[str, NDArray[Any]]:
                return self._run_block(q0[selection], target[selection], lock_time[selection], setting, progress)

            mapped = map if workers == 1 or len(blocks) == 1 else shared_pool().map
            block_results = list(mapped(run_rows, blocks))
        fields: dict[str, Any] = block_results[0]
        if block_results[1:]:
            fields = {name: np.concatenate([result[name] for result in block_results]) for name in fields}
        fields |= {"law": self.law, "q0": q0, "target": target, "lock_time": lock_time, "cycles": self.cycles}
        return Runs(**fields, _simulator=self, _settings=setting)

    def _run_block(
        self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings, report: Tell
    ) -> dict[str, NDArray[Any]]:
        """Simulate one block of runs, and return the fields of :class:`Runs`."""
        parameters = self._make_parameters(target, setting)
        is_finite = np.isfinite(q0).all(axis=1) & np.isfinite(target).all(axis=tuple(range(1, target.ndim)))
        finite_rows: slice | IndexArray = slice(None) if is_finite.all() else np.flatnonzero(is_finite)
        has_orientation, time_scale = target.ndim == 3 and self.law.task.angular, self._time_scale
        # The phase of a run whose joints lock later ends at each lock.
        locks_later = bool(((lock_time > 0) & np.isfinite(lock_time)).any())
        report_ended = ignore_count if locks_later else report

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, BoolArray]:
            if has_orientation and not self.cycles:
                return self._half_turns.advance(states, parameters, report_ended)
            loop = self._stepper.loop
            result = loop.run(states, parameters, 0.0, -(-MAX_STEPS // loop.times), report=report_ended)
            return result.state, result.done

        states = self._run_phases(q0[finite_rows], parameters[finite_rows], lock_time[finite_rows], setting, advance)
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
            # Half a turn from the target, a tight tolerance shrinks the steps to zero, as at a singular configuration.
            rows = np.flatnonzero(np.isin(reason, (Reason.STEPS, Reason.SINGULAR)))
            is_half_turn = self._half_turns.find_half_turns(q[rows], target[rows, :3, 3], target[rows, :3, :3])
            reason[rows[is_half_turn]] = Reason.HALF_TURN
        if isinstance(self._stepper, RungeKuttaStepper):
            rows = np.flatnonzero((reason == Reason.STEPS) | may_be_endless)
            self._stepper.parameters.view_parts(parameters)["mask"][rows] = lock_time[rows] * time_scale > parts["time"][rows]
            is_revolute, moving = ~self.law.arm.prismatic, (states[rows], parameters[rows])
            endless = rows[detect_periodic(self._stepper, *moving, is_revolute, MIN_ENDLESS_SPEED)]
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
            "time": parts["time"][:, 0] / time_scale,
        }

    def trace_steps(self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings) -> FloatArray:
        """Return configurations (T, N, n), the start and those after each fixed step; arguments as in :meth:`run`, finite."""
        trajectory = [q0]

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, BoolArray]:
            for _ in range(round(setting.time_limit / setting.step_size)):
                states = self._advance_step(states, parameters)
                trajectory.append(self._stepper.layout.view_parts(states)["q"])
            return states, np.ones(len(states), dtype=bool)

        self._run_phases(q0, self._make_parameters(target, setting), lock_time, setting, advance)
        return np.stack(trajectory)

    def _classify_endings(
        self, scaled_errors: FloatArray, parts: dict[str, FloatArray]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], BoolArray]:
        """Return outcomes, reasons, and the runs that are fast enough at the time limit to search for a limit cycle."""
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

    # ---- phases ------------------------------------------------------------------------------------------------------

    def _make_parameters(self, target: FloatArray, setting: RunSettings) -> FloatArray:
        """Return the parameters of runs to targets, poses (N, 4, 4) or task components (N, m).

        The mask of healthy joints and the end of the phase are not set yet.
        """
        return self._stepper.parameters.make_rows(
            len(target),
            **self._system.target_input_values(target),
            limit=setting.time_limit * self._time_scale,
            accuracy=setting.accuracy,
        )

    def _run_phases(
        self, q0: FloatArray, parameters: FloatArray, lock_time: FloatArray, setting: RunSettings, advance: Advance
    ) -> FloatArray:
        """Return the states at the end of runs from q0 (N, n) with joints that lock at (N, n), s or cycles.

        The parameters are those of :meth:`_make_parameters`; afterwards they contain the last phase of each run. The function
        ``advance`` returns the states at the end of a phase, and the flags of those that reached this end.
        """
        run_count, layout, time_scale = len(q0), self._stepper.layout, self._time_scale
        states = np.zeros((run_count, layout.size))
        parts = layout.view_parts(states)
        parts["q"][:] = parts["low"][:] = parts["high"][:] = q0
        parts["slowest"][:] = parts["closest"][:] = LARGE_NUMBER
        if not self.cycles:
            parts["h"][:] = setting.step_size * time_scale if self._has_fixed_step else FIRST_STEP_SIZE
        parameter_parts, clock_limit = self._stepper.parameters.view_parts(parameters), setting.time_limit * time_scale
        healthy_mask, phase_ends = parameter_parts["mask"], parameter_parts["until"][:, 0]
        # Without a speed limit, time and clock are equal, so the last step ends at the limit exactly.
        final_time = LARGE_NUMBER if self._system.law.speed_limit is not None and not self.cycles else clock_limit
        scaled_lock_times = lock_time * time_scale
        current_times, active = np.zeros(run_count), np.arange(run_count)
        while active.size:
            selection: slice | IndexArray = slice(None) if active.size == run_count else active
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

    def _start_phase(self, states: FloatArray, rows: slice | IndexArray, parameters: FloatArray) -> None:
        """Set the parts of the states that are known at the beginning of a phase."""
        parts = self._stepper.layout.view_parts(states)
        values = self._evaluate_states(states[rows], parameters)
        is_finite = np.isfinite(values).all(axis=1)
        code = np.where(is_finite, STATE_RUNNING, STATE_COLLAPSED)
        values[~is_finite] = np.where(np.isfinite(values[~is_finite]), values[~is_finite], 0.0)
        start_parts = self._start_columns.view_parts(values)
        parts["error"][rows] = start_parts["error"]
        parts["closest"][rows] = np.minimum(parts["closest"][rows], start_parts["error"])
        if not self.cycles:
            joint_speed = np.linalg.norm(start_parts["rates"], axis=1)
            code[(joint_speed < REST_SPEED * start_parts["share"][:, 0]) & is_finite] = STATE_AT_REST
            for name in ("rates", "hand", "share", "slope"):
                parts[name][rows] = start_parts[name]
            if not self._has_fixed_step:
                parts["h"][rows, 0] = np.minimum(
                    parts["h"][rows, 0], MAX_STEP_TRAVEL_RAD / np.maximum(joint_speed, MAX_STEP_TRAVEL_RAD)
                )
        parts["code"][rows, 0] = code

    def _evaluate_states(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return joint rates, tool speed, speed fraction, squared error, and its time derivative at the states, (N, n + 4)."""
        layout = self._stepper.layout
        if not self._stepper.is_staged:
            inputs = self._stepper.parameters.split_inputs(parameters)
            return self._start_kernel.rows(layout.view_parts(states)["q"], *[inputs[name] for name in self._system.inputs])
        # A stage before the first one avoids compiling the law a second time.
        entry_states = states.copy()
        parts = layout.view_parts(entry_states)
        parts["stage"][:], parts["code"][:], parts["rates"][:] = -1, STATE_RUNNING, 0.0
        entered_parts = layout.view_parts(self._call_step(entry_states, parameters))
        return np.concatenate([entered_parts[name] for name in self._start_columns.slices], axis=1)

    def _advance_step(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return the states after one step."""
        for _ in range(self._stepper.calls_per_step):
            states = self._call_step(states, parameters)
        return states

    def _call_step(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        loop = self._stepper.loop
        # A loop of single steps already has a compiled step.
        single = loop.step if loop.times == 1 else self._stepper.single_step
        return single.rows(states, *self._stepper.parameters.split_inputs(parameters).values())[:, : self._stepper.layout.size]

    # ---- on demand -----------------------------------------------------------------------------------------------

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        """Find the least error (N,) that each arm can have, and a configuration (N, n) with this error; NaN for bad input."""
        q, poses = np.atleast_2d(runs.q_final), self._target_poses(runs)
        healthy_mask = (np.atleast_2d(runs.lock_time) > np.atleast_1d(runs.time)[:, None]).astype(np.float64)
        rows = np.isfinite(q).all(axis=1)
        least_errors, nearest = np.full(len(q), np.nan), np.full(q.shape, np.nan)
        found = self._error_search.search(q[rows], poses[rows], healthy_mask[rows], restarts, generator)
        least_errors[rows], nearest[rows] = found
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
        errors = {"error": np.hypot(position, angle), "position_error": position, "angle_error": angle}
        locked = time[:, None] >= np.atleast_2d(runs.lock_time)[run]
        return RunPath(time, q, self.law.arm.forward_kinematics(q)[:, :3, 3], **errors, locked=locked)

    def compute_errors(self, runs: Runs, run: int | BoolArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Compute position errors (T,), m, and angle errors (T,), rad, of configurations (T, n) for the target of run k.

        If k is a mask of runs, there is one configuration for each of them.
        """
        target = np.broadcast_to(self._target_poses(runs)[run], (len(q), 4, 4))
        norms = self._error_search.compute_error_norms(q, target)
        return split_error_norms(self.law, norms, self.law.arm.forward_kinematics(q), target)

    def replay_run(self, runs: Runs, run: int, end: float) -> tuple[FloatArray, Callable[[FloatArray], FloatArray]]:
        """Simulate run k again up to a time, s or cycles; return the times (S,) of its steps and its motion, (T,) -> (T, n)."""
        history: list[tuple[FloatArray, FloatArray]] = []

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, BoolArray]:
            parts = self._stepper.layout.view_parts(states)
            for _ in range(MAX_STEPS):
                history.append((states[0].copy(), parameters[0].copy()))  # the next phase writes into both
                if parts["code"][0, 0] != STATE_RUNNING or parts["time"][0, 0] > end * self._time_scale:
                    break
                states = self._advance_step(states, parameters)
                parts = self._stepper.layout.view_parts(states)
            return states, np.array([parts["code"][0, 0] != STATE_RUNNING])

        rows, run_parameters = [run], self._make_parameters(self._target_poses(runs)[run][None], runs._settings)
        self._run_phases(np.atleast_2d(runs.q0)[rows], run_parameters, runs.held_from[rows], runs._settings, advance)
        states, parameters = (np.array(values) for values in zip(*history, strict=True))
        parts, time_scale = self._stepper.layout.view_parts(states), self._time_scale
        if self.cycles:
            times, columns = parts["time"][:, 0] + parts["substep"][:, 0] / SUBSTEPS_PER_CYCLE, parts["q"].T
            return times, lambda time: np.stack([np.interp(time, times, column) for column in columns], axis=1)

        def interpolate(time: FloatArray) -> FloatArray:
            # A shorter step from the step's beginning is as accurate as the integrator's step; at a kink it may take several.
            step_index = np.searchsorted(parts["time"][:, 0], time * time_scale, side="right") - 1
            layout, samples, step_parameters = self._stepper.layout, states[step_index], parameters[step_index]
            self._stepper.parameters.view_parts(step_parameters)["until"][:, 0] = time * time_scale
            while (layout.view_parts(samples)["code"] == STATE_RUNNING).any():
                samples = self._advance_step(samples, step_parameters)
            return layout.view_parts(samples)["q"]

        return parts["time"][:, 0] / time_scale, interpolate


@lru_cache(maxsize=16)
def compiled_simulator(law: Law, method: str) -> ClosedLoopSimulator:
    """Return the simulator of a law, which is compiled once and cached."""
    return ClosedLoopSimulator(law, method)
