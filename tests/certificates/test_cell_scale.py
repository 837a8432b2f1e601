"""How much of a cell one configuration proves: several tests in one loop, against each test alone."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast.certificates.taylor import ReachSolver, TaylorForm


@pytest.fixture
def forms(panda, rng):
    """Of a Panda with its fourth joint locked, away from its limits, and half widths of cells of all sizes."""
    limits = np.column_stack([panda.lower, panda.upper])
    q = rng.uniform([-1, -0.5, -1, -2.4, -1, 1, -1], [1, 0.5, 1, -1.2, 1, 2.5, 1], (60, 7))
    reach = ReachSolver(panda, "position", 3, limits)
    targets = panda.forward_kinematics(q)[:, :3, 3]
    return TaylorForm.expand_at(reach, q, targets), rng.uniform(0.5, 1, (60, 4)) * 10 ** rng.uniform(-5, -0.5, (60, 1))


def test_a_scale_is_the_last_test_that_passes(forms, rng):
    form, cells = forms
    passes = np.array([form.is_cell_proved(cells * k / 16) for k in range(1, 16)])
    assert (passes[:-1] >= passes[1:]).all()  # less of a cell is never harder
    most = passes.sum(axis=0) / 16
    assert len(set(most.tolist())) > 3
    np.testing.assert_array_equal(form.find_provable_width_fraction(cells), most)
    least = rng.integers(0, 16, 60) / 16
    np.testing.assert_array_equal(form.find_provable_width_fraction(cells, least), np.maximum(most, least))


def test_cells_may_be_as_small_as_one_likes(forms):
    form, cells = forms
    assert form.is_cell_proved(1e-6 * cells / cells.max(axis=1, keepdims=True)).all()
