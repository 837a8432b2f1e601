"""W17: certificates: the search beside the check, sampling in the same time, and intervals instead of Taylor forms."""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import harness

sys.path.append(str(Path(__file__).parents[1] / "tests" / "certificates"))  # what is compared

CENTRE = [0.485, 0.0, 0.53]
RANGES = [(-45, 45), (-60, 45), (-45, 45), (-118, -103.5), (-90, 90), (50, 145), (-90, 90)]  # deg, of the joints of a Panda
POSES, ROTATION = [0.968, 0.0, 0.025], 174  # m; deg about y
START = [-35, -45, 51, -111, -46, 84, -3]  # deg, of a Panda: where its paths begin


def panda():
    import holdfast as hf

    arm = hf.arms.load("panda")
    return arm, dict(zip(arm.joint_names, np.deg2rad(RANGES).tolist(), strict=True))


def proofs(chosen: argparse.Namespace) -> str:
    """Both halves of a certificate, and what as much time tells by samples."""
    from rivals import sampled

    import holdfast as hf

    arm, ranges = panda()
    rows = []
    for size in (0.1,) if chosen.quick else (0.15, 0.30):
        harness.progress(f"cube of {size} m")
        claim = hf.certificates.tolerant_claim(arm, CENTRE, size, working_ranges=ranges)
        began = time.process_time()
        found = hf.certify(claim)
        search = time.process_time() - began
        with tempfile.TemporaryDirectory() as folder:
            file = found.write(Path(folder) / "cube.certificate")
            began = time.process_time()
            check = hf.check_certificate(file)
            checked = time.process_time() - began
            amount = sum(x.stat().st_size for x in Path(folder).iterdir())
        for part, verdict in zip(found.parts, check.parts, strict=True):
            cells = [f"{part.leaves:,}", f"{float(part.undecided):.1e}", str(verdict.rejected)]
            times = [f"{part.seconds:.1f}", f"{verdict.seconds:.1f}", sampled(part.claim, part.seconds)]
            rows.append([f"{size} m", found.part_label(part), *cells, *times])
        cells = [f"{found.leaves:,}", f"{float(found.undecided):.1e} at the worst", str(check.rejected)]
        times = [
            f"{search:.1f} of processor",
            f"{checked:.1f} of processor",
            f"{amount / max(found.leaves, 1):.0f} bytes a leaf",
        ]
        rows.append([f"{size} m", "all", *cells, *times])
    head = ["cube", "lock of", "boxes proved", "undecided", "rejected", "search, s", "check, s", "sampling for as long"]
    return harness.table("W17: a failure-tolerant box of a Panda, proved and checked", head, rows)


def poses(chosen: argparse.Namespace) -> str:
    """A cube of poses with a fixed rotation."""
    from rivals import NINE
    from scipy.spatial.transform import Rotation

    import holdfast as hf

    harness.progress("poses of a PA10")
    arm = hf.arms.load("pa10-9dof")
    ranges = dict(zip(arm.joint_names, np.deg2rad(NINE).tolist(), strict=True))
    turn = Rotation.from_euler("y", ROTATION, degrees=True).as_matrix()
    claim = hf.certificates.tolerant_claim(arm, POSES, 0.02 if chosen.quick else 0.05, rotation=turn, working_ranges=ranges)
    found = hf.certify(claim)
    with tempfile.TemporaryDirectory() as folder:
        check = hf.check_certificate(found.write(Path(folder) / "cube.certificate"))
    rows = [
        [
            found.part_label(p),
            f"{p.leaves:,}",
            f"{float(p.undecided):.1e}",
            str(v.rejected),
            f"{p.seconds:.1f}",
            f"{v.seconds:.1f}",
        ]
        for p, v in zip(found.parts, check.parts, strict=True)
    ]
    rows.append(["all", f"{found.leaves:,}", f"{float(found.undecided):.1e} at the worst", str(check.rejected), "", ""])
    head = ["lock of", "boxes proved", "undecided", "rejected", "search, s", "check, s"]
    return harness.table("W17: poses with a fixed rotation, PA10 with nine joints", head, rows)


def paths(chosen: argparse.Namespace) -> str:
    """Straight tool paths of a Panda, finished after a lock at any instant."""
    import holdfast as hf

    arm, rows = hf.arms.load("panda"), []
    for name, move in (("0.1 m along x", [0.1, 0, 0]), ("0.3 m down", [0, 0, -0.3])):
        knots = straight(arm, np.deg2rad(START), move, 10 if chosen.quick else 50)
        for tube in (0.0, 0.0005):
            harness.progress(f"path {name}, tube {tube} m")
            found = hf.certify(
                hf.certificates.path_claim(arm, knots, tube=tube), halvings=7, time_limit=30 if chosen.quick else 300
            )
            with tempfile.TemporaryDirectory() as folder:
                file = found.write(Path(folder) / "path.certificate")
                began = time.process_time()
                check = hf.check_certificate(file)
                each = 1e3 * (time.process_time() - began) / max(check.leaves, 1)
                size = file.stat().st_size / max(check.leaves, 1)
            for part, verdict in zip(found.parts, check.parts, strict=True):
                share = [f"{float(x):.4f}" for x in (part.proved, part.refuted, part.undecided)]
                share += [f"{part.leaves:,}", str(verdict.rejected), f"{part.seconds:.1f}"]
                rows.append([f"{name}, tube {1000 * tube} mm", arm.joint_names[part.joint], *share])
            share = [f"{float(x):.4f}" for x in (found.proved, found.refuted, found.undecided)]
            share += [f"{found.leaves:,}", str(check.rejected)]
            rows.append(["", "all", *share, f"check {each:.2f} ms and {size:.0f} bytes a cell"])
    head = ["path", "lock of", "lock instants proved", "refuted", "undecided", "cells", "rejected", "search, s"]
    return harness.table("W17: tool paths of a Panda, finished by one continuous motion", head, rows)


