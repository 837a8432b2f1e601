"""The step of a control loop against the checked, batched call of the same law."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.control import GradientProjection


@pytest.mark.parametrize("measure", ["torque", "swing_angle"])
def test_a_step_has_the_bits_of_the_rates(measure, rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRRR", limits=2.0), rng)
    objective = getattr(hf.susceptibility, measure)(arm)
    law = GradientProjection(arm, objective, gain=0.1, task="position", rate_cap=1.0, period=0.1, damping=0.3)
    q, twist = oracles.inside(arm, rng, 300), rng.normal(size=(300, 6))
    rates = law.rates(q, twist)
    assert {(rates.self_motion < 1).any(), (rates.task < 1).any(), (rates.damping > 0).any()} == {True}
    for k in range(300):
        np.testing.assert_array_equal(law.step(q[k], twist[k]), rates.rates[k])
        np.testing.assert_array_equal(law.step.others, [rates.self_motion[k], rates.task[k], rates.damping[k]])


def test_a_step_takes_what_numpy_takes(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRRR", limits=2.0), rng)
    step = GradientProjection(arm, hf.susceptibility.torque(arm), task="position").step
    q = oracles.inside(arm, rng, 2)
    first = step(q[0], np.array([0.0, 0, 0, 0, 0, 1]))
    kept = first.copy()
    np.testing.assert_array_equal(step(list(q[0]), [0, 0, 0, 0, 0, 1]), first)
    np.testing.assert_array_equal(step(np.asfortranarray(q)[0], np.array([0, 0, 0, 0, 0, 1])), first)
    step(q[1], np.ones(6))
    np.testing.assert_array_equal(first, kept)
    with pytest.raises(ValueError, match="shape"):
        step(q[0], np.zeros(5))
