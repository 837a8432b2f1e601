"""The runs of the study: here, because processes that start afresh cannot find what is in ``__main__``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import holdfast as hf
from holdfast.control.physics import PhysicalRun

SEED = 1
MOTIONS = 4  # for each arm, task and locked joint
SPREAD = 0.5  # rad: starts about home, and configurations of the targets about the starts
RATE = 250.0  # Hz
LIMIT = 50.0  # s
ARRIVED = 1e-3  # m (and rad): close enough to the target to say that the end effector is there


@dataclass(frozen=True)
class Setting:
    """One group of runs: every joint locked once for every motion."""

    arm: str
    task: str
    bandwidth: float = 10.0  # Hz
    speed: float | None = 0.25  # m/s
    gain: float = 1.0  # 1/s
    limit: float = LIMIT  # s

    @property
    def label(self) -> str:
        """Servos and speed, for people."""
        speed = "no speed limit" if self.speed is None else f"{self.speed:g} m/s"
        return f"{self.bandwidth:g} Hz, gain {self.gain:g}/s, {speed}"


@dataclass(frozen=True)
class Row:
    """What is kept of one run: metres, and the share of the time at which some motor was at its effort."""

    joint: int
    kinematic: str
    physical: str
    reason: str
    there: tuple[bool, bool]  # at the end of the physical run: is the end effector at the target, kinematically and in MuJoCo
    path: float
    end: float
    turn: float
    tracking: float
    saturated: float
    moved: float
    time: float


def runs(setting: Setting) -> list[Row]:
    """All runs of one setting; motions are the same for all settings of an arm."""
    hf.set_threads(1)
    arm, home = hf.arms.load(setting.arm), np.array(hf.arms.about(setting.arm).home)
    law = hf.control.pseudoinverse(arm, setting.task, setting.gain, speed_limit=setting.speed)
    rng = np.random.default_rng(SEED)
    servos = hf.Servos(bandwidth=setting.bandwidth, rate=RATE)
    rows = []
    for _ in range(MOTIONS):
        start = np.clip(home + rng.uniform(-SPREAD, SPREAD, arm.n), arm.lower, arm.upper)
        pose = arm.forward_kinematics(np.clip(start + rng.uniform(-SPREAD, SPREAD, arm.n), arm.lower, arm.upper))
        for joint in range(arm.n):
            rows.append(
                row(hf.simulate_physics(law, start, pose, locked=[joint], servos=servos, time_limit=setting.limit), joint)
            )
    return rows


def row(run: PhysicalRun, joint: int) -> Row:
    """What is kept of a run."""
    return Row(
        joint,
        str(run.kinematic.outcome),
        run.outcome,
        run.reason,
        (bool(run.kinematic_path.error[-1] < ARRIVED), bool(run.error[-1] < ARRIVED)),
        run.path_distance,
        run.terminal_distance,
        run.terminal_turn,
        float(run.tracking_error.max()),
        float(run.saturated_fraction.max()),
        float(np.linalg.norm(np.diff(run.x, axis=0), axis=1).sum()),
        float(run.time[-1]),
    )
