"""Records of a simulated arm with servos, noise and a body that is not quite its model: to try the monitor on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.mjcf import import_mujoco, quiet
from holdfast.arm.model import Arm
from holdfast.errors import InputError
from holdfast.faults.events import FaultEvent
from holdfast.faults.injector import FaultInjector
from holdfast.faults.log import Log
from holdfast.notice import each, says
from holdfast.physics.body import Body
from holdfast.physics.drives import Drives
from holdfast.physics.servos import Servos

Array = NDArray[np.float64]

_STEP = 1e-3  # s
_HALF = 0.6  # rad or m to either side of the middle, at most; and half of the room to the limits
_POSE_RATE = 100.0  # Hz
_AT_ONCE = 10  # robots: more leave the processor's cache


@dataclass(frozen=True)
class Push:
    """A force on a link for a while: what no joint is to blame for.

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


@checked
@quiet()
@says("simulating a record")
def rehearse(
    arm: Arm,
    duration: float | None = None,
    *,
    motion: ArrayLike | None = None,
    faults: Sequence[FaultEvent] = (),
    pushes: Sequence[Push] = (),
    seed: int = 0,
    body: int | None = None,
    speed: float = 0.5,
    mismatch: float = 0.2,
    coulomb: float = 0.5,
    viscous: float = 0.3,
    pose: bool = True,
) -> Log:
    """A record of a simulated arm that swings each joint to and fro, with noise (needs ``holdfast[physics]``).

    Servos of 10 Hz with the gravity torque of the arm's model follow sines about the middle of the range, or a motion. Each
    drive closes its velocity loop faster than the control cycle of 1 kHz; at random configurations of every built-in arm with
    inertial data the linearised cycle has no eigenvalue above 0.98 in magnitude. The body is not quite the arm's model: masses
    and friction are off by up to ``mismatch``. Faults begin and end as their events say.

    Args:
        arm: The arm, with inertial data.
        duration: s; None with a motion.
        motion: (T, n) references, rad and m, 1000 a second, from rest; None: sines.
        faults: Events in it; times are those of the record.
        pushes: Forces from outside, likewise.
        seed: Of the motion and the noise.
        body: Seed of what is off: records of one robot have one. None: a robot of its own for each ``seed``.
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
    reference = _swinging(arm, duration, speed, rng) if motion is None else arm.check_configurations(motion)
    made = Body(seed if body is None else body, mismatch=mismatch, coulomb=coulomb, viscous=viscous)
    robot = _Robot(arm, reference, rng, made, faults, pushes)
    return _records(arm, [robot], pose)[0]


@checked
@quiet()
@says("simulating records")
def rehearse_many(
    arm: Arm,
    duration: float,
    *,
    seeds: Sequence[int],
    faults: Sequence[Sequence[FaultEvent]] | None = None,
    pushes: Sequence[Sequence[Push]] | None = None,
    bodies: Sequence[int] | None = None,
    speed: float = 0.5,
    mismatch: float = 0.2,
    coulomb: float = 0.5,
    viscous: float = 0.3,
    pose: bool = True,
) -> tuple[Log, ...]:
    """Records as :func:`holdfast.diagnosis.rehearse` makes them one by one, several at once: in about half the time.

    Args:
        arm: The arm, with inertial data.
        duration: Of each, s.
        seeds: One for each record.
        faults: Events of each; None: healthy.
        pushes: Forces from outside of each.
        bodies: Seeds of what is off, one for each; None: ``seeds``.
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
    for name, given in (("faults", faults), ("pushes", pushes), ("bodies", bodies)):
        if given is not None and len(given) != count:
            raise InputError(f"{name} are of {len(given)} records and seeds of {count}; give one for each record")
    off = {"mismatch": mismatch, "coulomb": coulomb, "viscous": viscous}
    logs: list[Log] = []
    for start in range(0, count, _AT_ONCE):
        robots = []
        for k in range(start, min(start + _AT_ONCE, count)):
            rng = np.random.default_rng(seeds[k])
            events, forces = faults[k] if faults else (), pushes[k] if pushes else ()
            reference = _swinging(arm, duration, speed, rng)
            robots.append(_Robot(arm, reference, rng, Body((bodies or seeds)[k], **off), events, forces))
        logs += _records(arm, robots, pose)
    return tuple(logs)


class _Robot:
    """One robot, its motion (T, n), and what happens to it."""

    def __init__(
        self,
        arm: Arm,
        reference: Array,
        rng: np.random.Generator,
        body: Body,
        faults: Sequence[FaultEvent],
        pushes: Sequence[Push],
    ) -> None:
        self._mujoco, self.reference, self.rng, self.happens = import_mujoco(), reference, rng, bool(faults or pushes)
        self.body = body
        self.model, self.stiffness, self.damping = body.model(arm, Servos(rate=1 / _STEP))
        self.data = self._mujoco.MjData(self.model)
        self.data.qpos[:] = reference[0]
        self._mujoco.mj_forward(self.model, self.data)
        self.injector = FaultInjector(self.model, self.data, arm, faults=faults)
        self._pushes = [(1 + arm.joint_index(push.joint), push) for push in pushes]  # body 0 is the world

    def push(self, time: float) -> None:
        """Let forces act."""
        data = self.data
        data.qfrc_applied[:] = 0.0
        for link, push in self._pushes:
            if push.onset <= time < push.end:
                where = data.xpos[link] + data.xmat[link].reshape(3, 3) @ push.point
                self._mujoco.mj_applyFT(self.model, data, np.array(push.force), np.zeros(3), where, link, data.qfrc_applied)


