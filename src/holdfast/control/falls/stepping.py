"""Steps of a fall with dry friction, stops, and brakes.

A step is a trapezoidal rule with one mass matrix and one bias. Its change of the joint rates ``dv`` solves a convex problem,

    min  1/2 dv' A dv - p' dv + h sum_i beta_i |v_i + dv_i|    subject to    v_i + dv_i >= -e v_i at a lower stop,

with ``A = M(q + h/2 v) + h/2 D`` and ``p = -h (C + g + D v)``. The solution is found by an active set, which is part of the
state. A call of the step solves the linear system of the present set. If the solution contradicts the set, the call corrects
the set and leaves the time unchanged. A step in which a joint reaches a stop or ceases to move is shortened to end there. An
impact is a call of no duration, which changes only the rates.

Sources: Moreau 1988 for impacts; Judice and Pires 1992 for the least-index rule, with which the search for the set is finite.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.control.falls.drop_points import DropPoints
from holdfast.control.falls.passive_arm import TIME_ROUNDING_S, PassiveArm, any_of, largest, solve_selected
from holdfast.control.simulation.system import (
    LARGE_NUMBER,
    STATE_AT_REST,
    STATE_PHASE_END,
    STATE_RUNNING,
    ColumnLayout,
    choose_parts,
    elementwise_max,
    elementwise_min,
)
from holdfast.kernels.program import SX
from holdfast.model.arm import dynamics, statics
from holdfast.model.arm.model import Arm

STOP_TOLERANCE = 1e-9  # rad or m: a step that ends this close to a stop ends at the stop
REST_RATE = 1e-9  # rad/s or m/s: a slower joint does not hit a stop, it lies against it
RATE_ROUNDING = 1e-12  # rad/s or m/s
FRACTION_ROUNDING = 1 + 1e-12  # a joint that ceases to move this close to the end of a shortened step does so at its end
TRIES_TOGETHER = 12  # corrections of the set that may change all joints; later corrections change one joint each
MOST_TRIES = 60

# Modes of a joint at rest or at a stop; only MODE_STOPPING also belongs to moving joints. The mode of a joint that breaks loose
# or slides has the sign of its motion.
MODE_HELD = 0
MODE_SLIDING = 1
MODE_BREAKING_LOOSE = 2
MODE_STOPPING = 3


@dataclass(frozen=True)
class _Conditions:
    """Values (n,) that a call of a step does not change."""

    at_lower: SX  # 1 if the joint is at this limit
    at_upper: SX
    is_moving: SX
    hits: SX  # 1 if the joint moves into the stop at which it is
    is_impact: SX  # scalar, 1 if a joint hits its stop
    h: SX  # scalar, duration of the step, s
    sliding_friction: SX  # N m or N
    resting_friction: SX


@dataclass(frozen=True)
class _Solution:
    """Solution (n,) of the linear system of the present set."""

    is_active: SX  # 1 if the rate of the joint is an unknown
    direction: SX  # sign of the motion against which friction acts
    target: SX  # rate after the step of a joint that is not active
    change: SX  # change of the rates
    rates: SX  # after the step
    reaction: SX  # impulse of friction and stop that holds a joint that is not active, N m s or N s


class DryFrictionStepper(PassiveArm):
    """Steps of the falls of an arm with dry friction, and with stops at its limits if they act.

    A state contains the configuration ``q``, the ``rates`` and the last ``acceleration`` (n,); the ``mode`` of each joint; the
    ``step`` that is tried, s, 0 for a new one; the number of ``tries`` of the set; the ``time``, s; the largest ``drop`` so
    far, m; the ``residual``, which is the largest torque or force by which a step contradicts its
    set; and the ``code``.
    """

    steps_per_call = 2  # the loop around a call takes a fifth of the time of one step

    def __init__(self, arm: Arm, points: DropPoints | None, is_plain: bool, has_stops: bool) -> None:
        super().__init__(arm, points, is_plain)
        self.made_of, n = (arm, self.points, is_plain, has_stops), arm.n
        self.lower = np.where(np.isfinite(arm.lower) & has_stops, arm.lower, -LARGE_NUMBER)
        self.upper = np.where(np.isfinite(arm.upper) & has_stops, arm.upper, LARGE_NUMBER)
        scalars = dict.fromkeys(("step", "tries", "time", "drop", "residual", "code"), 1)
        self.layout = ColumnLayout(q=n, rates=n, acceleration=n, mode=n, **scalars)

    def _build_call(self, parts: dict[str, SX]) -> dict[str, SX]:
        """Return the parts after one call: a corrected set, a shorter step, or the state after the step."""
        q, rates, mode, symbols = parts["q"], parts["rates"], parts["mode"], self.symbols
        at_lower, at_upper = q <= self.lower, q >= self.upper
        hits = ca.logic_or(ca.logic_and(at_lower, rates < -REST_RATE), ca.logic_and(at_upper, rates > REST_RATE))
        is_impact = any_of(hits)
        h = ca.if_else(is_impact, 0.0, ca.if_else(parts["step"] > 0, parts["step"], self.next_step(parts["time"])))
        middle = q + h / 2 * rates
        gravity = statics.gravity_torques(self.arm, statics.composite_bodies(self.arm, middle))
        middle_rates = rates + h / 2 * parts["acceleration"]
        bias = gravity + dynamics.inertial_torques(self.arm, middle, middle_rates, ca.SX(self.arm.n, 1))
        damping = self.damping(parts["time"])
        matrix = statics.inertia_matrix(self.arm, middle) + ca.diag(h / 2 * damping)
        impulse = -h * (bias + damping * rates)
        further = symbols["load"] * ca.fabs(gravity) + self.is_braked(parts["time"]) * symbols["brake_torque"]
        conditions = _Conditions(
            at_lower,
            at_upper,
            rates != 0,
            hits,
            is_impact,
            h,
            symbols["coulomb"] + further,
            symbols["stiction"] + further,
        )
        solution = self._solve_set(parts, conditions, matrix, impulse)
        corrected_mode, excess = self._correct_set(parts, conditions, solution)
        is_contradictory = ca.logic_and(any_of(corrected_mode != mode), parts["tries"] < MOST_TRIES)
        sign = ca.sign(mode)
        is_new = ca.logic_and(ca.fabs(mode) == MODE_BREAKING_LOOSE, conditions.resting_friction > conditions.sliding_friction)
        is_loosening = ca.logic_and(any_of(is_new), ca.logic_not(is_impact))
        corrected = {
            "mode": ca.if_else(is_contradictory, corrected_mode, ca.if_else(is_new, sign * MODE_SLIDING, mode)),
            "tries": parts["tries"] + 1,
            "step": h,
        }
        fraction, shortened_mode = self._find_event(parts, conditions, solution)
        shortened = {"mode": shortened_mode, "tries": ca.SX(0), "step": h * fraction}
        is_corrected, is_running = ca.logic_or(is_contradictory, is_loosening), parts["code"] == STATE_RUNNING
        moved = self._advance(parts, conditions, solution, excess)
        tried = {**parts, **choose_parts(is_running, choose_parts(is_corrected, corrected, shortened), parts)}
        return choose_parts(ca.logic_and(is_running, ca.logic_not(ca.logic_or(is_corrected, fraction < 1))), moved, tried)

    def _solve_set(self, parts: dict[str, SX], conditions: _Conditions, matrix: SX, impulse: SX) -> _Solution:
        """Solve the linear system in which each joint slides, is held, or rebounds as the present set has it."""
        rates, mode, free = parts["rates"], parts["mode"], self.symbols["free"]
        is_at_stop = ca.logic_or(conditions.at_lower, conditions.at_upper)
        slides = ca.if_else(conditions.is_moving, mode != MODE_STOPPING, mode != MODE_HELD)
        is_loose = ca.logic_and(conditions.resting_friction <= 0, ca.logic_not(is_at_stop))
        in_impact = ca.logic_or(ca.logic_not(is_at_stop), mode != MODE_HELD)
        is_active = free * ca.if_else(conditions.is_impact, in_impact, ca.logic_or(slides, is_loose))
        direction = ca.sign(ca.if_else(conditions.is_moving, rates, mode))
        is_breaking = ca.logic_and(ca.logic_not(conditions.is_moving), ca.fabs(mode) == MODE_BREAKING_LOOSE)
        friction = ca.if_else(is_breaking, conditions.resting_friction, conditions.sliding_friction)
        rebound = self.symbols["restitution"] * rates
        is_rebounding = ca.logic_and(conditions.hits, ca.fabs(rebound) > REST_RATE)
        target = ca.if_else(is_rebounding, -rebound, 0.0)
        right_side = impulse - conditions.h * direction * friction
        change = solve_selected(matrix, right_side, is_active, target - rates)
        reaction = matrix @ change - impulse
        rates_after = ca.if_else(is_active, rates + change, target)
        return _Solution(is_active, direction, target, change, rates_after, reaction)

    def _correct_set(self, parts: dict[str, SX], conditions: _Conditions, solution: _Solution) -> tuple[SX, SX]:
        """Return the modes (n,) without the contradictions of a solution, and these, N m and N."""
        mode, h = parts["mode"], conditions.h
        is_held = ca.logic_and(ca.logic_not(solution.is_active), ca.logic_and(self.symbols["free"], mode != MODE_STOPPING))
        excess = ca.fabs(solution.reaction) - h * conditions.resting_friction
        is_unsupported = ca.if_else(solution.reaction < 0, ca.logic_not(conditions.at_upper), ca.logic_not(conditions.at_lower))
        gives_way = ca.logic_and(is_held, ca.logic_and(excess > 0, is_unsupported))
        turns_back = ca.logic_and(ca.logic_not(conditions.is_moving), solution.direction * solution.rates < -RATE_ROUNDING)
        turns_back = ca.logic_and(turns_back, conditions.resting_friction > 0)
        beyond_target = solution.rates - solution.target
        enters_stop = ca.logic_or(
            ca.logic_and(conditions.at_lower, beyond_target < -RATE_ROUNDING),
            ca.logic_and(conditions.at_upper, beyond_target > RATE_ROUNDING),
        )
        is_wrong_motion = ca.if_else(conditions.is_impact, enters_stop, ca.logic_or(turns_back, enters_stop))
        is_wrong_motion = ca.logic_and(solution.is_active, ca.logic_and(mode != MODE_HELD, is_wrong_motion))
        is_wrong_motion = ca.logic_and(is_wrong_motion, ca.logic_or(conditions.is_impact, ca.logic_not(conditions.is_moving)))
        corrected = ca.if_else(
            gives_way, -ca.sign(solution.reaction) * MODE_BREAKING_LOOSE, ca.if_else(is_wrong_motion, MODE_HELD, mode)
        )
        duration = ca.if_else(h > 0, h, self.symbols["longest_step"])
        contradiction = ca.if_else(
            gives_way, excess / duration, ca.if_else(is_wrong_motion, 2 * conditions.resting_friction, 0.0)
        )
        first_only, is_earlier = [], ca.SX(0)
        for before, after in zip(ca.vertsplit(mode), ca.vertsplit(corrected), strict=True):
            first_only.append(ca.if_else(is_earlier, before, after))
            is_earlier = ca.logic_or(is_earlier, before != after)
        corrects_all = parts["tries"] < TRIES_TOGETHER
        return ca.if_else(corrects_all, corrected, ca.vertcat(*first_only)), contradiction

    def _find_event(self, parts: dict[str, SX], conditions: _Conditions, solution: _Solution) -> tuple[SX, SX]:
        """Return the fraction of the step at which a joint first reaches a stop or ceases to move, and the modes for that.

        The fraction is 1 if there is no event. The positions are parabolas over the step, and the rates straight lines. Of
        several joints that reach stops, only the one whose chord does so first counts. The shorter step is tried again.
        """
        q, rates, mode, h = parts["q"], parts["rates"], parts["mode"], conditions.h
        end = q + h / 2 * (rates + solution.rates)
        is_low = 2 * end < self.lower + self.upper  # only this limit can be crossed
        side, limit = ca.if_else(is_low, 1.0, -1.0), ca.if_else(is_low, self.lower, self.upper)
        start, overshoot = side * (q - limit), side * (limit - end)
        crosses = ca.logic_and(self.symbols["free"], overshoot > STOP_TOLERANCE)
        motion = ca.horzcat(side * h * rates, side * h / 2 * (solution.rates - rates))
        first_start, _, first, second = _select_smallest_ratio(
            ca.if_else(crosses, start, 1.0), ca.if_else(crosses, start + overshoot, 0.0), motion
        )
        to_stop = _crossing_fraction(first_start, first, second, any_of(crosses))
        is_stopping = ca.logic_and(solution.is_active, ca.logic_and(conditions.is_moving, conditions.sliding_friction > 0))
        is_stopping = ca.logic_and(is_stopping, solution.direction * solution.rates < -RATE_ROUNDING)
        speed, change = ca.fabs(rates), ca.fabs(rates - solution.rates)
        first_speed, first_change = _select_smallest_ratio(
            ca.if_else(is_stopping, speed, 1.0), ca.if_else(is_stopping, change, 1.0), ca.SX(self.arm.n, 0)
        )
        fraction = elementwise_min(to_stop, first_speed / first_change)
        fraction = ca.if_else(conditions.is_impact, 1.0, fraction)
        rests_first = ca.logic_and(is_stopping, speed <= fraction * FRACTION_ROUNDING * change)
        return fraction, ca.if_else(rests_first, MODE_STOPPING, ca.if_else(mode == MODE_STOPPING, MODE_HELD, mode))

    def _advance(self, parts: dict[str, SX], conditions: _Conditions, solution: _Solution, excess: SX) -> dict[str, SX]:
        """Return the parts after a step, or after an impact."""
        h = conditions.h
        # A rate this small is rounding: with it, two joints could stop and start in turns, in ever shorter steps.
        is_rounding = ca.logic_and(ca.fabs(solution.rates) < RATE_ROUNDING, conditions.resting_friction > 0)
        after = ca.if_else(is_rounding, 0.0, solution.rates)
        q = parts["q"] + h / 2 * (parts["rates"] + after)
        for limit, outwards in ((self.lower, -1.0), (self.upper, 1.0)):
            # This includes a joint that ceases to move next to its stop, because it would shorten every later step.
            arrives = ca.logic_and(outwards * (q - limit) >= -STOP_TOLERANCE, outwards * after >= 0)
            arrives = ca.logic_and(arrives, ca.logic_not(conditions.is_impact))
            is_there = ca.logic_and(self.symbols["free"], ca.logic_or(arrives, outwards * (q - limit) > 0))
            q = ca.if_else(is_there, limit, q)
            after = ca.if_else(ca.logic_and(arrives, outwards * after <= REST_RATE), 0.0, after)
        is_step = h > 0
        acceleration = ca.if_else(ca.logic_and(is_step, after != 0), solution.change / ca.if_else(is_step, h, 1.0), 0.0)
        time, until = parts["time"] + h, self.symbols["until"]
        is_last = time >= until - TIME_ROUNDING_S
        is_at_rest = ca.logic_not(any_of(ca.logic_or(conditions.is_moving, after != 0)))
        moved = {
            "q": q,
            "rates": after,
            "acceleration": acceleration,
            "mode": ca.SX(self.arm.n, 1),
            "step": ca.SX(0),
            "tries": ca.SX(0),
            "time": ca.if_else(is_last, until, time),
            "drop": elementwise_max(parts["drop"], self.drop(q)),
            "residual": elementwise_max(parts["residual"], largest(excess)),
            "code": ca.if_else(is_last, STATE_PHASE_END, STATE_RUNNING),
        }
        unchanged = {"q": parts["q"], "time": parts["time"], "code": ca.SX(STATE_AT_REST)}
        return {**moved, **choose_parts(is_at_rest, unchanged, moved)}


def _select_smallest_ratio(dividends: SX, divisors: SX, others: SX) -> list[SX]:
    """Return the dividend, the divisor, and the row of ``others`` (n, k) of the smallest ratio; divisors are not negative."""
    rows = [ca.horzsplit(row) for row in ca.vertsplit(ca.horzcat(dividends, divisors, others))]
    best = rows[0]
    for row in rows[1:]:
        is_smaller = row[0] * best[1] < best[0] * row[1]
        best = [ca.if_else(is_smaller, a, b) for a, b in zip(row, best, strict=True)]
    return list(best)


def _crossing_fraction(start: SX, first: SX, second: SX, crosses: SX) -> SX:
    """Return the first x in (0, 1) at which ``start + first x + second x^2`` falls through 0; 1 if it does not cross."""
    root = ca.sqrt(ca.if_else(crosses, elementwise_max(first * first - 4 * second * start, 0.0), 1.0))
    is_leaving = first > 0
    # Each quotient is that without cancellation.
    dividend, divisor = ca.if_else(is_leaving, -(first + root), 2 * start), ca.if_else(is_leaving, 2 * second, root - first)
    return ca.if_else(crosses, dividend / ca.if_else(crosses, divisor, 1.0), 1.0)
