"""Three unit links in the plane in closed form: configurations with one joint locked, and whether a path can be finished."""

from __future__ import annotations

import numpy as np

import holdfast as hf
from holdfast.kinematics.paths import Constant, TimedPath, line


def arm(limits=None):
    """Three unit links in the plane."""
    low, high = limits or (None, None)
    joints = [hf.DH(a=1.0, alpha=0.0, **({} if limits is None else {"lower": low[k], "upper": high[k]})) for k in range(3)]
    return hf.Arm.from_dh(joints, name="three")


def timed(begin, end, duration=2.0):
    return TimedPath(line([*begin, 0.0], [*end, 0.0]), Constant(duration))


def places(path, samples):
    return path.pose(np.linspace(0, path.duration, samples))[:, :2, 3]


def two_links(base, a, b, point, sign):
    """Absolute angles of two links of lengths a and b from base to a point, with the second to one side; None out of reach."""
    x, y = point - base
    cosine = (x * x + y * y - a * a - b * b) / (2 * a * b)
    if abs(cosine) > 1:
        return None
    bend = sign * np.arccos(cosine)
    return np.arctan2(y, x) - np.arctan2(b * np.sin(bend), a + b * np.cos(bend)), bend


def configuration(joint, value, point, sign):
    """The configuration (3,) of unit links with one joint at a value and the tool at a point, by the law of cosines."""
    if joint == 0:
        found = two_links(np.array([np.cos(value), np.sin(value)]), 1.0, 1.0, point, sign)
        return None if found is None else np.array([value, found[0] - value, found[1]])
    # Two links that do not move against each other are one, turned against its first.
    whole = 1 + np.exp(1j * value)
    length, turn = abs(whole), np.angle(whole)
    if joint == 2:
        found = two_links(np.zeros(2), 1.0, length, point, sign)
        return None if found is None else np.array([found[0], found[1] - turn, value])
    found = two_links(np.zeros(2), length, 1.0, point, sign)
    return None if found is None else np.array([found[0] - turn, value, found[1] - value + turn])


def around(x):
    return np.arctan2(np.sin(x), np.cos(x))


def survives(machine, q, joint, points):
    """Closed form: the tool passes through all points (S, 2), the first is that of q, on the branch that q is on."""
    branches = [s for s in (-1, 1) if configuration(joint, q[joint], points[0], s) is not None]
    if not branches:  # at the edge of what is within reach
        return False
    sign = min(branches, key=lambda s: np.abs(around(configuration(joint, q[joint], points[0], s) - q)).max())
    here = q
    for point in points[1:]:
        found = configuration(joint, q[joint], point, sign)
        if found is None:
            return False
        here = here + around(found - here)
        if ((here < machine.lower) | (here > machine.upper)).any():
            return False
    return True


LIMITS = (np.array([-2.0, -2.2, -2.0]), np.array([2.0, 2.4, 2.6]))
