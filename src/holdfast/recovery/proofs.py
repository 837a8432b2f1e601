"""That what is asked for cannot be done: the goal, or a pose of the tool path."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.task import plane_normal
from holdfast.recovery.bounds import out_of_reach
from holdfast.recovery.rows import RowSolver

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def unreachable(solver: RowSolver, free: Flags, at: Array, pose: Array) -> str | None:
    """A sentence that proves a pose (4, 4) out of reach, if its position counts and the bound says so.

    Args:
        solver: Of the rows that count, with the arm and the limits in force.
        free: (n,) joints that move.
        at: (n,) where the others are.
        pose: (4, 4) of the end effector, m.
    """
    rows, arm = solver.rows, solver.arm
    linear = rows.matrix[np.abs(rows.matrix[:, 3:]).max(axis=1) == 0, :3]
    rank = int(np.linalg.matrix_rank(linear)) if len(linear) else 0
    normal = plane_normal(arm)
    if rank == 3:
        normal = None
    elif rank != 2 or normal is None or rows.linear != "base" or np.abs(linear @ normal).max() > 1e-9:
        return None
    return out_of_reach(arm, free, at, pose, rows.m == 6, normal)


def telling_first(count: int) -> Iterator[int]:
    """0 to count - 1, those first that most often tell: the last, the first, the middle, quarters, eighths, ..."""
    seen, parts = set[int](), 1
    while len(seen) < count:
        for k in [count - 1, 0] if parts == 1 else [round(i * (count - 1) / parts) for i in range(1, parts, 2)]:
            if k not in seen:
                seen.add(k)
                yield k
        parts *= 2
