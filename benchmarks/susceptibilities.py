"""W5: torque, acceleration and swing angle susceptibility of the 7-joint Panda with their gradients, row-major in and out.

What the peers compute, with the axes z_i, a point O_i on each, the composite body behind each joint (first moment s_i and
second moment I_i about O_i), k_i = z_i x s_i and the upward vector g: torques t_i = k_i . g, their symmetric slopes
D_ij = k_j . (g x z_i) for j >= i, inertias m_i = z_i . I_i z_i, accelerations -t_i / m_i, and swing angles
atan2(-t_i, D_ii). For j > i, dm_i / dq_j = 2 (z_i x z_j) . I_j z_i + 2 (z_i x (O_j - O_i)) . (z_i x k_j). And
dD_ii / dq_j = k_j . (z_i x (z_i x g)) for j >= i, z_j . ((z_i x k_i) x g) for j < i.
The first axis of the Panda is upright: its joint has no torque and no swing, and its entries are left out.
"""

from __future__ import annotations

import os
from collections.abc import Callable

os.environ.setdefault("OMP_NUM_THREADS", "1")  # for arrays as small as these a second thread only waits
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("MKL_NUM_THREADS", "1")

import numpy as np

import harness
import panda
from harness import Contender

Array = np.ndarray
Both = tuple[Array, Array]  # values (N, 3) and gradients (N, 3, 7)
Function = Callable[[Array], Both]

N = panda.N
CHUNK = 1024  # configurations of the batched NumPy
FIRST = np.eye(N)[0]  # keeps 0/0 away from the upright joint
COLUMNS = 3 * (N + 1)  # torque, acceleration, swing angle; then their gradients


# ---- holdfast --------------------------------------------------------------------------------------------------------


def measures():
    from holdfast import susceptibility as s

    arm = panda.ours()
    return [s.torque(arm, weights="effort"), s.acceleration(arm), s.swing_angle(arm)]


def set_threads(threads: int) -> None:
    from holdfast.kernels import set_threads, thread_count

    if thread_count() != threads:
        set_threads(threads)


def holdfast(threads: int) -> Function:
    from holdfast import susceptibility

    together = susceptibility.SusceptibilityBatch(measures())

    def evaluate(q: Array) -> Both:
        set_threads(threads)
        return together(q)

    return evaluate


def holdfast_apart(threads: int) -> Callable[[Array], tuple[list[Array], list[Array]]]:
    three = measures()

    def evaluate(q: Array) -> Both:
        set_threads(threads)
        return [m(q) for m in three], [m.gradient(q) for m in three]

    return evaluate


# ---- Pinocchio, one configuration after the other ------------------------------------------------------------------------


