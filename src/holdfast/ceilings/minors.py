"""What is left after k failures, from a null-space basis alone; NumPy only, shared with no search."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def worst_case(null_space: Array, k: int) -> float:
    """Least relative manipulability over all sets of k joints that lock.

    Args:
        null_space: (n, p) orthonormal columns.
        k: Joints that lock at once, 1 to p.

    Returns:
        ``min sqrt(det(N_S N_S'))`` over the sets S of k rows.
    """
    n = len(null_space)
    left = [np.linalg.svd(null_space[list(s)], compute_uv=False).prod() for s in combinations(range(n), k)]
    return float(min(left))


def lack_of_orthonormality(null_space: Array) -> float:
    """Largest entry of ``N'N - I``."""
    return float(abs(null_space.T @ null_space - np.eye(null_space.shape[1])).max())
