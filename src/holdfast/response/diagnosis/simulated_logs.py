"""Recordings of a simulated arm with servos, noise, and masses and friction that deviate from its model, to test
the monitor.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.physics.body import Body
from holdfast.control.physics.drives import Drives
from holdfast.control.physics.servos import Servos
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.mjcf import import_mujoco, silence_mujoco
from holdfast.model.arm.model import Arm
from holdfast.response.faults.events import FaultEvent
from holdfast.response.faults.injector import FaultInjector
from holdfast.response.faults.log import Log

_CYCLE_S = 1e-3  # s
_MAX_AMPLITUDE = 0.6  # rad or m to either side of the middle, at most; and half of the room to the limits
_POSE_RATE_HZ = 100.0  # Hz
_ROBOTS_PER_BATCH = 10  # robots: more leave the processor's cache


@dataclass(frozen=True)
class ExternalForce:
    """External force on a link for a limited time, which is no joint's fault.

    Attributes:
        joint: Name of the joint that carries the link.
        force: N, world.
        onset: s.
        end: s.
        point: Where it acts, m, in the moving frame of the joint.
    """

    joint: str
    force: tuple[float, float, float]
    onset: float
    _: KW_ONLY
    end: float = np.inf
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)


@check_arguments
@silence_mujoco()
@reports_progress("simulating a record")
def simulate_log(
    arm: Arm,
    duration: float | None = None,
    *,
    motion: ArrayLike | None = None,
    faults: Sequence[FaultEvent] = (),
    external_forces: Sequence[ExternalForce] = (),
    seed: int = 0,
    robot: int | None = None,
    speed: float = 0.5,
    mismatch: float = 0.2,
    coulomb: float = 0.5,
    viscous: float = 0.3,
    pose: bool = True,
) -> Log:
    """Simulate a recording of an arm that swings each joint to and fro, with noise (needs ``holdfast-arms[physics]``).

    Servos of 10 Hz with the gravity torque of the arm's model follow sines about the middle of the range, or a motion. Each
    drive closes its velocity loop faster than the control cycle of 1 kHz; at random configurations of every built-in arm with
    inertial data the linearised cycle has no eigenvalue above 0.98 in magnitude. The body is not quite the arm's model: masses
    and friction are off by up to ``mismatch``. Faults begin and end as their events say.

    Args:
        arm: The arm, with inertial data.
        duration: s; None with a motion.
        motion: (T, n) references, rad and m, 1000 a second, from rest; None: sines.
        faults: Events in it; times are those of the record.
        external_forces: Forces from outside, likewise.
        seed: Of the motion and the noise.
        robot: Seed of the simulated robot. Use one value for all recordings of the same robot. Default: ``seed``.
        speed: Of the references, rad/s and m/s, at most.
        mismatch: Fraction by which masses and friction may be off.
        coulomb: Dry friction of every joint, N m and N.
        viscous: Viscous friction, N m s/rad and N s/m.
        pose: Whether the tool's pose is measured, 100 times a second.

    Returns:
        A record of 1000 samples a second. Everything in it is simulated.

    Raises:
        InputError: Not a finite time above 0, both or none of time and motion, an unknown joint, a fault that the model cannot
            have, or numbers that :class:`holdfast.Body` refuses.
        ArmError: Inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    if (duration is None) == (motion is None):
        raise InputError("give the duration or the motion of the record, one of them")
    rng = np.random.default_rng(seed)
    reference = _sine_references(arm, duration, speed, rng) if motion is None else arm.check_configurations(motion)
    robot_body = Body(seed if robot is None else robot, mismatch=mismatch, coulomb=coulomb, viscous=viscous)
    simulated_robot = _RecordedRobot(arm, reference, rng, robot_body, faults, external_forces)
    return _make_logs(arm, [simulated_robot], pose)[0]


