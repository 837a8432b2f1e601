"""Control laws: the joint rates that a controller without fault information commands for a motion of the end effector.

Every law is one straight-line program of the task Jacobian and a task velocity, so that the same law runs in the batch
kernel, in C on a robot's controller and in the browser. The task velocity is ``Ke`` times the error, and it is scaled down
as a whole if its linear part would exceed the speed limit.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (5), (6); Goel, Maciejewski, Balakrishnan 2005, eq. (5), (6), (10).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws import deviation, export
from holdfast.control.laws.c_functions import CFunction, generate_c_functions
from holdfast.control.laws.deviation import Deviations
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, TaskError
from holdfast.core.registry import LAW_REGISTRY, Labelled
from holdfast.core.result import Presentable
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kernels.control_step import Steppable
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.frameworks.rows import Differentiable, RowFunction
from holdfast.kernels.javascript_backend import write_javascript
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX, Program
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task


class Law(Presentable, Labelled, Differentiable, Steppable):
    """Control law ``rates = G(q) v`` for a task velocity v, with ``v = Ke error`` for a target.

    In a control loop, call ``step = law.prepare()`` once and ``rates = step(q, v)`` in every period, with q (n,), v (m,) and
    rates (n,). ``step.others`` then contains the further :meth:`outputs`.

    Args:
        arm: The arm.
        task: Rows of the end effector's velocity that are prescribed.
        gain: ``Ke``, 1/s, or 1/cycle if time is counted in cycles.
        speed_limit: Largest norm of the linear part of v, m/s or m/cycle; v is scaled down as a whole. None: no limit.

    Attributes:
        name: Name of the law in texts.
        slug: Name of the law on the command line and in files.
        source: Paper and equation.

    Raises:
        TaskError: The task has more rows than the arm has joints.
        InputError: The gain or the speed limit is not above 0.
    """

    name = ""
    slug = ""
    source = ""

    @check_arguments
    def __init__(
        self, arm: Arm, task: str | Task | Sequence[str] = "pose", gain: float = 1.0, *, speed_limit: float | None = None
    ) -> None:
        self.arm, self.task = arm, as_task(arm, task)
        if self.task.m > arm.n:
            raise TaskError(
                f"task '{self.task.name}' prescribes {self.task.m} rows, but '{arm.name}' has {arm.n} joints; prescribe fewer"
            )
        for name, value in (("gain", gain), ("speed_limit", speed_limit)):
            if value is not None and not (np.isfinite(value) and value > 0):
                raise InputError(f"{name} is {value:g}; it must be above 0")
        self.gain, self.speed_limit = float(gain), speed_limit

    # ---- symbols -----------------------------------------------------------------------------------------------

    @abstractmethod
    def inverse(self, j: SX, v: SX) -> SX:
        """Return the joint rates (n,), per second, of the law.

        Args:
            j: (m, n) task Jacobian with its linear rows divided by the task's characteristic length.
            v: (m,) task velocity with its linear rows divided by the task's characteristic length.
        """

    def jacobian(self, q: SX) -> SX:
        """Return the task Jacobian (m, n) at ``q`` (n,), with linear rows divided by the task's characteristic length."""
        return self.task.jacobian(self.arm, q)

    def scale_velocity(self, v: SX) -> SX:
        """Return ``v`` (m,), m/s and rad/s, with its linear rows divided by the task's characteristic length."""
        return ca.SX(ca.DM(self.task.scale(self.task.length))) @ v

    def command(self, error: SX) -> SX:
        """Return the task velocity (m,), m/s and rad/s, for an ``error`` (m,), m and rad: eq. (6), within the speed limit.

        The speed limit acts like a smaller gain far from the target: the motion takes longer on the same path.
        """
        if self.speed_limit is None:
            return self.gain * error
        linear = ca.SX(ca.DM(_linear_selector(self.task))) @ error
        speed = self.gain * ca.sqrt(ca.sumsqr(linear))
        scale = ca.if_else(speed > self.speed_limit, self.speed_limit / ca.if_else(speed > 0, speed, 1.0), 1.0)
        return scale * self.gain * error

    def rates(self, q: SX, v: SX) -> SX:
        """Return the joint rates (n,), rad/s and m/s, for ``q`` (n,), rad and m, and ``v`` (m,), m/s and rad/s."""
        return self.inverse(self.jacobian(q), self.scale_velocity(v))

    def with_slopes(self, q: SX, v: SX, by: SX) -> tuple[SX, SX]:
        """Return :meth:`rates` and their derivatives (n, k) by symbols ``by`` (k,), in which ``q`` and ``v`` are expressed."""
        rates = self.rates(q, v)
        return rates, ca.jacobian(rates, by)

    def quadratic(self) -> tuple[FloatArray, float] | None:
        """Return ``A`` (n, n) and ``d`` of a law ``A J' (J A J' + d I)^-1 v`` with scaled rows; None for any other law."""
        return None

    def outputs(self, q: SX, v: SX) -> dict[str, SX]:
        """Return the outputs of the law for ``q`` (n,) and ``v`` (m,), m/s and rad/s: ``rates`` (n,) first, then all others."""
        return {"rates": self.rates(q, v)}

    def computed_in_c(self) -> str:
        """Return the C99 text of ``static void computed(const double *q, const double *v, double *rates, ...)``.

        The function computes :meth:`outputs`.
        """
        q, v = kinematics.joint_symbols(self.arm), ca.SX.sym("v", self.task.m)
        return generate_c_functions(
            {"computed": CFunction({"q": q, "v": v}, {key: [expression] for key, expression in self.outputs(q, v).items()})}
        )

    def inverse_in_c(self) -> str:
        """Return the C99 text of ``static void inverse(const double *j, const double *v, double *rates)``, j row by row."""
        j, v = ca.SX.sym("j", self.task.m, self.arm.n), ca.SX.sym("v", self.task.m)
        return generate_c_functions({"inverse": CFunction({"j": j, "v": v}, {"rates": [self.inverse(j, v)]})})

    def write_rates_in_javascript(self, name: str, q: SX, v: SX, inputs: Sequence[SX], *, with_functions: bool = True) -> str:
        """Return :meth:`rates` for ``q``, ``v`` as JavaScript: ``const NAME = (x, y) => ...``.

        The text is as ``holdfast.kernels.javascript_backend.write_javascript`` writes it.

        Args:
            name: Name of the constant.
            q: (n,) configuration, an expression of the inputs.
            v: (m,) task velocity, an expression of the inputs.
            inputs: Symbols in x, in order; y are the joint rates.
            with_functions: If False, the text does not define the functions that it calls.
        """
        return write_javascript(Program(self.name, inputs, [self.rates(q, v)]), name, with_functions=with_functions)

    # ---- numbers -----------------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def _velocity_kernel(self) -> Kernel:
        q, v = kinematics.joint_symbols(self.arm), ca.SX.sym("v", self.task.m)
        return Kernel(self.name, [q, v], list(self.outputs(q, v).values()))

    @cached_property
    @cached_kernel
    def _deviation_kernel(self) -> Kernel:
        q, v, rates = kinematics.joint_symbols(self.arm), ca.SX.sym("v", self.task.m), ca.SX.sym("rates", self.arm.n)
        return Kernel(
            f"{self.name}, deviations",
            [q, v, rates],
            [deviation.deviation_expression(self.jacobian(q), self.scale_velocity(v), rates)],
        )

    @cached_property
    @cached_kernel
    def _rate_derivatives_kernel(self) -> Kernel:
        q, v = kinematics.joint_symbols(self.arm), ca.SX.sym("v", self.task.m)
        derivatives = self.with_slopes(q, v, ca.vertcat(q, v))[1]
        return Kernel(f"{self.name}, slopes", [q, v], [derivatives[:, : self.arm.n], derivatives[:, self.arm.n :]])

    def row_function(self) -> RowFunction:
        """Return the function of one row and its derivatives, those of the rates with respect to q and v."""
        return RowFunction(
            name=self.name,
            sizes=(self.arm.n, self.task.m),
            size=self.arm.n,
            value=self.velocity,
            slopes=self._rate_derivatives_kernel,
            kernels=(self._velocity_kernel, self._rate_derivatives_kernel),
        )

    def _step_kernel(self) -> tuple[Kernel, int]:
        return self._velocity_kernel, self.arm.n

    @check_arguments
    def velocity(self, q: ArrayLike, v: ArrayLike) -> FloatArray:
        """Compute the commanded joint rates.

        Args:
            q: (n,) configuration or (N, n) configurations, rad and m.
            v: (m,) or (N, m) velocity of the task's rows, m/s and rad/s.

        Returns:
            (n,) or (N, n) joint rates, rad/s and m/s; NaN in a row where q or v is NaN or the law has no answer.

        Raises:
            InputError: q or v has a wrong shape.
        """
        outputs, single = self._evaluate_outputs(q, v)
        rates = np.ascontiguousarray(outputs[:, : self.arm.n])
        return rates[0] if single else rates

    @check_arguments
    def damping(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Compute the damping lambda, not its square, in the unit of the scaled Jacobian; 0 for a law without damping.

        Args:
            q: (n,) configuration or (N, n) configurations, rad and m.
            v: (m,) or (N, m) velocity of the task's rows, m/s and rad/s.

        Returns:
            One damping or (N,) dampings; NaN in a row where q or v is NaN.

        Raises:
            InputError: q or v has a wrong shape.
        """
        return self._fill_constant(q, v, 0.0)

    @check_arguments
    def deviations(self, q: ArrayLike, v: ArrayLike) -> Deviations:
        """Compute the deviation of the tool velocity from the command, for the healthy arm and with each joint locked.

        Args:
            q: (n,) configuration or (N, n) configurations, rad and m.
            v: (m,) or (N, m) velocity of the task's rows, m/s and rad/s; only its direction counts. A row of zeros gives NaN.

        Returns:
            Velocity errors and angles, with a leading axis N if q or v has one.

        Raises:
            InputError: q or v has a wrong shape.

        Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (10).
        """
        configurations, velocities, single = self._broadcast_rows(q, v)
        rates = self._velocity_kernel.rows(configurations, velocities)[:, : self.arm.n]
        values = self._deviation_kernel.rows(configurations, velocities, np.ascontiguousarray(rates))
        return deviation.read_deviations(values[0] if single else values, self.arm.n)

    def peak_velocity_error(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Return PKE (8), the largest velocity error over all single locked joints for the unit velocity, as () or (N,).

        ``q`` and ``v`` are those of :meth:`deviations`.
        """
        return self.deviations(q, v).peak_velocity_error

    def peak_angular_deviation(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Return PAD (10), the largest angle to the command over all single locked joints, rad, as () or (N,).

        ``q`` and ``v`` are those of :meth:`deviations`. No choice of the pre-failure error bounds the angle; see
        :class:`holdfast.control.laws.Deviations`.
        """
        return self.deviations(q, v).peak_angular_deviation

    def healthy_angle(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Return the angle between the healthy arm's velocity and the command, rad, as () or (N,).

        ``q`` and ``v`` are those of :meth:`deviations`.
        """
        return self.deviations(q, v).healthy_angle

    def velocity_errors(self, q: ArrayLike, v: ArrayLike) -> FloatArray:
        """Return the velocity error with each joint locked, for the unit velocity, as (n,) or (N, n).

        ``q`` and ``v`` are those of :meth:`deviations`.
        """
        return self.deviations(q, v).errors

    def _evaluate_outputs(self, q: ArrayLike, v: ArrayLike) -> tuple[FloatArray, bool]:
        """Return all :meth:`outputs` in rows, and whether a single row was requested."""
        configurations, velocities, single = self._broadcast_rows(q, v)
        return self._velocity_kernel.rows(configurations, velocities), single

    def _fill_constant(self, q: ArrayLike, v: ArrayLike, value: float) -> Any:
        configurations, velocities, single = self._broadcast_rows(q, v)
        is_finite = np.isfinite(configurations).all(axis=1) & np.isfinite(velocities).all(axis=1)
        values = np.where(is_finite, value, np.nan)
        return values[0] if single else values

    def _broadcast_rows(self, q: ArrayLike, v: ArrayLike) -> tuple[FloatArray, FloatArray, bool]:
        configurations, velocities = self.arm.check_configurations(q), require_real_numbers(v, "the velocity")
        m = self.task.m
        if (
            velocities.ndim not in (1, 2)
            or velocities.shape[-1] != m
            or (configurations.ndim == 2 and velocities.ndim == 2 and len(configurations) != len(velocities))
        ):
            raise InputError(
                f"the velocity has shape {velocities.shape}; task '{self.task.name}' has {m} rows, so it must be ({m},), or "
                f"(N, {m}), a row for each configuration"
            )
        if configurations.ndim == velocities.ndim == 1:
            return configurations[None], velocities[None], True
        lengths = [len(array) for array in (configurations, velocities) if array.ndim == 2]
        count = min(lengths, default=1)
        return np.broadcast_to(configurations, (count, self.arm.n)), np.broadcast_to(velocities, (count, m)), False

    @check_arguments
    def export_c(self, folder: str | Path, name: str | None = None) -> export.ExportedLaw:
        """Write the law as a C99 file that needs only ``math.h``, with its header, an example, and a test.

        The function ``int NAME(const double q[n], const double v[m], double rates[n], ...)`` returns 0, or 1 and zero rates
        if an input is not finite or the law has no answer. The further :meth:`outputs` of the law follow the rates. Its rates
        equal those of :meth:`velocity` to rounding. ``NAME_check_joints`` compares the joint names of a driver with the order
        of q. The header also works in C++ and contains the version of holdfast and the arm's fingerprint.

        Args:
            folder: Folder of the files, created if it does not exist.
            name: Name of the function and the files. Default: the name of the law, for example ``failure_tolerant``.

        Returns:
            The paths of source, header, example and test, which can be unpacked.

        Raises:
            InputError: The name is not valid in C, or the arm is close to singular everywhere.
            StoreError: The files cannot be written.
        """
        return export.write_law_files(self, folder, self.slug.replace("-", "_") if name is None else name)

    def phrase(self) -> str:
        """Return a phrase that names the law, its settings, and its task, without gain and speed limit."""
        return f"{self.name}, task {self.task.describe()}"

    def describe(self) -> str:
        """Return a phrase that names the law, its settings, its task, its gain, and its speed limit."""
        limit_text = "" if self.speed_limit is None else f", at most {self.speed_limit:g} m/s"
        return f"{self.phrase()}, gain {self.gain:g}/s{limit_text}"

    def to_stored(self) -> dict[str, Any]:
        """Return all values that distinguish the law from other laws of the same arm, as JSON data.

        Raises:
            InputError: The law has no label.
        """
        limits = {"gain": self.gain, "speed_limit": self.speed_limit}
        return {"law": LAW_REGISTRY.label(self), **limits, "task": self.task.to_dict()}

    def __repr__(self) -> str:
        return f"<{self.describe()}, arm {self.arm.name!r}>"


def _linear_selector(task: Task) -> FloatArray:
    """Return the matrix (3, m) from a task velocity to its linear velocity."""
    return np.asarray(task.rows[:, :3].T)


@check_arguments
def by_name(name: str, arm: Arm, **options: Any) -> Law:
    """Make a control law from its label, for example ``pseudoinverse`` or ``damped:0.1``.

    Args:
        name: Label, which is the ``slug`` of the law and its settings.
        arm: The arm.
        options: Further arguments of the law (``task``, ``gain``, ``speed_limit``), or settings that the label omits.

    Raises:
        InputError: The name is unknown, the law does not have an option, or an option is missing.
        TaskError: The task has more rows than the arm has joints.
    """
    law: Law = LAW_REGISTRY.make(name, arm, **options)
    return law
