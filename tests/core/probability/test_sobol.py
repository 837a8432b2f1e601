"""Our Sobol points are SciPy's, bit for bit."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy.stats import qmc

from holdfast.core.probability.sobol_sequence import sobol_points


@pytest.mark.parametrize("dimensions", [*range(1, 17), 23])
@pytest.mark.parametrize("count", [0, 1, 5, 1024, 5000])
def test_the_points_are_those_of_scipy(count, dimensions):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a count that is no power of 2
        theirs = qmc.Sobol(dimensions, scramble=False).random(count) if count else np.zeros((0, dimensions))
        ours = sobol_points(count, dimensions)
    assert ours.shape == (count, dimensions)
    assert np.array_equal(ours, theirs)
