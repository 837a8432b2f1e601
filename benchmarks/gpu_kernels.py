"""W20: W1, W2, W5 and inverse kinematics on an NVIDIA GPU beside the processor of the same machine, in the same run.

Written without a GPU and not run on one yet. Prints a table for RESULTS.md; without a GPU it says so and ends.
"""

from __future__ import annotations

import sys
import time

import numpy as np

import holdfast as hf
import pa10
from holdfast import arms, kernels

ROWS, POSES, ROUNDS = 1_000_000, 20_000, 7


def workloads():
    """Name -> rows, and what computes them: arrays of the host in and out."""
    nine, panda = pa10.ours(), arms.load("panda")
    rng = np.random.default_rng(1)
    q, p = rng.uniform(nine.lower, nine.upper, (ROWS, 9)), rng.uniform(panda.lower, panda.upper, (ROWS, 7))
    index, measure = hf.indices.relative_manipulability(nine), hf.indices.susceptibility.torque(panda)
    poses = panda.forward_kinematics(p[:POSES])
    return {
        "W1, index": (ROWS, lambda: index(q)),
        "W2, gradient": (ROWS, lambda: index.gradient(q)),
        "W5, susceptibility": (ROWS, lambda: measure(p)),
        "inverse kinematics": (POSES, lambda: hf.solve_ik(panda, poses, seed=1).q),
    }


def main() -> None:
    try:
        kernels.set_backend("cuda")
    except hf.HoldfastError as error:
        sys.exit(f"no table: {error}")
    on_gpu = workloads()
    kernels.set_backend(None)
    here = workloads()
    print("| workload | processor, rows/s | GPU with copies, rows/s | ratio (range) | largest difference |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for name, (rows, plain) in here.items():
        gpu = on_gpu[name][1]
        off = float(np.nanmax(np.abs(plain() - gpu())))
        kernels.wait_for_compiler()
        times = []
        for _ in range(ROUNDS):
            start = time.perf_counter()
            plain()
            middle = time.perf_counter()
            gpu()
            times.append((middle - start, time.perf_counter() - middle))
        a, b = np.array(times).T
        ratios = a / b
        shown = f"{np.median(ratios):.1f} ({ratios.min():.1f} to {ratios.max():.1f})"
        print(f"| {name} | {rows / np.median(a):.3g} | {rows / np.median(b):.3g} | {shown} | {off:.0e} |", flush=True)


if __name__ == "__main__":
    main()
