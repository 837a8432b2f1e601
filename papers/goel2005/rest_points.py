"""Sections 4.4 to 4.6: where the failed three-link arm can stop, which of these points attract, and Figs. 8 and 9."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.control.equilibria import Basins, Curves, Kind
from holdfast.interface.report import save_png
from papers.claims import Claim, Verdict
from papers.goel2005.three_links import TARGET, away, law, wrapped
from papers.numbers import beside
from papers.part import Part

Array = NDArray[np.float64]
Row = tuple[tuple[float, float, float], str, tuple[float, float]]

# The specification's table: locked joint (from 0) and angle (deg); q (deg), kind and eigenvalues of every regular rest point.
TABLE: dict[tuple[int, float], tuple[Row, ...]] = {
    (0, 0): (
        ((0, 33.8038, 75.5225), "solution", (-1, -0.1370)),
        ((0, 109.3263, -75.5225), "solution", (-1, -0.27925)),
    ),
    (0, 125): (
        ((125, -157.1061, 0), "source", (3.31541, 1.60012)),
        ((125, -98.8754, 0), "sink", (-1.30541, -0.06619)),
    ),
    (1, 45): (
        ((-173.2216, 45, 157.5), "saddle", (2.22085, -20.59738)),
        ((15.7216, 45, 157.5), "saddle", (-2.25746, 8.82651)),
        ((-5.6173, 45, 66.1698), "solution", (-1, -0.49187)),
        ((50.6173, 45, -111.1698), "solution", (-1, -0.78898)),
    ),
    (1, 100): (
        ((-42.4502, 100, -50), "source", (0.36716, 0.62402)),
        ((-17.5498, 100, -50), "saddle", (-0.46467, 0.17619)),
        ((-26.7385, 100, 130), "saddle", (-2.63981, 3.02110)),
        ((146.7385, 100, 130), "saddle", (2.09675, -4.86264)),
        ((-24.1407, 100, -5.9284), "solution", (-1, -0.16870)),
        ((14.1407, 100, -94.0716), "solution", (-1, -0.26845)),
    ),
    (1, 140): (
        ((-10.5639, 140, -70), "sink", (-1.63856, -0.12823)),
        ((-109.4361, 140, -70), "source", (1.50326, 0.55799)),
        ((124.9008, 140, 110), "saddle", (0.86188, -3.20359)),
        ((-64.9008, 140, 110), "saddle", (2.27117, -1.55501)),
    ),
    (2, 30): (
        ((-85.1071, 165, 30), "saddle", (-5.91808, 3.41776)),
        ((145.1071, 165, 30), "saddle", (5.58923, -4.65807)),
        ((-20.3730, 78.4432, 30), "solution", (-1, -0.61291)),
        ((110.3730, -108.4432, 30), "solution", (-1, -0.88565)),
    ),
    (2, 130): (
        ((48.4314, -65, 130), "sink", (-1.22073, -0.12128)),
        ((-88.4314, -65, 130), "source", (0.74794, 2.40174)),
        ((68.2331, 115, 130), "saddle", (-1.80731, 3.23737)),
        ((-108.2331, 115, 130), "saddle", (1.31303, -5.08737)),
    ),
}
# Locked angles (deg) at which the specification has a sink, those of whole lines of stationary points, and those at
# which a curve turns back, for joints 1, 2, 3.
SINKS = (((114.295, 335.705),), ((111.80, 248.20),), ((111.80, 248.20),))
LINES = ((-16.8745, 106.8745), (180.0,), (180.0,))
FOLDS = ((-9.141, 99.141), (-96.92, 96.92), (-71.84, 71.84))

# ---- at a locked angle -----------------------------------------------------------------------------------------------------


def point_table() -> tuple[list[str], float, float, int]:
    """The specification's table beside ours; largest difference of angles (deg) and of eigenvalues, and points it lacks."""
    lines = [
        "| joint locked | at (deg) | configuration (deg) | kind | eigenvalues, Ke | largest difference of an angle (deg) "
        "| of an eigenvalue, Ke | error (m) |",
        "|---|---|---|---|---|---|---|---|",
    ]
    worst = [0.0, 0.0]
    other = 0
    for (joint, angle), rows in TABLE.items():
        points = hf.stationary_points(law(), TARGET, {joint: np.deg2rad(angle)})
        other += len(points) - len(rows)
        for q, kind, eigenvalues in rows:
            k = int(np.argmin([away(p, q) for p in points.q]))
            gap = away(points.q[k], q)
            values = points.eigenvalues[k].real
            off = float(np.abs(values - np.sort(eigenvalues)[::-1]).max())
            worst = [max(worst[0], gap), max(worst[1], off)]
            shown = ", ".join(f"{x:.4f}" for x in wrapped(np.degrees(points.q[k]) + 1e-9) + 0.0)
            found = points.kinds[k]
            lines.append(
                f"| {joint + 1} | {angle:g} | ({shown}) | {found}{'' if found == kind else f' (specification: {kind})'} | "
                f"{values[0]:.5f}, {values[1]:.5f} | {gap:.0e} | {off:.0e} | {points.error[k]:.5f} |"
            )
    return lines, worst[0], worst[1], other


