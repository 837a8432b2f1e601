"""Logs of a simulated arm with servos, noise, and masses and friction that deviate from its model, to test the monitor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.physics.body import Body
from holdfast.control.physics.robot import SimulatedRobots, split_tool_poses
from holdfast.control.physics.servos import Servos
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.formats.mjcf import import_mujoco, silence_mujoco
from holdfast.model.arm.model import Arm
from holdfast.response.faults.events import FaultEvent
from holdfast.response.faults.injector import FaultInjector
from holdfast.response.faults.log import Log

_CYCLE_S = 1e-3  # control period, s
_MAX_AMPLITUDE = 0.6  # largest amplitude of a sine, rad or m; it uses at most half of the range to the limits
_POSE_RATE_HZ = 100.0  # Hz
_ROBOTS_PER_BATCH = 10  # more robots exceed the processor's cache


@dataclass(frozen=True)
class ExternalForce:
    """External force on a link for a limited time, which is not a fault of a joint.

    Attributes:
        joint: Name of the joint that carries the link.
        force: Force vector in the world frame, N.
        onset: Time at which the force begins, s.
        end: Time at which the force ends, s. Default: the end of the log.
        point: Point of application, m, in the moving frame of the joint.
    """

    joint: str
    force: tuple[float, float, float]
    onset: float
    _: KW_ONLY
    end: float = np.inf
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)


@check_arguments
@silence_mujoco()
@reports_progress("simulating a log")
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
    """Simulate a log of an arm whose joints swing, with measurement noise (needs ``holdfast-arms[physics]``).

    Servos of 10 Hz with the gravity torque of the arm's model follow sines about the middle of the range, or a given motion.
    Each drive closes its velocity loop faster than the control cycle of 1 kHz. At random configurations of every built-in arm
    with inertial data, the linearised cycle has no eigenvalue above 0.98 in magnitude. The simulated body differs from the
    arm's model: its masses and friction are off by up to ``mismatch``. Faults begin and end as their events state.

    Args:
        arm: Arm with inertial data.
        duration: Duration of the log, s. None if ``motion`` is given.
        motion: (T, n) references from rest, rad and m, 1000 per second. None: sines.
        faults: Fault events, with times in the log.
        external_forces: External forces, with times in the log.
        seed: Seed of the motion and of the noise.
        robot: Seed of the simulated robot. Use one value for all logs of the same robot. Default: ``seed``.
        speed: Largest rate of the references, rad/s and m/s.
        mismatch: Largest relative error of the model's masses and friction.
        coulomb: Dry friction of every joint, N m and N.
        viscous: Viscous friction of every joint, N m s/rad and N s/m.
        pose: Record the tool pose, 100 times a second.

    Returns:
        A simulated log with 1000 samples per second.

    Raises:
        InputError: The duration is not finite and above 0, both or none of ``duration`` and ``motion`` are given, a joint is
            unknown, the model cannot represent a fault, or :class:`holdfast.Body` rejects a number.
        ArmError: Inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    if (duration is None) == (motion is None):
        raise InputError("give either the duration or the motion of the log")
    rng = np.random.default_rng(seed)
    reference = _sine_references(arm, duration, speed, rng) if motion is None else arm.check_configurations(motion)
    body = Body(seed if robot is None else robot, mismatch=mismatch, coulomb=coulomb, viscous=viscous)
    return _make_logs(arm, [_Recording(reference, rng, body, faults, external_forces)], pose)[0]


