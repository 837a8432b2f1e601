"""The compiled closed loop of one law, which simulates batches of runs and classifies their outcomes."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.control.laws.law import Law
from holdfast.control.simulation.cycles import SUBSTEPS_PER_CYCLE
from holdfast.control.simulation.periodic_motion import detect_periodic
from holdfast.control.simulation.phases import PhaseSimulator
from holdfast.control.simulation.residual import ErrorMinimiser
from holdfast.control.simulation.runge_kutta import RungeKuttaStepper
from holdfast.control.simulation.runs import Reason, RunOutcome, RunPath, Runs, RunSettings
from holdfast.control.simulation.system import (
    STATE_ARRIVED,
    STATE_AT_REST,
    STATE_COLLAPSED,
    STATE_RUNNING,
    STATE_TIME_LIMIT,
    scale_errors,
    split_error_norms,
)
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.progress import ProgressCount, ignore_count
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.compiled import expect_row_count
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Tell
from holdfast.kernels.threads import in_pool, shared_pool, thread_count
from holdfast.kinematics.solvers.inverse_kinematics import pose_error_for_task
from holdfast.model.arm import kinematics

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


class ClosedLoopSimulator:
    """The compiled closed loop of one law under one integration method."""

    def __init__(self, law: Law, method: str) -> None:
        self.law, self._phases = law, PhaseSimulator(law, method)
        self.cycles, self._system, self._stepper = self._phases.cycles, self._phases.system, self._phases.stepper
        self.made_of = law, method

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, which compiles its own
        return ClosedLoopSimulator, self.made_of

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
        error = pose_error_for_task(law.task, tool_chain.position, tool_chain.rotation, system.target, system.rotation)
        return Kernel("turn", [system.q, system.target, system.rotation], [ca.norm_2(error[3:])])

    def run(self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings) -> Runs:
        """Simulate runs from q0 (N, n) to target (N, 4, 4) or (N, m), with joints that lock at (N, n), s or cycles.

        A few thousand at a time, so that everything about them is done while they are in the cache, and by every thread.
        """
        run_count, workers = len(q0), 1 if in_pool() else thread_count()
        with expect_row_count(run_count * LOOP_CALLS_PER_RUN):
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
        parameters = self._phases.make_parameters(target, setting)
        is_finite = np.isfinite(q0).all(axis=1) & np.isfinite(target).all(axis=tuple(range(1, target.ndim)))
        finite_rows: slice | IndexArray = slice(None) if is_finite.all() else np.flatnonzero(is_finite)
        has_orientation, time_scale = target.ndim == 3 and self.law.task.angular, self._phases.time_scale
        # A run whose joints lock later ends at each lock, and goes on.
        locks_later = bool(((lock_time > 0) & np.isfinite(lock_time)).any())
        report_ended = ignore_count if locks_later else report

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, BoolArray]:
            if has_orientation and not self.cycles:
                return self._advance_until_trapped(states, parameters, report_ended)
            result = self._stepper.loop.run(
                states, parameters, 0.0, -(-MAX_STEPS // self._stepper.loop.times), report=report_ended
            )
            return result.state, result.done

        states = self._phases.run(q0[finite_rows], parameters[finite_rows], lock_time[finite_rows], setting, advance)
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
            self._stepper.parameters.view_parts(parameters)["mask"][rows] = lock_time[rows] * time_scale > parts["time"][rows]
            endless = rows[
                detect_periodic(self._stepper, states[rows], parameters[rows], ~self.law.arm.prismatic, MIN_ENDLESS_SPEED)
            ]
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

    def _is_half_turn_away(self, q: FloatArray, position: FloatArray, rotation: FloatArray) -> BoolArray:
        """Return (N,) True where the end effector is half a turn from its target, where the orientation error jumps."""
        return np.asarray(self._angle_kernel.rows(q, position, rotation)[:, 0] > np.pi - HALF_TURN_TOLERANCE_RAD)

    def _advance_until_trapped(
        self, states: FloatArray, parameters: FloatArray, report_ended: Tell
    ) -> tuple[FloatArray, BoolArray]:
        """Advance the states as the loop does, but give up running rows that are trapped half a turn from their target.

        Where the motion on either side of half a turn leads to it, steps across it shrink until next to nothing is left of
        them: a row is caught if it is half a turn away at the ends of a few stretches, one after the other, at whose pace it
        would not finish. Of 4,000 runs of a Panda half a turn caught 270; 4 of them would have got away later.
        """
        done, active, states = np.zeros(len(states), dtype=bool), np.arange(len(states)), states.copy()
        parts = self._stepper.layout.view_parts(states)
        # Looks one after the other that found the row half a turn away.
        half_turn_counts = np.zeros(len(states), dtype=np.int64)
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
            inputs, time = self._stepper.parameters.split_inputs(parameters[active]), parts["time"][active, 0]
            is_too_slow = time + checks_left * (time - earlier_times[is_running]) < np.minimum(
                inputs["until"][:, 0], inputs["limit"][:, 0]
            )
            is_half_turn = self._is_half_turn_away(parts["q"][active], inputs["target"], inputs["rotation"])
            half_turn_counts[active] = np.where(is_half_turn, np.where(is_too_slow, half_turn_counts[active], 0) + 1, 0)
            is_trapped = half_turn_counts[active] > HALF_TURN_CHECKS
            report_ended(int(np.count_nonzero(is_trapped)))
            active = active[~is_trapped]
        return states, done

    def _classify_endings(
        self, scaled_errors: FloatArray, parts: dict[str, FloatArray]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], BoolArray]:
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

    # ---- on demand -----------------------------------------------------------------------------------------------

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        """Find the least error (N,) that each arm can have, and a configuration (N, n) that has it; NaN for bad input."""
        q, poses = np.atleast_2d(runs.q_final), self._target_poses(runs)
        healthy_mask = (np.atleast_2d(runs.lock_time) > np.atleast_1d(runs.time)[:, None]).astype(np.float64)
        is_finite = np.isfinite(q).all(axis=1)
        least_errors, nearest = np.full(len(q), np.nan), np.full(q.shape, np.nan)
        least_errors[is_finite], nearest[is_finite] = self._error_search.search(
            q[is_finite], poses[is_finite], healthy_mask[is_finite], restarts, generator
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

    def compute_errors(self, runs: Runs, run: int | BoolArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Compute position errors (T,), m, and angle errors (T,), rad, of configurations (T, n) for the target of run k.

        Where k is a mask of runs, the configurations are one for each of them.
        """
        target = np.broadcast_to(self._target_poses(runs)[run], (len(q), 4, 4))
        return split_error_norms(
            self.law, self._error_search.compute_error_norms(q, target), self.law.arm.forward_kinematics(q), target
        )

    def replay_run(self, runs: Runs, run: int, end: float) -> tuple[FloatArray, Callable[[FloatArray], FloatArray]]:
        """Simulate run k again up to a time, s or cycles; return the times (S,) of its steps and its motion, (T,) -> (T, n)."""
        history: list[tuple[FloatArray, FloatArray]] = []
        time_scale = self._phases.time_scale

        def advance(states: FloatArray, parameters: FloatArray) -> tuple[FloatArray, BoolArray]:
            parts = self._stepper.layout.view_parts(states)
            for _ in range(MAX_STEPS):
                history.append((states[0].copy(), parameters[0].copy()))  # the next phase writes into both
                if parts["code"][0, 0] != STATE_RUNNING or parts["time"][0, 0] > end * time_scale:
                    break
                states = self._phases.advance_step(states, parameters)
                parts = self._stepper.layout.view_parts(states)
            return states, np.array([parts["code"][0, 0] != STATE_RUNNING])

        run_parameters = self._phases.make_parameters(self._target_poses(runs)[run][None], runs._settings)
        self._phases.run(
            np.atleast_2d(runs.q0)[run : run + 1], run_parameters, runs.held_from[run : run + 1], runs._settings, advance
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
            step_index = np.searchsorted(parts["time"][:, 0], time * time_scale, side="right") - 1
            step_parameters = parameters[step_index]
            parameter_parts = self._stepper.parameters.view_parts(step_parameters)
            parameter_parts["until"][:, 0], parameter_parts["accuracy"][:] = time * time_scale, 1.0
            return self._stepper.layout.view_parts(self._phases.advance_step(states[step_index], step_parameters))["q"]

        return parts["time"][:, 0] / time_scale, interpolate


@lru_cache(maxsize=16)
def compiled_simulator(law: Law, method: str) -> ClosedLoopSimulator:
    """Return the simulator of a law, compiled once."""
    return ClosedLoopSimulator(law, method)