# ---- over the locked angle -------------------------------------------------------------------------------------------------


@cache
def curves() -> tuple[Curves, ...]:
    """The rest curves of the three joints, for the paper's target."""
    return tuple(hf.stationary_points(law(), TARGET, {joint: None}) for joint in range(3))


def range_table(found: Sequence[Curves]) -> list[str]:
    """Kinds along the curves, by locked angle."""
    lines = ["| joint locked | curve | kind | locked angle runs (deg) | family, deg |", "|---|---|---|---|---|"]
    for c in found:
        for number, curve in enumerate(c.curves, 1):
            if curve.degenerate:
                at = float(wrapped(np.degrees(np.median(curve.locked_values)) - 1e-6) + 1e-6)
                lines.append(f"| {c.joint + 1} | {number} | degenerate | {at:.4f} only | whole line of stationary points |")
                continue
            for s in curve.segments:
                first, last = np.degrees(curve.locked_values[[s.first, s.last]])
                low = min(first, last)
                shift = wrapped(low + 1e-6) - 1e-6 - low
                shape = family(c.joint, curve.q[(s.first + s.last) // 2])
                lines.append(
                    f"| {c.joint + 1} | {number} | {s.kind.word} | {first + shift:.3f} to {last + shift:.3f} | {shape} |"
                )
    return lines


def family(joint: int, q: Array) -> str:
    """Which of the specification's families a rest point belongs to."""
    angles = np.radians(wrapped(np.degrees(q)))
    if joint == 0:
        return "stretched, theta3 = 0" if np.cos(angles[2]) > 0 else "folded, theta3 = 180"
    other = 3 - joint
    straight = np.cos(angles[other] + angles[joint] / 2) > 0
    return f"theta{other + 1} = -theta{joint + 1} / 2" + ("" if straight else " + 180")


def sinks(found: Sequence[Curves]) -> list[str]:
    """Locked angles with a sink, folds, and whole lines of stationary points, beside the specification."""
    lines = [
        "| joint | sinks at locked angles (deg) | folds at (deg) | whole lines of stationary points at (deg) |",
        "|---|---|---|---|",
    ]
    for c, expected, folds, points in zip(found, SINKS, FOLDS, LINES, strict=True):
        arcs = zip(np.degrees(c.sink_arcs).ravel(), np.ravel(expected), strict=True)
        turns = np.concatenate([wrapped(np.degrees(k.locked_values[k.folds])) for k in c.curves if not k.degenerate])
        cells = [
            " to ".join(beside(float(x), e, 2) for x, e in arcs),
            ", ".join(beside(float(x), e, 2) for x, e in zip(np.sort(turns), folds, strict=True)),
            ", ".join(beside(float(x), e, 4) for x, e in zip(np.degrees(c.degenerate_angles), points, strict=True)),
        ]
        lines.append(f"| {c.joint + 1} | {' | '.join(cells)} |")
    return lines


def complement(found: Sequence[Curves]) -> float:
    """How far, deg at most, ends of sinks are from the ends of the angles at which the target is within reach."""
    reach = hf.joint_bounds(law().arm, TARGET, task="planar")
    gaps = [
        away(np.array([end]), [float(np.degrees(other))])
        for c, ((low, high),) in zip(found, reach, strict=True)
        for (a, b) in c.sink_arcs
        for end, other in ((a, high), (b, low))
    ]
    return max(gaps)


def changes(found: Sequence[Curves]) -> tuple[int, int]:
    """Ends of sinks on the curves, and those of them where a complex pair of eigenvalues crosses the imaginary axis."""
    every = crossing = 0
    for curve in (k for c in found for k in c.curves if not k.degenerate):
        ends = {end for s in curve.segments if s.kind == Kind.SINK for end in (s.first, s.last)}
        if curve.closed and curve.segments[0].kind == curve.segments[-1].kind == Kind.SINK:
            ends -= {curve.segments[0].first, curve.segments[-1].last}  # where tracing happened to begin nothing changes
        every += len(ends)
        crossing += len(ends & set(curve.hopf_points.tolist()))
    return every, crossing


# ---- Fig. 8 ----------------------------------------------------------------------------------------------------------------

LOCKED_8, GRID = 45.0, 64
SHARES = (0.51, 0.49)  # of 4000 samples, the specification's


def figure_8(path: Path) -> tuple[Basins, float]:
    """Basins, and for how much of the boundary starts on either side end at different solutions."""
    found = hf.basins(law(), TARGET, {1: np.deg2rad(LOCKED_8)}, grid=GRID)
    save_png(found.figures()["basins"], path, dpi=110)
    return found, split_by(found)


def split_by(found: Basins, beside_it: float = 0.02) -> float:
    """Share of places along the boundary with starts that end at different solutions on either side, so many rad away."""
    q, across = [], []
    for line in found.boundaries:
        kept = line[10::10]
        along = np.gradient(line, axis=0)[10::10][:, [0, 2]]
        normal = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.linalg.norm(along, axis=1, keepdims=True)
        q.append(kept)
        across.append(normal)
    centre, side = np.concatenate(q), np.zeros((sum(map(len, q)), 3))
    side[:, [0, 2]] = beside_it * np.concatenate(across)
    ends = []
    for sign in (1, -1):
        ends.append(hf.basins(law(), TARGET, {1: np.deg2rad(LOCKED_8)}, starts=centre + sign * side).end)
    return float(np.mean(ends[0] != ends[1]))


def basin_table(found: Basins) -> list[str]:
    """Shares of the starts."""
    lines = ["| basin of | configuration (deg) | share of starts | 95 % interval | specification |", "|---|---|---|---|---|"]
    for (name, share), expected in zip(found.shares, SHARES, strict=True):
        q = ", ".join(f"{x:.4f}" for x in wrapped(np.degrees(found.points.q[int(name.split()[-1]) - 1]) + 1e-9))
        lines.append(f"| {name} | ({q}) | {share.value:.1%} | {share.low:.1%} to {share.high:.1%} | {expected:.0%} |")
    return lines


# ---- all of it -------------------------------------------------------------------------------------------------------------


def claims(found: Sequence[Curves], basins: Basins, split: float, worst: tuple[float, float, int]) -> list[Claim]:
    """What sections 4.3 to 4.6 say of the three-link arm."""
    saddles = [k for k, kind in enumerate(basins.points.kind) if kind == Kind.SADDLE]
    every, crossing = changes(found)
    folded = found[0]
    return [
        Claim(
            "Fig. 8: joint 2 at 45 deg, stationary points",
            "two, S1 and S2, beside two solutions",
            f"{len(saddles)} saddles and {int((basins.points.kind == Kind.SOLUTION).sum())} solutions from "
            f"{basins.points.starts} random starts; largest difference to the specification's table over all seven locked "
            f"angles {worst[0]:.0e} deg and {worst[1]:.0e} Ke of an eigenvalue, {worst[2]} points more",
            "agrees; x_d is not stated for Fig. 8, (1.5, 1.5) is that of Fig. 5, to which the text ties it",
            Verdict.HOLDS,
        ),
        Claim(
            "Fig. 8 and 4.5: basins",
            "all trajectories converge to the solution of their basin; what is drawn to S1 and S2 parts the basins",
            f"{basins.convergence.value:.1%} of {len(basins.end)} starts converge, {basins.shares[0][1].value:.1%} and "
            f"{basins.shares[1][1].value:.1%} to either solution; {split:.0%} of the places along the stable manifolds of S1 "
            "and "
            "S2, followed backwards, have starts 0.02 rad away on either side that end at different solutions",
            "agrees; which solution the paper calls 1 is not stated",
            Verdict.HOLDS if basins.convergence.value == 1 and split > 0.95 else Verdict.PARTLY,
        ),
        Claim(
            "Fig. 9: joint 1, x_d = (1.5, 1.5)",
            "stationary curves grown from two seeds S1 and S2, with sink segments",
            f"{len(folded)} curves: one through both arms of the stretched family with sinks at {_arc(folded)} deg of joint "
            "1, and "
            "two folded lines, each at one angle ("
            + ", ".join(f"{np.degrees(x):.4f}" for x in folded.degenerate_angles)
            + " deg), on which one eigenvalue is 0 everywhere",
            "agrees, as far as the drawing can be read; the folded lines are where the determinant stays in the zero band",
            Verdict.HOLDS,
        ),
        Claim(
            "4.6, for the paper's target",
            "sink segments end where the determinant vanishes",
            f"{every} ends of sinks on the curves of the three joints: {every - crossing} where a real eigenvalue changes "
            "sign or "
            f"J loses rank, {crossing} at a crossing pair. The sinks begin where the target goes out of reach, within "
            f"{complement(found):.0e} deg",
            "true for this target; for others see the statement on 4.6 below. Where J loses rank the determinant passes "
            "through "
            "infinity, not zero, and segments must be split there, too",
            Verdict.HOLDS if not crossing else Verdict.FALSE,
        ),
    ]


def _arc(c: Curves) -> str:
    return ", ".join(f"{np.degrees(a):.2f} to {np.degrees(b):.2f}" for a, b in c.sink_arcs)


def result(folder: Path) -> Part:
    """Tables of stationary points and sinks, and Figs. 8 and 9."""
    from papers.goel2005.rest_figures import figure_9

    table, angle, eigenvalue, more = point_table()
    found = curves()
    figure_9(found, folder / "figure-9.png")
    basins, split = figure_8(folder / "figure-8.png")
    sections = [
        "## Where the arm can stop, beside the specification",
        "",
        "x_d = (1.5, 1.5), pseudoinverse; every regular rest point at seven locked angles. Ours, and how far they are from the "
        f"specification's (at most {angle:.0e} deg and {eigenvalue:.0e} Ke; it prints four and five digits); {more} points "
        "were "
        "found that it does not have.",
        "",
        *table,
        "",
        "### Over the locked angle",
        "",
        "Sinks, folds and lines of stationary points of the three joints, ours minus the specification's in parentheses:",
        "",
        *sinks(found),
        "",
        "Stretches of the curves, each by the range of the locked angle (it runs beyond 180 deg where the curve does):",
        "",
        *range_table(found),
        "",
        "### Fig. 8",
        "",
        f"Joint 2 locked at {LOCKED_8:g} deg, a grid of {GRID} x {GRID} starts over joints 1 and 3; intervals are what as many "
        "random starts would have. The specification's shares are of 4000 samples.",
        "",
        *basin_table(basins),
    ]
    titles = {"figure-8": "Fig. 8 made again", "figure-9": "Fig. 9 made again, for the three joints"}
    return Part(claims(found, basins, split, (angle, eigenvalue, more)), sections, titles)