@check_arguments
@silence_mujoco()
@reports_progress("simulating records")
def simulate_logs(
    arm: Arm,
    duration: float,
    *,
    seeds: Sequence[int],
    faults: Sequence[Sequence[FaultEvent]] | None = None,
    external_forces: Sequence[Sequence[ExternalForce]] | None = None,
    robots: Sequence[int] | None = None,
    speed: float = 0.5,
    mismatch: float = 0.2,
    coulomb: float = 0.5,
    viscous: float = 0.3,
    pose: bool = True,
) -> tuple[Log, ...]:
    """Simulate the recordings of :func:`holdfast.response.diagnosis.simulate_log` several at a time, in about half the time.

    Args:
        arm: The arm, with inertial data.
        duration: Of each, s.
        seeds: One for each record.
        faults: Events of each; None: healthy.
        external_forces: Forces from outside of each.
        robots: Seeds of the simulated robots, one for each recording. Default: ``seeds``.
        speed: Of the references, rad/s and m/s, at most.
        mismatch: Fraction by which masses and friction may be off.
        coulomb: Dry friction of every joint, N m and N.
        viscous: Viscous friction, N m s/rad and N s/m.
        pose: Whether the tools' poses are measured.

    Raises:
        InputError: As there, or not one of something for each record.
        ArmError: Inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    count = len(seeds)
    for name, values in (("faults", faults), ("external_forces", external_forces), ("robots", robots)):
        if values is not None and len(values) != count:
            raise InputError(f"{name} are of {len(values)} records and seeds of {count}; give one for each record")
    deviations = {"mismatch": mismatch, "coulomb": coulomb, "viscous": viscous}
    logs: list[Log] = []
    for first_index in range(0, count, _ROBOTS_PER_BATCH):
        simulated_robots = []
        for index in range(first_index, min(first_index + _ROBOTS_PER_BATCH, count)):
            rng = np.random.default_rng(seeds[index])
            events, forces = faults[index] if faults else (), external_forces[index] if external_forces else ()
            reference = _sine_references(arm, duration, speed, rng)
            simulated_robots.append(
                _RecordedRobot(arm, reference, rng, Body((robots or seeds)[index], **deviations), events, forces)
            )
        logs += _make_logs(arm, simulated_robots, pose)
    return tuple(logs)


class _RecordedRobot:
    """Simulated robot with its motion (T, n), its faults, and its external forces."""

    def __init__(
        self,
        arm: Arm,
        reference: FloatArray,
        rng: np.random.Generator,
        body: Body,
        faults: Sequence[FaultEvent],
        pushes: Sequence[ExternalForce],
    ) -> None:
        self._mujoco, self.reference, self.rng, self.has_events = import_mujoco(), reference, rng, bool(faults or pushes)
        self.body = body
        self.model, self.stiffness, self.damping = body.model(arm, Servos(rate=1 / _CYCLE_S))
        self.data = self._mujoco.MjData(self.model)
        self.data.qpos[:] = reference[0]
        self._mujoco.mj_forward(self.model, self.data)
        self.injector = FaultInjector(self.model, self.data, arm, faults=faults)
        self._external_forces = [
            (1 + arm.joint_index(external_force.joint), external_force) for external_force in pushes
        ]  # body 0 is the world

    def apply_forces(self, time: float) -> None:
        """Apply the external forces that act at a time in s."""
        data = self.data
        data.qfrc_applied[:] = 0.0
        for link, external_force in self._external_forces:
            if external_force.onset <= time < external_force.end:
                application_point = data.xpos[link] + data.xmat[link].reshape(3, 3) @ external_force.point
                self._mujoco.mj_applyFT(
                    self.model, data, np.array(external_force.force), np.zeros(3), application_point, link, data.qfrc_applied
                )


def _make_logs(arm: Arm, robots: Sequence[_RecordedRobot], pose: bool) -> list[Log]:
    """Return the recordings of robots whose motions have one length."""
    measured, true_positions, torque = _simulate_robots(arm, robots)
    times, logs = np.arange(len(true_positions), dtype=np.float64) * _CYCLE_S, []
    for robot_index, robot in enumerate(robots):
        tool_positions, quaternions = _measured_tool_poses(arm, true_positions[:, robot_index], robot) if pose else (None, None)
        measured_torque = torque[:, robot_index] + robot.rng.normal(0, robot.body.torque, (len(times), arm.n))
        logs.append(
            Log(
                t=times,
                q_ref=robot.reference,
                q=measured[:, robot_index].copy(),
                tau=measured_torque,
                x=tool_positions,
                quat=quaternions,
            )
        )
    return logs


def _simulate_robots(arm: Arm, robots: Sequence[_RecordedRobot]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Run R robots in lockstep; return measured and true positions and torques (T, R, n)."""
    advance, cycle_count, joint_count = import_mujoco().mj_step, len(robots[0].reference), arm.n
    times = np.arange(cycle_count, dtype=np.float64) * _CYCLE_S
    reference = np.stack([robot.reference for robot in robots], axis=1)
    noise = np.stack([robot.rng.normal(0, robot.body.joint, (cycle_count, joint_count)) for robot in robots], axis=1)
    stiffness, damping = (np.array([getattr(robot, gain_name) for robot in robots]) for gain_name in ("stiffness", "damping"))
    drives = Drives(stiffness, damping, effort=np.array([joint.effort for joint in arm.joints]), period=_CYCLE_S)
    rates = np.diff(reference, axis=0, append=reference[-1:]) / _CYCLE_S
    rates[-1] = rates[max(-2, -cycle_count)]  # the motion goes on after the record
    measured, commands, true_positions = (
        np.empty_like(reference),
        np.empty_like(reference),
        np.empty((cycle_count + 1, len(robots), joint_count)),
    )
    gravity = arm._gravity_torque_kernel.single_row() if len(robots) == 1 else arm._gravity_torque_kernel.rows
    position_arrays, velocity_arrays = [robot.data.qpos for robot in robots], [robot.data.qvel for robot in robots]
    affected = [robot for robot in robots if robot.has_events]
    simulations = [(robot.model, robot.data, robot.data.ctrl) for robot in robots]
    for cycle in track("control cycles", range(cycle_count), every=1000):
        for robot in affected:
            robot.injector.before_step(times[cycle])
        positions_now, measured_now = true_positions[cycle], measured[cycle]
        np.concatenate(position_arrays, out=positions_now.reshape(-1))
        np.add(positions_now, noise[cycle], out=measured_now)
        for robot_index, robot in enumerate(robots if affected else ()):
            measured_now[robot_index] = (
                robot.injector.read_sensors(positions_now[robot_index], reference=reference[cycle, robot_index])
                + noise[cycle, robot_index]
            )
        drives.update_rate_error(measured_now, positions_now)
        torque = gravity(measured_now.reshape(-1) if len(robots) == 1 else measured_now)
        velocity = np.concatenate(velocity_arrays).reshape(measured_now.shape)
        commands[cycle] = drives.compute_motor_controls(
            reference[cycle], rates[cycle], measured_now, gravity=torque, velocity=velocity
        )
        for (model, state, control), command, robot in zip(simulations, commands[cycle], robots, strict=True):
            control[:] = command
            if robot.has_events:
                robot.injector.before_step(times[cycle])
                robot.apply_forces(times[cycle])
            advance(model, state)
    np.concatenate(position_arrays, out=true_positions[cycle_count].reshape(-1))
    return measured, true_positions[:-1], drives.compute_mean_torque(commands, np.diff(true_positions, axis=0))


