"""The arm of the workloads for the peers: the PA10 with 9 joints, its Jacobian and the index straight from the definitions."""

from __future__ import annotations

from itertools import islice
from pathlib import Path

import numpy as np

Array = np.ndarray

N = 9
A = np.zeros(N)
ALPHA = np.deg2rad([-90, 90, -90, 90, -90, 90, -90, 90, 0.0])
D = np.array([0.315, 0, 0.45, 0, 0.5, 0, 0.45, 0, 0.08])
COS_ALPHA, SIN_ALPHA = np.round(np.cos(ALPHA), 15), np.round(np.sin(ALPHA), 15)
LOWER = np.deg2rad([-45.0, -15, -45, 45, -45, -27, -45, -9, -45])
UPPER = np.deg2rad([45.0, 75, 45, 135, 45, 63, 45, 81, 45])


def ours():
    """The same arm in holdfast, after a check that it is the same."""
    from holdfast import arms

    arm = arms.load("pa10-9dof")
    if not (np.allclose(arm.lower, LOWER) and np.allclose(arm.upper, UPPER)):
        raise RuntimeError("the built-in pa10-9dof no longer has the limits written here")
    return arm


def configurations(count: int, seed: int = 0) -> Array:
    """(count, 9) uniform within the limits, row-major."""
    return np.random.default_rng(seed).uniform(LOWER, UPPER, (count, N))


