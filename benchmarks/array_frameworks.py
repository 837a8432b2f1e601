"""W20: indices and laws inside PyTorch beside the same without it: what a call costs more, one thread, processor time."""

from __future__ import annotations

import time

import numpy as np
import torch

import harness
import holdfast as hf
import pa10

BATCHES = {1: 2000, 1000: 200, 100_000: 3}  # rows -> calls of a round
ROUNDS = 15


def seconds(call, calls: int) -> float:
    start = time.process_time()
    for _ in range(calls):
        call()
    return (time.process_time() - start) / calls


def contenders(rows: int) -> dict:
    """What is asked -> without PyTorch, and with it."""
    arm = pa10.ours()
    index, law = hf.indices.relative_manipulability(arm), hf.control.by_name("damped:0.1", arm)
    of_index, of_law = index.to_torch(), law.to_torch()
    rng = np.random.default_rng(1)
    q, v = rng.uniform(-1, 1, (rows, 9)), rng.normal(size=(rows, 6))
    x, w, y = torch.from_numpy(q), torch.from_numpy(v), torch.from_numpy(q.copy()).requires_grad_()
    weights = torch.ones(rows, dtype=torch.float64)
    return {
        "index": (lambda: index(q), lambda: of_index(x)),
        "law": (lambda: law.velocity(q, v), lambda: of_law(x, w)),
        "index and gradient, backward": (
            lambda: (index(q), index.gradient(q)),
            lambda: torch.autograd.grad(of_index(y), y, weights),
        ),
    }


def main() -> None:
    torch.set_num_threads(1)
    hf.set_threads(1)
    print("| what | rows | without, us | with PyTorch, us | more, us | ratio |\n| --- | ---: | ---: | ---: | ---: | ---: |")
    for rows, calls in BATCHES.items():
        for name, (plain, inside) in contenders(rows).items():
            plain(), inside()
            rounds = [(seconds(plain, calls), seconds(inside, calls)) for _ in range(ROUNDS)]
            a, b = (min(r) * 1e6 for r in zip(*rounds, strict=True))
            ratio = float(np.median([r[1] / r[0] for r in rounds]))
            print(f"| {name} | {rows} | {a:.1f} | {b:.1f} | {b - a:.1f} | {ratio:.2f} |", flush=True)
    print(f"\n{harness.environment()}, PyTorch {torch.__version__}")


if __name__ == "__main__":
    main()
