"""W2: gradient of the worst-case relative manipulability of the 9-joint PA10, row-major arrays in and out."""

from __future__ import annotations

import numpy as np

import harness
import numpy_soa
import pa10
import scalarised
from harness import Contender, Function
from index_values import jax_single

SMALL = 256  # jit(vmap(grad)) through the Cholesky factor of jaxlib 0.10.2 hung from 4096 on, on two cores


def holdfast(threads: int) -> Function:
    from holdfast import indices
    from holdfast.kernels import set_threads, thread_count

    index = indices.relative_manipulability(pa10.ours())

    def evaluate(q: np.ndarray) -> np.ndarray:
        if thread_count() != threads:
            set_threads(threads)
        return index.gradient(q)

    return evaluate


def jax_vmap() -> Function:
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    compiled = jax.jit(jax.vmap(jax.grad(jax_single)))

    def evaluate(q: np.ndarray) -> np.ndarray:
        parts = [np.asarray(compiled(jnp.asarray(q[start : start + SMALL]))) for start in range(0, len(q), SMALL)]
        return np.concatenate(parts)

    return evaluate


def pinocchio() -> Function:
    """Jacobian from Pinocchio, one configuration at a time; derivative by the formulas of ``numpy_soa.py``."""
    import pinocchio as pin

    model, data, tool = pa10.pinocchio()

    def one(q: np.ndarray) -> np.ndarray:
        j = pin.computeFrameJacobian(model, data, q, tool, pin.LOCAL_WORLD_ALIGNED)
        m = np.linalg.solve(j @ j.T, j)
        leverage = np.einsum("ik,ik->k", j, m)
        k = leverage.argmax()
        u = m[:, k]
        weight = -(u @ j)
        weight[k] += 1
        v, z = j[:3].T, j[3:].T
        turning = (np.cross(v, u[:3]) + np.cross(z, u[3:])) * weight[:, None]
        moving = np.cumsum(np.cross(u[:3], z) * weight[:, None], axis=0)
        gradient = np.einsum("ci,ci->c", z, np.cumsum(turning[::-1], axis=0)[::-1])
        gradient[1:] += np.einsum("ci,ci->c", v[1:], moving[:-1])
        return -gradient / np.sqrt(1 - leverage[k])

    return lambda q: np.array([one(configuration) for configuration in q])


def peers(rows: int) -> list[Contender]:
    return [
        Contender("holdfast, 1 thread", lambda: holdfast(1), rows),
        Contender("NumPy, batch last, analytic", lambda: numpy_soa.in_chunks(numpy_soa.gradient_columns), min(rows, 40_000)),
        Contender("JAX, scalarised analytic, chunks of 4096", lambda: scalarised.in_jax(scalarised.gradient, 4_096), 65_536),
        Contender("JAX, scalarised analytic, chunks of 16384", lambda: scalarised.in_jax(scalarised.gradient, 16_384), 65_536),
        Contender(f"JAX, jit of vmap of grad, batches of {SMALL}", jax_vmap, 20 * SMALL),
        Contender("CasADi gradient, virtual machine, 2 threads", lambda: scalarised.casadi_gradient(2, 8_192), 8_192),
        Contender("Pinocchio Jacobian in a loop, NumPy analytic", pinocchio, 1_000),
    ]


def main() -> None:
    chosen = harness.options(__doc__)
    rows = 70_000 if chosen.quick else 800_000
    sample = pa10.configurations(SMALL, seed=1)
    candidate = Contender("holdfast, 2 threads", lambda: holdfast(2), rows)
    title = "W2: gradient of the worst-case relative manipulability of the 9-joint PA10"
    expected = pa10.gradient_by_complex_step(sample)
    print(harness.race(title, candidate, peers(rows), pa10.configurations(rows), sample, expected, chosen.rounds))
    print(f"Error: against complex-step derivatives of the determinants at {SMALL} configurations.")


if __name__ == "__main__":
    main()
