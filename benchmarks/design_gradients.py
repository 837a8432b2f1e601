"""W13: designs at poses, each at its best configuration, and the exact gradient by the design: the PA10 with its tool open."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import harness
import pa10
from harness import Spread, number

STARTS = 10  # of IPOPT
CLOSE = 1e-3
NEAR = 1e-6  # of two values that are the same optimum, so that their gradients can be compared
VARY = {"a7": (-0.1, 0.1), "alpha7": (-1.8, -1.3), "d7": (0.35, 0.55), "a9": (-0.1, 0.1), "d9": (0.02, 0.2)}
ROWS = ((6, "a"), (6, "alpha"), (6, "d"), (8, "a"), (8, "d"))

Result = tuple[np.ndarray, np.ndarray]  # values (D, P) and gradients (D, P, k)


def designs(count: int) -> np.ndarray:
    """Designs (D, k) spread over the bounds."""
    from holdfast.studies.designs import design_space

    return design_space(pa10.ours(), VARY).draw(count, 3)


def holdfast(poses: np.ndarray) -> Callable[[np.ndarray], Result]:
    from holdfast.studies.designs import Evaluator, Family, design_space, sensitivity

    evaluate = Evaluator(Family(design_space(pa10.ours(), VARY)), poses)

    def run(values: np.ndarray) -> Result:
        found = evaluate(values)
        s = sensitivity(evaluate, found, np.arange(found.value.size))
        value = np.where(found.reached, s.value.reshape(found.value.shape), np.nan)
        return value, s.gradient.reshape(*found.value.shape, -1)

    return run


def ipopt(poses: np.ndarray) -> Callable[[np.ndarray], Result]:
    """The epigraph form with the design as parameters of one program; its multipliers are the gradient."""
    import casadi as ca

    q, t, x = ca.SX.sym("q", pa10.N), ca.SX.sym("t"), ca.SX.sym("x", len(ROWS))
    position, rotation = ca.SX.sym("position", 3), ca.SX.sym("rotation", 3, 3)
    given = {"a": pa10.A, "alpha": np.arctan2(pa10.SIN_ALPHA, pa10.COS_ALPHA), "d": pa10.D}
    open_ = {row: x[i] for i, row in enumerate(ROWS)}
    p, r = ca.SX.zeros(3), ca.SX.eye(3)
    axes, points = [], []
    for i in range(pa10.N):
        a, alpha, d = (open_.get((i, kind), float(given[kind][i])) for kind in ("a", "alpha", "d"))
        axes.append(r[:, 2])
        points.append(p)
        c, s, ca_, sa_ = ca.cos(q[i]), ca.sin(q[i]), ca.cos(alpha), ca.sin(alpha)
        p = p + r @ ca.vertcat(a * c, a * s, d)
        turn = [ca.horzcat(c, -s * ca_, s * sa_), ca.horzcat(s, c * ca_, -c * sa_), ca.horzcat(0, sa_, ca_)]
        r = r @ ca.vertcat(*turn)
    j = ca.horzcat(*[ca.vertcat(ca.cross(z, p - o), z) for z, o in zip(axes, points, strict=True)])
    gram = ca.solve(j @ j.T, ca.SX.eye(6))
    rho = ca.sqrt(ca.fmax(1 - ca.vertcat(*[j[:, k].T @ gram @ j[:, k] for k in range(pa10.N)]), 1e-12))
    off = rotation @ r.T
    skew = ca.vertcat(off[2, 1] - off[1, 2], off[0, 2] - off[2, 0], off[1, 0] - off[0, 1]) / 2
    parameters = ca.vertcat(position, ca.vec(rotation), x)
    problem = {"x": ca.vertcat(q, t), "p": parameters, "f": -t, "g": ca.vertcat(rho - t, p - position, skew)}
    options = {"print_time": 0, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8, "max_iter": 300}}
    solver = ca.nlpsol("design", "ipopt", problem, options)
    upright = ca.Function("trace", [q, rotation, x], [ca.trace(off)])
    bounds = {
        "lbx": np.r_[pa10.LOWER, 0],
        "ubx": np.r_[pa10.UPPER, 1],
        "lbg": np.zeros(pa10.N + 6),
        "ubg": np.r_[np.full(pa10.N, np.inf), np.zeros(6)],
    }
    starts = pa10.configurations(len(poses) * STARTS, seed=5).reshape(len(poses), STARTS, pa10.N)

    def run(values: np.ndarray) -> Result:
        best = np.full((len(values), len(poses)), np.nan)
        slope = np.full((*best.shape, len(ROWS)), np.nan)
        for d, design in enumerate(values):
            for k, pose in enumerate(poses):
                given = np.r_[pose[:3, 3], pose[:3, :3].ravel(order="F"), design]
                for start in starts[k]:
                    found = solver(x0=np.r_[start, 0.1], p=given, **bounds)
                    at = np.array(found["x"]).ravel()
                    # The skew part of the error also vanishes half a turn away.
                    met = solver.stats()["success"] and float(upright(at[:-1], pose[:3, :3], design)) > 2.9
                    if met and not at[-1] <= best[d, k]:
                        best[d, k], slope[d, k] = at[-1], np.array(found["lam_p"]).ravel()[12:]
        return best, slope

    return run


def main() -> None:
    chosen = harness.options(__doc__, rounds=3)
    # Poses in the middle of the region, which all designs reach.
    from optimised_configurations import reachable_poses

    poses = reachable_poses(4 if chosen.quick else 16)
    many, few = designs(8 if chosen.quick else 64), designs(1 if chosen.quick else 2)
    ours, theirs = holdfast(poses), ipopt(poses[: len(poses) // 4])
    here = holdfast(poses[: len(poses) // 4])
    harness.progress("W13: designs")
    mine, other = here(few), theirs(few)
    first, second = harness.alternate(lambda: ours(many), lambda: theirs(few), chosen.rounds)
    rate = [many.shape[0] * len(poses) / s for s in first]
    peer = [few.shape[0] * (len(poses) // 4) / s for s in second]
    both = np.isfinite(mine[0]) & np.isfinite(other[0])
    same = both & (np.abs(mine[0] - other[0]) < NEAR)
    # lam_p belongs to the Lagrangian of -t; its sign is a convention, the same for all rows.
    apart = min(np.abs(mine[1][same] + sign * other[1][same]).max() for sign in (1, -1)) if same.any() else np.nan
    ratio = Spread.of([a / b for a, b in zip(rate, peer, strict=True)])
    lines = [
        ["holdfast", number(float(np.median(rate))), "", f"{(mine[0][both] >= other[0][both] - CLOSE).mean():.0%}", ""],
        [
            f"IPOPT in CasADi, {STARTS} starts, multipliers",
            number(float(np.median(peer))),
            str(ratio),
            f"{(other[0][both] >= mine[0][both] - CLOSE).mean():.0%}",
            f"one thread; {int(same.sum())} of {both.sum()} optima are the same to {NEAR:g}, their gradients to {apart:.1e}",
        ],
    ]
    title = f"W13: designs at poses with gradient, 9-joint PA10, {len(VARY)} parameters of its tool open"
    head = ["contender", "designs x poses per s", "holdfast is faster by (range)", f"within {CLOSE:g} of the better", "note"]
    print(harness.table(title, head, lines))
    print(f"{len(many)} designs x {len(poses)} poses; the peer {len(few)} x {len(poses) // 4}. Compiling is not in it.\n")
    print(f"Measured: {harness.environment()}.")


if __name__ == "__main__":
    main()
