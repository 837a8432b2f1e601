"""Train a small network to fold an arm so that it survives: by the gradient of the worst-case index, on the processor.

Needs PyTorch: ``pip install 'holdfast[torch]'``, then ``python examples/learn_elbow_angles.py [picture.png]``; it takes under
a minute. A planar arm of three links of 1 m is to reach points; one joint may lock. The network sees how far a point is and
chooses which way to fold: the angle of the first link, of which the other two joints follow in closed form. Its teacher is
``relative_manipulability``, differentiated by ``backward()`` like any other layer. A search over a fine grid of folds is the
best that can be done, and is what the picture compares with. The best fold jumps where a point is 1 m away, as far as a link is
long; a network is continuous, and pays for that around there.
"""

from __future__ import annotations

import sys
import time

import numpy as np
import torch

import holdfast as hf
from holdfast import arms

STEPS, BATCH, FOLDS = 1500, 512, 801


def configurations(distance, fold):
    """Joint angles (..., 3) that reach points on the x axis; a fold of -1 or 1 is the furthest that reaches them."""
    widest = torch.acos(((distance**2 - 3) / (2 * distance)).clamp(-1, 1))  # then the other two links are stretched
    first = 0.999 * fold * widest
    x, y = distance - torch.cos(first), -torch.sin(first)
    third = torch.acos(((x**2 + y**2 - 2) / 2).clamp(-1 + 1e-9, 1 - 1e-9))
    second = torch.atan2(y, x) - torch.atan2(torch.sin(third), 1 + torch.cos(third)) - first
    return torch.stack([first, second, third], dim=-1)


def main(picture: str | None) -> None:
    torch.manual_seed(1)
    torch.set_default_dtype(torch.float64)
    torch.set_num_threads(1)
    index = hf.indices.relative_manipulability(arms.load("planar-3r"), "planar")
    rho = index.to_torch()
    layers = [layer for a, b in ((1, 32), (32, 32), (32, 1)) for layer in (torch.nn.Linear(a, b), torch.nn.Tanh())]
    network = torch.nn.Sequential(*layers)
    adam = torch.optim.Adam(network.parameters(), lr=3e-3)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(adam, STEPS)
    curve, start = [], time.perf_counter()
    for _ in range(STEPS):
        distance = 0.4 + 2.2 * torch.rand(BATCH)
        value = rho(configurations(distance, network(distance[:, None] - 1.5)[:, 0])).mean()
        adam.zero_grad()
        (-value).backward()
        adam.step()
        schedule.step()
        curve.append(value.item())
    seconds = time.perf_counter() - start

    distance = torch.linspace(0.4, 2.6, 111)
    with torch.no_grad():
        learned = rho(configurations(distance, network(distance[:, None] - 1.5)[:, 0])).numpy()
        folds = torch.linspace(-1, 1, FOLDS)
        every = rho(configurations(distance[:, None].expand(-1, FOLDS), folds.expand(len(distance), -1))).numpy()
    best, typical = every.max(axis=1), np.median(every, axis=1)
    print(f"{STEPS} steps of {BATCH} points in {seconds:.1f} s")
    means = f"learned {learned.mean():.4f}, best of {FOLDS} folds {best.mean():.4f}, median {typical.mean():.4f}"
    print(f"mean worst-case index: {means}")
    print(f"within 5 % of the best at {(learned > 0.95 * best).mean():.0%} of the distances")
    if picture:
        draw(picture, np.array(curve), (distance.numpy(), learned, best, typical))


def draw(picture: str, curve, lines) -> None:
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    left.plot(curve, color="0.75", linewidth=0.8)
    left.plot(np.arange(24, len(curve) - 25), np.convolve(curve, np.ones(50) / 50, "valid"), color="C0")
    left.set(xlabel="step", ylabel="mean worst-case index of a batch", title="training", xlim=(0, len(curve)))
    distance, learned, best, typical = lines
    right.plot(distance, best, color="0.2", linewidth=2.5, label="best fold, by search")
    right.plot(distance, learned, color="C0", linestyle="--", label="learned")
    right.plot(distance, typical, color="0.65", label="median fold")
    right.set(xlabel="distance of the point (m)", ylabel="worst-case index", title="afterwards", ylim=(0, None))
    right.legend(frameon=False)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None)
