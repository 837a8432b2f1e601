"""Locks that a motion along a path survives, and the possible improvement."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.files.output import write_table
from holdfast.core.probability.intervals import Interval
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.path_following.trajectory import Trajectory
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance
from holdfast.response.lock_survival.conditions import MotionConditions
from holdfast.response.lock_survival.dynamic_program import SearchBounds
from holdfast.response.lock_survival.injection import LockTests, can_finish_path, interpolate_motion, sample_lock_times
from holdfast.response.lock_survival.lock_evaluation import has_joint_finished_moving
from holdfast.response.lock_survival.problem import Kind, Mode, SurvivalProblem
from holdfast.response.lock_survival.rates import FailureRates
from holdfast.response.lock_survival.timed_motion import VelocityJump, make_trajectory

_PROBABILITY_TOLERANCE = 1e-9  # differences of probabilities below this are rounding errors


@dataclass(frozen=True, eq=False, kw_only=True)
class BaselineMotion:
    """Survival of another motion along the same path.

    Attributes:
        name: Method that planned the motion.
        survival: Survival as in :class:`LockSurvival`.
        curve: (T,) survival of a lock at each time, as from ``LockSurvival.curve()``.
        off: Fraction of the samples at which the motion is off the path, violates a constraint, or has no configuration; a
            lock there counts as lost.
    """

    name: str
    survival: float
    curve: FloatArray
    off: float


@dataclass(frozen=True, eq=False, kw_only=True)
class LockSurvival(Result):
    """Single locks that a motion along a path survives, at T times.

    A lock stops a joint at once and permanently. It is survived if the rest of the path can still be followed. Later locks are
    not counted.

    Attributes:
        arm, task: Arm, and the rows of the path that it follows.
        path: Pose of the tool as a function of time.
        mode: ``on-path``: the failed arm continues from its configuration, at its own pace, and its tool never leaves the path.
            ``detour``: the tool may leave the path and return to it.
        rates: Failure rates of the joints.
        time: (T,) samples, s.
        poses: (T, 4, 4) poses of the tool in the world, m.
        q: (T, n) configurations of the motion, rad and m.
        survives: (T, n) True where a lock of the joint at that time is survived.
        kept: Collision model and margin, m, of the motion and the failed arm; None if collisions are not checked.
        keep: Tool constraints before and after the lock, anchored at the first pose.
        found: Results of the search for the best motion; None for a given motion.
        kind: Kind of every probability: ``exact``, up to the grid; ``upper bound``, because detours among obstacles or with
            constraints are not searched for; ``lower bound``, because with more than one degree of redundancy not every
            continuation after a lock is evaluated.
        comparisons: Other motions along the path.
        injected: Results of :meth:`test_locks`, or None.
    """

    arm: Arm
    task: Task
    path: TimedPath
    mode: Mode
    rates: FailureRates
    time: FloatArray
    poses: FloatArray
    q: FloatArray
    survives: BoolArray
    kept: tuple[Clearance, float] | None = None
    keep: tuple[ToolConstraint, ...] = ()
    found: SearchBounds | None = None
    kind: Kind = "exact"
    comparisons: tuple[BaselineMotion, ...] = ()
    injected: LockTests | None = None
    _problem: SurvivalProblem = field(repr=False)

    @classmethod
    def for_motion(
        cls, problem: SurvivalProblem, q: FloatArray, *, survives: BoolArray, found: SearchBounds | None = None
    ) -> LockSurvival:
        """Return the result for a motion.

        Args:
            problem: Problem of the path.
            q: (T, n) configurations of the motion, rad and m.
            survives: (T, n) True where a lock is survived.
            found: Results of the search. None: the motion was given.
        """
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
            kept=problem.conditions.required_clearance,
            keep=problem.conditions.constraints,
            found=found,
            kind=problem.kind,
            _problem=problem,
        )

    @property
    def survival(self) -> float:
        """Probability that the path is finished, given that one joint locks on the way."""
        return self._weighted_mean(self.curve())

    @property
    def survival_bound(self) -> float | None:
        """Upper bound on the survival of any motion, up to the grid; None for a given motion, and where no bound is known."""
        return None if self.found is None or self.kind == "lower bound" else self.found.bound

    @property
    def gap(self) -> float | None:
        """Upper bound on the distance of the motion from the optimum."""
        return None if self.survival_bound is None else max(self.survival_bound - self.survival, 0.0)

    @property
    def interval(self) -> tuple[float, float] | None:
        """Survival of the best motions of the grid, within the velocity limits and with the spacing on top; see ``found``."""
        return None if self.found is None else self.found.interval

    def curve(self) -> FloatArray:
        """Return the probability (T,) that a lock at that time is survived, averaged over the joints."""
        return np.asarray(np.round(self.survives @ self.rates.each / self.rates.total, 12))

    @cached_property
    def by_joint(self) -> dict[str, float]:
        """Probability that a lock of each joint is survived, at any time."""
        return {
            name: self._weighted_mean(probability)
            for name, probability in zip(self.arm.joint_names, self.survives.T.astype(np.float64), strict=True)
        }

    @property
    def survives_all_locks(self) -> bool:
        """True if every lock at every sample is survived, for joints that can fail."""
        return bool((self.curve() >= 1 - _PROBABILITY_TOLERANCE).all())

    @property
    def safe_from(self) -> float:
        """Time in s from which every lock is survived. At the end of the path every lock is survived."""
        unsafe = np.flatnonzero(self.curve() < 1 - _PROBABILITY_TOLERANCE)
        return float(self.time[0] if not unsafe.size else self.time[min(unsafe[-1] + 1, len(self.time) - 1)])

    @property
    def safe_until(self) -> float | None:
        """Time in s up to which every lock is survived; None if a lock at the start is not."""
        unsafe = np.flatnonzero(self.curve() < 1 - _PROBABILITY_TOLERANCE)
        last_safe = unsafe[0] - 1 if unsafe.size else len(self.time) - 1
        return float(self.time[last_safe]) if last_safe >= 0 else None

    @property
    def worst(self) -> tuple[float, float]:
        """Time in s at which a lock is survived least, and its probability."""
        sample = int(self.curve().argmin())
        return float(self.time[sample]), float(self.curve()[sample])

    @property
    def loss_probability(self) -> float | None:
        """Probability that a lock occurs and loses the path, with rates per second; None without."""
        if not self.rates.per_second:
            return None
        return float(self.rates.weights(self.time) @ ((1 - self.curve()) * self.rates.total))

    @cached_property
    def never(self) -> tuple[float, str] | None:
        """First sample in s at which no configuration survives every lock, and a joint whose lock is lost there.

        No motion at all then survives every lock. None if there is no such sample, for a given motion, or for a lower bound.
        """
        if self.found is None or self.kind == "lower bound":
            return None
        counts = self.rates.each > 0
        for sample, survives in enumerate(self.found.survives):
            if not survives[:, counts].all(axis=1).any():
                fractions = np.where(counts, survives.mean(axis=0), np.inf)
                return float(self.time[sample]), self.arm.joint_names[int(fractions.argmin())]
        return None

    @cached_property
    def rates_of_joints(self) -> FloatArray:
        """Joint velocities (T, n) in rad/s and m/s, by differences."""
        return np.asarray(np.gradient(self.q, self.time, axis=0, edge_order=2 if len(self.time) > 2 else 1))

    @cached_property
    def speed(self) -> float:
        """Largest fraction of a joint's velocity limit from sample to sample; a motion above 1 is too fast."""
        velocity = np.array([joint.velocity for joint in self.arm.joints])
        return float((np.abs(np.diff(self.q, axis=0)) / np.diff(self.time)[:, None] / velocity).max())

    @cached_property
    def jump(self) -> VelocityJump:
        """Velocity of the end effector that is lost when a joint stops at once."""
        twists = self.arm.jacobian(self.q) * self.rates_of_joints[:, None, :]
        linear, angular = (np.linalg.norm(twist_part, axis=1) for twist_part in (twists[:, :3], twists[:, 3:]))
        joint_probabilities = self.rates.each / self.rates.total
        return VelocityJump(
            linear=linear,
            angular=angular,
            mean_linear=self._weighted_mean(linear @ joint_probabilities),
            mean_angular=self._weighted_mean(angular @ joint_probabilities),
        )

    @cached_property
    def motion(self) -> Trajectory:
        """Motion for a controller, at five times as many samples, with a local measure of fault tolerance as objective."""
        return make_trajectory(self._problem, self.q)

    @check_arguments
    @reports_progress("injecting locks")
    def test_locks(self, locks: int = 1000, *, seed: int = 1) -> LockTests:
        """Test the motion with joints that lock at random times, and count how often the failed arm finishes.

        On the path, another integrator than that of the lock tables follows the failed arm along the arc of its branch with
        Runge-Kutta steps. With detours, inverse kinematics must find a configuration of every remaining sample. Joints are
        sampled by their rates and times uniformly; with rates per second, as first failures within the duration.

        Args:
            locks: Number of locks.
            seed: Seed of the random times and joints.

        Raises:
            InputError: ``locks`` is below 1.
        """
        if locks < 1:
            raise InputError(f"locks is {locks}; it must be 1 or more")
        generator = np.random.default_rng(np.random.SeedSequence(seed))
        lock_times, locked_joints = sample_lock_times(self._problem, locks, generator)
        survived = can_finish_path(
            self._problem, interpolate_motion(self._problem, self.q, lock_times), lock_times, locked_joints, q_start=self.q[0]
        )
        sample_before = np.clip(np.searchsorted(self.time, lock_times, side="right") - 1, 0, len(self.time) - 2)
        survived |= has_joint_finished_moving(self._problem, self.q)[sample_before, locked_joints]
        expected = self.survives[sample_before, locked_joints]
        return LockTests(
            time=lock_times,
            joint=locked_joints,
            survived=survived,
            expected=expected,
            told=expected == self.survives[sample_before + 1, locked_joints],
            interval=Interval.from_counts(float(survived.sum()), locks),
        )

    def to_csv(self, file: str | Path) -> Path:
        """Write the motion to the CSV file ``file``: time, joints, and survival of a lock at that time; return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        header = ["time_s", *(f"{joint.name}_{joint.unit}" for joint in self.arm.joints), "survival"]
        rows = np.column_stack([self.time, self.q, self.curve()])
        return write_table(file, "motion", header, rows, ["%.12g"] * len(header))

    def _weighted_mean(self, values: FloatArray) -> float:
        weights = self.rates.weights(self.time)
        return round(float(weights @ values / weights.sum()), 12)  # exactly 1 if all values are 1

    @property
    def conditions(self) -> MotionConditions:
        """Conditions that every configuration satisfies, before a lock and after it."""
        return self._problem.conditions

    @property
    def redundancy(self) -> int:
        """Number of joints beyond the rows of the path."""
        return self._problem.redundancy
