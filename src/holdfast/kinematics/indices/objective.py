"""Objectives for choosing configurations: a number, the better direction, and its form for the optimiser."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, TaskError
from holdfast.core.result import Presentable
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.kernels.frameworks.rows import Differentiable, RowFunction
from holdfast.kernels.linalg import HouseholderQR, select_at_smallest
from holdfast.kernels.program import SX
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

Better = Literal["larger", "smaller"]


@dataclass(frozen=True)
class ObjectivePart:
    """Term ``weight * min(values)`` of the sum that the optimiser maximises.

    Attributes:
        weight: Number above 0.
        values: F scalars.
        slopes: F lists of their derivatives along each null-space direction.
    """

    weight: float
    values: list[SX]
    slopes: list[list[SX]]


class Objective(Presentable, Differentiable, ABC):
    """Number that :func:`holdfast.optimise` improves: an index, a susceptibility, or a weighted sum of them.

    Objectives of one arm can be added, subtracted and multiplied by numbers: ``rho - 1e-4 * torque``.

    Attributes:
        name: Name for people and files.
        arm: Arm model.
        better: ``"larger"`` or ``"smaller"``, the better direction.
        unit: Unit of the value; ``1`` if it has none.
    """

    name: str
    arm: Arm
    better: Better
    unit: str = "1"

    @cached_property
    def _compiled_ascents(self) -> dict[object, Any]:
        """Compiled ascents of this objective, for :func:`holdfast.kinematics.solvers.optimum.get_cached_ascent`."""
        return {}

    @abstractmethod
    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the value, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m."""

    @abstractmethod
    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the exact gradient at ``q`` (N, n) or (n,), of the same shape, per rad and m; NaN where q is NaN."""

    def row_function(self) -> RowFunction:
        """Return the batch function; see :meth:`holdfast.kernels.frameworks.Differentiable.row_function`."""
        return RowFunction(name=self.name, sizes=(self.arm.n,), size=None, value=self, slopes=lambda q: (self.gradient(q),))

    @abstractmethod
    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return terms whose sum is largest where the objective is best.

        Args:
            q: (n,) symbols of the configuration.
            j: Jacobian that was factored.
            qr: Factorisation of j.
            directions: (n,) vectors, a basis of the null space of J.

        Raises:
            TaskError: The objective is not one symbolic program.
        """

    def exact_parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return terms whose sum equals the value (its negative if smaller is better), so that it can be added to others.

        ``q``, ``j``, ``qr`` and ``directions`` are as in :meth:`parts`.
        """
        return self.parts(q, j, qr, directions)

    @property
    def measured(self) -> SX | None:
        """Symbols (k,) in :meth:`parts` for numbers that :meth:`measure` computes; None if the objective is one program."""
        return None

    def measure(self, q: FloatArray) -> FloatArray:
        """Return the numbers (N, k) for the symbols :attr:`measured`, at ``q`` (N, n), rad and m."""
        return np.empty((len(q), 0))

    def row_statuses(self, q: FloatArray) -> NDArray[np.uint8]:
        """Return the status of each row of ``q`` (N, n): ``SINGULAR`` where the value is a convention."""
        return np.full(len(q), Status.OK, dtype=np.uint8)

    @property
    def own_task(self) -> Task | None:
        """Task for which the objective is defined; None if it is defined for every task."""
        return None

    def reversed(self) -> Objective:
        """Return the objective with the opposite better direction, to find the worst configuration."""
        return NegatedObjective(self)

    # ---- arithmetic --------------------------------------------------------------------------------------------

    def __mul__(self, factor: float) -> WeightedSum:
        return WeightedSum([(factor, self)])

    __rmul__ = __mul__

    def __neg__(self) -> WeightedSum:
        return self * -1.0

    def __add__(self, other: Objective) -> WeightedSum:
        if not isinstance(other, Objective):
            return NotImplemented
        return WeightedSum([(1.0, self), (1.0, other)])

    def __sub__(self, other: Objective) -> WeightedSum:
        if not isinstance(other, Objective):
            return NotImplemented
        return WeightedSum([(1.0, self), (-1.0, other)])


@check_constructor
class WeightedSum(Objective):
    """Weighted sum of objectives, such as those of English & Maciejewski 1998, section VII, and Abdi et al. 2012.

    All summands must have the same better direction: a susceptibility (smaller is better) in a sum with an index (larger is
    better) needs a weight of the opposite sign. The better direction of the sum is that of its first summand.

    Args:
        terms: Pairs of a weight, a number that is not 0, and an objective, all of one arm.
        name: Name for people; default: composed of the summands.

    Attributes:
        terms: Weights and summands, with sums expanded.

    Raises:
        InputError: There is no summand, a weight is 0 or not finite, or the summands have different arms.
        TaskError: The summands have opposite better directions, or are defined for different tasks.
    """

    def __init__(self, terms: Sequence[tuple[float, Objective]], name: str | None = None) -> None:
        terms_list: list[tuple[float, Objective]] = []
        for weight, objective in terms:
            try:
                factor = float(weight)
            except (TypeError, ValueError) as error:
                raise InputError(f"the weight {weight!r} of {objective.name} is not a number") from error
            if not np.isfinite(factor) or factor == 0:
                raise InputError(f"the weight of {objective.name} is {factor:g}; it must be finite and not 0")
            if isinstance(objective, WeightedSum):
                terms_list += [(factor * inner_weight, summand) for inner_weight, summand in objective.terms]
            else:
                terms_list.append((factor, objective))
        if not terms_list:
            raise InputError("a weighted sum needs at least one objective")
        self.terms: tuple[tuple[float, Objective], ...] = tuple(terms_list)
        first = terms_list[0][1]
        self.arm = first.arm
        directions = []
        for factor, objective in terms_list:
            if objective.arm.fingerprint != self.arm.fingerprint:
                raise InputError(f"{objective.name} belongs to '{objective.arm.name}', not to '{self.arm.name}'; use one arm")
            directions.append((objective.better == "larger") == (factor > 0))
        if len(set(directions)) > 1:
            other = terms_list[directions.index(not directions[0])][1]
            raise TaskError(
                f"{first.name} is better when {first.better} and {other.name} when {other.better}, but their weights pull "
                "different ways: change the sign of one of them"
            )
        self.better = "larger" if directions[0] else "smaller"
        self.name = name or " ".join(
            f"{'+' if factor > 0 else '-'} {abs(factor):g} x {summand.name}" for factor, summand in terms_list
        ).removeprefix("+ ")
        units = {summand.unit for _, summand in terms_list}
        self.unit = units.pop() if len(units) == 1 else "mixed"
        tasks = [summand.own_task for _, summand in terms_list if summand.own_task is not None]
        for task in tasks[1:]:
            if not task.same_rows(tasks[0]):
                raise TaskError(
                    f"{self.name}: its summands are defined for the tasks '{tasks[0].name}' and '{task.name}'; use one"
                )
        self._task = tasks[0] if tasks else None

    @property
    def own_task(self) -> Task | None:
        """Task of the summands."""
        return self._task

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the value, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m."""
        return np.asarray(sum(w * objective(q) for w, objective in self.terms))

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the exact gradient at ``q`` (N, n) or (n,), of the same shape, per rad and m."""
        return np.asarray(sum(w * objective.gradient(q) for w, objective in self.terms))

    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return the parts of the summands; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Objective.parts`."""
        return [
            ObjectivePart(abs(w) * part.weight, part.values, part.slopes)
            for w, objective in self.terms
            for part in objective.exact_parts(q, j, qr, directions)
        ]

    @property
    def measured(self) -> SX | None:
        """Symbols of the summands; see :attr:`Objective.measured`."""
        symbols = [o.measured for _, o in self.terms if o.measured is not None]
        return ca.vertcat(*symbols) if symbols else None

    def measure(self, q: FloatArray) -> FloatArray:
        """Return the numbers (N, k) of the summands at ``q`` (N, n); see :meth:`Objective.measure`."""
        return np.concatenate([o.measure(q) for _, o in self.terms], axis=1)

    def row_statuses(self, q: FloatArray) -> NDArray[np.uint8]:
        """Return for each row of ``q`` (N, n) the first status of a summand that is not ``OK``."""
        combined = np.full(len(q), Status.OK, dtype=np.uint8)
        for _, objective in self.terms:
            combined = np.where(combined == Status.OK, objective.row_statuses(q), combined)
        return combined

    def __repr__(self) -> str:
        return f"<{self.name}, arm {self.arm.name!r}>"


