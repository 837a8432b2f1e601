"""The two-joint tool that Abdi et al. 2012 add to the PA10, searched for what the arm guarantees over the paper's region."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import SOFT, Curve, draw_cdf, style
from holdfast.kinematics.regions import builtin_region

SEED = 1
POSES, DESIGNS, CLIMBS, FRESH = 500, 256, 6, 2000
STEP = {"m": 0.005, "rad": np.deg2rad(5.0)}  # to which a workshop would round


def vary() -> dict[str, tuple[float, float]]:
    """What is open of the tool: rows 7 to 9, without the last row's theta, which turns the end effector about its own axis."""
    deg = np.pi / 180
    return {
        "a7": (-0.2, 0.2),
        "alpha7": (-150 * deg, -30 * deg),
        "d7": (0.25, 0.6),
        "theta7": (-45 * deg, 45 * deg),
        "a8": (-0.2, 0.2),
        "alpha8": (30 * deg, 150 * deg),
        "d8": (-0.15, 0.15),
        "theta8": (-45 * deg, 45 * deg),
        "a9": (-0.15, 0.15),
        "alpha9": (-45 * deg, 45 * deg),
        "d9": (0.02, 0.3),
    }


def searched(level: float, store: str | None) -> hf.Designs:
    """The search."""
    arm, region = hf.arms.load("pa10-9dof"), builtin_region("pa10-9dof")
    folder = None if store is None else f"{store}/attachment-{100 * level:.0f}"
    return hf.design(
        arm,
        vary(),
        region=region,
        level=level,
        poses=POSES,
        designs=DESIGNS,
        local_searches=CLIMBS,
        check_poses=FRESH,
        seed=SEED,
        store=folder,
    )


def rounded(found: hf.Designs) -> np.ndarray:
    """The best design as a workshop would be asked for it."""
    step = np.array([STEP[p.unit or "m"] for p in found.space.parameters])
    return np.asarray(np.clip(np.round(found.values[found.best] / step) * step, found.space.lower, found.space.upper))


def assessed(arm: hf.Arm, store: str | None) -> hf.Assessment:
    """An arm on fresh poses by the way of the paper, which shares no compiled code with the search."""
    folder = None if store is None else f"{store}/{arm.name.replace(' ', '-')}"
    region = builtin_region("pa10-9dof")
    assert region is not None
    index = hf.indices.relative_manipulability(arm)
    return hf.assess(arm, region, index, poses=FRESH, seed=SEED + 100, optimise=True, clearance=False, store=folder)


def table(found: hf.Designs) -> list[str]:
    """Parameters before and after."""
    lines = ["| parameter | paper | best | rounded | bounds |", "|---|---|---|---|---|"]
    columns = (found.space.start, found.values[found.best], rounded(found))
    for k, p in enumerate(found.space.parameters):
        cells = [p.text(float(c[k])) for c in columns]
        lines.append(f"| {p.name} | {' | '.join(cells)} | {p.text(p.lower)} to {p.text(p.upper)} |")
    return lines


def worth(name: str, run: hf.Assessment) -> str:
    """A line of the table of what an arm guarantees."""
    d = run.distribution_of(True)
    q = [float(d.quantile(p, reachable_only=False)) for p in (0.05, 0.25, 0.5)]
    cells = [f"{d.unreached / d.samples:.1%}", *[f"{x:.3f}" for x in q], f"{d.highest:.3f}"]
    return f"| {name} | {' | '.join(cells)} | {run.interval(at_least=0.2, optimised=True)} |"


def figure(runs: dict[str, hf.Assessment], path: Path) -> None:
    """Cumulative distributions before and after."""
    h = np.linspace(0, 0.6, 601)
    curves = []
    for k, (name, run) in enumerate(runs.items()):
        band = run.distribution_of(True).band()
        curves.append(Curve(h, run.cdf(h, optimised=True), f"{name}, 95 % band ±{band:.3f}", second=k == 0, band=band))
    with style():
        drawn = Figure(figsize=(8, 4.4), layout="constrained")
        axes = drawn.add_subplot()
        label = "worst-case relative manipulability at the best configuration of a pose (no unit)"
        draw_cdf(axes, curves, [], xlabel=label, ylabel="share of poses below; not reached: 0")
        axes.axhline(0.05, color=SOFT, linewidth=1.0, linestyle=(0, (1.2, 1.6)))
        axes.annotate("5 %: what 95 % of the poses have", (0.56, 0.05), (0, 3), textcoords="offset points", ha="right")
        axes.axvline(np.sqrt(3 / 9), color=SOFT, linewidth=1.0)
        axes.annotate("bound 0.577", (np.sqrt(3 / 9), 0.5), (-4, 0), textcoords="offset points", ha="right")
        axes.legend(loc="upper left")
        axes.set_title(f"The tool of Abdi et al. 2012 and a better one: {FRESH:,} fresh poses of the paper's region")
        drawn.savefig(path, dpi=110)
