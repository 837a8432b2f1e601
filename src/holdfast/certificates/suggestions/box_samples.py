"""Sampling of the box of targets of a claim."""

from __future__ import annotations

from itertools import product

import numpy as np

from holdfast.certificates.claims import TolerantClaim
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.urdf import rpy_rotation


def sample_box_poses(claim: TolerantClaim, count: int, seed: int, sample: int) -> FloatArray:
    """Return poses (N, 4, 4) of the corners of a claim's box and of ``count`` random targets inside.

    Args:
        claim: Claim about every target of the box.
        count: Number of targets inside.
        seed: Seed of all samples.
        sample: Number of the sample; each number selects different targets.
    """
    from scipy.stats import qmc

    box = claim.box
    varying = box[:, 0] < box[:, 1]
    corners = np.array(list(product(*([lower, upper] if lower < upper else [lower] for lower, upper in box))))
    inside = np.tile(box[:, 0], (count if varying.any() else 0, 1))
    if varying.any():
        halton = qmc.Halton(int(varying.sum()), rng=np.random.default_rng([seed, sample]))
        inside[:, varying] = qmc.scale(halton.random(len(inside)), *box[varying].T)
    rows = np.vstack([corners, inside])
    position_count = 2 if claim.task.startswith("planar") else 3
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :position_count, 3] = rows[:, :position_count]
    if claim.rotation is not None:
        poses[:, :3, :3] = claim.rotation
    elif rows.shape[1] > position_count:  # a planar pose has only yaw
        angles = np.zeros((len(rows), 3))
        angles[:, position_count - rows.shape[1] :] = rows[:, position_count:]
        poses[:, :3, :3] = [rpy_rotation(row.tolist()) for row in angles]
    return poses
