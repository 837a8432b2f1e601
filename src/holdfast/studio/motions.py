"""Motions that are played: from files, from the closed loop, from the physics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError
from holdfast.paths.joint_table import joint_columns, read_joint_table
from holdfast.studio.scene.machine import Machine
from holdfast.studio.state import State

Array = NDArray[np.float64]
TIMES = ("time_s", "time_cycles", "travel_rad")
SAMPLES = 240
WORTH_SEEING = 15.0  # 1/Ke


@dataclass(frozen=True)
class Motion:
    """Configurations over time.

    Attributes:
        label: What it is, for people.
        time: (T,) increasing.
        unit: Of the time: s, cycles, or rad of joint travel.
        q: (T, n) rad and m.
    """

    label: str
    time: Array
    unit: str
    q: Array

    def at(self, time: float) -> Array:
        """The configuration (n,) at a time, in between linear; the first or last one outside."""
        k = int(np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, max(len(self.time) - 2, 0)))
        if len(self.time) == 1 or self.time[k + 1] <= self.time[k]:
            return np.array(self.q[k])
        share = float(np.clip((time - self.time[k]) / (self.time[k + 1] - self.time[k]), 0.0, 1.0))
        return np.asarray((1 - share) * self.q[k] + share * self.q[k + 1])


def read_motion(arm: Arm, path: str | Path) -> Motion:
    """The motion in a CSV file of ``holdfast follow``, ``simulate`` or ``recover``, or in the folder that one of them wrote.

    Raises:
        InputError: There is no such file, or a column or number is missing or wrong; the message names it.
    """
    file = Path(path)
    if file.is_dir():
        names = ("trajectory.csv", "run.csv", "waypoints.csv", "motion.csv")
        inside = [file / name for name in names if (file / name).is_file()]
        if not inside:
            raise InputError(
                f"folder '{file}' holds no motion; give one that follow, simulate, recover or endure wrote with --out"
            )
        file = inside[0]
    table = read_joint_table(arm, file, "motion", TIMES[0])
    time = next((name for name in TIMES if name in table.head), None)
    if time is None:
        raise InputError(f"{table.title}: a column '{TIMES[0]}' is missing; it says when the arm is there")
    rows = table.numbers([time, *joint_columns(arm)])
    if (np.diff(rows[:, 0]) < 0).any():
        raise InputError(f"{table.title}: time must not run backwards; sort the lines by '{time}'")
    return Motion(file.name, rows[:, 0], time.rpartition("_")[2], rows[:, 1:])


def law_motions(machine: Machine, state: State, progress: Callable[[int, int], None]) -> list[Motion]:
    """The motion to a target under each of the two laws, failed joints locked from the start, with how it ended.

    Args:
        machine: The arm and its laws.
        state: What has failed, where the arm is, where the end effector should go, and which laws.
        progress: Told of (done, in all) between the parts; raises to give up.

    Raises:
        InputError: A law that is not known, or no target.
    """
    from holdfast.arm.poses import pose_of
    from holdfast.present.simulation.errors import error_text
    from holdfast.simulation.closed_loop import simulate
    from holdfast.simulation.errors import error_history

    if state.target is None:
        raise InputError("there is no target; choose one first")
    target = pose_of(state.target[:3], state.target[3:])
    motions = []
    for k, text in enumerate(state.laws):
        progress(2 * k, 4)
        law = machine.law(text)
        runs = simulate(law, np.array(state.q), target, locked=list(state.failed))
        progress(2 * k + 1, 4)
        # The last approach to rest takes most of the time and moves nothing.
        path = runs.path(samples=SAMPLES, until=min(float(runs.time), WORTH_SEEING / law.gain) or None)
        history = error_history(runs)
        off = f"error {error_text(law, history.end.position, history.end.angle)}"
        past = [name for name, passed in zip(state.names, runs.limits_passed, strict=True) if passed]
        limits = f", past the limits of {' and '.join(past)}" if past else ""
        motions.append(Motion(f"{text}: {runs.ending_sentence()}{limits} ({off})", path.time, "s", path.q))
    return motions


def swing_motion(arm: Arm, state: State) -> Motion:
    """The free swing of the first joint that is set free, from the physics, the others held.

    Raises:
        InputError: No joint is free.
        HoldfastError: MuJoCo is not installed, or the arm's bodies are not known.
    """
    from holdfast.physics.swing import free_swing

    if not state.free:
        raise InputError("no joint is free; set one free first")
    k = state.free[0]
    found = free_swing(arm, np.array(state.q), k)
    q = np.tile(np.array(state.q), (len(found.time), 1))
    q[:, k] += found.angle
    every = max(1, len(q) // (8 * SAMPLES))
    factor, unit = arm.joints[k].shown
    rest = f", rests {factor * found.rest_angle:.3g} {unit} away" if found.settled else ""
    drops = "".join(
        f"; braked after {d.after_ms:g} ms it has moved {factor * d.angle:.3g} {unit}, the tool {1000 * d.distance:.3g} mm"
        for d in found.drops
    )
    label = f"{arm.joint_names[k]} swings: farthest {factor * found.peak:.3g} {unit}{rest}{drops}"
    return Motion(label, found.time[::every], "s", q[::every])