def cross(a: Array, b: Array) -> Array:
    """Of (3, ...); ``numpy.cross`` takes longer."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def pinocchio_loop() -> Function:
    """Composite inertias and slopes of the torques from Pinocchio, the rest in closed form with few calls of NumPy.

    With motions S_i = (velocity, axis) and inertias Y_j (6, 6) at the world's origin, k_j is the first half of Y_j S_j, and
    dm_i / dq_j = -2 S_i . (X_j' Y_j) S_i, where X_j u = S_j x u: summed over i, the product of X_j' Y_j with a sum of squares.
    """
    import pinocchio as pin

    model, data, _ = panda.pinocchio()
    world, weights, g = pin.Convention.WORLD, panda.weights(), panda.UP[2]
    inertia = np.empty((N, 6, 6))
    upto, beyond, before = np.tril(np.ones((N, N))), np.triu(np.ones((N, N)), 1), np.tril(np.ones((N, N)), -1)
    motions = np.stack([motion_cross(e).T for e in np.eye(6)]).reshape(6, 36)

    def one(q: Array, out: Array) -> None:
        slopes = pin.computeGeneralizedGravityDerivatives(model, data, q)
        torque = data.g
        m = pin.crba(model, data, q, world).diagonal()
        for i, body in enumerate(data.oYcrb.tolist()[1:]):
            inertia[i] = body.matrix()
        s = data.J.T
        z, k = s[:, 3:], (inertia[:, :3] @ s[:, :, None])[:, :, 0]
        f, down = -torque / m, slopes.diagonal()
        angle = np.arctan2(-torque, down)
        turn = angle / (torque * torque + down * down + FIRST)
        angle[0] = turn[0] = 0
        weighted, share = weights * torque, f / m
        out[0], out[1], out[2] = weighted @ torque, f @ f, angle @ angle
        gradients = np.stack([weighted, -share, -turn * down]) @ slopes
        squares = s[:, :, None] * ((share * f)[:, None] * s)[:, None]
        turned = (s @ motions).reshape(N, 6, 6) @ inertia
        gradients[1] += 2 * (turned.reshape(N, 36) * (before @ squares.reshape(N, 36))).sum(axis=1)
        bent = (turn * torque * g)[:, None]
        twice = z * z[:, 2:]
        twice[:, 2] -= 1
        wide = np.empty((N, 2))  # (z x k) x g
        wide[:, 0] = z[:, 2] * k[:, 0] - z[:, 0] * k[:, 2]
        wide[:, 1] = z[:, 2] * k[:, 1] - z[:, 1] * k[:, 2]
        gradients[2] += (k * (upto @ (bent * twice))).sum(axis=1) + (z[:, :2] * (beyond @ (bent * wide))).sum(axis=1)
        gradients *= 2
        out[3:] = gradients.ravel()

    return row_by_row(one)


def motion_cross(s: Array) -> Array:
    """(6, 6) of ``s x``, for motions (velocity, axis)."""
    v, w = np.cross(np.eye(3), s[:3]), np.cross(np.eye(3), s[3:])
    return np.block([[w, v], [np.zeros((3, 3)), w]])


def pinocchio_derivatives() -> Function:
    """What a Pinocchio user writes first: torque exactly, the slopes of inertias and swing angles from rnea derivatives.

    dm_i/dq_j is entry (i, j) of the slopes of ``rnea(q, 0, e_i)`` less those of gravity; dD_ii/dq_j by central differences.
    """
    import pinocchio as pin

    model, data, _ = panda.pinocchio()
    weights, zero, unit, h = panda.weights(), np.zeros(N), np.eye(N), 1e-5

    def one(q: Array, out: Array) -> None:
        slopes = pin.computeGeneralizedGravityDerivatives(model, data, q).copy()
        torque, m = data.g.copy(), pin.crba(model, data, q).diagonal().copy()
        rise, bend = np.empty((N, N)), np.empty((N, N))
        for i in range(N):
            rise[i] = pin.computeRNEADerivatives(model, data, q, zero, unit[i])[0][i] - slopes[i]
            ends = [
                pin.computeGeneralizedGravityDerivatives(model, data, q + s * h * unit[i]).diagonal().copy() for s in (1, -1)
            ]
            bend[:, i] = (ends[0] - ends[1]) / (2 * h)
        f, down = -torque / m, slopes.diagonal()
        angle, turn = np.arctan2(-torque, down), 1 / (torque**2 + down**2 + FIRST)
        angle[0] = 0
        swing = turn[:, None] * (torque[:, None] * bend - down[:, None] * slopes)
        out[0], out[1], out[2] = weights @ torque**2, f @ f, angle @ angle
        out[3:10] = 2 * (weights * torque) @ slopes
        out[10:17] = 2 * f @ (-(slopes + f[:, None] * rise) / m[:, None])
        out[17:] = 2 * angle @ swing

    return row_by_row(one)


def apart(out: Array) -> Both:
    """Views of (N, 24)."""
    return out[:, :3], out[:, 3:].reshape(-1, 3, N)


def joined(both) -> Array:
    """(N, 24) of what any contender returns, for the comparison."""
    values, gradients = both
    if isinstance(values, list):
        return np.column_stack([*values, *gradients])
    return np.concatenate([values, gradients.reshape(len(values), -1)], axis=1)


def row_by_row(one: Callable[[Array, Array], None]) -> Function:
    def evaluate(q: Array) -> Both:
        out = np.empty((len(q), COLUMNS))
        for row, result in zip(q, out, strict=True):
            one(row, result)
        return apart(out)

    return evaluate


# ---- NumPy, batch last ---------------------------------------------------------------------------------------------------


def numpy_batches() -> Function:
    """The same formulas on arrays (..., B): kinematics, composite bodies in the world's axes, gradients by cumulative sums."""
    model, _, _ = panda.pinocchio()
    steps = [(m.rotation.round(12), m.translation) for m in list(model.jointPlacements)[1:]]
    bodies = [(b.mass, b.lever, b.inertia) for b in list(model.inertias)[1:]]
    weights, up = panda.weights()[:, None], panda.UP

    def combined(factors: Array, vectors: list[Array]) -> Array | None:
        total = None
        for factor, vector in zip(factors, vectors, strict=True):
            if factor:
                term = vector if factor == 1 else factor * vector
                total = term if total is None else total + term
        return total

    def columns(angles: Array) -> Array:
        rows = angles.shape[1]
        cosine, sine = np.cos(angles), np.sin(angles)
        axes = [np.zeros((3, rows)) for _ in range(3)]
        for c in range(3):
            axes[c][c] = 1
        z, o = np.empty((3, N, rows)), np.empty((3, N, rows))
        frames, p = [], np.zeros((3, rows))
        for i, (turn, shift) in enumerate(steps):
            moved = combined(shift, axes)
            p = p if moved is None else p + moved
            x, y, third = (combined(turn[:, c], axes) for c in range(3))
            axes = [cosine[i] * x + sine[i] * y, cosine[i] * y - sine[i] * x, third]
            frames.append(axes)
            z[:, i], o[:, i] = third, p
        # Composite bodies, from the tip: first and second moments about O_i.
        k, m, about = np.empty((3, N, rows)), np.empty((N, rows)), np.empty((N, 6, rows))
        mass, first, second = 0.0, np.zeros((3, rows)), np.zeros((6, rows))
        for i in reversed(range(N)):
            if i < N - 1:
                move_moments(mass, first, second, o[:, i + 1] - o[:, i])
            own, lever, inertia = bodies[i]
            mass += own
            first += own * combined(lever, frames[i])
            moved = inertia + own * (lever @ lever * np.eye(3) - np.outer(lever, lever))
            half = [combined(moved[c], frames[i]) for c in range(3)]
            for entry, (a, b) in enumerate(SYMMETRIC):
                for c in range(3):
                    second[entry] += frames[i][c][a] * half[c][b]
            about[i] = second
            k[:, i] = cross(z[:, i], first)
            m[i] = np.einsum("cb,cb->b", z[:, i], times(second, z[:, i]))
        torque = up[2] * k[2]
        side = np.stack([-up[2] * z[1], up[2] * z[0]])  # g x z, whose third entry is 0
        down = np.einsum("cib,cib->ib", k[:2], side)
        f = -torque / m
        angle = np.arctan2(-torque, down)
        turn = angle / (torque * torque + down * down + FIRST[:, None])
        angle[0] = turn[0] = 0
        share = -2 * f / m
        out = np.empty((COLUMNS, rows))
        out[0] = (weights * torque * torque).sum(axis=0)
        out[1], out[2] = np.einsum("ib,ib->b", f, f), np.einsum("ib,ib->b", angle, angle)
        for at, factor in ((3, 2 * weights * torque), (10, share), (17, -2 * turn * down)):
            before = np.cumsum(factor * side, axis=1)
            product = factor * k[:2]
            after = product.sum(axis=1, keepdims=True) - np.cumsum(product, axis=1)
            out[at : at + N] = np.einsum("cib,cib->ib", k[:2], before) + np.einsum("cib,cib->ib", side, after)
        bent = 2 * turn * torque
        # z x (z x g) = z (z . g) - g, and (z x k) x g
        twice = z * (up[2] * z[2])
        twice[2] -= up[2]
        wide = cross(z, k)
        product = bent * up[2] * np.stack([wide[1], -wide[0]])
        after = product.sum(axis=1, keepdims=True) - np.cumsum(product, axis=1)
        out[17:] += np.einsum("cib,cib->ib", k, np.cumsum(bent * twice, axis=1)) + np.einsum("cib,cib->ib", z[:2], after)
        pull = 2 * share * f
        for j in range(1, N):
            zi = z[:, :j]
            across = cross(zi, z[:, j, None])
            rise = np.einsum("cib,cib->ib", across, times(about[j][:, None], zi))
            arm = cross(zi, o[:, j, None] - o[:, :j])
            rise += np.einsum("cib,cib->ib", arm, cross(zi, k[:, j, None]))
            out[10 + j] += np.einsum("ib,ib->b", pull[:j], rise)
        return out

    def evaluate(q: Array) -> Both:
        chunks = [q[start : start + CHUNK] for start in range(0, len(q), CHUNK)]
        return apart(np.concatenate([columns(np.ascontiguousarray(rows.T)).T for rows in chunks]))

    return evaluate


SYMMETRIC = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


def times(second: Array, x: Array) -> Array:
    """Symmetric matrices (6, ..., B) times vectors (3, ..., B)."""
    a, b, c, d, e, f = second
    return np.stack([a * x[0] + f * x[1] + e * x[2], f * x[0] + b * x[1] + d * x[2], e * x[0] + d * x[1] + c * x[2]])


def move_moments(mass: float, first: Array, second: Array, p: Array) -> None:
    """In place, to a point from which the old one is seen at p: ``s + M p``, ``I - [p][s] - [s][p] - M [p][p]``."""
    whole = 2 * first + mass * p
    dot = np.einsum("cb,cb->b", p, whole)
    for entry, (a, b) in enumerate(SYMMETRIC):
        if a == b:
            second[entry] += dot - p[a] * whole[a]
        else:
            second[entry] -= (p[a] * whole[b] + p[b] * whole[a]) / 2
    first += mass * p


# ---- the race ------------------------------------------------------------------------------------------------------------


def by_differences(q: Array) -> Array:
    """(N, 24) by a third route: values from Pinocchio's rnea and crba alone, gradients by differences of fourth order."""
    import pinocchio as pin

    model, data, _ = panda.pinocchio()
    weights, zero, unit = panda.weights(), np.zeros(N), np.eye(N)

    def values(x: Array) -> Array:
        torque, m = pin.rnea(model, data, x, zero, zero).copy(), pin.crba(model, data, x).diagonal()
        quarter = [pin.rnea(model, data, x + np.pi / 2 * unit[i], zero, zero)[i] for i in range(N)]  # the slope of a sine
        angle = np.arctan2(-torque, quarter)
        angle[0] = 0
        return np.array([weights @ torque**2, ((torque / m) ** 2).sum(), angle @ angle])

    def gradient(x: Array) -> Array:
        h = 1e-3
        ends = [[values(x + c * h * e) for c in (-2, -1, 1, 2)] for e in unit]
        return np.array([(a - 8 * b + 8 * c - d) / (12 * h) for a, b, c, d in ends]).T.ravel()

    return np.array([np.concatenate([values(x), gradient(x)]) for x in q])


def main() -> None:
    chosen = harness.options(__doc__)
    rows = 8_192 if chosen.quick else 65_536
    sample = panda.configurations(256, seed=1)
    expected = joined(pinocchio_loop()(sample))
    # Some entries pass through 0, and some are always 0: errors are measured against no less than the median of their kind.
    blocks = [
        np.median(np.abs(expected[:, at : at + width])) for at, width in ((0, 1), (1, 1), (2, 1), (3, N), (10, N), (17, N))
    ]
    scale = np.maximum(np.abs(expected), np.repeat(blocks, [1, 1, 1, N, N, N]))
    differences = float((np.abs(by_differences(sample[:32]) - expected[:32]) / scale[:32]).max())
    candidate = Contender("holdfast `Together`, 2 threads", lambda: holdfast(2), rows)
    peers = [
        Contender("holdfast `Together`, 1 thread", lambda: holdfast(1), rows),
        Contender("holdfast, each measure and gradient apart, 2 threads", lambda: holdfast_apart(2), rows),
        Contender("Pinocchio in a loop, NumPy closed forms", pinocchio_loop, min(rows, 4_000)),
        Contender("Pinocchio in a loop, rnea derivatives and differences", pinocchio_derivatives, min(rows, 1_000)),
        Contender("NumPy, batch last, closed forms", numpy_batches, min(rows, 32_768)),
    ]
    title = "W5: three susceptibilities and their gradients, 7-joint Panda"
    print(harness.race(title, candidate, peers, panda.configurations(rows), sample, expected, chosen.rounds, scale, joined))
    print(
        "Error: relative, against Pinocchio with the closed forms at 256 configurations; an entry of a gradient below the "
        "median of its gradient counts against that median. That row itself: "
        f"{differences:.0e} from differences of fourth order of values from Pinocchio alone, at 32 configurations."
    )


if __name__ == "__main__":
    main()
