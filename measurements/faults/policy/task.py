"""The task and its faults: Gymnasium's Pusher-v5, when it is done, and what may fail during an episode."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from holdfast import faults

NAME = "Pusher-v5"
STEPS = 200  # of 0.05 s; twice the environment's own, see ABOUT of the table
NEAR = 0.05  # m
LIMIT = 2.0  # N m
ONSET = (0.3, 3.0)  # s
JOINTS = (
    "r_shoulder_pan_joint",
    "r_shoulder_lift_joint",
    "r_upper_arm_roll_joint",
    "r_elbow_flex_joint",
    "r_forearm_roll_joint",
    "r_wrist_flex_joint",
    "r_wrist_roll_joint",
)


def kinds() -> dict[str, faults.Fault]:
    """Each kind of fault, on any joint of the arm."""
    when: Any = {"onset": ONSET}
    return {
        "locked": faults.locked(JOINTS, **when),
        "limp": faults.limp(JOINTS, **when),
        "weak": faults.weak(JOINTS, gain=(0.2, 0.7), **when),
        "friction": faults.friction(JOINTS, coulomb=(0.3, 1.5), **when),
        "reduced_range": faults.reduced_range(JOINTS, travel=(0.02, 0.3), **when),
        "reduced_speed": faults.reduced_speed(JOINTS, velocity=(0.2, 0.6), **when),
        "sensor_bias": faults.sensor_bias(JOINTS, bias=(0.05, 0.5), **when),
        "sensor_drift": faults.sensor_drift(JOINTS, rate=(0.05, 0.5), **when),
        "sensor_freeze": faults.sensor_freeze(JOINTS, **when),
        "sensor_noise": faults.sensor_noise(JOINTS, deviation=(0.05, 0.5), **when),
        "command_dropout": faults.command_dropout(JOINTS, **when),
        "slipping_clutch": faults.slipping_clutch(JOINTS, **when),
    }


def environment(faulty: faults.Fault | None, seed: int) -> faults.FaultWrapper:
    """Where one kind of fault happens in each episode, or none."""
    import gymnasium

    env = gymnasium.make(NAME, max_episode_steps=STEPS + 1)
    return faults.FaultWrapper(env, faults.FaultModel([] if faulty is None else [faulty], seed), joints=JOINTS)


def off(env: Any) -> float:
    """How far the object is from the goal on the table, m: the goal lies 48 mm lower, so heights do not count."""
    data = env.unwrapped.data
    return float(np.linalg.norm((data.body("object").xpos - data.body("goal").xpos)[:2]))


def seen(env: Any, act: Callable[[Any], Any], *, seed: int, episode: int) -> tuple[np.ndarray, bool]:
    """What an episode shows, (T + 1, m), and whether it ends with the object at the goal."""
    observation, _ = env.reset(seed=seed, options={"episode": episode})
    rows = [observation]
    for _ in range(STEPS):
        rows.append(env.step(act(rows[-1]))[0])
    return np.array(rows), off(env) <= NEAR


def finished(env: Any, act: Callable[[Any], Any], *, seed: int, episode: int) -> bool:
    """Whether an episode ends with the object at the goal."""
    return seen(env, act, seed=seed, episode=episode)[1]
