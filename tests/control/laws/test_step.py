"""The step of a control loop against the checked, batched call of the same law."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.kernels.llvm import machine_code
from holdfast.kinematics.path_following import GradientProjection


@pytest.mark.parametrize("measure", ["torque", "swing_angle"])
def test_a_step_has_the_bits_of_the_rates(measure, rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRRR", limits=2.0), rng)
    objective = getattr(hf.susceptibility, measure)(arm)
    law = GradientProjection(arm, objective, gain=0.1, task="position", rate_cap=1.0, period=0.1, damping=0.3)
    q, twist = oracles.inside(arm, rng, 300), rng.normal(size=(300, 6))
    rates = law.rates(q, twist)
    assert {(rates.self_motion < 1).any(), (rates.task < 1).any(), (rates.damping > 0).any()} == {True}
    law.prepare()
    for k in range(300):
        np.testing.assert_array_equal(law.step(q[k], twist[k]), rates.rates[k])
        np.testing.assert_array_equal(law.step.extra_outputs, [rates.self_motion[k], rates.task[k], rates.damping[k]])


def test_a_step_takes_what_numpy_takes(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RRRR", limits=2.0), rng)
    step = GradientProjection(arm, hf.susceptibility.torque(arm), task="position").prepare()
    q = oracles.inside(arm, rng, 2)
    first = step(q[0], np.array([0.0, 0, 0, 0, 0, 1]))
    kept = first.copy()
    np.testing.assert_array_equal(step(list(q[0]), [0, 0, 0, 0, 0, 1]), first)
    np.testing.assert_array_equal(step(np.asfortranarray(q)[0], np.array([0, 0, 0, 0, 0, 1])), first)
    step(q[1], np.ones(6))
    np.testing.assert_array_equal(first, kept)
    with pytest.raises(ValueError, match="shape"):
        step(q[0], np.zeros(5))


@pytest.mark.parametrize("kind", ["law", "resolution"])
def test_a_step_never_compiles(kind, rng, monkeypatch, tmp_path):
    """A control loop that waits for a compiler is worse than one that does not begin."""
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))
    arm = oracles.random_arm(rng, types="RRRR", limits=2.0)
    if kind == "law":
        law, v = hf.control.failure_tolerant(arm, "position"), rng.normal(size=3)
    else:
        law, v = GradientProjection(arm, hf.indices.manipulability(arm, "position"), task="position"), rng.normal(size=6)
    q = oracles.inside(arm, rng, 1)[0]
    with pytest.raises(hf.KernelError, match=r"not compiled yet; call its prepare\(\) once"):
        law.step(q, v)
    assert law.prepare() is law.step

    def never(*_):
        raise AssertionError("compiled in a control loop")

    monkeypatch.setattr(machine_code, "compile_program", never)
    monkeypatch.setattr(machine_code, "MachineCode", never)
    for k in range(200):
        assert np.isfinite(law.step(q + 1e-3 * k, v)).all()
