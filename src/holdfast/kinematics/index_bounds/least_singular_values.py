"""Upper bounds of the least singular value after joint locks; it has a unit, so the lengths of the columns matter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Protocol

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kinematics.index_bounds.frames import equal_row_frame
from holdfast.kinematics.index_bounds.manipulability_bounds import (
    ArmSize,
    FailureProblem,
    TaskSize,
    max_simultaneous_failures,
    upper_bound,
)

BOUND_REASONS = {
    "S0": "the mean over all sets of joints",
    "S1": "one failure: isotropy and columns of one length",
    "S2": "every two failures: blocks of two rows",
    "S3": "the three angular rows, whatever the lengths",
}
_POSE_ROWS = 6


class JointGeometry(Protocol):
    """Geometry of a joint of an arm."""

    @property
    def origin(self) -> FloatArray:
        """Pose (4, 4) in the frame of the previous joint, m."""

    @property
    def prismatic(self) -> bool:
        """True for a prismatic joint."""

    @property
    def lower(self) -> float:
        """Lower limit, rad or m."""

    @property
    def upper(self) -> float:
        """Upper limit, rad or m."""


class JointedArm(ArmSize, Protocol):
    """Arm whose geometry bounds the levers, such as the arm of an index."""

    @property
    def joints(self) -> Sequence[JointGeometry]:
        """Joints from base to tool."""

    @property
    def tool(self) -> FloatArray:
        """Pose (4, 4) of the tool in the frame of the last joint, m."""


class TaskGeometry(TaskSize, Protocol):
    """Task whose rows determine the unit, such as the task of an index."""

    @property
    def rows(self) -> FloatArray:
        """Rows (m, 6) of the task, linear columns first."""

    @property
    def length(self) -> float:
        """Characteristic length, m."""


class SingularValueProblem(FailureProblem, Protocol):
    """Arm, task, and failures for which an upper bound of the least singular value is requested, such as an index."""

    @property
    def arm(self) -> JointedArm:
        """Arm of the problem."""

    @property
    def task(self) -> TaskGeometry:
        """Task of the problem."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SingularValueBound(Result):
    """Upper bound of the worst-case least singular value of n columns in m rows.

    Attributes:
        n, m, k: Number of joints, of rows of the task, and of joints that lock at once.
        lever: Root mean square, over the joints, of the largest distance of the tool point from each axis, in m, or in
            characteristic lengths if rows are mixed; infinite if it is unlimited.
        angular: True if some rows are angular, for example the three angular rows of a pose.
        bound: Largest possible value for any Jacobian, in the unit of ``lever``.
        bound_by: Theorem that proves the bound, S0 to S3 of ``docs/theory/upper-bounds-proofs.md``.
    """

    n: int
    m: int
    k: int
    lever: float
    angular: bool
    bound: float
    bound_by: str

    @property
    def jacobian(self) -> FloatArray | None:
        """Jacobian (m, n) that attains the bound, for one lock and rows of one unit; None if none is known."""
        if self.angular or self.k > 1:
            return None
        return sqrt(self.n / self.m) * self.lever * equal_row_frame(self.n, self.m).T


def bound_singular_value(*, n: int, m: int, k: int = 1, lever: float = 1.0, angular: bool = False) -> SingularValueBound:
    """Return the upper bound of the least singular value that remains after the worst k of n joints lock.

    Args:
        n: Number of joints.
        m: Number of rows of the task.
        k: Number of joints that lock; every set of k joints may lock.
        lever: Largest distance of the tool point from the joint axes, such as the reach of the arm, m; with angular rows in
            characteristic lengths. The root mean square over the joints is sufficient. Infinite for a pose: any lengths.
        angular: True if some rows are angular, which makes the columns longer.

    Raises:
        InputError: As :func:`upper_bound`; a lever that is not positive, or is infinite although the task is not a pose.

    Source: derived here (``docs/theory/upper-bounds-proofs.md``, S0 to S3).
    """
    upper_bound(n=n, m=m, k=k)  # validates the sizes
    is_pose = angular and m == _POSE_ROWS
    if not lever > 0 or not (is_pose or isfinite(lever)):
        raise InputError(f"the lever is {lever:g}; give a positive length in m, infinite for a pose alone")
    square = lever**2 + angular
    bounds = {"S0": square * (n - k) / m}
    if k == 1:
        bounds["S1"] = square * (n - m) / m
    else:
        trace = n * (n - 1) / (n - 1 + sqrt((n - 1) * (n / m - 1)))
        bounds["S2"] = square * (n / m) * (1 - m / trace)
    if is_pose:
        bounds["S3"] = n * (n - 6) / (3 * (n - 3))
    theorem = min(bounds, key=lambda name: bounds[name])
    return SingularValueBound(n=n, m=m, k=k, lever=lever, angular=angular, bound=sqrt(bounds[theorem]), bound_by=theorem)


def bound_singular_value_of_index(index: SingularValueProblem) -> SingularValueBound | None:
    """Return the upper bound for the arm, the task, and the failures of an index; the lengths of the links bound the levers.

    Args:
        index: Index :func:`holdfast.kinematics.indices.minimum_singular_value`.

    Returns:
        SingularValueBound, or None if a set of this number of joints is missing in the failures, or a prismatic joint has no
        limit.

    Source: derived here.
    """
    k, arm, rows = max_simultaneous_failures(index), index.arm, index.task.rows
    lever, square = float(np.linalg.norm(arm.tool[:3, 3])), 0.0
    for joint in reversed(arm.joints):
        travel = max(abs(joint.lower), abs(joint.upper)) if joint.prismatic else 0.0
        square += 1.0 if joint.prismatic else lever**2
        lever += float(np.linalg.norm(joint.origin[:3, 3])) + travel
    if k is None or not isfinite(square):
        return None
    mean = sqrt(square / arm.n) / index.task.length if abs(rows[:, :3]).max() > 0 else 1.0
    has_both_units = abs(rows[:, :3]).max() > 0 and abs(rows[:, 3:]).max() > 0
    return bound_singular_value(n=arm.n, m=index.task.m, k=k, lever=mean, angular=bool(has_both_units))
