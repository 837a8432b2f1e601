"""Tool poses as six numbers: x, y, z in m, then roll, pitch, yaw in degrees with URDF's convention."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.urdf import rpy_rotation
from holdfast.model.arm.model import Arm


def tool_pose_from_numbers(numbers: ArrayLike) -> FloatArray:
    """Return the pose (4, 4) for six numbers, m and degrees; ``R = Rz(yaw) Ry(pitch) Rx(roll)``."""
    values = np.asarray(numbers, dtype=np.float64)
    pose = np.eye(4)
    pose[:3, 3] = values[:3]
    pose[:3, :3] = rpy_rotation(np.deg2rad(values[3:]).tolist())
    return pose


def format_tool_pose(arm: Arm) -> str:
    """Return the six numbers of an arm's tool in the last link's own frame, comma-separated, to 12 digits."""
    from scipy.spatial.transform import Rotation

    pose = np.linalg.inv(arm.flange) @ arm.tool
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # at a pitch of 90 degrees, several triples are valid
        yaw, pitch, roll = Rotation.from_matrix(pose[:3, :3]).as_euler("ZYX", degrees=True)
    return ",".join(f"{round(float(number), 12) + 0.0:.12g}" for number in (*pose[:3, 3], roll, pitch, yaw))
