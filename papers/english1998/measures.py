"""Which measure to minimise: what configurations chosen by each do in the other measures, and when a joint lets go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.indices.susceptibility import Susceptibility
from holdfast.solve import fibres

Array = NDArray[np.float64]

ARMS = ("panda", "xarm7")
POSES = 16
BRAKE_MS = 100.0
SEED = 1
COLUMNS = (
    "holding torques, share of effort, rms",
    "accelerations, rms, rad/s^2",
    "swing angles, rms, deg",
    f"tool moved after {BRAKE_MS:g} ms, worst joint, mm",
    "tool moved when it hangs still, worst joint, m",
)


@dataclass(frozen=True)
class Outcome:
    """Of P poses: (P, 5) what the configurations chosen by one measure do, in the order of ``COLUMNS``."""

    chosen_by: str
    values: Array

    @property
    def row(self) -> list[str]:
        """Medians, for a table."""
        a, b, c, d, e = np.median(self.values, axis=0)
        return [self.chosen_by, f"{a:.3f}", f"{b:.1f}", f"{np.rad2deg(c):.0f}", f"{d:.0f}", f"{e:.2f}"]


def compare(name: str) -> list[Outcome]:
    """The first configuration found for each pose, and the best under each measure."""
    arm = hf.arms.load(name)
    region = hf.Region.around(arm, hf.arms.about(name).home)
    poses = region.poses(next(region.blocks(0, SEED))[:POSES])
    torque = hf.susceptibility.torque(arm, "effort")
    acceleration, swing = hf.susceptibility.acceleration(arm), hf.susceptibility.swing_angle(arm)
    measures = {
        "torque, over effort": torque,
        "torque, over effort, made worst": torque.reversed(),
        "acceleration": acceleration,
        "swing angle": swing,
    }
    found = hf.solve_ik(arm, poses, SEED)
    poses = poses[found.success]
    chosen = {"nothing: first configuration found": found.q[found.success]}
    for label, measure in measures.items():
        best = hf.optimise(arm, poses, measure, SEED)
        best.require_ok()
        chosen[label] = best.q
    curves = [f.q for f in fibres(arm, poses, "pose", 0.05, SEED)]
    chosen["the last column itself, among all configurations"] = np.array([q[fallen(swing, q).argmin()] for q in curves])
    return [Outcome(label, outcome(arm, acceleration, swing, q)) for label, q in chosen.items()]


def outcome(arm: hf.Arm, acceleration: Susceptibility, swing: Susceptibility, q: Array) -> Array:
    """(P, 5) of configurations (P, n), in the order of ``COLUMNS``."""
    load = arm.gravity_torque(q) / np.array([joint.effort for joint in arm.joints])
    moved = np.array([[moved_after(arm, one, k) for k in range(arm.n)] for one in q]).max(axis=1)
    return np.stack([rms(load), rms(acceleration.by_joint(q)), rms(swing.by_joint(q)), 1000 * moved, fallen(swing, q)], axis=1)


def moved_after(arm: hf.Arm, q: Array, joint: int) -> float:
    """How far the tool is from its place when the brakes act after ``BRAKE_MS``, m."""
    swing = hf.free_swing(arm, q, joint, duration=BRAKE_MS / 1000, brake_after=(BRAKE_MS,))
    return swing.drops[0].distance


def fallen(swing: Susceptibility, q: Array) -> Array:
    """(N,) of configurations (N, n): how far the tool is from its place when the worst joint hangs still, m."""
    arm = swing.arm
    hanging = q[:, None] + np.eye(arm.n) * swing.by_joint(q)[:, None]
    place = arm.forward_kinematics(hanging.reshape(-1, arm.n))[:, :3, 3].reshape(*q.shape, 3)
    return np.asarray(np.linalg.norm(place - arm.forward_kinematics(q)[:, None, :3, 3], axis=2).max(axis=1))


def rms(x: Array) -> Array:
    """Root of the mean square of each row."""
    return np.asarray(np.sqrt(np.mean(x**2, axis=1)))
