"""The actuators that drive some joints of a MuJoCo model, and how strong they are."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.faults.events import FaultEvent


class Actuators:
    """Those of n joints, given by their numbers in the model.

    Attributes:
        all: Numbers of all of them.
        driven: Numbers of the joints of the model that have one.
    """

    def __init__(self, mujoco: ModuleType, model: Any, ids: Sequence[int]) -> None:
        on_joint = [int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)]
        kinds, joints = np.asarray(model.actuator_trntype), np.asarray(model.actuator_trnid).reshape(-1, 2)[:, 0]
        self._fixed = int(mujoco.mjtGain.mjGAIN_FIXED), int(mujoco.mjtBias.mjBIAS_NONE)
        self._model, self._ids = model, ids
        there = np.isin(kinds, on_joint)
        self.driven = joints[there].tolist()
        self._of = [np.flatnonzero(there & (joints == k)) for k in ids]
        self.all = np.concatenate([*self._of, np.zeros(0, dtype=np.int64)]).astype(np.int64)
        self.note()

    def note(self) -> None:
        """Take the efforts from the model as it is now, without faults."""
        self._efforts = [self._strength(j) for j in range(len(self._ids))]

    def of(self, joint: int) -> NDArray[np.int64]:
        """Numbers of those of a joint."""
        return self._of[joint]

    def require(self, event: FaultEvent) -> None:
        """Refuse a fault of a motor that is not there.

        Raises:
            InputError: The joint has no actuator of its own.
        """
        names = [self._model.joint(k).name for k in self._ids]
        if not self._of[names.index(event.joint)].size:
            raise InputError(f"'{event.kind}' is a fault of a motor, and '{event.joint}' has none; choose another")

    def effort(self, joint: int, event: FaultEvent) -> float:
        """What all motors of a joint can give, N m or N.

        Raises:
            InputError: Nothing in the model limits them.
        """
        found = self._efforts[joint]
        if found is None:
            raise InputError(
                f"'{event.kind}' of '{event.joint}' needs the effort of its motor, and the model states none; give it "
                "actuatorfrcrange, forcerange or ctrlrange"
            )
        return found

    def _strength(self, joint: int) -> float | None:
        m, k, total = self._model, self._ids[joint], 0.0
        if m.jnt_actfrclimited[k]:
            return float(np.abs(m.jnt_actfrcrange[k]).max())
        for a in self._of[joint]:
            gear = abs(float(m.actuator_gear[a, 0]))
            if m.actuator_forcelimited[a]:
                total += gear * float(np.abs(m.actuator_forcerange[a]).max())
            elif m.actuator_ctrllimited[a] and (m.actuator_gaintype[a], m.actuator_biastype[a]) == self._fixed:
                total += gear * float(np.abs(m.actuator_ctrlrange[a]).max() * abs(m.actuator_gainprm[a, 0]))
            else:
                return None
        return total if self._of[joint].size else None
