"""Explicit Runge-Kutta steps with a step size for each row of a batch, each step a straight-line program.

The step-size control is part of the program, so that a batch needs nothing but its repetition. A law of many operations is
evaluated once per call instead of once per stage: compiling it a dozen times over would take minutes.

Source: Hairer, Norsett, Wanner 1993, section II.4 for the control, II.10 for the error estimate of DOP853.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import casadi as ca

from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.simulation.system import (
    COLLAPSE,
    FAR,
    PHASE,
    REST,
    RUNNING,
    TIME,
    UNROLLED,
    Here,
    State,
    System,
    chosen,
    greater,
    known_at,
    lesser,
    loop_of,
    turning_value,
    watched,
)
from holdfast.simulation.tableaus import Tableau

REST_SPEED = 1e-8  # rad (and m) per 1/Ke: at rest
COLLAPSED = 1e-12  # of 1/Ke: steps this short lead nowhere
NEARLY, FINEST = 1e-4, 1e-12  # 1/Ke, rad (and m): the tolerance is at most so much of the speed, down to the finest
TURN = 0.5  # rad (and m): a longer step would see too little of the way
FIRST = 0.5  # of 1/Ke
_SMALL = 1250  # operations of one evaluation: beyond, stages are taken one at a time
_EVALUATIONS = 32  # in one call, about


class Steps:
    """Runge-Kutta steps of one system under one method, as a loop over states.

    A state holds the configuration ``q`` and what is known there (``rates``, tool speed, ``share``, ``error`` squared
    and its ``slope``); the next step ``h`` and the ``time``, both in 1/Ke; the ``clock``, which counts time as if no speed
    limit slowed the motion; the ``path`` of the end effector, m; the ``closest`` squared error so far; the least and greatest
    joint values ``low`` and ``high``; the speeds ``slowest``, ``early`` and ``late`` of the end; and its ``code``.

    Parameters of a row, after those of the system: ``until``, the time at which the phase ends; the ``limit`` of the clock;
    the ``tolerance`` of a step, rad (and m).
    """

    def __init__(self, system: System, tableau: Tableau) -> None:
        self.system, self.tableau = system, tableau
        n, stages = system.law.arm.n, len(tableau.rows)
        self._until, self._limit, self._tolerance = (ca.SX.sym(x) for x in ("until", "limit", "tolerance"))
        self.parameters = [*system.given, self._until, self._limit, self._tolerance]
        self.made_of = system, tableau
        kept = {"stage": 1, "k": n * (stages - 1), "hands": stages - 1, "shares": stages - 1}
        scalars = dict.fromkeys(("hand", "share", "error", "slope", "h", "time", "clock", "path", "closest"), 1)
        ends = {"low": n, "high": n, "slowest": 1, "early": 1, "late": 1, "code": 1}
        self._layouts = State(q=n, rates=n, **scalars, **ends), State(q=n, rates=n, **scalars, **ends, **kept)

    @cached_property
    @recalled
    def loop(self) -> Loop:
        """The steps, or stages, repeated."""
        s = self.system
        size = int(s.function.n_instructions())
        staged = size > 4 * _SMALL
        if not staged:
            staged = int(ca.Function("rates", [s.q, *s.given], [s.at(s.q).rates], {"cse": True}).n_instructions()) > _SMALL
        most = _EVALUATIONS if staged else _EVALUATIONS // len(self.tableau.rows)
        if size > UNROLLED:
            most = 1
        next_state = self._stage if staged else self._step
        return loop_of(f"closed loop, {self.tableau.name}", next_state, self._layouts[staged], self.parameters, most)

    @property
    def staged(self) -> bool:
        """Whether the loop takes a stage at a time; before a motion one with the stage -1 then notes what is known there."""
        return self.loop.size == self._layouts[1].size

    @property
    def state(self) -> State:
        """What a state is made of."""
        return self._layouts[self.staged]

    @property
    def calls(self) -> int:
        """Of :attr:`single` in a step."""
        return len(self.tableau.rows) if self.staged else 1

    @cached_property
    @recalled
    def single(self) -> Kernel:
        """One step, or one stage of it, of a state: for whoever needs every one."""
        symbol = ca.SX.sym("state", self.state.size)
        after = (self._stage if self.staged else self._step)(self.state.split(symbol))
        return Kernel("one step", [symbol, *self.parameters], [self.state.join(after)])

    def _step(self, parts: dict[str, SX]) -> dict[str, SX]:
        h = lesser(parts["h"], self._until - parts["time"])
        rates, hands, shares = [parts["rates"]], [parts["hand"]], [parts["share"]]
        for row in self.tableau.rows[:-1]:
            here = self.system.at(parts["q"] + h * _mixed(row, rates))
            rates.append(here.rates)
            hands.append(here.hand)
            shares.append(here.share)
        end = parts["q"] + h * _mixed(self.tableau.rows[-1], rates)
        return self._finished(parts, h, rates, hands, shares, end, self.system.at(end))

    def _stage(self, parts: dict[str, SX]) -> dict[str, SX]:
        """One evaluation; the last one finishes the step."""
        n, rows = self.system.law.arm.n, self.tableau.rows
        h = lesser(parts["h"], self._until - parts["time"])
        rates = [parts["rates"], *[parts["k"][i * n : (i + 1) * n] for i in range(len(rows) - 1)]]
        weights = [
            sum(ca.if_else(parts["stage"] == i, row[k], 0.0) for i, row in enumerate(rows) if k < len(row))
            for k in range(len(rows))
        ]
        there = parts["q"] + h * _mixed(weights, rates)
        here = self.system.at(there)
        hands, shares = [parts["hand"], *ca.vertsplit(parts["hands"])], [parts["share"], *ca.vertsplit(parts["shares"])]
        finished = self._finished(parts, h, rates, hands, shares, there, here)
        good = ca.sumsqr(here.rates) < FAR
        stored = dict(parts)
        for name, value, width in (("k", here.rates, n), ("hands", here.hand, 1), ("shares", here.share, 1)):
            # A NaN in the state would stay there; a number this large has the step rejected.
            kept = ca.if_else(good, value, 1e30)
            old = parts[name]
            stored[name] = ca.vertcat(
                *[ca.if_else(parts["stage"] == i, kept, old[i * width : (i + 1) * width]) for i in range(len(rows) - 1)]
            )
        stored["stage"] = parts["stage"] + 1
        entering = parts["stage"] < 0
        for name, value in known_at(here).items():
            stored[name] = ca.if_else(entering, value, parts[name])
        finished["stage"] = ca.SX(0)
        for name in ("k", "hands", "shares"):
            finished[name] = parts[name]
        after = chosen(parts["stage"] == len(rows) - 1, finished, stored)
        return chosen(parts["code"] == RUNNING, after, parts)

    def _finished(
        self, parts: dict[str, SX], h: SX, rates: list[SX], hands: list[SX], shares: list[SX], end: SX, here: Here
    ) -> dict[str, SX]:
        """The state after a step, or the old state with a shorter step where the step was not good enough."""
        weights = self.tableau.rows[-1]
        running = parts["code"] == RUNNING
        rate = ca.sqrt(ca.sumsqr(here.rates))
        if self.tableau.errors:
            # Beside a singularity a stationary point pulls so strongly that errors allowed elsewhere would keep the arm moving.
            slow = greater(NEARLY * ca.sqrt(ca.sumsqr(parts["rates"])), FINEST)
            size = self._error(h, rates) / lesser(self._tolerance, slow) ** 2
            # A stage that met a singularity makes the estimate NaN, and every comparison with it false. The estimate does not
            # know the derivative at the end, with which the next step begins.
            usable = ca.logic_and(size < 1e20, ca.sumsqr(here.rates) < FAR)
            good = ca.logic_and(size <= 1, usable)
            root = ca.if_else(usable, size, 1.0) + 1e-20
            for _ in range(4):  # of the squared error of a method of order 8
                root = ca.sqrt(root)
            factor = ca.if_else(usable, lesser(greater(0.9 / root, 0.2), 10.0), 0.2)
            # A step cut short by the end of its phase says nothing against the step that was planned.
            grown = ca.if_else(h < parts["h"], greater(h * factor, parts["h"]), h * factor)
            longest = TURN / greater(rate, TURN / self.tableau.longest)
            after = ca.if_else(good, lesser(grown, longest), h * factor)
        else:
            good = ca.sumsqr(here.rates) < FAR
            after = ca.if_else(good, parts["h"], 0.0)
        time, clock = parts["time"] + h, parts["clock"] + h * _mixed(weights, shares)
        speed = rate / here.share
        closest, low, high = self._least_and_greatest(parts, h, rates, end, here)
        code = ca.if_else(time >= self._until - COLLAPSED, PHASE, RUNNING)
        code = ca.if_else(clock >= self._limit * (1 - 1e-12), TIME, code)
        code = ca.if_else(speed < REST_SPEED, REST, code)
        moved = {
            **parts,
            "q": end,
            "rates": here.rates,
            "hand": here.hand,
            "share": here.share,
            "error": here.squared_error,
            "slope": here.slope,
            "h": after,
            "time": time,
            "clock": clock,
            "path": parts["path"] + h * _mixed(weights, hands),
            "closest": closest,
            "low": low,
            "high": high,
            **watched(parts, speed, clock, self._limit),
            "code": code,
        }
        # Everything else stays as it was, also where the run has ended.
        code = ca.if_else(running, ca.if_else(after < COLLAPSED, COLLAPSE, RUNNING), parts["code"])
        return chosen(ca.logic_and(running, good), moved, {**parts, "h": after, "code": code})

    def _least_and_greatest(self, parts: dict[str, SX], h: SX, rates: list[SX], end: SX, here: Here) -> tuple[SX, SX, SX]:
        """Least squared error, least and greatest joint values so far: at both ends of the step and where a slope changes sign.

        A long step is looked at in two halves.
        """
        points = [(parts["q"], parts["rates"], parts["error"], parts["slope"])]
        if self.tableau.middle:
            way, slope = (_mixed(weights, [*rates, here.rates]) for weights in self.tableau.middle)
            e, j = self.system.error(parts["q"] + h * way)
            points.append((parts["q"] + h * way, slope, ca.sumsqr(e), -2 * ca.dot(e, j @ slope)))
        points.append((end, here.rates, here.squared_error, here.slope))
        span = h / (len(points) - 1)
        closest, low, high = parts["closest"], parts["low"], parts["high"]
        for (q0, rates0, error0, slope0), (q1, rates1, error1, slope1) in pairwise(points):
            squared = turning_value(error0, error1, span * slope0, span * slope1)
            turn = turning_value(q0, q1, span * rates0, span * rates1)
            closest = lesser(closest, lesser(squared, error1))
            low, high = lesser(low, lesser(turn, q1)), greater(high, greater(turn, q1))
        return closest, low, high

    def _error(self, h: SX, rates: list[SX]) -> SX:
        """Estimated mean squared error of a step."""
        assert self.tableau.errors is not None
        fifth, third = (ca.sumsqr(_mixed(weights, rates)) for weights in self.tableau.errors)
        return h * h * fifth * fifth / ((fifth + 0.01 * third + 1e-60) * rates[0].numel())


def _mixed(weights: Sequence[SX | float], values: Sequence[SX]) -> SX:
    """Weighted sum; weights that are the number 0 cost nothing."""
    total = ca.SX(0)
    for weight, value in zip(weights, values, strict=True):
        if not (isinstance(weight, float) and weight == 0):
            total = total + weight * value
    return total
