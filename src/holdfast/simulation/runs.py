"""How the motions of a failed arm ended, with the evidence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from enum import IntEnum
from pathlib import Path as File
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.result import Result
from holdfast.words import capitalised

if TYPE_CHECKING:
    from holdfast.clearance.clearance import Clearance
    from holdfast.clearance.contacts import Contact
    from holdfast.control.law import Law

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


CHECKED_SPAN = 200.0  # 1/Ke: the part of a motion that repeats itself which is checked for contacts


class Outcome(IntEnum):
    """How one run ended."""

    CONVERGED = 0
    STUCK = 1
    MOVING = 2
    UNDECIDED = 3

    @property
    def sentence(self) -> str:
        """What it means, said of the end effector."""
        return _ENDS[self]


_ENDS = {
    Outcome.CONVERGED: "reaches the target",
    Outcome.STUCK: "stops elsewhere",
    Outcome.MOVING: "never stops: it repeats its motion",
    Outcome.UNDECIDED: "is undecided",
}


class Reason(IntEnum):
    """Why a run is undecided, beside its :class:`Outcome`; ``NONE`` where it is decided. No status: a run has an outcome.

    ``CONTACT`` is of runs that were stopped where they touched something.
    """

    NONE = 0
    SINGULAR = 1
    TIME_LIMIT = 2
    STEPS = 3
    BAD_INPUT = 4
    HALF_TURN = 5
    CONTACT = 6

    @property
    def sentence(self) -> str:
        """What it means and what to try."""
        return _SENTENCES[self]


_SENTENCES = {
    Reason.NONE: "decided",
    Reason.SINGULAR: "the motion ran into a singular configuration, where the law has no answer: its steps shrank to nothing",
    Reason.TIME_LIMIT: "still moving at the time limit, and not found to repeat the motion: give a longer time_limit",
    Reason.STEPS: "the motion took 100,000 steps, as it does close to a singular configuration: look at it with path()",
    Reason.HALF_TURN: (
        "the end effector was half a turn from its target, where the shortest turn flips from one instant to the next and the "
        "steps shrink to next to nothing: bring the target nearer to its orientation by poses in between, or leave the "
        "orientation free"
    ),
    Reason.CONTACT: "the arm was stopped where it first touched something",
    Reason.BAD_INPUT: "the start, the target or a lock held NaN or infinity: look at where it came from",
}

UNDECIDED = tuple(reason for reason in Reason if reason not in (Reason.NONE, Reason.CONTACT))


@dataclass(frozen=True)
class Path:
    """One run over time.

    Attributes:
        time: (T,) s, or cycles.
        q: (T, n) rad and m.
        x: (T, 3) tool point in the world, m.
        error: (T,) norm of the task's error, m and rad.
        position_error: (T,) distance of the tool point from the target in the directions of the task, m.
        angle_error: (T,) angle of the end effector from the target in the directions of the task, rad.
        locked: (T, n) True where the joint is locked.
    """

    time: Array
    q: Array
    x: Array
    _: KW_ONLY
    error: Array
    position_error: Array
    angle_error: Array
    locked: Flags


@dataclass(frozen=True)
class Setting:
    """How runs were made.

    Attributes:
        limit: s, or cycles.
        accuracy: Tolerance of a step, or radius of the target in cycles.
        step: Of the fixed-step method, s.
    """

    limit: float
    accuracy: float
    step: float


class _Motion(Protocol):
    """What computed the runs, as far as they ask it again."""

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> tuple[Array, Array]: ...
    def errors(self, runs: Runs, k: int | Flags, q: Array) -> tuple[Array, Array]: ...
    def sample_path(self, runs: Runs, k: int, at: Callable[[Array], Array], time: Array) -> Path: ...
    def path(self, runs: Runs, k: int, samples: int, until: float | None) -> Path: ...
    def run(self, q0: Array, target: Array, lock_time: Array, setting: Setting) -> Runs: ...
    def recorded(self, runs: Runs, k: int, end: float) -> tuple[Array, Callable[[Array], Array]]: ...


@dataclass(frozen=True, kw_only=True)
class Runs(Result):
    """N runs of the closed loop, or one (then without the leading N).

    Norms of errors put metres and radians of the task's rows side by side, as the law's own command does.

    Attributes:
        law: The law of the controller.
        q0: (N, n) starts, rad and m.
        target: (N, 4, 4), or (N, m) where it was given so.
        lock_time: (N, n) when each joint locks, s or cycles; 0 from the start, infinite: never.
        cycles: Time counts in control cycles.
        code: (N,) :class:`holdfast.simulation.Outcome`.
        reason: (N,) :class:`holdfast.simulation.Reason`.
        q_final: (N, n) where the run ended, not wrapped.
        x_final: Where the end effector ended, in the form of ``target``.
        error: (N,) norm of the task's error at the end.
        closest: (N,) least norm of the error on the way.
        path_length: (N,) m, of the tool point.
        q_low, q_high: (N, n) least and greatest value of each joint on the way.
        limits_passed: (N, n) True where a joint left its limits; the motion does not heed them.
        time: (N,) s, or cycles, when it ended.
        clearance: What the arm was to keep clear of, or None: then nobody looked. It changes no run that is not stopped.
        contacts: First of each pair that touches, of all runs, in order of run and time; None if nobody looked.
        stopped: (N,) when a run was stopped at its first contact, infinite for never; None if none was to be.
    """

    law: Law
    q0: Array
    target: Array
    lock_time: Array
    cycles: bool
    code: NDArray[np.uint8]
    reason: NDArray[np.uint8]
    q_final: Array
    x_final: Array
    error: Array
    closest: Array
    path_length: Array
    q_low: Array
    q_high: Array
    limits_passed: Flags
    time: Array
    clearance: Clearance | None = None
    contacts: tuple[Contact, ...] | None = None
    stopped: Array | None = None
    _motion: _Motion = field(repr=False, compare=False)
    _setting: Setting = field(repr=False, compare=False)

    def __len__(self) -> int:
        return int(np.size(self.code))

    @property
    def outcome(self) -> NDArray[np.str_]:
        """(N,) ``converged``, ``stuck``, ``moving`` or ``undecided``."""
        return np.asarray(_NAMES[self.code])

    @property
    def position_error(self) -> Array:
        """(N,) distance of the tool point from the target at the end in the directions of the task, m."""
        return self._ends[0]

    @property
    def angle_error(self) -> Array:
        """(N,) angle of the end effector from the target at the end in the directions of the task, rad."""
        return self._ends[1]

    @cached_property
    def _ends(self) -> tuple[Array, Array]:
        q = np.atleast_2d(self.q_final)
        known = np.asarray(np.isfinite(q).all(axis=1))
        found = np.full((2, len(q)), np.nan)
        found[:, known] = self._motion.errors(self, known, q[known])
        return (found[0], found[1]) if self.code.ndim else (found[0, 0], found[1, 0])

    @property
    def held_from(self) -> Array:
        """(N, n) when each joint stops for good, by its lock or because the run was stopped, s or cycles."""
        held = np.atleast_2d(self.lock_time)
        return held if self.stopped is None else np.minimum(held, np.atleast_1d(self.stopped)[:, None])

    @property
    def first_contacts(self) -> tuple[Contact | None, ...]:
        """(N,) what each run touches first; None where it touches nothing, or nobody looked."""
        found = {c.run: c for c in reversed(self.contacts or ())}  # of each run the first comes last
        return tuple(found.get(k) for k in range(len(self)))

    def ending_sentence(self, k: int = 0) -> str:
        """Return how run k ended, a phrase about the end effector that names the time limit where the limit ended the run."""
        reason = Reason(int(np.atleast_1d(self.reason)[k]))
        if reason == Reason.TIME_LIMIT:
            return f"is still moving at the limit of {self._setting.limit:.6g} {self.unit}"
        outcome = Outcome(int(np.atleast_1d(self.code)[k])).sentence
        return outcome if reason == Reason.NONE else f"{outcome}: {reason.sentence}"

    @property
    def unit(self) -> str:
        """``s``, or ``cycles``."""
        return "cycles" if self.cycles else "s"

    def checked_until(self, k: int = 0) -> float:
        """Return the time up to which run k is checked for contacts, s or cycles: its end, unless it repeats its motion."""
        end, repeats = float(np.atleast_1d(self.time)[k]), np.atleast_1d(self.code)[k] == Outcome.MOVING
        return min(end, CHECKED_SPAN / self.law.gain) if repeats else end

    def counts(self) -> dict[str, int]:
        """How many runs ended in each way."""
        found = np.bincount(np.atleast_1d(self.code), minlength=len(Outcome))
        return {str(name): int(count) for name, count in zip(_NAMES, found, strict=True)}

    @checked
    @says("looking for the least errors")
    def least_error(self, restarts: int = 24, seed: int = 0) -> Array:
        """(N,) least norm of the task's error that each arm can have with its locked joints where they were at the end.

        Found by damped least squares over the healthy joints, starting where the run ended and from random configurations,
        joint limits left aside as in the run itself: an upper bound of the true least, never above the run's own end.

        Raises:
            InputError: Fewer than 0 restarts.
        """
        if restarts < 0:
            raise InputError(f"restarts is {restarts}; it must be 0 or more")
        least, _ = self._motion.least_error(self, restarts, np.random.default_rng(seed))
        return least if self.code.ndim else least[0]

    @property
    def excess_error(self) -> Array:
        """(N,) error at the end minus :meth:`least_error`: 0 where the arm ends as close as it still could."""
        return np.asarray(self.error - self.least_error())

    @checked
    def path(self, k: int = 0, samples: int = 400, until: float | None = None) -> Path:
        """Run k again, sampled at equal times, each as exact as the run itself; in cycles, linear between the sub-steps.

        Args:
            k: Which run, from 0.
            samples: How many.
            until: Up to this time, s or cycles; the whole run if not given.

        Raises:
            InputError: No such run, one that had bad input, or fewer than 2 samples.
        """
        if not 0 <= k < len(self):
            raise InputError(f"there is no run {k}; runs are 0 to {len(self) - 1}")
        if samples < 2:
            raise InputError(f"samples is {samples}; it must be 2 or more")
        if np.atleast_1d(self.reason)[k] == Reason.BAD_INPUT:
            raise InputError(f"run {k} has no path: {Reason.BAD_INPUT.sentence}")
        return self._motion.path(self, k, samples, until)

    def to_csv(self, file: str | File, k: int = 0) -> File:
        """Write run k as rows over time, from its start to its end: joint positions, tool point (m), position and angle error.

        Raises:
            InputError: No such run.
            StoreError: It cannot be written.
        """
        written: File = self._presented("to_csv", File(file), k)
        return written

    def limits_sentence(self, k: int = 0) -> str:
        """Whether the joints of run k stayed within their limits, for people; empty for an arm without limits.

        It goes with the outcome and does not follow from it: the motion does not heed limits.
        """
        arm, low, high = self.law.arm, np.atleast_2d(self.q_low)[k], np.atleast_2d(self.q_high)[k]
        if not np.isfinite([arm.lower, arm.upper]).any():
            return ""
        past = []
        for joint, name, least, most in zip(arm.joints, arm.joint_names, low, high, strict=True):
            factor, unit = joint.shown
            for value, end, beyond in ((least, joint.lower, least < joint.lower), (most, joint.upper, most > joint.upper)):
                if beyond:
                    past.append(f"{name} goes to {factor * value:.4g} {unit} (limit {factor * end:.4g} {unit})")
        if not past:
            return "All joints stay within their limits."
        return f"On the way {' and '.join(past)}: a real arm would stop there."

    def contact_sentence(self, k: int | None = None) -> str:
        """What run k touched first, or how many of all runs touched what, for people; empty if nobody looked."""
        if self.contacts is None:
            return ""
        if k is None and len(self) > 1:
            touching = len({c.run for c in self.contacts})
            things = Counter(c.object for c in self.contacts)
            what = ", ".join(f"{thing} by {count} link{'' if count == 1 else 's'}" for thing, count in things.most_common(3))
            return f"{touching} of them touch something on the way" + (f" ({what}, all runs together)" if what else "")
        own = [c for c in self.contacts if c.run == (k or 0)]
        if not own:
            whole, checked = float(np.atleast_1d(self.time)[k or 0]), self.checked_until(k or 0)
            if checked < whole:
                return f"The arm touches nothing in the first {checked:g} s; its motion after them was not checked."
            return "The arm touches nothing on the way."
        unit, ends = self.unit, self.stopped is not None
        more = "" if len(own) == 1 else f", the first of {len(own)} contacts"
        return f"{capitalised(own[0].sentence(unit))}{more}{': the run is stopped there' if ends else ''}."

    def describe(self) -> list[str]:
        """A few sentences for people."""
        counts = self.counts()
        lines = [
            f"{len(self)} runs of {self.law.describe()} on '{self.law.arm.name}': "
            + ", ".join(f"{count} {name}" for name, count in counts.items())
        ]
        past = np.atleast_2d(self.limits_passed).any(axis=1)
        if past.any():
            there = int((past & (np.atleast_1d(self.code) == Outcome.CONVERGED)).sum())
            lines.append(f"{int(past.sum())} of them pass a joint limit on the way, {there} of these converge")
        reasons = np.atleast_1d(self.reason)
        for reason in UNDECIDED:
            if (reasons == reason).any():
                limit = f", {self._setting.limit:.6g} {self.unit}" if reason == Reason.TIME_LIMIT else ""
                lines.append(f"{int((reasons == reason).sum())} undecided{limit}: {reason.sentence}")
        return [*lines, *[x for x in (self.contact_sentence(),) if x]]


_NAMES = np.array([o.name.lower() for o in Outcome])
