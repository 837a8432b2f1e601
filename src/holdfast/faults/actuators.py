"""Actuators that drive some joints of a MuJoCo model, and their strength."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError


class JointActuators:
    """Actuators of n joints, which are given by their numbers in the model.

    Attributes:
        numbers: Numbers of all of them.
        driven_joints: Numbers of the joints of the model that have one.
    """

    def __init__(self, mujoco: ModuleType, model: Any, ids: Sequence[int]) -> None:
        on_joint = [int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)]
        transmission_types, joints = np.asarray(model.actuator_trntype), np.asarray(model.actuator_trnid).reshape(-1, 2)[:, 0]
        self._fixed_gain_and_bias = int(mujoco.mjtGain.mjGAIN_FIXED), int(mujoco.mjtBias.mjBIAS_NONE)
        self._model, self._ids = model, ids
        drives_joint = np.isin(transmission_types, on_joint)
        self.driven_joints = joints[drives_joint].tolist()
        self._by_joint = [np.flatnonzero(drives_joint & (joints == joint_id)) for joint_id in ids]
        self.numbers = np.concatenate([*self._by_joint, np.zeros(0, dtype=np.int64)]).astype(np.int64)
        self.read_efforts()

    def read_efforts(self) -> None:
        """Read the efforts from the current model, without faults."""
        self._efforts = [self._compute_effort(joint) for joint in range(len(self._ids))]

    def numbers_of_joint(self, joint: int) -> NDArray[np.int64]:
        """Return the numbers of the actuators of a joint."""
        return self._by_joint[joint]

    def require_actuator(self, joint: int, kind: str) -> None:
        """Raise an error for a motor fault of a joint without an actuator.

        Raises:
            InputError: The joint has no actuator of its own.
        """
        if not self._by_joint[joint].size:
            raise InputError(f"'{kind}' is a fault of a motor, and '{self._joint_name(joint)}' has none; choose another")

    def total_effort(self, joint: int, kind: str) -> float:
        """Return the total effort of all motors of a joint, N m or N.

        Raises:
            InputError: Nothing in the model limits them.
        """
        effort = self._efforts[joint]
        if effort is None:
            raise InputError(
                f"'{kind}' of '{self._joint_name(joint)}' needs the effort of its motor, and the model states none; give it "
                "actuatorfrcrange, forcerange or ctrlrange"
            )
        return effort

    def _joint_name(self, joint: int) -> str:
        return str(self._model.joint(self._ids[joint]).name)

    def _compute_effort(self, joint: int) -> float | None:
        model, joint_id, total = self._model, self._ids[joint], 0.0
        if model.jnt_actfrclimited[joint_id]:
            return float(np.abs(model.jnt_actfrcrange[joint_id]).max())
        for actuator in self._by_joint[joint]:
            gear = abs(float(model.actuator_gear[actuator, 0]))
            if model.actuator_forcelimited[actuator]:
                total += gear * float(np.abs(model.actuator_forcerange[actuator]).max())
            elif (
                model.actuator_ctrllimited[actuator]
                and (model.actuator_gaintype[actuator], model.actuator_biastype[actuator]) == self._fixed_gain_and_bias
            ):
                total += gear * float(
                    np.abs(model.actuator_ctrlrange[actuator]).max() * abs(model.actuator_gainprm[actuator, 0])
                )
            else:
                return None
        return total if self._by_joint[joint].size else None
