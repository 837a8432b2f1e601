"""Explicit Runge-Kutta steps with a step size for each row of a batch, each step a straight-line program.

The step-size control is part of the program, so that a batch needs nothing but its repetition. A law of many operations is
evaluated once per call instead of once per stage: compiling it seven times over would take minutes.

Source: Dormand and Prince 1980, the pair RK5(4)7M; Hairer, Norsett, Wanner 1993, section II.4 for the control.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from holdfast.kernels import SX
from holdfast.simulate.motion import (
    COLLAPSE,
    FAR,
    PHASE,
    REST,
    RUNNING,
    TIME,
    Here,
    State,
    System,
    chosen,
    greater,
    lesser,
    loop_of,
    turning_value,
    watched,
)

REST_SPEED = 1e-8  # rad (and m) per 1/Ke: at rest
COLLAPSED = 1e-12  # of 1/Ke: steps this short lead nowhere
LONGEST = 2.5  # of 1/Ke: beyond it the method is not stable for the rate Ke at which the error itself shrinks
NEARLY = 1e-4  # rad (and m) per 1/Ke: below this speed the tolerance shrinks with it
TURN = 0.5  # rad (and m): a longer step would see too little of the way
FIRST = 1e-2  # of 1/Ke
_SMALL = 2500  # operations of one evaluation: beyond, stages are taken one at a time
_UNROLL = 8


@dataclass(frozen=True)
class Tableau:
    """A method whose last stage is the new state, so that its derivative serves the next step too.

    Attributes:
        name: For people.
        rows: Row i holds the weights of the derivatives before stage i + 1; the last row is the step itself.
        error: Weights of the error estimate; empty for a fixed step.
    """

    name: str
    rows: tuple[tuple[float, ...], ...]
    error: tuple[float, ...] = ()


DORMAND_PRINCE = Tableau(
    "Dormand-Prince 5(4)",
    (
        (1 / 5,),
        (3 / 40, 9 / 40),
        (44 / 45, -56 / 15, 32 / 9),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
        (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
    ),
    (71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40),
)
CLASSIC = Tableau("Runge-Kutta 4", ((1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)))


class Steps:
    """Runge-Kutta steps of one system under one method, as a loop over states.

    A state holds the configuration ``q`` and what is known there (``rates``, speed of the ``hand``, ``share``, ``error``
    squared and its ``slope``); the next step ``h`` and the ``time``, both in 1/Ke; the ``clock``, which counts time as if no
    speed limit slowed the motion; the ``path`` of the hand, m; the ``closest`` squared error so far; the least and greatest
    joint values ``low`` and ``high``; the speeds ``slowest``, ``early`` and ``late`` of the end; and its ``code``.

    Parameters of a row, after those of the system: ``until``, the time at which the phase ends; the ``limit`` of the clock;
    the ``tolerance`` of a step, rad (and m).
    """

    def __init__(self, system: System, tableau: Tableau) -> None:
        self.system, self.tableau = system, tableau
        n, stages = system.law.arm.n, len(tableau.rows)
        self._until, self._limit, self._tolerance = (ca.SX.sym(x) for x in ("until", "limit", "tolerance"))
        self.parameters = [*system.parameters, self._until, self._limit, self._tolerance]
        size = ca.Function("at", [system.q, *system.parameters], [system.at(system.q).rates], {"cse": True}).n_instructions()
        self.staged = int(size) > _SMALL
        kept = {"stage": 1, "k": n * (stages - 1), "hands": stages - 1, "shares": stages - 1} if self.staged else {}
        scalars = dict.fromkeys(("hand", "share", "error", "slope", "h", "time", "clock", "path", "closest"), 1)
        ends = {"low": n, "high": n, "slowest": 1, "early": 1, "late": 1, "code": 1}
        self.state = State(q=n, rates=n, **scalars, **ends, **kept)
        self._next = self._stage if self.staged else self._step
        self.loop, self.unrolled = loop_of(
            f"closed loop, {tableau.name}",
            self._next,
            self.state,
            self.parameters,
            stages * _UNROLL if self.staged else _UNROLL,
        )

    def single(self) -> ca.Function:
        """One step, or one stage of it, of a state: for those who want to see every one."""
        symbol = ca.SX.sym("state", self.state.size)
        return ca.Function("step", [symbol, *self.parameters], [self.state.join(self._next(self.state.split(symbol)))])

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
        if self.tableau.error:
            # Beside a singularity a rest point pulls so strongly that errors allowed elsewhere would keep the arm moving.
            slow = lesser(greater(ca.sqrt(ca.sumsqr(parts["rates"])) / NEARLY, 1e-3), 1.0)
            error = h * _mixed(self.tableau.error, [*rates, here.rates]) / (slow * self._tolerance)
            size = ca.sumsqr(error) / error.numel()
            good = size <= 1
            # A stage that met a singularity makes the estimate NaN, and every comparison with it false.
            usable = size < 1e20
            factor = ca.if_else(usable, 0.9 * ca.exp(-0.1 * ca.log(ca.if_else(usable, size, 1.0) + 1e-12)), 0.2)
            factor = lesser(greater(factor, 0.2), 5.0)
            # A step cut short by the end of its phase says nothing against the step that was planned.
            grown = ca.if_else(h < parts["h"], greater(h * factor, parts["h"]), h * factor)
            longest = TURN / greater(rate, TURN / LONGEST)
            after = ca.if_else(good, lesser(grown, longest), h * factor)
        else:
            good = ca.sumsqr(here.rates) < FAR
            after = ca.if_else(good, parts["h"], 0.0)
        time, clock = parts["time"] + h, parts["clock"] + h * _mixed(weights, shares)
        speed = rate / here.share
        squared = turning_value(parts["error"], here.squared_error, h * parts["slope"], h * here.slope)
        turn = turning_value(parts["q"], end, h * parts["rates"], h * here.rates)
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
            "closest": lesser(parts["closest"], lesser(squared, here.squared_error)),
            "low": lesser(parts["low"], lesser(turn, end)),
            "high": greater(parts["high"], greater(turn, end)),
            **watched(parts, speed, clock, self._limit),
            "code": code,
        }
        # Everything else stays as it was, also where the run has ended.
        code = ca.if_else(running, ca.if_else(after < COLLAPSED, COLLAPSE, RUNNING), parts["code"])
        return chosen(ca.logic_and(running, good), moved, {**parts, "h": after, "code": code})


def _mixed(weights: Sequence[SX | float], values: Sequence[SX]) -> SX:
    """Weighted sum; weights that are the number 0 cost nothing."""
    total = ca.SX(0)
    for weight, value in zip(weights, values, strict=True):
        if not (isinstance(weight, float) and weight == 0):
            total = total + weight * value
    return total
