"""Arms as the papers have them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import holdfast as hf


def without_limits(name: str) -> hf.Arm:
    """A built-in arm whose joints turn without limits."""
    arm = hf.arms.load(name)
    return replace(arm, joints=tuple(replace(j, lower=-np.inf, upper=np.inf) for j in arm.joints))
