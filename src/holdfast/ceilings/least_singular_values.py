"""What no Jacobian can keep of its least singular value when joints lock: it has a unit, so the lengths of columns count."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite, sqrt
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.ceilings.ceiling import OfArm, OfFailures, OfTask, at_once, look_up, rows_of, when
from holdfast.ceilings.frames import equal_rows
from holdfast.errors import InputError
from holdfast.result import Result

Array = NDArray[np.float64]

REASONS = {
    "S0": "the mean over all sets of joints",
    "S1": "one failure: isotropy and columns of one length",
    "S2": "every two failures: blocks of two rows",
    "S3": "the three angular rows, whatever the lengths",
}
_POSE = 6


class OfJoint(Protocol):
    """A joint of an arm."""

    @property
    def origin(self) -> Array:
        """(4, 4) in the frame of the one before, m."""

    @property
    def prismatic(self) -> bool:
        """Whether it slides."""

    @property
    def lower(self) -> float:
        """Limit, rad or m."""

    @property
    def upper(self) -> float:
        """Limit, rad or m."""


class JointedArm(OfArm, Protocol):
    """What bounds the levers: an index's arm."""

    @property
    def joints(self) -> Sequence[OfJoint]:
        """In order."""

    @property
    def tool(self) -> Array:
        """(4, 4) of the tool in the last joint's frame, m."""


class RowsOfTask(OfTask, Protocol):
    """What says the unit: an index's task."""

    @property
    def rows(self) -> Array:
        """(m, 6) linear columns first."""

    @property
    def length(self) -> float:
        """Characteristic length, m."""


class OfSingularValue(OfFailures, Protocol):
    """What a ceiling of the least singular value is asked for: an index with its arm, its task and its failures."""

    @property
    def arm(self) -> JointedArm:
        """Its arm."""

    @property
    def task(self) -> RowsOfTask:
        """Its task."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SingularValueCeiling(Result):
    """The ceiling of the worst-case least singular value of n columns in m rows.

    Attributes:
        n, m, k: Joints, rows of the task, joints that lock at once.
        lever: Root mean square, over the joints, of how far the tool point is from their axes at most: m, or characteristic
            lengths where rows are mixed; infinite if it may be anything.
        angular: True where angular rows are among the rows: three linear and three angular ones of a pose, for example.
        bound: No Jacobian has more, in the unit of ``lever``.
        bound_by: S0 to S3 of ``docs/ceilings.md``.
    """

    n: int
    m: int
    k: int
    lever: float
    angular: bool
    bound: float
    bound_by: str

    @property
    def jacobian(self) -> Array | None:
        """(m, n) that attains the bound: where one joint locks, rows of one unit; None where none is known."""
        if self.angular or self.k > 1:
            return None
        return sqrt(self.n / self.m) * self.lever * equal_rows(self.n, self.m).T

    def describe(self) -> list[str]:
        """The bound, why, and what it supposes."""
        unit = " in characteristic lengths" if self.angular else ""
        lengths = "any lengths" if self.lever == inf else f"mean lever of the joints {self.lever:.4g}{unit or ' m'}"
        why = f"{self.bound_by}, {REASONS[self.bound_by]}{', attained' if self.jacobian is not None else ''}"
        return [
            f"{self.n} joints, a task of {rows_of(self.m)}, {lengths}: when {when(self.k)}, no least singular value is above "
            f"{self.bound:.6g} ({why})"
        ]


def singular_value(*, n: int, m: int, k: int = 1, lever: float = 1.0, angular: bool = False) -> SingularValueCeiling:
    """The ceiling of the least singular value that is left after the worst k of n joints lock.

    Args:
        n: Joints.
        m: Rows of the task.
        k: Every set of k joints may lock.
        lever: How far the tool point is from the joints' axes at most, such as the reach of the arm, m; with angular rows in
            characteristic lengths. The root mean square over the joints will do. Infinite for a pose: any lengths.
        angular: Angular rows are among the rows, so that columns are longer by their unit.

    Raises:
        InputError: As :func:`look_up`; a lever that is not positive, or infinite where the task is no pose.

    Source: derived here (``docs/ceilings.md``, S0 to S3).
    """
    look_up(n=n, m=m, k=k)  # the same sizes have one
    pose = angular and m == _POSE
    if not lever > 0 or not (pose or isfinite(lever)):
        raise InputError(f"the lever is {lever:g}; give a positive length in m, infinite for a pose alone")
    square = lever**2 + angular
    found = {"S0": square * (n - k) / m}
    if k == 1:
        found["S1"] = square * (n - m) / m
    else:
        trace = n * (n - 1) / (n - 1 + sqrt((n - 1) * (n / m - 1)))
        found["S2"] = square * (n / m) * (1 - m / trace)
    if pose:
        found["S3"] = n * (n - 6) / (3 * (n - 3))
    by = min(found, key=lambda name: found[name])
    return SingularValueCeiling(n=n, m=m, k=k, lever=lever, angular=angular, bound=sqrt(found[by]), bound_by=by)


def singular_value_of_index(index: OfSingularValue) -> SingularValueCeiling | None:
    """The ceiling for the arm, the task and the failures of an index: the lengths of the arm's links bound the levers.

    Args:
        index: Of the least singular value, :func:`holdfast.indices.minimum_singular_value`.

    Returns:
        SingularValueCeiling, or None: Not every set of so many joints is among the failures, or a prismatic joint has no limit.

    Source: derived here.
    """
    k, arm, rows = at_once(index), index.arm, index.task.rows
    lever, square = float(np.linalg.norm(arm.tool[:3, 3])), 0.0
    for joint in reversed(arm.joints):
        travel = max(abs(joint.lower), abs(joint.upper)) if joint.prismatic else 0.0
        square += 1.0 if joint.prismatic else lever**2
        lever += float(np.linalg.norm(joint.origin[:3, 3])) + travel
    if k is None or not isfinite(square):
        return None
    mean = sqrt(square / arm.n) / index.task.length if abs(rows[:, :3]).max() > 0 else 1.0
    mixed = abs(rows[:, :3]).max() > 0 and abs(rows[:, 3:]).max() > 0
    return singular_value(n=arm.n, m=index.task.m, k=k, lever=mean, angular=bool(mixed))
