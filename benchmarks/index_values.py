"""W1: worst-case relative manipulability of many configurations of the 9-joint PA10, row-major arrays in and out."""

from __future__ import annotations

import numpy as np

import harness
import native
import numpy_soa
import pa10
import scalarised
from harness import Contender, Function


def holdfast(threads: int) -> Function:
    from holdfast import indices
    from holdfast.kernels import set_threads, thread_count

    index = indices.relative_manipulability(pa10.ours())

    def evaluate(q: np.ndarray) -> np.ndarray:
        if thread_count() != threads:
            set_threads(threads)
        return index(q)

    return evaluate


def jax_vmap() -> Function:
    """What a JAX user writes first: one configuration, ``vmap``, ``jit``."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    compiled = jax.jit(jax.vmap(jax_single))
    return lambda q: np.asarray(compiled(jnp.asarray(q)))


def jax_single(q):
    """The index of one configuration in JAX."""
    import jax
    import jax.numpy as jnp

    frame = jnp.eye(4)
    axes, origins = [], []
    for i in range(pa10.N):
        axes.append(frame[:3, 2])
        origins.append(frame[:3, 3])
        c, s = jnp.cos(q[i]), jnp.sin(q[i])
        ca, sa = pa10.COS_ALPHA[i], pa10.SIN_ALPHA[i]
        link = [[c, -s * ca, s * sa, pa10.A[i] * c], [s, c * ca, -c * sa, pa10.A[i] * s], [0, sa, ca, pa10.D[i]], [0, 0, 0, 1]]
        frame = frame @ jnp.array(link)
    z = jnp.stack(axes)
    j = jnp.concatenate([jnp.cross(z, frame[:3, 3] - jnp.stack(origins)), z], axis=1).T
    y = jax.scipy.linalg.solve_triangular(jnp.linalg.cholesky(j @ j.T), j, lower=True)
    return jnp.sqrt(jnp.maximum(1 - (y * y).sum(axis=0).max(), 0))


def pinocchio() -> Function:
    import pinocchio as pin

    model, data, tool = pa10.pinocchio()

    def evaluate(q: np.ndarray) -> np.ndarray:
        j = np.empty((len(q), 6, pa10.N))
        for row, configuration in enumerate(q):
            j[row] = pin.computeFrameJacobian(model, data, configuration, tool, pin.LOCAL_WORLD_ALIGNED)
        return pa10.worst_of_jacobians(j)

    return evaluate


def robotics_toolbox() -> Function:
    chain = pa10.robotics_toolbox()
    return lambda q: pa10.worst_of_jacobians(np.stack([chain.jacob0(configuration) for configuration in q]))


def peers(rows: int) -> list[Contender]:
    return [
        Contender("holdfast, 1 thread", lambda: holdfast(1), rows),
        Contender("C++ by hand, SIMD and OpenMP, 2 threads", lambda: native.worst_relative_manipulability(2), rows),
        Contender("C++ by hand, SIMD, 1 thread", lambda: native.worst_relative_manipulability(1), rows),
        Contender("NumPy, batched determinants", lambda: pa10.worst_by_determinants, min(rows, 5_000)),
        Contender("NumPy, batch last, leverage", lambda: numpy_soa.in_chunks(numpy_soa.worst_columns), min(rows, 60_000)),
        Contender("JAX, jit of vmap", jax_vmap, min(rows, 131_072)),
        Contender("JAX, scalarised, one batch", lambda: scalarised.in_jax(scalarised.worst), min(rows, 524_288)),
        Contender("JAX, scalarised, chunks of 16384", lambda: scalarised.in_jax(scalarised.worst, 16_384), min(rows, 524_288)),
        Contender("Pinocchio Jacobian in a loop, NumPy leverage", pinocchio, min(rows, 10_000)),
        Contender("Robotics Toolbox Jacobian in a loop, NumPy leverage", robotics_toolbox, min(rows, 3_000)),
    ]


def main() -> None:
    chosen = harness.options(__doc__)
    rows = 20_000 if chosen.quick else 1_000_000
    sample = pa10.configurations(64, seed=1)
    candidate = Contender("holdfast, 2 threads", lambda: holdfast(2), rows)
    title = "W1: worst-case relative manipulability of the 9-joint PA10"
    expected = pa10.worst_by_determinants(sample)
    print(harness.race(title, candidate, peers(rows), pa10.configurations(rows), sample, expected, chosen.rounds))
    print("Error: against batched determinants at 64 configurations.")


if __name__ == "__main__":
    main()