def link_transform(i: int, angle: Array) -> Array:
    """Standard DH: (..., 4, 4) from frame i to frame i + 1."""
    c, s = np.cos(angle), np.sin(angle)
    ca, sa = COS_ALPHA[i], SIN_ALPHA[i]
    zero, one = np.zeros_like(c), np.ones_like(c)
    rows = [
        [c, -s * ca, s * sa, A[i] * c],
        [s, c * ca, -c * sa, A[i] * s],
        [zero, sa * one, ca * one, D[i] * one],
        [zero, zero, zero, one],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def jacobian(q: Array) -> Array:
    """(N, 6, 9) geometric Jacobian at the tool in the base frame, linear rows first; q may be complex."""
    return forward(q)[1]


def forward(q: Array) -> tuple[Array, Array]:
    """Poses of the tool (N, 4, 4) in the base frame, and its geometric Jacobian."""
    frame = np.broadcast_to(np.eye(4, dtype=q.dtype), (len(q), 4, 4))
    axes, origins = [], []
    for i in range(N):
        axes.append(frame[:, :3, 2])
        origins.append(frame[:, :3, 3])
        frame = frame @ link_transform(i, q[:, i])
    z, p = np.stack(axes, axis=1), np.stack(origins, axis=1)
    linear = np.cross(z, frame[:, None, :3, 3] - p)
    return frame, np.concatenate([linear, z], axis=2).transpose(0, 2, 1)


def region_poses(count: int, seed: int = 1) -> Array:
    """(count, 4, 4) poses, uniform in the region of the paper; the first ones are the same for every count."""
    from holdfast.kinematics.regions import builtin_region

    region = builtin_region("pa10-9dof")
    if region is None:
        raise RuntimeError("holdfast no longer knows the region of the pa10-9dof")
    blocks = islice(region.blocks(0, seed), -(-count // region.block))
    return region.poses(np.concatenate(list(blocks))[:count])


def on_pose(poses: Array, q: Array, tolerance: float = 1e-6) -> Array:
    """(N,) True where q is within the limits and puts the tool on the pose, by the forward kinematics of this file.

    Args:
        poses: (N, 4, 4).
        q: (N, 9); NaN is never on the pose.
        tolerance: Largest error, m and rad; also of the limits, since TRAC-IK rounds them to single precision.
    """
    reached = forward(q)[0]
    position = np.linalg.norm(reached[:, :3, 3] - poses[:, :3, 3], axis=1)
    chord = np.linalg.norm(reached[:, :3, :3] - poses[:, :3, :3], axis=(1, 2)) / np.sqrt(2)  # 2 sin(angle / 2)
    inside = ((q >= LOWER - tolerance) & (q <= UPPER + tolerance)).all(axis=1)
    return inside & (position <= tolerance) & (chord <= tolerance)


def by_determinants(q: Array) -> Array:
    """(N, 9) relative manipulability of every joint, by the determinants of its definition; q may be complex."""
    j = jacobian(q)
    healthy = np.linalg.det(j @ j.transpose(0, 2, 1))
    columns = []
    for k in range(N):
        reduced = np.delete(j, k, axis=2)
        columns.append(np.linalg.det(reduced @ reduced.transpose(0, 2, 1)) / healthy)
    squares = np.stack(columns, axis=1)
    return np.sqrt(squares if np.iscomplexobj(squares) else np.maximum(squares, 0))


def worst_by_determinants(q: Array) -> Array:
    """(N,) the workload W1."""
    return by_determinants(q).min(axis=1)


def gradient_by_complex_step(q: Array) -> Array:
    """(N, 9) the workload W2: derivative of the worst joint's value, exact to rounding."""
    worst = by_determinants(q).argmin(axis=1)
    step = 1e-30
    gradient = np.empty_like(q)
    for i in range(N):
        moved = q.astype(complex)
        moved[:, i] += 1j * step
        gradient[:, i] = by_determinants(moved)[np.arange(len(q)), worst].imag / step
    return gradient


def leverage_of(j: Array) -> Array:
    """(N, 9) j_k' (J J')^-1 j_k: the share of the determinant that goes with column k; rho_k = sqrt(1 - leverage)."""
    return np.einsum("nik,nik->nk", j, np.linalg.solve(j @ j.transpose(0, 2, 1), j))


def worst_of_jacobians(j: Array) -> Array:
    return np.sqrt(np.maximum(1 - leverage_of(j).max(axis=1), 0))


def pinocchio():
    """(model, data, frame id of the tool) of Pinocchio."""
    import pinocchio as pin

    model = pin.Model()
    parent, placement = 0, pin.SE3.Identity()
    for i in range(N):
        parent = model.addJoint(parent, pin.JointModelRZ(), placement, f"joint{i + 1}")
        twist = np.array([[1, 0, 0], [0, COS_ALPHA[i], -SIN_ALPHA[i]], [0, SIN_ALPHA[i], COS_ALPHA[i]]])
        placement = pin.SE3(twist, np.array([A[i], 0, D[i]]))
    tool = model.addFrame(pin.Frame("tool", parent, 0, placement, pin.FrameType.OP_FRAME))
    return model, model.createData(), tool


def robotics_toolbox():
    """Elementary transform sequence of the Robotics Toolbox, whose Jacobian is written in C."""
    import roboticstoolbox as rtb

    links = [rtb.RevoluteDH(d=D[i], alpha=ALPHA[i], a=A[i], qlim=[LOWER[i], UPPER[i]]) for i in range(N)]
    return rtb.DHRobot(links, name="pa10-9dof").ets()


def write_urdf(path: Path) -> None:
    """The arm from link ``base`` to link ``tool``, for peers that read files."""
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    lines = ['<robot name="pa10-9dof">', '<link name="base"/>']
    origin, parent = '<origin xyz="0 0 0" rpy="0 0 0"/>', "base"
    for i in range(N):
        lines += [
            f'<link name="link{i + 1}">{inertial}</link>',
            f'<joint name="joint{i + 1}" type="revolute"><parent link="{parent}"/><child link="link{i + 1}"/>{origin}',
            f'<axis xyz="0 0 1"/><limit lower="{LOWER[i]:.17g}" upper="{UPPER[i]:.17g}" velocity="1" effort="1"/></joint>',
        ]
        origin, parent = f'<origin xyz="{A[i]:.17g} 0 {D[i]:.17g}" rpy="{ALPHA[i]:.17g} 0 0"/>', f"link{i + 1}"
    lines.append(f'<link name="tool"/><joint name="fix" type="fixed"><parent link="{parent}"/><child link="tool"/>{origin}')
    lines.append("</joint></robot>")
    path.write_text("\n".join(lines))
