"""The failed arm as a system of differential equations, and what is recorded along a motion.

The controller knows of no failure: it commands ``G(q) Ke e``, and locked joints do not follow. With ``mask`` 0 for
a locked joint and 1 for a healthy one, ``q' = mask G(q) Ke e(q)``.

Time is in units of ``1/Ke`` here, so that thresholds are free of units.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (3), (6), (7).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.solvers.inverse_kinematics import scaled_error, task_error

Array = NDArray[np.float64]

FAR = 1e300  # stands for "never" in kernels, which turn infinity into NaN
UNROLLED = 12_000  # operations in one call, about


@dataclass(frozen=True)
class Here:
    """What is known at one configuration, in units of ``1/Ke``.

    Attributes:
        rates: (n,) joint rates, 0 for locked joints.
        hand: Tool speed, m.
        share: By how much the speed limit slows the command: 1 where it does not act.
        squared_error: Of the task's rows, m and rad.
        slope: Its derivative by time.
    """

    rates: SX
    hand: SX
    share: SX
    squared_error: SX
    slope: SX


class System:
    """The symbols of a law and its target, and the motion they make."""

    def __init__(self, law: Law) -> None:
        self.law = law
        self.q = kinematics.joint_symbols(law.arm)
        self.mask = ca.SX.sym("mask", law.arm.n)
        self.target, self.rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        self.parameters = [self.target, self.rotation, self.mask]
        self._turns = law.task.angular or law.task.frame != "base"
        self.made_of = law
        # What the motion needs to know: no orientation where no row of the task has one.
        self.given = self.parameters if self._turns else [self.target, self.mask]

    def numbers(self, target: Array) -> Array:
        """Targets, poses (N, 4, 4) or the task's rows (N, m), as the numbers of ``given`` before the mask, (N, ...)."""
        if target.ndim == 2:
            return np.asarray(target @ self.law.task.rows[:, :3])
        positions = target[:, :3, 3]
        return np.concatenate([positions, target[:, :3, :3].reshape(-1, 9)], axis=1) if self._turns else positions

    def error(self, q: SX) -> tuple[SX, SX]:
        """Error (m,) of the task's rows, m and rad, and their Jacobian (m, n)."""
        return task_error(self.law.arm, self.law.task, q, self.target, self.rotation)

    def scaled_error(self, q: SX) -> tuple[SX, SX]:
        """As :meth:`error`, with lengths in units of the arm's own, for what has a threshold."""
        return scaled_error(self.law.arm, self.law.task, q, self.target, self.rotation)

    def command(self, e: SX) -> tuple[SX, SX]:
        """Commanded task velocity (m,) in units of ``1/Ke``, and how far the speed limit slows it."""
        v = self.law.command(e) / self.law.gain
        if self.law.speed_limit is None:
            return v, ca.SX(1)
        size = ca.sumsqr(e)
        return v, ca.if_else(size > 0, ca.dot(v, e) / ca.if_else(size > 0, size, 1.0), 1.0)

    def rates(self, q: SX, v: SX) -> SX:
        """Joint rates (n,) of the failed arm for a command v."""
        return self.mask * self.law.rates(q, v)

    def hand_speed(self, q: SX, rates: SX) -> SX:
        """Speed of the tool point, m."""
        return ca.sqrt(ca.sumsqr(kinematics.jacobian(self.law.arm, q)[:3, :] @ rates))

    @cached_property
    def function(self) -> ca.Function:
        """What :meth:`at` tells, of q and ``given``: a law takes a second to write down, so that is done once."""
        q = self.q
        e, j = self.error(q)
        v, share = self.command(e)
        rates = self.rates(q, v)
        # Exact also for turns: the length of log R changes with the part of the angular velocity along it.
        known = [rates, self.hand_speed(q, rates), share, ca.sumsqr(e), -2 * ca.dot(e, j @ rates)]
        return ca.Function("at", [q, *self.given], known, {"cse": True})

    def at(self, q: SX) -> Here:
        """Everything at a configuration q (n,)."""
        return Here(*self.function(q, *self.given))


def prescribed_way(law: Law, hand: Array, target: Array) -> Array:
    """(N, 3) from tools to targets, poses (N, 4, 4), in the directions that the task prescribes, m."""
    linear = law.task.rows[:, :3]
    into = linear.T @ linear
    way = target[:, :3, 3] - hand[:, :3, 3]
    if law.task.frame == "base":
        return np.asarray(way @ into)
    turn = hand[:, :3, :3]
    return np.asarray(np.einsum("nij,jk,nlk,nl->ni", turn, into, turn, way))


def split_errors(law: Law, error: Array, tool: Array, target: Array) -> tuple[Array, Array]:
    """Split norms of the task's error into position errors and angle errors.

    Args:
        law: The control law.
        error: (N,) norms over the task's rows, m and rad.
        tool: (N, 4, 4) tool poses, or whatever where the task has no angular row.
        target: (N, 4, 4) targets, likewise.

    Returns:
        (N,) m, and (N,) rad, which is 0 where the task has no angular row.
    """
    if not law.task.angular:
        return np.asarray(error), np.zeros(np.shape(error))
    linear = np.linalg.norm(prescribed_way(law, tool, target), axis=1)
    return linear, np.sqrt(np.maximum(error**2 - linear**2, 0.0))


