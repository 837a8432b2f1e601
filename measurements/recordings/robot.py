"""Simulated arm like the SO-101: five position servos with friction and play, recorded at 30 frames per second.

Servos: 17.8 N m/rad, 2.9 N m, no integral part; friction 0.04 to 0.11 N m; damping 0.6 N m s/rad; play 0.6 to 1.5 deg between
servo and link; positions in ticks of 0.088 deg. Each robot differs in masses, stiffness, friction, play, and in the zero of the
leader. Each episode has a payload of 0 to 150 g, and one in four has a push of 1 to 5 N. These numbers are section 2.4 of the
specification; lengths and masses are estimates.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

import holdfast as hf
from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis import RecordedEpisode

JOINTS = ("shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll")
FAULTS = (
    "locked",
    "limp",
    "weak",
    "stale joint",
    "stale",
    "dropped",
    "spike",
    "offset",
    "drift",
    "slip",
    "friction",
    "play",
)
WITHOUT_JOINT = ("stale", "dropped")
FPS = 30.0
LENGTH_S = 15.0
TICK_DEG = 360 / 4096
_AXES = ("0 0 1", "0 1 0", "0 1 0", "0 1 0", "1 0 0")
_ORIGINS = ("0 0 0.05", "0.03 0 0.05", "0 0 0.116", "0.135 0 0", "0.06 0 0")
_ENDS = ("0.03 0 0.05", "0 0 0.116", "0.135 0 0", "0.06 0 0", "0.10 0 0")
_MASSES = (0.15, 0.15, 0.13, 0.10, 0.14)
_STEP_S = 0.004
_AMPLITUDES_DEG = np.array([55.0, 45.0, 50.0, 50.0, 60.0])


def write_model(masses: FloatArray | None = None, play: bool = False) -> str:
    """Return the MJCF text of the arm; with ``play``, each servo has a second joint behind it."""
    opening, closing = "", ""
    for index, (name, mass) in enumerate(zip(JOINTS, _MASSES if masses is None else masses, strict=True)):
        opening += f'<body name="{name}_link" pos="{_ORIGINS[index]}"><joint name="{name}" axis="{_AXES[index]}" damping="0.6" '
        opening += 'limited="true" range="-1.75 1.75"/>'
        if play:  # between the servo and the link
            opening += '<inertial pos="0 0 0" mass="0.002" diaginertia="1e-6 1e-6 1e-6"/>'
            opening += (
                f'<body name="{name}_play"><joint name="{name}_play" axis="{_AXES[index]}" damping="0.02" limited="true" '
            )
            opening += 'range="-0.01 0.01" solreflimit="0.01 1"/>'
            closing += "</body>"
        opening += f'<geom type="capsule" fromto="0 0 0 {_ENDS[index]}" size="0.02" mass="{mass}" contype="0" conaffinity="0"/>'
        closing += "</body>"
    motors = "".join(
        f'<position name="{name}" joint="{name}" kp="17.8" kv="0" forcerange="-2.9 2.9"/>' for name in JOINTS if play
    )
    return (
        f'<mujoco model="small"><compiler angle="radian" autolimits="true"/><option timestep="{_STEP_S}" '
        f'integrator="implicitfast"/><default><joint armature="0.028"/></default><worldbody>{opening}{closing}</worldbody>'
        f"<actuator>{motors}</actuator></mujoco>"
    )


def load_arm(folder: Path) -> hf.Arm:
    """Return the nominal arm, without play, from a file in a folder."""
    file = folder / "small.xml"
    file.write_text(write_model())
    return hf.Arm.from_mjcf(file)


@dataclass
class Fault:
    """Fault of one episode."""

    kind: str
    joint: int
    onset: float  # s, as the frames count it: late frames do not show in the times of a recording
    size: float
    duration: float = np.inf  # s


def draw_fault(kind: str, rng: np.random.Generator) -> Fault:
    """Draw the joint, onset (4 to 9 s), and size of a fault."""
    sizes = {
        "weak": (0.15, 0.4),  # of the torque
        "stale joint": (0.8, 3.0),  # s
        "stale": (0.3, 1.2),
        "dropped": (0.3, 1.2),
        "spike": (8.0, 40.0),  # deg
        "offset": (3.0, 15.0),
        "drift": (2.0, 6.0),
        "slip": (5.0, 20.0),
        "friction": (5.0, 10.0),  # times the friction of the robot
        "play": (3.0, 6.0),  # deg
    }
    size = float(rng.uniform(*sizes.get(kind, (1.0, 1.0))))
    if kind in ("spike", "offset", "drift", "slip"):
        size *= float(rng.choice([-1, 1]))
    onset = 0.0 if kind == "drift" else float(rng.uniform(4.0, 9.0))
    duration = abs(size) if kind in ("stale joint", "stale", "dropped") else np.inf
    return Fault(kind, int(rng.integers(5)), onset, size, duration)


class Robot:
    """One robot of the kind, with its own masses, stiffness, friction, play, and zero of the leader.

    Args:
        seed: Seed of the robot.
    """

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng([seed, 0])
        self._model: Any = mujoco.MjModel.from_xml_string(write_model(np.array(_MASSES) * rng.uniform(0.8, 1.2, 5), play=True))
        self._data: Any = mujoco.MjData(self._model)
        self._friction = rng.uniform(0.04, 0.11, 5)
        self._damping = 0.6 * rng.uniform(0.8, 1.2, 5)
        self._stiffness = 17.8 * rng.uniform(0.9, 1.1, 5)
        self._play = np.radians(rng.uniform(0.6, 1.5, 5))
        self._zero = rng.normal(0, 0.6, 5)  # deg
        self._tip = self._model.body(f"{JOINTS[-1]}_play").id
        self._mass = float(self._model.body_mass[self._tip])

    def record(self, index: int, seed: int, fault: Fault | None = None, fps: float = FPS) -> RecordedEpisode:
        """Simulate and record one episode, in deg.

        Args:
            index: Number of the episode in its recording.
            seed: Seed of the motion and of the disturbances.
            fault: Fault of the episode. None: healthy.
            fps: Frames per second.
        """
        rng = np.random.default_rng([seed, 1])
        model, data = self._model, self._data
        self._reset(rng)
        leader = _draw_motion(rng)
        frame_count = int(LENGTH_S * fps)
        steps = 1 / fps * np.ones(frame_count) + rng.normal(0, 0.002, frame_count)
        steps += (rng.random(frame_count) < 0.003) * rng.uniform(0.02, 0.13, frame_count)
        push = _draw_push(rng)
        data.qpos[0::2] = np.radians(leader(0.0)) + np.radians(self._zero)
        data.ctrl[:] = data.qpos[0::2]
        mujoco.mj_step(model, data, int(0.5 / _STEP_S))
        start, time, is_faulty = float(data.time), 0.0, False
        rows: list[tuple[FloatArray, ...]] = []
        for step in steps:
            if fault is not None and not is_faulty and len(rows) >= fault.onset * fps:
                is_faulty = True
                self._insert(fault)
                if fault.kind == "slip":
                    data.qpos[2 * fault.joint] += np.radians(fault.size)
            measured = np.degrees(data.qpos[0::2] + data.qpos[1::2])
            wanted = leader(time)
            ticks = [np.round(values / TICK_DEG) * TICK_DEG for values in (measured, wanted)]
            rows.append((*ticks, data.actuator_force.copy()))
            data.ctrl[:] = np.radians(wanted + self._zero)
            data.xfrc_applied[self._tip, :3] = push[2] if push[0] <= time < push[1] else 0.0
            mujoco.mj_step(model, data, max(1, round((time + max(step, _STEP_S) - (data.time - start)) / _STEP_S)))
            time = float(data.time) - start
        q, reference, torque = (np.array(part) for part in zip(*rows, strict=True))
        if fault is not None:
            q, reference, torque = _corrupt(fault, fps, [q, reference, torque], rng)
        return RecordedEpisode(index=index, t=np.arange(len(q)) / fps, q=q, q_ref=reference, tau=torque, clock="computed")

    def _reset(self, rng: np.random.Generator) -> None:
        model = self._model
        mujoco.mj_resetData(model, self._data)
        model.dof_frictionloss[0::2], model.dof_frictionloss[1::2] = self._friction, 0.0
        model.dof_damping[0::2] = self._damping
        model.actuator_gainprm[:, 0], model.actuator_biasprm[:, 1] = self._stiffness, -self._stiffness
        model.actuator_forcerange[:] = np.array([-2.9, 2.9])
        model.jnt_range[1::2] = np.stack([-self._play / 2, self._play / 2], axis=1)
        model.body_mass[self._tip] = self._mass + rng.uniform(0, 0.15)  # payload
        mujoco.mj_setConst(model, self._data)

    def _insert(self, fault: Fault) -> None:
        """Change the model at the onset of a fault of the body."""
        model, joint = self._model, fault.joint
        if fault.kind == "locked":
            model.dof_frictionloss[2 * joint] = 100.0
            model.actuator_gainprm[joint], model.actuator_biasprm[joint] = 0.0, 0.0
        elif fault.kind == "limp":
            model.actuator_gainprm[joint], model.actuator_biasprm[joint] = 0.0, 0.0
        elif fault.kind == "weak":
            model.actuator_forcerange[joint] *= fault.size
            model.actuator_gainprm[joint] *= 0.5
            model.actuator_biasprm[joint] *= 0.5
        elif fault.kind == "friction":
            model.dof_frictionloss[2 * joint] *= fault.size
        elif fault.kind == "play":
            model.jnt_range[2 * joint + 1] = np.radians([-fault.size / 2, fault.size / 2])


def _draw_motion(rng: np.random.Generator) -> Any:
    """Return a function of time (s) to leader positions (deg): minimum-jerk moves with rests."""
    knots, points, time = [0.0], [rng.uniform(-0.5, 0.5, 5) * _AMPLITUDES_DEG], 0.0
    while time < LENGTH_S + 5:
        rest, move = rng.uniform(0.1, 1.2), rng.uniform(0.8, 2.2)
        moves = rng.random(5) < 0.75
        point = np.where(moves, rng.uniform(-1, 1, 5) * _AMPLITUDES_DEG, points[-1])
        knots += [time + rest, time + rest + move]
        points += [points[-1], point]
        time = knots[-1]
    starts, values = np.array(knots), np.array(points)

    def leader(now: float) -> FloatArray:
        k = int(np.searchsorted(starts, now, side="right")) - 1
        fraction = (now - starts[k]) / (starts[k + 1] - starts[k])
        blend = 10 * fraction**3 - 15 * fraction**4 + 6 * fraction**5
        return np.asarray(values[k] + blend * (values[k + 1] - values[k]))

    return leader


def _draw_push(rng: np.random.Generator) -> tuple[float, float, FloatArray]:
    """Return start and end (s) of a push, and its force (3,) in N; one episode in four has a push."""
    direction = rng.normal(size=3)
    force = rng.uniform(1, 5) * direction / np.linalg.norm(direction)
    start, length = rng.uniform(1, LENGTH_S - 1), rng.uniform(0.3, 1.0)
    return (start, start + length, force) if rng.random() < 0.25 else (np.inf, np.inf, force)


def _corrupt(fault: Fault, fps: float, signals: list[FloatArray], rng: np.random.Generator) -> list[FloatArray]:
    """Insert a fault of the sensors or of the recording program."""
    joint, first = fault.joint, int(np.ceil(fault.onset * fps))
    last, q = first + int(min(fault.duration, LENGTH_S) * fps), signals[0]
    if fault.kind == "stale joint":
        q[first:last, joint] = q[first - 1, joint]
    elif fault.kind == "stale":
        q[first:last] = q[first - 1]
    elif fault.kind == "dropped":
        return [np.delete(values, slice(first, last), axis=0) for values in signals]
    elif fault.kind == "spike":
        q[first : first + int(rng.integers(1, 4)), joint] += fault.size
    elif fault.kind in ("offset", "drift"):
        q[first:, joint] += fault.size
    return signals
