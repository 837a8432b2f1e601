"""What a motion along a path survives, and how much better one could be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.clearance.clearance import Clearance
from holdfast.endurance.injection import Injection, drawn_locks, finished, healthy
from holdfast.endurance.problem import Kind, Mode, Problem
from holdfast.endurance.rates import FailureRates
from holdfast.endurance.timed_motion import VelocityJump, as_trajectory
from holdfast.errors import InputError
from holdfast.files.output import write_table
from holdfast.keep.kept import Kept
from holdfast.motion.trajectory import Trajectory
from holdfast.notice import says
from holdfast.paths.timed_path import TimedPath
from holdfast.probability.intervals import Interval
from holdfast.result import Result
from holdfast.words import percent

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

_LITTLE, _STILL = 0.3, 1e-6  # rad and m along a whole curve
_WHOLE = 1e-9  # of a probability: less is rounding
_AT: dict[Kind, str] = {"exact": "", "upper bound": "at most ", "lower bound": "at least "}


@dataclass(frozen=True, eq=False, kw_only=True)
class Found:
    """What a search over all motions of the grid knows.

    Attributes:
        bound: No motion survives more, up to the grid: what the best motion over the nodes would survive if it found at each
            the best of all places up to halfway to its neighbours, with the spacing on top of the velocity limits.
        interval: The most that motions over the nodes survive: of those that keep to the velocity limits, and of those that may
            exceed them by the spacing from pose to pose, as nodes are no finer. NaN: no such motion.
        spacing: Of the nodes, rad (and m).
        nodes: T arrays (P, n) of configurations, all that were found.
        curve: T arrays (P,) with the number of their curve.
        survives: T arrays (P, n): True where a lock there is survivable.
        moved: (n,) how far the self-motion moves each joint, at most, along one curve of one pose, rad and m.
        held: Joints that the motions looked at do not move, and where they are, rad and m; none with one degree of redundancy.
    """

    bound: float
    interval: tuple[float, float]
    spacing: float
    nodes: Sequence[Array]
    curve: Sequence[Index]
    survives: Sequence[Flags]
    moved: Array
    held: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, kw_only=True)
class Compared:
    """What another motion along the same path survives.

    Attributes:
        name: What made it.
        survival: As of :class:`Endurance`.
        curve: (T,) as there, at the same times.
        off: Fraction of the samples at which it is off the path, breaks what is kept, or has no configuration; nothing is
            survived there.
    """

    name: str
    survival: float
    curve: Array
    off: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Endurance(Result):
    """Which single locks a motion along a path survives, at T times.

    A lock stops a joint at once and for good; it is survived if the rest of the path can still be followed. Later locks are
    not counted.

    Attributes:
        arm, task: What moves, and which rows of the path it keeps.
        path: Where the tool is to be, and when.
        mode: ``on-path``: the failed arm goes on from where it is, at its own pace, and its tool never leaves the path.
            ``detour``: it may leave the path and come back to it.
        rates: Of the joints.
        time: (T,) s.
        poses: (T, 4, 4) of the tool in the world.
        q: (T, n) the motion, rad and m.
        survives: (T, n) True where a lock of the joint at that time is survived.
        kept: What the motion and the failed arm keep clear of, and by how much, m; or None.
        keep: What the tool keeps beside the path, before the lock and after it, through the first pose.
        found: What the search for the best motion knows; None for a motion that was given.
        kind: Of every probability: ``exact``, up to the grid; ``upper bound``, of detours among obstacles or with something
            kept, which are not looked for; ``lower bound``, with more than one degree of redundancy, where not every way on
            after a lock is looked at.
        beside: Other motions along the path.
        injected: Locks that were tried on it, if somebody did; see :meth:`inject`.
    """

    arm: Arm
    task: Task
    path: TimedPath
    mode: Mode
    rates: FailureRates
    time: Array
    poses: Array
    q: Array
    survives: Flags
    kept: tuple[Clearance, float] | None = None
    keep: tuple[Kept, ...] = ()
    found: Found | None = None
    kind: Kind = "exact"
    beside: tuple[Compared, ...] = ()
    injected: Injection | None = None
    _problem: Problem = field(repr=False)

    @classmethod
    def of(cls, problem: Problem, q: Array, *, survives: Flags, found: Found | None = None) -> Endurance:
        """Of a motion (T, n), with its verdicts (T, n)."""
        return cls(
            arm=problem.arm,
            task=problem.task,
            path=problem.path,
            mode=problem.mode,
            rates=problem.rates,
            time=problem.time,
            poses=problem.lock.poses,
            q=q,
            survives=survives,
            kept=problem.conditions.room,
            keep=problem.conditions.keep,
            found=found,
            kind=problem.kind,
            _problem=problem,
        )

    @property
    def survival(self) -> float:
        """Probability that the path is finished, given that one joint locks on the way."""
        return self._mean(self.curve())

    @property
    def bound(self) -> float | None:
        """No motion survives more, up to the grid; None for a motion that was given, and where nobody knows."""
        return None if self.found is None or self.kind == "lower bound" else self.found.bound

    @property
    def gap(self) -> float | None:
        """How far the motion is from the bound, at most."""
        return None if self.bound is None else max(self.bound - self.survival, 0.0)

    @property
    def interval(self) -> tuple[float, float] | None:
        """The best of the grid within the velocity limits, and with the spacing on top; see ``found``."""
        return None if self.found is None else self.found.interval

    def curve(self) -> Array:
        """(T,) probability that a lock at that time is survived, whichever joint it is."""
        return np.asarray(np.round(self.survives @ self.rates.each / self.rates.total, 12))

    @cached_property
    def by_joint(self) -> dict[str, float]:
        """Probability that a lock of each joint is survived, whenever it is."""
        return {name: self._mean(x) for name, x in zip(self.arm.joint_names, self.survives.T.astype(np.float64), strict=True)}

    @property
    def guaranteed(self) -> bool:
        """True if every lock at every sample is survived, of joints that can fail."""
        return bool((self.curve() >= 1 - _WHOLE).all())

    @property
    def safe_from(self) -> float:
        """Every lock from this sample on is survived, s. At the end of the path nothing is left to be lost."""
        lost = np.flatnonzero(self.curve() < 1 - _WHOLE)
        return float(self.time[0] if not lost.size else self.time[min(lost[-1] + 1, len(self.time) - 1)])

    @property
    def safe_until(self) -> float | None:
        """Every lock up to this sample is survived, s; None if one at the very start is not."""
        lost = np.flatnonzero(self.curve() < 1 - _WHOLE)
        last = lost[0] - 1 if lost.size else len(self.time) - 1
        return float(self.time[last]) if last >= 0 else None

    @property
    def worst(self) -> tuple[float, float]:
        """When a lock is survived least, s, and with what probability."""
        k = int(self.curve().argmin())
        return float(self.time[k]), float(self.curve()[k])

    @property
    def lost(self) -> float | None:
        """Probability that a lock comes and loses the path, with rates per second; None without."""
        if not self.rates.per_second:
            return None
        return float(self.rates.weights(self.time) @ ((1 - self.curve()) * self.rates.total))

    @cached_property
    def never(self) -> tuple[float, str] | None:
        """The first sample, s, at which no configuration of the pose survives every lock, and the joint that is lost.

        So no motion at all is guaranteed. None if there is no such sample, or if the motion was given, or of a lower bound.
        """
        if self.found is None or self.kind == "lower bound":
            return None
        counts = self.rates.each > 0
        for t, survives in enumerate(self.found.survives):
            if not survives[:, counts].all(axis=1).any():
                share = np.where(counts, survives.mean(axis=0), np.inf)
                return float(self.time[t]), self.arm.joint_names[int(share.argmin())]
        return None

    @cached_property
    def rates_of_joints(self) -> Array:
        """(T, n) rad/s and m/s, by differences."""
        return np.asarray(np.gradient(self.q, self.time, axis=0, edge_order=2 if len(self.time) > 2 else 1))

    @cached_property
    def speed(self) -> float:
        """Largest fraction of a joint's velocity limit that the motion takes from sample to sample; above 1: it is too fast."""
        velocity = np.array([j.velocity for j in self.arm.joints])
        return float((np.abs(np.diff(self.q, axis=0)) / np.diff(self.time)[:, None] / velocity).max())

    @cached_property
    def jump(self) -> VelocityJump:
        """What the end effector's velocity loses when a joint stops at once."""
        twists = self.arm.jacobian(self.q) * self.rates_of_joints[:, None, :]
        linear, angular = (np.linalg.norm(x, axis=1) for x in (twists[:, :3], twists[:, 3:]))
        share = self.rates.each / self.rates.total
        return VelocityJump(
            linear=linear,
            angular=angular,
            mean_linear=self._mean(linear @ share),
            mean_angular=self._mean(angular @ share),
        )

    @cached_property
    def motion(self) -> Trajectory:
        """The motion for a controller, at five times as many samples, each on its pose; its objective is what a local measure
        of fault tolerance says of it.
        """
        return as_trajectory(self._problem, self.q)

    @checked
    @says("injecting locks")
    def inject(self, locks: int = 1000, *, seed: int = 1) -> Injection:
        """Try the motion: joints that lock at random times, and whether the failed arm gets to the end.

        On the path the failed arm is followed by another integrator than the table's, along the arc of its branch with steps of
        Runge and Kutta; with detours, inverse kinematics must find a configuration of every sample still to come. Joints are
        drawn by their rates, and times evenly; with rates per second, as failures come that come before the end.

        Args:
            locks: How many.
            seed: Of the draws.

        Raises:
            InputError: Fewer than one lock.
        """
        if locks < 1:
            raise InputError(f"locks is {locks}; it must be 1 or more")
        generator = np.random.default_rng(np.random.SeedSequence(seed))
        time, joint = drawn_locks(self._problem, locks, generator)
        survived = finished(self._problem, healthy(self._problem, self.q, time), time, joint, begin=self.q[0])
        before = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        survived |= self._problem.stays(self.q)[before, joint]
        expected = self.survives[before, joint]
        return Injection(
            time=time,
            joint=joint,
            survived=survived,
            expected=expected,
            told=expected == self.survives[before + 1, joint],
            interval=Interval.of(float(survived.sum()), locks),
        )

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion as rows: time, joints, and the probability that a lock then is survived.

        Raises:
            StoreError: It cannot be written.
        """
        header = ["time_s", *(f"{j.name}_{j.unit}" for j in self.arm.joints), "survival"]
        rows = np.column_stack([self.time, self.q, self.curve()])
        return write_table(file, "motion", header, rows, ["%.12g"] * len(header))

    def _mean(self, values: Array) -> float:
        weights = self.rates.weights(self.time)
        return round(float(weights @ values / weights.sum()), 12)  # all of them are 1, not almost

    def _set_by_the_pose(self) -> list[str]:
        """Why some locks are hardly survived by any motion, of full poses above all that of an elbow."""
        if self.found is None or self.kind == "lower bound":
            return []
        joints = np.flatnonzero((self.found.moved <= _LITTLE) & (self.rates.each > 0) & ~self.survives.all(axis=0))
        lines = []
        for joint, most in zip([self.arm.joints[k] for k in joints], self.found.moved[joints], strict=True):
            far = f" by more than {most:.3g} {joint.unit}" if most > _STILL else ""
            lines.append(
                f"no self-motion moves {joint.name}{far}: the pose sets it (of an elbow between spherical shoulder and wrist "
                "their distance does), so that its lock is survived only while that hardly changes"
            )
        return lines

    @property
    def headline(self) -> str:
        """The answer in a sentence."""
        if self.guaranteed:
            return "every lock of a joint, at any sample of the path, is survived"
        most = "" if self.bound is None else f"; no motion along this path survives more than {percent(self.bound)}"
        return f"{_AT[self.kind]}{percent(self.survival)} of all locks of a joint on the way are survived{most}"

    def describe(self) -> list[str]:
        """A few sentences for people."""
        how = "without leaving the path" if self.mode == "on-path" else "with detours"
        lines = [f"{self.arm.title}, {self.path.describe()}, {how}: {self.headline}"]
        if self.kind == "lower bound":
            cone = ", or the axis that is kept in a cone and fewer joints" if self._problem.conditions.left else ""
            lines.append(
                "a lower bound: after a lock the failed arm has redundancy left, and of its ways on only those are followed "
                f"that hold {self._problem.spare - 1} more of its joints{cone}"
                if self.mode == "on-path"
                else "a lower bound: of the poses to come only what inverse kinematics found with the joint locked counts"
            )
        elif self.found is not None:
            low, high = self.found.interval
            within = "within the velocity limits " + ("none is found" if np.isnan(low) else f"the best survives {percent(low)}")
            lines.append(
                f"no motion survives more than {percent(self.found.bound)} up to the grid of {len(self.time)} poses and "
                f"{self.found.spacing:g} rad; over its nodes {within}, with the spacing on top of them {percent(high)}"
            )
        if self.kept is not None and self.kind != "lower bound":
            lines.append("clearance is judged by shapes that cover the links; the arm is smaller and may survive more")
        if self.keep:
            alone = "" if self._problem.conditions.left else ", by the rows of the path alone"
            lines.append(f"kept at every sample, before a lock and after it{alone}: {'; '.join(map(str, self.keep))}")
        if not self.guaranteed:
            when, least = self.worst
            lines.append(
                f"by joint: {', '.join(f'{name} {percent(x)}' for name, x in self.by_joint.items())}; "
                f"worst at {when:.4g} s, where {percent(least)} are survived; from {self.safe_from:.4g} s on all are"
            )
        if self.beside:
            lines.append("beside it: " + ", ".join(f"{other.name} {percent(other.survival)}" for other in self.beside))
        if self.injected is not None:
            count, p = len(self.injected.time), self.injected.interval
            lines.append(
                f"of {count} locks injected at random times {percent(p.value)} were survived ({percent(p.low)} to "
                f"{percent(p.high)}, 95 %), {percent(self.injected.alike)} of them as the motion says"
            )
        if self.never is not None:
            when, name = self.never
            lines.append(f"no motion survives all: at {when:.4g} s no configuration survives every lock, least of all {name}'s")
        lines += self._set_by_the_pose()
        if self.speed > 1 + _WHOLE:
            lines.append(f"the motion takes {self.speed:.3g} times the velocity limit of a joint: slow the path down")
        if self.lost is not None:
            lines.append(f"probability that a lock loses the path: {self.lost:.3g}")
        if self.kind == "upper bound":
            where = "that keep what is kept" if self.keep else "among obstacles"
            lines.append(f"detours {where} were not looked for: every probability is an upper bound")
        jump = self.jump
        lines.append(
            f"when a joint stops at once the tool loses at most {jump.most_linear:.3g} m/s and {jump.most_angular:.3g} rad/s, "
            f"in the mean {jump.mean_linear:.3g} m/s and {jump.mean_angular:.3g} rad/s"
        )
        return lines
