"""A joint of a Panda locks while it carries a tray: recovered with nothing kept, and with the tray upright. In MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from tools.loops.fail_active import NOTICE, SHARE, TABLE
from tools.loops.film import Shot
from tools.loops.solid import box, rod
from tools.loops.stage import Side, Stage, seen_from

JOINT, WHEN, ACCELERATION = "panda_joint2", 0.35, 1.8
START = np.array([2.038, -1.76, -0.654, -1.52, -1.938, 0.694, 0.849])
END = np.array([1.477, 1.76, -2.448, -1.344, 2.087, 0.806, 2.299])
PLANNED, BORNE = 4, 5  # deg: the cone that is planned in, and what the tray bears; servos lag
TRAY = np.concatenate([box([0.34, 0.22, 0.012], [0, 0, 0.02]), *(rod(0.03, [x, 0, -0.065], 0.08) for x in (-0.12, 0.12))])


def shots() -> Iterator[Shot]:
    """From one end of the table to the other."""
    arm = hf.arms.load("panda")
    slowly = hf.Degraded(arm, speeds=dict.fromkeys(arm.joint_names, SHARE))
    cell, goal = hf.Cell([TABLE], margin=0.01), arm.forward_kinematics(END)
    asked = {"goal": goal, "cell": cell, "samples": 0, "accelerations": ACCELERATION}
    planned, borne = (hf.tool_constraints.upright(np.deg2rad(angle)) for angle in (PLANNED, BORNE))
    way = hf.recover(arm, slowly, START, keep=planned, **asked).require_ok().timed
    done = {"goal": goal, "cell": cell, "keep": borne}
    first = hf.execute(arm, way.q, way.time, locked=[JOINT], lock_time=WHEN * way.time[-1], notice=NOTICE, **done)
    lasts = []
    for keep in (None, planned):
        found = hf.recover(arm, first.degraded, first.q_final, keep=keep, **asked).require_ok().timed
        lasts.append(hf.execute(arm, found.q, found.time, locked=first.degraded, **done))
    lasts[1].require_ok()

    def tilt(run: hf.Execution, row: int) -> float:
        return float(np.rad2deg(borne.anchor(run.poses[0]).farthest(run.poses[: row + 1])[1]))

    def state(run: hf.Execution, row: int) -> str:
        most = max(tilt(run, row), 0.0 if run is first else tilt(first, -2))
        off = 1000 * np.linalg.norm(run.poses[row, :3, 3] - goal[:3, 3])
        return f"up to {most:.1f}° tilted, {off:.{0 if off > 10 else 1}f} mm to go"

    def said(t: float) -> str:
        return (
            f"A joint locks under a tray: is it still level when it is there?   {t:4.1f} s\n"
            "Panda, MuJoCo with joint servos, as fast as it is; the ring is the goal"
        )

    stage = Stage(seen_from(35, 20), (-0.80, 0.72, -0.14, 1.12), cell, JOINT, TRAY, goal[:3, 3], (0.98, 0.92))
    names = ("recovered, nothing kept", f"recovered, kept within {PLANNED}°")
    yield from stage.shots([Side([first, last], name, state) for name, last in zip(names, lasts, strict=True)], said)
