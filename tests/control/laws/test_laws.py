"""Control laws: each against its formula in numpy, what they measure, one call against many, and what they refuse."""

from __future__ import annotations

import inspect

import damping_oracle
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.control import by_name
from holdfast.core.errors import InputError, TaskError
from holdfast.core.registry import LAW_REGISTRY

LENGTH = 0.3


def laws_of(arm, task, rng):
    """Every registered law with the settings of its example, and a full matrix of weights."""
    root = rng.normal(size=(arm.n, arm.n))
    full = hf.control.weighted(arm, root @ root.T + np.eye(arm.n), task)
    return [full, *(LAW_REGISTRY.make(label, arm, task=task) for label in LAW_REGISTRY.labels(arm, task))]


@pytest.fixture(scope="module")
def cases(mixed5, generator):
    """Laws of an arm with a sliding joint for a linear and an angular row of the tool with a length, and samples."""
    rng = generator("laws")
    task = hf.Task("half", np.eye(6)[[0, 4]], "tool", length=LENGTH)
    q, v = oracles.inside(mixed5, rng, 60), rng.normal(size=(60, 2))
    scale = np.array([1 / LENGTH, 1])
    j = oracles.task_jacobian(mixed5, q, ["vx", "wy"], "tool", LENGTH)
    patch = pytest.MonkeyPatch()
    patch.setenv("HOLDFAST_BACKEND", "casadi")  # nothing to compile; compiled in test_failure_tolerant
    yield laws_of(mixed5, task, rng), q, v, j, v * scale
    patch.undo()


def test_every_law_that_is_offered_has_a_name(cases):
    offered = [getattr(hf.control, name) for name in hf.control.__all__]
    kinds = {k for k in offered if isinstance(k, type) and issubclass(k, hf.control.Law) and not inspect.isabstract(k)}
    assert {type(law) for law in cases[0]} == kinds


def test_rates_are_those_of_the_formulas(cases):
    laws, q, v, j, u = cases
    for law in laws:
        rates = law.velocity(q, v)
        damping = law.damping(q, v)
        for k in range(len(q)):
            expected = oracles.ORACLES["control law"][law.slug](j[k], u[k], law, damping[k])
            size = np.abs(expected).max()
            np.testing.assert_allclose(rates[k], expected, rtol=0, atol=1e-9 * size, err_msg=law.name)
        if law.slug != "failure-tolerant":
            assert (damping == getattr(law, "fixed_damping", 0.0)).all()


