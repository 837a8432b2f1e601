"""Runs that the time limit ended while they converged slowly to the target, and their outcome by linearisation.

Near the ends of the range of a locked joint the failed arm converges ever more slowly, at the rate ``n_i^2 Ke`` of
the null vector's component: no time limit is long enough for all.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (22), for the linearisation; that this decides such runs is ours.
"""

from __future__ import annotations

import numpy as np

from holdfast.control.equilibria.stability import linearisation
from holdfast.control.laws.law import Law
from holdfast.control.simulation.residual import solution_search
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

SOLUTION_DISTANCE = 0.1  # rad (and m): how far the solution may be
MIN_DECAY_RATE = 1e-9  # 1/Ke: slower than this is not told from rest


def is_near_attracting_solution(law: Law, q: FloatArray, pose: FloatArray, joint: IndexArray) -> BoolArray:
    """Return (N,) True where a run at q (N, n) is next to a solution that attracts, with ``joint`` (N,) locked.

    The solution is found by damped least squares over the healthy joints from q, and must be within 0.1 rad; all eigenvalues
    of the linearised motion there but those of the failed arm's own self-motion must have a negative real part.
    """
    is_near = np.zeros(len(q), dtype=bool)
    for locked_joint in np.unique(joint):
        rows = np.flatnonzero(joint == locked_joint)
        healthy = np.arange(law.arm.n) != locked_joint
        solutions, is_reached = solution_search(law).search(q[rows], pose, healthy.astype(np.float64))
        is_reached &= np.linalg.norm(solutions - q[rows], axis=1) <= SOLUTION_DISTANCE
        rows, solutions = rows[is_reached], solutions[is_reached]
        if rows.size:
            real_parts = linearisation(law).eigenvalues(solutions, pose, healthy).real
            # Degrees of redundancy leave as many zeros: the self-motion of the failed arm, along which nothing moves.
            is_near[rows] = (real_parts[:, max(law.arm.n - 1 - law.task.m, 0) :] < -MIN_DECAY_RATE).all(axis=1)
    return is_near
