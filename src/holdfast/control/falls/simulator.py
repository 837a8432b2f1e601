"""Batches of falls in the compiled loops, in blocks of bounded memory."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from holdfast.control.falls.drop_points import DropPoints
from holdfast.control.falls.passive_arm import PLAIN_CONDITIONS, PassiveArm, energy_kernel
from holdfast.control.falls.smooth import SmoothStepper
from holdfast.control.falls.stepping import DryFrictionStepper
from holdfast.control.simulation.system import STATE_AT_REST
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm.model import Arm

MOST_CALLS_PER_STEP = 50  # on average over a fall, before its simulation is given up
BLOCK_ROWS = 1 << 15


@dataclass(frozen=True, kw_only=True, eq=False)
class FallStates:
    """States of falls at their end, or from which on all joints are at rest.

    Attributes:
        q: (N, n) configurations, rad and m.
        rates: (N, n) joint rates, rad/s and m/s.
        tool: (N, 3) tool points in the world, m.
        drop: (N,) largest displacement of a point along gravity so far, m.
        time: (N,) time of the state, s.
        residual: (N,) largest torque or force by which a step contradicts the laws of friction and contact, N m or N.
        is_at_rest: (N,) True if no joint moves any more.
        is_finished: (N,) False if the simulation was given up.
        pair: (N,) pair of the clearance that touches at this time; -1 for none.
    """

    q: FloatArray
    rates: FloatArray
    tool: FloatArray
    drop: FloatArray
    time: FloatArray
    residual: FloatArray
    is_at_rest: BoolArray
    is_finished: BoolArray
    pair: IndexArray

    @classmethod
    def join(cls, parts: list[FallStates]) -> FallStates:
        """Return the falls of all parts in one."""
        return cls(**{name: np.concatenate([getattr(part, name) for part in parts]) for name in cls.__dataclass_fields__})


class FallSimulator:
    """Falls of one arm under constant conditions.

    Args:
        arm: The arm.
        has_stops: True if the limits of the arm stop its joints.
        conditions: Parameters of :class:`holdfast.control.falls.passive_arm.PassiveArm`, all of them except ``until`` and
            ``longest_step``.
        is_stiff: True if explicit steps would diverge, so that implicit ones are needed also without dry friction and stops.
        points: Points whose drop is computed. Default: the tool point.
    """

    def __init__(
        self,
        arm: Arm,
        has_stops: bool,
        conditions: dict[str, FloatArray | float],
        is_stiff: bool = False,
        points: DropPoints | None = None,
    ) -> None:
        self.arm, self.has_stops, self.conditions, self.is_stiff = arm, has_stops, conditions, is_stiff
        has_limits = has_stops and bool(np.isfinite([arm.lower, arm.upper]).any())
        is_dry = any(np.any(conditions[name]) for name in ("stiction", "load", "brake_torque"))
        is_plain = all(np.all(conditions[name] == value) for name, value in PLAIN_CONDITIONS.items())
        is_smooth = not (has_limits or is_dry or is_stiff)
        self.stepper: PassiveArm = (
            compiled_smooth_stepper(arm, points, is_plain) if is_smooth else compiled_stepper(arm, points, is_plain, has_limits)
        )
        self.points = self.stepper.points
        self.energy_kernel: Kernel = energy_kernel(arm)

    def __reduce__(self) -> tuple[Any, ...]:
        """Leave the compiled loops out of a pickle."""
        return FallSimulator, (self.arm, self.has_stops, self.conditions, self.is_stiff, self.points)

    def run(self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray) -> FallStates:
        """Simulate falls up to given times.

        Args:
            q: (N, n) finite configurations at the power loss, rad and m.
            rates: (N, n) finite joint rates at the power loss, rad/s and m/s.
            until: (N,) times since the power loss, above 0, s.
            step: (N,) longest steps, s.
        """
        blocks = [slice(start, start + BLOCK_ROWS) for start in range(0, max(len(q), 1), BLOCK_ROWS)]
        return FallStates.join([self._run_block(q[b], rates[b], until[b], step[b]) for b in track("blocks of falls", blocks)])

    def make_rows(
        self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray
    ) -> tuple[FloatArray, FloatArray, int]:
        """Return the states and the parameters of the loop for falls, and the number of calls after which they are given up."""
        states = np.zeros((len(q), self.stepper.layout.size))
        parts = self.stepper.layout.view_parts(states)
        parts["q"][:], parts["rates"][:] = q, rates
        names = self.conditions.keys() & self.stepper.parameters.slices.keys()
        parameters = self.stepper.parameters.make_rows(len(q), **{name: self.conditions[name] for name in names})
        columns = self.stepper.parameters.view_parts(parameters)
        columns["until"][:, 0], columns["longest_step"][:, 0] = until, step
        columns["start_depth"][:] = self.points.depths(self.arm, q)
        return states, parameters, int(np.ceil((until / step).max(initial=0.0)) + 100) * MOST_CALLS_PER_STEP

    def _run_block(self, q: FloatArray, rates: FloatArray, until: FloatArray, step: FloatArray) -> FallStates:
        states, parameters, most_calls = self.make_rows(q, rates, until, step)
        result = self.stepper.loop.run(states, parameters, 0.5, most_calls)
        return self.read_states(parameters, result.state, result.done, np.full(len(q), -1, dtype=np.int64))

    def read_states(self, parameters: FloatArray, states: FloatArray, done: BoolArray, pair: IndexArray) -> FallStates:
        """Return the states of falls from the parameters and the states of the loop."""
        parts, known = self.stepper.layout.view_parts(states), self.stepper.parameters.view_parts(parameters)
        end, time = parts["q"].copy(), parts["time"][:, 0].copy()
        return FallStates(
            q=end,
            rates=parts["rates"].copy(),
            tool=self.tool_points(end),
            drop=np.maximum(parts["drop"][:, 0], (self.points.depths(self.arm, end) - known["start_depth"]).max(axis=1)),
            time=time,
            residual=parts["residual"][:, 0].copy(),
            is_at_rest=parts["code"][:, 0] == STATE_AT_REST,
            is_finished=done,
            pair=pair,
        )

    def tool_points(self, q: FloatArray) -> FloatArray:
        """Return the tool points (N, 3) in the world, m, of configurations (N, n)."""
        return np.ascontiguousarray(self.arm.forward_kinematics(q)[:, :3, 3])

    def energies(self, q: FloatArray, rates: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return potential and kinetic energies (N,), J, of states (N, n); the first up to a constant."""
        return self.energy_kernel.rows(q, first=1)[:, 0], np.einsum("ni,nij,nj->n", rates, self.inertia_matrices(q), rates) / 2

    def inertia_matrices(self, q: FloatArray) -> FloatArray:
        """Return the inertia matrices (N, n, n), kg m^2, of configurations (N, n)."""
        return self.energy_kernel.rows(q)[:, 1:].reshape(-1, self.arm.n, self.arm.n)


# Compiled once for each arm.
compiled_stepper = lru_cache(maxsize=16)(DryFrictionStepper)
compiled_smooth_stepper = lru_cache(maxsize=16)(SmoothStepper)
