"""Section 3: the self-motion manifold of the task position, and between which values each joint may lock."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.report import save_png
from holdfast.kinematics.solvers import SelfMotion
from papers.claims import Claim, Verdict
from papers.goel2005.three_links import TARGET, law
from papers.numbers import beside
from papers.part import Part

Array = NDArray[np.float64]

PRINTED = ((-24.30, 114.30), (-111.80, 111.80), (-111.80, 111.80))  # deg, section 5.1
SEED = 1
BETWEEN = 200  # configurations between two manifolds
# The specification's targets: 1 <= r <= 3, one manifold; r < 1, two, each joint 2 and 3 on two arcs; r > 3, none.
OTHERS = ((0.7, 2.1), (-0.8, 0.0), (0.3, -0.4), (2.5, 2.0))


def closed_form(x: Array) -> list[list[tuple[float, float]]]:
    """Of each joint the arcs, deg, of three unit links: the specification's, worked out from the triangle of the links."""
    r, direction = float(np.hypot(*x)), float(np.degrees(np.arctan2(x[1], x[0])))
    if r > 3:
        return [[], [], []]
    if r >= 1:
        first, other = (float(np.degrees(a)) for a in (np.arccos((r * r - 3) / (2 * r)), 2 * np.arccos((r - 1) / 2)))
        return [[(direction - first, direction + first)], [(-other, other)], [(-other, other)]]
    low, high = (float(np.degrees(2 * np.arccos((1 + s * r) / 2))) for s in (1, -1))
    return [[(-180.0, 180.0)], *[[(-high, -low), (low, high)]] * 2]


def arcs(x: Array) -> list[list[tuple[float, float]]]:
    """The same by :func:`holdfast.joint_bounds`, deg."""
    found = hf.joint_bounds(law().arm, x, task="planar", seed=SEED)
    return [[(float(np.degrees(a)), float(np.degrees(b))) for a, b in joint] for joint in found]


def farthest(ours: list[list[tuple[float, float]]], expected: list[list[tuple[float, float]]]) -> float:
    """Largest difference of an end, deg; infinite where the numbers of arcs differ."""
    if [len(a) for a in ours] != [len(b) for b in expected]:
        return float("inf")
    gaps = [
        abs(u - v)
        for a, b in zip(ours, expected, strict=True)
        for x, y in zip(a, b, strict=True)
        for u, v in zip(x, y, strict=True)
    ]
    return max(gaps, default=0.0)


def bounds_table(found: list[list[tuple[float, float]]]) -> list[str]:
    """The printed bounds beside ours."""
    lines = ["| joint | lower (deg) | upper (deg) |", "|---|---|---|"]
    for k, (((low, high),), printed) in enumerate(zip(found, PRINTED, strict=True), 1):
        lines.append(f"| {k} | {beside(low, printed[0], 2)} | {beside(high, printed[1], 2)} |")
    return lines


def others_table() -> list[str]:
    """Other targets beside the closed form."""
    lines = ["| target (m) | arcs of joints 1, 2, 3 (deg) | largest difference to the closed form (deg) |", "|---|---|---|"]
    for x in OTHERS:
        ours = arcs(np.array(x))
        shown = "; ".join(", ".join(f"{a:.4f} to {b:.4f}" for a, b in joint) or "none" for joint in ours)
        lines.append(f"| ({x[0]:g}, {x[1]:g}) | {shown} | {farthest(ours, closed_form(np.array(x))):.0e} |")
    return lines


def traced(motion: SelfMotion) -> Array:
    """(2, 3) least and greatest value of each joint on the traced manifold, deg from -180 to 180."""
    q = np.degrees((motion.q + np.pi) % (2 * np.pi) - np.pi)
    return np.stack([q.min(axis=0), q.max(axis=0)])


def boxes() -> Claim:
    """Of a target with two self-motion manifolds: configurations in which any joint may lock though they lie in no box."""
    x = np.array(OTHERS[2])
    rng = np.random.default_rng(SEED)
    (low, high), (lower, upper) = (np.radians(arcs(x)[k][arc]) for k, arc in ((1, 1), (2, 0)))
    # Joint 2 on the arc of the one manifold, joint 3 on that of the other.
    columns = [rng.uniform(float(a), float(b), BETWEEN) for a, b in ((-np.pi, np.pi), (low, high), (lower, upper))]
    q = np.stack(columns, axis=1)
    found = [
        hf.reachable_when_locked(law().arm, np.tile(x, (BETWEEN, 1)), {k: q[:, k]}, task="planar").success for k in range(3)
    ]
    return Claim(
        "5, pseudocode: B_xd, the union of the bounding boxes of all self-motion manifolds of x_d",
        "the part of a trajectory inside it is that from which the target stays in reach",
        f"x_d = ({x[0]:g}, {x[1]:g}) has two manifolds, mirror images. With joint 2 on an arc of the one and joint 3 on an "
        "arc of the "
        "other the arm is in neither box; yet x_d stays in reach, whichever joint locks, in "
        f"{int(np.all(found, axis=0).sum())} of "
        f"{BETWEEN} such configurations, drawn at random",
        "with one manifold, as for (1.5, 1.5), the box is exact. With several what counts is the union of the ranges of each "
        "joint, "
        "which `hf.workspace` takes; a box about everything would count too much",
        Verdict.PARTLY,
    )


def result(folder: Path) -> Part:
    """The bounds and the manifold."""
    found = arcs(TARGET)
    pose = np.eye(4)
    pose[:2, 3] = TARGET
    motion = hf.self_motion(law().arm, pose, "planar", spacing=0.01)
    save_png(
        replace(motion, bounds=[[(np.radians(a), np.radians(b)) for a, b in joint] for joint in found]).figures()[
            "self-motion"
        ],
        folder / "self-motion.png",
        dpi=110,
    )
    ends = np.array([joint[0] for joint in found]).T
    claim = Claim(
        "5.1 bounds of joints 1, 2, 3 for x_d = (1.5, 1.5)",
        "[-24.30, 114.30], [-111.80, 111.80], [-111.80, 111.80] deg, of the single self-motion manifold",
        ", ".join(f"[{joint[0][0]:.2f}, {joint[0][1]:.2f}]" for joint in found)
        + f" deg; {len(motion.components)} manifold, along which the joints run within "
        f"{np.abs(traced(motion) - ends).max():.0e} "
        "deg of these ends",
        "agrees; (8) is lost in our text, and these numbers confirm how we read it",
        Verdict.HOLDS if np.abs(ends.T - np.array(PRINTED)).max() < 0.006 else Verdict.FALSE,
    )
    sections = [
        "## Bounds of the joints on the self-motion manifold",
        "",
        "By (8) and (9), x_d = (1.5, 1.5); ours minus the paper's in parentheses, 0 where both round to the same digits.",
        "",
        *bounds_table(found),
        "",
        "Other targets, where the paper prints nothing, beside the specification's closed form:",
        "",
        *others_table(),
    ]
    return Part([claim, boxes()], sections, {"self-motion": "The self-motion manifold of the task position, and its bounds"})
