"""Relative manipulability after k failures from a null-space basis, in NumPy and independent of any search."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from holdfast.core.typing import FloatArray


def worst_relative_manipulability(null_space: FloatArray, k: int) -> float:
    """Return the least relative manipulability over all sets of k joints that lock.

    Args:
        null_space: (n, p) orthonormal columns.
        k: Number of joints that lock at once, 1 to p.

    Returns:
        ``min sqrt(det(N_S N_S'))`` over the sets S of k rows.
    """
    n = len(null_space)
    remaining = [np.linalg.svd(null_space[list(locked)], compute_uv=False).prod() for locked in combinations(range(n), k)]
    return float(min(remaining))


def measure_orthonormality_error(null_space: FloatArray) -> float:
    """Return the largest entry of ``N'N - I``."""
    return float(abs(null_space.T @ null_space - np.eye(null_space.shape[1])).max())
