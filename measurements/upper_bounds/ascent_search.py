"""Search for a null space with a larger worst case than the best one known.

``python -m measurements.upper_bounds.ascent_search 9 6 2 --seconds 60 --out null-space.csv``
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.index_bounds.manipulability_bounds import UpperBound, upper_bound
from holdfast.kinematics.index_bounds.minors import worst_relative_manipulability
from measurements.upper_bounds.ascent import best_null_space

_BOUND_TOLERANCE = 1e-9  # relative


@dataclass(frozen=True, kw_only=True, eq=False)
class UpperBoundSearch:
    """Best null space that a search found.

    Attributes:
        ceiling: What was known before.
        null_space: (n, n - m) orthonormal columns.
        value: Its worst case, measured anew by singular values.
        seed: Of the random starts.
        seconds: What it took.
    """

    ceiling: UpperBound
    null_space: FloatArray
    value: float
    seed: int
    seconds: float

    @property
    def bound(self) -> float:
        """Proved upper bound of any arm."""
        return self.ceiling.bound

    def describe(self) -> list[str]:
        """Return the value that was found and the best known value in sentences."""
        known, found_text = self.ceiling.best_known, f"found {self.value:.12g} in {self.seconds:.0f} s, seed {self.seed}"
        if known is None:
            return [f"{found_text}: nothing was stored for this size, and no arm can beat {self.bound:.6g}"]
        if self.value > known * (1 + _BOUND_TOLERANCE):
            return [f"{found_text}: a new best, {100 * (self.value / known - 1):.2g} % above {known:.12g}"]
        if self.value >= known * (1 - _BOUND_TOLERANCE):
            return [f"{found_text}: {'the ceiling' if self.ceiling.is_attained else 'the best known value'}, found again"]
        return [f"{found_text}: {100 * (1 - self.value / known):.2g} % below the best known {known:.12g}"]


def search_null_space(
    *,
    n: int,
    m: int,
    k: int,
    seed: int = 0,
    seconds: float = 20.0,
    enough: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> UpperBoundSearch:
    """Search for a null space whose worst case after k failures is large, by ascents from random starts and then linear
    programmes.

    Args:
        n: Joints.
        m: Rows of the task.
        k: Joints that lock at once.
        seed: Of the starts: with the same seed a longer search goes through the same starts, and more.
        seconds: After which no new start is polished; the first one always is.
        enough: A worst case that ends the search. Default: the proven bound, which nothing passes.
        progress: Called with the best value so far.

    Raises:
        InputError: As :func:`upper_bound`; seconds that are not positive.

    Source: derived here.
    """
    known = upper_bound(n=n, m=m, k=k)
    if not seconds > 0:
        raise InputError(f"the search may take {seconds:g} s; give a positive number")
    start = monotonic()
    stop = known.bound * (1 - _BOUND_TOLERANCE) if enough is None else enough
    best_found, _ = best_null_space(n, n - m, k, seed=seed, seconds=seconds, sufficient_value=stop, progress=progress)
    null = np.linalg.qr(best_found)[0]
    return UpperBoundSearch(
        ceiling=known, null_space=null, value=worst_relative_manipulability(null, k), seed=seed, seconds=monotonic() - start
    )


def main() -> None:
    """Search for the given time, and write the null space for ``python -m measurements.synthesis``."""
    parser = argparse.ArgumentParser(prog="python -m measurements.upper_bounds.ascent_search", description=__doc__)
    parser.add_argument("joints", type=int)
    parser.add_argument("rows", type=int, help="rows of the task")
    parser.add_argument("failures", type=int, help="joints that fail at once")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, help="file for the null space (CSV), a row for each joint")
    options = parser.parse_args()
    search = search_null_space(n=options.joints, m=options.rows, k=options.failures, seed=options.seed, seconds=options.seconds)
    print("\n".join([*search.ceiling.describe(), *search.describe()]))
    if options.out is not None:
        np.savetxt(options.out, search.null_space, delimiter=",", fmt="%.17g")


if __name__ == "__main__":
    main()
