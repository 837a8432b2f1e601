"""Family of all designs of a space as one arm with symbols for the varied numbers, compiled once for all designs.

The symbols replace constants of the arm, so the equations of ``arm``, ``indices`` and ``solve`` need no change, and constants
that are 0 and not varied still vanish from the code. (The alternative, a locked joint for every parameter in a longer chain,
needs no symbols, but makes every kernel longer and cannot vary joint limits.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import TaskError
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import factor_householder
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.index import Index, by_name
from holdfast.kinematics.solvers.inverse_kinematics import damped_step_and_residual, sine_task_error, task_error_and_jacobian
from holdfast.kinematics.solvers.optimum import ascent_step
from holdfast.model.arm import kinematics
from holdfast.model.arm.machine import Joint, snap_rounding_noise
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, plane_normal
from holdfast.model.failure_modes import FailureSpec
from holdfast.studies.designs.space import TOOL_PARAMETERS, DesignSpace


@dataclass(frozen=True, eq=False)
class SymbolicJoint(Joint):
    """Joint whose origin and limits can be symbols."""

    def __post_init__(self) -> None:
        """Skip the checks, because the designs that provide the numbers are checked."""


@dataclass(frozen=True, eq=False)
class SymbolicArm(Arm):
    """Arm whose constants can be symbols, for use in equations only; ``symbols`` are those of :func:`make_revolute_arm`."""

    limits: tuple[Sequence[SX], Sequence[SX]] = field(default=((), ()))
    symbols: tuple[SX, ...] = ()
    length_unit = 1.0  # m, because lengths can be symbols

    def __post_init__(self) -> None:
        """Skip the checks, because the designs that provide the numbers are checked."""

    @property
    def lower(self) -> Sequence[SX]:  # type: ignore[override]
        """(n,) lower limits, numbers or symbols."""
        return self.limits[0]

    @property
    def upper(self) -> Sequence[SX]:  # type: ignore[override]
        """(n,) upper limits, numbers or symbols."""
        return self.limits[1]


def make_symbolic_arm(space: DesignSpace, x: SX) -> SymbolicArm:
    """Return the arm of the design x (k,), in which only the parameters are symbols.

    Its table is that of :meth:`holdfast.DesignSpace.table_of`, and its construction that of ``from_dh``.
    """
    table = space.table
    open_symbols: dict[tuple[int | None, str], SX] = {
        (parameter.row, parameter.kind): x[i] for i, parameter in enumerate(space.parameters)
    }
    joints, lower, upper = [], [], []
    pending = ca.sparsify(ca.SX.eye(4))
    for index, row in enumerate(table.rows):
        a, alpha, d, theta = (open_symbols.get((index, kind), getattr(row, kind)) for kind in ("a", "alpha", "d", "theta"))
        lower_limit, upper_limit = (open_symbols.get((index, kind), getattr(row, kind)) for kind in ("lower", "upper"))
        lower.append(-np.inf if lower_limit is None else lower_limit)
        upper.append(np.inf if upper_limit is None else upper_limit)
        theta_rotation = _rotation_about(2, theta)
        offset_shift = _translation(0, 0, d)
        link_transform = _translation(a, 0, 0) @ _rotation_about(0, alpha)
        is_prismatic = row.type == "prismatic"
        origin = pending @ theta_rotation @ offset_shift if is_prismatic else pending @ theta_rotation
        pending = link_transform if is_prismatic else offset_shift @ link_transform
        joint_name = row.name or f"joint{index + 1}"
        joints.append(SymbolicJoint(joint_name, row.type, ca.sparsify(origin), axis=np.array([0.0, 0.0, 1.0])))
    tool = ca.sparsify(
        pending
        @ _make_tool_transform(table.tool, {kind: symbol for (row_, kind), symbol in open_symbols.items() if row_ is None})
    )
    return SymbolicArm(f"designs of {space.arm.name}", tuple(joints), base=table.base, tool=tool, limits=(lower, upper))


def make_revolute_arm(joint_count: int) -> SymbolicArm:
    """Return any arm with at most ``joint_count`` revolute joints, whose geometry consists of symbols.

    These are the pose (3, 4) of each joint, with its axis as z, in the frame of the joint before it; the tool pose (3, 4) in
    the frame of the last joint; the lower and the upper limits (n,); and 1 for each joint of the arm, 0 for the remaining ones
    (n,). The remaining joints must be at the tool point.
    """
    poses = [ca.SX.sym("pose", 3, 4) for _ in range(joint_count + 1)]
    lower, upper, present = (ca.SX.sym(name, joint_count) for name in ("lower", "upper", "present"))
    *origins, tool = (ca.vertcat(pose, ca.SX(ca.DM([[0, 0, 0, 1]]))) for pose in poses)
    z = np.array([0.0, 0.0, 1.0])
    joints = tuple(SymbolicJoint(f"joint{k + 1}", "revolute", origin, axis=z) for k, origin in enumerate(origins))
    limits, symbols = (ca.vertsplit(lower), ca.vertsplit(upper)), (*poses, lower, upper, present)
    return SymbolicArm("any arm", joints, (None,) * joint_count, tool=tool, limits=limits, symbols=symbols)


def _make_tool_transform(tool: FloatArray, open_symbols: dict[str, SX]) -> SX:
    """Return the tool transform (4, 4) with symbols for the varied ones of x, y, z, roll, pitch, and yaw."""
    from scipy.spatial.transform import Rotation

    position = [open_symbols.get(kind, float(tool[i, 3])) for i, kind in enumerate(TOOL_PARAMETERS[:3])]
    if not any(kind in open_symbols for kind in TOOL_PARAMETERS[3:]):
        rotation = ca.SX.eye(4)
        rotation[:3, :3] = kinematics.constant_matrix(snap_rounding_noise(tool[:3, :3]))
        return _translation(*position) @ rotation
    numbers = dict(zip(TOOL_PARAMETERS[3:], Rotation.from_matrix(tool[:3, :3]).as_euler("xyz").tolist(), strict=True))
    roll, pitch, yaw = (open_symbols.get(kind, numbers[kind]) for kind in TOOL_PARAMETERS[3:])
    return _translation(*position) @ _rotation_about(2, yaw) @ _rotation_about(1, pitch) @ _rotation_about(0, roll)


def _rotation_about(axis: int, angle: float | SX) -> SX:
    """Return the rotation (4, 4) about x, y, or z."""
    if isinstance(angle, ca.SX):
        cosine, sine = ca.cos(angle), ca.sin(angle)
    else:
        cosine, sine = snap_rounding_noise(np.array([np.cos(angle), np.sin(angle)])).tolist()
    second, third = (axis + 1) % 3, (axis + 2) % 3
    transform = ca.SX.eye(4)
    transform[second, second] = cosine
    transform[third, third] = cosine
    transform[third, second] = sine
    transform[second, third] = -sine
    return ca.sparsify(transform)


def _translation(x: float | SX, y: float | SX, z: float | SX) -> SX:
    transform = ca.SX.eye(4)
    transform[0, 3], transform[1, 3], transform[2, 3] = x, y, z
    return ca.sparsify(transform)


class Family:
    """Equations of all designs of a space, compiled once each.

    Every row of a kernel has its own configuration, pose, and design.

    Args:
        space: Design space.
        objective: Name of an index that is better when larger.
        task: Task, or its name or components.
        failures: ``"single"``, ``"pairs"``, the number of joints that fail together, or a list of joints or sets of joints.
        length: Characteristic length of the task, m.

    Attributes:
        space, task: Design space and task.
        index: Index of the arm with symbols, for use in equations.
        x: Symbols of a design (k,).

    Raises:
        TaskError: The index is better when smaller or not a single symbolic program, the arm is not redundant for the task, or
            the parameters move the arm out of the plane of a planar task.
    """

    def __init__(
        self,
        space: DesignSpace,
        objective: str = "relative-manipulability",
        task: str | Task | Sequence[str] = "pose",
        *,
        failures: FailureSpec = "single",
        length: float | None = None,
    ) -> None:
        self.space = space
        self.x = ca.SX.sym("x", len(space.parameters))
        self.task = as_task(space.arm, task, length)
        if self.task.name.startswith("planar"):
            _require_planar_designs(space)
        self.arm = make_symbolic_arm(space, self.x)
        self.index: Index = by_name(objective, self.arm, self.task, failures=failures)
        if self.index.better == "smaller":
            raise TaskError(
                f"{self.index.name} is better when smaller, and a search maximises; use minimum-singular-value or another index"
            )
        if self.index.measured is not None:
            raise TaskError(f"{self.index.name} after several joints fail together has no exact slopes; use another index")

    @cached_property
    def numeric_index(self) -> Index:
        """Index of the baseline arm in numbers, for properties such as its bound."""
        return by_name(self.index.label, self.space.arm, self.task, failures=self.index.failures)

    # ---- numbers ---------------------------------------------------------------------------------------------------

    def limits(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return lower and upper limits (D, n), rad and m, of designs ``values`` (D, k); infinite for joints without limits."""
        sides = []
        for kind, default in (("lower", -np.inf), ("upper", np.inf)):
            own_limits = [getattr(row, kind) for row in self.space.table.rows]
            table = np.tile([default if v is None else v for v in own_limits], (len(values), 1))
            for index, parameter in enumerate(self.space.parameters):
                if parameter.kind == kind and parameter.row is not None:
                    table[:, parameter.row] = values[:, index]
            sides.append(table)
        return sides[0], sides[1]

    @cached_property
    def turning(self) -> NDArray[np.bool_]:
        """(n,) True for revolute joints without limits."""
        rows = self.space.table.rows
        return np.array([row.type != "prismatic" and row.lower is None and row.upper is None for row in rows])

    @cached_property
    def prismatic(self) -> NDArray[np.bool_]:
        """(n,) True for prismatic joints."""
        return np.array([row.type == "prismatic" for row in self.space.table.rows])

    # ---- kernels ---------------------------------------------------------------------------------------------------

    @cached_property
    def _pose_symbols(self) -> tuple[SX, SX, SX]:
        return kinematics.joint_symbols(self.arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)

    @cached_property
    @cached_kernel
    def inverse(self) -> Loop:
        """Loop with state q and the parameters position (3), rotation (9), and design (k)."""
        q, position, rotation = self._pose_symbols
        error, jacobian = task_error_and_jacobian(self.arm, self.task, q, position, rotation)
        step, residual = damped_step_and_residual(self.arm, q, error, jacobian)
        return Loop("inverse kinematics of designs", q, [position, rotation, self.x], next_state=step, residual=residual)

    @cached_property
    @cached_kernel
    def errors(self) -> Kernel:
        """Kernel from (q, p, r, x) to position error, m, and rotation error, rad."""
        q, position, rotation = self._pose_symbols
        error, _ = task_error_and_jacobian(self.arm, self.task, q, position, rotation)
        full_error = ca.SX(ca.DM(self.task.rows)).T @ error
        return Kernel(
            "task error of designs",
            [q, position, rotation, self.x],
            [ca.vertcat(ca.norm_2(full_error[:3]), ca.norm_2(full_error[3:]))],
        )

    @cached_property
    @cached_kernel
    def misses(self) -> Kernel:
        """Kernel from (q, p, r, x) to the error e (m,), ``J' e`` (n,) and ``d (e' e) / 2 / dx`` (k,), for unreached poses."""
        q, position, rotation = self._pose_symbols
        error, jacobian = task_error_and_jacobian(self.arm, self.task, q, position, rotation)
        by_design = ca.gradient(ca.sumsqr(error) / 2, self.x)
        return Kernel("miss of designs", [q, position, rotation, self.x], [ca.vertcat(error, jacobian.T @ error, by_design)])

    @cached_property
    @cached_kernel
    def ascent(self) -> Kernel:
        """Kernel from (q, radius, last, p, r, x) to the next (q, radius, last), by ``solvers.optimum.ascent_step``."""
        inputs, step = ascent_step(self.index, self.task)
        return Kernel("ascent of designs", [*inputs, self.x], [step])

    @cached_property
    def _score_expressions(self) -> tuple[SX, list[SX], list[list[SX]]]:
        """Symbols of the configuration, scores of the failures, and gradients of the scores by the joints."""
        q = self._pose_symbols[0]
        jacobian = kinematics.invariant_jacobian(self.arm, q) if self.task.invariant else self.task.jacobian(self.arm, q)
        units = [ca.SX(ca.DM(e)) for e in np.eye(self.arm.n)]
        return q, *self.index.scores(q, jacobian, factor_householder(jacobian), units)

    @cached_property
    @cached_kernel
    def value(self) -> Kernel:
        """Kernel from (q, x) to the index."""
        q, scores, _ = self._score_expressions
        return Kernel("value of designs", [q, self.x], [ca.vertcat(*[self.index.value_of_score(s) for s in scores])])

    @cached_property
    @cached_kernel
    def conditions(self) -> Kernel:
        """Kernel from (q, p, r, x) to the terms of the optimality conditions.

        The terms are scores (F,), their slopes (F, n), a smooth error of the pose (m,) and its Jacobian (m, n).
        """
        q, position, rotation = self._pose_symbols
        _, scores, gradients = self._score_expressions
        pose_error = sine_task_error(self.arm, self.task, q, position, rotation)
        gradient_table = ca.vertcat(*[ca.horzcat(*row) for row in gradients])
        return Kernel(
            "conditions of designs",
            [q, position, rotation, self.x],
            [ca.vertcat(*scores), gradient_table, pose_error, ca.jacobian(pose_error, q)],
        )

    @cached_property
    @cached_kernel
    def by_design(self) -> Kernel:
        """Kernel from (q, p, r, x, u, w) to index, its derivative by the score, and ``d (u' scores - w' error) / dx``."""
        q, position, rotation = self._pose_symbols
        _, scores, _ = self._score_expressions
        u, w = ca.SX.sym("u", len(scores)), ca.SX.sym("w", self.task.m)
        lagrangian = ca.dot(u, ca.vertcat(*scores)) - ca.dot(w, sine_task_error(self.arm, self.task, q, position, rotation))
        score_symbol = ca.SX.sym("score")
        value = self.index.value_of_score(score_symbol)
        lowest = scores[0]
        for score in scores[1:]:
            lowest = ca.if_else(score < lowest, score, lowest)
        value_and_gradient = ca.Function("value", [score_symbol], [value, ca.gradient(value, score_symbol)])
        return Kernel(
            "gradient of designs",
            [q, position, rotation, self.x, u, w],
            [ca.vertcat(*value_and_gradient(lowest), ca.gradient(lagrangian, self.x))],
        )


def _require_planar_designs(space: DesignSpace) -> None:
    """Reject parameters that move an arm out of the plane of its task."""
    normal = plane_normal(space.arm)
    for values in (space.lower, space.upper, *space.draw(4)):
        design_normal = plane_normal(space.arm_of(values))
        if normal is None or design_normal is None or np.linalg.norm(design_normal - normal) > 1e-9:
            raise TaskError(
                f"{', '.join(space.names)} would move '{space.arm.name}' out of the plane of its task; keep the twists fixed, "
                "or use the task position or pose"
            )
