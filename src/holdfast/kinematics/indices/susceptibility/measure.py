"""Susceptibility of an arm at rest: the effect of a free-swinging failure of each joint, combined into one number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.registry import SUSCEPTIBILITY_REGISTRY, Labelled, Parameter, constructor
from holdfast.core.status import Status, require_ok
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.frameworks.rows import RowFunction
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import HouseholderQR
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.objective import Objective, ObjectivePart
from holdfast.kinematics.indices.susceptibility.formulas import (
    ACCELERATION_FORMULA,
    SWING_ANGLE_FORMULA,
    TORQUE_FORMULA,
    SusceptibilityFormula,
)
from holdfast.kinematics.indices.susceptibility.weights import WeightSpec, weight_matrix
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.model import Arm


@dataclass(frozen=True, kw_only=True)
class SusceptibilityEvaluation:
    """Values of a susceptibility at N configurations, or at one configuration (without the leading N).

    Attributes:
        value: (N,) combination of the joints by the weights, ``f' W f``.
        by_joint: (N, n) signed measure f of each joint, in ``measure.joint_unit``.
        status: (N,) ``Status.OK``, ``BAD_INPUT``, or ``NO_INERTIA`` if a joint has no acceleration.
        joint_status: (N, n) :class:`holdfast.Status` of each joint.
    """

    value: FloatArray
    by_joint: FloatArray
    status: NDArray[np.uint8]
    joint_status: NDArray[np.uint8]

    def require_ok(self) -> SusceptibilityEvaluation:
        """Return the object itself, or raise :class:`holdfast.HoldfastError`, which names the first row without a value."""
        require_ok(self.status, "susceptibility")
        return self


class Susceptibility(Labelled, Objective):
    r"""Effects :math:`f` of the failure of each joint, combined as :math:`F = f^\top W f`; smaller is better.

    The arm is at rest, its links are rigid, and no joint holds by friction. Measures are signed: the holding torque of the
    joint, and the direction in which it would accelerate or swing, about ``+z`` of its axis; reversing an axis reverses its f.

    Source: English and Maciejewski 1998, eq. (1)-(4). The paper prints f' W f without stating whether half of it is meant.

    Attributes:
        arm: Arm model.
        formula: Measure of each joint.
        weights: (n, n) symmetric matrix W. The argument may be None, n numbers, a matrix, ``"effort"`` or ``"worst-case"``.
        better: ``"smaller"``.
    """

    def __init__(self, formula: SusceptibilityFormula, arm: Arm, weights: WeightSpec = None) -> None:
        formula.check(arm)
        self.formula, self.arm = formula, arm
        self.name, self.better = f"{formula.name} susceptibility", "smaller"
        self.weights, self._weighting = weight_matrix(arm, weights, formula is TORQUE_FORMULA, formula.name)
        self.weights.setflags(write=False)
        self.unit = self._value_unit()

    # ---- names ------------------------------------------------------------------------------------

    @property
    def slug(self) -> str:
        """Name on the command line and in files."""
        return self.formula.name.replace(" ", "-")

    @property
    def settings(self) -> dict[str, Any]:
        """Weights as given by the user: None for the identity, a word, n numbers, or a matrix."""
        by_word = {"identity": None, "diagonal": np.diag(self.weights), "full": self.weights}
        return {"weights": by_word.get(self._weighting, self._weighting)}

    @property
    def source(self) -> str:
        """Paper and equations."""
        return self.formula.source

    @property
    def joint_unit(self) -> tuple[str, ...]:
        """Unit of each joint's measure; the swing angle of a prismatic joint is 0 by convention."""
        return tuple(self.formula.sliding if is_prismatic else self.formula.turning for is_prismatic in self.arm.prismatic)

    def _value_unit(self) -> str:
        if self.formula.total is not None:
            return self.formula.total_unit
        if self._weighting in ("effort", "worst-case"):
            return "1"
        square = ", ".join(f"({unit})^2" for unit in dict.fromkeys(self.joint_unit))
        mixed = " mixed" if len(set(self.joint_unit)) > 1 else ""
        return square + mixed + ("" if self._weighting == "identity" else ", weighted")

    def describe(self) -> str:
        """Return a phrase with the name of the measure and the kind of its weights."""
        return f"{self.name} after any one joint swings free, {self._weighting} weights"

    def __repr__(self) -> str:
        return f"<{self.describe()}, arm {self.arm.name!r}>"

    # ---- symbols -----------------------------------------------------------------------------------------------

    def by_joint_expression(self, q: SX) -> SX:
        """Return the measure of every joint (n,) as a function of the symbols ``q`` (n,), with its conventions."""
        return ca.densify(self.formula.values(self.arm, q)[0])

    def expression(self, q: SX) -> SX:
        """Return ``f' W f`` of the symbols ``q`` (n,); it is smooth unless a joint becomes degenerate or hangs upright."""
        return self._total(q, self.by_joint_expression(q))

    def gradient_expression(self, q: SX) -> SX:
        """Return the gradient (n,) of ``f' W f``, eq. (3), of the symbols ``q`` (n,); 0 for a degenerate joint.

        It comes from differentiation of the formula. For the Panda this takes 312, 917 and 586 operations for torque,
        acceleration and swing angle (measured), and the paper's closed forms take 851, 2287 and 1935 (see
        ``formula.jacobian``).
        """
        return ca.densify(ca.gradient(self.expression(q), q))

    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return ``-f' W f`` and its slopes; ``q``, ``j``, ``qr``, ``directions`` as in ``Objective.parts``."""
        value = self.expression(q)
        derivative = ca.densify(ca.gradient(value, q))
        return [ObjectivePart(1.0, [-value], [[-ca.dot(derivative, v) for v in directions]])]

    def _total(self, q: SX, f: SX) -> SX:
        return self._weighted_square_sum(f) if self.formula.total is None else self.formula.total(self.arm, q, f)

    def _weighted_square_sum(self, f: SX) -> SX:
        # A joint without weight does not count, also if its own measure is NaN.
        weights = ca.sparsify(ca.SX(ca.DM(self.weights)))
        return ca.SX(ca.densify(ca.dot(f, weights @ f)))

    @cached_property
    @cached_kernel
    def _values_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        f, degenerate = self.formula.values(self.arm, q)
        return Kernel(self.name, [q], [self._total(q, f), f, degenerate])

    @cached_property
    @cached_kernel
    def _gradient_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel(f"{self.name} gradient", [q], [self.gradient_expression(q)])

    @cached_property
    @cached_kernel
    def _jacobian_kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel(f"{self.name} jacobian", [q], [ca.jacobian(self.by_joint_expression(q), q)])

    # ---- evaluation --------------------------------------------------------------------------------------

    def evaluate(self, q: ArrayLike) -> SusceptibilityEvaluation:
        """Return value, measure of each joint, and the status of both, in one pass.

        Args:
            q: (n,) or (N, n) configurations, rad and m.

        Raises:
            InputError: A wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = as_configurations(self.arm, q)
        n = self.arm.n
        outputs = self._values_kernel.rows(rows)
        value, by_joint = outputs[:, 0].copy(), outputs[:, 1 : n + 1].copy()
        joint_status = np.where(outputs[:, n + 1 :] > 0, Status.DEGENERATE, Status.OK).astype(np.uint8)
        if not self.formula.slides:
            joint_status[:, self.arm.prismatic] = Status.NOT_DEFINED
        joint_status[np.isnan(by_joint)] = Status.NO_INERTIA
        is_invalid = ~np.isfinite(rows).all(axis=1)
        joint_status[is_invalid] = Status.BAD_INPUT
        status = np.where(np.isnan(value), Status.NO_INERTIA, Status.OK).astype(np.uint8)
        status[is_invalid] = Status.BAD_INPUT
        selection = 0 if single else slice(None)
        return SusceptibilityEvaluation(
            value=value[selection], by_joint=by_joint[selection], status=status[selection], joint_status=joint_status[selection]
        )

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return ``f' W f``, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m; eq. (2)."""
        rows, single = as_configurations(self.arm, q)
        value = self._values_kernel.rows(rows, first=1)[:, 0]
        return value[0] if single else value

    def by_joint(self, q: ArrayLike) -> FloatArray:
        """Return the signed measure f of each joint at ``q`` (N, n) or (n,), of the same shape, in :attr:`joint_unit`."""
        rows, single = as_configurations(self.arm, q)
        f = self._values_kernel.rows(rows)[:, 1 : self.arm.n + 1].copy()
        return f[0] if single else f

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the gradient of ``f' W f`` at ``q`` (N, n) or (n,), per rad and m; eq. (3). NaN where q or the value is."""
        rows, single = as_configurations(self.arm, q)
        gradient = self._gradient_kernel.rows(rows)
        return gradient[0] if single else gradient

    def row_function(self) -> RowFunction:
        """Return the batch function; see :meth:`holdfast.kernels.frameworks.Differentiable.row_function`."""
        return replace(super().row_function(), kernels=(self._values_kernel, self._gradient_kernel))

    def jacobian(self, q: ArrayLike) -> FloatArray:
        """Return ``out[..., i, j] = d f_i / d q_j``, (..., n, n), at ``q`` (N, n) or (n,), rad and m; eq. (4).

        The row of a degenerate joint is 0.
        """
        rows, single = as_configurations(self.arm, q)
        derivatives = self._jacobian_kernel.rows(rows).reshape(-1, self.arm.n, self.arm.n)
        return derivatives[0] if single else derivatives


