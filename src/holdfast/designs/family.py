"""All designs of a space as one arm with symbols for the varied numbers: compiled once for every design.

The symbols are the arm's constants themselves, so the equations of ``arm``, ``indices`` and ``solve`` are used as they are
and what is not varied still vanishes from the code where it is 0. (The other way, a locked joint for every parameter in a
longer chain, needs no symbols but makes every kernel longer, and has no place for joint limits.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.machine import Joint, snapped
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.caching import cached_property
from holdfast.designs.space import OF_TOOL, DesignSpace
from holdfast.errors import TaskError
from holdfast.failures import FailureSpec
from holdfast.indices.index import Index, by_name
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import householder
from holdfast.solvers.inverse_kinematics import damped_step, smooth_error, task_error
from holdfast.solvers.optimum import ascent_step

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SymbolicJoint(Joint):
    """A joint whose origin and limits may be symbols."""

    def __post_init__(self) -> None:
        """Nothing to check: the designs that give the numbers are."""


@dataclass(frozen=True, eq=False)
class SymbolicArm(Arm):
    """An arm whose constants may be symbols: for equations only."""

    limits: tuple[Sequence[SX], Sequence[SX]] = field(default=((), ()))

    def __post_init__(self) -> None:
        """Nothing to check: the designs that give the numbers are."""

    @property
    def lower(self) -> Sequence[SX]:  # type: ignore[override]
        """(n,) numbers or symbols."""
        return self.limits[0]

    @property
    def upper(self) -> Sequence[SX]:  # type: ignore[override]
        """(n,) numbers or symbols."""
        return self.limits[1]


def symbolic_arm(space: DesignSpace, x: SX) -> SymbolicArm:
    """The arm of the design x (k,), of which only the parameters are symbols.

    The same table as :meth:`holdfast.DesignSpace.table_of`, built as ``from_dh`` does.
    """
    table = space.table
    open_: dict[tuple[int | None, str], SX] = {(p.row, p.kind): x[i] for i, p in enumerate(space.parameters)}
    joints, lower, upper = [], [], []
    after = ca.sparsify(ca.SX.eye(4))
    for k, row in enumerate(table.rows):
        a, alpha, d, theta = (open_.get((k, kind), getattr(row, kind)) for kind in ("a", "alpha", "d", "theta"))
        least, most = (open_.get((k, kind), getattr(row, kind)) for kind in ("lower", "upper"))
        lower.append(-np.inf if least is None else least)
        upper.append(np.inf if most is None else most)
        turned, raised, along = _turn(2, theta), _shift(0, 0, d), _shift(a, 0, 0) @ _turn(0, alpha)
        sliding = row.type == "prismatic"
        origin = after @ turned @ raised if sliding else after @ turned
        after = along if sliding else raised @ along
        name = row.name or f"joint{k + 1}"
        joints.append(SymbolicJoint(name, row.type, ca.sparsify(origin), axis=np.array([0.0, 0.0, 1.0])))
    tool = ca.sparsify(after @ _tool(table.tool, {kind: s for (row_, kind), s in open_.items() if row_ is None}))
    return SymbolicArm(f"designs of {space.arm.name}", tuple(joints), base=table.base, tool=tool, limits=(lower, upper))


def _tool(tool: Array, open_: dict[str, SX]) -> SX:
    """The tool (4, 4) with symbols for what is open of x, y, z, roll, pitch, yaw."""
    from scipy.spatial.transform import Rotation

    position = [open_.get(kind, float(tool[i, 3])) for i, kind in enumerate(OF_TOOL[:3])]
    if not any(kind in open_ for kind in OF_TOOL[3:]):
        rotation = ca.SX.eye(4)
        rotation[:3, :3] = kinematics.constant(snapped(tool[:3, :3]))
        return _shift(*position) @ rotation
    numbers = dict(zip(OF_TOOL[3:], Rotation.from_matrix(tool[:3, :3]).as_euler("xyz").tolist(), strict=True))
    roll, pitch, yaw = (open_.get(kind, numbers[kind]) for kind in OF_TOOL[3:])
    return _shift(*position) @ _turn(2, yaw) @ _turn(1, pitch) @ _turn(0, roll)


def _turn(axis: int, angle: float | SX) -> SX:
    """Rotation (4, 4) about x, y or z."""
    if isinstance(angle, ca.SX):
        c, s = ca.cos(angle), ca.sin(angle)
    else:
        c, s = snapped(np.array([np.cos(angle), np.sin(angle)])).tolist()
    i, k = (axis + 1) % 3, (axis + 2) % 3
    t = ca.SX.eye(4)
    t[i, i], t[k, k], t[k, i], t[i, k] = c, c, s, -s
    return ca.sparsify(t)


def _shift(x: float | SX, y: float | SX, z: float | SX) -> SX:
    t = ca.SX.eye(4)
    t[0, 3], t[1, 3], t[2, 3] = x, y, z
    return ca.sparsify(t)


class Family:
    """The equations of all designs of a space, compiled once each.

    Rows of every kernel are (configuration, pose, design), each with its own.

    Args:
        space: The designs.
        objective: An index by name, larger is better.
        task: What the end effector must do.
        failures: Which joints fail.
        length: Characteristic length of the task, m.

    Attributes:
        space, task, index: The same; the index is of the arm with symbols, to write equations with.
        x: Symbols of a design (k,).

    Raises:
        TaskError: An index that is better when smaller or that is not one symbolic program, a task for which the arm is not
            redundant, or a planar task where the parameters take the arm out of its plane.
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
            _stay_in_plane(space)
        self.arm = symbolic_arm(space, self.x)
        self.index: Index = by_name(objective, self.arm, self.task, failures=failures)
        if self.index.better == "smaller":
            raise TaskError(
                f"{self.index.name} is better when smaller, and a search maximises; use minimum-singular-value or another index"
            )
        if self.index.measured is not None:
            raise TaskError(f"{self.index.name} after several joints fail together has no exact slopes; use another index")

    @cached_property
    def numeric_index(self) -> Index:
        """The same index of the given arm, for facts such as its bound."""
        return by_name(self.index.label, self.space.arm, self.task, failures=self.index.failures)

    # ---- numbers ---------------------------------------------------------------------------------------------------

    def limits(self, values: Array) -> tuple[Array, Array]:
        """Lower and upper limits (D, n) of designs (D, k); infinite where there is none."""
        found = []
        for kind, given in (("lower", -np.inf), ("upper", np.inf)):
            own = [getattr(row, kind) for row in self.space.table.rows]
            table = np.tile([given if v is None else v for v in own], (len(values), 1))
            for i, p in enumerate(self.space.parameters):
                if p.kind == kind and p.row is not None:
                    table[:, p.row] = values[:, i]
            found.append(table)
        return found[0], found[1]

    @cached_property
    def turning(self) -> NDArray[np.bool_]:
        """(n,) True for joints that turn without limits."""
        rows = self.space.table.rows
        return np.array([r.type != "prismatic" and r.lower is None and r.upper is None for r in rows])

    @cached_property
    def prismatic(self) -> NDArray[np.bool_]:
        """(n,) True for prismatic joints."""
        return np.array([r.type == "prismatic" for r in self.space.table.rows])

    # ---- kernels ---------------------------------------------------------------------------------------------------

    @cached_property
    def _pose(self) -> tuple[SX, SX, SX]:
        return kinematics.joint_symbols(self.arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)

    @cached_property
    @recalled
    def inverse(self) -> Loop:
        """State q; parameters position (3), rotation (9), design (k)."""
        q, p, r = self._pose
        e, j = task_error(self.arm, self.task, q, p, r)
        step, residual = damped_step(self.arm, q, e, j)
        return Loop("inverse kinematics of designs", q, [p, r, self.x], next_state=step, residual=residual)

    @cached_property
    @recalled
    def errors(self) -> Kernel:
        """(q, p, r, x) to position error, m, and rotation error, rad."""
        q, p, r = self._pose
        e, _ = task_error(self.arm, self.task, q, p, r)
        back = ca.SX(ca.DM(self.task.rows)).T @ e
        return Kernel("task error of designs", [q, p, r, self.x], [ca.vertcat(ca.norm_2(back[:3]), ca.norm_2(back[3:]))])

    @cached_property
    @recalled
    def misses(self) -> Kernel:
        """(q, p, r, x) to the error e (m,), ``J' e`` (n,) and ``d (e' e) / 2 / dx`` (k,): for poses out of reach."""
        q, p, r = self._pose
        e, j = task_error(self.arm, self.task, q, p, r)
        by_design = ca.gradient(ca.sumsqr(e) / 2, self.x)
        return Kernel("miss of designs", [q, p, r, self.x], [ca.vertcat(e, j.T @ e, by_design)])

    @cached_property
    @recalled
    def ascent(self) -> Kernel:
        """(q, radius, last, p, r, x) to the next (q, radius, last): :func:`holdfast.solvers.optimise.ascent_step`."""
        inputs, step = ascent_step(self.index, self.task)
        return Kernel("ascent of designs", [*inputs, self.x], [step])

    @cached_property
    def _scored(self) -> tuple[SX, list[SX], list[list[SX]]]:
        """Configuration, scores of the failures, and their slopes by each joint."""
        q = self._pose[0]
        j = kinematics.invariant_jacobian(self.arm, q) if self.task.invariant else self.task.jacobian(self.arm, q)
        units = [ca.SX(ca.DM(e)) for e in np.eye(self.arm.n)]
        return q, *self.index.scores(q, j, householder(j), units)

    @cached_property
    @recalled
    def value(self) -> Kernel:
        """(q, x) to the index."""
        q, scores, _ = self._scored
        return Kernel("value of designs", [q, self.x], [ca.vertcat(*[self.index.value_of_score(s) for s in scores])])

    @cached_property
    @recalled
    def conditions(self) -> Kernel:
        """(q, p, r, x) to what the conditions of an optimum are made of.

        Scores (F,), their slopes (F, n), a smooth error of the pose (m,) and its Jacobian (m, n).
        """
        q, p, r = self._pose
        _, scores, slopes = self._scored
        c = smooth_error(self.arm, self.task, q, p, r)
        table = ca.vertcat(*[ca.horzcat(*row) for row in slopes])
        return Kernel("conditions of designs", [q, p, r, self.x], [ca.vertcat(*scores), table, c, ca.jacobian(c, q)])

    @cached_property
    @recalled
    def by_design(self) -> Kernel:
        """(q, p, r, x, u, w) to the index, its slope by the score, and ``d (u' scores - w' error) / dx``."""
        q, p, r = self._pose
        _, scores, _ = self._scored
        u, w = ca.SX.sym("u", len(scores)), ca.SX.sym("w", self.task.m)
        lagrangian = ca.dot(u, ca.vertcat(*scores)) - ca.dot(w, smooth_error(self.arm, self.task, q, p, r))
        s = ca.SX.sym("score")
        value = self.index.value_of_score(s)
        lowest = scores[0]
        for score in scores[1:]:
            lowest = ca.if_else(score < lowest, score, lowest)
        both = ca.Function("value", [s], [value, ca.gradient(value, s)])
        return Kernel(
            "gradient of designs", [q, p, r, self.x, u, w], [ca.vertcat(*both(lowest), ca.gradient(lagrangian, self.x))]
        )


def _stay_in_plane(space: DesignSpace) -> None:
    """Refuse parameters that take an arm out of the plane of its task."""
    normal = plane_normal(space.arm)
    for values in (space.lower, space.upper, *space.draw(4)):
        other = plane_normal(space.arm_of(values))
        if normal is None or other is None or np.linalg.norm(other - normal) > 1e-9:
            raise TaskError(
                f"a planar task needs designs that move in the plane of '{space.arm.name}'; {', '.join(space.names)} take it "
                "out of it: leave the twists as they are, or use the task position or pose"
            )
