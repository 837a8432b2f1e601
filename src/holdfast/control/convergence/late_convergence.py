"""Outcome by linearisation of runs that the time limit ended while they converged slowly to the target.

Near the ends of the range of a locked joint the failed arm converges ever more slowly, at the rate ``n_i^2 Ke`` for the
component ``n_i`` of the null vector, so no time limit is long enough for all runs.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (22), for the linearisation. Its use to decide such runs is ours.
"""

from __future__ import annotations

import numpy as np

from holdfast.control.equilibria.stability import linearisation
from holdfast.control.laws.law import Law
from holdfast.control.simulation.residual import solution_search
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

SOLUTION_DISTANCE = 0.1  # rad (and m): largest distance of the solution
MIN_DECAY_RATE = 1e-9  # 1/Ke: a slower decay cannot be distinguished from rest


def is_near_attracting_solution(law: Law, q: FloatArray, pose: FloatArray, joint: IndexArray) -> BoolArray:
    """Return a mask of the runs at q (N, n) that are next to an attracting solution with ``joint`` (N,) locked.

    Damped least squares over the healthy joints find the solution from q, which must be within 0.1 rad. All eigenvalues of the
    linearised motion at the solution, except those of the failed arm's self-motion, must have a negative real part.
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
            # Each degree of redundancy of the failed arm gives a zero eigenvalue, that of its self-motion.
            is_near[rows] = (real_parts[:, max(law.arm.n - 1 - law.task.m, 0) :] < -MIN_DECAY_RATE).all(axis=1)
    return is_near