class SusceptibilityBatch:
    """Several susceptibilities of one arm with their gradients, from one kernel that computes shared terms once.

    Args:
        measures: One or more susceptibilities of one arm.

    Raises:
        InputError: There is no measure, or the measures have different arms.
    """

    def __init__(self, measures: Sequence[Susceptibility]) -> None:
        self.measures = tuple(measures)
        if not self.measures or any(m.arm is not self.measures[0].arm for m in self.measures):
            raise InputError("measures to evaluate together must be at least one, and all of the same arm")
        self.arm = self.measures[0].arm

    @cached_property
    @cached_kernel
    def _kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        values = [m.expression(q) for m in self.measures]
        return Kernel("susceptibilities", [q], [ca.vertcat(*values), *[ca.gradient(v, q) for v in values]])

    def __call__(self, q: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return values and gradients of all measures.

        Args:
            q: (n,) or (N, n) configurations, rad and m.

        Returns:
            Values (N, k) and gradients (N, k, n) of the k measures, or (k,) and (k, n) for one configuration.

        Raises:
            InputError: A wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = as_configurations(self.arm, q)
        outputs = self._kernel.rows(rows)
        count = len(self.measures)
        values = np.ascontiguousarray(outputs[:, :count])
        gradients = np.ascontiguousarray(outputs[:, count:]).reshape(-1, count, self.arm.n)
        return (values[0], gradients[0]) if single else (values, gradients)


def _one_to_n(arm: Arm, task: object) -> FloatArray:
    del task
    return np.arange(1.0, arm.n + 1)


Weights = Annotated[WeightSpec, Parameter("1", "one number per joint, 0 or larger", example="_one_to_n")]


@constructor(needs=("inertia",))
def torque(
    arm: Arm,
    weights: Annotated[
        WeightSpec, Parameter("1", "effort, worst-case, or one number per joint, 0 or larger", example="_one_to_n")
    ] = None,
) -> Susceptibility:
    """The torque or force that holds each joint against gravity; English and Maciejewski 1998, eq. (7), (8), (12).

    ``arm`` is the model; ``weights`` are those of :class:`Susceptibility`.

    Raises:
        ArmError: The inertia of a link is unknown.
        InputError: The weights are not positive semidefinite, or do not fit the arm.
    """
    return Susceptibility(TORQUE_FORMULA, arm, weights)


@constructor(needs=("inertia",))
def acceleration(arm: Arm, weights: Weights = None) -> Susceptibility:
    """The acceleration of each joint as it fails with the others fixed; English and Maciejewski 1998, eq. (22).

    ``arm`` is the model; ``weights`` are numeric, as for :class:`Susceptibility`. Armature counts as inertia. The acceleration
    is NaN if all the mass that a revolute joint carries lies on its axis.

    Raises:
        ArmError: The mass or inertia of a link is unknown or impossible, or a joint carries no mass.
        InputError: The weights are not positive semidefinite, do not fit the arm, or are named after torques.
    """
    return Susceptibility(ACCELERATION_FORMULA, arm, weights)


@constructor(needs=("inertia",))
def swing_angle(arm: Arm, weights: Weights = None) -> Susceptibility:
    """The angle that each revolute joint swings, the others fixed, until it hangs; English and Maciejewski 1998, eq. (36)-(39).

    ``arm`` is the model; ``weights`` are numeric, as for :class:`Susceptibility`. The angle lies in (-pi, pi] and ignores joint
    limits and obstacles. It and its gradient are 0 for a prismatic joint, for a balanced one and if gravity runs along the
    axis; near those cases it changes abruptly, and at pi it is discontinuous.

    Raises:
        ArmError: The mass of a link is unknown.
        InputError: The weights are not positive semidefinite, do not fit the arm, or are named after torques.
    """
    return Susceptibility(SWING_ANGLE_FORMULA, arm, weights)


@check_arguments
def by_name(name: str, arm: Arm, weights: WeightSpec = None) -> Susceptibility:
    """Return the susceptibility of ``arm`` with the label ``name``: ``torque``, or ``torque:effort``; or with ``weights``.

    Raises:
        InputError: There is no such measure; the message contains the nearest name and all names.
    """
    options: dict[str, Any] = {} if weights is None else {"weights": weights}
    susceptibility: Susceptibility = SUSCEPTIBILITY_REGISTRY.make(name, arm, **options)
    return susceptibility
