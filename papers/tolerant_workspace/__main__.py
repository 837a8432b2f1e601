"""The grid, the optimum, and RESULTS.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.report import save_png
from holdfast.kinematics.workspace import TolerantWorkspace, closed_form
from holdfast.model.arm import as_task

HERE = Path(__file__).parent
Array = NDArray[np.float64]

STEP = 20.0  # deg, of the grid of the limits of joints 2 and 3
HALVES = (10.0, 15.0, 20.0, 30.0, 45.0)  # deg, half of the range of joint 1
COARSE, FINE = 32, 1600  # radii of the integral
FINALISTS = 50  # for each half: integrated again with more radii
_CHUNK = 4000


@dataclass(frozen=True)
class Best:
    """Of one range of joint 1, the largest region on the grid.

    Attributes:
        half: Of the range of joint 1, deg.
        limits: (3, 2) deg.
        area: m^2.
        tried: Limits tried.
    """

    half: float
    limits: Array
    area: float
    tried: int


def three_links() -> closed_form.ThreeLinks:
    """The arm with three unit links."""
    arm = hf.arms.load("planar-3r")
    found = closed_form.ThreeLinks.from_task(arm, as_task(arm, "planar"))
    if found is None:
        raise ValueError("the built-in arm has no closed form")
    return found


def grid(half: float, step: float) -> Array:
    """(P, 3, 2) limits, deg, of the links: every pair of limits of joints 2 and 3 on a grid, one of two mirror images."""
    ends = np.arange(-180.0, 180.0 + step / 2, step)
    pairs = np.array([(a, b) for a in ends for b in ends if a < b])
    second = pairs[pairs.sum(axis=1) >= 0]
    first, third = np.meshgrid(np.arange(len(second)), np.arange(len(pairs)), indexing="ij")
    joints = second[first.ravel()], pairs[third.ravel()]
    return np.stack([np.broadcast_to((-half, half), joints[0].shape), *joints], axis=1)


def search(half: float, step: float = STEP) -> Best:
    """The largest region on the grid."""
    arm, limits = three_links(), grid(half, step)
    area = np.concatenate(
        [closed_form.workspace_area(arm, np.radians(limits[k : k + _CHUNK]), COARSE) for k in range(0, len(limits), _CHUNK)]
    )
    last = np.argsort(area)[-FINALISTS:]
    exact = np.array([closed_form.workspace_area(arm, np.radians(limits[k][None]), FINE)[0] for k in last])
    best = int(np.argmax(exact))
    return Best(half, limits[last[best]], float(exact[best]), len(limits))


def results(found: Sequence[Best], region: TolerantWorkspace) -> list[str]:
    """RESULTS.md."""
    largest = max(found, key=lambda b: b.area)
    shown = ", ".join(f"{a:.1f} to {b:.1f}" for a, b in np.degrees(region.limits))
    verdict = "none is larger" if largest.area <= region.size else "LARGER than the optimum, which is none"
    return [
        "# The failure-tolerant workspace of three equal links",
        "",
        "Written by `python -m papers.tolerant_workspace`. Bader and Maciejewski 2020 compute the optimum for equal links; "
        "only "
        "the abstract could be had, which gives no number. Brute force stands in for it.",
        "",
        f"`hf.tolerant_workspace(arm, task='planar', optimise=True)` finds {region.size:.4f} m^2 of {region.healthy_size:.4f} "
        "m^2 "
        f"({region.share:.1%}), for unit links, with artificial limits of {shown} deg.",
        "",
        f"Brute force: every pair of limits of joints 2 and 3 on a grid of {STEP:g} deg (one of two mirror images), "
        f"{len(found)} ranges of joint 1, {sum(b.tried for b in found)} sets of limits in all. Their areas are integrated over "
        f"{COARSE} radii, those of the {FINALISTS} largest of each range again over {FINE}. Of all, {verdict}: at most "
        f"{largest.area:.4f} m^2.",
        "",
        "| range of joint 1 (deg) | sets of limits | largest area (m^2) | with joint 2 at (deg) | joint 3 at (deg) |",
        "|---|---|---|---|---|",
        *[
            f"| {-b.half:g} to {b.half:g} | {b.tried} | {b.area:.4f} | {b.limits[1, 0]:g} to {b.limits[1, 1]:g} | "
            f"{b.limits[2, 0]:g} to {b.limits[2, 1]:g} |"
            for b in found
        ],
        "",
        "Both use the same closed form of the area; that one is checked against sampled inverse kinematics and a scan of "
        "angles in "
        "`tests/kinematics/workspace/test_tolerant_workspace.py`.",
        "",
        "![The region](region.png)",
        "",
    ]


def main() -> None:
    """Run the grid and write RESULTS.md."""
    found = [search(half) for half in HALVES]
    region = hf.tolerant_workspace(hf.arms.load("planar-3r"), task="planar", optimise=True)
    save_png(region.figures()["region"], HERE / "region.png", dpi=100)
    lines = results(found, region)
    (HERE / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