def _sine_references(arm: Arm, duration: float | None, speed: float, rng: np.random.Generator) -> FloatArray:
    """Return sines about the middle of each range, from rest: their phase accelerates within half a second."""
    if duration is None or not 0 < duration < np.inf:
        raise InputError(f"duration is {duration}; it must be a finite number of seconds above 0")
    lower, upper = (
        np.where(np.isfinite(limits), limits, sign * np.pi) for limits, sign in ((arm.lower, -1.0), (arm.upper, 1.0))
    )
    amplitude = np.minimum(_MAX_AMPLITUDE, (upper - lower) / 4)
    angular_rates = speed / amplitude * rng.uniform(0.5, 1.0, arm.n)
    times = np.arange(int(np.ceil(duration / _CYCLE_S)), dtype=np.float64) * _CYCLE_S
    return np.asarray(
        (lower + upper) / 2 + amplitude * np.sin(np.where(times < 0.5, times**2, times - 0.25)[:, None] * angular_rates)
    )


def _measured_tool_poses(arm: Arm, q: FloatArray, robot: _RecordedRobot) -> tuple[FloatArray, FloatArray]:
    """Return tool poses with noise, NaN between samples."""
    from scipy.spatial.transform import Rotation

    sample_interval = round(1 / (_POSE_RATE_HZ * _CYCLE_S))
    poses = robot.body.measure_poses(arm.forward_kinematics(q[::sample_interval]), robot.rng)
    positions, quaternions = np.full((len(q), 3), np.nan), np.full((len(q), 4), np.nan)
    positions[::sample_interval], quaternions[::sample_interval] = (
        poses[:, :3, 3],
        Rotation.from_matrix(poses[:, :3, :3]).as_quat(),
    )
    return positions, quaternions
