"""The length in which an arm's own errors are small or not, so that thresholds mean the same for arms of any size."""

from __future__ import annotations

import numpy as np

from holdfast.arm.model import Arm


def length_unit(arm: Arm) -> float:
    """A length of about the arm's own size, m: its links end to end and the tool, rounded to a power of two.

    Errors are divided by it before they are compared with a threshold. A power of two rounds nothing in that: copies of an
    arm in sizes a power of two apart do the same to the last bit. 1 m where nothing has a length.
    """
    size = sum(float(np.linalg.norm(joint.origin[:3, 3])) for joint in arm.joints[1:])
    size += float(np.linalg.norm(arm.tool[:3, 3]))
    slides = [max(abs(j.lower), abs(j.upper)) for j in arm.joints if j.prismatic]
    size += sum(x for x in slides if np.isfinite(x))
    return float(2.0 ** np.round(np.log2(size))) if size > 0 else 1.0
