"""Other routes to the same numbers: numpy transforms, singular values, long doubles, Pinocchio. No CasADi, no compiled kernels.

Functions take batches ``q (N, n)``. The Jacobian is the exact derivative of the product of transforms, not ``z x (p - p_k)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast.core.registry import INDEX_REGISTRY, Registry

ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")
EPS = float(np.finfo(np.float64).eps)
LONG = np.finfo(np.longdouble).eps < 1e-18


# ---- arms and configurations ---------------------------------------------------------------------------------------


def pose(rotation=None, position=(0.0, 0.0, 0.0)) -> np.ndarray:
    t = np.eye(4)
    t[:3, :3] = np.eye(3) if rotation is None else rotation
    t[:3, 3] = position
    return t


def random_pose(rng: np.random.Generator, reach: float = 0.5) -> np.ndarray:
    return pose(Rotation.random(random_state=rng).as_matrix(), rng.uniform(-reach, reach, 3))


def random_arm(
    rng: np.random.Generator,
    n: int | None = None,
    types: str | None = None,
    limits: float | None = None,
    base: bool = True,
) -> hf.Arm:
    """An arm with nothing aligned; ``types`` such as ``"RRPC"`` (revolute, prismatic, continuous), else drawn."""
    if types is None:
        types = "".join(rng.choice(list("RRRCP"), n or int(rng.integers(2, 10))))
    joints = []
    for k, letter in enumerate(types):
        low, high = -np.inf, np.inf
        if limits is not None and letter != "C":
            low, high = -limits * rng.uniform(0.7, 1.0), limits * rng.uniform(0.7, 1.0)
            if letter == "P":
                low, high = low / 4, high / 4
        kind = {"R": "revolute", "C": "continuous", "P": "prismatic"}[letter]
        joints.append(hf.Joint(f"j{k}", kind, random_pose(rng, 0.4), axis=rng.normal(size=3), lower=low, upper=high))
    return hf.Arm(
        name=f"random-{types}",
        joints=tuple(joints),
        base=random_pose(rng, 1.0) if base else np.eye(4),
        tool=random_pose(rng, 0.3),
    )


def random_link(rng: np.random.Generator, name: str | None = None) -> hf.Link:
    """A body with a full inertia that obeys the triangle inequality."""
    moments = rng.uniform(0.01, 0.1, 3)
    turn = Rotation.random(random_state=rng).as_matrix()
    inertia = turn @ np.diag(moments.sum() - moments) @ turn.T
    return hf.Link(rng.uniform(0.3, 3.0), rng.uniform(-0.3, 0.3, 3), inertia, name=name)


def with_bodies(arm: hf.Arm, rng: np.random.Generator, payload: bool = False, armature: bool = False) -> hf.Arm:
    """The arm with random links, gravity in a random direction, and if asked a payload and rotor inertias."""
    joints = [replace(j, armature=rng.uniform(0.01, 0.2) if armature else 0.0) for j in arm.joints]
    return replace(
        arm,
        joints=tuple(joints),
        links=tuple(random_link(rng) for _ in joints),
        gravity=9.81 * Rotation.random(random_state=rng).as_matrix()[0],
        payload=random_link(rng) if payload else None,
    )


def planar_arm(rng: np.random.Generator, n: int, sliding: Sequence[int] = (), tilted: bool = True) -> hf.Arm:
    """``n`` joints that move in one plane; axes point up or down at random, joints at ``sliding`` slide in the plane."""
    joints = []
    for k in range(n):
        turn = pose(Rotation.from_euler("z", rng.uniform(-np.pi, np.pi)).as_matrix(), [rng.uniform(0.4, 1.0), 0, 0])
        axis = [1.0, 0.5, 0.0] if k in sliding else [0.0, 0.0, rng.choice([-1.0, 1.0])]
        joints.append(hf.Joint(f"j{k}", "prismatic" if k in sliding else "revolute", turn, axis=np.array(axis)))
    tool = pose(None, [rng.uniform(0.4, 1.0), 0, 0])
    return hf.Arm(name=f"planar-{n}", joints=tuple(joints), base=random_pose(rng) if tilted else np.eye(4), tool=tool)


def alternating_arm(rng: np.random.Generator, n: int) -> hf.Arm:
    """Axes across and along by turns, as most industrial arms: singular for a full pose at q = 0."""
    rows = [
        hf.DH(a=0.0, alpha=0.0 if k == n - 1 else (-1.0) ** (k + 1) * np.pi / 2, d=0.0 if k % 2 else rng.uniform(0.2, 0.6))
        for k in range(n)
    ]
    return hf.Arm.from_dh(rows, base=random_pose(rng), name=f"alternating-{n}")


def near_singular(rng: np.random.Generator, n: int, count: int, least: float, most: float) -> np.ndarray:
    """Configurations (count, n) at random distances ``least`` to ``most`` from q = 0."""
    distance = 10 ** rng.uniform(np.log10(least), np.log10(most), (count, 1))
    return distance * rng.uniform(-1, 1, (count, n))


NOMINAL = np.radians([0.0, 30, 0, 90, 0, 18, 0, 36, 0])


def pa10_nine() -> hf.Arm:
    """Table I of Abdi, Maciejewski and Nahavandi 2012."""
    alpha = [-90.0, 90, -90, 90, -90, 90, -90, 90, 0]
    d = [0.315, 0, 0.450, 0, 0.500, 0, 0.450, 0, 0.080]
    low = [-45.0, -15, -45, 45, -45, -27, -45, -9, -45]
    high = [45.0, 75, 45, 135, 45, 63, 45, 81, 45]
    return hf.Arm.from_dh(
        [
            hf.DH(a=0.0, alpha=np.radians(a), d=x, lower=np.radians(lo), upper=np.radians(up))
            for a, x, lo, up in zip(alpha, d, low, high, strict=True)
        ],
        name="table-1",
    )


def inside(arm: hf.Arm, rng: np.random.Generator, count: int) -> np.ndarray:
    """Configurations within the limits; +-pi rad and +-1 m where there are none."""
    free = np.where(arm.prismatic, 1.0, np.pi)
    low = np.where(np.isfinite(arm.lower), arm.lower, -free)
    high = np.where(np.isfinite(arm.upper), arm.upper, free)
    return rng.uniform(low, high, (count, arm.n))


def to_pinocchio(arm: hf.Arm):
    """The arm as a Pinocchio model, with links, payload, gravity and armature, and the id of its tool frame."""
    import pinocchio as pin

    model, parent = pin.Model(), 0
    for k, joint in enumerate(arm.joints):
        made = pin.JointModelPrismaticUnaligned if joint.prismatic else pin.JointModelRevoluteUnaligned
        placement = (arm.base @ joint.origin) if k == 0 else joint.origin
        parent = model.addJoint(parent, made(np.array(joint.axis)), pin.SE3(np.array(placement)), joint.name)
        for body in (arm.links[k], arm.payload if k == arm.n - 1 else None):
            if body is not None:
                inertia = pin.Inertia(body.mass, np.array(body.com), np.array(body.inertia))
                model.appendBodyToJoint(parent, inertia, pin.SE3.Identity())
    model.gravity.linear = np.array(arm.gravity)
    model.armature = np.array([j.armature for j in arm.joints])
    tool = model.addFrame(pin.Frame("tool", parent, 0, pin.SE3(np.array(arm.tool)), pin.FrameType.OP_FRAME))
    return model, tool


# ---- kinematics ----------------------------------------------------------------------------------------------------


def _skew(v: np.ndarray) -> np.ndarray:
    x, y, z = v
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def _motion(joint: hf.Joint, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Motions (N, 4, 4) of a joint, and the constant 4x4 matrix G with ``dM/dq = M G``."""
    rate = np.zeros((4, 4), dtype=x.dtype)
    t = np.broadcast_to(np.eye(4, dtype=x.dtype), (len(x), 4, 4)).copy()
    axis = joint.axis.astype(x.dtype)
    axis = axis / np.sqrt(axis @ axis)  # in long double: a unit vector again, not one rounded to double
    if joint.prismatic:
        rate[:3, 3] = axis
        t[:, :3, 3] = x[:, None] * axis
    else:
        k = _skew(axis)
        rate[:3, :3] = k
        t[:, :3, :3] += np.sin(x)[:, None, None] * k + (1 - np.cos(x))[:, None, None] * (k @ k)
    return t, rate


