"""One law, target and set of locked joints, with everything that is asked of its stationary points."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.control.law import Law
from holdfast.equilibria.equations import RestEquations
from holdfast.equilibria.solutions import Solutions
from holdfast.equilibria.stability import REACHED, linearisation
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

HEALTHY_SHARE = 1e-7  # of all rates: healthy joints that move less are still
VANISHED = 1e-5  # of c: b is that short, per unit of error
IDLE = 1e-12  # of the Jacobian: a joint with a smaller column does not move the task


class RestSystem:
    """The equations of rest and the linearisation of a failed arm.

    Attributes:
        law: The control law.
        pose: (4, 4) target.
        joints: Locked joints, from 0.
        idle: Joints that the task does not notice, from 0: they are at 0, and are left out of everything.
        mask: (n,) 0 for locked joints, else 1.
        healthy: (n,) neither locked nor idle.
        active: Unknowns but for idle joints, as indices; one more than equations where one joint is locked.
    """

    def __init__(self, law: Law, pose: Array, joints: tuple[int, ...]) -> None:
        self.law, self.pose, self.joints = law, pose, joints
        self.idle = tuple(k for k in idle_joints(law) if k not in joints)
        self.mask = np.ones(law.arm.n)
        self.mask[list(joints)] = 0.0
        self.healthy: Flags = self.mask > 0
        self.healthy[list(self.idle)] = False
        self.equations = _equations(law, len(joints) == 1)
        self.linear = linearisation(law)
        self._free = np.ones(self.equations.size)
        self._free[list(self.idle)] = 0.0
        self.active = np.flatnonzero(self._free)
        unlocked = np.flatnonzero(self.mask)
        self._rows = np.flatnonzero(~np.isin(np.r_[unlocked, np.full(law.task.m + 2, -1)], self.idle))

    def __reduce__(self) -> tuple[type[RestSystem], tuple[Law, Array, tuple[int, ...]]]:  # to another process
        return RestSystem, (self.law, self.pose, self.joints)

    def starts(self, count: int, generator: np.random.Generator) -> Array:
        """Random unknowns (count, size), idle joints at 0."""
        z = self.equations.starts(count, generator)
        z[:, list(self.idle)] = 0.0
        return z

    def seeds(self, count: int, generator: np.random.Generator) -> Array:
        """Unknowns (N, size) of erroneous rest for any value of the locked joints."""
        z, held = self.equations.search(self.starts(count, generator), self.pose, self.mask, self._free)
        z = z[held]
        return z[self.still(z[:, : self.law.arm.n])]

    def stuck(self, z: Array) -> Array:
        """Configurations (N, n) of erroneous rest from starts z, with the locked joints at their values."""
        free = self._free.copy()
        free[list(self.joints)] = 0.0
        out, held = self.equations.search(z, self.pose, self.mask, free)
        # Where b vanishes the equations hold with c = 0, but J has lost rank and the law no answer.
        q = out[held & (np.abs(out[:, -2]) > VANISHED), : self.law.arm.n]
        _, _, scaled = self.linear.rates(q, self.pose)
        return q[self.still(q) & (scaled > REACHED)]

    def solutions(self, z: Array) -> Array:
        """Configurations (N, n) that reach the target from starts z, with the locked joints at their values."""
        q, converged = _solutions(self.law).search(z[:, : self.law.arm.n], self.pose, self.mask)
        return q[converged]

    def reaches(self, values: Array, generator: np.random.Generator) -> Flags:
        """(N,) whether the target is reached from one random start with the locked joint at values (N,)."""
        q = self.starts(len(values), generator)[:, : self.law.arm.n]
        q[:, self.joints[0]] = values
        return _solutions(self.law).search(q, self.pose, self.mask)[1]

    def still(self, q: Array) -> Flags:
        """(N,) whether only locked joints are commanded at q (N, n)."""
        rates, _, _ = self.linear.rates(q, self.pose)
        return np.asarray(np.linalg.norm(rates[:, self.healthy], axis=1) < HEALTHY_SHARE * np.linalg.norm(rates, axis=1))

    def holds(self, z: Array) -> bool:
        """Whether the law itself is at rest along z (N, size), where it has an answer."""
        q = z[:, : self.law.arm.n]
        _, _, scaled = self.linear.rates(q, self.pose)
        return bool(self.still(q)[scaled > 1e-3].mean() > 0.5)

    def values(self, z: Array) -> tuple[Array, Array]:
        """The equations (N, e) at unknowns (N, size), and their Jacobian (N, e, a) by those that are active."""
        values, slopes = self.equations.values(z, self.pose, self.mask)
        return values[:, self._rows], slopes[:, self._rows][:, :, self.active]

    def pulls(self, z: Array) -> Array:
        """(N,) see :meth:`RestEquations.pulls`."""
        return self.equations.pulls(z, self.pose, self.mask)

    def eigenvalues(self, q: Array) -> NDArray[np.complex128]:
        """(N, h) see :meth:`Linearisation.eigenvalues`."""
        return self.linear.eigenvalues(q, self.pose, self.healthy)

    def settled(self, q: Array) -> Array:
        """(N, n) erroneous stationary points near q (N, n), locked joints at their values; NaN where there is none."""
        n = self.law.arm.n
        free = self._free.copy()
        free[list(self.joints)] = 0.0
        out, held = self.equations.search(self.equations.completed(q, self.pose, self.mask), self.pose, self.mask, free)
        return np.where(held[:, None], out[:, :n], np.nan)

    def isolated(self, q: Array) -> Flags:
        """(N,) False where an eigenvalue is 0."""
        if not len(q):
            return np.zeros(0, dtype=bool)
        size = np.abs(self.eigenvalues(q))
        return np.asarray(size.min(axis=1) > 1e-6 * np.maximum(1.0, size.max(axis=1)))


@lru_cache(maxsize=64)
def idle_joints(law: Law) -> tuple[int, ...]:
    """Joints that do not move the task of a law at any configuration, by index from 0; stationary points have them at 0."""
    form = law.quadratic()
    if form is not None and not np.array_equal(form[0], np.diag(np.diag(form[0]))):
        return ()
    q = np.random.default_rng(0).uniform(-np.pi, np.pi, (8, law.arm.n))
    rows = law.task.rows
    twists = law.arm.jacobian(q)
    j = np.abs(rows @ twists if law.task.frame == "base" else twists).max(axis=(0, 1))
    return tuple(int(k) for k in np.flatnonzero(j < IDLE * j.max()))


def wrapped(arm: Arm, q: Array) -> Array:
    """Configurations (N, n) with revolute joints from -pi to pi, whatever their limits."""
    return joint_space.wrapped(arm.without_limits, q)


def distinct(arm: Arm, q: Array, known: Array, apart: float) -> Array:
    """Those of q (N, n), in order, that are ``apart`` from the known points (P, n) and from those kept before."""
    free = arm.without_limits
    if len(known) and len(q):
        q = q[joint_space.nearest(free, known, q)[0] > apart]
    keep = np.ones(len(q), dtype=bool)
    if len(q) > 1:
        for k, m in joint_space.pairs(free, q, apart):
            if keep[k]:
                keep[m] = False
    return q[keep]


@lru_cache(maxsize=16)
def _equations(law: Law, single: bool) -> RestEquations:
    """The compiled equations of a law."""
    return RestEquations(law, single)


@lru_cache(maxsize=16)
def _solutions(law: Law) -> Solutions:
    """The compiled search for configurations of a target with locked joints."""
    return Solutions(law)
