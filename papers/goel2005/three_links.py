"""Section 4.3: the arm with three unit links under the pseudoinverse, and Figs. 5 to 7."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

import holdfast as hf
from holdfast.control.convergence import configurations_at
from papers.claims import Claim, Verdict
from papers.numbers import beside
from papers.part import Part

Array = NDArray[np.float64]

TARGET = np.array([1.5, 1.5])
START_5, START_6, START_7 = (np.array(x) for x in ([2.0, -1.4], [-0.9, 1.5], [0.7, 2.1]))
TARGET_7 = np.array([-0.8, 0.0])
ON_MANIFOLD = 180  # starts of Fig. 5
MEAN_OVER = 400.0  # 1/Ke
FOLDED = 45 + np.degrees(np.arccos(1 / np.linalg.norm(TARGET)))  # deg, joint 1: see convergence of Fig. 6


@cache
def law() -> hf.control.Pseudoinverse:
    """The pseudoinverse with Ke = 1, on an arm whose joints turn without limits."""
    return hf.control.pseudoinverse(hf.arms.load("planar-3r").without_limits, "planar")


def postures(place: ArrayLike, joint: int, degrees: float) -> Array:
    """(2, 3) configurations, deg, of a place (2,) with one joint, from 0, at an angle: the triangle of the other two."""
    x, fixed = complex(*np.asarray(place)), np.deg2rad(degrees)
    if joint == 0:
        return _two(x - np.exp(1j * fixed), 1.0, 1.0, lambda a, b: (fixed, a - fixed, b))
    bent = 1 + np.exp(1j * fixed)  # two links that hold together
    turn = float(np.angle(bent))
    if joint == 1:
        return _two(x, abs(bent), 1.0, lambda a, b: (a - turn, fixed, b - (fixed - turn)))
    return _two(x, 1.0, abs(bent), lambda a, b: (a, b - turn, fixed))


def _two(x: complex, first: float, second: float, read: Callable[[float, float], Sequence[float]]) -> Array:
    bend = np.arccos((abs(x) ** 2 - first**2 - second**2) / (2 * first * second))
    found = []
    for b in (bend, -bend):
        a = float(np.angle(x) - np.angle(first + second * np.exp(1j * b)))
        found.append(read(a, b))
    return wrapped(np.degrees(found))


def wrapped(degrees: ArrayLike) -> Array:
    """In [-180, 180)."""
    return np.asarray((np.asarray(degrees) + 180) % 360 - 180)


def run(start: ArrayLike, joint: int, target: Array = TARGET, **options: float) -> hf.Runs:
    """From a start, deg, with a joint, from 0, locked."""
    return hf.simulate(law(), np.deg2rad(start), target, locked=[joint], **options)  # type: ignore[arg-type]


def degrees(q: Array) -> str:
    """A configuration for people, wrapped, deg."""
    return "(" + ", ".join(f"{x:.4f}" for x in wrapped(np.degrees(q))) + ")"


def away(q: Array, expected: Sequence[float]) -> float:
    """Largest difference of a joint to a configuration in deg, modulo a turn."""
    return float(np.abs(wrapped(np.degrees(q) - expected)).max())


@dataclass(frozen=True)
class Case:
    """A run to reproduce: start (deg), locked joint from 0, target, configuration at the end (deg) and error there (m)."""

    name: str
    start: tuple[float, ...]
    joint: int
    target: Array
    outcome: str
    final: tuple[float, ...] | None
    error: float | None


def cases() -> list[Case]:
    """Those of section 10.1 of the specification."""
    at_45 = postures(START_5, 1, 45)
    folded = postures(START_6, 0, FOLDED)
    low, high = at_45[np.argsort(at_45[:, 0])]
    out = [
        Case("Fig. 5", tuple(low), 1, TARGET, "converged", (-5.6173, 45, 66.1698), 0),
        Case("Fig. 5, the other elbow", tuple(high), 1, TARGET, "converged", (50.6173, 45, -111.1698), 0),
        Case("Fig. 6, theta1 = FOLDED", tuple(folded[folded[:, 1].argmin()]), 0, TARGET, "stuck", None, 1.87083),
        Case("Fig. 6, the other elbow", tuple(folded[folded[:, 1].argmax()]), 0, TARGET, "converged", None, 0),
    ]
    unreachable = {
        120: ((120, -97.7251, 0), 0.194119),
        125: ((125, -98.8754, 0), 0.342268),
        140: ((140, -104.4803, 0), 0.707241),
        160: ((160, -114.4262, 0), 1.074282),
    }
    for angle, (final, error) in unreachable.items():
        for elbow, start in zip(("", ", the other elbow"), postures(START_6, 0, angle), strict=True):
            name = f"Fig. 6, target out of reach: theta1 = {angle}{elbow}"
            out.append(Case(name, tuple(start), 0, TARGET, "stuck", final, error))
    for angle, outcome, final_7, error_7 in ((44, "stuck", (-13.9699, 158, 44), 0.2083), (60, "converged", None, 0)):
        start = postures(START_7, 2, angle)[0]
        out.append(Case(f"Fig. 7, theta3 = {angle}", tuple(start), 2, TARGET_7, outcome, final_7, error_7))
    return out


FINAL_6 = (106.8745, -52.4994, 180.0)
MEAN_RATES = ((10, -3.31), (20, -1.51), (30, -0.816), (40, -0.28))  # theta3 (deg), rad per 1/Ke
LIMITS_7 = (51.684, 43.107)  # |theta3| (deg) below which the target is out of reach, and nothing is stationary


def case_table(found: list[tuple[Case, hf.Runs]]) -> list[str]:
    """Cases beside the specification."""
    lines = [
        "| case | locked | start (deg) | outcome | at the end (deg) | largest difference (deg) | error there (m) |",
        "|---|---|---|---|---|---|---|",
    ]
    for c, r in found:
        final = FINAL_6 if "FOLDED" in c.name else c.final
        digits = 4 if "Fig. 7" in c.name else 6
        cells = [
            c.name.replace("FOLDED", f"{FOLDED:.4f}"),
            f"joint {c.joint + 1}",
            "(" + ", ".join(f"{x:.4f}" for x in c.start) + ")",
            str(r.outcome) + ("" if r.outcome == c.outcome else f" (specification: {c.outcome})"),
            degrees(r.q_final),
            "not given" if final is None else f"{away(r.q_final, final):.1g}",
            "-" if c.error is None else beside(float(r.error), c.error, 5 if "FOLDED" in c.name else digits),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def rate_table() -> list[str]:
    """Mean rates of joint 1 while the arm turns for ever."""
    lines = [
        "| theta3 (deg) | outcome | mean rate of joint 1 (rad per 1/Ke) | specification | difference |",
        "|---|---|---|---|---|",
    ]
    for angle, expected in MEAN_RATES:
        for sign in (1, -1):
            start = np.deg2rad(postures(START_7, 2, sign * angle)[0])
            turning = hf.simulate(law(), start, TARGET_7, locked=[2], time_limit=MEAN_OVER)
            mean = float(turning.q_final[0] - start[0]) / MEAN_OVER
            gap = mean / (sign * expected) - 1
            lines.append(f"| {sign * angle} | {turning.outcome} | {mean:+.4f} | {sign * expected:+.3g} | {gap:+.1%} |")
    return lines


def thresholds() -> tuple[float, float]:
    """Deg of theta3: below the first the target is out of reach, below the second runs never rest; by bisection."""

    def reached(angle: float) -> bool:
        start = postures(START_7, 2, angle)[0]
        return bool(run(start, 2, TARGET_7, time_limit=0.01).least_error() < 1e-7)

    def rests(angle: float) -> bool:
        return str(run(postures(START_7, 2, angle)[0], 2, TARGET_7).outcome) in ("stuck", "converged")

    found = []
    for low, high, true in ((48.0, 55.0, reached), (41.0, 46.0, rests)):
        while high - low > 1e-4:
            middle = (low + high) / 2
            low, high = (low, middle) if true(middle) else (middle, high)
        found.append((low + high) / 2)
    return found[0], found[1]


def manifold(place: ArrayLike, count: int) -> Array:
    """(count, 3) configurations of a place, rad, equally far apart along its self-motion manifold in joint space."""
    pose = np.eye(4)
    pose[:2, 3] = place
    return configurations_at(law().arm, law().task, pose[None], count=count, seed=0)[1]


def claims(found: dict[str, hf.Runs]) -> list[Claim]:
    """What the captions say."""
    starts = manifold(START_5, ON_MANIFOLD)
    every = hf.simulate(law(), starts, TARGET, locked=[1])
    folded = found["Fig. 6, theta1 = FOLDED"]
    random = np.random.default_rng(1).uniform(-np.pi, np.pi, (1000, 3))
    random[:, 0] = np.deg2rad(FOLDED)
    exact = hf.simulate(law(), random, TARGET, locked=[0])
    random[:, 0] += np.deg2rad(1.0)
    beyond = hf.simulate(law(), random, TARGET, locked=[0])
    reach, still = thresholds()
    turning = found["Fig. 7"]
    return [
        Claim(
            "Fig. 5 x_i = (2.0, -1.4), x_d = (1.5, 1.5), joint 2",
            "successful convergence",
            f"joint 2 at 45 deg as in Fig. 8: both elbows converge; and so do {int((every.outcome == 'converged').sum())} of "
            f"{len(every)} starts on the self-motion manifold of x_i with joint 2 locked where it is",
            "agrees; the angle is not stated for Fig. 5",
            Verdict.HOLDS,
        ),
        Claim(
            "Fig. 6 x_i = (-0.9, 1.5), x_d = (1.5, 1.5), joint 1",
            "erroneous convergence although the target is reachable: x_c and j1 line up, (j2 j3) is singular",
            f"theta1 = {FOLDED:.4f} deg: {folded.outcome} at {degrees(folded.q_final)} deg, error {folded.error:.5f} m; the "
            "other "
            f"elbow converges. Random starts at this angle: {int((exact.outcome == 'stuck').sum())} of {len(exact)} "
            f"stuck, 1 deg "
            f"beside it {int((beyond.outcome == 'stuck').sum())}",
            "it happens, but with a reachable target only where joint 1 is at 45 deg +- arccos(1 / norm(x_d)) exactly; "
            "the sign of "
            "x_i is hard to read in our text, and the angle is not stated",
            Verdict.PARTLY,
        ),
        Claim(
            "Fig. 7 x_i = (0.7, 2.1), x_d = (-0.8, 0), joint 3",
            "no convergence: the target is outside the post-failure workspace and nothing is stationary",
            f"theta3 = 30 deg: {turning.outcome}, from both elbows; out of reach below abs(theta3) = {reach:.3f} deg, never at "
            f"rest below {still:.3f} deg (by bisection; closed forms {LIMITS_7[0]} and {LIMITS_7[1]})",
            "agrees; between the two angles the arm stops short of the target. The angle is not stated",
            Verdict.HOLDS,
        ),
    ]


def result(folder: Path) -> Part:
    """Figs. 5 to 7 and their numbers."""
    from papers.goel2005 import three_link_figures as figures

    found = [(c, run(c.start, c.joint, c.target)) for c in cases()]
    named = {c.name: r for c, r in found}
    turning = [run(q, 2, TARGET_7) for q in postures(START_7, 2, 30)]
    named["Fig. 7"] = turning[0] if all(r.outcome == "moving" for r in turning) else turning[1]
    figures.figure_5_6(
        [named["Fig. 5"], named["Fig. 5, the other elbow"]], "Fig. 5: joint 2 locked at 45 deg", folder / "figure-5.png"
    )
    figures.figure_5_6(
        [named["Fig. 6, theta1 = FOLDED"], named["Fig. 6, the other elbow"]],
        f"Fig. 6: joint 1 locked at {FOLDED:.4f} deg",
        folder / "figure-6.png",
    )
    figures.figure_7(named["Fig. 7"], named["Fig. 7, theta3 = 44"], folder / "figure-7.png")
    sections = [
        "## The three-link arm beside the specification",
        "",
        "The paper gives no joint angles; these are the specification's. Starts are solved from the place of the end "
        "effector and the "
        "locked angle; configurations are wrapped. Errors with ours minus the specification's in parentheses.",
        "",
        *case_table(found),
        "",
        f"Fig. 7, mean over {MEAN_OVER:g}/Ke; the specification gives it to 2 %:",
        "",
        *rate_table(),
    ]
    return Part(claims(named), sections, {f"figure-{k}": f"Fig. {k} made again" for k in (5, 6, 7)})
