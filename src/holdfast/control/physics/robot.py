"""Simulated robots in MuJoCo: the body, the servos, the sensors, the faults, and one control cycle.

There are two kinds of robot. A :class:`ServoRobot` has the masses of the model, servos that MuJoCo evaluates at every step, and
welds in place of locked joints. :class:`SimulatedRobots` have bodies that differ from the model, drives that get their command
once in a control cycle, noisy sensors, and faults of every kind.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.control.physics.body import Body, Drives
from holdfast.control.physics.servos import Servos, max_reference_offsets
from holdfast.control.physics.surroundings import ContactLog, add_cell_objects
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance

MAX_PHYSICAL_SPEED = 1e4  # rad/s or m/s: no arm is this fast; MuJoCo itself continues to 1e10 and then writes a log
LOCK_TIME_TOLERANCE_S = 1e-9  # s: a lock at the time of a control cycle is not delayed to the next one


class ServoRobot:
    """Simulated arm whose healthy joints are driven by servos inside MuJoCo, and whose locked joints are welded.

    Args:
        arm: The arm, with inertial data.
        q: (n,) configuration at the start, rad and m, at rest.
        servos: Servos of the joints.
        clearance: Collision model of the arm, with the cell around it if there is one.

    Attributes:
        stiffness, damping: (n,) gains of the servos.
        rate_feed: (n,) time in s by which a moving reference is advanced, so that the damping does not slow the joint.
        contacts: Contacts with the cell so far.

    Raises:
        InputError: The start lies within an object of the cell.
    """

    def __init__(self, arm: Arm, q: FloatArray, servos: Servos, clearance: Clearance | None = None) -> None:
        self._mujoco, self.arm, self.servos, self.contacts = import_mujoco(), arm, servos, ContactLog(clearance)
        self._build_model(q, np.ones(arm.n, dtype=bool))
        self.contacts.require_collision_free(self.model)
        self.stiffness, self.damping = servos.gains(arm, self._mujoco, self.model, start=q)
        self.rate_feed, self._max_lead = self.damping / self.stiffness, max_reference_offsets(arm, self.stiffness)
        self._set_gains()
        self.schedule_locks(np.full(arm.n, np.inf))

    def _build_model(self, q: FloatArray, healthy: NDArray[np.bool_]) -> None:
        """Build the model with a motor at each healthy joint, whose ``qpos`` counts from q (n,), and its data at rest."""
        mujoco, servos = self._mujoco, self.servos
        step = 1 / (servos.rate * servos.substeps)
        self._start, self.free = q, np.flatnonzero(healthy)
        spec = build_mujoco_spec(self.arm, q, self.free.tolist(), step=step)
        for body in spec.bodies:
            body.gravcomp = servos.compensation
        for index, spec_joint in zip(self.free, spec.joints, strict=True):
            joint = self.arm.joints[index]
            spec_joint.actgravcomp = True  # the motor gives it, within its effort
            if np.isfinite(joint.effort):
                spec_joint.actfrclimited = mujoco.mjtLimited.mjLIMITED_TRUE
                spec_joint.actfrcrange = [-joint.effort, joint.effort]
            motor = spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
            motor.gaintype, motor.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
        if self.contacts.clearance is not None:
            add_cell_objects(spec, self.contacts.clearance, step)
        # The integrator must treat the motors' damping implicitly, because it may be far too stiff for light links.
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def _set_gains(self) -> None:
        gains, biases = self.model.actuator_gainprm, self.model.actuator_biasprm
        gains[:, 0] = self.stiffness[self.free]
        biases[:, 1] = -self.stiffness[self.free]
        biases[:, 2] = -self.damping[self.free]

    def _joint_vector(self, values: FloatArray) -> FloatArray:
        """Return values of the healthy joints as a vector (n,) that is 0 for locked joints."""
        vector = np.zeros(self.arm.n)
        vector[self.free] = values
        return vector

    @property
    def q(self) -> FloatArray:
        """(n,) configuration, rad and m."""
        return self._start + self._joint_vector(self.data.qpos)

    @property
    def rates(self) -> FloatArray:
        """(n,) joint rates, rad/s and m/s, 0 where the joint is locked."""
        return self._joint_vector(self.data.qvel)

    @property
    def torque(self) -> FloatArray:
        """(n,) torques of the motors, 0 where the joint is locked."""
        return self._joint_vector(self.data.qfrc_actuator)

    def limit_reference(self, reference: FloatArray, q: FloatArray) -> FloatArray:
        """Limit a reference (n,) to the distance from q (n,) at which it requests the full effort."""
        return np.minimum(np.maximum(reference, q - self._max_lead), q + self._max_lead)

    def simulate_cycle(self, goal: FloatArray, end_time: float) -> None:
        """Simulate a control cycle up to ``end_time`` in s towards ``goal`` (n,), the reference advanced by its rates."""
        self.data.ctrl[:] = (goal - self._start)[self.free]
        self._mujoco.mj_step(self.model, self.data, self.servos.substeps)
        if self.data.ncon > 0:
            self.contacts.record_contacts(self.model, self.data, end_time)

    def schedule_locks(self, lock_times: FloatArray) -> None:
        """Set the times (n,) in s at which the joints lock, infinite for never."""
        self._lock_times, self._next_lock = lock_times, float(lock_times.min())

    def lock_due_joints(self, time: float) -> None:
        """Lock the joints that are due at a time in s."""
        if time >= self._next_lock - LOCK_TIME_TOLERANCE_S:
            healthy = self._lock_times > time + LOCK_TIME_TOLERANCE_S
            self.lock_all_except(healthy)
            self._next_lock = float(self._lock_times[healthy].min(initial=np.inf))

    def lock_all_except(self, healthy: NDArray[np.bool_]) -> None:
        """Lock the joints that are not healthy, which stop at once, as in an impact without rebound.

        The momenta of the healthy joints are conserved: M_hh rates_h after the impact equals (M rates)_h before it.
        """
        mujoco, rates, still_healthy = self._mujoco, self.data.qvel.copy(), healthy[self.free]
        momentum = np.zeros(self.free.size)
        mujoco.mj_forward(self.model, self.data)
        mujoco.mj_mulM(self.model, self.data, momentum, rates)
        self._build_model(self.q, healthy)
        if still_healthy.any() and rates.any():
            mujoco.mj_forward(self.model, self.data)
            mujoco.mj_solveM(self.model, self.data, self.data.qvel[None], momentum[still_healthy][None])
        self._set_gains()


class FaultSource(Protocol):
    """Source of the faults of one simulated robot, such as :class:`holdfast.response.faults.FaultInjector`."""

    def before_step(self, time: float) -> None:
        """Begin and end the faults that are due at a time in s, and insert the active ones into the MuJoCo model."""
        ...

    def read_sensors(self, q: FloatArray, *, reference: FloatArray) -> FloatArray:
        """Return the readings (n,) of joint sensors at true positions (n,) of servos that follow a reference (n,)."""
        ...


class SimulatedRobots:
    """Set of R robots of one arm that run in lockstep, each with its own body, drives, sensor noise, and faults.

    A control cycle consists of :meth:`measure` and then :meth:`advance`.

    Args:
        arm: The arm, with inertial data.
        bodies: Body of each robot.
        starts: (R, n) configurations at the start, rad and m, at rest.
        servos: Servos of the joints.

    Attributes:
        models, data: ``mujoco.MjModel`` and ``mujoco.MjData`` of each robot; ``qpos`` is the configuration.
        faults: Faults of each robot; None for a healthy one.
        drives: Cascaded loops of all robots' drives.
        q: (R, n) true positions at the last measurement, rad and m.
        gravity: (R, n) gravity torques of the arm's model in the last cycle, N m and N.
    """

    def __init__(self, arm: Arm, bodies: Sequence[Body], starts: FloatArray, servos: Servos) -> None:
        mujoco = import_mujoco()
        self._step, self._substeps = mujoco.mj_step, servos.substeps
        models, stiffness, damping = zip(*(body.model(arm, servos) for body in bodies), strict=True)
        self.models: Sequence[Any] = models
        self.data = [mujoco.MjData(model) for model in self.models]
        for model, data, start in zip(self.models, self.data, starts, strict=True):
            data.qpos[:] = start
            mujoco.mj_forward(model, data)
        self.faults: list[FaultSource | None] = [None] * len(self.data)
        effort = np.array([joint.effort for joint in arm.joints])
        self.drives = Drives(np.array(stiffness), np.array(damping), effort=effort, period=1 / servos.rate)
        self.max_reference_lead = max_reference_offsets(arm, self.drives.stiffness)
        kernel, self._shape = arm._gravity_torque_kernel, (len(self.data), arm.n)
        self._gravity_torque = kernel.rows if len(self.data) > 1 else kernel.single_row()
        self._positions, self._velocities = [data.qpos for data in self.data], [data.qvel for data in self.data]
        self._controls, self._time = [data.ctrl for data in self.data], 0.0
        self.q = self.read_positions()
        self.gravity = self.compute_gravity_torques(self.q)

    def read_positions(self) -> FloatArray:
        """Return the true positions (R, n) at this moment, rad and m."""
        return np.concatenate(self._positions).reshape(self._shape)

    def read_velocities(self) -> FloatArray:
        """Return the true velocities (R, n) at this moment, rad/s and m/s."""
        return np.concatenate(self._velocities).reshape(self._shape)

    def compute_gravity_torques(self, q: FloatArray) -> FloatArray:
        """Compute the gravity torques (R, n) of the arm's model at q (R, n), N m and N."""
        return self._gravity_torque(q if len(self.data) > 1 else q[0]).reshape(self._shape)

    def measure(self, time: float, reference: FloatArray, noise: FloatArray) -> FloatArray:
        """Measure the joint positions (R, n) at a time in s while the servos follow references (R, n), with noise (R, n)."""
        self._time = time
        for faults in self.faults:
            if faults is not None:
                faults.before_step(time)
        self.q = self.read_positions()
        readings = self.q.copy()
        for index, faults in enumerate(self.faults):
            if faults is not None:
                readings[index] = faults.read_sensors(self.q[index], reference=reference[index])
        readings += noise
        self.drives.update_rate_error(readings, self.q)
        return readings

    def advance(self, q: FloatArray, reference: FloatArray, rates: FloatArray) -> FloatArray:
        """Advance the control cycle, and return the commands (R, n) of the motors, N m and N.

        Args:
            q: (R, n) positions that the servos assume, rad and m.
            reference: (R, n) references of the servos, rad and m.
            rates: (R, n) rates of the reference, rad/s and m/s.
        """
        self.gravity = self.compute_gravity_torques(q)
        velocity = self.read_velocities()
        commands = self.drives.compute_motor_controls(reference, rates, q, gravity=self.gravity, velocity=velocity)
        for index, faults in enumerate(self.faults):
            self._controls[index][:] = commands[index]
            if faults is not None:
                faults.before_step(self._time)
            self._step(self.models[index], self.data[index], self._substeps)
        return commands


def split_tool_poses(poses: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Split tool poses (T, 4, 4), NaN without a measurement, into positions (T, 3) and quaternions (T, 4), x, y, z, w."""
    from scipy.spatial.transform import Rotation

    is_measured = np.isfinite(poses[:, 0, 0])
    quaternions = np.full((len(poses), 4), np.nan)
    if is_measured.any():
        quaternions[is_measured] = Rotation.from_matrix(poses[is_measured, :3, :3]).as_quat()
    return poses[:, :3, 3], quaternions
