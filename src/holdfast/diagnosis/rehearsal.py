"""Records of a simulated arm with servos, noise and a body that is not quite its model: to try the monitor on."""

from __future__ import annotations

from collections.abc import Sequence

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
from holdfast.physics.body import spread, with_motors
from holdfast.physics.servos import Servos

Array = NDArray[np.float64]

_STEP = 1e-3  # s
_HALF = 0.6  # rad or m to either side of the middle, at most; and half of the room to the limits
_ROTOR = 0.1  # kg m^2, where the arm states none
_NOISE = {"q": 2e-5, "tau": 0.05, "x": 0.5e-3, "angle": 1e-3}  # standard deviations: rad, N m, m, rad
_POSE_RATE = 100.0  # Hz


@checked
@quiet()
@says("simulating a record")
def rehearse(
    arm: Arm,
    duration: float | None = None,
    *,
    motion: ArrayLike | None = None,
    faults: Sequence[FaultEvent] = (),
    seed: int = 0,
    body: int | None = None,
    speed: float = 0.5,
    mismatch: float = 0.2,
    coulomb: float = 0.5,
    viscous: float = 0.3,
    pose: bool = True,
) -> Log:
    """A record of a simulated arm that swings each joint to and fro, with noise (needs ``holdfast[physics]``).

    Servos of 10 Hz with the gravity torque of the arm's model follow sines about the middle of the range, or a motion. The body
    is not quite the arm's model: masses and friction are off by up to ``mismatch``. Faults begin and end as their events say.

    Args:
        arm: The arm, with inertial data.
        duration: s; None with a motion.
        motion: (T, n) references, rad and m, 1000 a second, from rest; None: sines.
        faults: Events in it; times are those of the record.
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
        InputError: Not a finite time above 0, both or none of time and motion, an unknown joint, or a fault that the model
            cannot have.
        ArmError: Inertial data are missing or impossible.
        HoldfastError: MuJoCo is not installed.
    """
    if (duration is None) == (motion is None):
        raise InputError("give the duration or the motion of the record, one of them")
    mujoco, rng, n = import_mujoco(), np.random.default_rng(seed), arm.n
    reference = _swinging(arm, duration, speed, rng) if motion is None else arm.check_configurations(motion)
    count = len(reference)
    t = np.arange(count, dtype=np.float64) * _STEP
    model = with_motors(arm, step=_STEP, rotor=_ROTOR)
    spread(model, seed if body is None else body, mismatch=mismatch, coulomb=coulomb, viscous=viscous)
    data = mujoco.MjData(model)
    stiffness, damping = Servos(step=_STEP).gains(arm, mujoco, model, start=np.zeros(n))
    rates = np.diff(reference, axis=0, append=reference[-1:]) / _STEP
    data.qpos[:] = reference[0]
    mujoco.mj_forward(model, data)
    injector = FaultInjector(model, data, arm, faults=faults)
    noise = rng.normal(0, _NOISE["q"], (count, n))
    gravity = arm._gravity_torque_kernel.single()
    told, tau, true = np.empty((count, n)), np.empty((count, n)), np.empty((count, n))
    effort = np.array([joint.effort for joint in arm.joints])
    last = reference[0].copy()
    for k in each("control cycles", range(count), every=1000):
        injector.before_step(t[k])
        true[k] = data.qpos
        told[k] = q = injector.read(data.qpos, reference=reference[k]) + noise[k]
        v = data.qvel if k == 0 else (q - last) / _STEP
        last = q
        torque = stiffness * (reference[k] - q) + damping * (rates[k] - np.clip(v, -10, 10)) + gravity(q)
        tau[k] = data.ctrl[:] = np.clip(torque, -effort, effort)
        injector.before_step(t[k])
        mujoco.mj_step(model, data)
    x, quat = (_measured(arm, true, rng)) if pose else (None, None)
    return Log(t=t, q_ref=reference, q=told, tau=tau + rng.normal(0, _NOISE["tau"], tau.shape), x=x, quat=quat)


def _swinging(arm: Arm, duration: float | None, speed: float, rng: np.random.Generator) -> Array:
    """Sines about the middle of each range, from rest: their phase runs up within half a second."""
    if duration is None or not 0 < duration < np.inf:
        raise InputError(f"duration is {duration}; it must be a finite number of seconds above 0")
    low, high = (np.where(np.isfinite(x), x, s * np.pi) for x, s in ((arm.lower, -1.0), (arm.upper, 1.0)))
    half = np.minimum(_HALF, (high - low) / 4)
    pace = speed / half * rng.uniform(0.5, 1.0, arm.n)
    t = np.arange(int(np.ceil(duration / _STEP)), dtype=np.float64) * _STEP
    return np.asarray((low + high) / 2 + half * np.sin(np.where(t < 0.5, t**2, t - 0.25)[:, None] * pace))


def _measured(arm: Arm, q: Array, rng: np.random.Generator) -> tuple[Array, Array]:
    """Tool poses with noise, NaN between samples."""
    from scipy.spatial.transform import Rotation

    every = round(1 / (_POSE_RATE * _STEP))
    poses = arm.forward_kinematics(q[::every])
    x, quat = np.full((len(q), 3), np.nan), np.full((len(q), 4), np.nan)
    x[::every] = poses[:, :3, 3] + rng.normal(0, _NOISE["x"], (len(poses), 3))
    turned = Rotation.from_rotvec(rng.normal(0, _NOISE["angle"], (len(poses), 3)))
    quat[::every] = (turned * Rotation.from_matrix(poses[:, :3, :3])).as_quat()
    return x, quat
