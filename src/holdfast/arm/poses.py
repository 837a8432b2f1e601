"""Poses as arrays: what every entry point accepts."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError

Array = NDArray[np.float64]


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
