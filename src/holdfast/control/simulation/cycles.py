"""Closed loop in discrete control cycles, in which the command is constant while the arm follows the law.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 4; the sub-steps and the stopping rule are ours.
"""

from __future__ import annotations

import casadi as ca

from holdfast.control.simulation.system import (
    STATE_ARRIVED,
    STATE_AT_REST,
    STATE_COLLAPSED,
    STATE_PHASE_END,
    STATE_RUNNING,
    STATE_TIME_LIMIT,
    ColumnLayout,
    FailedArmSystem,
    ParameterLayout,
    choose_parts,
    elementwise_max,
    elementwise_min,
    make_state_loop,
    track_final_speeds,
)
from holdfast.core.caching import cached_property
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics

SUBSTEPS_PER_CYCLE = 10
REST_TRAVEL_FRACTION = 2e-5  # fraction of the travel in a cycle at the speed limit, below which the end effector is still
REST_TRAVEL_LENGTHS = 1e-6  # travel without a speed limit, in the arm's unit of length
REST_CYCLES = 50  # consecutive cycles with a still end effector after which the arm is at rest


class CycleStepper:
    """Sub-steps of control cycles of one system, as a loop over states.

    A state contains the configuration ``q``; the number of the ``substep``, the ``command`` of the cycle and the position of
    the end effector (``place``) at its beginning; the ``time`` in cycles; the number of cycles for which the end effector was
    ``still``; and path, closest approach, joint excursions, speeds and code as for
    :class:`holdfast.control.simulation.runge_kutta.RungeKuttaStepper`.

    The parameters of a row, after those of the system, are ``until`` and ``limit``, cycles, and the ``accuracy``, which is the
    radius of the target.
    """

    calls_per_step = 1  # calls of single_step in a step
    is_staged = False

    def __init__(self, system: FailedArmSystem) -> None:
        self.system = system
        law = system.law
        n, m = law.arm.n, law.task.m
        self._rest_distance = (
            REST_TRAVEL_LENGTHS * law.arm.length_unit if law.speed_limit is None else REST_TRAVEL_FRACTION * law.speed_limit
        )
        self._until, self._limit, self._radius = (ca.SX.sym(name) for name in ("until", "limit", "radius"))
        self.parameters = ParameterLayout(**system.inputs, until=self._until, limit=self._limit, accuracy=self._radius)
        scalars = dict.fromkeys(("error", "time", "clock", "path", "closest", "still"), 1)
        end_parts = {"low": n, "high": n, "slowest": 1, "early": 1, "late": 1, "code": 1}
        self.layout = ColumnLayout(q=n, substep=1, command=m, place=3, **scalars, **end_parts)
        self.made_of = system

    @cached_property
    @cached_kernel
    def loop(self) -> Loop:
        """Loop that repeats the sub-steps."""
        return make_state_loop("control cycles", self._build_substep, self.layout, self.parameters.symbols, SUBSTEPS_PER_CYCLE)

    @cached_property
    @cached_kernel
    def single_step(self) -> Kernel:
        """Kernel of one sub-step of a state."""
        symbol = ca.SX.sym("state", self.layout.size)
        return Kernel(
            "one step",
            [symbol, *self.parameters.symbols],
            [self.layout.join_parts(self._build_substep(self.layout.split_symbol(symbol)))],
        )

    def _build_substep(self, parts: dict[str, SX]) -> dict[str, SX]:
        system, q = self.system, parts["q"]
        is_first, is_last = parts["substep"] == 0, parts["substep"] == SUBSTEPS_PER_CYCLE - 1
        error, _ = system.error_and_jacobian(q)
        velocity, speed_fraction = system.compute_limited_velocity(error)
        started = choose_parts(is_first, self._start_cycle(parts, error, velocity), parts)
        rates = system.compute_rates(q, started["command"])
        speed = ca.sqrt(ca.sumsqr(rates)) / speed_fraction
        q = q + rates * (system.law.gain / SUBSTEPS_PER_CYCLE)
        time = parts["time"] + ca.if_else(is_last, 1.0, 0.0)
        moved_parts = {
            **started,
            "q": q,
            "low": elementwise_min(started["low"], q),
            "high": elementwise_max(started["high"], q),
            "substep": ca.if_else(is_last, 0.0, parts["substep"] + 1),
            "time": time,
            "clock": time,
        }
        moved_parts |= choose_parts(is_first, track_final_speeds(started, speed, parts["time"], self._limit), started)
        # A singular configuration makes the rates NaN and the comparison false, so the arm stays at its configuration.
        next_parts = choose_parts(ca.sumsqr(q) < 1e30, moved_parts, {**started, "code": ca.SX(STATE_COLLAPSED)})
        return choose_parts(started["code"] == STATE_RUNNING, next_parts, started)

    def _start_cycle(self, parts: dict[str, SX], task_error: SX, velocity: SX) -> dict[str, SX]:
        """Return the parts that are recorded, and the code that is decided, at the beginning of a cycle."""
        position = kinematics.kinematic_chain(self.system.law.arm, parts["q"]).position
        travel = ca.if_else(parts["time"] > 0, ca.sqrt(ca.sumsqr(position - parts["place"])), 0.0)
        rest_cycles = ca.if_else(ca.logic_and(parts["time"] > 0, travel < self._rest_distance), parts["still"] + 1, 0.0)
        squared_error = ca.sumsqr(task_error)
        code = ca.if_else(parts["time"] >= self._limit, STATE_TIME_LIMIT, STATE_RUNNING)
        code = ca.if_else(rest_cycles >= REST_CYCLES, STATE_AT_REST, code)
        code = ca.if_else(squared_error <= self._radius * self._radius, STATE_ARRIVED, code)
        started_parts = {
            **parts,
            "command": velocity,
            "place": position,
            "error": squared_error,
            "path": parts["path"] + travel,
            "closest": elementwise_min(parts["closest"], squared_error),
            "still": rest_cycles,
            "code": code,
        }
        # The next phase begins this cycle again with another joint locked, so nothing may be recorded twice.
        is_phase_end = ca.logic_and(parts["time"] >= self._until, parts["time"] < self._limit)
        next_parts = choose_parts(is_phase_end, {**parts, "code": ca.SX(STATE_PHASE_END)}, started_parts)
        return choose_parts(parts["code"] == STATE_RUNNING, next_parts, parts)
