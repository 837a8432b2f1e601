"""W3: inverse kinematics to 1e-6 m and rad, within the joint limits: rates for the 9-joint PA10, and verdicts on poses of
7-joint arms, half of them poses that may be unreachable."""

from __future__ import annotations

import contextlib
import runpy
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

import harness
import pa10
from harness import Contender, Function, Spread, number

FEW, MANY = 200, 4_000
POSES = 200  # of each arm and kind, for the verdicts
ON_POSE = 1e-6  # m and rad: largest error of an answer, and of its joint limits, since TRAC-IK rounds them to single precision
STARTS = 50  # of Pinocchio, for the verdicts
LOCKED = "holdfast `all_configurations`, one joint locked"
ITERATIONS = 40  # of the damped least squares in JAX: what holdfast takes at most


def holdfast(restarts: int) -> Function:
    from holdfast import solve_ik

    arm = pa10.ours()
    return lambda poses: solve_ik(arm, poses, restarts=restarts).q


def robotics_toolbox(searches: int) -> Function:
    """Levenberg-Marquardt in C, one pose at a time. Its residual is half the square of the error."""
    chain = pa10.robotics_toolbox()

    def solve(poses: np.ndarray) -> np.ndarray:
        starts = pa10.configurations(len(poses), seed=2)
        return np.array(
            [chain.ik_LM(t, q0=q, slimit=searches, tol=1e-13).q for t, q in zip(poses, starts, strict=True)], dtype=float
        )

    return solve


