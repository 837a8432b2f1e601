"""Body of a simulated robot, which differs from the model of its arm, and the drives that move it."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np

from holdfast.control.physics.servos import Servos
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec
from holdfast.model.arm.model import Arm

OBSERVER_RAD_S = 2 * np.pi * 20  # bandwidth with which an error of the joint sensors reaches the velocity loop


@check_constructor
@dataclass(frozen=True)
class Body:
    """Differences between a simulated robot and the model of its arm, and the noise of its sensors.

    Attributes:
        seed: Seed of the differences. Use one seed for everything that one robot does.
        mismatch: Largest relative error of masses, inertias and friction, sampled uniformly for each link and joint.
        coulomb: Dry friction of every joint, N m and N.
        viscous: Viscous friction of every joint, N m s/rad and N s/m.
        rotor: Rotor inertia of joints whose model states none, kg m^2 and kg.
        joint: Standard deviation of a joint sensor, rad and m.
        torque: Standard deviation of a recorded torque, N m and N.
        position: Standard deviation of each coordinate of the measured tool point, m.
        angle: Standard deviation of each component of the measured tool orientation, rad.

    Raises:
        InputError: A value is below 0, or the mismatch is 1 or more.
    """

    seed: int = 0
    _: KW_ONLY
    mismatch: float = 0.2
    coulomb: float = 0.5
    viscous: float = 0.3
    rotor: float = 0.1
    joint: float = 2e-5
    torque: float = 0.05
    position: float = 0.5e-3
    angle: float = 1e-3

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not 0 <= value < np.inf:
                raise InputError(f"{name} of the body is {value:g}; it must be a finite number of 0 or more")
        if self.mismatch >= 1:
            raise InputError(f"mismatch of the body is {self.mismatch:g}; it must be below 1, or a mass would be 0")

    def model(self, arm: Arm, servos: Servos) -> tuple[Any, FloatArray, FloatArray]:
        """Build the robot as a MuJoCo model with a motor at every joint, in which ``qpos`` is the configuration.

        A motor's torque is its control minus the servo's damping times the joint's rate. This is the velocity loop of a drive,
        which is much faster than the control cycle.

        Args:
            arm: The arm, with inertial data.
            servos: The servos. Their gains suit the arm's model, and their rate determines the time step.

        Returns:
            The ``mujoco.MjModel``, and the stiffness (n,) and damping (n,) of the servos in the units of :class:`Servos`.

        Raises:
            ArmError: Inertial data are missing or impossible, or a joint carries no mass.
            HoldfastError: MuJoCo is not installed.
        """
        mujoco = import_mujoco()
        model = _build_motor_model(arm, step=1 / (servos.rate * servos.substeps), rotor=self.rotor)
        stiffness, damping = servos.gains(arm, mujoco, model, start=np.zeros(arm.n))
        model.actuator_biastype[:], model.actuator_biasprm[:, 2] = mujoco.mjtBias.mjBIAS_AFFINE, -damping
        generator = np.random.default_rng([1, self.seed])
        model.body_mass[1:] *= (scale := 1 + generator.uniform(-self.mismatch, self.mismatch, model.nbody - 1))
        model.body_inertia[1:] *= scale[:, None]
        model.dof_frictionloss[:] = self.coulomb * (1 + generator.uniform(-self.mismatch, self.mismatch, model.nv))
        model.dof_damping[:] = self.viscous * (1 + generator.uniform(-self.mismatch, self.mismatch, model.nv))
        return model, stiffness, damping

    def measure_poses(self, poses: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Return the tool poses ``poses`` (N, 4, 4), m, with measurement noise from the generator ``rng``."""
        from scipy.spatial.transform import Rotation

        measured_poses = poses.copy()
        measured_poses[:, :3, 3] += rng.normal(0, self.position, (len(poses), 3))
        noise_rotation = Rotation.from_rotvec(rng.normal(0, self.angle, (len(poses), 3)))
        measured_poses[:, :3, :3] = noise_rotation.as_matrix() @ poses[:, :3, :3]
        return measured_poses


def _build_motor_model(arm: Arm, *, step: float, rotor: float) -> Any:
    """Build the ``mujoco.MjModel`` of an arm with a motor at every joint, whose control is its torque."""
    mujoco = import_mujoco()
    model_spec = build_mujoco_spec(arm, np.zeros(arm.n), range(arm.n), step=step)
    model_spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    for joint in arm.joints:
        motor = model_spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        if np.isfinite(joint.effort):
            motor.forcelimited, motor.forcerange = mujoco.mjtLimited.mjLIMITED_TRUE, [-joint.effort, joint.effort]
    model = model_spec.compile()
    model.dof_armature[:] = [joint.armature or rotor for joint in arm.joints]
    return model


class Drives:
    """Cascaded control loops of a robot's drives, which convert references to torques.

    In each control cycle the position loop asks every motor for the torque

        K (reference - measured position) + D (reference rate - rate error) + gravity torque,

    from which the drive itself subtracts ``D`` times the joint's rate, much faster than the control cycle. The bodies of
    :meth:`holdfast.Body.model` have this damping inside MuJoCo, whose integrator treats it implicitly. With any K and D above 0
    the loop is passive, so joints that share an axis, and together are much lighter than one alone, remain stable.

    The rate error is the derivative of the joint sensors' error (noise, quantisation, a sensor fault), filtered at 20 Hz.
    The noise of the sensors therefore reaches the motors, but not as a difference of two samples 1 ms apart.

    Args:
        stiffness: (..., n) K of each joint, N m/rad and N/m.
        damping: (..., n) D, N m s/rad and N s/m.
        effort: (n,) largest torque of each motor, N m and N.
        period: Control cycle in seconds.
    """

    def __init__(self, stiffness: FloatArray, damping: FloatArray, *, effort: FloatArray, period: float) -> None:
        self.stiffness, self.damping, self._effort, self._period = stiffness, damping, effort, period
        self._filter_fraction = min(1.0, OBSERVER_RAD_S * period)
        self.rate_error, self._sensor_error = np.zeros_like(stiffness), np.zeros_like(stiffness)

    def update_rate_error(self, measured: FloatArray, true: FloatArray) -> None:
        """Update the rate error from measured and true positions (..., n) of this cycle, rad and m."""
        error = measured - true
        self.rate_error = self.rate_error + self._filter_fraction * (
            (error - self._sensor_error) / self._period - self.rate_error
        )
        self._sensor_error = error

    def compute_motor_controls(
        self, reference: FloatArray, rates: FloatArray, measured: FloatArray, *, gravity: FloatArray, velocity: FloatArray
    ) -> FloatArray:
        """Compute the controls (..., n) of the motors, N m and N, from which the drives subtract ``D`` times the velocity.

        The drive limits the sum to the effort before the motor converts it to a torque, so a motor with a torque loss gets the
        same command as a healthy one.
        """
        requested_torque = self.stiffness * (reference - measured) + self.damping * (rates - self.rate_error) + gravity
        damping_torque = self.damping * velocity
        return np.minimum(np.maximum(requested_torque, damping_torque - self._effort), damping_torque + self._effort)

    def compute_mean_torque(self, command: FloatArray, moved: FloatArray) -> FloatArray:
        """Compute the mean torque (..., n) of a cycle, N m and N, in which the joints moved (..., n), rad and m."""
        return np.clip(command - self.damping * (moved / self._period), -self._effort, self._effort)
