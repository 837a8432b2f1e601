"""The base class of all indices."""

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
"""A Jacobian is singular if its smallest singular value is at most this times its largest: the same everywhere."""


@dataclass(frozen=True, kw_only=True)
class IndexEvaluation:
    """An index at N configurations, or at one (then without the leading N).

    Attributes:
        value: (N,) the worst case over the failures.
        by_failure: (N, F) the value for each failure, in the order of ``index.failures``.
        worst: (N,) position in ``index.failures`` of the failure that attains the worst case; the first one of several.
        status: (N,) ``OK``, ``SINGULAR`` (value by convention), ``BAD_INPUT``, or ``UNDEFINED`` where the formula of an index
            of one's own gives NaN.
    """

    value: FloatArray
    by_failure: FloatArray
    worst: IndexArray
    status: NDArray[np.uint8]


@dataclass(frozen=True)
class WorstCase:
    """Part of an :class:`IndexEvaluation` that concerns the worst failure alone.

    Attributes:
        value, worst, status: As there.
    """

    value: FloatArray
    worst: IndexArray
    status: NDArray[np.uint8]


class Index(Labelled, Objective):
    """A number that rates a configuration after any one of a set of failures.

    Attributes:
        name: For people and files.
        unit: Of the value; ``1`` if it has none.
        better: ``"larger"`` or ``"smaller"``.
        arm, task: What it is an index of.
        failures: Sets of joints, indices from 0, that fail together.
        source: Paper and equation.
        bound: The value no configuration can beat, or None if there is none.
        bound_note: What is known of how near one can come to it, a phrase; empty where some Jacobian of this size attains it.
        ceiling: Bound and best known value for all arms of this size, where there are such.
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
        """Largest value that a Jacobian of this size is known to attain; None where no value is known."""
        return None if self.ceiling is None else self.ceiling.best_known

    @property
    def is_attained(self) -> bool:
        """True where the best known value is the bound."""
        return self.ceiling is not None and self.ceiling.is_attained

    # ---- what a formula provides -------------------------------------------------------------------------------

    @abstractmethod
    def _evaluate_by_failure(self, q: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Values (N, F), NaN where q (N, n) is not finite, and which rows are singular (N,)."""

    @abstractmethod
    def _evaluate_gradient(self, q: FloatArray) -> FloatArray:
        """Gradient (N, n) of the worst case, NaN where q (N, n) is not finite."""

    # ---- what a user asks --------------------------------------------------------------------------------------

    @property
    def singular_value_by_convention(self) -> float:
        """The value at a singular configuration: 0, or infinity if smaller is better."""
        return 0.0 if self.better == "larger" else np.inf

    @cached_property
    def failure_names(self) -> list[str]:
        """Joint names, joined by ``+`` where several fail together."""
        return failure_names(self.arm, self.failures)

    def evaluate(self, q: ArrayLike) -> IndexEvaluation:
        """Value, value per failure, worst failure and status in one pass.

        Args:
            q: (n,) or (N, n), rad and m.

        Raises:
            InputError: Wrong shape; NaN or infinity in a single configuration (in a batch such a row gets NaN).
        """
        rows, single = self._read_configurations(q)
        by_failure, singular = self._evaluate_by_failure(rows)
        # A NaN, if there is any.
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
        """Value, worst failure and status, without the values of the other failures: for very many configurations.

        Args:
            q: (n,) or (N, n), rad and m.

        Raises:
            InputError: As :meth:`evaluate`.
        """
        evaluation = self.evaluate(q)
        return WorstCase(evaluation.value, evaluation.worst, evaluation.status)

    def __call__(self, q: ArrayLike) -> FloatArray:
        """The worst case over the failures, (N,), or a scalar for one configuration; 0 at a singular one."""
        return self.evaluate(q).value

    def by_joint(self, q: ArrayLike) -> FloatArray:
        """The value for each failure, (N, F) or (F,); for single failures one column per joint."""
        return self.evaluate(q).by_failure

    def worst_failure(self, q: ArrayLike) -> IndexArray:
        """Position in ``failures`` of the worst one, (N,) or a scalar."""
        return self.evaluate(q).worst

    def worst_joint(self, q: ArrayLike) -> IndexArray:
        """Index from 0 of the joint whose failure is the worst, (N,) or a scalar.

        Raises:
            TaskError: Some failures are of several joints; ask for :meth:`worst_failure`.
        """
        if any(len(failure) != 1 for failure in self.failures):
            raise TaskError(f"{self.name}: several joints fail together here; ask for worst_failure and failure_names")
        return np.array([failure[0] for failure in self.failures], dtype=np.int64)[self.evaluate(q).worst]

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Exact gradient of the worst case, (N, n) or (n,), per rad and m.

        Where two failures tie it is that of the first. It is 0 at a singular configuration and where the worst case is 0
        whatever the joints do (both are kinks or constants), and NaN where q is.
        """
        rows, single = self._read_configurations(q)
        gradient = self._evaluate_gradient(rows)
        return gradient[0] if single else gradient

    def singular(self, q: ArrayLike) -> BoolArray:
        """True where the healthy arm's task Jacobian is singular, (N,) or a scalar."""
        rows, single = self._read_configurations(q)
        finite: BoolArray = np.asarray(np.isfinite(rows).all(axis=1))
        result = self._is_singular(np.where(finite[:, None], rows, 0.0)) & finite
        return result[0] if single else result

    def scores(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> tuple[list[SX], list[list[SX]]]:
        """Smooth functions of q whose smallest is largest where the index is best, one per failure: for optimisation.

        Args:
            q: (n,) symbols.
            j: The Jacobian that was factored.
            qr: Its factorisation.
            directions: (n,) each, a basis of the null space of J.

        Returns:
            F scores, and their derivatives along each direction, F lists.

        Raises:
            TaskError: The index is not one symbolic program.
        """
        raise TaskError(f"{self.name} cannot be optimised: it has no scores; use one of the built-in indices or a CustomIndex")

    def value_of_score(self, score: SX) -> SX:
        """The value that a score stands for, its negative where smaller is better: an increasing function of the score."""
        return score

    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """The scores, as one part; see :meth:`Objective.parts`."""
        return [ObjectivePart(1.0, *self.scores(q, j, qr, directions))]

    def exact_parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """The values themselves, as one part; see :meth:`Objective.exact_parts`."""
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
        """``SINGULAR`` where the value is a convention; see :meth:`Objective.row_statuses`."""
        return self.evaluate(q).status

    @property
    def own_task(self) -> Task:
        """The task of the index."""
        return self.task

    def with_failures(self, failures: FailureSpec) -> Index:
        """Build the same index over other failures.

        Raises:
            InputError: The index is of a class of one's own.
        """
        return by_name(INDEX_REGISTRY.label(self), self.arm, self.task, failures=failures)

    # ---- shared machinery --------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def _task_jacobian(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        return Kernel("task jacobian", [q], [self.task.jacobian(self.arm, q)])

    def task_jacobian(self, q: FloatArray) -> FloatArray:
        """Task Jacobian (N, m, n) for q (N, n), linear rows divided by the characteristic length."""
        return self._task_jacobian.rows(q).reshape(-1, self.task.m, self.arm.n)

    def _is_singular(self, q: FloatArray) -> BoolArray:
        """The definition itself, by singular values of the task Jacobian."""
        if not len(q):
            return np.zeros(0, dtype=bool)
        singular_values = np.linalg.svd(self.task_jacobian(q), compute_uv=False)
        return np.asarray(singular_values[:, -1] <= SINGULAR_RATIO * singular_values[:, 0])

    def _read_configurations(self, q: ArrayLike) -> tuple[FloatArray, bool]:
        return as_configurations(self.arm, q)

    @property
    def slug(self) -> str:
        """The name as used on the command line and in files."""
        return self.name.replace(" ", "-")

    def describe(self) -> str:
        """One phrase for people: what it is, of which task, after which failures."""
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
    """A built-in index by its label: ``relative-manipulability``, or ``directional-velocity:0,0,1``.

    Raises:
        TaskError: There is no such index; the message has the nearest, and all.
        InputError: A setting that the index does not have, or one that is missing.
    """
    index: Index = INDEX_REGISTRY.make(name, arm, task=task, failures=failures, length=length)
    return index
