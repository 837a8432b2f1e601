"""Null spaces that attain an upper bound for every number of joints, in closed form."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray


def equal_row_frame(n: int, p: int) -> FloatArray:
    """Return orthonormal columns (n, p) with n rows of equal length: cosines, sines, and a constant column if p is odd."""
    i = np.arange(n)
    waves = 2 * np.pi * np.outer(i, np.arange(1, p // 2 + 1)) / n
    columns = [*np.cos(waves).T * np.sqrt(2 / n), *np.sin(waves).T * np.sqrt(2 / n)]
    if p % 2:
        columns.append(np.full(n, np.sqrt(1 / n)))
    return np.array(columns).T.reshape(n, p)


def equally_spaced_line_frame(n: int) -> FloatArray:
    """Return orthonormal columns (n, 2): n lines in a plane with equal angles between neighbours."""
    angle = np.pi * np.arange(n) / n
    return np.asarray(np.sqrt(2 / n) * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def two_row_task_frame(n: int) -> FloatArray:
    """Return orthonormal columns (n, n - 2) for even n of 6 or more, the best known for two failures under tasks of two rows.

    The columns of the Jacobian are two orthogonal bundles of h - 1 lines, n = 2 h, and two longer single lines between them.
    After the worst two locks ``rho^2 = (sqrt(4 h^2 - 4 h + 9) - h - 2) / (h - 1)`` remains. Derived here; not proved to be the
    least upper bound.
    """
    h = n // 2
    square = (2 * h + 1 - np.sqrt(4 * h * h - 4 * h + 9)) / (2 * (h - 1))  # squared length of each line of a bundle
    lengths = np.sqrt(np.repeat([square, 1 - (h - 1) * square] * 2, [h - 1, 1] * 2))
    angle = np.repeat(np.pi / 4 * np.arange(4), [h - 1, 1] * 2)
    return orthogonal_complement((lengths * np.stack([np.cos(angle), np.sin(angle)])).T)


def orthogonal_complement(columns: FloatArray) -> FloatArray:
    """Return orthonormal columns (n, n - p) that are orthogonal to the given columns (n, p)."""
    return np.linalg.qr(columns, mode="complete")[0][:, columns.shape[1] :]


def known_null_space(n: int, m: int, k: int) -> FloatArray | None:
    """Return the null space that attains its bound by theorem T1, T2 or T3, or the best known one of a family; else None."""
    p = n - m
    if k == 1 or m == 1:
        return equal_row_frame(n, p)
    if p == k == 2:
        return equally_spaced_line_frame(n)
    if m == 2 and k == p:
        return orthogonal_complement(equally_spaced_line_frame(n))
    if m == k == 2 and n >= 6 and n % 2 == 0:
        return two_row_task_frame(n)
    return None
