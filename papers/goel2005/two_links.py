"""Section 4.2: the arm with two unit links, joint 1 locked at 0, and Figs. 1 to 4."""

from __future__ import annotations

from pathlib import Path as File

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from papers.claims import Claim, Verdict
from papers.goel2005.two_link_motion import CASES, START, Ended, ended, hand, law, rate, runs, target, wrapped
from papers.numbers import beside
from papers.part import Part

Array = NDArray[np.float64]

SEED = 1
PERIOD = 3.6276  # of D, s
# rho = 2: phi (deg), angle of joint 2 at rest (deg, wrapped), error there (m)
AT_REST = (
    (75, 28.0389, 1.506658),
    (90, 53.1301, 1.341641),
    (105, 76.3055, 1.221160),
    (135, 119.2776, 1.072220),
    (150, 139.7922, 1.031171),
    (180, 180.0, 1.0),
)
NEARLY_60 = 60.001  # deg: the limit that the specification gives is that of phi -> 60


def period(moving: Ended) -> float:
    """Of the error of a run that never stops, s."""
    middle = moving.path.error - moving.path.error.mean()
    k = np.flatnonzero((middle[1:] > 0) & (middle[:-1] <= 0))
    time, step = moving.path.time, moving.path.time[1]
    return float(np.diff(time[k] + step * middle[k] / (middle[k] - middle[k + 1])).mean())


