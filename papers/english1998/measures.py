"""Which measure to minimise: what configurations chosen by each do in the other measures, and when a joint swings free."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import holdfast as hf
from holdfast.kinematics.indices.susceptibility import Susceptibility
from holdfast.kinematics.solvers import fibres

Array = NDArray[np.float64]

ARMS = ("panda", "xarm7")
POSES = 16
BRAKE_MS = 100.0
SEED = 1
NO_SWING_DEG = 3.0  # the configurations are traced 0.05 rad apart
JOINT_COLUMNS = (
    "joint",
    "smallest swing, median, deg",
    f"poses at which it is below {NO_SWING_DEG:g} deg",
    f"poses at which this joint moves the tool most in {BRAKE_MS:g} ms",
)
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


@dataclass(frozen=True)
class Study:
    """Outcomes of one arm, and what each joint can and does.

    Attributes:
        outcomes: One per way to choose.
        least_swing: (P, n) smallest swing of each joint among all configurations of each pose, rad.
        worst_joint: (P,) joint whose failure moves the tool most in ``BRAKE_MS``, in the first configuration found.
    """

    outcomes: list[Outcome]
    least_swing: Array
    worst_joint: NDArray[np.int64]

    def joint_row(self, joint: int) -> list[str]:
        """Cells of a table."""
        least = np.rad2deg(self.least_swing[:, joint])
        zero = int((least < NO_SWING_DEG).sum())
        return [str(joint + 1), f"{np.median(least):.0f}", str(zero), str(int((self.worst_joint == joint).sum()))]


def compare(name: str) -> Study:
    """The first configuration found for each pose, and the best under each measure."""
    arm = hf.arms.load(name)
    region = hf.Region.around_tool(arm, hf.arms.about(name).home)
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
        best = hf.optimise(arm, poses, measure, seed=SEED)
        best.require_ok()
        chosen[label] = best.q
    curves = [f.q for f in fibres(arm, poses, "pose", spacing=0.05, seed=SEED)]
    chosen["the last column itself, among all configurations"] = np.array([q[fallen(swing, q).argmin()] for q in curves])
    outcomes = [Outcome(label, outcome(arm, acceleration, swing, q)) for label, q in chosen.items()]
    least = np.array([np.abs(swing.by_joint(q)).min(axis=0) for q in curves])
    return Study(outcomes, least, moved_by_joint(arm, found.q[found.success]).argmax(axis=1))


def outcome(arm: hf.Arm, acceleration: Susceptibility, swing: Susceptibility, q: Array) -> Array:
    """(P, 5) of configurations (P, n), in the order of ``COLUMNS``."""
    load = arm.gravity_torque(q) / np.array([joint.effort for joint in arm.joints])
    moved = moved_by_joint(arm, q).max(axis=1)
    return np.stack([rms(load), rms(acceleration.by_joint(q)), rms(swing.by_joint(q)), 1000 * moved, fallen(swing, q)], axis=1)


def moved_by_joint(arm: hf.Arm, q: Array) -> Array:
    """(P, n) of configurations (P, n): how far each joint's failure moves the tool in ``BRAKE_MS``, m."""
    return np.array([[moved_after(arm, one, k) for k in range(arm.n)] for one in q])


def moved_after(arm: hf.Arm, q: Array, joint: int) -> float:
    """How far the tool is from its place when the brakes act after ``BRAKE_MS``, m."""
    friction = hf.Friction(coulomb=0.0, viscous=visible_friction(arm, q, joint))
    fall = hf.power_loss(arm, q, free=[joint], friction=friction, stops=False, duration=BRAKE_MS / 1000)
    return float(np.linalg.norm(fall.tool_at(BRAKE_MS / 1000) - arm.forward_kinematics(q)[:3, 3]))


def visible_friction(arm: hf.Arm, q: Array, joint: int) -> float:
    """The joint's viscous friction, or 10 % of critical if the file has less than 2 % as a placeholder, N m s/rad."""
    turns = q + np.array([[0.0], [np.pi / 2]]) * np.eye(arm.n)[joint]
    # About one axis the torque of gravity is a sine, so values a quarter turn apart give its amplitude.
    stiffness = float(np.linalg.norm(arm.gravity_torque(turns)[:, joint]))
    acceleration = float(np.linalg.norm(hf.susceptibility.acceleration(arm).by_joint(turns)[:, joint]))
    critical = 2 * stiffness / np.sqrt(acceleration) if acceleration > 0 else 0.0
    own = arm.joints[joint].friction
    return own if own > 0.02 * critical else 0.1 * critical


def fallen(swing: Susceptibility, q: Array) -> Array:
    """(N,) of configurations (N, n): how far the tool is from its place when the worst joint hangs still, m."""
    arm = swing.arm
    hanging = q[:, None] + np.eye(arm.n) * swing.by_joint(q)[:, None]
    place = arm.forward_kinematics(hanging.reshape(-1, arm.n))[:, :3, 3].reshape(*q.shape, 3)
    return np.asarray(np.linalg.norm(place - arm.forward_kinematics(q)[:, None, :3, 3], axis=2).max(axis=1))


def rms(x: Array) -> Array:
    """Root of the mean square of each row."""
    return np.asarray(np.sqrt(np.mean(x**2, axis=1)))
