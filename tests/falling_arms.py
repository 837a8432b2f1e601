"""Arms of one joint whose falls have closed forms."""

from __future__ import annotations

import numpy as np

import holdfast as hf
import oracles

G, LENGTH, MASS = 9.81, 0.7, 2.0
WEIGHT = MASS * G * LENGTH
FREE = hf.Friction(viscous=0.0)


def pendulum(**joint) -> hf.Arm:
    """A heavy point on a light rod along x, turning about -y: level at q = 0, hanging at -pi/2."""
    return hf.Arm(
        name="pendulum",
        joints=(hf.Joint("hinge", "revolute", np.eye(4), axis=np.array([0.0, -1, 0]), **joint),),
        links=(hf.Link(MASS, np.array([LENGTH, 0, 0]), np.zeros((3, 3))),),
        tool=oracles.pose(None, [LENGTH, 0, 0]),
    )


def lift(lower: float = -10.0, upper: float = 10.0) -> hf.Arm:
    joint = hf.Joint("lift", "prismatic", np.eye(4), axis=np.array([0.0, 0, 1]), lower=lower, upper=upper)
    return hf.Arm(name="lift", joints=(joint,), links=(hf.Link(MASS, np.zeros(3), np.eye(3)),))
