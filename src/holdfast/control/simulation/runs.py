"""Outcomes of the motions of a failed arm, with the evidence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path as File
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.formatting import capitalise_first
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.status import SentenceEnum
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments

if TYPE_CHECKING:
    from holdfast.control.laws.law import Law
    from holdfast.model.collision.clearance import Clearance
    from holdfast.model.collision.contacts import Contact


CHECKED_SPAN = 200.0  # 1/Ke: duration for which a motion that repeats itself is checked for contacts


class RunOutcome(SentenceEnum):
    """Outcome of one run."""

    CONVERGED = 0, "reaches the target"
    STUCK = 1, "stops elsewhere"
    MOVING = 2, "never stops: it repeats its motion"
    UNDECIDED = 3, "is undecided"


class Reason(SentenceEnum):
    """Reason for which a run is undecided, in addition to its :class:`RunOutcome`; ``NONE`` if it is decided.

    ``CONTACT`` marks runs that were stopped at a contact. A reason is not a :class:`holdfast.Status`.
    """

    NONE = 0, "decided"
    SINGULAR = 1, "the motion ran into a singular configuration, where the law has no answer: its steps shrank to nothing"
    TIME_LIMIT = 2, "still moving at the time limit, and not found to repeat the motion: give a longer time_limit"
    STEPS = 3, "the motion took 100,000 steps, as it does close to a singular configuration: inspect it with path()"
    BAD_INPUT = 4, "the start, the target or a lock held NaN or infinity: look at where it came from"
    HALF_TURN = (
        5,
        "the end effector was half a turn from its target, where the direction of the shortest rotation keeps changing and the "
        "steps shrink to almost nothing: approach the orientation of the target by poses in between, or leave the "
        "orientation free",
    )
    CONTACT = 6, "the arm was stopped where it first touched something"


UNDECIDED_REASONS = tuple(reason for reason in Reason if reason not in (Reason.NONE, Reason.CONTACT))


@dataclass(frozen=True)
class RunPath:
    """One run at T sampled times.

    Attributes:
        time: (T,) simulated time, s or cycles.
        q: (T, n) configuration, rad and m.
        x: (T, 3) tool point in the world, m.
        error: (T,) norm of the task's error, m and rad.
        position_error: (T,) distance of the tool point from the target in the directions of the task, m.
        angle_error: (T,) angle of the end effector from the target in the directions of the task, rad.
        locked: (T, n) True if the joint is locked.
    """

    time: FloatArray
    q: FloatArray
    x: FloatArray
    _: KW_ONLY
    error: FloatArray
    position_error: FloatArray
    angle_error: FloatArray
    locked: BoolArray


_LINE_SAMPLES = 2000  # of a run, for its distance from a straight line


@dataclass(frozen=True)
class RunSettings:
    """Settings with which runs were simulated."""

    time_limit: float  # s, or cycles
    accuracy: float  # tolerance of a step, or radius of the target in cycles
    step_size: float  # of the fixed-step method, s


class _Simulator(Protocol):
    """Simulator of the runs, for later questions about them."""

    def least_error(self, runs: Runs, restarts: int, generator: np.random.Generator) -> tuple[FloatArray, FloatArray]: ...
    def compute_errors(self, runs: Runs, run: int | BoolArray, q: FloatArray) -> tuple[FloatArray, FloatArray]: ...
    def sample_path(self, runs: Runs, run: int, motion: Callable[[FloatArray], FloatArray], time: FloatArray) -> RunPath: ...
    def path(self, runs: Runs, run: int, samples: int, until: float | None) -> RunPath: ...
    def run(self, q0: FloatArray, target: FloatArray, lock_time: FloatArray, setting: RunSettings) -> Runs: ...
    def replay_run(self, runs: Runs, run: int, end: float) -> tuple[FloatArray, Callable[[FloatArray], FloatArray]]: ...


@dataclass(frozen=True, kw_only=True)
class Runs(Result):
    """Result of N simulated runs of the closed loop; for a single run, arrays lack the axis N.

    Norms of errors combine metres and radians of the task's rows with equal weights, as in the command of the law.

    Attributes:
        law: The control law.
        q0: (N, n) configurations at the start, rad and m.
        target: (N, 4, 4) tool poses in the world, or (N, m) task components in m, as in the call.
        lock_time: (N, n) time at which each joint locks, s or cycles; 0 from the start, infinite for never.
        cycles: True if time is counted in control cycles.
        code: (N,) :class:`holdfast.control.simulation.RunOutcome` of each run.
        reason: (N,) :class:`holdfast.control.simulation.Reason` of each run.
        q_final: (N, n) configuration at the end, rad and m, not wrapped.
        x_final: Poses or task components of the end effector at the end, in the form of ``target``.
        error: (N,) norm of the task's error at the end, m and rad.
        closest: (N,) least norm of the error during the run, m and rad.
        path_length: (N,) length of the path of the tool point, m.
        q_low: (N, n) least value of each joint during the run, rad and m.
        q_high: (N, n) greatest value of each joint during the run, rad and m.
        limits_passed: (N, n) True if a joint left its limits, which the motion does not enforce.
        time: (N,) simulated time at the end, s or cycles.
        clearance: Collision model for the check of contacts; None if they were not checked. It only changes stopped runs.
        contacts: First contact of each pair in all runs, in order of run and time; None if contacts were not checked.
        stopped: (N,) time at which a run was stopped at its first contact, infinite for never; None without such stops.
    """

    law: Law
    q0: FloatArray
    target: FloatArray
    lock_time: FloatArray
    cycles: bool
    code: NDArray[np.uint8]
    reason: NDArray[np.uint8]
    q_final: FloatArray
    x_final: FloatArray
    error: FloatArray
    closest: FloatArray
    path_length: FloatArray
    q_low: FloatArray
    q_high: FloatArray
    limits_passed: BoolArray
    time: FloatArray
    clearance: Clearance | None = None
    contacts: tuple[Contact, ...] | None = None
    stopped: FloatArray | None = None
    _simulator: _Simulator = field(repr=False, compare=False)
    _settings: RunSettings = field(repr=False, compare=False)

    def __len__(self) -> int:
        return int(np.size(self.code))

    @property
    def outcome(self) -> NDArray[np.str_]:
        """(N,) outcome of each run as text: ``converged``, ``stuck``, ``moving`` or ``undecided``."""
        return np.asarray(_OUTCOME_NAMES[self.code])

    @property
    def position_error(self) -> FloatArray:
        """(N,) distance of the tool point from the target at the end in the directions of the task, m."""
        return self._end_errors[0]

    @property
    def angle_error(self) -> FloatArray:
        """(N,) angle of the end effector from the target at the end in the directions of the task, rad."""
        return self._end_errors[1]

    @cached_property
    def _end_errors(self) -> tuple[FloatArray, FloatArray]:
        q = np.atleast_2d(self.q_final)
        is_finite = np.asarray(np.isfinite(q).all(axis=1))
        errors = np.full((2, len(q)), np.nan)
        errors[:, is_finite] = self._simulator.compute_errors(self, is_finite, q[is_finite])
        return (errors[0], errors[1]) if self.code.ndim else (errors[0, 0], errors[1, 0])

    @property
    def held_from(self) -> FloatArray:
        """(N, n) time from which on each joint is held, by its lock or because the run was stopped, s or cycles."""
        lock_times = np.atleast_2d(self.lock_time)
        return lock_times if self.stopped is None else np.minimum(lock_times, np.atleast_1d(self.stopped)[:, None])

    @property
    def first_contacts(self) -> tuple[Contact | None, ...]:
        """(N,) first contact of each run; None for a run without contact, or if contacts were not checked."""
        contact_by_run = {contact.run: contact for contact in reversed(self.contacts or ())}  # the first of a run remains
        return tuple(contact_by_run.get(run) for run in range(len(self)))

    def ending_sentence(self, k: int = 0) -> str:
        """Return a phrase on how run ``k`` ended, for the subject *end effector*; it names a time limit that ended the run."""
        reason = Reason(int(np.atleast_1d(self.reason)[k]))
        if reason == Reason.TIME_LIMIT:
            return f"is still moving at the limit of {self._settings.time_limit:.6g} {self.unit}"
        outcome = RunOutcome(int(np.atleast_1d(self.code)[k])).sentence
        return outcome if reason == Reason.NONE else f"{outcome}: {reason.sentence}"

    @property
    def unit(self) -> str:
        """Unit of time, which is ``s`` or ``cycles``."""
        return "cycles" if self.cycles else "s"

    def checked_until(self, k: int = 0) -> float:
        """Return the time up to which run ``k`` is checked for contacts, s or cycles.

        This is its end, or at most 200/Ke if the run repeats its motion.
        """
        end_time, is_periodic = float(np.atleast_1d(self.time)[k]), np.atleast_1d(self.code)[k] == RunOutcome.MOVING
        return min(end_time, CHECKED_SPAN / self.law.gain) if is_periodic else end_time

    def counts(self) -> dict[str, int]:
        """Return the number of runs with each outcome."""
        run_counts = np.bincount(np.atleast_1d(self.code), minlength=len(RunOutcome))
        return {str(name): int(count) for name, count in zip(_OUTCOME_NAMES, run_counts, strict=True)}

    @check_arguments
    @reports_progress("searching for the least errors")
    def least_error(self, restarts: int = 24, seed: int = 0) -> FloatArray:
        """Find the least norm (N,) of the task's error, m and rad, that each arm can have with the joints locked at the end.

        Damped least squares over the healthy joints start at the end of the run and at random configurations. Joint limits are
        ignored, as in the run. The result is an upper bound of the true least error, and never above the error of the run.

        Args:
            restarts: Number of random configurations from which the search starts, 0 or more.
            seed: Seed of these configurations.

        Raises:
            InputError: There are fewer than 0 restarts.
        """
        if restarts < 0:
            raise InputError(f"restarts is {restarts}; it must be 0 or more")
        least_errors, _ = self._simulator.least_error(self, restarts, np.random.default_rng(seed))
        return least_errors if self.code.ndim else least_errors[0]

    @property
    def excess_error(self) -> FloatArray:
        """(N,) error at the end minus :meth:`least_error`, m and rad; 0 if the arm ends as close as it still can."""
        return np.asarray(self.error - self.least_error())

    @check_arguments
    def path(self, k: int = 0, samples: int = 400, until: float | None = None) -> RunPath:
        """Simulate run k again, and sample it at equal times.

        Each sample is as accurate as the run itself; in cycles it is interpolated linearly between the sub-steps.

        Args:
            k: Index of the run, from 0.
            samples: Number of samples, 2 or more.
            until: Time of the last sample, s or cycles. Default: the end of the run.

        Raises:
            InputError: There is no such run, it had bad input, or there are fewer than 2 samples.
        """
        if samples < 2:
            raise InputError(f"samples is {samples}; it must be 2 or more")
        self._check_run(k)
        return self._simulator.path(self, k, samples, until)

    def _check_run(self, k: int) -> None:
        if not 0 <= k < len(self):
            raise InputError(f"there is no run {k}; give an index from 0 to {len(self) - 1}")
        if np.atleast_1d(self.reason)[k] == Reason.BAD_INPUT:
            raise InputError(f"run {k} has no path: {Reason.BAD_INPUT.sentence}")

    def line_deviation(self, k: int = 0, until: float | None = None) -> float:
        """Return the largest distance of run ``k``'s tool point from the straight line between its start and its target, m.

        Only the components of the position that the task prescribes count. The run is sampled at 2000 times, most of them at
        the beginning, where the arm moves fastest.

        Args:
            k: Index of the run, from 0.
            until: Last time that counts, s or cycles. Default: the end of the run.

        Raises:
            InputError: There is no such run, or it had bad input.
        """
        self._check_run(k)
        rows = self.law.task.rows[:, :3]
        end = min(float(np.atleast_1d(self.time)[k]), np.inf if until is None else until)
        q = self._simulator.replay_run(self, k, end)[1](end * np.linspace(0.0, 1.0, _LINE_SAMPLES) ** 3)
        components = self.law.arm.forward_kinematics(q)[:, :3, 3] @ rows.T
        is_pose = self.target.shape[-2:] == (4, 4)
        targets = self.target.reshape(-1, 4, 4)[:, :3, 3] @ rows.T if is_pose else np.atleast_2d(self.target)
        target = targets[min(k, len(targets) - 1)]
        line = target - components[0]
        fraction = np.clip((components - components[0]) @ line / max(float(line @ line), 1e-300), 0.0, 1.0)
        return float(np.linalg.norm(components - components[0] - fraction[:, None] * line, axis=1).max())

    def to_csv(self, file: str | File, k: int = 0) -> File:
        """Write run ``k`` to ``file`` as rows over time: joint positions, tool point (m), position and angle error.

        Raises:
            InputError: There is no such run.
            StoreError: The file cannot be written.
        """
        written: File = self._present("to_csv", File(file), k)
        return written

    def limits_sentence(self, k: int = 0) -> str:
        """Return a sentence on whether the joints of run ``k`` stayed within their limits; empty for an arm without limits.

        The sentence supplements the outcome, because the motion does not enforce limits.
        """
        arm, lowest, highest = self.law.arm, np.atleast_2d(self.q_low)[k], np.atleast_2d(self.q_high)[k]
        if not np.isfinite([arm.lower, arm.upper]).any():
            return ""
        violations = []
        for joint, minimum, maximum in zip(arm.joints, lowest, highest, strict=True):
            factor, unit = joint.display_unit
            for value, limit, passes in (
                (minimum, joint.lower, minimum < joint.lower),
                (maximum, joint.upper, maximum > joint.upper),
            ):
                if passes:
                    violations.append(f"{joint.name} goes to {factor * value:.4g} {unit} (limit {factor * limit:.4g} {unit})")
        if not violations:
            return "All joints stay within their limits."
        return f"On the way {' and '.join(violations)}: a real arm would stop there."

    def contact_sentence(self, k: int | None = None) -> str:
        """Return a sentence on the first contact of run ``k``, or for None on all runs; empty if contacts were not checked."""
        if self.contacts is None:
            return ""
        if k is None and len(self) > 1:
            touching = len({contact.run for contact in self.contacts})
            counts = Counter(contact.object for contact in self.contacts).most_common(3)
            objects = ", ".join(f"{name} by {count} link{'' if count == 1 else 's'}" for name, count in counts)
            return f"{touching} of them touch something on the way" + (f" ({objects}, all runs together)" if objects else "")
        run_contacts = [contact for contact in self.contacts if contact.run == (k or 0)]
        if not run_contacts:
            end_time, checked_time = float(np.atleast_1d(self.time)[k or 0]), self.checked_until(k or 0)
            if checked_time < end_time:
                return f"The arm touches nothing in the first {checked_time:g} s; its motion after them was not checked."
            return "The arm touches nothing on the way."
        remark = "" if len(run_contacts) == 1 else f", the first of {len(run_contacts)} contacts"
        remark += "" if self.stopped is None else ": the run is stopped there"
        return f"{capitalise_first(run_contacts[0].sentence(self.unit))}{remark}."


_OUTCOME_NAMES = np.array([o.name.lower() for o in RunOutcome])
