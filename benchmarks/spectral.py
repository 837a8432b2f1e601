"""Worst-case smallest singular value against LAPACK on every reduced Jacobian."""

from __future__ import annotations

import numpy as np

import harness
import pa10
from harness import Contender, Function


def holdfast(threads: int) -> Function:
    from holdfast import indices
    from holdfast.kernels import set_threads, thread_count

    index = indices.minimum_singular_value(pa10.ours())

    def evaluate(q: np.ndarray) -> np.ndarray:
        if thread_count() != threads:
            set_threads(threads)
        return index(q)

    return evaluate


def characteristic_length() -> float:
    from holdfast import indices

    return indices.minimum_singular_value(pa10.ours()).task.length


def lapack() -> Function:
    """Nine batches of singular values, the linear rows divided by the same characteristic length."""
    length = characteristic_length()

    def evaluate(q: np.ndarray) -> np.ndarray:
        j = pa10.jacobian(q)
        j[:, :3] /= length
        return np.min([np.linalg.svd(np.delete(j, k, axis=2), compute_uv=False)[:, -1] for k in range(pa10.N)], axis=0)

    return evaluate


def main() -> None:
    chosen = harness.options(__doc__)
    rows = 1_000 if chosen.quick else 20_000
    sample = pa10.configurations(64, seed=1)
    candidate = Contender("holdfast, 2 threads", lambda: holdfast(2), rows)
    peers = [
        Contender("holdfast, 1 thread", lambda: holdfast(1), rows),
        Contender("NumPy Jacobians, numpy.linalg.svd of each reduced one", lapack, rows),
    ]
    title = "Worst-case smallest singular value of the 9-joint PA10"
    print(harness.race(title, candidate, peers, pa10.configurations(rows), sample, lapack()(sample), chosen.rounds))
    print("Error: against the singular values of LAPACK at 64 configurations.")


if __name__ == "__main__":
    main()
