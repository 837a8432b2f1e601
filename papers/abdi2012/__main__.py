"""The case study on the 9-joint PA10, non-optimised part."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.assess import structure
from holdfast.assess.region import builtin_region

HERE = Path(__file__).parent
POSES = (500, 2000, 100_000)
SEED = 1


@dataclass(frozen=True)
class Claim:
    """One row of the comparison."""

    where: str
    paper: str
    ours: str
    why: str


def nominal(arm: hf.Arm) -> list[Claim]:
    """Section V.B: the pose of the nominal configuration."""
    pose = arm.forward_kinematics(hf.arms.about("pa10-9dof").home)
    x, y, z = 1000 * pose[:3, 3]
    pitch = np.rad2deg(np.arctan2(pose[0, 2], pose[0, 0])) % 360
    return [
        Claim(
            "V.B position (mm)",
            "(968, 0, 041)",
            f"({x:.2f}, {abs(y):.2f}, {z:.2f})",
            f"x differs by {968 - x:.2f} mm: Table I gives {x:.2f}, which rounds to {x:.0f}; z and y agree",
        ),
        Claim("V.B pitch (deg)", "174", f"{pitch:.3f}", "agrees"),
    ]


def original_arm() -> list[Claim]:
    """Section V.A: the 7-joint arm after an elbow failure."""
    found = structure(hf.arms.load("pa10-7dof"), "pose")
    names = ", ".join(str(k + 1) for k in found.fatal)
    return [
        Claim(
            "V.A unmodified PA10, elbow locked",
            "very close to a singularity for most configurations",
            f"exactly singular in every configuration (joint {names})",
            "stronger than stated: the self-motion never moves the elbow",
        )
    ]


def study(arm: hf.Arm, index: hf.indices.Index) -> tuple[list[Claim], list[hf.Assessment]]:
    """Sections V.C and V.D: random poses, inverse kinematics, distribution."""
    region = builtin_region("pa10-9dof")
    assert region is not None
    runs = [hf.assess(arm, region, index, poses=n, seed=SEED) for n in POSES]
    claims = []
    for run in runs:
        d = run.distribution
        lost = d.unreached / d.samples
        low, middle, high = d.quantile([0.05, 0.5, 0.95])
        claims += [
            Claim(
                f"V.C poses with a configuration in the limits, N = {d.samples}",
                "all 500" if d.samples == 500 else "not stated",
                f"{d.reached} ({lost:.1%} not found)",
                "about 7 % of the printed region cannot be reached within Table I's limits; the paper must have redrawn, "
                "or its region or limits differ from the text",
            ),
            Claim(
                f"Fig. 3, N = {d.samples}: 5 / 50 / 95 % quantile, mean",
                "no numbers in the text",
                f"{low:.3f} / {middle:.3f} / {high:.3f}, {d.mean:.3f} (band of the CDF +-{d.band(reachable_only=True):.3f})",
                "depends on which solution the inverse kinematics picks; ours starts at random",
            ),
        ]
    few, many = runs[0].distribution, runs[1].distribution
    h = np.linspace(0, 0.5, 501)
    gap = float(np.abs(few.cdf(h, True) - many.cdf(h, True)).max())
    sum_of_bands = few.band(reachable_only=True) + many.band(reachable_only=True)
    claims.append(
        Claim(
            "V.D 2000 configurations give similar results",
            "similar",
            f"largest gap between the two CDFs {gap:.3f}",
            f"{'within' if gap < sum_of_bands else 'outside'} the sum of the two 95 % bands, {sum_of_bands:.3f}",
        )
    )
    return claims, runs


def figure_3(run: hf.Assessment, path: Path) -> None:
    """Fig. 3: the index per pose, its histogram, its cumulative histogram."""
    values = run.dataset["index"].values
    values = values[np.isfinite(values)]
    figure = Figure(figsize=(7, 8), layout="constrained")
    top, middle, bottom = figure.subplots(3, 1)
    top.plot(np.arange(1, len(values) + 1), values, ".", ms=3, color="#1f4e79")
    top.set(xlabel="pose with a configuration", ylabel="worst-case rho (no unit)", ylim=(0, None))
    edges = np.linspace(0, 0.5, 41)
    middle.hist(values, edges, color="#1f4e79")
    middle.set(xlabel="worst-case relative manipulability (no unit)", ylabel="number of poses")
    band = run.distribution.band(reachable_only=True)
    h = np.linspace(0, 0.5, 501)
    f = run.cdf(h, reachable_only=True)
    bottom.plot(h, f, color="#1f4e79", label="F(h)")
    bottom.fill_between(
        h, np.clip(f - band, 0, 1), np.clip(f + band, 0, 1), color="#1f4e79", alpha=0.2, label="95 % band (DKW)"
    )
    bottom.set(xlabel="worst-case relative manipulability h (no unit)", ylabel="share of poses below h")
    bottom.legend(frameon=False)
    title = f"Fig. 3 of Abdi et al. 2012 made again: {len(values)} of {run.poses} random poses, seed {run.seed}, not optimised"
    figure.suptitle(title, fontsize=10)
    figure.savefig(path, dpi=110)


def main() -> None:
    """Make everything and write RESULTS.md."""
    arm = hf.arms.load("pa10-9dof")
    claims, runs = study(arm, hf.indices.relative_manipulability(arm))
    region = builtin_region("pa10-9dof")
    assert region is not None
    kr = hf.assess(arm, region, hf.indices.manipulability(arm), poses=2000, seed=SEED).distribution
    claims = [*nominal(arm), *original_arm(), *claims]
    claims.append(
        Claim(
            "Fig. 7, worst-case manipulability, non-optimised, N = 2000: mean",
            "no numbers in the text",
            f"{kr.mean:.3f}",
            "as for Fig. 3",
        )
    )
    claims.append(
        Claim(
            "Figs. 4 to 7, optimised curves",
            "plotted",
            "not made yet",
            "configurations are optimised in the next step of holdfast",
        )
    )
    (HERE / "figures").mkdir(exist_ok=True)
    figure_3(runs[0], HERE / "figures" / "figure-3.png")
    lines = [
        "# Abdi, Maciejewski, Nahavandi 2012: the paper's numbers and ours",
        "",
        f"Written by `python -m papers.abdi2012`, seed {SEED}. Ours are measured, the paper's are cited.",
        "",
        "| where | paper | ours | difference and why |",
        "|---|---|---|---|",
        *[f"| {c.where} | {c.paper} | {c.ours} | {c.why} |" for c in claims],
        "",
        "![Fig. 3 made again](figures/figure-3.png)",
        "",
    ]
    (HERE / "RESULTS.md").write_text("\n".join(lines))
    print("\n".join(lines))


if __name__ == "__main__":
    main()
