"""The closed loop in discrete control cycles: the command is held for a cycle while the arm follows the law.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 4; the sub-steps and the rule that stops are ours.
"""

from __future__ import annotations

import casadi as ca

from holdfast.arm import kinematics
from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.simulation.system import (
    ARRIVED,
    COLLAPSE,
    PHASE,
    REST,
    RUNNING,
    TIME,
    State,
    System,
    chosen,
    greater,
    lesser,
    loop_of,
    watched,
)

SUBSTEPS = 10
STILL, SLOWEST = 2e-5, 1e-6  # of a cycle's way at the speed limit; of the arm's own unit of length where there is no limit
PATIENCE = 50  # cycles one after the other in which the end effector moved less than that: at rest


class Cycles:
    """Sub-steps of control cycles of one system, as a loop over states.

    A state holds the configuration ``q``; the number of the ``substep``, the ``command`` held and where the end effector was
    (``place``) when the cycle began; the ``time`` in cycles; for how many cycles the end effector was ``still``; and, as for
    :class:`holdfast.simulation.runge_kutta.Steps`, path, closest approach, joint excursions, speeds and code.

    Parameters of a row, after those of the system: ``until`` and ``limit``, cycles; the ``radius`` of the target.
    """

    calls = 1  # of single in a step
    staged = False

    def __init__(self, system: System) -> None:
        self.system = system
        law = system.law
        n, m = law.arm.n, law.task.m
        self._still = SLOWEST * law.arm.length_unit if law.speed_limit is None else STILL * law.speed_limit
        self._until, self._limit, self._radius = (ca.SX.sym(x) for x in ("until", "limit", "radius"))
        self.parameters = [*system.given, self._until, self._limit, self._radius]
        scalars = dict.fromkeys(("error", "time", "clock", "path", "closest", "still"), 1)
        ends = {"low": n, "high": n, "slowest": 1, "early": 1, "late": 1, "code": 1}
        self.state = State(q=n, substep=1, command=m, place=3, **scalars, **ends)
        self.made_of = system

    @cached_property
    @recalled
    def loop(self) -> Loop:
        """The sub-steps repeated."""
        return loop_of("control cycles", self._next, self.state, self.parameters, SUBSTEPS)

    @cached_property
    @recalled
    def single(self) -> Kernel:
        """One sub-step of a state."""
        symbol = ca.SX.sym("state", self.state.size)
        return Kernel("one step", [symbol, *self.parameters], [self.state.join(self._next(self.state.split(symbol)))])

    def _next(self, parts: dict[str, SX]) -> dict[str, SX]:
        system, q = self.system, parts["q"]
        first, last = parts["substep"] == 0, parts["substep"] == SUBSTEPS - 1
        e, _ = system.error(q)
        v, share = system.command(e)
        at = chosen(first, self._begun(parts, e, v), parts)
        rates = system.rates(q, at["command"])
        speed = ca.sqrt(ca.sumsqr(rates)) / share
        q = q + rates * (system.law.gain / SUBSTEPS)
        time = parts["time"] + ca.if_else(last, 1.0, 0.0)
        moved = {
            **at,
            "q": q,
            "low": lesser(at["low"], q),
            "high": greater(at["high"], q),
            "substep": ca.if_else(last, 0.0, parts["substep"] + 1),
            "time": time,
            "clock": time,
        }
        moved |= chosen(first, watched(at, speed, parts["time"], self._limit), at)
        # A singular configuration makes the rates NaN, and the comparison false: the arm stays where it was.
        after = chosen(ca.sumsqr(q) < 1e30, moved, {**at, "code": ca.SX(COLLAPSE)})
        return chosen(at["code"] == RUNNING, after, at)

    def _begun(self, parts: dict[str, SX], e: SX, v: SX) -> dict[str, SX]:
        """What is noted, and decided, when a cycle begins."""
        place = kinematics.chain(self.system.law.arm, parts["q"]).position
        moved = ca.if_else(parts["time"] > 0, ca.sqrt(ca.sumsqr(place - parts["place"])), 0.0)
        still = ca.if_else(ca.logic_and(parts["time"] > 0, moved < self._still), parts["still"] + 1, 0.0)
        error = ca.sumsqr(e)
        code = ca.if_else(parts["time"] >= self._limit, TIME, RUNNING)
        code = ca.if_else(still >= PATIENCE, REST, code)
        code = ca.if_else(error <= self._radius * self._radius, ARRIVED, code)
        noted = {
            **parts,
            "command": v,
            "place": place,
            "error": error,
            "path": parts["path"] + moved,
            "closest": lesser(parts["closest"], error),
            "still": still,
            "code": code,
        }
        # The next phase begins this cycle again with another joint locked: nothing may be noted twice.
        ends = ca.logic_and(parts["time"] >= self._until, parts["time"] < self._limit)
        after = chosen(ends, {**parts, "code": ca.SX(PHASE)}, noted)
        return chosen(parts["code"] == RUNNING, after, parts)
