"""The Sobol sequence, unscrambled: the points of SciPy's without its half second of imports."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_SOBOL_BITS = 30
_DIRECTION_TABLE = (  # of each dimension: the primitive polynomial over GF(2), bit by bit, and the first direction numbers
    (1, (1,)),
    (3, (1,)),
    (7, (1, 3)),
    (11, (1, 3, 1)),
    (13, (1, 1, 1)),
    (19, (1, 1, 3, 3)),
    (25, (1, 3, 5, 13)),
    (37, (1, 1, 5, 5, 17)),
    (41, (1, 1, 5, 5, 5)),
    (47, (1, 1, 7, 11, 19)),
    (55, (1, 1, 5, 1, 1)),
    (59, (1, 1, 1, 3, 11)),
    (61, (1, 3, 5, 5, 31)),
    (67, (1, 3, 3, 9, 7, 49)),
    (91, (1, 1, 1, 15, 21, 21)),
    (97, (1, 3, 1, 13, 27, 49)),
)


def sobol_points(count: int, dimensions: int) -> NDArray[np.float64]:
    """Return the first points (count, dimensions), between 0 and 1.

    Source: Joe and Kuo 2008 for the direction numbers; Antonov and Saleev 1979 for the order of the points.
    """
    if dimensions > len(_DIRECTION_TABLE):
        from scipy.stats import qmc

        return np.asarray(qmc.Sobol(dimensions, scramble=False).random(count))
    number = np.arange(count)
    gray = number ^ (number >> 1)
    points = np.zeros((count, dimensions), dtype=np.int64)
    directions = np.array([_direction_numbers(*entry) for entry in _DIRECTION_TABLE[:dimensions]], dtype=np.int64).reshape(
        dimensions, _SOBOL_BITS
    )
    for k in range(int(count).bit_length()):
        points ^= (gray >> k & 1)[:, None] * directions[:, k]
    return points / (1 << _SOBOL_BITS)


def _direction_numbers(polynomial: int, first: tuple[int, ...]) -> list[int]:
    degree = polynomial.bit_length() - 1
    m = list(first)
    while len(m) < _SOBOL_BITS:
        new = m[-degree] if degree else 1
        for k in range(1, degree + 1):
            if polynomial >> (degree - k) & 1:
                new ^= m[-k] << k
        m.append(new)
    return [value << (_SOBOL_BITS - 1 - k) for k, value in enumerate(m)]
