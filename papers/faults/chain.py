"""The table of section 7: random faults on random tasks, and how many of them are finished by whom."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

import holdfast as hf
from holdfast.faults import Fault

SPEED, GAIN, DAMPING, CENTRING = 0.25, 2.0, 0.02, 0.15  # m/s, 1/s, m, 1/s
ONSET = (0.3, 1.5)  # s
AWAY = (0.2, 0.6)  # m, of a target
COULOMB, VISCOUS = 0.5, 0.3
# Of 100 faults so many of each kind, as in the specification.
MIX: dict[str, tuple[int, Fault]] = {
    "locked": (35, hf.faults.locked(onset=ONSET)),
    "limp": (15, hf.faults.limp(onset=ONSET)),
    "weak": (10, hf.faults.weak(gain=(0.2, 0.7), onset=ONSET)),
    "friction": (10, hf.faults.friction(coulomb=(2 * COULOMB, 8 * COULOMB), onset=ONSET)),
    "sensor_freeze": (10, hf.faults.sensor_freeze(onset=ONSET)),
    "reduced_range": (5, hf.faults.reduced_range(travel=(0.02, 0.3), onset=ONSET)),
    "reduced_speed": (5, hf.faults.reduced_speed(velocity=(0.2, 0.6), onset=ONSET)),
    "sensor_bias": (5, hf.faults.sensor_bias(bias=(0.005, 0.05), onset=ONSET)),
    "sensor_drift": (5, hf.faults.sensor_drift(rate=(0.01, 0.05), onset=ONSET)),
}


@dataclass(frozen=True)
class Trial:
    """One task of one robot."""

    number: int
    law: hf.control.Law
    q0: np.ndarray
    target: np.ndarray
    body: hf.Body


def trials(arm: hf.Arm, *, seed: int) -> Iterator[Trial]:
    """Without end; half of them positions, half poses."""
    laws = [hf.control.damped(arm, DAMPING, task=task, gain=GAIN, speed_limit=SPEED) for task in ("position", "pose")]
    room = 0.1 * (arm.upper - arm.lower)
    k = 0
    while True:
        rng = np.random.default_rng([seed, k])
        q0 = rng.uniform(arm.lower + room, arm.upper - room)
        ends = np.clip(q0 + rng.uniform(-1.2, 1.2, (64, arm.n)), arm.lower + room, arm.upper - room)
        poses = arm.forward_kinematics(np.vstack([q0, ends]))
        away = np.linalg.norm(poses[1:, :3, 3] - poses[0, :3, 3], axis=1)
        good = np.flatnonzero((away >= AWAY[0]) & (away <= AWAY[1]))
        if good.size:
            pose = poses[1 + good[0]]
            law = laws[k % 2]
            target = pose if law.task.angular else pose[:3, 3]
            yield Trial(k, law, q0, target, hf.Body(seed=seed + k, coulomb=COULOMB, viscous=VISCOUS))
        k += 1
