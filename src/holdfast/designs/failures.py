"""How often failed arms of many designs reach their target, by simulation: any arm, task and law, all designs in one batch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.designs.joints import LawOfDesigns
from holdfast.equilibria.solutions import Solutions
from holdfast.simulation.closed_loop import simulate
from holdfast.simulation.runs import Outcome
from holdfast.simulation.system import own_units
from holdfast.solvers import joint_space

Array = NDArray[np.float64]

TIME_CONSTANTS, TOLERANCE = 500.0, 1e-8  # of a run, as in a convergence map
NEAR = 1e-3  # rad, and of the arm's own length: a run that creeps this near to its target has converged
_TRIES = 40  # random starts of inverse kinematics for each configuration that is wanted


@dataclass(frozen=True, eq=False)
class Convergences:
    """How D designs do at T targets, after C failures of each joint.

    Attributes:
        converged: (D, T, C, n) True where the target was reached.
        known: (D, T, C) there was a configuration at the target to take the locked angles from.
        ends: (D, 4) how the runs ended, by :class:`holdfast.simulation.Outcome`; undecided ones next to the target have
            converged.
    """

    converged: NDArray[np.bool_]
    known: NDArray[np.bool_]
    ends: NDArray[np.int64]

    @property
    def reached(self) -> Array:
        """(D,) share of the targets for which a configuration was found."""
        return np.asarray(self.known.any(axis=2).mean(axis=1))

    @property
    def by_target(self) -> Array:
        """(D, T) share of the failures of a target after which it is still reached; NaN where it is out of reach."""
        count = self.known.sum(axis=2)
        with np.errstate(invalid="ignore"):
            share = self.converged.mean(axis=3).sum(axis=2) / np.where(count > 0, count, np.nan)
        return np.asarray(share)

    @property
    def overall(self) -> Array:
        """(D,) mean over the targets, 0 for those out of reach."""
        return np.asarray(np.nan_to_num(self.by_target).mean(axis=1))


class Failures:
    """The same failures for every design: targets, and random numbers for configurations and starts.

    A joint locks where it is in a configuration at the target, so that the target stays in reach; the arm starts from a
    random configuration with that joint there.

    Args:
        law: The law of all designs.
        poses: (T, 4, 4) targets in the world.
        count: C.
        seed: Of the random numbers.
    """

    def __init__(self, law: LawOfDesigns, poses: Array, count: int, seed: int) -> None:
        self.law, self.poses, self.count = law, poses, count
        self._solutions = Solutions(law)
        low, high = finite_limits(law.joints.arm)
        generator = np.random.default_rng(seed)
        self._guesses = generator.uniform(low, high, (len(poses), count * _TRIES, low.size))
        self._starts = generator.uniform(low, high, (len(poses), count, low.size, low.size))

    def of(self, values: Array) -> Convergences:
        """What becomes of them with designs (D, k)."""
        joints, poses = self.law.joints, self.poses
        n, shape = joints.arm.n, (len(values), len(poses), self.count)
        at, known = self._configurations(values)
        # Each joint in turn is locked where it is at the target.
        q0 = np.broadcast_to(self._starts, (*shape, n, n)).copy()
        each = np.arange(n)
        q0[..., each, each] = at
        rows = np.broadcast_to(known[..., None], (*shape, n))
        design, target, _, joint = np.nonzero(rows)
        runs = simulate(
            self.law,
            joints.configurations(values[design], q0[rows]),
            poses[target],
            locked=joints.moving[joint],
            time_limit=TIME_CONSTANTS / self.law.gain,
            tolerance=TOLERANCE,
        )
        left = own_units(self.law, runs.error, runs.x_final, poses[target])
        near = (runs.code == Outcome.CONVERGED) | ((runs.code == Outcome.UNDECIDED) & (left < NEAR))
        converged = np.zeros((*shape, n), dtype=bool)
        converged[rows] = near
        ends = np.zeros((len(values), len(Outcome)), dtype=np.int64)
        np.add.at(ends, (design, np.where(near, Outcome.CONVERGED, runs.code)), 1)
        return Convergences(converged, known, ends)

    def _configurations(self, values: Array) -> tuple[Array, NDArray[np.bool_]]:
        """(D, T, C, n) configurations at the targets within the limits, and (D, T, C) which there are."""
        joints = self.law.joints
        arm, count = joints.arm, self.count
        found = np.zeros((len(values), len(self.poses), count, arm.n))
        known = np.zeros(found.shape[:3], dtype=bool)
        for t, (pose, guesses) in enumerate(zip(self.poses, self._guesses, strict=True)):
            starts = joints.configurations(np.repeat(values, len(guesses), axis=0), np.tile(guesses, (len(values), 1)))
            q, ok = self._solutions.search(starts, pose, joints.mask)
            q = joint_space.wrapped(arm, q[:, joints.moving])
            ok &= ((q >= arm.lower) & (q <= arm.upper)).all(axis=1)
            ok = ok.reshape(len(values), -1)
            # The first ones that were found, in the order of the guesses.
            order = np.argsort(~ok, axis=1, kind="stable")[:, :count]
            found[:, t] = np.take_along_axis(q.reshape(*ok.shape, arm.n), order[..., None], axis=1)
            known[:, t] = np.take_along_axis(ok, order, axis=1)
        return found, known
