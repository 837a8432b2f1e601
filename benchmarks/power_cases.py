"""Power losses of open arms next to published numbers, all simulated: YAM, SO-101, and the closed form of the tool drop.

Sources of the published numbers: Positronic#782 (YAM, "~40 cm" from the park pose, observed); SO-101 has none.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

import holdfast as hf

Array = np.ndarray[Any, np.dtype[np.float64]]
PARK = [0.0, 1.047, 1.047, 0.0, 0.0, 0.0]  # rad
STOWED = [0.0, 0.0, 0.0, 1.45, 0.0, 0.0]


def lowest_points(arm: hf.Arm, q: Array) -> Array:
    """(N,) height of the lowest point of the capsules of all moving links but the first, m."""
    capsules = hf.Clearance(arm).capsules
    frames, heights = arm.frames(q), []
    for part in capsules.parts:
        if part.link > 0:
            upwards, height = frames[:, part.link + 1, 2, :3], frames[:, part.link + 1, 2, 3]
            heights += [upwards @ np.asarray(point) + height - part.radius for point in (part.start, part.end)]
    return np.min(heights, axis=0)


def fall_to_table(pose: list[float], coulomb: float) -> tuple[float, float, float]:
    """Drop of the YAM's tool, m, time, s, and downward speed of the tool, m/s, when a link first meets the base plane."""
    arm = hf.arms.load("yam")
    fall = hf.power_loss(arm, pose, friction=hf.Friction(coulomb=coulomb), duration=0.6)
    times = np.arange(0.0, 0.6, 5e-4)
    below = np.flatnonzero(lowest_points(arm, fall.q_at(times)) < 0)
    if not below.size:
        return float(fall.drop), np.nan, np.nan
    contact = times[below[0]]
    before, drop = fall.drop_at([contact - 1e-3, contact])
    return float(drop), float(contact), float(drop - before) / 1e-3


def holding_fraction(name: str, coulomb: float, samples: int) -> float:
    """Fraction of the configurations, uniform within the limits, in which an arm holds with this Coulomb friction, N m."""
    arm = hf.arms.load(name)
    q = np.random.default_rng(1).uniform(arm.lower, arm.upper, (samples, arm.n))
    return float(np.mean(hf.holds(arm, q, friction=hf.Friction(coulomb=coulomb)).holds))


def drop_errors(name: str, friction: hf.Friction, samples: int, time: float) -> tuple[float, float, float]:
    """Median and 90 % quantile of the relative error of alpha t^2/2, and its rank correlation with the simulation."""
    from scipy.stats import spearmanr

    arm = hf.arms.load(name)
    q = np.random.default_rng(2).uniform(arm.lower, arm.upper, (samples, arm.n))
    simulated = hf.power_loss(arm, q, friction=friction, stops=False, duration=time).drop_at(time)
    predicted = hf.susceptibility.tool_drop(arm)(q) * time**2 / 2
    error = np.abs(predicted - simulated) / np.maximum(np.abs(simulated), 1e-6)
    return float(np.median(error)), float(np.quantile(error, 0.9)), float(spearmanr(predicted, simulated).statistic)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=20_000)
    samples = parser.parse_args().samples
    print("### W21: power losses of open arms (simulated)\n\n| case | specification | holdfast |\n| --- | --- | --- |")
    for coulomb in (0.0, 0.1, 0.3, 1.0):
        drop, contact, speed = fall_to_table(PARK, coulomb)
        print(
            f"| YAM, park pose, Coulomb friction {coulomb:g} N m, until a link meets the base plane | 343 to 348 mm; about "
            f"40 cm observed | {1e3 * drop:.0f} mm after {contact:.3f} s, tool at {speed:.1f} m/s downwards |"
        )
    for title, pose, expected in (("folded on its stops", STOWED, 0), ("zero pose", [0.0] * 6, 115)):
        drop = fall_to_table(pose, 0.1)[0]
        print(f"| YAM, {title}, 0.1 N m, until a link meets the base plane | {expected} mm | {1e3 * drop:.1f} mm |")
    fall = hf.power_loss(hf.arms.load("so101"), np.zeros(5))
    for time, expected in ((0.1, 19), (0.5, 194), (2.0, 395)):
        print(f"| SO-101, straight out, {time:g} s | {expected} mm | {1e3 * float(fall.drop_at(time)):.0f} mm |")
    for coulomb, expected in ((0.052, 0.21), (0.4, 49)):
        percent = 100 * holding_fraction("so101", coulomb, samples)
        print(f"| SO-101, configurations that hold with {coulomb:g} N m | {expected:g} % | {percent:.2f} % of {samples:,} |")
    none, dry = hf.Friction(viscous=0.0), hf.Friction(coulomb=0.1, viscous=0.0)
    for name in ("panda", "yam"):
        for label, friction, time in (("none", none, 0.05), ("none", none, 0.1), ("none", none, 0.2), ("0.1 N m", dry, 0.1)):
            middle, high, rank = drop_errors(name, friction, samples, time)
            print(
                f"| {name}, alpha t^2/2 at {1e3 * time:g} ms, friction {label} | median at most 2 % at 100 ms | median "
                f"{100 * middle:.2g} %, 90 % below {100 * high:.2g} %, rank correlation {rank:.4f} |"
            )


if __name__ == "__main__":
    main()
