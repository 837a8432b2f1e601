"""W17: certificates: the search beside the check, sampling in the same time, and intervals instead of Taylor forms."""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np

import harness

CENTRE = [0.485, 0.0, 0.53]
RANGES = [(-45, 45), (-60, 45), (-45, 45), (-118, -103.5), (-90, 90), (50, 145), (-90, 90)]  # deg, of the joints of a Panda
POSES, ROTATION = [0.968, 0.0, 0.025], 174  # m; deg about y
NINE = [(-40, 40), (37, 43.5), (-40, 40), (60, 100), (-40, 40), (-2, 38), (-40, 40), (16, 56), (-40, 40)]  # deg
WIDE = 1e3  # rad: limits that are none


def panda():
    import holdfast as hf

    arm = hf.arms.load("panda")
    return arm, dict(zip(arm.joint_names, np.deg2rad(RANGES).tolist(), strict=True))


def proofs(chosen: argparse.Namespace) -> str:
    """Both halves of a certificate, and what as much time tells by samples."""
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
            rows.append([f"{size} m", found.named(part), *cells, *times])
        cells = [f"{found.leaves:,}", f"{float(found.undecided):.1e} at the worst", str(check.rejected)]
        times = [
            f"{search:.1f} of processor",
            f"{checked:.1f} of processor",
            f"{amount / max(found.leaves, 1):.0f} bytes a leaf",
        ]
        rows.append([f"{size} m", "all", *cells, *times])
    head = ["cube", "lock of", "boxes proved", "undecided", "rejected", "search, s", "check, s", "sampling for as long"]
    return harness.table("W17: a failure-tolerant box of a Panda, proved and checked", head, rows)


def sampled(claim, budget: float) -> str:
    """What random targets and locked angles tell in so many seconds: how many were tried, how many were not reached."""
    from holdfast.certificates.claims import ROWS
    from holdfast.certificates.taylor import Reach

    reach = Reach(claim.arm, ROWS[claim.task], claim.locked, claim.limits)
    generator, end = np.random.default_rng(17), time.perf_counter() + min(budget, 20.0)
    tried = missed = 0
    while time.perf_counter() < end:
        at = generator.uniform(
            *(claim.box if claim.angle is None else np.vstack([claim.box, claim.angle])).T, (1000, 3 + (claim.locked >= 0))
        )
        left = at
        for _ in range(20):
            q = reach.placed(generator.uniform(*reach.spans.T, (len(left), claim.arm.n)), left)
            q = reach.solved(q, left[:, :3], 40)
            left = left[~(reach.missed(q, left[:, :3])[:, 0] < 1e-9)]
            if not len(left):
                break
        tried, missed = tried + len(at), missed + len(left)
    most = 3 / tried if not missed else np.nan
    said = f"at most {most:.0e} with 95 %" if not missed else f"{missed} not found"
    return f"{tried:,} targets: {said}"


def poses(chosen: argparse.Namespace) -> str:
    """A cube of poses with a fixed rotation."""
    from scipy.spatial.transform import Rotation

    import holdfast as hf

    harness.progress("poses of a PA10")
    arm = hf.arms.load("pa10-9dof")
    ranges = dict(zip(arm.joint_names, np.deg2rad(NINE).tolist(), strict=True))
    turn = Rotation.from_euler("y", ROTATION, degrees=True).as_matrix()
    claim = hf.certificates.tolerant_claim(arm, POSES, 0.02 if chosen.quick else 0.05, rotation=turn, working_ranges=ranges)
    found = hf.certify(claim, time_limit=120)
    with tempfile.TemporaryDirectory() as folder:
        check = hf.check_certificate(found.write(Path(folder) / "cube.certificate"))
    rows = [
        [found.named(p), f"{p.leaves:,}", f"{float(p.undecided):.1e}", str(v.rejected), f"{p.seconds:.1f}", f"{v.seconds:.1f}"]
        for p, v in zip(found.parts, check.parts, strict=True)
    ]
    rows.append(["all", f"{found.leaves:,}", f"{float(found.undecided):.1e} at the worst", str(check.rejected), "", ""])
    head = ["lock of", "boxes proved", "undecided", "rejected", "search, s", "check, s"]
    return harness.table("W17: poses with a fixed rotation, PA10 with nine joints", head, rows)