def test_errors_and_angles_are_those_of_the_formulas(cases):
    laws, q, v, j, u = cases
    for law in laws:
        found = law.deviations(q, v)
        rates = law.velocity(q, v)
        for k in range(len(q)):
            size = np.linalg.norm(u[k])
            errors, angles, healthy_error, healthy_angle = damping_oracle.errors(j[k], u[k] / size, rates[k] / size)
            np.testing.assert_allclose(found.errors[k], errors, rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(found.angles[k], angles, atol=1e-7)
            assert found.healthy_error[k] == pytest.approx(healthy_error, abs=1e-9)
            assert found.healthy_angle[k] == pytest.approx(healthy_angle, abs=1e-7)
            # Two joints of a decoupled arm may tie, to rounding.
            assert errors[found.worst_joint[k]] == pytest.approx(errors.max(), rel=1e-9)
        np.testing.assert_array_equal(law.peak_velocity_error(q, v), found.errors.max(axis=1))
        np.testing.assert_array_equal(law.peak_angular_deviation(q, v), found.angles.max(axis=1))
        np.testing.assert_array_equal(law.healthy_angle(q, v), found.healthy_angle)
        np.testing.assert_array_equal(law.velocity_errors(q, v), found.errors)


def test_only_the_direction_counts_for_deviations_and_rates_are_homogeneous(cases):
    laws, q, v, _, _ = cases
    for law in laws:
        np.testing.assert_allclose(law.velocity(q, 8 * v), 8 * law.velocity(q, v), rtol=1e-12)
        np.testing.assert_allclose(law.velocity_errors(q, 8 * v), law.velocity_errors(q, v), rtol=1e-11, atol=1e-13)


def test_one_call_gives_the_bits_of_the_batch_and_a_step_too(cases):
    laws, q, v, _, _ = cases
    for law in laws:
        rates, errors, damping = law.velocity(q, v), law.velocity_errors(q, v), law.damping(q, v)
        for k in range(0, len(q), 7):
            np.testing.assert_array_equal(law.velocity(q[k], v[k]), rates[k])
            np.testing.assert_array_equal(law.prepare()(q[k], v[k]), rates[k])
            np.testing.assert_array_equal(law.velocity_errors(q[k], v[k]), errors[k])
            assert law.damping(q[k], v[k]) == damping[k]
        np.testing.assert_array_equal(law.velocity(q, v[0])[:3], law.velocity(q[:3], np.tile(v[0], (3, 1))))


def test_nan_stays_in_its_row_and_zero_commands_zero(cases):
    laws, q, v, _, _ = cases
    bad_q, bad_v = q[:6].copy(), v[:6].copy()
    bad_q[1, 2] = np.nan
    bad_v[3, 0] = np.inf
    bad_v[5] = 0
    for law in laws:
        rates, damping = law.velocity(bad_q, bad_v), law.damping(bad_q, bad_v)
        assert np.isnan(rates[[1, 3]]).all()
        assert np.isnan(damping[[1, 3]]).all()
        np.testing.assert_array_equal(rates[[0, 2, 4]], law.velocity(q[:6], v[:6])[[0, 2, 4]])
        np.testing.assert_array_equal(rates[5], 0)
        assert np.isnan(law.peak_velocity_error(bad_q, bad_v)[[1, 3, 5]]).all()
        assert not np.isnan(law.peak_velocity_error(bad_q, bad_v)[[0, 2, 4]]).any()


def test_a_hand_that_does_not_move_has_a_right_angle_and_a_flag():
    arm = hf.arms.load("planar-2r")
    # Straight along x: joint 1 alone moves the hand along y by 2, joint 2 by 1; lambda is 0 for a single row.
    law = hf.control.weighted(arm, [1.0, 1e30], task=["vy"])
    found = law.deviations(np.zeros(2), [1.0])
    np.testing.assert_array_equal(found.still, [True, False])
    assert found.angles[0] == np.pi / 2
    assert found.peak_angular_deviation == np.pi / 2


def test_by_name(planar4):
    for label in LAW_REGISTRY.labels(planar4, "planar"):
        law = by_name(label, planar4, task="planar", gain=2.0, speed_limit=0.1)
        assert (law.slug, law.gain, law.speed_limit, law.task.name) == (label.partition(":")[0], 2.0, 0.1, "planar")
        assert law.name in repr(law)
        assert law.source
    assert by_name("failure-tolerant", planar4, task="planar", pre_failure_error=0.2).pre_failure_error == 0.2
    with pytest.raises(InputError, match=r"'pinv' is not known; use one of pseudoinverse, weighted, damped, "):
        by_name("pinv", planar4)
    with pytest.raises(InputError, match=r"'damped' needs damping, .*, above 0; write damped:DAMPING"):
        by_name("damped", planar4, task="planar")
    with pytest.raises(InputError, match="'pseudoinverse' has no option 'damping'; it takes task, gain, speed_limit"):
        by_name("pseudoinverse", planar4, damping=0.1)


def test_what_is_refused(planar4):
    with pytest.raises(TaskError, match="prescribes 6 rows"):
        hf.control.pseudoinverse(planar4)
    for wrong in (0, 1, -0.5, np.nan, np.inf):
        with pytest.raises(InputError, match=r"pre_failure_error is .*between 0 and 1"):
            hf.control.failure_tolerant(planar4, "planar", wrong)
    for wrong in (0, -1, np.nan):
        with pytest.raises(InputError, match="damping is"):
            hf.control.damped(planar4, wrong, "planar")
        with pytest.raises(InputError, match="gain is"):
            hf.control.pseudoinverse(planar4, "planar", gain=wrong)
        with pytest.raises(InputError, match="speed_limit is"):
            hf.control.pseudoinverse(planar4, "planar", speed_limit=wrong)
    with pytest.raises(InputError, match="above 0"):
        hf.control.weighted(planar4, [1, 1, 0, 1], "planar")
    with pytest.raises(InputError, match=r"weights have shape \(3,\)"):
        hf.control.weighted(planar4, [1, 1, 1], "planar")
    law = hf.control.pseudoinverse(planar4, "planar")
    with pytest.raises(InputError, match=r"the velocity has shape \(3,\)"):
        law.velocity(np.zeros(4), np.zeros(3))
    with pytest.raises(InputError, match="velocity has shape"):
        law.velocity(np.zeros((5, 4)), np.zeros((4, 2)))
