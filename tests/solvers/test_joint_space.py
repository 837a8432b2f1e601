"""Neighbours of a few configurations are those of SciPy's tree, bit for bit, round the corner where a joint has no limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from holdfast import arms
from holdfast.solvers import joint_space


@pytest.fixture(params=["none", "some", "all"])
def arm(request):
    seven = arms.load("panda")
    turning = {"none": [], "some": [0, 3, 6], "all": range(7)}[request.param]
    return replace(
        seven, joints=tuple(replace(j, lower=-np.inf, upper=np.inf) if k in turning else j for k, j in enumerate(seven.joints))
    )


@pytest.mark.parametrize(("points", "rows"), [(1, 1), (40, 300), (300, 40), (1000, 1000), (1100, 1000)])
def test_neighbours(arm, points, rows, rng):
    a, b = rng.uniform(-8, 8, (points, 7)), rng.uniform(-8, 8, (rows, 7))
    b[: min(points, rows) : 3] = a[: min(points, rows) : 3] + 1e-9
    away, which = joint_space.nearest(arm, a, b)
    expected = joint_space.tree(arm, a).query(joint_space.folded(arm, b))
    assert away.tobytes() == expected[0].tobytes()
    assert np.array_equal(which, expected[1])
    assert away == pytest.approx(np.linalg.norm(joint_space.difference(arm, b, a[which]), axis=1), abs=1e-12)
    for apart in (1e-6, float(np.median(away))):
        both = np.concatenate([a, b])
        found = {tuple(p) for p in joint_space.pairs(arm, both, apart).tolist()}
        assert found == joint_space.tree(arm, both).query_pairs(apart)
