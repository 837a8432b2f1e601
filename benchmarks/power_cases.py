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


def on_table(arm: hf.Arm) -> hf.Clearance:
    """Return the collision model of an arm on a table at the height of its base."""
    table = hf.cell.HalfSpace("table", pose=[0.0, 0.0, -1e-3])
    return hf.Clearance(arm, cell=hf.Cell([table], may_touch=(("table", "base"), ("table", arm.joint_names[0]))))


def stow_paths() -> None:
    """Print the paths of the YAM from its park pose to a stow configuration, judged by falls in MuJoCo with all contacts."""
    arm = hf.arms.load("yam")
    friction = hf.Friction(coulomb=[0.3, 0.3, 0.3, 0.1, 0.1, 0.1], viscous=0.02)
    stow = hf.stow(arm, PARK, friction=friction, clearance=on_table(arm), speeds=[2, 2, 2, 3, 3, 3])
    paths = {
        "searched": hf.plan_stow_path(stow).curve,
        "monotone": hf.plan_stow_path(stow, monotone=True).curve,
        "straight": hf.plan_stow_path(stow, nodes=1).straight,
    }
    expected = {"searched": "364 mm, 157 mm s", "monotone": "none found", "straight": "423 mm, 206 mm s"}
    for name, curve in paths.items():
        found = "not found"
        if curve is not None:
            time, drop = curve.confirm(25)
            found = f"{1e3 * drop.max():.0f} mm, {1e3 * np.trapezoid(drop, time):.0f} mm s in {curve.time[-1]:.2f} s"
        print(f"| YAM, {name} path to a stow pose, worst drop and exposure in MuJoCo | {expected[name]} | {found} |")


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
    predicted = hf.susceptibility.tool_drop_with_friction(arm, friction)(q) * time**2 / 2
    error = np.abs(predicted - simulated) / np.maximum(np.abs(simulated), 1e-6)
    return float(np.median(error)), float(np.quantile(error, 0.9)), float(spearmanr(predicted, simulated).statistic)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=20_000)
    samples = parser.parse_args().samples
    print("### W21: power losses of open arms (simulated)\n\n| case | specification | holdfast |\n| --- | --- | --- |")
    yam = hf.arms.load("yam")
    clearance = on_table(yam)
    for coulomb in (0.0, 0.1, 0.3, 1.0):
        fall = hf.power_loss(yam, PARK, friction=hf.Friction(coulomb=coulomb), clearance=clearance)
        touched = fall.contacts
        print(
            f"| YAM, park pose, Coulomb {coulomb:g} N m, until it meets the table | 343 to 348 mm, 0.25 to 0.27 s, 2.1 "
            f"to 2.3 m/s, 1.1 kg, 2.6 to 3.0 J; about 40 cm observed | {1e3 * fall.drop:.0f} mm, {touched.time:.3f} s, "
            f"{touched.normal_speed:.1f} m/s, {touched.effective_mass:.1f} kg, {touched.energy_lost:.1f} J |"
        )
    physical = hf.power_loss(yam, PARK, friction=hf.Friction(coulomb=0.1)).physical(clearance=clearance)
    print(f"| YAM, park pose, 0.1 N m, in MuJoCo with all contacts | 364 mm at its deepest | {1e3 * physical.drop:.0f} mm |")
    for title, pose, expected in (("folded on its stops", STOWED, 0), ("zero pose", [0.0] * 6, 115)):
        drop = hf.power_loss(yam, pose, friction=hf.Friction(coulomb=0.1), clearance=clearance).drop
        print(f"| YAM, {title}, 0.1 N m, until it meets the table | {expected} mm | {1e3 * drop:.1f} mm |")
    stow_paths()
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