@check_arguments
@silence_mujoco()
@reports_progress("simulating logs")
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
    """Simulate several logs as :func:`holdfast.response.diagnosis.simulate_log` does, together and in about half the time.

    Args:
        arm: Arm with inertial data.
        duration: Duration of each log, s.
        seeds: Seeds of motion and noise, one for each log.
        faults: Fault events of each log. None: healthy.
        external_forces: External forces of each log. None: no forces.
        robots: Seeds of the simulated robots, one for each log. Default: ``seeds``.
        speed: Largest rate of the references, rad/s and m/s.
        mismatch: Largest relative error of the model's masses and friction.
        coulomb: Dry friction of every joint, N m and N.
        viscous: Viscous friction of every joint, N m s/rad and N s/m.
        pose: Record the tool poses, 100 times a second.

    Raises:
        InputError: As for :func:`holdfast.response.diagnosis.simulate_log`, or a sequence lacks entries for some logs.
        ArmError: Inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    count = len(seeds)
    for name, values in (("faults", faults), ("external_forces", external_forces), ("robots", robots)):
        if values is not None and len(values) != count:
            raise InputError(f"{name} has entries for {len(values)} logs and there are {count} seeds; give one for each log")
    deviations = {"mismatch": mismatch, "coulomb": coulomb, "viscous": viscous}
    recordings = []
    for index, (rng, body_seed) in enumerate(zip(map(np.random.default_rng, seeds), robots or seeds, strict=True)):
        events, forces = faults[index] if faults else (), external_forces[index] if external_forces else ()
        reference = _sine_references(arm, duration, speed, rng)
        recordings.append(_Recording(reference, rng, Body(body_seed, **deviations), events, forces))
    batches = [recordings[first : first + _ROBOTS_PER_BATCH] for first in range(0, count, _ROBOTS_PER_BATCH)]
    return tuple(log for batch in batches for log in _make_logs(arm, batch, pose))


class _Recording(NamedTuple):
    """Motion (T, n) of one simulated robot, with its random generator, body, faults, and external forces."""

    reference: FloatArray
    rng: np.random.Generator
    body: Body
    faults: Sequence[FaultEvent]
    external_forces: Sequence[ExternalForce]


class _Disturbances:
    """Faults of one robot, and external forces on its links."""

    def __init__(self, model: Any, data: Any, arm: Arm, recording: _Recording) -> None:
        self._apply_force, self._model, self._data = import_mujoco().mj_applyFT, model, data
        self._injector = FaultInjector(model, data, arm, faults=recording.faults)
        self.read_sensors = self._injector.read_sensors
        links = [1 + arm.joint_index(force.joint) for force in recording.external_forces]  # body 0 is the world
        self._forces_by_link = list(zip(links, recording.external_forces, strict=True))

    def before_step(self, time: float) -> None:
        """Insert the faults, and apply the external forces that act at a time in s."""
        self._injector.before_step(time)
        data = self._data
        data.qfrc_applied[:] = 0.0
        for link, external_force in self._forces_by_link:
            if external_force.onset <= time < external_force.end:
                point = data.xpos[link] + data.xmat[link].reshape(3, 3) @ external_force.point
                force, torque = np.array(external_force.force), np.zeros(3)
                self._apply_force(self._model, data, force, torque, point, link, data.qfrc_applied)


def _make_logs(arm: Arm, recordings: Sequence[_Recording], pose: bool) -> list[Log]:
    """Return the logs of robots that run in lockstep, with motions of one length."""
    robots = _make_robots(arm, recordings)
    measured, q, torque = _simulate_robots(robots, recordings)
    logs, pose_interval = [], round(1 / (_POSE_RATE_HZ * _CYCLE_S))
    for index, (reference, rng, body, *_) in enumerate(recordings):
        x = quat = None
        if pose:
            poses = np.full((len(q), 4, 4), np.nan)
            poses[::pose_interval] = body.measure_poses(arm.forward_kinematics(q[::pose_interval, index]), rng)
            x, quat = split_tool_poses(poses)
        tau = torque[:, index] + rng.normal(0, body.torque, (len(q), arm.n))
        t = np.arange(len(q), dtype=np.float64) * _CYCLE_S
        logs.append(Log(t=t, q_ref=reference, q=measured[:, index].copy(), tau=tau, x=x, quat=quat))
    return logs


def _make_robots(arm: Arm, recordings: Sequence[_Recording]) -> SimulatedRobots:
    starts = np.array([recording.reference[0] for recording in recordings])
    robots = SimulatedRobots(arm, [recording.body for recording in recordings], starts, Servos(rate=1 / _CYCLE_S))
    robots.faults = [
        _Disturbances(model, data, arm, recording) if recording.faults or recording.external_forces else None
        for model, data, recording in zip(robots.models, robots.data, recordings, strict=True)
    ]
    return robots


def _simulate_robots(robots: SimulatedRobots, recordings: Sequence[_Recording]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Run R robots along their motions; return measured and true positions and torques (T, R, n)."""
    reference = np.stack([recording.reference for recording in recordings], axis=1)
    shape, cycle_count = reference[:, 0].shape, len(reference)
    noise = np.stack([recording.rng.normal(0, recording.body.joint, shape) for recording in recordings], axis=1)
    rates = np.diff(reference, axis=0, append=reference[-1:]) / _CYCLE_S
    rates[-1] = rates[max(-2, -cycle_count)]  # the motion continues after the log
    measured = np.empty_like(reference)
    commands = np.empty_like(reference)
    q = np.empty((cycle_count + 1, *reference.shape[1:]))
    for cycle in track("control cycles", range(cycle_count), every=1000):
        measured[cycle] = robots.measure(cycle * _CYCLE_S, reference[cycle], noise[cycle])
        q[cycle] = robots.q
        commands[cycle] = robots.advance(measured[cycle], reference[cycle], rates[cycle])
    q[cycle_count] = robots.read_positions()
    return measured, q[:-1], robots.drives.compute_mean_torque(commands, np.diff(q, axis=0))


def _sine_references(arm: Arm, duration: float | None, speed: float, rng: np.random.Generator) -> FloatArray:
    """Return sines about the middle of each range, from rest: their phase accelerates within half a second."""
    if duration is None or not 0 < duration < np.inf:
        raise InputError(f"duration is {duration}; it must be a finite number of seconds above 0")
    lower = np.where(np.isfinite(arm.lower), arm.lower, -np.pi)
    upper = np.where(np.isfinite(arm.upper), arm.upper, np.pi)
    amplitude = np.minimum(_MAX_AMPLITUDE, (upper - lower) / 4)
    angular_rates = speed / amplitude * rng.uniform(0.5, 1.0, arm.n)
    times = np.arange(int(np.ceil(duration / _CYCLE_S)), dtype=np.float64) * _CYCLE_S
    phases = np.where(times < 0.5, times**2, times - 0.25)[:, None]
    return np.asarray((lower + upper) / 2 + amplitude * np.sin(phases * angular_rates))
