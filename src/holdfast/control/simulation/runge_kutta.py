"""Explicit Runge-Kutta steps as straight-line programs, with a separate step size for each row of a batch.

The program includes the step-size control, so simulating a batch only repeats it. A law of many operations is evaluated once
per call instead of once per stage, because compiling it a dozen times would take minutes.

Source: Hairer, Norsett, Wanner 1993, section II.4 for the control, II.10 for the error estimate of DOP853.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import casadi as ca

from holdfast.control.simulation.system import (
    LARGE_NUMBER,
    MAX_UNROLLED_OPERATIONS,
    STATE_AT_REST,
    STATE_COLLAPSED,
    STATE_PHASE_END,
    STATE_RUNNING,
    STATE_TIME_LIMIT,
    ColumnLayout,
    FailedArmSystem,
    ParameterLayout,
    StateRates,
    choose_parts,
    configuration_state_parts,
    elementwise_max,
    elementwise_min,
    make_state_loop,
    track_final_speeds,
    value_at_turning_point,
)
from holdfast.control.simulation.tableaus import Tableau
from holdfast.core.caching import cached_property
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX

REST_SPEED = 1e-8  # rad (and m) per 1/Ke: at rest
MIN_STEP_SIZE = 1e-12  # 1/Ke: a motion with shorter steps makes no progress
SPEED_TOLERANCE_RATIO = 1e-4  # 1/Ke: largest ratio of the tolerance to the speed
MIN_SPEED_TOLERANCE = 1e-12  # rad (and m): smallest tolerance from this ratio
MAX_STEP_TRAVEL_RAD = 0.5  # rad (and m): a longer step would sample the path too coarsely
FIRST_STEP_SIZE = 0.5  # 1/Ke
_STAGED_OPERATIONS = 1250  # operations of one evaluation above which a call computes a single stage
_EVALUATIONS_PER_CALL = 32  # approximate number of evaluations in one call


class RungeKuttaStepper:
    """Runge-Kutta steps of one system under one method, as a loop over states.

    A state contains the configuration ``q`` with its ``rates``, tool speed, ``share`` (speed fraction), squared ``error`` and
    its ``slope``; the next step ``h`` and the ``time``, both in 1/Ke; the ``clock``, which is the time without the speed limit;
    the length ``path`` of the end effector's path, m; the ``closest`` squared error so far; the least and greatest joint
    values ``low`` and ``high``; the speeds ``slowest``, ``early`` and ``late`` near the end; and the ``code``.

    The parameters of a row, after those of the system, are ``until``, the time at which the phase ends; the ``limit`` of the
    clock; and the ``accuracy`` of a step, rad (and m).
    """

    def __init__(self, system: FailedArmSystem, tableau: Tableau) -> None:
        self.system, self.tableau = system, tableau
        n, stages = system.law.arm.n, len(tableau.rows)
        self._until, self._limit, self._tolerance = (ca.SX.sym(name) for name in ("until", "limit", "tolerance"))
        self.parameters = ParameterLayout(**system.inputs, until=self._until, limit=self._limit, accuracy=self._tolerance)
        self.made_of = system, tableau
        stage_parts = {"stage": 1, "k": n * (stages - 1), "hands": stages - 1, "shares": stages - 1}
        scalars = dict.fromkeys(("hand", "share", "error", "slope", "h", "time", "clock", "path", "closest"), 1)
        end_parts = {"low": n, "high": n, "slowest": 1, "early": 1, "late": 1, "code": 1}
        self._layouts = (
            ColumnLayout(q=n, rates=n, **scalars, **end_parts),
            ColumnLayout(q=n, rates=n, **scalars, **end_parts, **stage_parts),
        )

    @cached_property
    @cached_kernel
    def loop(self) -> Loop:
        """Loop that repeats the steps, or the stages."""
        system = self.system
        operations = int(system.rates_function.n_instructions())
        is_staged = operations > 4 * _STAGED_OPERATIONS
        if not is_staged:
            inputs, rates = [system.q, *system.inputs.values()], system.evaluate_state_rates(system.q).rates
            is_staged = int(ca.Function("rates", inputs, [rates], {"cse": True}).n_instructions()) > _STAGED_OPERATIONS
        max_steps = _EVALUATIONS_PER_CALL if is_staged else _EVALUATIONS_PER_CALL // len(self.tableau.rows)
        if operations > MAX_UNROLLED_OPERATIONS:
            max_steps = 1
        next_state, name = self._build_stage if is_staged else self._build_step, f"closed loop, {self.tableau.name}"
        return make_state_loop(name, next_state, self._layouts[is_staged], self.parameters.symbols, max_steps)

    @property
    def is_staged(self) -> bool:
        """True if the loop computes one stage at a time; a stage -1 then records the values at the start of a motion."""
        return self.loop.size == self._layouts[1].size

    @property
    def layout(self) -> ColumnLayout:
        """Layout of a state."""
        return self._layouts[self.is_staged]

    @property
    def calls_per_step(self) -> int:
        """Number of calls of :attr:`single_step` in a step."""
        return len(self.tableau.rows) if self.is_staged else 1

    @cached_property
    @cached_kernel
    def single_step(self) -> Kernel:
        """Kernel of one step of a state, or of one of its stages, for callers that need every step."""
        symbol = ca.SX.sym("state", self.layout.size)
        next_parts = (self._build_stage if self.is_staged else self._build_step)(self.layout.split_symbol(symbol))
        return Kernel("one step", [symbol, *self.parameters.symbols], [self.layout.join_parts(next_parts)])

    def _build_step(self, parts: dict[str, SX]) -> dict[str, SX]:
        h = elementwise_min(parts["h"], self._until - parts["time"])
        rates, tool_speeds, speed_fractions = [parts["rates"]], [parts["hand"]], [parts["share"]]
        for weights in self.tableau.rows[:-1]:
            stage_rates = self.system.evaluate_state_rates(parts["q"] + h * _weighted_sum(weights, rates))
            rates.append(stage_rates.rates)
            tool_speeds.append(stage_rates.tool_speed)
            speed_fractions.append(stage_rates.speed_fraction)
        end_position = parts["q"] + h * _weighted_sum(self.tableau.rows[-1], rates)
        end_rates = self.system.evaluate_state_rates(end_position)
        return self._finish_step(parts, h, rates, tool_speeds, speed_fractions, end_position, end_rates)

    def _build_stage(self, parts: dict[str, SX]) -> dict[str, SX]:
        """Return the parts after one evaluation; the last one finishes the step."""
        n, stage_weights = self.system.law.arm.n, self.tableau.rows
        h = elementwise_min(parts["h"], self._until - parts["time"])
        rates = [parts["rates"], *[parts["k"][stage * n : (stage + 1) * n] for stage in range(len(stage_weights) - 1)]]
        weights = [
            sum(
                ca.if_else(parts["stage"] == stage, row[column], 0.0)
                for stage, row in enumerate(stage_weights)
                if column < len(row)
            )
            for column in range(len(stage_weights))
        ]
        stage_position = parts["q"] + h * _weighted_sum(weights, rates)
        stage_rates = self.system.evaluate_state_rates(stage_position)
        tool_speeds = [parts["hand"], *ca.vertsplit(parts["hands"])]
        speed_fractions = [parts["share"], *ca.vertsplit(parts["shares"])]
        finished_parts = self._finish_step(parts, h, rates, tool_speeds, speed_fractions, stage_position, stage_rates)
        is_finite = ca.sumsqr(stage_rates.rates) < LARGE_NUMBER
        stored_parts = dict(parts)
        for name, value, width in (
            ("k", stage_rates.rates, n),
            ("hands", stage_rates.tool_speed, 1),
            ("shares", stage_rates.speed_fraction, 1),
        ):
            # A NaN would stay in the state, whereas a number this large makes the step rejected.
            bounded_value = ca.if_else(is_finite, value, 1e30)
            old_value = parts[name]
            stored_parts[name] = ca.vertcat(
                *[
                    ca.if_else(parts["stage"] == stage, bounded_value, old_value[stage * width : (stage + 1) * width])
                    for stage in range(len(stage_weights) - 1)
                ]
            )
        stored_parts["stage"] = parts["stage"] + 1
        is_entering = parts["stage"] < 0
        for name, value in configuration_state_parts(stage_rates).items():
            stored_parts[name] = ca.if_else(is_entering, value, parts[name])
        finished_parts["stage"] = ca.SX(0)
        for name in ("k", "hands", "shares"):
            finished_parts[name] = parts[name]
        next_parts = choose_parts(parts["stage"] == len(stage_weights) - 1, finished_parts, stored_parts)
        return choose_parts(parts["code"] == STATE_RUNNING, next_parts, parts)

    def _finish_step(
        self,
        parts: dict[str, SX],
        h: SX,
        rates: list[SX],
        tool_speeds: list[SX],
        speed_fractions: list[SX],
        end_position: SX,
        end_rates: StateRates,
    ) -> dict[str, SX]:
        """Return the state after a step, or the old state with a shorter step if the step was rejected."""
        weights = self.tableau.rows[-1]
        is_running = parts["code"] == STATE_RUNNING
        joint_speed = ca.sqrt(ca.sumsqr(end_rates.rates))
        if self.tableau.errors:
            # Close to a singularity a stationary point attracts so strongly that usual errors would keep the arm moving.
            speed_tolerance = elementwise_max(SPEED_TOLERANCE_RATIO * ca.sqrt(ca.sumsqr(parts["rates"])), MIN_SPEED_TOLERANCE)
            relative_error = self._estimate_error(h, rates) / elementwise_min(self._tolerance, speed_tolerance) ** 2
            # A stage at a singularity makes the estimate NaN and every comparison with it false. The estimate does not include
            # the derivative at the end, with which the next step begins.
            is_usable = ca.logic_and(relative_error < 1e20, ca.sumsqr(end_rates.rates) < LARGE_NUMBER)
            is_accepted = ca.logic_and(relative_error <= 1, is_usable)
            error_root = ca.if_else(is_usable, relative_error, 1.0) + 1e-20
            for _ in range(4):  # 16th root of the squared error, for a method of order 8
                error_root = ca.sqrt(error_root)
            factor = ca.if_else(is_usable, elementwise_min(elementwise_max(0.9 / error_root, 0.2), 10.0), 0.2)
            # A step that the end of its phase shortened is no reason to reduce the planned step.
            grown_step = ca.if_else(h < parts["h"], elementwise_max(h * factor, parts["h"]), h * factor)
            longest_step = MAX_STEP_TRAVEL_RAD / elementwise_max(joint_speed, MAX_STEP_TRAVEL_RAD / self.tableau.longest_step)
            next_step = ca.if_else(is_accepted, elementwise_min(grown_step, longest_step), h * factor)
        else:
            is_accepted = ca.sumsqr(end_rates.rates) < LARGE_NUMBER
            next_step = ca.if_else(is_accepted, parts["h"], 0.0)
        time, clock = parts["time"] + h, parts["clock"] + h * _weighted_sum(weights, speed_fractions)
        speed = joint_speed / end_rates.speed_fraction
        closest, lowest, highest = self._update_extremes(parts, h, rates, end_position, end_rates)
        code = ca.if_else(time >= self._until - MIN_STEP_SIZE, STATE_PHASE_END, STATE_RUNNING)
        code = ca.if_else(clock >= self._limit * (1 - 1e-12), STATE_TIME_LIMIT, code)
        code = ca.if_else(speed < REST_SPEED, STATE_AT_REST, code)
        moved_parts = {
            **parts,
            "q": end_position,
            "rates": end_rates.rates,
            "hand": end_rates.tool_speed,
            "share": end_rates.speed_fraction,
            "error": end_rates.squared_error,
            "slope": end_rates.squared_error_rate,
            "h": next_step,
            "time": time,
            "clock": clock,
            "path": parts["path"] + h * _weighted_sum(weights, tool_speeds),
            "closest": closest,
            "low": lowest,
            "high": highest,
            **track_final_speeds(parts, speed, clock, self._limit),
            "code": code,
        }
        # All other parts keep their values, also after the end of a run.
        code = ca.if_else(is_running, ca.if_else(next_step < MIN_STEP_SIZE, STATE_COLLAPSED, STATE_RUNNING), parts["code"])
        return choose_parts(ca.logic_and(is_running, is_accepted), moved_parts, {**parts, "h": next_step, "code": code})

    def _update_extremes(
        self, parts: dict[str, SX], h: SX, rates: list[SX], end_position: SX, end_rates: StateRates
    ) -> tuple[SX, SX, SX]:
        """Return the least squared error and the least and greatest joint values so far, also within steps and half steps."""
        points = [(parts["q"], parts["rates"], parts["error"], parts["slope"])]
        if self.tableau.middle:
            middle_step, middle_rates = (_weighted_sum(weights, [*rates, end_rates.rates]) for weights in self.tableau.middle)
            middle_position = parts["q"] + h * middle_step
            error, jacobian = self.system.error_and_jacobian(middle_position)
            error_rate = -2 * ca.dot(error, jacobian @ middle_rates)
            points.append((middle_position, middle_rates, ca.sumsqr(error), error_rate))
        points.append((end_position, end_rates.rates, end_rates.squared_error, end_rates.squared_error_rate))
        interval = h / (len(points) - 1)
        closest, lowest, highest = parts["closest"], parts["low"], parts["high"]
        for (q0, rates0, error0, slope0), (q1, rates1, error1, slope1) in pairwise(points):
            turning_error = value_at_turning_point(error0, error1, interval * slope0, interval * slope1)
            turning_joint = value_at_turning_point(q0, q1, interval * rates0, interval * rates1)
            closest = elementwise_min(closest, elementwise_min(turning_error, error1))
            lowest = elementwise_min(lowest, elementwise_min(turning_joint, q1))
            highest = elementwise_max(highest, elementwise_max(turning_joint, q1))
        return closest, lowest, highest

    def _estimate_error(self, h: SX, rates: list[SX]) -> SX:
        """Estimate the mean squared error of a step."""
        assert self.tableau.errors is not None
        fifth, third = (ca.sumsqr(_weighted_sum(weights, rates)) for weights in self.tableau.errors)
        return h * h * fifth * fifth / ((fifth + 0.01 * third + 1e-60) * rates[0].numel())


def _weighted_sum(weights: Sequence[SX | float], values: Sequence[SX]) -> SX:
    """Return a weighted sum, which omits weights that are the number 0."""
    total = ca.SX(0)
    for weight, value in zip(weights, values, strict=True):
        if not (isinstance(weight, float) and weight == 0):
            total = total + weight * value
    return total
