"""The arm of the workloads on free-swinging failures: the 7-joint Panda, for holdfast and the peers, checked to be one arm."""

from __future__ import annotations

from functools import cache

import numpy as np

Array = np.ndarray

N = 7
UP = np.array([0.0, 0.0, 9.81])  # the papers' upward vector


@cache
def ours():
    from holdfast import arms

    return arms.load("panda")


@cache
def pinocchio():
    """The Pinocchio model of the URDF file that holdfast reads too, its data, and the id of the tool frame."""
    from importlib.resources import files

    import pinocchio as pin

    full = pin.buildModelFromUrdf(str(files("holdfast.model.arms").joinpath("data", "panda.urdf")))
    fingers = [full.getJointId(name) for name in full.names if "finger" in name]
    model = pin.buildReducedModel(full, fingers, pin.neutral(full))
    if [*model.names][1:] != [joint.name for joint in ours().joints]:
        raise RuntimeError("the built-in panda no longer has the joints of its file")
    return model, model.createData(), model.getFrameId("panda_hand_tcp")


def weights() -> Array:
    """(7,) diagonal of the weights of torques: 1 over the square of each effort limit, per N^2 m^2."""
    return 1 / np.array([joint.effort for joint in ours().joints]) ** 2


def configurations(count: int, seed: int = 0, share: float = 1.0) -> Array:
    """(count, 7) uniform within the middle ``share`` of the limits, row-major."""
    arm = ours()
    middle, half = (arm.lower + arm.upper) / 2, share * (arm.upper - arm.lower) / 2
    return np.random.default_rng(seed).uniform(middle - half, middle + half, (count, N))
