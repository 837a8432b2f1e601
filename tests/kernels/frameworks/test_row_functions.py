"""What needs no framework: functions of rows and their slopes, and what is said where a framework is missing."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import HoldfastError, InputError
from oracles import inside


def differences(value, rows, which, step=1e-6):
    """Slopes of rows by one input, by central differences; the last axis is the input's."""
    columns = []
    for k in range(rows[which].shape[1]):
        ends = []
        for sign in (1, -1):
            moved = [r.copy() for r in rows]
            moved[which][:, k] += sign * step
            ends.append(value(*moved))
        columns.append((ends[0] - ends[1]) / (2 * step))
    return np.stack(columns, axis=-1)


def test_slopes_of_objectives_are_those_of_differences(panda, rng):
    rho = hf.indices.relative_manipulability(panda)
    torque = hf.indices.susceptibility.torque(panda)
    q = inside(panda, rng, 20)
    for objective in (rho, torque, rho - 1e-4 * torque, rho.reversed()):
        f = objective.row_function()
        np.testing.assert_array_equal(f.value(q), objective(q))
        np.testing.assert_allclose(
            f.slopes(q)[0], differences(f.value, [q], 0), rtol=1e-5, atol=1e-5 * np.abs(f.value(q)).max()
        )


@pytest.mark.parametrize("name", ["pseudoinverse", "damped:0.1", "jacobian-transpose"])
def test_slopes_of_laws_are_those_of_differences(name, panda, rng):
    law = hf.control.by_name(name, panda, task="position")
    f = law.row_function()
    q, v = inside(panda, rng, 20), rng.normal(size=(20, 3))
    np.testing.assert_array_equal(f.value(q, v), law.velocity(q, v))
    for k, slopes in enumerate(f.slopes(q, v)):
        expected = differences(f.value, [q, v], k)
        np.testing.assert_allclose(slopes, expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max())


def test_shapes_that_do_not_fit_are_a_sentence(panda):
    f = hf.control.by_name("pseudoinverse", panda, task="position").row_function()
    assert f.leading_axes([(7,), (5, 3)]) == (5,)
    assert f.leading_axes([(2, 1, 7), (5, 3)]) == (2, 5)
    for shapes in ([(7,)], [(7,), (4,)], [(2, 7), (3, 3)], [(), (3,)], []):
        with pytest.raises(InputError, match=r"takes \(\.\.\., 7\) and \(\.\.\., 3\), got"):
            f.leading_axes(shapes)


@pytest.mark.parametrize(("framework", "ask"), [("torch", "to_torch"), ("jax", "to_jax")])
def test_a_missing_framework_is_a_sentence(framework, ask, panda, monkeypatch):
    monkeypatch.setitem(sys.modules, framework, None)
    monkeypatch.delitem(sys.modules, f"holdfast.kernels.frameworks.{framework}_rows", raising=False)
    with pytest.raises(HoldfastError, match=rf"pip install 'holdfast-arms\[{framework}\]'"):
        getattr(hf.indices.relative_manipulability(panda), ask)()