def straight(arm, start, move, count):
    """Knots whose tools lie on a line, turned as at the start."""
    q, found, first = np.array(start), [np.array(start)], arm.forward_kinematics(start)
    for k in range(1, count + 1):
        for _ in range(6):
            now = arm.forward_kinematics(q)
            turn = sum(np.cross(now[:3, i], first[:3, i]) for i in range(3)) / 2
            away = first[:3, 3] + np.array(move) * k / count - now[:3, 3]
            q = q + np.linalg.pinv(arm.jacobian(q)) @ np.append(away, turn)
        found.append(q)
    return np.array(found)


def widths(chosen: argparse.Namespace) -> str:
    """The widest box, equal along all axes and without limits, that one configuration proves, by both."""
    from rivals import half_widths

    arm, ranges = panda()
    generator, rows = np.random.default_rng(5), []
    for locked in range(-1, arm.n):
        harness.progress(f"widths, lock of {locked + 1}")
        at = generator.uniform(-0.15, 0.15, (4 if chosen.quick else 20, 3)) + CENTRE
        if locked >= 0:
            at = np.column_stack([at, generator.uniform(*ranges[arm.joint_names[locked]], len(at))])
        q = generator.uniform(*np.array(list(ranges.values())).T, (len(at), arm.n))
        ours, theirs = half_widths(arm, locked, at, q)
        name, ratio = "healthy" if locked < 0 else arm.joint_names[locked], float(np.median(ours / theirs))
        spans = [f"{1000 * np.median(x):.2f}" for x in (ours, theirs)]
        rows.append([name, str(len(ours)), *spans, f"{ratio:.1f}", f"{ratio ** at.shape[1]:,.0f}"])
    head = ["lock of", "configurations", "Taylor form, mm and mrad", "intervals, mm and mrad", "ratio", "as many boxes"]
    return harness.table("W17: half widths of what one configuration proves (medians)", head, rows)


SHOULDER = [0.0, 0.0, 0.333]  # m, of a Panda
AROUND, FLOORS = [-35, -45, 51, -111, -46, 84, -3], [40, 20, -30, -90, 30, 120, 0]  # deg
APART = [  # locked joint, interval in deg, distance of the target from the shoulder along x, m; bar
    (3, (-150, -145), 0.75, 200),
    (3, (-130, -125), 0.715, 200),
    (3, (-90, -85), 0.875, 200),
    (3, (-60, -50), 0.26, 200),
    (5, (0, 5), 0.92, 200),
]


def configurations(chosen: argparse.Namespace) -> str:
    """What is told of configurations: out of reach, ceilings, floors."""
    import holdfast as hf

    arm, ranges = panda()
    rows, made = [], hf.certificates

    def about(degrees: list[int], half: float) -> np.ndarray:
        middle = np.deg2rad(degrees)
        return np.column_stack([middle - np.deg2rad(half), middle + np.deg2rad(half)])

    claims = [
        (
            f"out of reach: joint {k + 1} at {a} to {b} deg, {far} m from the shoulder",
            made.out_of_reach_claim(arm, np.add(SHOULDER, [far, 0, 0]), 0.01, locked={k: (np.deg2rad(a), np.deg2rad(b))}),
            f"{bar}",
        )
        for k, (a, b), far, bar in APART
    ]
    below = {1: (np.deg2rad(-20), np.deg2rad(-15))}
    claims.append(
        (
            "out of reach: joint 2 at -20 to -15 deg, (0.5, 0, -0.3)",
            made.out_of_reach_claim(arm, [0.5, 0, -0.3], 0.015, locked=below),
            "301,000 in the spike",
        )
    )
    for half, top, bar in ((5, 0.0867, ""), (5, 0.0734, "23,300 in the spike"), (10, 0.0776, "250,000")):
        claims.append((f"ceiling {top}, +-{half} deg", made.ceiling_claim(arm, about(AROUND, half), top), bar))
    if not chosen.quick:
        claims.append(("ceiling 0.0927, working ranges", made.ceiling_claim(arm, ranges, 0.0927), "2,000,000"))
    for half, low, bar in (
        (2, 0.02, "6,924 in the spike"),
        (6, 0.003, "12,300 in the spike"),
        (6, 0.0074, "27,800 in the spike"),
    ):
        claims.append((f"floor {low}, +-{half} deg", made.floor_claim(arm, about(FLOORS, half), low), bar))
    for name, claim, bar in claims:
        harness.progress(name)
        found = hf.certify(claim)
        with tempfile.TemporaryDirectory() as folder:
            check = hf.check_certificate(found.write(Path(folder) / "one.certificate"))
        times = [f"{found.seconds:.2f}", f"{check.seconds:.2f}"]
        rows.append([name, f"{found.leaves:,}", bar, f"{float(found.undecided):.1e}", str(check.rejected), *times])
    head = ["claim", "boxes", "asked, at most", "undecided", "rejected", "search, s", "check, s"]
    return harness.table("W17: claims about configurations of a Panda", head, rows)


def main() -> None:
    chosen = harness.options(__doc__, rounds=1)
    for part in (proofs, poses, configurations, paths, widths):
        print(part(chosen), flush=True)


if __name__ == "__main__":
    main()
