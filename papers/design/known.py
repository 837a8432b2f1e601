"""Searches whose answer is known: no configuration beats sqrt((n - m) / n), and some arms attain it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import holdfast as hf


@dataclass(frozen=True)
class Known:
    """A search and the bound it must come to.

    Attributes:
        name: What is searched.
        arm: Where it begins.
        vary: What is open, rad and m.
        task: Rows of the pose to keep.
        region: One pose, or a region.
        poses: Of the search.
    """

    name: str
    arm: hf.Arm
    vary: dict[str, tuple[float, float]]
    task: str
    region: hf.Region
    poses: int


def planar() -> hf.Arm:
    """Three links in a plane, of unequal lengths."""
    limits = ((-2.5, 2.5), (-2.5, 2.5), (-2.5, 2.5))
    rows = [hf.DH(a=a, alpha=0.0, lower=lo, upper=up) for a, (lo, up) in zip((1.0, 0.8, 0.6), limits, strict=True)]
    return hf.Arm.from_dh(rows, name="planar 3R")


def spatial(joints: int) -> hf.Arm:
    """Turning joints whose axes are at 90 or 60 degrees in turn, with links and offsets of unequal lengths."""
    rows = [
        hf.DH(a=0.2 + 0.03 * k, alpha=float(np.deg2rad((90, -60)[k % 2])), d=0.1 + 0.02 * k, lower=-2.8, upper=2.8)
        for k in range(joints)
    ]
    return hf.Arm.from_dh(rows, name=f"spatial {joints}R")


def one_pose(arm: hf.Arm) -> hf.Region:
    """The pose of a bent configuration, alone."""
    return hf.Region.from_poses(arm.forward_kinematics(np.full(arm.n, 0.6))[None], name="one pose")


def known() -> list[Known]:
    """The searches."""
    flat, four, seven = planar(), spatial(4), spatial(7)
    lengths = {f"a{k}": (0.3, 1.5) for k in (1, 2, 3)}

    def open_(arm: hf.Arm) -> dict[str, tuple[float, float]]:
        found: dict[str, tuple[float, float]] = {}
        for k in range(1, arm.n + 1):
            found |= {f"a{k}": (0.0, 0.6), f"alpha{k}": (-np.pi / 2, np.pi / 2), f"d{k}": (0.0, 0.6)}
        return found

    return [
        Known("planar 3R, position, one point", flat, lengths, "planar", one_pose(flat), 1),
        Known(
            "planar 3R, position, 95 % of a region", flat, lengths, "planar", hf.Region.around_tool(flat, np.zeros(flat.n)), 128
        ),
        Known("spatial 4R, position, one point", four, open_(four), "position", one_pose(four), 1),
        Known("spatial 7R, pose, one pose", seven, open_(seven), "pose", one_pose(seven), 1),
    ]


def found(case: Known, store: str | None = None) -> hf.Designs:
    """The search of a case."""
    return hf.design(
        case.arm,
        case.vary,
        region=case.region,
        task=case.task,
        poses=case.poses,
        designs=256,
        local_searches=4,
        check_poses=256,
        store=store,
    )


def rows(store: str | None = None) -> list[str]:
    """Lines of the table: bound, what the given arm has, what was found."""
    lines = ["| search | bound | given arm | best design | share of the bound |", "|---|---|---|---|---|"]
    for number, case in enumerate(known()):
        result = found(case, None if store is None else f"{store}/known-{number + 1}")
        bound, best = result.index.bound, float(result.guaranteed[result.best])
        assert bound is not None
        lines.append(f"| {case.name} | {bound:.7f} | {result.start_guaranteed:.4f} | {best:.7f} | {best / bound:.6f} |")
        print(lines[-1], flush=True)
    return lines
