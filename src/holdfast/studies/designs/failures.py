"""Simulation of how often failed arms of many designs reach their target, with all designs in one batch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.control.simulation.closed_loop import simulate
from holdfast.control.simulation.residual import SolutionSearch
from holdfast.control.simulation.runs import RunOutcome
from holdfast.control.simulation.system import scale_errors
from holdfast.core.typing import FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.model.arm.configurations import sampling_limits
from holdfast.studies.designs.joints import LawOfDesigns

# Time limit and tolerance of a run, as in a convergence map.
RUN_TIME_CONSTANTS = 500.0
RUN_TOLERANCE = 1e-8
CONVERGED_DISTANCE = 1e-3  # rad, and fraction of the arm's own length: an undecided run this close to its target has converged
_STARTS_PER_CONFIGURATION = 40  # random starts of inverse kinematics for each requested configuration


@dataclass(frozen=True, eq=False)
class ConvergenceOutcomes:
    """Outcomes of D designs at T targets, after C failures of each joint.

    Attributes:
        converged: (D, T, C, n) True if the target was reached.
        known: (D, T, C) True if there was a configuration at the target, from which the locked values are taken.
        ends: (D, 4) number of runs by :class:`holdfast.control.simulation.RunOutcome`; undecided runs next to the target count
            as converged.
    """

    converged: NDArray[np.bool_]
    known: NDArray[np.bool_]
    ends: NDArray[np.int64]

    @property
    def reached_fraction(self) -> FloatArray:
        """(D,) fraction of the targets for which a configuration was found."""
        return np.asarray(self.known.any(axis=2).mean(axis=1))

    @property
    def fraction_by_target(self) -> FloatArray:
        """(D, T) fraction of the failures of a target after which it is still reached; NaN for a target out of reach."""
        count = self.known.sum(axis=2)
        with np.errstate(invalid="ignore"):
            fractions = self.converged.mean(axis=3).sum(axis=2) / np.where(count > 0, count, np.nan)
        return np.asarray(fractions)

    @property
    def mean_fraction(self) -> FloatArray:
        """(D,) mean fraction over the targets; targets out of reach count as 0."""
        return np.asarray(np.nan_to_num(self.fraction_by_target).mean(axis=1))


class FailureTrials:
    """Equal failures for every design, with targets and random numbers for configurations and starts.

    A joint locks at its value in a configuration at the target, so that the target stays in reach. The arm starts from a random
    configuration with this joint at the locked value.

    Args:
        law: Control law of all designs.
        poses: (T, 4, 4) tool poses of the targets in the world, m.
        count: Number C of failures of each joint for each target.
        seed: Seed of the random numbers.
    """

    def __init__(self, law: LawOfDesigns, poses: FloatArray, count: int, seed: int) -> None:
        self.law, self.poses, self.count = law, poses, count
        self._solutions = SolutionSearch(law)
        lower, upper = sampling_limits(law.joints.arm)
        generator = np.random.default_rng(seed)
        self._guesses = generator.uniform(lower, upper, (len(poses), count * _STARTS_PER_CONFIGURATION, lower.size))
        self._starts = generator.uniform(lower, upper, (len(poses), count, lower.size, lower.size))

    def simulate_designs(self, values: FloatArray) -> ConvergenceOutcomes:
        """Simulate the failures with designs (D, k)."""
        joints, poses = self.law.joints, self.poses
        n, shape = joints.arm.n, (len(values), len(poses), self.count)
        target_q, is_known = self._find_target_configurations(values)
        # Each joint in turn is locked at its value at the target.
        q0 = np.broadcast_to(self._starts, (*shape, n, n)).copy()
        joint_range = np.arange(n)
        q0[..., joint_range, joint_range] = target_q
        selected = np.broadcast_to(is_known[..., None], (*shape, n))
        design, target, _, joint = np.nonzero(selected)
        runs = simulate(
            self.law,
            joints.configurations(values[design], q0[selected]),
            poses[target],
            locked=joints.moving[joint],
            time_limit=RUN_TIME_CONSTANTS / self.law.gain,
            tolerance=RUN_TOLERANCE,
        )
        distances = scale_errors(self.law, runs.error, runs.x_final, poses[target])
        has_converged = (runs.code == RunOutcome.CONVERGED) | (
            (runs.code == RunOutcome.UNDECIDED) & (distances < CONVERGED_DISTANCE)
        )
        converged = np.zeros((*shape, n), dtype=bool)
        converged[selected] = has_converged
        outcome_counts = np.zeros((len(values), len(RunOutcome)), dtype=np.int64)
        np.add.at(outcome_counts, (design, np.where(has_converged, RunOutcome.CONVERGED, runs.code)), 1)
        return ConvergenceOutcomes(converged, is_known, outcome_counts)

    def _find_target_configurations(self, values: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Return configurations (D, T, C, n) at the targets within the limits, and which of them (D, T, C) exist."""
        joints = self.law.joints
        arm, count = joints.arm, self.count
        configurations = np.zeros((len(values), len(self.poses), count, arm.n))
        is_known = np.zeros(configurations.shape[:3], dtype=bool)
        for target, (pose, guesses) in enumerate(zip(self.poses, self._guesses, strict=True)):
            starts = joints.configurations(np.repeat(values, len(guesses), axis=0), np.tile(guesses, (len(values), 1)))
            q, is_valid = self._solutions.search(starts, pose, joints.mask)
            q = joint_space.wrap_joints(arm, q[:, joints.moving])
            is_valid &= ((q >= arm.lower) & (q <= arm.upper)).all(axis=1)
            is_valid = is_valid.reshape(len(values), -1)
            # Take the first valid configurations in the order of the guesses.
            order = np.argsort(~is_valid, axis=1, kind="stable")[:, :count]
            configurations[:, target] = np.take_along_axis(q.reshape(*is_valid.shape, arm.n), order[..., None], axis=1)
            is_known[:, target] = np.take_along_axis(is_valid, order, axis=1)
        return configurations, is_known
