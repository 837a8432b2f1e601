"""Null spaces that attain a ceiling for every number of joints, written down instead of searched for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def equal_rows(n: int, p: int) -> Array:
    """Orthonormal columns (n, p) whose n rows are equally long: cosines and sines, and a constant column if p is odd."""
    i = np.arange(n)
    waves = 2 * np.pi * np.outer(i, np.arange(1, p // 2 + 1)) / n
    columns = [*np.cos(waves).T * np.sqrt(2 / n), *np.sin(waves).T * np.sqrt(2 / n)]
    if p % 2:
        columns.append(np.full(n, np.sqrt(1 / n)))
    return np.array(columns).T.reshape(n, p)


def star(n: int) -> Array:
    """Orthonormal columns (n, 2): n lines of a plane with equal angles between neighbours."""
    angle = np.pi * np.arange(n) / n
    return np.asarray(np.sqrt(2 / n) * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def complement(columns: Array) -> Array:
    """Orthonormal columns (n, n - p) across the given (n, p)."""
    return np.linalg.qr(columns, mode="complete")[0][:, columns.shape[1] :]


def known(n: int, m: int, k: int) -> Array | None:
    """The null space that theorem T1, T2, T3 or T4 says attains its bound; None where none of them does."""
    p = n - m
    if k == 1 or m == 1:
        return equal_rows(n, p)
    if p == k == 2:
        return star(n)
    if m == 2 and k == p:
        return complement(star(n))
    return None
