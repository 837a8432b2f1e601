"""Check and convert poses and rotations as arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray

_QUARTER_TURN_TOLERANCE_RAD = 1e-9  # rad; files write pi/2 with 11 or more digits


def check_poses(poses: ArrayLike) -> FloatArray:
    """Return ``poses`` (4, 4) or (N, 4, 4), m, as (N, 4, 4) float64.

    Raises:
        InputError: The shape is wrong, or the upper left block of a finite pose is not a rotation.
    """
    checked = np.asarray(poses, dtype=np.float64)
    if checked.ndim not in (2, 3) or checked.shape[-2:] != (4, 4):
        raise InputError(f"poses have shape {checked.shape}; they must be (4, 4) or (N, 4, 4) arrays")
    checked = checked[None] if checked.ndim == 2 else checked
    rotation = checked[:, :3, :3]
    finite: BoolArray = np.asarray(np.isfinite(checked).all(axis=(1, 2)))
    orthonormality_error = np.abs(rotation @ rotation.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2), initial=0.0)
    wrong = np.flatnonzero(
        finite & ((orthonormality_error > 1e-6) | (np.linalg.det(np.where(finite[:, None, None], rotation, np.eye(3))) < 0))
    )
    if wrong.size:
        raise InputError(f"pose {wrong[0]} has no rotation in its upper left 3x3 block (orthonormal, determinant +1)")
    return checked


def pose_from_quaternion(position: ArrayLike, quaternion: ArrayLike) -> FloatArray:
    """Return the pose (4, 4) of a position (3,), m, and a quaternion x, y, z, w of any length except 0."""
    from scipy.spatial.transform import Rotation

    pose = np.eye(4)
    pose[:3, 3], pose[:3, :3] = position, Rotation.from_quat(np.asarray(quaternion, dtype=np.float64)).as_matrix()
    return pose


def pose_numbers(pose: FloatArray) -> tuple[float, ...]:
    """Return position x, y, z in m and unit quaternion x, y, z, w of the ``pose`` (4, 4)."""
    from scipy.spatial.transform import Rotation

    return (*pose[:3, 3].tolist(), *Rotation.from_matrix(pose[:3, :3]).as_quat().tolist())


# ---- rotations for every command, without the import of scipy.spatial ----------------------------------------------


def rotations_of_quaternions(quaternions: ArrayLike) -> FloatArray:
    """Return rotations (..., 3, 3) of quaternions (..., 4), x, y, z, w, of any length except 0."""
    q = np.asarray(quaternions, dtype=np.float64)
    x, y, z, w = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [
        [x * x - y * y - z * z + w * w, 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), -x * x + y * y - z * z + w * w, 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), -x * x - y * y + z * z + w * w],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def rotations_of_vectors(vectors: ArrayLike) -> FloatArray:
    """Return rotations (..., 3, 3) of rotation vectors (..., 3), whose lengths are the angles, rad."""
    rotation_vector = np.asarray(vectors, dtype=np.float64)
    half_angle = np.linalg.norm(rotation_vector, axis=-1, keepdims=True) / 2
    return rotations_of_quaternions(
        np.concatenate([rotation_vector / 2 * np.sinc(half_angle / np.pi), np.cos(half_angle)], axis=-1)
    )


def rotation_vectors(rotations: ArrayLike) -> FloatArray:
    """Return rotation vectors (..., 3) of rotations (..., 3, 3), angles from 0 to pi, rad."""
    matrices = np.asarray(rotations, dtype=np.float64)
    trace = np.trace(matrices, axis1=-2, axis2=-1)[..., None]
    diagonal = np.diagonal(matrices, axis1=-2, axis2=-1)
    # The rows are 4 q q^T of the unit quaternion q; the longest one has no cancellation.
    quaternion_products = np.empty((*matrices.shape[:-2], 4, 4))
    quaternion_products[..., :3, :3] = matrices + matrices.swapaxes(-1, -2)
    np.einsum("...ii->...i", quaternion_products)[..., :3] = 1 + 2 * diagonal - trace
    quaternion_products[..., 3, 3] = 1 + trace[..., 0]
    double_sines = np.stack(
        [
            matrices[..., 2, 1] - matrices[..., 1, 2],
            matrices[..., 0, 2] - matrices[..., 2, 0],
            matrices[..., 1, 0] - matrices[..., 0, 1],
        ],
        axis=-1,
    )
    quaternion_products[..., 3, :3] = quaternion_products[..., :3, 3] = double_sines
    largest = np.einsum("...ii->...i", quaternion_products).argmax(axis=-1)[..., None, None]
    quaternion = np.take_along_axis(quaternion_products, largest, axis=-2)[..., 0, :]
    quaternion = quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True)
    quaternion = np.where(quaternion[..., 3:] < 0, -quaternion, quaternion)
    half_angle = np.arctan2(np.linalg.norm(quaternion[..., :3], axis=-1, keepdims=True), quaternion[..., 3:])
    return np.asarray(quaternion[..., :3] * 2 / np.sinc(half_angle / np.pi))


def zyx_angles(rotations: ArrayLike) -> FloatArray:
    """Return angles (..., 3) a, b, c, rad, of rotations ``Rz(a) Ry(b) Rx(c)``, b within +-90 degrees, where c is 0."""
    matrices = np.asarray(rotations, dtype=np.float64)
    cosine_of_b = np.hypot(matrices[..., 0, 0], matrices[..., 1, 0])
    upright = cosine_of_b < 1e-12
    sines = np.where(upright, -matrices[..., 0, 1], matrices[..., 1, 0])
    a = np.arctan2(sines, np.where(upright, matrices[..., 1, 1], matrices[..., 0, 0]))
    c = np.where(upright, 0.0, np.arctan2(matrices[..., 2, 1], matrices[..., 2, 2]))
    return np.stack([a, np.arctan2(-matrices[..., 2, 0], cosine_of_b), c], axis=-1)


# ---- motions of joints -----------------------------------------------------------------------------------------------
def joint_motion(kind: str, axis: FloatArray, value: float) -> FloatArray:
    """Return the motion (4, 4) of a joint, rad or m; the identity for types without one axis."""
    pose = np.eye(4)
    if kind == "prismatic":
        pose[:3, 3] = axis * value
    elif kind in ("revolute", "continuous"):
        pose[:3, :3] = _rotation_about(axis, value)
    return pose


def rotation_to_axis(axis: FloatArray) -> FloatArray:
    """Return a rotation (3, 3) whose third column is a unit ``axis``: to the frame of a joint from one with the axis as z."""
    perpendicular = np.linalg.svd(axis[None])[2][1]
    return np.column_stack([perpendicular, np.cross(axis, perpendicular), axis])


def cos_sin(angle: float) -> tuple[float, float]:
    """Return cosine and sine, exact at quarter turns."""
    quarters = round(angle / (np.pi / 2))
    # Exact zeros remove terms from the generated code, and they are what the author of the file meant.
    if abs(angle - quarters * np.pi / 2) < _QUARTER_TURN_TOLERANCE_RAD:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarters % 4]
    return float(np.cos(angle)), float(np.sin(angle))


def _rotation_about(axis: FloatArray, angle: float) -> FloatArray:
    """Return the rotation (3, 3) about a unit axis (Rodrigues)."""
    cosine, sine = cos_sin(angle)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(cosine * np.eye(3) + sine * cross + (1 - cosine) * np.outer(axis, axis))