@check_constructor
class NegatedObjective(Objective):
    """Objective with the opposite better direction, to find the worst configuration of a pose.

    Multiplication by -1 differs: it changes the sign and the better direction, so the best configuration remains the best. The
    worst value of an index often lies in a crease, where a failure removes all manipulability; the optimiser zigzags into the
    crease and finds it less reliably than the best value.

    Args:
        objective: Objective to make as bad as possible.

    Attributes:
        objective: Original objective.
    """

    def __init__(self, objective: Objective) -> None:
        self.objective = objective
        self.name, self.arm, self.unit = objective.name, objective.arm, objective.unit
        self.better = "smaller" if objective.better == "larger" else "larger"

    def reversed(self) -> Objective:
        """Return the original objective."""
        return self.objective

    @property
    def own_task(self) -> Task | None:
        """Task of the objective."""
        return self.objective.own_task

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the value of the objective, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m."""
        return self.objective(q)

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the gradient of the objective at ``q`` (N, n) or (n,), of the same shape, per rad and m."""
        return self.objective.gradient(q)

    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return negated parts, of several failures the first; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`parts`."""
        opposed = []
        for part in self.objective.exact_parts(q, j, qr, directions):
            derivative, value = select_at_smallest(part.values, [ca.vertcat(*row) for row in part.slopes])
            opposed.append(ObjectivePart(part.weight, [-value], [[-derivative[k] for k in range(len(directions))]]))
        return opposed

    @property
    def measured(self) -> SX | None:
        """Symbols of the objective; see :attr:`Objective.measured`."""
        return self.objective.measured

    def measure(self, q: FloatArray) -> FloatArray:
        """Return the numbers (N, k) of the objective at ``q`` (N, n); see :meth:`Objective.measure`."""
        return self.objective.measure(q)

    def row_statuses(self, q: FloatArray) -> NDArray[np.uint8]:
        """Return the status of each row of ``q`` (N, n); see :meth:`Objective.row_statuses`."""
        return self.objective.row_statuses(q)

    def __repr__(self) -> str:
        return f"<{self.name}, {self.better} wanted, arm {self.arm.name!r}>"