def tool_errors(law: Law, q: Array, error: Array, target: Array) -> tuple[Array, Array]:
    """Compute position errors (N,), m, and angle errors (N,), rad, as :func:`split_errors`, at q (N, n) for a target or N."""
    return split_errors(law, error, law.arm.forward_kinematics(q), np.broadcast_to(target, (len(q), 4, 4)))


def own_units(law: Law, error: Array, hand: Array, target: Array) -> Array:
    """Norms of errors (N,), m and rad, with lengths in units of the arm's own; places and targets as they have them."""
    linear, angular = split_errors(law, error, hand, target)
    return np.asarray(np.hypot(linear / law.arm.length_unit, angular))


def known_at(here: Here) -> dict[str, SX]:
    """What a state holds of where it is."""
    return {
        "rates": here.rates,
        "hand": here.hand,
        "share": here.share,
        "error": here.squared_error,
        "slope": here.slope,
    }


class State:
    """Named scalars and vectors, one after the other, as the state of a loop."""

    def __init__(self, **sizes: int) -> None:
        self.slices: dict[str, slice] = {}
        at = 0
        for name, size in sizes.items():
            self.slices[name] = slice(at, at + size)
            at += size
        self.size = at

    def split(self, state: SX) -> dict[str, SX]:
        """The parts of a state symbol by name."""
        return {name: state[where] for name, where in self.slices.items()}

    def values(self, state: Array) -> dict[str, Array]:
        """The parts of states (N, s) by name, each (N, size), views of them."""
        return {name: state[:, where] for name, where in self.slices.items()}

    def join(self, parts: dict[str, SX]) -> SX:
        """A state from its parts."""
        return ca.vertcat(*[parts[name] for name in self.slices])


def lesser(a: SX, b: SX) -> SX:
    """Elementwise, without fmin."""
    return ca.if_else(a < b, a, b)


def greater(a: SX, b: SX) -> SX:
    """Elementwise, without fmax."""
    return ca.if_else(a > b, a, b)


def turning_value(start: SX, end: SX, slope: SX, end_slope: SX) -> SX:
    """What lies between two ends with these slopes (per step) where the slope changes sign: the value there, else ``end``.

    The place is that of a parabola, the value that of the cubic; being flat there, it is as good as the cubic's own.
    """
    turns = slope * end_slope < 0
    x = ca.if_else(turns, slope / ca.if_else(turns, slope - end_slope, 1.0), 1.0)
    y = 1 - x
    return end + y * (y * ((1 + 2 * x) * (start - end) + x * slope) - x * x * end_slope)


def chosen(condition: SX, yes: dict[str, SX], no: dict[str, SX]) -> dict[str, SX]:
    """Part by part, one or the other."""
    return {name: ca.if_else(condition, value, no[name]) for name, value in yes.items()}


# Where a motion is: the code in the state of a loop.
RUNNING, REST, COLLAPSE, TIME, PHASE, ARRIVED = range(6)
WINDOW, HALF = 0.8, 0.9  # shares of the time limit: the end of a motion is watched from the first on, in two halves


def watched(parts: dict[str, SX], speed: SX, clock: SX, limit: SX) -> dict[str, SX]:
    """The speeds noted near the end of the time limit: least, and greatest of the first and of the second half."""
    inside, second = clock >= WINDOW * limit, clock >= HALF * limit
    return {
        "slowest": ca.if_else(inside, lesser(parts["slowest"], speed), parts["slowest"]),
        "early": ca.if_else(ca.logic_and(inside, ca.logic_not(second)), greater(parts["early"], speed), parts["early"]),
        "late": ca.if_else(second, greater(parts["late"], speed), parts["late"]),
    }


def loop_of(
    name: str, step: Callable[[dict[str, SX]], dict[str, SX]], state: State, parameters: Sequence[SX], most: int
) -> Loop:
    """A loop that repeats a step until the state has a code; cheap steps are taken several at a time.

    Args:
        name: For messages.
        step: From the parts of a state to those of the next; it leaves a state with a code as it is.
        state: What the state is made of, with a part ``code``.
        parameters: Symbols.
        most: Steps at most in one call.

    Returns:
        The loop; its ``times`` tells how many steps one of its own takes.
    """
    symbol = ca.SX.sym("state", state.size)
    after = state.join(step(state.split(symbol)))
    times = 1
    if most > 1:
        once = ca.Function("step", [symbol, *parameters], [after], {"cse": True})
        times = max(1, min(most, UNROLLED // int(once.n_instructions())))
        for _ in range(times - 1):
            after = once(after, *parameters)
    running = ca.if_else(state.split(after)["code"] == RUNNING, 1.0, 0.0)
    return Loop(name, symbol, parameters, next_state=after, residual=running, ahead=True, times=times)