def damped(parts: Any, pose: np.ndarray, q: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """At most 200 steps from one start, with Pinocchio's (model, data, frame id of the tool)."""
    import pinocchio as pin

    (model, data, tool), target = parts, pin.SE3(pose[:3, :3], pose[:3, 3])
    for _ in range(200):
        pin.forwardKinematics(model, data, q)
        error = pin.log6(pin.updateFramePlacement(model, data, tool).actInv(target)).vector
        if np.abs(error).max() < 1e-7:
            break
        j = pin.computeFrameJacobian(model, data, q, tool, pin.LOCAL)
        q = np.clip(q + j.T @ np.linalg.solve(j @ j.T + 1e-6 * np.eye(6), error), lower, upper)
    return q


def pinocchio() -> Function:
    """The usual closed loop, damped and clipped to the limits, one pose and one start at a time."""
    parts = pa10.pinocchio()

    def solve(poses: np.ndarray) -> np.ndarray:
        starts = pa10.configurations(len(poses), seed=2)
        return np.array([damped(parts, t, q, pa10.LOWER, pa10.UPPER) for t, q in zip(poses, starts, strict=True)])

    return solve


def trac_ik(timeout: float, file: Path | None = None, limits: Sequence[np.ndarray] = (pa10.LOWER, pa10.UPPER)) -> Function:
    """TRAC-IK in C++, two threads a pose; it restarts until the timeout."""
    from trac_ik import TracIK

    with tempfile.TemporaryDirectory() as folder:
        urdf = file or Path(folder) / "pa10.urdf"
        if file is None:
            pa10.write_urdf(urdf)
        solver = TracIK("base", "tool", str(urdf), timeout, 1e-7, "Speed")
    nothing = np.full(len(limits[0]), np.nan)

    def solve(poses: np.ndarray) -> np.ndarray:
        starts = np.random.default_rng(2).uniform(*limits, (len(poses), len(nothing)))
        found = [solver.ik(t[:3, 3], t[:3, :3], q) for t, q in zip(poses, starts, strict=True)]
        return np.array([nothing if q is None else q for q in found])

    return solve


def jax_batch() -> Function:
    """Damped least squares as holdfast does it, one start, arrays with the batch last, a fixed number of iterations."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    low, high = jnp.asarray(pa10.LOWER)[:, None], jnp.asarray(pa10.UPPER)[:, None]

    def cross(a: Any, b: Any) -> Any:
        return jnp.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])

    def forward(q: Any) -> tuple[list[Any], Any, list[Any]]:
        """Axes (x, y, z) of the tool, its position, and the nine columns (6, N) of the Jacobian."""
        cosine, sine = jnp.cos(q), jnp.sin(q)
        x, y, z = jnp.eye(3)[:, :, None] * jnp.ones(q.shape[1])
        p, axes, origins = 0 * z, [], []
        for i in range(pa10.N):
            axes.append(z)
            origins.append(p)
            x, side = cosine[i] * x + sine[i] * y, cosine[i] * y - sine[i] * x
            p = p + float(pa10.D[i]) * z + float(pa10.A[i]) * x
            ca, sa = float(pa10.COS_ALPHA[i]), float(pa10.SIN_ALPHA[i])
            y, z = ca * side + sa * z, ca * z - sa * side
        columns = [jnp.concatenate([cross(a, p - o), a]) for a, o in zip(axes, origins, strict=True)]
        return [x, y, z], p, columns

    def error_of(axes: list[Any], p: Any, target: Any, rotation: Any) -> Any:
        turn = 0.5 * sum(cross(axis, rotation[:, k]) for k, axis in enumerate(axes))
        cosine = 0.5 * (sum((axis * rotation[:, k]).sum(0) for k, axis in enumerate(axes)) - 1)
        sine = jnp.sqrt((turn * turn).sum(0) + 1e-300)
        return jnp.concatenate([target - p, turn * jnp.where(sine > 1e-12, jnp.arctan2(sine, cosine) / sine, 1.0)])

    def solve_positive(a: list[list[Any]], b: Any) -> list[Any]:
        """Cholesky written out: LAPACK on a batch of 6 x 6 is slower."""
        lower: list[list[Any]] = [[None] * 6 for _ in range(6)]
        y: list[Any] = []
        for c in range(6):
            lower[c][c] = jnp.sqrt(a[c][c] - sum(lower[c][k] ** 2 for k in range(c)))
            for r in range(c + 1, 6):
                lower[r][c] = (a[r][c] - sum(lower[r][k] * lower[c][k] for k in range(c))) / lower[c][c]
            y.append((b[c] - sum(lower[c][k] * y[k] for k in range(c))) / lower[c][c])
        for r in reversed(range(6)):
            y[r] = (y[r] - sum(lower[k][r] * y[k] for k in range(r + 1, 6))) / lower[r][r]
        return y

    def step(_: int, carried: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
        q, target, rotation = carried
        axes, p, columns = forward(q)
        e = error_of(axes, p, target, rotation)
        pull = jnp.stack([(column * e).sum(0) for column in columns])
        active = 1.0 - (((q <= low) & (pull < 0)) | ((q >= high) & (pull > 0)))
        masked = [a * column for a, column in zip(active, columns, strict=True)]
        gram = [[sum(column[r] * column[c] for column in masked) for c in range(6)] for r in range(6)]
        for r in range(6):
            gram[r][r] = gram[r][r] + 1e-3 * (e * e).sum(0) + 1e-12
        u = jnp.stack(solve_positive(gram, e))
        return jnp.clip(q + jnp.stack([(column * u).sum(0) for column in masked]), low, high), target, rotation

    @jax.jit
    def compiled(q: Any, poses: Any) -> Any:
        carried = (q.T, poses[:, :3, 3].T, poses[:, :3, :3].transpose(1, 2, 0))
        return jax.lax.fori_loop(0, ITERATIONS, step, carried)[0].T

    return lambda poses: np.asarray(compiled(pa10.configurations(len(poses), seed=2), poses))


def contenders() -> list[Contender]:
    """The first is the candidate: it takes many poses at a time and gives up last."""
    return [
        Contender("holdfast, 100 restarts", lambda: holdfast(100), MANY),
        Contender("holdfast, 100 restarts", lambda: holdfast(100), FEW),
        Contender("holdfast, 1 start", lambda: holdfast(1), MANY),
        Contender("holdfast, 1 start", lambda: holdfast(1), FEW),
        Contender("Robotics Toolbox `ik_LM` (C), 100 searches", lambda: robotics_toolbox(100), FEW, "its default"),
        Contender("Robotics Toolbox `ik_LM` (C), 1 search", lambda: robotics_toolbox(1), FEW),
        Contender("TRAC-IK, 5 ms", lambda: trac_ik(0.005), FEW, "its default"),
        Contender("TRAC-IK, 50 ms", lambda: trac_ik(0.05), FEW),
        Contender("Pinocchio in a loop, 1 start", pinocchio, FEW, "at most 200 steps"),
        Contender("JAX, damped least squares, 1 start", jax_batch, MANY, f"{ITERATIONS} steps, always"),
    ]


def made(parts: Sequence[Contender], poses: np.ndarray) -> tuple[list[tuple[Contender, Function, np.ndarray]], dict[int, str]]:
    """Those that could be made, with the poses each solves, and for the others, by their place, what is amiss."""
    able, amiss = [], {}
    for place, part in enumerate(parts):
        harness.progress(f"W3: {part.name}, {part.rows} poses, once")
        try:
            function = part.make()
            solved = pa10.on_pose(poses[: part.rows], function(poses[: part.rows]))
            able.append((part, function, np.pad(solved, (0, len(poses) - part.rows))))
        except ImportError as missing:
            amiss[place] = f"not installed: {missing.name}"
        except Exception as failure:  # one broken peer must not cost the others their rows
            amiss[place] = f"failed: {type(failure).__name__}: {str(failure)[:80]}".replace("\n", " ")
    return able, amiss


def main() -> None:
    chosen = harness.options(__doc__)
    parts, many = contenders(), 400 if chosen.quick else MANY
    poses = pa10.region_poses(many)
    parts = [Contender(p.name, p.make, min(p.rows, many), p.note) for p in parts]
    able, amiss = made(parts, poses)
    ours, candidate, found = able[0]
    by_peers = np.any([s for p, _, s in able if "holdfast" not in p.name], axis=0)
    possible = by_peers | np.any([s for p, _, s in able if "holdfast" in p.name], axis=0)

    def timed(function: Function, rows: int) -> Callable[[], list[float]]:
        """Seconds for all poses, those that can be solved, and the others."""
        subset = poses[:rows]
        sets = [subset, subset[possible[:rows]], subset[~possible[:rows]]]
        for part in sets:
            function(part)
        return lambda: [harness.seconds(lambda part=part: function(part)) for part in sets]

    def rates(times: Sequence[float], rows: int, solved: np.ndarray) -> tuple[float, float, float]:
        """Poses/s, solved/s of those that can be, ms for one that cannot."""
        hopeless = int((~possible[:rows]).sum())
        return rows / times[0], int(solved.sum()) / times[1], times[2] / hopeless * 1e3 if hopeless else np.nan

    lines: list[list[str]] = []
    for part, function, solved in able:
        harness.progress(f"W3: {part.name}, {part.rows} poses")
        first, second = timed(candidate, ours.rows), timed(function, part.rows)
        rounds = []
        for _ in range(chosen.rounds):
            own = rates(first(), ours.rows, found)
            rounds.append((own, own if part is ours else rates(second(), part.rows, solved)))
        all_poses, solvable, hopeless = np.median([their for _, their in rounds], axis=0)
        faster = ["1", "1"] if part is ours else [str(Spread.of([a[k] / b[k] for a, b in rounds])) for k in (0, 1)]
        cells = [f"**{part.name}**" if part is ours else part.name, number(all_poses), f"{solved[: part.rows].mean():.1%}"]
        cells += [number(solvable), *faster, number(hopeless), "; ".join(filter(None, [f"batch {part.rows}", part.note]))]
        lines.append(cells)
    for place, what in sorted(amiss.items()):
        lines.insert(place, [parts[place].name, *["-"] * 6, what])
    head = ["contender", "poses/s", "solved", "solved/s of the solvable"]
    head += ["holdfast is faster by (range), all poses", "solvable poses", "ms for an unsolved pose", "note"]
    print(harness.table("W3: inverse kinematics of the 9-joint PA10, poses of the paper's region", head, lines))
    few = slice(0, FEW)
    missed_few = int((by_peers & ~next(s for p, _, s in able if p.rows == FEW and "100 restarts" in p.name))[few].sum())
    print(
        f"Solved: pose and limits to 1e-6 m and rad, by forward kinematics written apart. Solvable: solved by any row, "
        f"{int(possible[few].sum())} of the first {FEW} poses and {int(possible.sum())} of {many} (only rows of batch {many} "
        f"saw the rest). Of the poses that a peer solved, holdfast with 100 restarts missed {missed_few} of "
        f"{int(by_peers[few].sum())} in the batch of {FEW} and {int((by_peers & ~found).sum())} of {int(by_peers.sum())} "
        f"in the batch of {many}.\n"
    )
    print(verdicts(10 if chosen.quick else POSES))


# Left arm of the OpenArm 2.0: the origin of each joint in the frame before it, its axis, and its limits; those of
# enactic/openarm_description in ssik's artifact, which the public complaint is about (personalrobotics/ssik, issue 359).
OPENARM_2 = (
    ("0 0.0625 0", "0 1 0", -3.4907, 1.3963),
    ("0 0.06 0", "-1 0 0", -3.3161, 0.17453),
    ("0 0 -0.06625", "0 0 -1", -1.5708, 1.5708),
    ("0 0 -0.15375", "0 -1 0", 0.0, 2.4435),
    ("0 0 -0.0955", "0 0 -1", -1.5708, 1.5708),
    ("0 0 -0.1205", "0 -1 0", -0.7854, 0.7854),
    ("0 0 0", "1 0 0", -0.7854, 0.7854),
)
OPENARM_2_JOINT = (
    '<link name="link{1}"/><joint name="joint{1}" type="revolute"><parent link="link{0}"/><child link="link{1}"/>'
    '<origin xyz="{2}"/><axis xyz="{3}"/><limit lower="{4}" upper="{5}" velocity="1" effort="1"/></joint>'
)
Answer = tuple[np.ndarray, bool]  # configurations (K, n), and whether it is proved that there is none
Solver = Callable[[np.ndarray, np.ndarray], Answer]  # of a pose (4, 4) and limits (2, n), which only a lock changes


class UrdfArm:
    """An arm of holdfast, the URDF file that all peers read, and forward kinematics of that file by Pinocchio."""

    def __init__(self, arm: Any, folder: Path) -> None:
        import pinocchio as pin

        self.arm, self.limits, self.urdf, self.pin = arm, np.array([arm.lower, arm.upper]), folder / f"{arm.name}.urdf", pin
        self.urdf.write_text(arm.to_urdf())
        model = pin.buildModelFromUrdf(str(self.urdf))
        self.parts = model, model.createData(), model.getFrameId("tool")

    def forward(self, q: np.ndarray) -> np.ndarray:
        self.pin.framesForwardKinematics(*self.parts[:2], q)
        return np.array(self.parts[1].oMf[self.parts[2]].homogeneous)

    def accepts(self, pose: np.ndarray, q: np.ndarray, limits: np.ndarray) -> bool:
        """Whether there are configurations q (K, n), all on the pose and within the limits."""
        off = [self.forward(one) - pose for one in q]
        errors = [max(np.linalg.norm(e[:3, 3]), np.linalg.norm(e[:3, :3]) / np.sqrt(2)) for e in off]
        return len(q) > 0 and max(*errors, (limits[0] - q).max(), (q - limits[1]).max()) <= ON_POSE


def single_solvers(arm: UrdfArm, starts: np.ndarray) -> dict[str, Callable[[], Solver]]:
    """One pose at a time; ``starts`` (K, n) are those of the peers that need some."""
    import holdfast as hf

    def by_solve_ik(pose: np.ndarray, _: np.ndarray) -> Answer:
        found = hf.solve_ik(arm.arm, pose)
        return found.q[None][: int(found.success)], False

    def by_all_configurations(pose: np.ndarray, limits: np.ndarray) -> Answer:
        found = hf.all_configurations(arm.arm, pose, limits=(limits[0], limits[1]), first=True)
        return found.q, found.proved_empty

    def by_explain_ik(pose: np.ndarray, _: np.ndarray) -> Answer:
        found = hf.explain_ik(arm.arm, pose)
        return found.q[None][: int(found.verdict.name == "REACHABLE")], found.verdict.name == "UNREACHABLE"

    def ssik() -> Solver:
        from ssik.cli import main as command

        path = arm.urdf.with_suffix(".py")
        with contextlib.redirect_stdout(sys.stderr):
            command(["build", str(arm.urdf), "--base", "base", "--ee", "tool", "--out", str(path), "--no-validate"])
        module = runpy.run_path(str(path))
        return lambda pose, _: (np.array([found.q for found in module["solve"](pose)]).reshape(-1, arm.arm.n), False)

    def by_trac_ik(timeout: float) -> Solver:
        function = trac_ik(timeout, arm.urdf, arm.limits)
        return lambda pose, _: ((q := function(pose[None]))[np.isfinite(q).all(axis=1)], False)

    def by_pinocchio(pose: np.ndarray, limits: np.ndarray) -> Answer:
        ends = (damped(arm.parts, pose, q, *limits)[None] for q in starts)
        return next((q for q in ends if arm.accepts(pose, q, limits)), starts[:0]), False

    return {
        "holdfast `solve_ik`": lambda: by_solve_ik,
        "holdfast `all_configurations`": lambda: by_all_configurations,
        "holdfast `explain_ik`": lambda: by_explain_ik,
        "ssik": ssik,
        "TRAC-IK, 5 ms": lambda: by_trac_ik(0.005),
        "TRAC-IK, 500 ms": lambda: by_trac_ik(0.5),
        f"Pinocchio in a loop, {len(starts)} starts": lambda: by_pinocchio,
        LOCKED: lambda: by_all_configurations,
    }


def verdict_rows(arm: UrdfArm, count: int) -> list[list[str]]:
    """Ask about poses of random configurations, and about the same positions with random orientations."""
    n = arm.arm.n
    q = np.random.default_rng(3).uniform(*arm.limits, (count, n))
    poses = np.array([[arm.forward(one) for one in q]] * 2)
    if np.abs(arm.arm.forward_kinematics(q) - poses[0]).max() > 1e-9:
        raise RuntimeError(f"Pinocchio reads {arm.urdf.name} as another arm")
    poses[1, :, :3, :3] = Rotation.random(count, random_state=4).as_matrix()
    is_locked = np.arange(n) == np.arange(count)[:, None, None] % n
    locked = np.where(is_locked, q[:, None], arm.limits)  # joint 1 of the first pose, joint 2 of the second, and so on

    def ask(solve: Solver, pose: np.ndarray, limits: np.ndarray) -> tuple[float, ...]:
        """Whether it is solved, proved unreachable or answered wrongly, and seconds of the processor."""
        start = time.process_time()
        answer, proved = solve(pose, limits)
        duration = time.process_time() - start
        solved = arm.accepts(pose, answer, limits)
        return solved, proved, len(answer) > 0 and not solved, duration

    lines, records = [], {}
    for name, make in single_solvers(arm, np.random.default_rng(5).uniform(*arm.limits, (STARTS, n))).items():
        harness.progress(f"W3: {arm.arm.name}, {name}")
        limits = locked if name == LOCKED else np.tile(arm.limits, (count, 1, 1))
        try:
            solve = make()
        except ImportError as missing:
            lines.append([arm.arm.name, name, *["-"] * 8, f"not installed: {missing.name}"])
            continue
        solve(poses[0, 0], limits[0])
        records[name] = np.array([[ask(solve, *pair) for pair in zip(kind, limits, strict=True)] for kind in poses])
    reached = np.max([record[..., 0] for record in records.values()], axis=0)
    reached[0] = 1.0
    for name, record in records.items():
        cells: list[str] = []
        for kind, (solved, proved, wrong, durations) in enumerate(record.transpose(0, 2, 1)):
            wrong = np.maximum(wrong, proved * (solved if name == LOCKED and kind else reached[kind]))
            proved = proved * (1 - wrong)
            cells += [f"{flags.sum():.0f}" for flags in (solved, proved, 1 - solved - proved - wrong, wrong)]
            cells.append(" / ".join(map(number, 1e3 * np.percentile(durations, [50, 95]))))
        lines.append([arm.arm.name, name, cells[0], *cells[2:]])  # a proof about a reachable pose is counted as wrong
    return lines


def verdicts(count: int) -> str:
    """Table of answers to single poses, and what its columns mean."""
    from holdfast import Arm, arms

    joints = "".join(OPENARM_2_JOINT.format(i, i + 1, *numbers) for i, numbers in enumerate(OPENARM_2))
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "xacro.urdf"
        file.write_text(f'<robot name="openarm-2"><link name="link0"/>{joints}</robot>')
        three = [Arm.from_urdf(file), arms.load("openarm"), arms.load("iiwa14")]
        lines = [line for arm in three for line in verdict_rows(UrdfArm(arm, file.parent), count)]
    head = ["arm", "contender", "reachable: solved", "undecided", "wrong", "ms, median / 95 %"]
    head += ["random orientation: solved", "proved unreachable", "undecided", "wrong", "ms, median / 95 %"]
    return harness.table(f"W3: verdicts on single poses, {count} of each arm and kind", head, lines) + (
        "\nReachable: poses of random configurations. Random orientation: the same positions with random orientations. "
        "Undecided: neither an answer nor a proof; peers prove nothing. Wrong: an answer off the "
        "pose or the limits by more than 1e-6 m and rad, by Pinocchio, or a proof where a row has an answer. ssik: the module "
        "of `ssik build`, all answers to each pose. One joint locked: joint 1 of the first pose, joint 2 of the second, and so "
        "on, where the configuration has it. Processor time, all threads."
    )


if __name__ == "__main__":
    main()
