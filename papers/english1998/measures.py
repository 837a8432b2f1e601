"""Which measure to minimise: what configurations chosen by each do in the other measures, and when a joint lets go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
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
    measures = {
        "torque, over effort": hf.susceptibility.torque(arm, "effort"),
        "torque, over effort, made worst": hf.susceptibility.torque(arm, "effort").reversed(),
        "acceleration": hf.susceptibility.acceleration(arm),
        "swing angle": hf.susceptibility.swing_angle(arm),
    }
    found = hf.solve_ik(arm, poses, SEED)
    poses = poses[found.success]
    chosen = {"nothing: first configuration found": found.q[found.success]}
    for label, measure in measures.items():
        best = hf.optimise(arm, poses, measure, SEED)
        best.require_ok()
        chosen[label] = best.q
    curves = [f.q for f in fibres(arm, poses, "pose", 0.05, SEED)]
    chosen["the last column itself, among all configurations"] = np.array([q[fallen(arm, q).argmin()] for q in curves])
    return [Outcome(label, np.array([outcome(arm, q) for q in configurations])) for label, configurations in chosen.items()]


def outcome(arm: hf.Arm, q: Array) -> Array:
    """(5,) in the order of ``COLUMNS``."""
    effort = np.array([joint.effort for joint in arm.joints])
    load = arm.gravity_torque(q) / effort
    acceleration = hf.susceptibility.acceleration(arm).by_joint(q)
    swing = hf.susceptibility.swing_angle(arm).by_joint(q)
    seconds = BRAKE_MS / 1000
    moved = [hf.free_swing(arm, q, k, duration=seconds, brake_after=(BRAKE_MS,)).drops[0].distance for k in range(arm.n)]
    return np.array([rms(load), rms(acceleration), rms(swing), 1000 * max(moved), fallen(arm, q[None])[0]])


def fallen(arm: hf.Arm, q: Array) -> Array:
    """(N,) of configurations (N, n): how far the tool is from its place when the worst joint hangs still, m."""
    swing = hf.susceptibility.swing_angle(arm).by_joint(q)
    hanging = q[:, None] + np.eye(arm.n) * swing[:, None]
    place = arm.forward_kinematics(hanging.reshape(-1, arm.n))[:, :3, 3].reshape(*q.shape, 3)
    return np.asarray(np.linalg.norm(place - arm.forward_kinematics(q)[:, None, :3, 3], axis=2).max(axis=1))


def rms(x: Array) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(x**2)))
