"""The base of a Panda locks while it carries a part round a rack: as it goes on, and as the task is finished. In MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from holdfast.model.cell import Box
from tools.loops.film import Shot
from tools.loops.solid import box
from tools.loops.stage import Side, Stage, seen_from

JOINT, WHEN, NOTICE = "panda_joint1", 0.45, 0.02  # WHEN: share of the motion; NOTICE: s
PICK, PLACE = [0.45, -0.42, 0.14], [0.5, 0.38, 0.14]  # m
START = np.array([-0.8, 0.2, 0, -2.1, 0, 2.3, 0.785])
SHARE, ACCELERATION = 0.4, 1.2  # of the speed limits, and rad/s^2, at which the arm works
TABLE = Box("table", [0.7, 1.3, 0.04], pose=[0.6, 0, -0.021])
RACK = Box("rack", [0.34, 0.05, 0.34], pose=[0.5, -0.05, 0.17])


def down(place: list[float]) -> np.ndarray:
    """The tool at a place, straight down."""
    pose = np.diag([1.0, -1.0, -1.0, 1.0])
    pose[:3, 3] = place
    return pose


def shots() -> Iterator[Shot]:
    """From the part picked up to the part in its place."""
    arm = hf.arms.load("panda")
    slowly = hf.Degraded(arm, speeds=dict.fromkeys(arm.joint_names, SHARE))
    cell = hf.Cell([TABLE, RACK], margin=0.015)
    goal, asked = down(PLACE), {"cell": cell, "samples": 0}
    picked = hf.recover(arm, slowly, START, goal=down(PICK), **asked).require_ok().q[-1]
    way = hf.recover(arm, slowly, picked, goal=goal, accelerations=ACCELERATION, **asked).require_ok().timed
    lock = {"locked": [JOINT], "lock_time": WHEN * way.time[-1], "goal": goal, "cell": cell}
    gone = hf.execute(arm, way.q, way.time, **lock)
    first = hf.execute(arm, way.q, way.time, notice=NOTICE, **lock)
    answer = hf.recover(arm, first.degraded, first.q_final, goal=goal, accelerations=ACCELERATION, **asked).require_ok()
    last = hf.execute(arm, answer.timed.q, answer.timed.time, locked=answer.degraded, goal=goal, cell=cell).require_ok()

    def state(run: hf.Execution, row: int) -> str:
        hits = [c for c in run.contacts or () if c.time <= run.time[row]]
        off = 1000 * np.linalg.norm(run.poses[row, :3, 3] - goal[:3, 3])
        return (f"hits the {hits[0].object}, " if hits else "") + f"{off:.{0 if off > 10 else 1}f} mm to go"

    known = f"noticed after {1000 * NOTICE:.0f} ms, recovered"

    def said(t: float) -> str:
        return (
            f"The base joint locks on the way: can the task be finished?   {t:4.1f} s\n"
            "Panda, MuJoCo with joint servos, as fast as it is; the ring is the goal"
        )

    stage = Stage(seen_from(25, 28), (-0.71, 0.59, -0.31, 0.66), cell, JOINT, box([0.05] * 3, [0, 0, 0.02]), goal[:3, 3])
    yield from stage.shots([Side([gone], "the controller does not know", state), Side([first, last], known, state)], said)
