"""Section VI-C: a real arm with seven joints, hung sideways, its second joint made to carry little or much."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.kinematics.paths import TimedPath, Trapezoid, line

Array = NDArray[np.float64]

ARM = "panda"
JOINT = 1
DURATION = 13.0  # s
SCALES = (1.0, 0.5, 0.25)
SAMPLES = 521
START, TRAVEL = (0.5, 0.3, -0.4), (0.0, -0.6, 0.0)  # m in the world
SIDEWAYS = np.array([[0.0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])  # joint 1 turns about the world's x
SEED = 1


@dataclass(frozen=True)
class Hardware:
    """The arm on its side, the path and both motions: joint 2's static torque made small, and made large."""

    arm: hf.Arm
    small: hf.Trajectory
    large: hf.Trajectory

    @classmethod
    def run(cls, global_answer: bool = True) -> Hardware:
        """Both motions; with ``global_answer`` also the best and worst of all configurations of each pose."""
        arm = hf.arms.load(ARM).with_base(SIDEWAYS)
        weights = np.zeros(arm.n)
        weights[JOINT] = 1
        square = hf.susceptibility.torque(arm, weights)
        first = arm.forward_kinematics(np.array(hf.arms.about(ARM).home))
        first[:3, 3] = START
        last = first.copy()
        last[:3, 3] += TRAVEL
        path = TimedPath(line(first, last), Trapezoid(DURATION))
        small = hf.follow(arm, path, minimise=square, task="pose", samples=SAMPLES, seed=SEED, best=global_answer)
        large = hf.follow(arm, path, maximise=square, task="pose", samples=SAMPLES, seed=SEED, best=global_answer)
        return cls(arm, small, large)

    @property
    def way(self) -> Array:
        """(T,) distance along the path, m."""
        return np.asarray(np.linalg.norm(self.small.poses[:, :3, 3] - self.small.poses[0, :3, 3], axis=1))

    def torque(self, motion: hf.Trajectory, scale: float) -> Array:
        """(T,) torque of joint 2 with the whole dynamics, time stretched by ``scale``, N m."""
        return motion.torques(scale)[:, JOINT]

    def gravity(self, motion: hf.Trajectory) -> Array:
        """(T,) the part of it that holds the arm at rest, N m."""
        return np.asarray(self.arm.gravity_torque(motion.q)[:, JOINT])

    def tilt(self, motion: hf.Trajectory) -> Array:
        """(T,) angle of the second axis from the vertical, rad."""
        axes = self.arm.jacobian(motion.q)[:, 3:, JOINT]
        return np.asarray(np.arccos(np.clip(np.abs(axes[:, 2]), 0, 1)))

    @cached_property
    def _parts(self) -> list[hf.Arm]:
        """The arm up to each joint: their tools are the places of the joints."""
        arm = self.arm
        return [replace(arm, joints=arm.joints[:k], links=arm.links[:k], tool=np.eye(4)) for k in range(1, arm.n + 1)]

    def joints(self, q: Array) -> Array:
        """(n + 2, 3) places of the base, the joints and the end effector, m."""
        places = [part.forward_kinematics(q[: part.n])[:3, 3] for part in self._parts]
        return np.array([self.arm.base[:3, 3], *places, self.arm.forward_kinematics(q)[:3, 3]])
