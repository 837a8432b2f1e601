"""An arm in MuJoCo whose healthy joints are driven by servos, and whose others are welded."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.mjcf import import_mujoco
from holdfast.arm.model import Arm
from holdfast.clearance.clearance import Clearance
from holdfast.physics.model import compiled, mujoco_spec
from holdfast.physics.servos import Servos
from holdfast.physics.surroundings import surround

Array = NDArray[np.float64]

BURST = 1e4  # rad/s or m/s: no arm is so fast; MuJoCo itself goes on to 1e10 and then writes a log
EARLY = 1e-9  # s: a lock at a control cycle's time is not left to the next one


class Plant:
    """The arm with the healthy joints driven and the others welded."""

    def __init__(
        self, arm: Arm, q: Array, rates: Array, healthy: NDArray[np.bool_], servos: Servos, around: Clearance | None = None
    ) -> None:
        self.mujoco = mujoco = import_mujoco()
        self.arm, self.start, self.servos, self._around = arm, q, servos, around
        self.free = np.flatnonzero(healthy)
        self.model = _model(mujoco, arm, q, self.free.tolist(), servos, around)
        self.data = mujoco.MjData(self.model)
        self.data.qvel[:] = rates[self.free]

    def tune(self, stiffness: Array, damping: Array) -> None:
        """Set the gains (n,) of the motors."""
        gains, biases = self.model.actuator_gainprm, self.model.actuator_biasprm
        gains[:, 0], biases[:, 1], biases[:, 2] = stiffness[self.free], -stiffness[self.free], -damping[self.free]

    @property
    def q(self) -> Array:
        """(n,) configuration."""
        q = self.start.copy()
        q[self.free] += self.data.qpos
        return q

    @property
    def rates(self) -> Array:
        """(n,) rad/s and m/s, 0 where the joint is locked."""
        rates = np.zeros(self.arm.n)
        rates[self.free] = self.data.qvel
        return rates

    @property
    def torque(self) -> Array:
        """(n,) of the motors, 0 where the joint is locked."""
        torque = np.zeros(self.arm.n)
        torque[self.free] = self.data.qfrc_actuator
        return torque

    def follow(self, wanted: Array) -> None:
        """One control cycle towards (n,) references with the feed of the rates in them."""
        self.data.ctrl[:] = (wanted - self.start)[self.free]
        self.mujoco.mj_step(self.model, self.data, self.servos.substeps)

    def locked(self, healthy: NDArray[np.bool_]) -> Plant:
        """The same arm at this moment with fewer healthy joints: the others stop at once, as in an impact without rebound.

        The momenta of the joints that stay healthy go on: M_hh rates_h is after it what (M rates)_h was before.
        """
        before, left = self.data.qvel.copy(), healthy[self.free]
        momentum = np.zeros(self.free.size)
        self.mujoco.mj_forward(self.model, self.data)
        self.mujoco.mj_mulM(self.model, self.data, momentum, before)
        after = Plant(self.arm, self.q, np.zeros(self.arm.n), healthy, self.servos, self._around)
        if left.any() and before.any():
            after.mujoco.mj_forward(after.model, after.data)
            after.mujoco.mj_solveM(after.model, after.data, after.data.qvel[None], momentum[left][None])
        return after


def _model(mujoco: Any, arm: Arm, q: Array, free: list[int], servos: Servos, around: Clearance | None) -> Any:
    """The arm with a motor at each free joint; the motors' gains are still to come."""
    step = 1 / (servos.rate * servos.substeps)
    spec = mujoco_spec(arm, q, free, step=step)
    for body in spec.bodies:
        body.gravcomp = servos.compensation
    for k, made in zip(free, spec.joints, strict=True):
        joint = arm.joints[k]
        made.actgravcomp = True  # the motor gives it, within its effort
        if np.isfinite(joint.effort):
            made.actfrclimited, made.actfrcrange = mujoco.mjtLimited.mjLIMITED_TRUE, [-joint.effort, joint.effort]
        motor = spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.gaintype, motor.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
    if around is not None:
        surround(spec, around, step)
    # Implicit in the motors' damping, which may be far stiffer than the light links behind it.
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    return compiled(spec, arm, free)
