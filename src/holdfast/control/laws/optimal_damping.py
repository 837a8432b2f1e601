"""The failure-tolerant inverse: damped, with the damping that minimises the error of the worst single locked joint."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws import damping_search
from holdfast.control.laws.c_functions import CFunction, generate_c_functions
from holdfast.control.laws.c_translation import translate_c_to_javascript
from holdfast.control.laws.law import Law
from holdfast.core.errors import InputError
from holdfast.core.registry import Parameter, constructor
from holdfast.core.typing import BoolArray
from holdfast.core.validation import check_constructor
from holdfast.kernels.javascript.functions import define_functions
from holdfast.kernels.javascript_backend import write_javascript
from holdfast.kernels.program import SX, Program
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, TaskSpec


@check_constructor
class FailureTolerant(Law):
    """Damped inverse whose damping minimises the peak velocity error over all single locked joints.

    At every instant the damping lambda minimises PKE (8) under the constraint that the *healthy* arm's velocity error stays
    within ``pre_failure_error`` (9). Lambda depends on the configuration and on the direction of the command, not on its norm.
    For m >= 3, PKE may have several minima as a function of lambda. The search is therefore global: it refines the best cells
    of a grid in lambda^2 that is uniform near 0 and logarithmic beyond, in a fixed number of steps. It was compared with the
    exact optimum from polynomial roots (8,000 random cases each of a 3R arm, m = 2, and a 7R arm, m = 3) and with a dense grid
    (20,000 each); no result was worse by more than 1e-9. For full poses (m = 6) about 1 in 3,000 was (an iiwa14, by 2e-6). In
    20,000 earlier cases of a 7R arm, the worst missed a narrow minimum, which made PKE too large by the fraction 6e-4.

    If the arm is singular and the part of the command that it cannot produce is the allowed error or more, no damping
    satisfies (9). Then :meth:`feasible` is False, and lambda is 1e-3 in the unit of the scaled Jacobian (m for a position
    task). A command of zero gives zero rates and zero damping.

    Args:
        arm: The arm.
        task: Rows of the end effector's velocity that are prescribed, from 1 to 6. Their characteristic length weighs
            metres against radians and therefore changes the result.
        pre_failure_error: Allowed error of the healthy arm for the unit velocity, between 0 and 1.
        gain: ``Ke``, 1/s.
        speed_limit: Largest norm of the linear part of the task velocity, m/s. None: no limit.

    Raises:
        TaskError: The task has more rows than the arm has joints.
        InputError: The pre-failure error is not between 0 and 1.

    Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9), with <= for <, because otherwise there often is no
    minimum.
    """

    name, slug = "failure-tolerant inverse", "failure-tolerant"
    source = "Goel et al. 2003, eq. (8), (9)"

    def __init__(
        self,
        arm: Arm,
        task: str | Task | Sequence[str] = "pose",
        pre_failure_error: float = 0.5,
        *,
        gain: float = 1.0,
        speed_limit: float | None = None,
    ) -> None:
        super().__init__(arm, task, gain, speed_limit=speed_limit)
        if not 0 < pre_failure_error < 1:
            raise InputError(
                f"pre_failure_error is {pre_failure_error:g}; it must be between 0 and 1 (for 0, use the pseudoinverse)"
            )
        self.pre_failure_error = float(pre_failure_error)

    def inverse(self, j: SX, v: SX) -> SX:
        """Return the rates (n,) with the best damping for the scaled ``j`` (m, n) and ``v`` (m,); see :meth:`Law.inverse`."""
        return self._build_damped_outputs(j, v)["rates"]

    def outputs(self, q: SX, v: SX) -> dict[str, SX]:
        """Return ``rates`` (n,), ``damping``, ``largest_damping``, and ``feasible`` (1 or 0) for ``q`` (n,) and ``v`` (m,)."""
        return self._build_damped_outputs(self.jacobian(q), self.scale_velocity(v))

    def with_slopes(self, q: SX, v: SX, by: SX) -> tuple[SX, SX]:
        """Return rates and derivatives for ``q``, ``v``, ``by`` as :meth:`Law.with_slopes`, without differentiating the search.

        The derivatives follow from the optimality conditions, because the search itself has about ten thousand operations.
        """
        j, scaled = self.jacobian(q), self.scale_velocity(v)
        choice = self._build_damped_outputs(j, scaled)
        return choice["rates"], damping_search.differentiate_damped_rates(j, scaled, self.pre_failure_error, choice, by)

    def computed_in_c(self) -> str:
        """Return the C99 text of :meth:`outputs`, with the search in loops; see :meth:`Law.computed_in_c`."""
        q, v = kinematics.joint_symbols(self.arm), ca.SX.sym("v", self.task.m)
        scaling_text = generate_c_functions(
            {"seen": CFunction({"q": q, "v": v}, {"j": [self.jacobian(q).T], "scaled": [self.scale_velocity(v)]})}
        )
        output_arguments = "double *rates, double *damping, double *largest, double *feasible"
        return f"""{scaling_text}
{damping_search.generate_c_search(self.task.m, self.arm.n, self.pre_failure_error)}
static void computed(const double *q, const double *v, {output_arguments}) {{
    double j[ROWS * JOINTS], scaled[ROWS];
    seen(q, v, j, scaled);
    damped_inverse(j, scaled, rates, damping, largest, feasible);
}}
"""

    def inverse_in_c(self) -> str:
        """Return the C99 text of :meth:`inverse`, with the search in loops; see :meth:`Law.inverse_in_c`."""
        return f"""{damping_search.generate_c_search(self.task.m, self.arm.n, self.pre_failure_error)}
