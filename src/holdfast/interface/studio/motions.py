"""Motions for playback, from files, closed-loop simulations, and physics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.state import State
from holdfast.kinematics.paths.joint_table import joint_columns, read_joint_table
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.model import Arm

TIME_COLUMNS = ("time_s", "time_cycles", "travel_rad")
MOTION_SAMPLES = 240
FALL_S = 3.0  # s: simulated duration of a fall
SHOWN_TIME_CONSTANTS = 15.0  # duration of a shown motion, in time constants 1/Ke of the law


@dataclass(frozen=True)
class PlayedMotion:
    """Configurations over time.

    Attributes:
        label: Caption of the motion.
        time: (T,) increasing times, in ``unit``.
        unit: Unit of the time: s, cycles, or rad of joint travel.
        q: (T, n) configurations, rad and m.
    """

    label: str
    time: FloatArray
    unit: str
    q: FloatArray

    def to_plain(self) -> dict[str, Any]:
        """Return the motion as plain data for JSON."""
        return {"label": self.label, "unit": self.unit, "time": self.time.tolist(), "q": self.q.tolist()}


def read_motion(arm: Arm, path: str | Path) -> PlayedMotion:
    """Read the motion from a CSV file of ``holdfast follow``, ``simulate`` or ``recover``, or from their output folder.

    Raises:
        InputError: There is no such file, or a column or number is missing or wrong; the message names it.
    """
    file = Path(path)
    if file.is_dir():
        names = ("trajectory.csv", "run.csv", "waypoints.csv", "motion.csv")
        motion_files = [file / name for name in names if (file / name).is_file()]
        if not motion_files:
            raise InputError(
                f"folder '{file}' contains no motion; give one that follow, simulate, recover or plan-motion wrote with --out"
            )
        file = motion_files[0]
    table = read_joint_table(arm, file, "motion", TIME_COLUMNS[0])
    time_column = next((name for name in TIME_COLUMNS if name in table.header), None)
    if time_column is None:
        raise InputError(f"{table.title}: a column '{TIME_COLUMNS[0]}' is missing; it must contain the time of each row")
    samples = table.select_columns([time_column, *joint_columns(arm)])
    if (np.diff(samples[:, 0]) < 0).any():
        raise InputError(f"{table.title}: time must not run backwards; sort the lines by '{time_column}'")
    return PlayedMotion(file.name, samples[:, 0], time_column.rpartition("_")[2], samples[:, 1:])


def simulate_law_motions(machine: CompiledArm, state: State, progress: Callable[[int, int], None]) -> list[PlayedMotion]:
    """Simulate the motion to a target under each of the two laws, with failed joints locked from the start.

    The label of each motion describes its end.

    Args:
        machine: Compiled arm with its laws.
        state: State with the failed joints, the configuration, the target, and the laws.
        progress: Function that is called with (done, total) parts, and raises an exception to cancel.

    Raises:
        InputError: A law is unknown, or there is no target.
    """
    from holdfast.control.simulation.closed_loop import simulate
    from holdfast.control.simulation.errors import error_history
    from holdfast.interface.presentation.simulation.errors import format_errors
    from holdfast.model.arm.poses import pose_from_quaternion

    if state.target is None:
        raise InputError("there is no target; choose one first")
    target = pose_from_quaternion(state.target[:3], state.target[3:])
    motions = []
    for law_number, law_label in enumerate(state.laws):
        progress(2 * law_number, 4)
        law = machine.get_law(law_label)
        runs = simulate(law, np.array(state.q), target, locked=list(state.failed_joints))
        progress(2 * law_number + 1, 4)
        # The final approach takes most of the time and shows hardly any motion.
        sampled_path = runs.path(samples=MOTION_SAMPLES, until=min(float(runs.time), SHOWN_TIME_CONSTANTS / law.gain) or None)
        history = error_history(runs)
        error_note = f"error {format_errors(law, history.end.position, history.end.angle)}"
        exceeded_joints = [name for name, is_exceeded in zip(state.names, runs.limits_passed, strict=True) if is_exceeded]
        limits_note = f", beyond the limits of {' and '.join(exceeded_joints)}" if exceeded_joints else ""
        motions.append(
            PlayedMotion(
                f"{law_label}: {runs.ending_sentence()}{limits_note} ({error_note})", sampled_path.time, "s", sampled_path.q
            )
        )
    return motions


def simulate_fall_motion(arm: Arm, state: State) -> PlayedMotion:
    """Simulate the fall after a power loss of the free joints, or of all joints that are not locked.

    Raises:
        InputError: All joints are locked, or the configuration is outside the limits.
        ArmError: The arm's bodies are not known.
    """
    from holdfast.control.falls.power_cut import power_loss

    if not state.powerless:
        raise InputError("all joints are locked, so the arm cannot fall; make one healthy or free")
    friction = Friction(coulomb=state.friction)
    fall = power_loss(arm, np.array(state.q), free=state.powerless, friction=friction, duration=FALL_S)
    time = np.linspace(0.0, FALL_S, 4 * MOTION_SAMPLES + 1)
    return PlayedMotion(f"power loss: {' '.join(fall.describe())}", time, "s", fall.q_at(time))