def frames(arm: hf.Arm, q: np.ndarray) -> list[np.ndarray]:
    """World poses (N, 4, 4) of the base, of each joint's moving frame, and of the tool: n + 2 of them."""
    t = np.broadcast_to(arm.base.astype(q.dtype), (len(q), 4, 4))
    out = [t]
    for k, joint in enumerate(arm.joints):
        t = t @ joint.origin.astype(q.dtype) @ _motion(joint, q[:, k])[0]
        out.append(t)
    return [*out, t @ arm.tool.astype(q.dtype)]


def forward(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """Tool poses (N, 4, 4)."""
    return frames(arm, q)[-1]


def jacobian(arm: hf.Arm, q: np.ndarray, made: list[np.ndarray] | None = None) -> np.ndarray:
    """Geometric Jacobian (N, 6, n): column k is the twist read off ``dT/dq_k``. ``made``: its frames, if known."""
    made = made or frames(arm, q)
    tool = made[-1]
    rotation = tool[:, :3, :3].transpose(0, 2, 1)
    after = np.broadcast_to(arm.tool.astype(q.dtype), tool.shape)
    columns = []
    for k in reversed(range(arm.n)):
        motion, rate = _motion(arm.joints[k], q[:, k])
        slope = made[k + 1] @ rate @ after  # dT/dq_k
        spin = slope[:, :3, :3] @ rotation
        columns.append(
            np.stack([slope[:, 0, 3], slope[:, 1, 3], slope[:, 2, 3], spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], 1)
        )
        after = arm.joints[k].origin.astype(q.dtype) @ motion @ after
    return np.stack(columns[::-1], axis=2)


def jacobian_slope(arm: hf.Arm, j: np.ndarray) -> np.ndarray:
    """``out[b, :, a] = d J[:, a] / d q_b`` from J (6, n) alone: the table of probabilistic-tolerance.md, section 2."""
    v, sliding = j[:3].T, arm.prismatic
    z = np.where(sliding[:, None], j[:3].T, j[3:].T)
    out = np.zeros((arm.n, 6, arm.n))
    for a in range(arm.n):
        for b in range(arm.n):
            linear, angular = np.zeros(3), np.zeros(3)
            if not sliding[a]:
                linear = (np.zeros(3) if sliding[b] else np.cross(z[b], v[a])) if b < a else np.cross(z[a], v[b])
                if b < a and not sliding[b]:
                    angular = np.cross(z[b], z[a])
            elif b < a and not sliding[b]:
                linear = np.cross(z[b], z[a])
            out[b, :, a] = np.r_[linear, angular]
    return out


def plane(arm: hf.Arm) -> np.ndarray:
    """Normal of a planar arm's plane: the null space of the linear velocities it can have, its largest entry above 0."""
    q = np.random.default_rng(0).uniform(-1, 1, (8, arm.n))
    velocities = np.concatenate(list(jacobian(arm, q)[:, :3].transpose(0, 2, 1)))
    normal = np.linalg.svd(velocities)[2][-1]
    return normal * np.sign(normal[np.argmax(np.abs(normal))])


def task_jacobian(arm: hf.Arm, q: np.ndarray, task, frame: str = "base", length: float = 1.0) -> np.ndarray:
    """Task Jacobian (N, m, n): ``task`` a name or a list of rows, linear rows divided by ``length``."""
    j = jacobian(arm, q)
    if task == "pointing" or frame == "tool":
        turn = forward(arm, q)[:, :3, :3].transpose(0, 2, 1)
        j = np.concatenate([turn @ j[:, :3], turn @ j[:, 3:]], axis=1)
    j = np.concatenate([j[:, :3] / np.asarray(length, q.dtype), j[:, 3:]], axis=1)
    if task in ("planar", "planar-pose"):
        normal = plane(arm)
        first = np.eye(3)[np.argmin(np.abs(normal))]  # the axes in the plane, as the task has them
        first = (first - normal * (normal @ first)) / np.linalg.norm(first - normal * (normal @ first))
        across = np.array([first, np.cross(normal, first)]).astype(q.dtype)
        flat = across @ j[:, :3]
        return flat if task == "planar" else np.concatenate([flat, (normal @ j[:, 3:])[:, None]], axis=1)
    if isinstance(task, str):
        return j[:, : {"pose": 6, "pointing": 5, "position": 3}[task]]
    return j[:, [ROWS.index(r) for r in task]]


# ---- indices of a Jacobian -----------------------------------------------------------------------------------------


def index(name: str, j: np.ndarray, failures: Sequence[Sequence[int]], of: hf.indices.Index | None = None) -> np.ndarray:
    """A built-in index (N, F) of Jacobians (N, m, n); one with settings is told them by the index itself."""
    return np.stack([ORACLES["index"][name](np.delete(j, list(s), axis=-1), j, of) for s in failures], axis=-1)


def worst(better: str, values: np.ndarray) -> np.ndarray:
    return values.max(-1) if better == "smaller" else values.min(-1)


def singular_values(j: np.ndarray) -> np.ndarray:
    return np.linalg.svd(j, compute_uv=False)


def directional_velocity(kept: np.ndarray, whole: np.ndarray, of: hf.indices.Index) -> np.ndarray:
    """The size t of the task velocity ``t u`` whose joint rates of least norm have norm 1; 0 where u cannot be had."""
    direction = np.asarray(of.settings["direction"], dtype=float)
    rows = of.task.rows
    u = rows[:, :3] @ direction / np.linalg.norm(direction)
    u = u / np.where(np.abs(rows[:, :3]).max(axis=1) > 0, of.task.length, 1.0)
    rates = np.linalg.pinv(kept) @ u
    had = np.linalg.norm(np.einsum("nij,nj->ni", kept, rates) - u, axis=1) < 1e-6 * np.linalg.norm(u)
    return np.where(had, 1 / np.linalg.norm(rates, axis=1), 0.0)


def condition(j: np.ndarray) -> np.ndarray:
    s = np.linalg.svd(j, compute_uv=False)
    with np.errstate(divide="ignore"):
        return s[..., 0] / s[..., -1]


def orthonormal_long(j: np.ndarray) -> np.ndarray:
    """Orthonormal rows (n, n) by repeated Gram-Schmidt: those of a long double matrix (m, n), then those of its null space."""
    m, n = j.shape
    basis: list[np.ndarray] = []
    for v in [*j, *np.random.default_rng(0).normal(size=(n - m, n)).astype(j.dtype)]:
        for _ in range(3):
            for b in basis:
                v = v - (v @ b) * b
            v = v / np.sqrt(v @ v)
        basis.append(v)
    return np.array(basis)


def rho_long(j: np.ndarray) -> np.ndarray:
    """rho (n,) of one long double Jacobian (m, n): the norms of the rows of a null-space basis."""
    return np.sqrt((orthonormal_long(j)[len(j) :] ** 2).sum(axis=0))


def lost_motions_long(j: np.ndarray, locked: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Remaining fractions (k,) of locked joints for one long double Jacobian (m, n), and their directions (k, m)."""
    m = len(j)
    basis = orthonormal_long(j)
    left, fractions, _ = np.linalg.svd(basis[m:, locked].T.astype(float))
    count = min(m, len(locked))
    fractions = np.append(fractions, np.zeros(len(locked) - len(fractions)))[::-1][:count]
    lower, motions = j @ basis[:m].T, basis[:m, locked] @ left[:, ::-1][:, :count]
    for i in reversed(range(m)):  # solve lower' x = motions in place, which NumPy does only in double
        motions[i] = (motions[i] - lower[i + 1 :, i] @ motions[i + 1 :]) / lower[i, i]
    return fractions, motions.T


def slope(function, q: np.ndarray, h: float = 2e-4) -> np.ndarray:
    """Central differences of fourth order: ``function (M, n) -> (M, ...)``, q (n,); (n, ...)."""
    eye = np.eye(q.size)
    points = np.concatenate([q + s * h * eye for s in (1, -1, 2, -2)])
    a, b, c, d = np.split(function(points), 4)
    return (8 * (a - b) - (c - d)) / (12 * h)


def three_link_fibre(arm: hf.Arm, point: np.ndarray, count: int = 4000) -> np.ndarray:
    """Every in-limit configuration (K, 3) of three unit links at a point: the last link's direction, two elbows."""
    phi = np.linspace(-np.pi, np.pi, count, endpoint=False)
    wrist = point[:2] - np.c_[np.cos(phi), np.sin(phi)]
    cosine = (np.sum(wrist**2, axis=1) - 2) / 2
    phi, wrist, cosine = (x[np.abs(cosine) <= 1] for x in (phi, wrist, cosine))
    out = []
    for side in (1, -1):
        elbow = side * np.arccos(cosine)
        first = np.arctan2(wrist[:, 1], wrist[:, 0]) - np.arctan2(np.sin(elbow), 1 + np.cos(elbow))
        q = np.stack([first, elbow, phi - first - elbow], axis=1)
        out.append((q + np.pi) % (2 * np.pi) - np.pi)
    q = np.concatenate(out)
    return q[((q >= arm.lower) & (q <= arm.upper)).all(axis=1)]


# ---- the best configuration of a pose, by a program that knows only transforms --------------------------------------------


def dh_chain(rows: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tool pose (4, 4) and geometric Jacobian (6, n) of distal Denavit-Hartenberg rows (n, 4): a, alpha, d, theta at 0."""
    t, axes, places = np.eye(4), [], []
    for (a, alpha, d, theta), angle in zip(rows, q, strict=True):
        axes.append(t[:3, 2].copy())
        places.append(t[:3, 3].copy())
        turn = Rotation.from_euler("z", theta + angle).as_matrix()
        t = t @ pose(turn, turn @ [a, 0, 0] + [0, 0, d]) @ pose(Rotation.from_euler("x", alpha).as_matrix())
    z, p = np.array(axes), np.array(places)
    return t, np.concatenate([np.cross(z, t[:3, 3] - p), z], axis=1).T


def best_worst_rho(
    rows: np.ndarray, low: np.ndarray, high: np.ndarray, target: np.ndarray, starts: int, rng: np.random.Generator
) -> float:
    """Largest worst-case relative manipulability over the configurations of a pose, by SLSQP from several starts; 0 if none."""

    def apart(q: np.ndarray) -> np.ndarray:
        t, _ = dh_chain(rows, q)
        turn = Rotation.from_matrix(target[:3, :3] @ t[:3, :3].T).as_rotvec()
        return np.concatenate([target[:3, 3] - t[:3, 3], turn])

    def squares(q: np.ndarray) -> np.ndarray:
        j = dh_chain(rows, q)[1]
        return 1 - np.einsum("ij,ij->j", j, np.linalg.solve(j @ j.T, j))

    found, tries = 0.0, 0
    while starts and tries < 60:
        tries += 1
        q = rng.uniform(low, high)
        for _ in range(60):
            e = apart(q)
            j = dh_chain(rows, q)[1]
            q = np.clip(q + j.T @ np.linalg.solve(j @ j.T + 1e-3 * (e @ e) * np.eye(6), e), low, high)
        if np.linalg.norm(apart(q)) > 1e-8:
            continue
        starts -= 1
        x0 = np.append(q, squares(q).min())
        made = minimize(
            lambda x: -x[-1],
            x0,
            jac=lambda x: np.append(np.zeros(len(x) - 1), -1.0),
            bounds=[*zip(low, high, strict=True), (0, 1)],
            constraints=[
                {"type": "eq", "fun": lambda x: apart(x[:-1])},
                {"type": "ineq", "fun": lambda x: squares(x[:-1]) - x[-1]},
            ],
            method="SLSQP",
            options={"maxiter": 120, "ftol": 1e-9},
        )
        if np.linalg.norm(apart(made.x[:-1])) < 1e-6:
            found = max(found, float(np.sqrt(max(squares(made.x[:-1]).min(), 0.0))))
    return found


# ---- planar arms in closed loop, by scipy ---------------------------------------------------------------------------------


def planar_hand(lengths: Sequence[float], q: np.ndarray) -> np.ndarray:
    """Hand (..., 2) of a planar arm of these links."""
    angle = np.cumsum(q, axis=-1)
    return np.stack([np.cos(angle) @ lengths, np.sin(angle) @ lengths], axis=-1)


def planar_jacobian(lengths: Sequence[float], q: np.ndarray) -> np.ndarray:
    """(2, n) of one configuration."""
    angle = np.cumsum(q)
    columns = [[-(np.sin(angle[k:]) @ lengths[k:]), np.cos(angle[k:]) @ lengths[k:]] for k in range(len(q))]
    return np.array(columns).T


def planar_run(lengths, damping: float, q0, target, locked: int, until: float, arrives: float = 0.0):
    """The arm towards a target with gain 1 by the damped inverse of all joints, one of which (-1: none) does not move."""
    lengths, moves = np.asarray(lengths, dtype=float), np.arange(len(q0)) != locked

    def rates(_, q):
        j = planar_jacobian(lengths, q)
        e = target - planar_hand(lengths, q)
        return moves * (j.T @ np.linalg.solve(j @ j.T + damping**2 * np.eye(2), e))

    def there(_, q):
        return np.linalg.norm(target - planar_hand(lengths, q)) - arrives

    there.terminal = True
    # LSODA: beside a singular configuration the damped inverse is stiff.
    return solve_ivp(rates, (0, until), q0, "LSODA", events=there, dense_output=True, rtol=1e-9, atol=1e-11)


def two_link_ring(lengths: Sequence[float], joint: int, angle: float) -> tuple[np.ndarray, float, float]:
    """What a planar 3R arm with a locked joint reaches: middle (2,), least and largest radius of a ring."""
    a, b, c = lengths
    if joint == 0:
        return a * np.array([np.cos(angle), np.sin(angle)]), abs(b - c), b + c
    first, second = (abs(a + b * np.exp(1j * angle)), c) if joint == 1 else (a, abs(b + c * np.exp(1j * angle)))
    return np.zeros(2), abs(first - second), first + second


# ---- of everything that has a name ---------------------------------------------------------------------------------------


def damped_inverse(j: np.ndarray, damping: float) -> np.ndarray:
    """``J' (J J' + damping^2 I)^-1`` by singular values."""
    u, s, v = np.linalg.svd(j, full_matrices=False)
    return v.T @ np.diag(s / (s**2 + damping**2)) @ u.T


def weighted(j: np.ndarray, u: np.ndarray, law: hf.control.Weighted, damping: float) -> np.ndarray:
    w = np.linalg.inv(law.weights)
    return w @ j.T @ np.linalg.solve(j @ w @ j.T, u)


def jacobian_transpose(j: np.ndarray, u: np.ndarray, law: hf.control.Law, damping: float) -> np.ndarray:
    """The step along ``J' u`` that leaves the least of u, as a least-squares problem of one unknown."""
    slope = u @ j
    return np.linalg.lstsq((j @ slope)[:, None], u, rcond=None)[0][0] * slope


def generalized_gravity(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    import pinocchio as pin

    model, _ = to_pinocchio(arm)
    data = model.createData()
    return np.array([pin.computeGeneralizedGravity(model, data, x) for x in q])


def failed_acceleration(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """Of each joint as it fails, the others held: its torque over its entry of the mass matrix."""
    import pinocchio as pin

    model, _ = to_pinocchio(arm)
    data = model.createData()
    inertia = np.array([np.diag(pin.crba(model, data, x)).copy() for x in q])
    return -generalized_gravity(arm, q) / inertia


def free_fall(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """The accelerations with which all joints start together."""
    import pinocchio as pin

    model, _ = to_pinocchio(arm)
    data, still = model.createData(), np.zeros(arm.n)
    return np.array([pin.aba(model, data, x, still, still).copy() for x in q])


def swing_angle(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """To the least potential energy, a sinusoid of each joint that three values fix; 0 for a joint that slides."""
    import pinocchio as pin

    model, _ = to_pinocchio(arm)
    data = model.createData()
    out = np.zeros(q.shape)
    for row, x in zip(out, q, strict=True):
        for k in np.flatnonzero(~arm.prismatic):
            turned = (x + turn * np.eye(arm.n)[k] for turn in (0, np.pi / 2, np.pi))
            a, b, c = (pin.computePotentialEnergy(model, data, y) for y in turned)
            row[k] = np.arctan2((a + c) / 2 - b, (c - a) / 2)
    return out


def attained(j: np.ndarray, whole: np.ndarray) -> float:
    """What some Jacobian keeps after so many locks: equal entries of the null space, or what is stored."""
    m, n = whole.shape[-2:]
    k = n - j.shape[-1]
    return np.sqrt((n - m) / n) if k == 1 else hf.index_bounds.upper_bound(n=n, m=m, k=k).best_known


ORACLES = {
    "index": {  # (reduced Jacobians (N, m, c), whole ones (N, m, n), the index for its settings and task) -> (N,)
        "relative-manipulability": lambda j, whole, of: singular_values(j).prod(-1) / singular_values(whole).prod(-1),
        "ceiling-fraction": lambda j, whole, of: (
            singular_values(j).prod(-1) / singular_values(whole).prod(-1) / attained(j, whole)
        ),
        "manipulability": lambda j, whole, of: singular_values(j).prod(-1),
        "mean-singular-value": lambda j, whole, of: singular_values(j).mean(-1),
        "geometric-mean-singular-value": lambda j, whole, of: singular_values(j).prod(-1) ** (1 / j.shape[-2]),
        "minimum-singular-value": lambda j, whole, of: singular_values(j)[..., -1],
        "condition-number": lambda j, whole, of: condition(j),
        "directional-velocity": directional_velocity,
    },
    "control law": {  # (Jacobian (m, n), task velocity (m,), both scaled, the law, the damping it says it took) -> rates (n,)
        "pseudoinverse": lambda j, u, law, damping: np.linalg.pinv(j) @ u,
        "weighted": weighted,
        "damped": lambda j, u, law, damping: damped_inverse(j, law.fixed_damping) @ u,
        "failure-tolerant": lambda j, u, law, damping: damped_inverse(j, damping) @ u,  # its choice has tests of its own
        "jacobian-transpose": jacobian_transpose,
    },
    "susceptibility": {  # (arm, q (N, n)) -> of each joint (N, n)
        "torque": generalized_gravity,
        "acceleration": failed_acceleration,
        "swing-angle": swing_angle,
        "free-acceleration": free_fall,
        "release": free_fall,
        "tool-drop": free_fall,
    },
}
"""Every registered name by another route. A name without one fails ``test_registry.py``, which says what to add here."""


def example(registry: Registry, name: str, arm: hf.Arm, task="pose") -> str:
    """A label for an arm and a task: the name, with the settings of its example where it cannot do without."""
    return registry.labels(arm, task)[list(registry).index(name)]


def index_of(name: str, arm: hf.Arm, task="pose", failures="single", length: float | None = None) -> hf.indices.Index:
    """A registered index, with the settings of its example where it cannot do without."""
    return hf.indices.by_name(example(INDEX_REGISTRY, name, arm, task), arm, task, failures=failures, length=length)
