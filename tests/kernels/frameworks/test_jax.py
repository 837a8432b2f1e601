"""Indices, susceptibilities and laws as functions of JAX, where it is installed."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from oracles import inside

jax = pytest.importorskip("jax", reason="JAX is not installed: CONTRIBUTING has the command that runs these tests")
jnp = jax.numpy


@pytest.fixture(autouse=True)
def double():
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", False)


@pytest.fixture(scope="module")
def objectives(panda):
    rho, torque = hf.indices.relative_manipulability(panda), hf.indices.susceptibility.torque(panda)
    return [rho, rho - 1e-4 * torque]


@pytest.fixture(scope="module")
def law(panda):
    return hf.control.by_name("damped:0.1", panda, task="position")


def test_values_and_gradients_are_those_without(objectives, panda, rng):
    q = inside(panda, rng, 50)
    for objective in objectives:
        f = objective.to_jax()
        np.testing.assert_array_equal(f(q), objective(q))
        np.testing.assert_array_equal(jax.grad(lambda x, f=f: f(x).sum())(jnp.asarray(q)), objective.gradient(q))


def test_check_grads(objectives, law, panda, rng):
    from jax.test_util import check_grads

    q, v = jnp.asarray(inside(panda, rng, 3)), jnp.asarray(rng.normal(size=(3, 3)))
    check_grads(objectives[0].to_jax(), (q,), order=1, modes=("fwd", "rev"), atol=1e-5, rtol=1e-5)
    check_grads(law.to_jax(), (q, v), order=1, modes=("fwd", "rev"), atol=1e-5, rtol=1e-5)


def test_jit_and_vmap(objectives, law, panda, rng):
    q, v = jnp.asarray(inside(panda, rng, 6)), jnp.asarray(rng.normal(size=3))
    f, h = objectives[0].to_jax(), law.to_jax()
    np.testing.assert_array_equal(jax.jit(f)(q), objectives[0](q))
    np.testing.assert_array_equal(jax.vmap(f, in_axes=1)(q.T), objectives[0](q))
    np.testing.assert_allclose(jax.jit(jax.vmap(jax.grad(f)))(q), objectives[0].gradient(q), rtol=1e-14)
    np.testing.assert_array_equal(jax.jit(jax.vmap(h, in_axes=(0, None)))(q, v), law.velocity(q, v))
    by_q, by_v = jax.jacrev(h, argnums=(0, 1))(q[0], v)
    np.testing.assert_allclose(jax.jacfwd(h, argnums=(0, 1))(q[0], v)[0], by_q, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(by_v @ v, h(q[0], v), rtol=1e-12, atol=1e-14)


def test_a_wrong_shape_is_a_sentence(objectives):
    with pytest.raises(InputError, match=r"takes \(\.\.\., 7\), got \(6,\)"):
        objectives[0].to_jax()(np.zeros(6))


def test_single_precision_without_x64(objectives, panda, rng):
    jax.config.update("jax_enable_x64", False)
    q = inside(panda, rng, 5)
    y = objectives[0].to_jax()(q)
    assert y.dtype == jnp.float32
    np.testing.assert_allclose(y, objectives[0](q), rtol=1e-4, atol=1e-6)
