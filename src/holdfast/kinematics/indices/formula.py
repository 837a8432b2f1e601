"""Indices defined by one formula of the reduced Jacobian, including user-defined formulas."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from inspect import signature
from typing import Literal

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError, TaskError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_constructor
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import HouseholderQR, directional_derivatives
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.index import Index
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.failure_modes import FailureSpec

Formula = Callable[..., SX]


class FormulaIndex(Index):
    """Worst case, over the failures, of one formula of the reduced Jacobian, with its exact gradient; base of most indices.

    Raises:
        TaskError: At the first evaluation, if the formula does not return one scalar.
    """

    @abstractmethod
    def formula(self, j: SX) -> SX:
        """Return the scalar value of a reduced task Jacobian ``j``, ``(m, n - |S|)``, linear rows divided by the length."""

    def _evaluate_formula(self, j: SX, q: SX, joints: Sequence[int]) -> SX:
        """Compute the formula for the joints that still work, which are the columns of the Jacobian."""
        del q, joints
        return self.formula(j)

    def _joint_symbols_and_values(self) -> tuple[SX, list[SX]]:
        q = kinematics.joint_symbols(self.arm)
        j = self.task.jacobian(self.arm, q)
        values = []
        for failed in self.failures:
            joints = [k for k in range(self.arm.n) if k not in failed]
            value = self._evaluate_formula(j[:, joints], q, joints)
            if value.shape != (1, 1):
                raise TaskError(f"{self.name}: its formula returned shape {value.shape}; it must return one scalar")
            values.append(value)
        return q, values

    @cached_property
    @cached_kernel
    def _values_kernel(self) -> Kernel:
        q, values = self._joint_symbols_and_values()
        return Kernel(self.name, [q], [ca.vertcat(*values)])

    @cached_property
    @cached_kernel
    def _gradient_kernel(self) -> Kernel:
        q, values = self._joint_symbols_and_values()
        worst = values[0]
        for value in values[1:]:
            worst = ca.if_else(value < worst if self.better == "larger" else value > worst, value, worst)
        return Kernel(f"{self.name} gradient", [q], [ca.gradient(worst, q)])

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Return values, negated if smaller is better; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Index.scores`."""
        symbols, formulas = self._joint_symbols_and_values()
        sign = 1.0 if self.better == "larger" else -1.0
        values = ca.vertsplit(ca.substitute(ca.vertcat(*[sign * value for value in formulas]), symbols, q))
        return values, directional_derivatives(values, q, directions)

    def _evaluate_by_failure(self, q: FloatArray) -> tuple[FloatArray, BoolArray]:
        values = self._values_kernel.rows(q)
        singular = self._singular_rows(q)
        values[singular] = self.singular_value_by_convention
        return values, singular

    def _evaluate_gradient(self, q: FloatArray) -> FloatArray:
        gradient = self._gradient_kernel.rows(q)
        gradient[self._singular_rows(q)] = 0.0
        return gradient

    def _singular_rows(self, q: FloatArray) -> BoolArray:
        singular = np.zeros(len(q), dtype=bool)
        finite = np.flatnonzero(np.isfinite(q).all(axis=1))
        singular[finite] = self._is_singular(q[finite])
        return singular


@check_constructor
class CustomIndex(FormulaIndex):
    """Worst case, over the failures, of ``formula(reduced Jacobian)``, with its exact gradient.

    Args:
        formula: Function ``formula(j)`` or ``formula(j, q, joints)`` that returns a scalar CasADi ``SX``. ``j`` is the reduced
            task Jacobian ``(m, n - |S|)``, ``q`` the configuration ``(n,)``, and ``joints`` the indices from 0 of the joints
            that still work, one for each column of ``j``. The parameters of the function decide between the two forms.
        arm: Arm model.
        task: Task, as for :class:`Index`.
        failures: Failure sets, as for :class:`Index`.
        length: Characteristic length, m, as for :class:`Index`.
        name: Name for people and files.
        unit: Unit of the value.
        better: ``"larger"`` or ``"smaller"``, the better direction.
        bound: Best possible value in the unit of the index, if known.

    Raises:
        TaskError: The formula raises an error, or does not return one scalar.
    """

    def __init__(
        self,
        formula: Formula,
        arm: Arm,
        task: str | Task | Sequence[str] = "pose",
        *,
        failures: FailureSpec = "single",
        length: float | None = None,
        name: str = "custom index",
        better: Literal["larger", "smaller"] = "larger",
        unit: str = "1",
        bound: float | None = None,
    ) -> None:
        super().__init__(name, arm, task, failures=failures, length=length)
        if better not in ("larger", "smaller"):
            raise TaskError(f"{name}: better is '{better}'; it must be 'larger' or 'smaller'")
        self.better, self.unit, self.bound = better, unit, bound
        self._formula = formula

    def formula(self, j: SX) -> SX:
        """Return the user's formula of ``j``; see :meth:`FormulaIndex.formula`."""
        return self._evaluate_formula(j, ca.SX.zeros(0), ())

    def with_failures(self, failures: FailureSpec) -> CustomIndex:
        """Return the same index over other ``failures``; see :meth:`Index.with_failures`."""
        return CustomIndex(
            self._formula,
            self.arm,
            self.task,
            failures=failures,
            name=self.name,
            better=self.better,
            unit=self.unit,
            bound=self.bound,
        )

    def _evaluate_formula(self, j: SX, q: SX, joints: Sequence[int]) -> SX:
        arguments = (j, q, list(joints)) if _takes_joints(self._formula) else (j,)
        try:
            return ca.SX(self._formula(*arguments))
        except HoldfastError:
            raise
        except Exception as error:  # a formula, or CasADi, may raise any error
            reason = str(error).strip().splitlines()[-1] if str(error).strip() else type(error).__name__
            raise TaskError(f"{self.name}: its formula failed for a Jacobian of shape {j.shape}: {reason}") from error


def _takes_joints(formula: Formula) -> bool:
    """Return True for a formula with the required parameters j, q and joints."""
    try:
        parameters = signature(formula).parameters.values()
    except (TypeError, ValueError):  # functions written in C have no signature
        return False
    required = [
        parameter
        for parameter in parameters
        if parameter.default is parameter.empty
        and parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD)
    ]
    return len(required) == 3
