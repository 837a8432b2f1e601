"""How faults hold in environments of others, at random full actions: a line for each environment and kind."""

from __future__ import annotations

import argparse
import logging
from collections.abc import Callable, Sequence
from datetime import datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.response.faults import FaultEvent, FaultWrapper

HERE = Path(__file__).parent
ONSET = 0.1  # s
STEPS, LATER = 200, 100  # after the onset; "later" counts from there
KINDS: dict[str, Callable[[str], FaultEvent]] = {
    "locked": lambda joint: FaultEvent("locked", joint, ONSET),
    "limp": lambda joint: FaultEvent("limp", joint, ONSET),
    "weak": lambda joint: FaultEvent("weak", joint, ONSET, parameters={"gain": 0.3}),
}
PACKAGES = ("holdfast", "numpy", "mujoco", "gymnasium", "gymnasium-robotics", "robosuite")
HEAD = ["environment", "joints", "kind", "largest deviation, mrad", "after 100 steps, mrad", "largest torque, N m", "restored"]


def made(name: str) -> Any:
    """An environment of Gymnasium or Gymnasium-Robotics, or ``robosuite:Lift``."""
    import gymnasium

    family, _, task = name.rpartition(":")
    if family == "robosuite":
        import robosuite
        from robosuite.wrappers import GymWrapper

        plain = {"has_renderer": False, "has_offscreen_renderer": False, "use_camera_obs": False, "hard_reset": False}
        return GymWrapper(robosuite.make(task, robots="Panda", horizon=10_000, **plain))
    try:
        import gymnasium_robotics

        gymnasium.register_envs(gymnasium_robotics)
    except ImportError:
        pass  # its environments are then unknown
    return gymnasium.make(name, max_episode_steps=10_000)


def driven(env: Any) -> list[str]:
    """Joints that have an actuator of their own, by a wrapper without faults."""
    injector = FaultWrapper(env, []).injector
    return [joint for joint in injector.joints if injector.actuators_of(joint).size]


def rows(name: str) -> list[list[str]]:
    """A line for each kind: the worst of up to eight joints."""
    env, found = made(name), []
    joints = driven(env)[:8]
    for kind, event_of in KINDS.items():
        largest = later = torque = 0.0
        whole = True
        for joint in joints:
            event = event_of(joint)
            wrapped = FaultWrapper(env, [event], joints=joints, observes={joint: ()})
            wrapped.reset(seed=1)
            injector = wrapped.injector
            model, data = injector.model, injector.data
            before = fields(model)
            place, dof, rng = model.joint(joint).qposadr[0], injector.dofs[joints.index(joint)], np.random.default_rng(0)
            told: list[float] = []
            while len(told) < STEPS:
                wrapped.step(rng.uniform(env.action_space.low, env.action_space.high).astype(env.action_space.dtype))
                if wrapped.fault["active"]:
                    told.append(data.qpos[place])
                    torque = max(torque, abs(float(data.qfrc_actuator[dof])))
            if kind == "locked":
                moved = np.abs(np.array(told) - injector.places[event])
                largest, later = max(largest, moved.max()), max(later, moved[LATER])
            injector.restore()
            whole &= fields(model) == before
        shown = [f"{1e3 * largest:.2g}", f"{1e3 * later:.2g}"] if kind == "locked" else ["-", "-"]
        found.append([name, str(len(joints)), kind, *shown, f"{torque:.3g}", "yes" if whole else "**no**"])
    env.close()
    return found


def fields(model: Any) -> dict[str, bytes]:
    """Every number of the model that could be touched."""
    names = [name for name in dir(model) if name.startswith(("jnt_", "dof_", "actuator_"))]
    return {name: np.array(getattr(model, name)).tobytes() for name in names}


def versions() -> str:
    """Of the packages that are there."""
    told = []
    for name in PACKAGES:
        try:
            told.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            continue
    return ", ".join(told)


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the lines, and add them to ENVIRONMENTS.md under their versions."""
    parser = argparse.ArgumentParser(prog="python -m measurements.faults.environments", description=__doc__)
    parser.add_argument("names", nargs="+", help="as Pusher-v5, AdroitHandDoor-v1, robosuite:Lift")
    names = parser.parse_args(arguments).names
    logging.disable(logging.CRITICAL)
    lines = [f"{datetime.now():%Y-%m-%d}, {versions()}:", "", f"| {' | '.join(HEAD)} |", "|" + "---|" * len(HEAD)]
    for name in names:
        lines += [f"| {' | '.join(cells)} |" for cells in rows(name)]
        print(lines[-len(KINDS) :])
    file = HERE / "ENVIRONMENTS.md"
    known = file.read_text(encoding="utf-8") if file.exists() else "# Faults in environments\n\n" + ABOUT
    file.write_text(known + "\n" + "\n".join(lines) + "\n", encoding="utf-8")


ABOUT = f"""Written by `python -m measurements.faults.environments NAMES`, which adds a table. Everything is **simulated**. A
joint fails after 0.1 s, and {STEPS} steps with random actions over their whole range follow. Each row is the worst of up to
eight joints. It contains the largest deviation from the locked value, the largest torque of the motors, and whether every
number of the model is restored afterwards. Robosuite requires an older MuJoCo, so it ran in a separate installation. Kitchen of
Gymnasium-Robotics 1.4.2 does not run on MuJoCo 4. The joints of its Fetch have no motors, because the hand is dragged to the
commanded position.
"""

if __name__ == "__main__":
    main()
