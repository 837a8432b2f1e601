"""Poses and rotations as arrays: checked input, and conversions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError

Array = NDArray[np.float64]

_QUARTER_TURN_SLACK = 1e-9  # rad; files write pi/2 with 11 or more digits


def check_poses(poses: ArrayLike) -> Array:
    """Poses as (N, 4, 4) float64.

    Raises:
        InputError: Not 4x4, or the upper left block of a finite pose is not a rotation.
    """
    t = np.asarray(poses, dtype=np.float64)
    if t.ndim not in (2, 3) or t.shape[-2:] != (4, 4):
        raise InputError(f"poses have shape {t.shape}; they must be (4, 4) or (N, 4, 4) arrays")
    t = t[None] if t.ndim == 2 else t
    rotation = t[:, :3, :3]
    finite: NDArray[np.bool_] = np.asarray(np.isfinite(t).all(axis=(1, 2)))
    off = np.abs(rotation @ rotation.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2), initial=0.0)
    wrong = np.flatnonzero(finite & ((off > 1e-6) | (np.linalg.det(np.where(finite[:, None, None], rotation, np.eye(3))) < 0)))
    if wrong.size:
        raise InputError(f"pose {wrong[0]} has no rotation in its upper left 3x3 block (orthonormal, determinant +1)")
    return t


def pose_of(position: ArrayLike, quaternion: ArrayLike) -> Array:
    """(4, 4) from a position (3,), m, and a quaternion x, y, z, w of any length but 0."""
    from scipy.spatial.transform import Rotation

    pose = np.eye(4)
    pose[:3, 3], pose[:3, :3] = position, Rotation.from_quat(np.asarray(quaternion, dtype=np.float64)).as_matrix()
    return pose


def pose_numbers(pose: Array) -> tuple[float, ...]:
    """Position x, y, z in m and unit quaternion x, y, z, w of a pose (4, 4)."""
    from scipy.spatial.transform import Rotation

    return (*pose[:3, 3].tolist(), *Rotation.from_matrix(pose[:3, :3]).as_quat().tolist())


# ---- rotations: what every command needs without loading scipy.spatial ---------------------------------------------


def rotations_of_quaternions(quaternions: ArrayLike) -> Array:
    """Rotations (..., 3, 3) of quaternions (..., 4), x, y, z, w, of any length but 0."""
    q = np.asarray(quaternions, dtype=np.float64)
    x, y, z, w = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [
        [x * x - y * y - z * z + w * w, 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), -x * x + y * y - z * z + w * w, 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), -x * x - y * y + z * z + w * w],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def rotations_of_vectors(vectors: ArrayLike) -> Array:
    """Rotations (..., 3, 3) of rotation vectors (..., 3): axes as long as their angles, rad."""
    v = np.asarray(vectors, dtype=np.float64)
    half = np.linalg.norm(v, axis=-1, keepdims=True) / 2
    return rotations_of_quaternions(np.concatenate([v / 2 * np.sinc(half / np.pi), np.cos(half)], axis=-1))


def rotation_vectors(rotations: ArrayLike) -> Array:
    """Rotation vectors (..., 3) of rotations (..., 3, 3), angles from 0 to pi, rad."""
    r = np.asarray(rotations, dtype=np.float64)
    trace = np.trace(r, axis1=-2, axis2=-1)[..., None]
    diagonal = np.diagonal(r, axis1=-2, axis2=-1)
    # 4 q q^T of the unit quaternion q: its longest row is the one without cancellation.
    outer = np.empty((*r.shape[:-2], 4, 4))
    outer[..., :3, :3] = r + r.swapaxes(-1, -2)
    np.einsum("...ii->...i", outer)[..., :3] = 1 + 2 * diagonal - trace
    outer[..., 3, 3] = 1 + trace[..., 0]
    twice = np.stack([r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]], axis=-1)
    outer[..., 3, :3] = outer[..., :3, 3] = twice
    best = np.einsum("...ii->...i", outer).argmax(axis=-1)[..., None, None]
    q = np.take_along_axis(outer, best, axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    q = np.where(q[..., 3:] < 0, -q, q)
    half = np.arctan2(np.linalg.norm(q[..., :3], axis=-1, keepdims=True), q[..., 3:])
    return np.asarray(q[..., :3] * 2 / np.sinc(half / np.pi))


def zyx_angles(rotations: ArrayLike) -> Array:
    """Angles (..., 3) a, b, c, rad, of rotations ``Rz(a) Ry(b) Rx(c)``, b within +-90 degrees; where b is that, c is 0."""
    r = np.asarray(rotations, dtype=np.float64)
    level = np.hypot(r[..., 0, 0], r[..., 1, 0])
    upright = level < 1e-12
    a = np.arctan2(np.where(upright, -r[..., 0, 1], r[..., 1, 0]), np.where(upright, r[..., 1, 1], r[..., 0, 0]))
    c = np.where(upright, 0.0, np.arctan2(r[..., 2, 1], r[..., 2, 2]))
    return np.stack([a, np.arctan2(-r[..., 2, 0], level), c], axis=-1)


# ---- motions of joints -----------------------------------------------------------------------------------------------
def motion(kind: str, axis: Array, value: float) -> Array:
    """(4, 4) motion of a joint by itself, rad or m; the identity for types without one axis."""
    pose = np.eye(4)
    if kind == "prismatic":
        pose[:3, 3] = axis * value
    elif kind in ("revolute", "continuous"):
        pose[:3, :3] = _turn(axis, value)
    return pose


def cos_sin(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact at quarter turns."""
    quarters = round(angle / (np.pi / 2))
    # Exact zeros make terms vanish from the generated code; the file's author meant them.
    if abs(angle - quarters * np.pi / 2) < _QUARTER_TURN_SLACK:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarters % 4]
    return float(np.cos(angle)), float(np.sin(angle))


def _turn(axis: Array, angle: float) -> Array:
    """(3, 3) rotation about a unit axis (Rodrigues)."""
    c, s = cos_sin(angle)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(c * np.eye(3) + s * cross + (1 - c) * np.outer(axis, axis))
