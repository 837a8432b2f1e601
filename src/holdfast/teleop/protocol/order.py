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

    In each column every task comes equally often, and every ordered pair of neighbours occurs equally often in the rows:
    once for even n, in n rows; twice for odd n, which takes 2 n rows (the square and its mirror image).

    Args:
        n: Number of tasks, 1 or more.

    Returns:
        Task indices from 0, a row for each subject, (n, n), or (2 n, n) for odd n above 1.

    Raises:
        InputError: n below 1.
    """
    if n < 1:
        raise InputError(f"a square of {n} tasks is not possible; give 1 or more")
    offsets = np.zeros(n, dtype=np.int64)
    offsets[1::2] = np.arange(1, n // 2 + 1)
    offsets[2::2] = n - np.arange(1, (n + 1) // 2)
    square = (offsets + np.arange(n)[:, None]) % n
    return square if n % 2 == 0 or n == 1 else np.concatenate([square, square[:, ::-1]])


def choose_next_row(completed: Sequence[int], open_: Sequence[int], rows: int) -> int:
    """Return the row of the square for the next subject: completed by the fewest subjects, then in progress with the fewest.

    Rows of subjects who dropped out come up again, so that an experiment ends balanced.

    Args:
        completed: Rows of subjects who finished their session.
        open_: Rows of subjects whose session is under way.
        rows: Number of rows.

    Raises:
        InputError: A row that the square does not have.
    """
    for row in (*completed, *open_):
        if not 0 <= row < rows:
            raise InputError(f"row {row} is not one of 0 to {rows - 1}")
    completed_counts, open_counts = (
        np.bincount(np.asarray(assigned, dtype=np.int64), minlength=rows) for assigned in (completed, open_)
    )
    return int(np.lexsort((np.arange(rows), open_counts, completed_counts + open_counts))[0])


def shuffle_scenarios(tasks: int, scenarios: int, seed: int, *, subject: int) -> IndexArray:
    """Return (tasks, scenarios) random orders of the scenarios within each task, the same for the same seed and
    subject number.
    """
    generator = np.random.default_rng(np.random.SeedSequence([seed, subject]))
    return np.asarray(generator.permuted(np.tile(np.arange(scenarios), (tasks, 1)), axis=1), dtype=np.int64)