def _records(arm: Arm, robots: Sequence[_Robot], pose: bool) -> list[Log]:
    """Return what robots record of motions of one length."""
    measured, true, torque = _run_cycles(arm, robots)
    t, logs = np.arange(len(true), dtype=np.float64) * _STEP, []
    for r, robot in enumerate(robots):
        x, quat = _measured(arm, true[:, r], robot) if pose else (None, None)
        tau = torque[:, r] + robot.rng.normal(0, robot.body.torque, (len(t), arm.n))
        logs.append(Log(t=t, q_ref=robot.reference, q=measured[:, r].copy(), tau=tau, x=x, quat=quat))
    return logs


def _run_cycles(arm: Arm, robots: Sequence[_Robot]) -> tuple[Array, Array, Array]:
    """Run R robots, one control cycle of all after the other; return measured and true positions and torques (T, R, n)."""
    step, count, n = import_mujoco().mj_step, len(robots[0].reference), arm.n
    t = np.arange(count, dtype=np.float64) * _STEP
    reference = np.stack([robot.reference for robot in robots], axis=1)
    noise = np.stack([robot.rng.normal(0, robot.body.joint, (count, n)) for robot in robots], axis=1)
    stiffness, damping = (np.array([getattr(robot, name) for robot in robots]) for name in ("stiffness", "damping"))
    drives = Drives(stiffness, damping, effort=np.array([joint.effort for joint in arm.joints]), period=_STEP)
    rates = np.diff(reference, axis=0, append=reference[-1:]) / _STEP
    rates[-1] = rates[max(-2, -count)]  # the motion goes on after the record
    measured, commands, true = np.empty_like(reference), np.empty_like(reference), np.empty((count + 1, len(robots), n))
    gravity = arm._gravity_torque_kernel.single() if len(robots) == 1 else arm._gravity_torque_kernel.rows
    places, speeds = [robot.data.qpos for robot in robots], [robot.data.qvel for robot in robots]
    happening = [robot for robot in robots if robot.happens]
    moved = [(robot.model, robot.data, robot.data.ctrl) for robot in robots]
    for k in each("control cycles", range(count), every=1000):
        for robot in happening:
            robot.injector.before_step(t[k])
        now, q = true[k], measured[k]
        np.concatenate(places, out=now.reshape(-1))
        np.add(now, noise[k], out=q)
        for r, robot in enumerate(robots if happening else ()):
            q[r] = robot.injector.read(now[r], reference=reference[k, r]) + noise[k, r]
        drives.sense(q, now)
        torque = gravity(q.reshape(-1) if len(robots) == 1 else q)
        velocity = np.concatenate(speeds).reshape(q.shape)
        commands[k] = drives.command(reference[k], rates[k], q, gravity=torque, velocity=velocity)
        for (model, data, control), row, robot in zip(moved, commands[k], robots, strict=True):
            control[:] = row
            if robot.happens:
                robot.injector.before_step(t[k])
                robot.push(t[k])
            step(model, data)
    np.concatenate(places, out=true[count].reshape(-1))
    return measured, true[:-1], drives.torque(commands, np.diff(true, axis=0))


def _swinging(arm: Arm, duration: float | None, speed: float, rng: np.random.Generator) -> Array:
    """Sines about the middle of each range, from rest: their phase runs up within half a second."""
    if duration is None or not 0 < duration < np.inf:
        raise InputError(f"duration is {duration}; it must be a finite number of seconds above 0")
    low, high = (np.where(np.isfinite(x), x, s * np.pi) for x, s in ((arm.lower, -1.0), (arm.upper, 1.0)))
    half = np.minimum(_HALF, (high - low) / 4)
    pace = speed / half * rng.uniform(0.5, 1.0, arm.n)
    t = np.arange(int(np.ceil(duration / _STEP)), dtype=np.float64) * _STEP
    return np.asarray((low + high) / 2 + half * np.sin(np.where(t < 0.5, t**2, t - 0.25)[:, None] * pace))


def _measured(arm: Arm, q: Array, robot: _Robot) -> tuple[Array, Array]:
    """Tool poses with noise, NaN between samples."""
    from scipy.spatial.transform import Rotation

    every = round(1 / (_POSE_RATE * _STEP))
    poses = robot.body.measured(arm.forward_kinematics(q[::every]), robot.rng)
    x, quat = np.full((len(q), 3), np.nan), np.full((len(q), 4), np.nan)
    x[::every], quat[::every] = poses[:, :3, 3], Rotation.from_matrix(poses[:, :3, :3]).as_quat()
    return x, quat
