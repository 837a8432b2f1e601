"""Rotation matrices from quaternions and rotation vectors, and back: what every command needs without loading scipy.spatial."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def of_quaternions(quaternions: ArrayLike) -> Array:
    """Rotations (..., 3, 3) of quaternions (..., 4), x, y, z, w, of any length but 0."""
    q = np.asarray(quaternions, dtype=np.float64)
    x, y, z, w = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [
        [x * x - y * y - z * z + w * w, 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), -x * x + y * y - z * z + w * w, 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), -x * x - y * y + z * z + w * w],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def of_vectors(vectors: ArrayLike) -> Array:
    """Rotations (..., 3, 3) of rotation vectors (..., 3): axes as long as their angles, rad."""
    v = np.asarray(vectors, dtype=np.float64)
    half = np.linalg.norm(v, axis=-1, keepdims=True) / 2
    return of_quaternions(np.concatenate([v / 2 * np.sinc(half / np.pi), np.cos(half)], axis=-1))


def to_vectors(rotations: ArrayLike) -> Array:
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


def to_zyx(rotations: ArrayLike) -> Array:
    """Angles (..., 3) a, b, c, rad, of rotations ``Rz(a) Ry(b) Rx(c)``, b within +-90 degrees; where b is that, c is 0."""
    r = np.asarray(rotations, dtype=np.float64)
    level = np.hypot(r[..., 0, 0], r[..., 1, 0])
    upright = level < 1e-12
    a = np.arctan2(np.where(upright, -r[..., 0, 1], r[..., 1, 0]), np.where(upright, r[..., 1, 1], r[..., 0, 0]))
    c = np.where(upright, 0.0, np.arctan2(r[..., 2, 1], r[..., 2, 2]))
    return np.stack([a, np.arctan2(-r[..., 2, 0], level), c], axis=-1)
