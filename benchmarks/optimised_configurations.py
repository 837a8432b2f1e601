"""W4: problem (11), the largest worst-case relative manipulability at a fixed pose, on poses of the paper's region."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

import numpy as np

import harness
import pa10
import scalarised
from harness import Spread, number

STARTS = 10  # of the peers
CLOSE = 1e-3
TOLERANCE = 1e-5  # m and rad, to which a result must be on its pose; looser than what any solver was asked for

Solver = Callable[[np.ndarray], np.ndarray]  # poses (N, 4, 4) -> candidates (N, starts, 9)


def holdfast(starts: int | None = None) -> Solver:
    from holdfast import indices, optimise

    arm = pa10.ours()
    index = indices.relative_manipulability(arm)
    options = {} if starts is None else {"starts": starts}
    return lambda poses: optimise(arm, poses, index, **options).q[:, None]


class Symbols:
    """The epigraph form in CasADi: maximise t with rho_k(q) >= t, the tool on the pose, and q within the limits."""

    def __init__(self) -> None:
        import casadi as ca

        self.q, self.t = ca.SX.sym("q", pa10.N), ca.SX.sym("t")
        self.position, self.rotation = ca.SX.sym("position", 3), ca.SX.sym("rotation", 3, 3)
        angles = ca.vertsplit(self.q)
        cosine, sine = [ca.cos(a) for a in angles], [ca.sin(a) for a in angles]
        whitened = scalarised.whiten(scalarised.columns_of_jacobian(cosine, sine), ca.sqrt)[2]
        leverage = ca.vertcat(*[scalarised.dot(y, y) for y in whitened])
        self.rho = ca.sqrt(ca.fmax(1 - leverage, 1e-12))
        p, r = ca.SX.zeros(3), ca.SX.eye(3)
        for i in range(pa10.N):
            c, s = cosine[i], sine[i]
            ca_, sa_ = float(pa10.COS_ALPHA[i]), float(pa10.SIN_ALPHA[i])
            p = p + r @ ca.vertcat(pa10.A[i] * c, pa10.A[i] * s, pa10.D[i])
            turn = [ca.horzcat(c, -s * ca_, s * sa_), ca.horzcat(s, c * ca_, -c * sa_), ca.horzcat(0, sa_, ca_)]
            r = r @ ca.vertcat(*turn)
        off = self.rotation @ r.T
        skew = ca.vertcat(off[2, 1] - off[1, 2], off[0, 2] - off[2, 0], off[1, 0] - off[0, 1]) / 2
        self.error = ca.vertcat(p - self.position, skew)


def from_starts(one: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> Solver:
    """A local solver of one pose, started from the same random configurations for every peer."""

    def solve(poses: np.ndarray) -> np.ndarray:
        starts = pa10.configurations(len(poses) * STARTS, seed=5).reshape(len(poses), STARTS, pa10.N)
        return np.array([[one(t, q) for q in own] for t, own in zip(poses, starts, strict=True)])

    return solve


def ipopt() -> Solver:
    import casadi as ca

    s = Symbols()
    problem = {
        "x": ca.vertcat(s.q, s.t),
        "p": ca.vertcat(s.position, ca.vec(s.rotation)),
        "f": -s.t,
        "g": ca.vertcat(s.rho - s.t, s.error),
    }
    options = {"print_time": 0, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-8, "max_iter": 300}}
    solver = ca.nlpsol("problem", "ipopt", problem, options)
    bounds = {
        "lbx": np.r_[pa10.LOWER, 0],
        "ubx": np.r_[pa10.UPPER, 1],
        "lbg": np.zeros(pa10.N + 6),
        "ubg": np.r_[np.full(pa10.N, np.inf), np.zeros(6)],
    }

    def one(pose: np.ndarray, start: np.ndarray) -> np.ndarray:
        parameters = np.r_[pose[:3, 3], pose[:3, :3].ravel(order="F")]
        return np.array(solver(x0=np.r_[start, 0.1], p=parameters, **bounds)["x"]).ravel()[: pa10.N]

    return from_starts(one)


def slsqp() -> Solver:
    import casadi as ca
    from scipy.optimize import minimize

    s = Symbols()
    values = ca.Function("values", [s.q], [s.rho], {"cse": True})
    slopes = ca.Function("slopes", [s.q], [ca.jacobian(s.rho, s.q)], {"cse": True})
    pose_of = [s.q, s.position, s.rotation]
    errors = ca.Function("errors", pose_of, [s.error], {"cse": True})
    error_slopes = ca.Function("error_slopes", pose_of, [ca.jacobian(s.error, s.q)], {"cse": True})
    objective_slope = np.r_[np.zeros(pa10.N), -1.0]
    bounds = [*zip(pa10.LOWER, pa10.UPPER, strict=True), (0.0, 1.0)]
    minus_one, zero = -np.ones((pa10.N, 1)), np.zeros((6, 1))

    def one(pose: np.ndarray, start: np.ndarray) -> np.ndarray:
        target = pose[:3, 3], pose[:3, :3]
        constraints = [
            {
                "type": "ineq",
                "fun": lambda x: values(x[:-1]).full().ravel() - x[-1],
                "jac": lambda x: np.hstack([slopes(x[:-1]).full(), minus_one]),
            },
            {
                "type": "eq",
                "fun": lambda x: errors(x[:-1], *target).full().ravel(),
                "jac": lambda x: np.hstack([error_slopes(x[:-1], *target).full(), zero]),
            },
        ]
        found = minimize(
            lambda x: -x[-1],
            np.r_[start, 0.1],
            jac=lambda x: objective_slope,
            method="SLSQP",
            bounds=bounds,
            constraints=constraints,
            options={"maxiter": 200, "ftol": 1e-9},
        )
        return found.x[: pa10.N]

    return from_starts(one)


def best_values(poses: np.ndarray, candidates: np.ndarray) -> np.ndarray:
    """(N,) the best value among the candidates that are on the pose and within the limits; NaN where none is."""
    starts = candidates.shape[1]
    q = candidates.reshape(-1, pa10.N)
    clipped = np.clip(q, pa10.LOWER, pa10.UPPER)  # a solver may pass a limit by its tolerance
    good = pa10.on_pose(np.repeat(poses, starts, axis=0), clipped, TOLERANCE) & (np.abs(q - clipped).max(axis=1) < 1e-6)
    values = np.full(len(q), -np.inf)
    values[good] = pa10.worst_by_determinants(clipped[good])
    best = values.reshape(-1, starts).max(axis=1)
    return np.where(np.isfinite(best), best, np.nan)


def reachable_poses(count: int) -> np.ndarray:
    """The first poses of the region that inverse kinematics reaches within the limits."""
    from holdfast import solve_ik

    poses = pa10.region_poses(count + count // 8 + 20)
    return poses[solve_ik(pa10.ours(), poses).success][:count]


def main() -> None:
    extra = argparse.ArgumentParser(add_help=False)
    extra.add_argument("--poses", type=int, default=20, help="poses that every contender solves (default %(default)s)")
    chosen = harness.options(__doc__, parents=[extra])
    count, many = (2, 100) if chosen.quick else (chosen.poses, max(4_000, chosen.poses))
    poses = reachable_poses(many)
    few = poses[:count]
    ours = holdfast()
    contenders: list[tuple[str, Callable[[], Solver], np.ndarray, str]] = [
        ("**holdfast**", lambda: ours, poses, ""),
        ("holdfast", lambda: ours, few, ""),
        ("holdfast, 256 starts", lambda: holdfast(256), few, "a check on the 32 starts of the default"),
        (f"CasADi and IPOPT, epigraph, {STARTS} starts", ipopt, few, "one thread"),
        (f"SciPy SLSQP, epigraph, {STARTS} starts", slsqp, few, "one thread; analytic derivatives from CasADi"),
    ]
    results: list[tuple[str, np.ndarray | None, list[str]]] = []
    for name, make, own, note in contenders:
        harness.progress(f"W4: {name}, {len(own)} poses")
        try:
            solver = make()
            values = best_values(few, solver(own)[:count])
            rounds = []
            for _ in range(chosen.rounds):
                rate = [len(p) / harness.seconds(lambda p=p: ours(p)) for p in (poses, few)]
                theirs = rate[0] if own is poses else len(own) / harness.seconds(lambda s=solver, p=own: s(p))
                rounds.append((theirs, rate[0] / theirs, rate[1] / theirs))
        except ImportError as missing:
            results.append((name, None, ["-", "-", "-", f"not installed: {missing.name}"]))
            continue
        except Exception as failure:  # one broken peer must not cost the others their rows
            what = f"failed: {type(failure).__name__}: {str(failure)[:80]}".replace("\n", " ")
            results.append((name, None, ["-", "-", "-", what]))
            continue
        rates, large, small = zip(*rounds, strict=True)
        faster = ["1" if own is poses else str(Spread.of(large)), str(Spread.of(small))]
        results.append(
            (name, values, [number(float(np.median(rates))), *faster, f"batch {len(own)}" + (f"; {note}" if note else "")])
        )
    found = np.array([v for _, v, _ in results if v is not None])
    best = np.nanmax(found, axis=0)
    lines = []
    for name, values, (rate, large, small, note) in results:
        if values is None:
            lines.append([name, rate, "-", "-", "-", large, small, note])
            continue
        mean = f"{np.nanmean(values):.4f}" if np.isfinite(values).any() else "-"
        close = f"{np.mean(values >= best - CLOSE):.0%}"
        lines.append([name, rate, f"{np.isfinite(values).mean():.0%}", mean, close, large, small, note])
    head = ["contender", "poses/s", "reached", "mean value", f"within {CLOSE:g} of the best"]
    head += [f"holdfast is faster by (range), batch {len(poses)}", f"batch {count}", "note"]
    print(harness.table("W4: largest worst-case relative manipulability at a fixed pose, 9-joint PA10", head, lines))
    print(
        f"Values: by determinants, of the first {count} poses that can be reached, the best of all starts that ended on the "
        f"pose (to {TOLERANCE:g} m and rad) and within the limits. Best: of any row, mean {math.fsum(best) / count:.4f}."
    )


if __name__ == "__main__":
    main()