def widths(chosen: argparse.Namespace) -> str:
    """The widest box, equal along all axes and without limits, that one configuration proves, by both."""
    from holdfast.certificates.taylor import Form, Reach

    arm, ranges = panda()
    generator, rows = np.random.default_rng(5), []
    for locked in range(-1, arm.n):
        harness.progress(f"widths, lock of {locked + 1}")
        reach = Reach(arm, 3, locked, np.tile([-WIDE, WIDE], (arm.n, 1)))
        at = generator.uniform(-0.15, 0.15, (4 if chosen.quick else 20, 3)) + CENTRE
        if locked >= 0:
            at = np.column_stack([at, generator.uniform(*ranges[arm.joint_names[locked]], len(at))])
        q = reach.placed(generator.uniform(*np.array(list(ranges.values())).T, (len(at), arm.n)), at)
        q = reach.solved(q, at[:, :3], 60)
        met = reach.missed(q, at[:, :3])[:, 0] < 1e-9
        q, at = q[met], at[met]
        form = Form.at(reach, q, at[:, :3])
        ours = widest(len(q), lambda h, form=form, at=at: form.proved(np.tile(h[:, None], at.shape[1]))[0])
        theirs = widest(
            len(q),
            lambda h, q=q, at=at, k=locked: np.array(
                [by_intervals(arm, a, b[:3], k, x) for a, b, x in zip(q, at, h, strict=True)]
            ),
        )
        name = "healthy" if locked < 0 else arm.joint_names[locked]
        ratio = float(np.median(ours / theirs))
        spans = [f"{1000 * np.median(x):.2f}" for x in (ours, theirs)]
        rows.append([name, str(len(q)), *spans, f"{ratio:.1f}", f"{ratio ** at.shape[1]:,.0f}"])
    head = ["lock of", "configurations", "Taylor form, mm and mrad", "intervals, mm and mrad", "ratio", "as many boxes"]
    return harness.table("W17: half widths of what one configuration proves (medians)", head, rows)


def widest(count: int, proved) -> np.ndarray:
    """(count,) half widths, to 0.05 mm."""
    low, high = np.zeros(count), np.full(count, 0.2)
    for _ in range(12):
        middle = (low + high) / 2
        good = proved(middle)
        low, high = np.where(good, middle, low), np.where(good, high, middle)
    return np.maximum(low, 1e-6)


def by_intervals(arm, q: np.ndarray, target: np.ndarray, locked: int, half: float) -> bool:
    """Whether the mean-value form with the Jacobian over the box, in balls, proves a box of this half width around a target."""
    free = np.arange(arm.n) != locked
    tip, jacobian = _balls(arm, q, np.zeros(arm.n))
    middle = np.array([[float(x.mid()) for x in row] for row in jacobian])
    inverse = np.zeros((arm.n, 3))
    inverse[free] = np.linalg.pinv(middle[:, free])
    made = np.column_stack([inverse, np.zeros((arm.n, int(locked >= 0))), inverse])
    if locked >= 0:
        made[:, 3] = -inverse @ middle[:, locked]
        made[locked, 3] = 1
    still = np.column_stack([np.eye(3), np.zeros((3, int(locked >= 0))), np.eye(3)])
    residual = np.array([abs(float(x.mid()) - t) for x, t in zip(tip, target, strict=True)])
    s = np.zeros(3)
    for _ in range(30):
        w = np.concatenate([np.full(made.shape[1] - 3, half), s])
        _, over = _balls(arm, q, np.abs(made) @ w)
        slope = [
            [sum((row[j] * made[j, k] for j in range(arm.n)), -still[i, k]) for k in range(made.shape[1])]
            for i, row in enumerate(over)
        ]
        e = residual + np.array([[float(abs(x).upper()) for x in row] for row in slope]) @ w
        if (e <= s).all():
            return True
        if not (e < 0.5).all():
            return False
        s = 1.05 * e + 1e-9
    return False


def _balls(arm, q: np.ndarray, radius: np.ndarray):
    """Tool point and its Jacobian (3, n) over a box of joints, in ball arithmetic."""
    import flint

    turn, place = (
        flint.arb_mat(3, 3, [float(x) for x in arm.base[:3, :3].ravel()]),
        flint.arb_mat(3, 1, [float(x) for x in arm.base[:3, 3]]),
    )
    axes, points = [], []
    for joint, middle, far in zip(arm.joints, q, radius, strict=True):
        place = place + turn * flint.arb_mat(3, 1, [float(x) for x in joint.origin[:3, 3]])
        turn = turn * flint.arb_mat(3, 3, [float(x) for x in joint.origin[:3, :3].ravel()])
        axis = [float(x) for x in joint.axis]
        axes.append([sum(turn[i, k] * axis[k] for k in range(3)) for i in range(3)])
        points.append([place[i, 0] for i in range(3)])
        sine, cosine = flint.arb(float(middle), float(far)).sin_cos()
        x, y, z = axis
        cross = flint.arb_mat([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        outer = flint.arb_mat([[a * b for b in axis] for a in axis])
        one = flint.arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1])
        turn = turn * (outer + (one - outer) * cosine + cross * sine)
    tip = place + turn * flint.arb_mat(3, 1, [float(x) for x in arm.tool[:3, 3]])
    at = [tip[i, 0] for i in range(3)]
    columns = []
    for a, o in zip(axes, points, strict=True):
        d = [p - c for p, c in zip(at, o, strict=True)]
        columns.append([a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2], a[0] * d[1] - a[1] * d[0]])
    return at, [[column[i] for column in columns] for i in range(3)]


def main() -> None:
    chosen = harness.options(__doc__, rounds=1)
    for part in (proofs, poses, widths):
        print(part(chosen), flush=True)


if __name__ == "__main__":
    main()