def table(found: list[Ended]) -> list[str]:
    """The four cases beside the specification."""
    lines = [
        "| case | target (rho, phi) | outcome | rate of joint 2 at the start (rad/s) | joint 2 at the end (deg) | wrapped "
        "| error at the start (m) | at the end | least possible | greatest on the way |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for f in found:
        c, run = f.case, f.run
        start, end, least, most = c.errors
        cells = [
            f"{c.name}, {c.what}",
            f"({c.rho:g} m, {c.phi:g} deg)",
            str(run.outcome),
            beside(f.rate, c.rate),
            "-" if c.angle is None else beside(f.angle, c.angle, 4),
            "-" if c.angle is None else beside(float(wrapped(f.angle)), float(wrapped(c.angle)), 4),
            beside(float(f.path.error[0]), start),
            "-" if end is None else beside(float(run.error), end),
            beside(float(run.least_error()), least),
            "-" if most is None else beside(float(f.path.error.max()), most),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    moving = found[-1]
    low, high = moving.path.error.min(), moving.path.error.max()
    return [
        *lines,
        "",
        f"D: the error goes to and fro between {low:.6f} and {high:.6f} m with a period of "
        f"{beside(period(moving), PERIOD, 4)} s; "
        f"the rate of joint 2 stays within {np.ptp(np.gradient(moving.path.q[:, 1], moving.path.time)):.0e} rad/s of itself.",
    ]


def rest_table() -> list[str]:
    """Rest angles for rho = 2 beside the specification."""
    phi = [row[0] for row in AT_REST]
    found = runs(2, phi)
    rows = []
    for k, (degrees, angle, error) in enumerate(AT_REST):
        at = float(np.rad2deg(found.q_final[k, 1]) % 360)
        rows.append(f"| {degrees} | {found.outcome[k]} | {beside(at, angle, 4)} | {beside(float(found.error[k]), error)} |")
    nearly = runs(2, NEARLY_60)
    return [
        "| phi (deg) | outcome | joint 2 at rest, wrapped (deg) | error there (m) |",
        "|---|---|---|---|",
        *rows,
        f"| {NEARLY_60:g} | {nearly.outcome} | {wrapped(np.rad2deg(nearly.q_final[1])):.4f} | "
        f"{beside(float(nearly.error), np.sqrt(3), 3)}, against the limit sqrt(3) |",
    ]


def formula() -> Claim:
    """Eq. (15) against the law itself."""
    rng = np.random.default_rng(SEED)
    angle = rng.uniform(0.2, np.pi - 0.2, 2000) * rng.choice([-1, 1], 2000)
    x = target(rng.uniform(0.5, 2.5, 2000), rng.uniform(-180, 180, 2000))
    q = np.stack([np.zeros(2000), angle], axis=1)
    off = np.abs(law().velocity(q, x - hand(angle))[:, 1] - rate(angle, x)).max()
    return Claim(
        "(15) rate of joint 2",
        "lost in our text; reconstructed as (2 - Xd) cot(theta2 / 2) - Yd",
        f"largest difference to the simulated law over 2000 random cases {off:.0e} rad/s",
        "the reconstruction holds, and gives -Yd on the line Xd = 2, as the text says",
        Verdict.HOLDS,
    )


def sweep() -> list[Claim]:
    """What the text says of all targets at 1 m and at 2 m."""
    phi = np.arange(-179.5, 180, 1.0)
    near = runs(1, phi)
    arrive = near.outcome == "converged"
    grows = np.sin(START[1] - np.deg2rad(phi)) * rate(START[1], target(1, phi)) > 0
    far = runs(2, phi)
    rest, excess = far.outcome == "stuck", far.excess_error
    worst = np.argmax(np.where(rest, far.error, 0))
    return [
        Claim(
            "4.2 case 1: targets at 1 m from joint 2",
            "for almost all phi the trajectory is drawn to the target",
            f"{int(arrive.sum())} of {len(phi)} targets on the circle, 1 deg apart, are reached",
            "agrees; phi = 0 is the exception (case B)",
            Verdict.HOLDS if arrive.all() else Verdict.PARTLY,
        ),
        Claim(
            "4.2 case 1: the error at first",
            "increases in large regions of theta2 and phi; joint 2 may go a long way",
            f"for {np.mean(grows):.0%} of those targets the error grows at first; joint 2 turns up to "
            f"{np.rad2deg(np.ptp(np.stack([near.q_low[:, 1], near.q_high[:, 1]]), axis=0)).max():.0f} deg",
            "agrees: it never crosses theta2 = 0, where the arm is singular",
            Verdict.HOLDS,
        ),
        Claim(
            "4.2 case 2: other distances from joint 2",
            "the end effector almost always does not converge to the point closest to the target",
            f"rho = 2 m: {int(rest.sum())} of {len(phi)} stop, {np.mean(excess[rest] > 1e-6):.0%} of them elsewhere "
            "than "
            f"at the closest point; their error is largest, {far.error[worst]:.3f} m, at phi = {phi[worst]:g} deg",
            "agrees, and with it that the error is least at phi = 180 deg and largest close to 60",
            Verdict.HOLDS,
        ),
        Claim(
            "4.2 rho = 2 m, abs(phi) < 60 deg",
            "not said in the text; its Fig. 4 has the cross-bar of an H there",
            f"{int((far.outcome[np.abs(phi) < 60] == 'undecided').sum())} of {int((np.abs(phi) < 60).sum())} targets: the arm "
            "runs "
            "into the stretched configuration in a finite time, where its Jacobian has no inverse",
            "`hf.simulate` calls it undecided, singular: the specification finds the same",
        ),
    ]


def claims(found: list[Ended]) -> list[Claim]:
    """The four cases."""
    a, b, c, d = found
    everywhere = np.stack([np.zeros(35), np.deg2rad(np.arange(15, 360, 10))], axis=1)
    still = hf.simulate(law(), everywhere, b.run.target, locked=[0])
    return [
        formula(),
        Claim(
            "4.2 A = (1 m, 45 deg)",
            "convergence to the task position",
            f"{a.run.outcome}, error {a.run.error:.0e} m, joint 2 turns by {abs(a.angle + 30):.0f} deg the long way round",
            "agrees",
            Verdict.HOLDS,
        ),
        Claim(
            "4.2 B = (1 m, 0 deg)",
            "no motion, whatever the angle of joint 2",
            f"{b.run.outcome} after {b.run.time:g} s: joint 2 is commanded {abs(b.rate):.0e} rad/s; "
            f"{int((still.path_length < 1e-9).sum())} of {len(still)} other angles of joint 2 do not move either",
            "agrees; left out are 0 and 180 deg, where the arm is singular",
            Verdict.HOLDS,
        ),
        Claim(
            "4.2 C = (2 m, 120 deg)",
            "converges to a position that is not closest to C",
            f"{c.run.outcome}, error {c.run.error:.6f} m where {c.run.least_error():.6f} m could be had",
            "agrees",
            Verdict.HOLDS,
        ),
        Claim(
            "4.2 D = (2 m, 60 deg)",
            "does not converge: joint 2 turns at the constant rate -Yd",
            f"{d.run.outcome}, rate {d.rate:.6f} rad/s, period {period(d):.4f} s",
            "agrees",
            Verdict.HOLDS,
        ),
        *sweep(),
    ]


def result(folder: File) -> Part:
    """Figs. 1 to 4 and their numbers."""
    from papers.goel2005 import two_link_figures as figures

    found = [ended(case) for case in CASES]
    figures.figure_1(found[2], folder / "figure-1.png")
    figures.figure_2(found, folder / "figure-2.png")
    figures.figure_3_4(1, found[:2], folder / "figure-3.png")
    figures.figure_3_4(2, found[2:], folder / "figure-4.png")
    sections = [
        "## The two-link arm beside the specification",
        "",
        "Start at theta1 = 0, theta2 = -30 deg, joint 1 locked, Ke = 1/s. In parentheses ours minus the specification's; 0 "
        "where "
        "both round to the same digits.",
        "",
        *table(found),
        "",
        "Targets at rho = 2 m, the same start:",
        "",
        *rest_table(),
    ]
    titles = {f"figure-{k}": f"Fig. {k} made again" for k in (1, 2, 3, 4)}
    return Part(claims(found), sections, titles)
