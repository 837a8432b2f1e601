"""Runs that the time limit ended on their last, slow stretch to the target: what becomes of them, by linearisation.

Near the ends of the range of a locked joint the failed arm converges ever more slowly, at the rate ``n_i^2 Ke`` of
the null vector's component: no time limit is long enough for all.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (22), for the linearisation; that this decides such runs is ours.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.equilibria.solutions import Solutions
from holdfast.equilibria.stability import linearisation

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

NEAR = 0.1  # rad (and m): how far the solution may be
DECAYS = 1e-9  # 1/Ke: slower than this is not told from rest


def arriving(law: Law, q: Array, pose: Array, joint: NDArray[np.int64]) -> Flags:
    """(N,) True where a run that is at q (N, n) is next to a solution that attracts, with ``joint`` (N,) locked.

    The solution is found by damped least squares over the healthy joints from q, and must be within 0.1 rad; all eigenvalues
    of the linearised motion there but those of the failed arm's own self-motion must have a negative real part.
    """
    out = np.zeros(len(q), dtype=bool)
    for j in np.unique(joint):
        rows = np.flatnonzero(joint == j)
        healthy = np.arange(law.arm.n) != j
        found, reached = _solutions(law).search(q[rows], pose, healthy.astype(np.float64))
        reached &= np.linalg.norm(found - q[rows], axis=1) <= NEAR
        rows, found = rows[reached], found[reached]
        if rows.size:
            real = linearisation(law).eigenvalues(found, pose, healthy).real
            # Degrees of redundancy leave as many zeros: the self-motion of the failed arm, along which nothing moves.
            out[rows] = (real[:, max(law.arm.n - 1 - law.task.m, 0) :] < -DECAYS).all(axis=1)
    return out


@lru_cache(maxsize=16)
def _solutions(law: Law) -> Solutions:
    return Solutions(law)
