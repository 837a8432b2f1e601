"""The shoulder of a Panda loses its torque on the way: as it goes on, and as a monitor and the controller finish the task."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from holdfast.model.cell import Box
from holdfast.response.faults import FaultEvent
from tools.loops.film import Shot
from tools.loops.solid import box
from tools.loops.stage import Side, Stage, seen_from

JOINT, WHEN = "panda_joint2", 0.7  # s
START = np.array([-0.9, 0.1, 0, -2.0, 0, 2.1, 0.785])
GOAL = np.array([0.42, 0.42, 0.45])  # m
BODY = hf.Body(3)
PEDESTAL = Box("pedestal", [0.2, 0.2, 0.5], pose=[0, 0, -0.25])


def shots() -> Iterator[Shot]:
    """From the start to the target, or not."""
    arm = hf.arms.load("panda")
    law = hf.control.damped(arm, 0.02, task="position", gain=2.0, speed_limit=0.25)
    goals = GOAL + np.array([[0, 0, 0], [0.05, -0.2, 0.1], [0, -0.5, 0], [0.1, -0.8, 0.1]])
    healthy = [hf.simulate_faults(law, START, goal, body=BODY, seed=k).log() for k, goal in enumerate(goals)]
    friction = {"coulomb": [BODY.coulomb] * arm.n, "viscous": [BODY.viscous] * arm.n}
    monitor = hf.diagnosis.Monitor(arm, hf.diagnosis.calibrate(arm, healthy, **friction))
    asked = {"faults": [FaultEvent("limp", JOINT, WHEN)], "body": BODY, "seed": 9}
    gone = hf.simulate_faults(law, START, GOAL, time_limit=3.0, **asked)
    chain = hf.simulate_faults(law, START, GOAL, monitor=monitor, **asked).require_ok()

    def state(run: hf.FaultRun, row: int) -> str:
        off = f"{1000 * run.position_error[row]:.0f} mm to go"
        done = [a for a in run.actions if a.what in ("alarm", "brake") and a.time <= run.time[row]]
        return f"{done[-1].what} after {1000 * (done[-1].time - WHEN):.0f} ms, {off}" if done else off

    def said(t: float) -> str:
        return (
            f"The shoulder's motor gives no more torque: can the task be finished?   {t:4.1f} s\n"
            "Panda, MuJoCo, masses and friction up to 20 % off; the ring is the target"
        )

    cell = hf.Cell([PEDESTAL])
    stage = Stage(
        seen_from(25, 22),
        (-0.72, 0.68, -0.42, 0.98),
        cell,
        JOINT,
        box([0.05] * 3, [0, 0, 0.02]),
        GOAL,
        (0.98, 0.95),
        fault="without torque",
    )
    sides = [Side([gone], "nobody notices", state), Side([chain], "a monitor, and a reaction", state)]
    yield from stage.shots(sides, said, fails=WHEN)
