"""A search for null spaces finds the best known values again."""

from itertools import combinations

import numpy as np
import pytest
from measurements.upper_bounds.ascent_search import search_null_space


def least(null, k):
    """The checker: minors of the rows by determinants of Gram matrices."""
    some = null[np.array(list(combinations(range(len(null)), k)))]
    return np.sqrt(np.maximum(np.linalg.det(some @ np.swapaxes(some, -1, -2)), 0)).min()


@pytest.mark.parametrize("size", [(6, 3, 2), (8, 6, 2), (5, 2, 3)])
def test_a_search_finds_the_ceiling_again(size):
    n, m, k = size
    found = search_null_space(n=n, m=m, k=k, seed=3, seconds=0.5)
    assert found.value == pytest.approx(least(found.null_space, k), rel=1e-10)
    assert 0.97 * found.bound < found.value <= found.bound * (1 + 1e-12)
    assert found.describe()[0].startswith("found")
