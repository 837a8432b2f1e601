"""The planar arm of the paper without limits, and lines for its hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
from holdfast.kinematics.paths import Constant, TimedPath, line


@pytest.fixture(scope="session")
def planar() -> hf.Arm:
    """Three links of 1 m, gravity along -y; joints turn without limits."""
    arm = hf.arms.load("planar-3r")
    return replace(arm, joints=tuple(replace(j, lower=-np.inf, upper=np.inf) for j in arm.joints))


@pytest.fixture(scope="session")
def across():
    """``across(x, y)``: from x to -x at height y in 10 s."""
    return lambda x, y: TimedPath(line([x, y, 0], [-x, y, 0]), Constant(10.0))
