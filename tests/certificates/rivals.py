"""What certificates are compared with: as much time of samples, and balls instead of Taylor forms."""

from __future__ import annotations

import time

import flint
import numpy as np

from holdfast.certificates.taylor import ReachSolver, TaylorForm

WIDE = 1e3  # rad: limits that are none
# deg: working ranges of a PA10 with nine joints, for the cube of poses that is claimed of it
NINE = [(-40, 40), (37, 43.5), (-40, 40), (60, 100), (-40, 40), (-2, 38), (-40, 40), (16, 56), (-40, 40)]


def sampled(claim, budget):
    """What random targets and locked angles tell in so many seconds: how many were tried, how many were not reached."""
    reach = ReachSolver(claim.arm, claim.task, claim.locked, claim.limits)
    generator, end = np.random.default_rng(17), time.perf_counter() + min(budget, 20.0)
    tried = missed = 0
    while time.perf_counter() < end:
        at = generator.uniform(
            *(claim.box if claim.angle is None else np.vstack([claim.box, claim.angle])).T, (1000, 3 + (claim.locked >= 0))
        )
        left = at
        for _ in range(20):
            q = reach.set_nonfree_joints(generator.uniform(*reach.sampling_limits.T, (len(left), claim.arm.n)), left)
            q = reach.solve_inverse_kinematics(q, left[:, :3], 40)
            left = left[~(reach.measure_pose_error(q, left[:, :3])[:, 0] < 1e-9)]
            if not len(left):
                break
        tried, missed = tried + len(at), missed + len(left)
    most = 3 / tried if not missed else np.nan
    said = f"at most {most:.0e} with 95 %" if not missed else f"{missed} not found"
    return f"{tried:,} targets: {said}"


def half_widths(arm, locked, at, q):
    """(2, M) m and rad: of the widest boxes, equal along all axes and without limits, that M configurations prove.

    Args:
        arm: The arm.
        locked: Index of the locked joint; -1: none.
        at: (N, 3 or 4) targets, m, and locked angles, rad.
        q: (N, n) configurations near them.

    Returns:
        By Taylor forms, and by the mean-value form with the Jacobian over the box in balls; of those that reach their target.
    """
    reach = ReachSolver(arm, "position", locked, np.tile([-WIDE, WIDE], (arm.n, 1)))
    q = reach.solve_inverse_kinematics(reach.set_nonfree_joints(q, at), at[:, :3], 60)
    met = reach.measure_pose_error(q, at[:, :3])[:, 0] < 1e-9
    q, at = q[met], at[met]
    form = TaylorForm.expand_at(reach, q, at[:, :3])

    def balls(half):
        return np.array([by_intervals(arm, a, b[:3], locked, x) for a, b, x in zip(q, at, half, strict=True)])

    return np.array(
        [widest(len(q), lambda half: form.is_cell_proved(np.tile(half[:, None], at.shape[1]))), widest(len(q), balls)]
    )


def widest(count, proved):
    """(count,) half widths, to 0.05 mm."""
    low, high = np.zeros(count), np.full(count, 0.2)
    for _ in range(12):
        middle = (low + high) / 2
        good = proved(middle)
        low, high = np.where(good, middle, low), np.where(good, high, middle)
    return np.maximum(low, 1e-6)


def by_intervals(arm, q, target, locked, half):
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


def _balls(arm, q, radius):
    """Tool point and its Jacobian (3, n) over a box of joints, in ball arithmetic."""
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
