"""The phases of runs: nothing changes between two locks, so that each phase is one loop over the states of all runs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.cycles import CycleStepper
from holdfast.control.simulation.runge_kutta import FIRST_STEP_SIZE, MAX_STEP_TRAVEL_RAD, REST_SPEED, RungeKuttaStepper
from holdfast.control.simulation.runs import RunSettings
from holdfast.control.simulation.system import (
    LARGE_NUMBER,
    STATE_AT_REST,
    STATE_COLLAPSED,
    STATE_PHASE_END,
    STATE_RUNNING,
    STATE_TIME_LIMIT,
    ColumnLayout,
    FailedArmSystem,
    configuration_state_parts,
)
from holdfast.control.simulation.tableaus import CLASSIC_RK4, DOP853
from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel

Advance = Callable[[FloatArray, FloatArray], tuple[FloatArray, BoolArray]]


class PhaseSimulator:
    """The steps of one law under one integration method, applied to the states and parameters of runs.

    Attributes:
        system: The differential equation.
        stepper: The compiled steps, with the layouts of their states and parameters.
        cycles: True for discrete control cycles.
        time_scale: Units of time of a state in one second or cycle.
    """

    def __init__(self, law: Law, method: str) -> None:
        self.cycles, self._has_fixed_step = method == "cycles", method == "rk4"
        self.system = FailedArmSystem(law)
        self.stepper: RungeKuttaStepper | CycleStepper = (
            CycleStepper(self.system)
            if self.cycles
            else RungeKuttaStepper(self.system, CLASSIC_RK4 if self._has_fixed_step else DOP853)
        )
        self.time_scale = 1.0 if self.cycles else law.gain
        self._start_columns = ColumnLayout(rates=law.arm.n, hand=1, share=1, error=1, slope=1)
        self.made_of = law, method

    @cached_property
    @cached_kernel
    def _start_kernel(self) -> Kernel:
        system = self.system
        parts = self._start_columns.join_parts(configuration_state_parts(system.evaluate_state_rates(system.q)))
        return Kernel("start of a motion", [system.q, *system.inputs.values()], [parts])

    def make_parameters(self, target: FloatArray, setting: RunSettings) -> FloatArray:
        """Return the parameters of runs to targets, poses (N, 4, 4) or task components (N, m).

        The healthy joints and the end of the phase are still to be set.
        """
        return self.stepper.parameters.make_rows(
            len(target),
            **self.system.target_input_values(target),
            limit=setting.time_limit * self.time_scale,
            accuracy=setting.accuracy,
        )

    def run(
        self, q0: FloatArray, parameters: FloatArray, lock_time: FloatArray, setting: RunSettings, advance: Advance
    ) -> FloatArray:
        """Return the states at the end of runs from q0 (N, n) with joints that lock at (N, n), s or cycles.

        The parameters are those of :meth:`make_parameters`, in which the last phase of each run is left. The function
        ``advance`` returns the states at the end of a phase, and which of them have got there.
        """
        run_count, layout, time_scale = len(q0), self.stepper.layout, self.time_scale
        states = np.zeros((run_count, layout.size))
        parts = layout.view_parts(states)
        parts["q"][:] = parts["low"][:] = parts["high"][:] = q0
        parts["slowest"][:] = parts["closest"][:] = LARGE_NUMBER
        if not self.cycles:
            parts["h"][:] = setting.step_size * time_scale if self._has_fixed_step else FIRST_STEP_SIZE
        parameter_parts, clock_limit = self.stepper.parameters.view_parts(parameters), setting.time_limit * time_scale
        healthy_mask, phase_ends = parameter_parts["mask"], parameter_parts["until"][:, 0]
        # Time and clock are the same where nothing slows the command: then the last step ends at the limit exactly.
        final_time = LARGE_NUMBER if self.system.law.speed_limit is not None and not self.cycles else clock_limit
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
        """Set the parts of the states that are known where a phase begins."""
        parts = self.stepper.layout.view_parts(states)
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
        layout = self.stepper.layout
        if not self.stepper.is_staged:
            inputs = self.stepper.parameters.split_inputs(parameters)
            return self._start_kernel.rows(layout.view_parts(states)["q"], *[inputs[name] for name in self.system.inputs])
        # A stage before the first: the law is not compiled a second time.
        entry_states = states.copy()
        parts = layout.view_parts(entry_states)
        parts["stage"][:], parts["code"][:], parts["rates"][:] = -1, STATE_RUNNING, 0.0
        entered_parts = layout.view_parts(self._call_step(entry_states, parameters))
        return np.concatenate([entered_parts[name] for name in self._start_columns.slices], axis=1)

    def advance_step(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return the states after one step."""
        for _ in range(self.stepper.calls_per_step):
            states = self._call_step(states, parameters)
        return states

    def _call_step(self, states: FloatArray, parameters: FloatArray) -> FloatArray:
        loop = self.stepper.loop
        # A loop that takes single steps has a compiled one.
        single = loop.step if loop.times == 1 else self.stepper.single_step
        return single.rows(states, *self.stepper.parameters.split_inputs(parameters).values())[:, : self.stepper.layout.size]
