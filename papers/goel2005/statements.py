"""Statements of sections 4 and 5 that can be true or false: Theorem 1, where eigenvalues change sign, and sinks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import holdfast as hf
from holdfast.control.equilibria import Kind, StationaryPoints, orbit
from papers.claims import Claim, Verdict
from papers.goel2005.three_links import law
from papers.numbers import beside
from papers.part import Part

Array = NDArray[np.float64]

SEED = 1

# ---- Theorem 1 -----------------------------------------------------------------------------------------------------------

AT = np.deg2rad([20.0, 40, 60])  # the specification's example
TRIALS = 2000


def theorem() -> list[Claim]:
    """Theorem 1, both parts, on an example and on random arms."""
    j = law().arm.jacobian(AT)[:2]
    one = law().velocity(AT, j[:, 0])
    two = law().velocity(AT, np.array([1.0, 0]))
    across = j @ j.T @ np.array([-j[1, 2], j[0, 2]])
    across /= np.linalg.norm(across)
    stuck = law().velocity(AT, across)
    rng = np.random.default_rng(SEED)
    q = rng.uniform(-np.pi, np.pi, (TRIALS, 3))
    k = rng.integers(0, 3, TRIALS)
    columns = law().arm.jacobian(q)[np.arange(TRIALS), :2, k]
    rates = law().velocity(q, columns)
    healthy = np.where(np.arange(3) == k[:, None], 0, rates)
    others = np.linalg.norm(healthy, axis=1) > 1e-9 * np.linalg.norm(rates, axis=1)
    worst, ranks = exact_form()
    return [
        Claim(
            "Theorem 1, part 1, 'if'",
            "a command in the span of the failed columns moves only failed joints",
            f"3R at (20, 40, 60) deg, joint 1, command j1: rates ({', '.join(f'{x:.4f}' for x in one)}), not (1, 0, 0); "
            "healthy "
            f"joints are commanded in {np.mean(others):.0%} of {TRIALS} random cases",
            "the proof also uses that the failed rates are orthogonal, by W, to the null space. With that condition named, the "
            "statement is true. For n = m there is no null space, and it is true as written",
            Verdict.FALSE,
        ),
        Claim(
            "Theorem 1, part 1, 'only if'",
            "if only failed joints move, the command is in the span of their columns",
            "multiply by J",
            "true",
            Verdict.HOLDS,
        ),
        Claim(
            "Theorem 1, part 2, and 4.1",
            "the arm is stuck only where the command is in that span and the post-failure weighted Jacobian is rank deficient",
            f"{TRIALS} random J, W and locked joints, n up to 7, made rank deficient: only failed joints move, up to "
            f"{worst:.0e} "
            f"of the rates, exactly for the commands of a subspace of dimension m - rank ({ranks} of {TRIALS} dimensions "
            "agree)",
            "true as a necessary condition, which is what the text claims. It is sufficient for one locked joint; with two it "
            "is "
            "not: at the same configuration with joints 1 and 2 locked, command (1, 0) is in the span, the rank is 1, and "
            "joint 3 "
            f"is commanded {two[2]:.4f}. Of all directions only ({across[0]:.4f}, {across[1]:.4f}) is stuck there "
            f"(joint 3: {abs(stuck[2]):.0e})",
            Verdict.HOLDS,
        ),
    ]


def exact_form() -> tuple[float, int]:
    """Largest share of healthy joints in the rates of stuck commands, and in how many trials the subspace has its dimension.

    The stuck commands are ``(J W^-1 J') null(S(J W^-1)')``.
    """
    rng = np.random.default_rng(SEED)
    worst, agree = 0.0, 0
    for _ in range(TRIALS):
        n = int(rng.integers(3, 8))
        m = int(rng.integers(2, n))
        k = int(rng.integers(max(1, n - m + 1), n))  # so many that the others cannot have full rank
        locked = rng.choice(n, k, replace=False)
        j, a = rng.normal(size=(m, n)), rng.normal(size=(n, n))
        weighted = j @ np.linalg.inv(a @ a.T + 0.1 * np.eye(n))
        left = weighted.copy()
        left[:, locked] = 0
        rank = np.linalg.matrix_rank(left, tol=1e-9 * np.linalg.norm(weighted))
        null = np.linalg.svd(left)[0][:, rank:]
        commands = (weighted @ j.T) @ null
        rates = weighted.T @ np.linalg.solve(weighted @ j.T, commands)
        free = np.delete(rates, locked, axis=0)
        worst = max(worst, float(np.linalg.norm(free) / np.linalg.norm(rates)))
        # and no other command is stuck: the map to healthy rates has no larger null space
        whole = np.delete(weighted.T @ np.linalg.inv(weighted @ j.T), locked, axis=0)
        agree += int(m - np.linalg.matrix_rank(whole, tol=1e-9 * np.linalg.norm(whole)) == m - rank)
    return worst, agree


# ---- eigenvalues and the limit cycle ---------------------------------------------------------------------------------------

NEAR = np.array([0.9, 0.0])  # a target inside the unit circle: joint 2 has two arcs
JOINT = 1
CYCLES = ((168.26, 6.018, 75.76), (168.30, 9.2372, 79.76), (168.36, 13.380, 88.84), (168.42, 17.770, 107.28))
GONE = 168.50  # deg


@dataclass(frozen=True)
class Window:
    """Where a curve of stationary points is a sink although the target is within reach.

    Attributes:
        fold, hopf: Ends of the window: joint 2, deg.
        eigenvalue: The one of the pair with the positive imaginary part, at the Hopf point.
        determinant: Least one from the window's inside to 171 deg.
    """

    fold: float
    hopf: float
    eigenvalue: complex
    determinant: float


@cache
def window() -> Window:
    """From the curves that :func:`holdfast.stationary_points` traces."""
    curve = next(c for c in hf.stationary_points(law(), NEAR, {JOINT: None}).curves if len(c.hopf_points))
    angle = np.degrees(curve.locked_values) % 360
    fold = next(float(angle[k]) for k in curve.folds if 160 < angle[k] < 180)
    k = next(k for k in curve.hopf_points if angle[k] < 180)
    pair = curve.eigenvalues[k]
    # The fold itself has determinant 0; beside it the curve is a saddle on one side and a sink on the other.
    beyond = (angle > fold) & (angle < 171) & np.isin(curve.kind, (Kind.SINK, Kind.SOURCE))
    least = float(np.prod(curve.eigenvalues[beyond], axis=1).real.min())
    return Window(fold, float(angle[k]), complex(pair[np.argmax(pair.imag)]), least)


def at(degrees: float) -> StationaryPoints:
    """All stationary points of the near target with joint 2 at an angle."""
    return hf.stationary_points(law(), NEAR, {JOINT: np.deg2rad(degrees)})


def kinds(points: StationaryPoints) -> tuple[int, list[str]]:
    """How many solutions, and the kinds of the others."""
    return points.kinds.count("solution"), [k for k in points.kinds if k != "solution"]


def beside_source(points: StationaryPoints, offset: float, **options: float) -> hf.Runs:
    """A run from some degrees of joint 1 beside the source near the target."""
    sources = points.of_kind(Kind.SOURCE)
    q = sources.q[int(np.argmin(sources.error))] + np.deg2rad([offset, 0, 0])
    return hf.simulate(law(), q, NEAR, locked=[JOINT], **options)  # type: ignore[arg-type]


def cycle_table() -> list[str]:
    """Limit cycles beside the specification."""
    lines = [
        "| theta2 (deg) | stationary configurations | solutions | outcome | peak to peak of joint 1 (deg) | period (1/Ke) "
        "| Floquet multiplier | error (m) |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for degrees, width, period in CYCLES:
        points = at(degrees)
        reached, others = kinds(points)
        run = beside_source(points, 3.0)
        o = orbit(run)
        lines.append(
            f"| {degrees:.2f} | {', '.join(others)} | {reached} | {run.outcome}: {o.label} | "
            f"{beside(float(np.degrees(o.amplitude[0])), width, 4 if degrees == 168.30 else 3)} | "
            f"{beside(o.period, period, 2)} | "
            f"{o.multipliers[0].real:.4f} | {o.position_error[0]:.3f} to {o.position_error[1]:.3f} |"
        )
    points = at(GONE)
    reached, others = kinds(points)
    gone = beside_source(points, 0.5)
    lines.append(f"| {GONE:.2f} | {', '.join(others)} | {reached} | {gone.outcome} | - | - | - | {gone.error:.0e} |")
    return lines


def figure_cycle(path: Path) -> None:
    """The limit cycle in the plane of the healthy joints."""
    from holdfast.interface.report import BLUE, ORANGE, SOFT, WIDTH_IN, legend_below, save_png, settle_layout, style

    points = at(168.30)
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.62, 5.0))
        axes = figure.subplots()
        for start, color, text in ((0.3, SOFT, "from inside"), (7.0, BLUE, "from outside")):
            way = beside_source(points, start).path(0, 40_001)
            early = way.time < 700
            axes.plot(*np.degrees(way.q[early][:, [0, 2]]).T, color=color, linewidth=1.0, label=f"{text}, first 700/Ke")
        late = way.time > 2900
        axes.plot(*np.degrees(way.q[late][:, [0, 2]]).T, color=ORANGE, linewidth=2.4, label="last 100/Ke of 3000/Ke")
        sources = points.of_kind(Kind.SOURCE)
        source = sources.q[int(np.argmin(sources.error))]
        axes.plot(*np.degrees(source[[0, 2]]), "o", color="white", markeredgecolor="black", label="source")
        axes.set(xlabel="joint 1, deg", ylabel="joint 3, deg", title="Joint 2 locked at 168.30 deg, target (0.9, 0) m")
        legend_below(figure, axes, 2)
        save_png(settle_layout(figure), path, dpi=110)


# ---- all of it -------------------------------------------------------------------------------------------------------------


def eigenvalues() -> list[Claim]:
    """Section 4.6, and the conclusion drawn from it in section 5."""
    w, points = window(), at(168.30)
    reached, others = kinds(points)
    run = beside_source(points, 3.0)
    o = orbit(run)
    return [
        Claim(
            "4.6 one degree of redundancy",
            "eigenvalues can change sign only at zeros of the determinant",
            f"3R, joint 2, x_d = (0.9, 0), theta3 = -theta2 / 2: at theta2 = {beside(w.hopf, 168.2262, 4)} deg a pair "
            f"+-{w.eigenvalue.imag:.3f} i crosses the imaginary axis; the determinant is above {w.determinant:.1g} at every "
            "point "
            f"traced beyond the fold at {beside(w.fold, 167.909, 3)} deg",
            "true of real eigenvalues. A complex pair crosses with a positive determinant, so zeros of the trace must be "
            "looked "
            "at, too. For the paper's own target no such point was found",
            Verdict.FALSE,
        ),
        Claim(
            "5, pseudocode",
            "if the ranges of the trajectory and of the sinks do not overlap, the task is tolerant",
            f"joint 2 locked at 168.30 deg, x_d = (0.9, 0): reachable ({reached} solutions), stationary only "
            f"{', '.join(others)}, no sink; yet a run from 3 deg beside the source never rests ({run.outcome}: {o.label}, "
            "peak to "
            f"peak of joint 1 {beside(float(np.degrees(o.amplitude[0])), 9.2372, 4)} deg, period "
            f"{beside(o.period, 79.76, 2)}/Ke, "
            f"error {o.position_error[0]:.3f} to {o.position_error[1]:.3f} m, Floquet multiplier {o.multipliers[0].real:.3f})",
            "a limit cycle attracts. The specification's scan finds such windows only for joint 2 and targets 0.85 to 1.03 m "
            "away, and none wider than a few tenths of a degree: an excellent rule of thumb, and not a guarantee",
            Verdict.FALSE,
        ),
    ]


def result(folder: Path) -> Part:
    """Statements, and the limit cycle."""
    figure_cycle(folder / "figure-limit-cycle.png")
    sections = [
        "## A limit cycle where the target is reachable and there is no sink",
        "",
        "Joint 2 locked, x_d = (0.9, 0), from 3 deg beside the source in joint 1 (0.5 deg in the last row); the orbit that "
        "the run "
        "comes to is closed by shooting. Ours minus the specification's in parentheses.",
        "",
        *cycle_table(),
    ]
    return Part([*theorem(), *eigenvalues()], sections, {"figure-limit-cycle": "The limit cycle"})
