"""Base class of all indices."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import TaskError
from holdfast.core.registry import INDEX_REGISTRY, Labelled
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import HouseholderQR
from holdfast.kernels.program import SX
from holdfast.kinematics.index_bounds.manipulability_bounds import UpperBound
from holdfast.kinematics.indices.objective import Better, Objective, ObjectivePart
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.model.failure_modes import FailureSpec, failure_names, failure_sets
from holdfast.model.failure_modes.sets import require_redundant

SINGULAR_RATIO = 1e-12
"""A Jacobian is singular if its smallest singular value is at most this multiple of its largest, everywhere in holdfast."""


@dataclass(frozen=True, kw_only=True)
class IndexEvaluation:
    """Values of an index at N configurations, or at one configuration (without the leading N).

    Attributes:
        value: (N,) worst case over the failures.
        by_failure: (N, F) value for each failure, in the order of ``index.failures``.
        worst: (N,) position in ``index.failures`` of the worst failure; the first one of several.
        status: (N,) ``OK``, ``SINGULAR`` (value by convention), ``BAD_INPUT``, or ``UNDEFINED`` if the formula of a
            user-defined index gives NaN.
    """

    value: FloatArray
    by_failure: FloatArray
    worst: IndexArray
    status: NDArray[np.uint8]


@dataclass(frozen=True)
class WorstCase:
    """Worst failure at N configurations, or at one: a part of :class:`IndexEvaluation`.

    Attributes:
        value, worst, status: (N,) each, as in :class:`IndexEvaluation`.
    """

    value: FloatArray
    worst: IndexArray
    status: NDArray[np.uint8]


class Index(Labelled, Objective):
    """Number that rates a configuration by its worst case after any one of a set of failures.

    Args:
        name: Name for people and files.
        arm: Arm model.
        task: :class:`holdfast.Task`, its name, or row names such as ``["vx", "vy"]``.
        failures: ``"single"``, ``"pairs"``, a number k (every k joints), or sets of joints by name or index from 0.
        length: Characteristic length, m, that divides linear rows; default: that of the task, 1 m.

    Attributes:
        failures: Sets of joints, indices from 0, that fail together.
        unit: Unit of the value; ``1`` if it has none.
        better: ``"larger"`` or ``"smaller"``, the better direction.
        source: Paper and equation.
        bound: Best value of any configuration, or None if it is unlimited.
        bound_note: Phrase on how closely the bound can be approached; empty if some Jacobian of this size attains it.
        ceiling: Bound and best known value for all arms of this size, or None.
    """

    better: Better = "larger"
    source = ""
    bound: float | None = None
    bound_note = ""
    ceiling: UpperBound | None = None

    @check_arguments
    def __init__(
        self,
        name: str,
        arm: Arm,
        task: str | Task | Sequence[str] = "pose",
        *,
        failures: FailureSpec = "single",
        length: float | None = None,
    ) -> None:
        self.name = name
        self.arm = arm
        self.task = as_task(arm, task, length)
        self.failures = failure_sets(arm, failures)
        require_redundant(arm, self.task.m, self.task.name, self.failures)

    @property
    def best_known(self) -> float | None:
        """Largest value that some Jacobian of this size is known to attain; None if no value is known."""
        return None if self.ceiling is None else self.ceiling.best_known

    @property
    def is_attained(self) -> bool:
        """True if the best known value equals the bound."""
        return self.ceiling is not None and self.ceiling.is_attained

    # ---- methods of a formula -------------------------------------------------------------------------------

    @abstractmethod
    def _evaluate_by_failure(self, q: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Return values (N, F), NaN where q (N, n) is not finite, and which rows are singular (N,)."""

    @abstractmethod
    def _evaluate_gradient(self, q: FloatArray) -> FloatArray:
        """Return the gradient (N, n) of the worst case, NaN where q (N, n) is not finite."""

    # ---- evaluation --------------------------------------------------------------------------------------

    @property
    def singular_value_by_convention(self) -> float:
        """Value at a singular configuration: 0, or infinity if smaller is better."""
        return 0.0 if self.better == "larger" else np.inf

    @cached_property
    def failure_names(self) -> list[str]:
        """Names of the failed joints, joined by ``+`` if several fail together."""
        return failure_names(self.arm, self.failures)

    def evaluate(self, q: ArrayLike) -> IndexEvaluation:
        """Return value, value per failure, worst failure and status in one pass.

        Args:
            q: (n,) or (N, n) configurations, rad and m.

        Raises:
            InputError: A wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = self._read_configurations(q)
        by_failure, singular = self._evaluate_by_failure(rows)
        # NaN if any value is NaN.
        worst_failures = by_failure.argmin(axis=1) if self.better == "larger" else by_failure.argmax(axis=1)
        worst = worst_failures.astype(np.int64, copy=False)
        value = by_failure.ravel().take(worst + np.arange(0, by_failure.size, by_failure.shape[1]))
        status = np.full(len(rows), Status.OK, dtype=np.uint8)
        status[singular] = Status.SINGULAR
        unknown = np.isnan(value)
        if unknown.any():
            status[unknown] = np.where(np.isfinite(rows[unknown]).all(axis=1), Status.UNDEFINED, Status.BAD_INPUT)
        selection = 0 if single else slice(None)
        return IndexEvaluation(
            value=value[selection], by_failure=by_failure[selection], worst=worst[selection], status=status[selection]
        )

    def worst_case(self, q: ArrayLike) -> WorstCase:
        """Return value, worst failure and status without the other failures, for very many configurations.

        Args:
            q: (n,) or (N, n) configurations, rad and m.

        Raises:
            InputError: As :meth:`evaluate`.
        """
        evaluation = self.evaluate(q)
        return WorstCase(evaluation.value, evaluation.worst, evaluation.status)

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the worst case, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m; 0 at a singular configuration."""
        return self.evaluate(q).value

    def by_joint(self, q: ArrayLike) -> FloatArray:
        """Return the value for each failure (single failures: each joint), (N, F) or (F,), at ``q`` (N, n) or (n,)."""
        return self.evaluate(q).by_failure

    def worst_failure(self, q: ArrayLike) -> IndexArray:
        """Return the position in ``failures`` of the worst one, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m."""
        return self.evaluate(q).worst

    def worst_joint(self, q: ArrayLike) -> IndexArray:
        """Return the index from 0 of the joint with the worst failure, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m.

        Raises:
            TaskError: Several joints fail together; use :meth:`worst_failure` instead.
        """
        if any(len(failure) != 1 for failure in self.failures):
            raise TaskError(f"{self.name}: several joints fail together here; use worst_failure and failure_names")
        return np.array([failure[0] for failure in self.failures], dtype=np.int64)[self.evaluate(q).worst]

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the exact gradient of the worst case at ``q`` (N, n) or (n,), of the same shape, per rad and m.

        If two failures tie, the gradient is that of the first. It is 0 at a singular configuration and where the worst case is
        constantly 0 (both are kinks or constants), and NaN where q is NaN.
        """
        rows, single = self._read_configurations(q)
        gradient = self._evaluate_gradient(rows)
        return gradient[0] if single else gradient

    def singular(self, q: ArrayLike) -> BoolArray:
        """Return True where the task Jacobian of the healthy arm is singular, (N,) or a scalar, at ``q`` (N, n) or (n,)."""
        rows, single = self._read_configurations(q)
        finite: BoolArray = np.asarray(np.isfinite(rows).all(axis=1))
        result = self._is_singular(np.where(finite[:, None], rows, 0.0)) & finite
        return result[0] if single else result

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Return for optimisation one smooth function of q per failure; their minimum is largest where the index is best.

        Args:
            q: (n,) symbols of the configuration.
            j: Jacobian that was factored.
            qr: Factorisation of j.
            directions: (n,) vectors, a basis of the null space of J.

        Returns:
            F scores, and their derivatives along each direction, F lists.

        Raises:
            TaskError: The index is not one symbolic program.
        """
        raise TaskError(f"{self.name} cannot be optimised: it has no scores; use one of the built-in indices or a CustomIndex")

    def value_of_score(self, score: SX) -> SX:
        """Return the value (negative if smaller is better) of a ``score``, an increasing function of it."""
        return score

    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return the scores as one part; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Objective.parts`."""
        return [ObjectivePart(1.0, *self.scores(q, j, qr, directions))]

    def exact_parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return the values as one part; ``q``, ``j``, ``qr``, ``directions`` as in :meth:`Objective.exact_parts`."""
        scores, derivatives = self.scores(q, j, qr, directions)
        score_symbol = ca.SX.sym("score")
        value = self.value_of_score(score_symbol)
        value_and_rate = ca.Function("value", [score_symbol], [value, ca.gradient(value, score_symbol)])
        values, exact = [], []
        for score, row in zip(scores, derivatives, strict=True):
            v, rate = value_and_rate(score)
            values.append(v)
            exact.append([rate * x for x in row])
        return [ObjectivePart(1.0, values, exact)]

    def row_statuses(self, q: FloatArray) -> NDArray[np.uint8]:
        """Return ``SINGULAR`` for rows of ``q`` (N, n) whose value is a convention; see :meth:`Objective.row_statuses`."""
        return self.evaluate(q).status

    @property
    def own_task(self) -> Task:
        """Task of the index."""
        return self.task

    def with_failures(self, failures: FailureSpec) -> Index:
        """Return the same index over other ``failures``, in any form that the constructor accepts.

        Raises:
            InputError: The index has a user-defined class.
        """
        return by_name(INDEX_REGISTRY.label(self), self.arm, self.task, failures=failures)

    # ---- shared machinery --------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def _task_jacobian(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("task jacobian", [q], [self.task.jacobian(self.arm, q)])

    def task_jacobian(self, q: FloatArray) -> FloatArray:
        """Return task Jacobians (N, m, n) at ``q`` (N, n), rad and m, linear rows divided by the characteristic length."""
        return self._task_jacobian.rows(q).reshape(-1, self.task.m, self.arm.n)

    def _is_singular(self, q: FloatArray) -> BoolArray:
        """Return which rows are singular by definition, from singular values of the task Jacobian."""
        if not len(q):
            return np.zeros(0, dtype=bool)
        singular_values = np.linalg.svd(self.task_jacobian(q), compute_uv=False)
        return np.asarray(singular_values[:, -1] <= SINGULAR_RATIO * singular_values[:, 0])

    def _read_configurations(self, q: ArrayLike) -> tuple[FloatArray, bool]:
        return as_configurations(self.arm, q)

    @property
    def slug(self) -> str:
        """Name on the command line and in files."""
        return self.name.replace(" ", "-")

    def describe(self) -> str:
        """Return a phrase with the name of the index, its task and its failures."""
        kinds = {len(s) for s in self.failures}
        failures_text = (
            "any one joint" if kinds == {1} and len(self.failures) == self.arm.n else f"{len(self.failures)} failure sets"
        )
        return f"worst-case {self.name} over {failures_text}, task {self.task.describe()}"

    def __repr__(self) -> str:
        return f"<{self.describe()}, arm {self.arm.name!r}>"


@check_arguments
def by_name(
    name: str,
    arm: Arm,
    task: str | Task | Sequence[str] = "pose",
    *,
    failures: FailureSpec = "single",
    length: float | None = None,
) -> Index:
    """Return the built-in index with the label ``name``: ``relative-manipulability``, or ``directional-velocity:0,0,1``.

    ``arm``, ``task``, ``failures`` and ``length`` (m) are the arguments of :class:`Index`.

    Raises:
        TaskError: There is no such index; the message contains the nearest name and all names.
        InputError: A setting is missing, or the index does not have it.
    """
    index: Index = INDEX_REGISTRY.make(name, arm, task=task, failures=failures, length=length)
    return index