static void inverse(const double *j, const double *v, double *rates) {{
    double told[3];
    damped_inverse(j, v, rates, told, told + 1, told + 2);
}}
"""

    def write_rates_in_javascript(self, name: str, q: SX, v: SX, inputs: Sequence[SX], *, with_functions: bool = True) -> str:
        """Return the rates as JavaScript, with the search in loops; see :meth:`Law.write_rates_in_javascript`."""
        program = Program("Jacobian and velocity", inputs, [self.jacobian(q), self.scale_velocity(v)])
        body = write_javascript(program, "see", with_functions=False) + translate_c_to_javascript(
            damping_search.generate_c_search(self.task.m, self.arm.n, self.pre_failure_error)
        )
        return f"""const {name}=(()=>{{
"use strict";
{define_functions(body) if with_functions else ""}{body}\
const j=new Float64Array({program.n_out}),v=j.subarray({program.n_out - self.task.m}),other=new Float64Array(1);
return (x,y)=>{{see(x,j);damped_inverse(j,v,y,other,other,other);}};
}})();
"""

    def _build_damped_outputs(self, j: SX, v: SX) -> dict[str, SX]:
        speed = ca.sqrt(ca.sumsqr(v))
        is_moving = speed > 0
        default_direction = np.eye(int(v.numel()))[0]
        u = ca.vertcat(
            *[
                ca.if_else(is_moving, component / ca.if_else(is_moving, speed, 1.0), default)
                for component, default in zip(ca.vertsplit(v), default_direction, strict=True)
            ]
        )
        choice = damping_search.search_damping(j, u, self.pre_failure_error)
        return {
            "rates": speed * ca.vertcat(*choice.rates),
            "damping": ca.if_else(is_moving, choice.damping, 0.0),
            "largest_damping": ca.if_else(is_moving, choice.largest, 0.0),
            "feasible": ca.if_else(is_moving, choice.feasible, 1.0),
        }

    def damping(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Compute the best damping at ``q`` (n,) or (N, n) for ``v`` (m,) or (N, m); see :meth:`Law.damping`."""
        return self._extra_output(q, v, 0)

    def largest_damping(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Compute the largest damping that keeps the healthy arm's error within the allowed one, as () or (N,).

        ``q``, ``v`` and the unit are those of :meth:`Law.damping`.
        """
        return self._extra_output(q, v, 1)

    def feasible(self, q: ArrayLike, v: ArrayLike) -> BoolArray | np.bool_:
        """Return True if some damping keeps the healthy arm's error within the allowed one, as () or (N,).

        ``q`` and ``v`` are those of :meth:`Law.damping`. The result is False in a row where q or v is NaN.
        """
        flags: BoolArray | np.bool_ = self._extra_output(q, v, 2) > 0
        return flags

    def _extra_output(self, q: ArrayLike, v: ArrayLike, number: int) -> Any:
        outputs, single = self._evaluate_outputs(q, v)
        values = np.ascontiguousarray(outputs[:, self.arm.n + number])
        return values[0] if single else values

    @property
    def settings(self) -> dict[str, Any]:
        """Allowed pre-failure error of the law, by the name of the argument."""
        return {"pre_failure_error": self.pre_failure_error}

    def phrase(self) -> str:
        """Return a phrase that names the law, its settings, and its task, without gain and speed limit."""
        return f"{super().phrase()}, pre-failure error at most {self.pre_failure_error:g}"


@constructor()
def failure_tolerant(
    arm: Arm,
    task: TaskSpec = "pose",
    pre_failure_error: Annotated[
        float, Parameter("1", "allowed velocity error of the healthy arm, a fraction of the speed", low=0, high=1, example=0.5)
    ] = 0.5,
    *,
    gain: float = 1.0,
    speed_limit: float | None = None,
) -> FailureTolerant:
    """Make the damped inverse that minimises the error of the worst single locked joint; Goel et al. 2003, eq. (8), (9).

    ``arm``, ``task``, ``pre_failure_error``, ``gain`` and ``speed_limit`` are those of
    :class:`holdfast.control.laws.FailureTolerant`.
    """
    return FailureTolerant(arm, task, pre_failure_error, gain=gain, speed_limit=speed_limit)
