"""What is believed of arms that lose a joint, and what certificates say; statements of papers that samples left open."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from papers.claims import Claim, Verdict, table

import holdfast as hf

HERE = Path(__file__).parent
Array = NDArray[np.float64]

WORKING = ((-45, 45), (-60, 45), (-45, 45), (-118, -103.5), (-90, 90), (50, 145), (-90, 90))  # deg, of a Panda
WHOLE = 0.0927  # ceiling over all of these
AROUND, NEAR = 5.0, 0.04  # deg about the greatest manipulability, and the ceiling there
READY, KEPT = 10.0, 0.025  # deg about the pose that Franka calls ready, and the ceiling there
NOMINAL, FLOOR = 2.0, 0.11  # deg about the nominal configuration of the PA10, and the floor there
SAMPLES, SEED = 100_000, 1
TARGET, RANGES = (1.5, 1.5), ((-24.30, 114.30), (-111.80, 111.80), (-111.80, 111.80))  # Goel 2005, 5.1: m, deg
AWAY, NO_ANGLE = (-0.8, 0.0), 51.684  # Goel 2005, Fig. 7: m, deg
EDGE, SIDE = 1.0, 0.001  # deg left out at each end of a range; m, of the box about a target


@dataclass(frozen=True)
class Checked:
    """A proof, and what the verifier said of it.

    Attributes:
        name: Of the claim, for the table.
        proof: As :func:`holdfast.certify` gives it.
        check: As :func:`holdfast.check_certificate` does.
    """

    name: str
    proof: Any
    check: Any

    @property
    def whole(self) -> bool:
        """Whether all is proved, and every leaf accepted."""
        return bool(self.check.ok and self.check.undecided == 0)

    @property
    def row(self) -> str:
        """Of the table of certificates."""
        occurs = f"{self.proof.value:.6f}" if hasattr(self.proof, "value") else ""
        leaves = f"{self.check.accepted:,} of {self.check.leaves:,}"
        return f"| {self.name} | {float(self.check.undecided):.2g} | {leaves} | {self.check.rejected} | {occurs} |"


def checked(name: str, claim: Any, **how: Any) -> Checked:
    """Search, write, check."""
    proof = hf.certify(claim, **how)
    with tempfile.TemporaryDirectory() as folder:
        return Checked(name, proof, hf.check_certificate(proof.write(Path(folder) / "one.certificate")))


def within(arm: hf.Arm, middle: Array, degrees: float) -> Array:
    """(n, 2) rad about a configuration, within limits."""
    half = np.deg2rad(degrees)
    return np.column_stack([np.maximum(middle - half, arm.lower), np.minimum(middle + half, arm.upper)])


def manipulability(arm: hf.Arm, q: Array) -> Array:
    """(N,) of the healthy arm, all six rows, lengths in m."""
    jacobian = arm.jacobian(q)
    return np.asarray(np.sqrt(np.linalg.det(jacobian @ jacobian.swapaxes(1, 2))))


def dexterous(arm: hf.Arm) -> Array:
    """(n,) rad, whole degrees: near the greatest manipulability of samples and random climbs."""
    rng = np.random.default_rng(SEED)
    q = rng.uniform(arm.lower, arm.upper, (SAMPLES, arm.n))
    value = manipulability(arm, q)
    some = np.argsort(-value)[:32]
    q, value = q[some], value[some]
    for step in 0.2 * 0.93 ** np.arange(150):
        moves = rng.normal(size=q.shape) * rng.integers(0, 2, q.shape) * step
        moved = np.clip(q + moves, arm.lower, arm.upper)
        found = manipulability(arm, moved)
        better = found > value
        q[better], value[better] = moved[better], found[better]
    return np.asarray(np.deg2rad(np.round(np.rad2deg(q[value.argmax()]))))


def beliefs() -> tuple[list[Claim], list[Checked]]:
    """Two ceilings for a Panda, and one about the pose in which it waits."""
    arm = hf.arms.load("panda")
    rho = hf.indices.relative_manipulability(arm, "pose")
    best = dexterous(arm)
    home = np.array(hf.arms.about("panda").home)
    boxes = np.deg2rad(WORKING), within(arm, best, AROUND), within(arm, home, READY)
    names = "working ranges", f"{AROUND:g} deg about the greatest manipulability", f"{READY:g} deg about the ready pose"
    tops = WHOLE, NEAR, KEPT
    found = [
        checked(f"Panda, ceiling {top}: {name}", hf.certificates.ceiling_claim(arm, box, top))
        for name, box, top in zip(names, boxes, tops, strict=True)
    ]
    rng, most = np.random.default_rng(SEED), []
    for box in boxes:
        most.append(float(rho(rng.uniform(box[:, 0], box[:, 1], (SAMPLES, arm.n))).max()))
    at = ", ".join(f"{x:.0f}" for x in np.rad2deg(best))
    whole, near, ready = found
    return [
        Claim(
            "popular belief: with a joint more than the task has rows, an arm can spare any one",
            "a seventh joint makes it tolerant",
            f"a Panda within working ranges of 15 to 180 deg: {whole.proof.value:.4f} of the manipulability occurs whatever "
            f"locks, and **nowhere more than {WHOLE}** ({said(whole)})",
            f"some lock costs more than nine tenths in every configuration; {SAMPLES:,} samples found {most[0]:.4f} at most "
            "and could not say 'nowhere'. Positions alone are another matter: after any lock at least 99.97 % of the published "
            "cube of 0.30 m is proved in reach (the rest, corners among it, is undecided)",
            Verdict.FALSE if whole.whole else Verdict.OPEN,
        ),
        Claim(
            "popular belief: where manipulability is greatest the arm is safest",
            "dexterous means tolerant",
            f"within {AROUND:g} deg of the Panda's greatest manipulability, at ({at}) deg, {near.proof.value:.4f} occurs, and "
            f"**nowhere more than {NEAR}** ({said(near)})",
            "0.31 occurs elsewhere (0.378 is the most that any 7-joint arm can have); the self-motion there hardly moves some "
            f"joints, so that their lock leaves next to nothing. {SAMPLES:,} samples found {most[1]:.4f} at most",
            Verdict.FALSE if near.whole else Verdict.OPEN,
        ),
        Claim(
            "popular belief: the pose in which an arm waits for work is a good one to begin from",
            "ready",
            f"within {READY:g} deg of the Panda's ready pose {ready.proof.value:.4f} occurs, and **nowhere more than {KEPT}** "
            f"({said(ready)})",
            "in it the self-motion swings the elbow to the side and leaves joints 2, 4 and 6 where they are: 0, exactly there. "
            f"{SAMPLES:,} samples found {most[2]:.4f} at most",
            Verdict.FALSE if ready.whole else Verdict.OPEN,
        ),
    ], found


def nine_joints() -> tuple[list[Claim], list[Checked]]:
    """The study of the PA10: its elbow, and its nominal configuration."""
    seven, nine = hf.arms.load("pa10-7dof"), hf.arms.load("pa10-9dof")
    elbow = checked("PA10, 7 joints, structural zero: elbow", hf.certificates.structural_zero_claim(seven, 3))
    home = np.array(hf.arms.about("pa10-9dof").home)
    box = within(nine, home, NOMINAL)
    floor = checked(
        f"PA10, 9 joints, floor {FLOOR}: {NOMINAL:g} deg about the nominal configuration",
        hf.certificates.floor_claim(nine, box, FLOOR),
    )
    at_home = float(hf.indices.relative_manipulability(nine, "pose")(home))
    return [
        Claim(
            "Abdi 2012, V.A: unmodified PA10, elbow locked",
            "very close to a singularity for most configurations",
            f"**singular in every configuration**: relative manipulability after its lock is 0 ({said(elbow)})",
            "a structural zero, proved in exact fractions: axes 1 to 3 meet in one point, and axes 5 to 7 in another",
            Verdict.HOLDS if elbow.whole else Verdict.OPEN,
        ),
        Claim(
            "Abdi 2012, V.B: the nominal configuration of the PA10 with nine joints is fault-tolerant",
            "chosen for it",
            f"within {NOMINAL:g} deg of it **at least {FLOOR} is left whatever locks**, and {at_home:.4f} in it; the worst "
            f"that was found there is {floor.proof.value:.4f} ({said(floor)})",
            "a floor over all nine joints at once, where the study has single configurations",
            Verdict.HOLDS if floor.whole else Verdict.OPEN,
        ),
    ], [elbow, floor]


def three_links() -> tuple[list[Claim], list[Checked]]:
    """Goel 2005: which locked angles leave a target in reach, for all of them."""
    arm = hf.arms.load("planar-3r")
    arm = arm.with_limits([-np.pi] * 3, [np.pi] * 3)
    kept, lost = [], []
    for joint, (low, high) in enumerate(RANGES):
        inner = np.deg2rad([low + EDGE, high - EDGE])
        kept.append(
            checked(
                f"three links, reach: joint {joint + 1} locked at {low + EDGE:.2f} to {high - EDGE:.2f} deg",
                hf.certificates.reach_claim(arm, TARGET, SIDE, locked={joint: tuple(inner)}),
            )
        )
        for pair in ((-180.0, low - EDGE), (high + EDGE, 180.0)):
            lost.append(
                checked(
                    f"three links, out of reach: joint {joint + 1} locked at {pair[0]:.2f} to {pair[1]:.2f} deg",
                    hf.certificates.out_of_reach_claim(arm, TARGET, SIDE, locked={joint: tuple(np.deg2rad(pair))}),
                )
            )
    beyond = NO_ANGLE - EDGE / 10
    away = checked(
        f"three links, out of reach of Fig. 7: joint 3 locked at {-beyond:.2f} to {beyond:.2f} deg",
        hf.certificates.out_of_reach_claim(arm, AWAY, SIDE, locked={2: tuple(np.deg2rad([-beyond, beyond]))}),
    )
    every = [*kept, *lost]
    return [
        Claim(
            "Goel 2005, 5.1: bounds of joints 1, 2, 3 for x_d = (1.5, 1.5)",
            "[-24.30, 114.30], [-111.80, 111.80], [-111.80, 111.80] deg",
            f"**in reach at every locked angle** inside, **at none** outside, for every target within {SIDE / 2 * 1000:g} mm "
            f"of x_d along each axis, up to {EDGE:g} deg on either side of each bound ({said(*every)})",
            "nine certificates; before, the self-motion manifold was traced at points",
            Verdict.HOLDS if all(one.whole for one in every) else Verdict.OPEN,
        ),
        Claim(
            "Goel 2005, Fig. 7: x_d = (-0.8, 0), joint 3",
            "the target is outside the post-failure workspace",
            f"**at every locked angle** up to {beyond:.2f} deg to either side no configuration reaches it ({said(away)})",
            "before, by bisection: 51.684 deg",
            Verdict.HOLDS if away.whole else Verdict.OPEN,
        ),
    ], [*every, away]


def said(*found: Checked) -> str:
    """What was checked."""
    leaves, wrong = sum(one.check.accepted for one in found), sum(one.check.rejected for one in found)
    open_ = max(one.check.undecided for one in found)
    return f"{leaves:,} boxes accepted, {wrong} rejected, undecided {'0' if open_ == 0 else f'{float(open_):.1g}'}"


def results(parts: Sequence[tuple[list[Claim], list[Checked]]]) -> list[str]:
    """The lines of RESULTS.md."""
    return [
        "# Where a sample said 'no exception found'",
        "",
        "Written by `python -m measurements.certificates`. Each certificate was found by the search and checked, box "
        "for box, by",
        "the verifier; see the explanation of certificates. Numbers are of relative manipulability",
        "(full pose, worst lock of any one joint).",
        "",
        *table([claim for claims, _ in parts for claim in claims]),
        "",
        "| certificate | undecided | boxes accepted | rejected | nearest that was found |",
        "|---|---|---|---|---|",
        *[one.row for _, found in parts for one in found],
        "",
    ]


def main() -> None:
    """Prove, check, write."""
    lines = results([beliefs(), nine_joints(), three_links()])
    (HERE / "RESULTS.md").write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
