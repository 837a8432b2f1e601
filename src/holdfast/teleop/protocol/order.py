"""Order of the tasks: balanced Latin squares, and the assignment of their rows to subjects.

Source: Williams 1949; Goel et al. 2003, section 6, uses one of order 24.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import IndexArray


def williams_square(n: int) -> IndexArray:
    """Return a Latin square balanced for the preceding task, by Williams' construction.

    Every task occurs equally often in each column, and every ordered pair of neighbours occurs equally often in the rows: once
    for even n, in n rows; twice for odd n, which takes 2 n rows (the square and its mirror image).

    Args:
        n: Number of tasks, 1 or more.

    Returns:
        Task indices from 0, one row for each subject, (n, n), or (2 n, n) for odd n above 1.

    Raises:
        InputError: n is below 1.
    """
    if n < 1:
        raise InputError(f"a square of {n} tasks is not possible; give 1 or more")
    offsets = np.zeros(n, dtype=np.int64)
    offsets[1::2] = np.arange(1, n // 2 + 1)
    offsets[2::2] = n - np.arange(1, (n + 1) // 2)
    square = (offsets + np.arange(n)[:, None]) % n
    return square if n % 2 == 0 or n == 1 else np.concatenate([square, square[:, ::-1]])


def choose_next_row(completed: Sequence[int], open_: Sequence[int], rows: int) -> int:
    """Return the row of the square for the next subject: the one completed, and then in progress, by the fewest subjects.

    Rows of subjects who dropped out are used again, so that an experiment ends balanced.

    Args:
        completed: Rows of subjects who finished their session.
        open_: Rows of subjects whose session is in progress.
        rows: Number of rows.

    Raises:
        InputError: The square does not have one of the rows.
    """
    for row in (*completed, *open_):
        if not 0 <= row < rows:
            raise InputError(f"row {row} is not one of 0 to {rows - 1}")
    completed_counts, open_counts = (
        np.bincount(np.asarray(assigned, dtype=np.int64), minlength=rows) for assigned in (completed, open_)
    )
    return int(np.lexsort((np.arange(rows), open_counts, completed_counts + open_counts))[0])


def shuffle_scenarios(tasks: int, scenarios: int, seed: int, *, subject: int) -> IndexArray:
    """Return random orders (tasks, scenarios) of a number of ``scenarios`` within each of a number of ``tasks``.

    They depend only on the ``seed`` of the experiment and the number of the ``subject``, both 0 or more.
    """
    generator = np.random.default_rng(np.random.SeedSequence([seed, subject]))
    return np.asarray(generator.permuted(np.tile(np.arange(scenarios), (tasks, 1)), axis=1), dtype=np.int64)
