"""Point-to-point tasks of the end effector, and the scenarios in which operators do them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.laws.law import Law, by_name
from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task


@dataclass(frozen=True)
class Scenario:
    """Condition of a trial: a control law, and the state of the task's joint.

    Attributes:
        number: Number of the scenario, from 1.
        law: Name of the control law.
        options: Options of the law, for example ``pre_failure_error``.
        failed: True if the joint is locked at its start angle from the beginning of the trial.
    """

    number: int
    law: str
    failed: bool
    _: KW_ONLY
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """Label of the scenario: ``failed, pseudoinverse``."""
        return f"{'failed' if self.failed else 'healthy'}, {self.law}"

    def make_law(self, arm: Arm, task: str | Task | Sequence[str] = "planar") -> Law:
        """Return the control law of an ``arm`` for the rows of a ``task`` that the joystick commands.

        Raises:
            InputError: The law, or one of its options, is unknown.
        """
        return by_name(self.law, arm, task=task, **self.options)


SCENARIO_NAMES = (
    Scenario(1, "pseudoinverse", failed=False),
    Scenario(2, "failure-tolerant", failed=False, options={"pre_failure_error": 0.5}),
    Scenario(3, "pseudoinverse", failed=True),
    Scenario(4, "failure-tolerant", failed=True, options={"pre_failure_error": 0.5}),
)
"""The four scenarios of Goel et al. 2003, section 4."""


@dataclass(frozen=True, eq=False)
class PointTasks:
    """N point-to-point tasks.

    Attributes:
        q0: (N, n) start configurations, rad and m.
        target: (N, m) centres of the target circles, m.
        joint: (N,) index from 0 of the joint that is locked at its start angle in scenarios with a failure; -1 for none.
    """

    q0: FloatArray
    target: FloatArray
    joint: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.joint)

    def healthy_mask(self, failed: bool | NDArray[np.bool_]) -> FloatArray:
        """Return the mask (N, n): 1, or 0 for a locked joint; ``failed`` is one value for all tasks, or (N,)."""
        mask = np.ones(self.q0.shape)
        locked = np.flatnonzero((self.joint >= 0) & failed)
        mask[locked, self.joint[locked]] = 0.0
        return mask

    def take(self, rows: NDArray[np.int64]) -> PointTasks:
        """Return the tasks with indices ``rows`` (K,), in this order."""
        return PointTasks(self.q0[rows], self.target[rows], self.joint[rows])
