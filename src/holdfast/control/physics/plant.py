"""An arm in MuJoCo whose healthy joints are driven by servos, and whose others are welded."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.control.physics.model import build_mujoco_spec, compile_model
from holdfast.control.physics.servos import Servos
from holdfast.control.physics.surroundings import add_cell_objects
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.mjcf import import_mujoco
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance

MAX_PHYSICAL_SPEED = 1e4  # rad/s or m/s: no arm is so fast; MuJoCo itself goes on to 1e10 and then writes a log
LOCK_TIME_TOLERANCE_S = 1e-9  # s: a lock at a control cycle's time is not left to the next one


class ServoPlant:
    """The arm with the healthy joints driven and the others welded."""

    def __init__(
        self,
        arm: Arm,
        q: FloatArray,
        rates: FloatArray,
        healthy: BoolArray,
        servos: Servos,
        cell_clearance: Clearance | None = None,
    ) -> None:
        self.mujoco = mujoco = import_mujoco()
        self.arm, self.start, self.servos, self._cell_clearance = arm, q, servos, cell_clearance
        self.free = np.flatnonzero(healthy)
        self.model = _build_model(mujoco, arm, q, self.free.tolist(), servos, cell_clearance)
        self.data = mujoco.MjData(self.model)
        self.data.qvel[:] = rates[self.free]

    def set_gains(self, stiffness: FloatArray, damping: FloatArray) -> None:
        """Set the gains (n,) of the motors."""
        gains, biases = self.model.actuator_gainprm, self.model.actuator_biasprm
        gains[:, 0], biases[:, 1], biases[:, 2] = stiffness[self.free], -stiffness[self.free], -damping[self.free]

    @property
    def q(self) -> FloatArray:
        """(n,) configuration."""
        q = self.start.copy()
        q[self.free] += self.data.qpos
        return q

    @property
    def rates(self) -> FloatArray:
        """(n,) joint rates, rad/s and m/s, 0 where the joint is locked."""
        rates = np.zeros(self.arm.n)
        rates[self.free] = self.data.qvel
        return rates

    @property
    def torque(self) -> FloatArray:
        """(n,) torques of the motors, 0 where the joint is locked."""
        torque = np.zeros(self.arm.n)
        torque[self.free] = self.data.qfrc_actuator
        return torque

    def simulate_control_cycle(self, reference: FloatArray) -> None:
        """Simulate one control cycle towards (n,) references with the feed of the rates in them."""
        self.data.ctrl[:] = (reference - self.start)[self.free]
        self.mujoco.mj_step(self.model, self.data, self.servos.substeps)

    def lock_all_except(self, healthy: BoolArray) -> ServoPlant:
        """Return the arm at this moment with fewer healthy joints: the others stop at once, as in an impact without rebound.

        The momenta of the joints that stay healthy go on: M_hh rates_h is after it what (M rates)_h was before.
        """
        rates, still_healthy = self.data.qvel.copy(), healthy[self.free]
        momentum = np.zeros(self.free.size)
        self.mujoco.mj_forward(self.model, self.data)
        self.mujoco.mj_mulM(self.model, self.data, momentum, rates)
        locked_plant = ServoPlant(self.arm, self.q, np.zeros(self.arm.n), healthy, self.servos, self._cell_clearance)
        if still_healthy.any() and rates.any():
            locked_plant.mujoco.mj_forward(locked_plant.model, locked_plant.data)
            locked_plant.mujoco.mj_solveM(
                locked_plant.model, locked_plant.data, locked_plant.data.qvel[None], momentum[still_healthy][None]
            )
        return locked_plant


def _build_model(
    mujoco: Any, arm: Arm, q: FloatArray, free: list[int], servos: Servos, cell_clearance: Clearance | None
) -> Any:
    """Build the model of the arm with a motor at each free joint, whose gains are set later."""
    step = 1 / (servos.rate * servos.substeps)
    model_spec = build_mujoco_spec(arm, q, free, step=step)
    for body in model_spec.bodies:
        body.gravcomp = servos.compensation
    for index, spec_joint in zip(free, model_spec.joints, strict=True):
        joint = arm.joints[index]
        spec_joint.actgravcomp = True  # the motor gives it, within its effort
        if np.isfinite(joint.effort):
            spec_joint.actfrclimited, spec_joint.actfrcrange = mujoco.mjtLimited.mjLIMITED_TRUE, [-joint.effort, joint.effort]
        motor = model_spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.gaintype, motor.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
    if cell_clearance is not None:
        add_cell_objects(model_spec, cell_clearance, step)
    # Implicit in the motors' damping, which may be far stiffer than the light links behind it.
    model_spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model_spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    return compile_model(model_spec, arm, free)
