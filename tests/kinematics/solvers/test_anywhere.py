"""The best configuration at all, against closed forms, SLSQP from where it ended, and many random configurations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

import holdfast as hf
import oracles


@pytest.mark.interpreted
def test_three_equal_links_reach_the_ceiling():
    arm = hf.Arm.from_dh([hf.DH(0.75, 0.0, 0.0)] * 3, name="three")
    index = hf.indices.relative_manipulability(arm, "planar")
    found = hf.optimise(arm, None, index, seed=2, starts=200)
    assert found.value == pytest.approx(1 / np.sqrt(3), abs=1e-8)
    assert found.free
    np.testing.assert_allclose(found.poses, arm.forward_kinematics(found.q))
    assert found.start_value <= found.value
    drawn = index(np.random.default_rng(5).uniform(-np.pi, np.pi, (200, 3)))
    assert found.start_value > np.nanquantile(drawn, 0.95), "the best of 4,000 random configurations is climbed from"
    values = oracles.index("relative-manipulability", oracles.task_jacobian(arm, found.q[None], "planar"), [(0,), (1,), (2,)])
    assert values.min() == pytest.approx(found.value, rel=1e-9)


def test_a_kink_of_a_panda_is_found_and_no_step_from_it_is_better():
    """Four failures are equally bad there, with joint 6 beyond half a turn; the specification knows 0.31355."""
    arm = hf.arms.load("panda")
    found = hf.optimise(arm, None, hf.indices.relative_manipulability(arm), starts=3000, seed=1)
    assert found.value == pytest.approx(0.313547, abs=2e-6)
    assert (found.q >= arm.lower).all()
    assert (found.q <= arm.upper).all()

    def left(q):
        return oracles.index("relative-manipulability", oracles.jacobian(arm, q[None]), [(k,) for k in range(7)])[0]

    better = minimize(
        lambda x: -x[-1],
        [*found.q, found.value],
        bounds=[*zip(arm.lower, arm.upper, strict=True), (0, 1)],
        constraints={"type": "ineq", "fun": lambda x: left(x[:-1]) - x[-1]},
        options={"maxiter": 30},
    )
    assert left(better.x[:-1]).min() <= found.value + 1e-6


@pytest.mark.interpreted
def test_clear_and_limited_and_no_value_at_all(rng):
    arm = hf.arms.load("planar-3r").with_limits(np.full(3, 0.2), np.full(3, 1.0))
    index = hf.indices.relative_manipulability(arm, "planar")
    given = np.full(3, 0.5)
    found = hf.optimise(arm, None, index, starts=50, initial=given)
    many = rng.uniform(0.2, 1.0, (20000, 3))
    assert found.value >= index(many).max()
    assert found.value_before == index(given)
    clearance = hf.Clearance(arm)
    with pytest.raises(hf.HoldfastError, match=r"none of 1000 random configurations has a value .* without collision: the arm"):
        hf.optimise(arm, None, index, starts=50, clearance=clearance, margin=99.0)
    with pytest.raises(hf.InputError, match=r"no poses are given; give one configuration"):
        hf.optimise(arm, None, index, initial=np.zeros((2, 3)))
