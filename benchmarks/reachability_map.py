"""W16: the reachability map of a Panda, intact and with each joint locked at its home value, by samples; one thread."""

from __future__ import annotations

import os

os.environ["HOLDFAST_THREADS"] = "1"  # the peer has one

import numpy as np

import harness
import panda
from harness import Spread, number, table

CELL_SIZE = 0.1  # m
BANDS = 3
HOME = np.array([0.0, -np.pi / 4, 0.0, -3 * np.pi / 4, 0.0, np.pi / 2, np.pi / 4])
FEW, MANY = 20_000, 500_000  # configurations for the intact arm and for each lock, in the peer and in holdfast


def holdfast(samples: int) -> np.ndarray:
    """Pairs of a cell and a direction that are reached, intact and by locked joint (8,)."""
    import holdfast as hf

    result = hf.reachability_map(panda.ours(), at=HOME, cell_size=CELL_SIZE, bands=BANDS, samples=samples)
    return np.append(result.reached.sum(), result.reached_locked.sum(axis=(0, 2)))


def pinocchio(samples: int) -> np.ndarray:
    """The same with Pinocchio's forward kinematics of one configuration at a time; the cells are counted with NumPy."""
    import pinocchio as pin

    model, data, tool = panda.pinocchio()
    generator = np.random.default_rng(1)
    found = []
    for joint in range(-1, 7):
        q = generator.uniform(model.lowerPositionLimit, model.upperPositionLimit, (samples, 7))
        if joint >= 0:
            q[:, joint] = HOME[joint]
        points, axes = np.empty((samples, 3)), np.empty((samples, 3))
        for row, configuration in enumerate(q):
            pin.forwardKinematics(model, data, configuration)
            pose = pin.updateFramePlacement(model, data, tool)
            points[row], axes[row] = pose.translation, pose.rotation[:, 2]
        cells = np.rint((points - [0, 0, 0.333]) / CELL_SIZE).astype(np.int64) + 1000
        band = np.minimum((axes[:, 2] + 1) / 2 * BANDS, BANDS - 1).astype(np.int64)
        sector = (np.arctan2(axes[:, 1], axes[:, 0]) / np.pi * BANDS % (2 * BANDS)).astype(np.int64) % (2 * BANDS)
        found.append(np.unique((cells @ [4_000_000, 2000, 1]) * 100 + band * 2 * BANDS + sector))
    return np.array([len(np.unique(np.concatenate(found))), *map(len, found[1:])])


def main() -> None:
    chosen = harness.options(__doc__)
    few, many = (2_000, 20_000) if chosen.quick else (FEW, MANY)
    ours, theirs = holdfast(few), pinocchio(few)
    first, second = harness.alternate(lambda: holdfast(many), lambda: pinocchio(few), chosen.rounds)
    rates = [8 * many / t / 1e6 for t in first], [8 * few / t / 1e6 for t in second]
    ratio = Spread.of([x / y for x, y in zip(*rates, strict=True)])
    difference = float((np.abs(ours - theirs) / theirs).max())
    name = "Pinocchio, one configuration at a time, cells with NumPy"
    rows = [
        ["**holdfast**", number(Spread.of(rates[0]).median), "1", f"{8 * many:,} configurations"],
        [name, number(Spread.of(rates[1]).median), str(ratio), f"{8 * few:,} configurations"],
    ]
    print(table("W16: reachability map of a Panda", ["contender", "M/s", "holdfast is faster by (range)", "note"], rows))
    print(
        f"With {few:,} random configurations each, the numbers of reached pairs of cell and direction differ by at most "
        f"{100 * difference:.2g} % (intact and by locked joint); the random numbers differ.\n"
    )
    print(harness.environment())


if __name__ == "__main__":
    main()
