"""Kernels of the browser page of an arm, printed in JavaScript from the equations of the library."""

from __future__ import annotations

import json
from collections.abc import Sequence

import casadi as ca

from holdfast.control.falls.passive_arm import PassiveArm
from holdfast.control.laws.law import by_name
from holdfast.kernels.javascript.functions import define_functions
from holdfast.kernels.javascript_backend import write_javascript
from holdfast.kernels.linalg import factor_householder
from holdfast.kernels.program import SX, Program
from holdfast.kinematics.solvers.inverse_kinematics import damped_step_and_residual, scaled_error_and_jacobian
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, default_path_task
from holdfast.studies.designs.family import SymbolicArm

DEFAULT_LAWS = ("pseudoinverse", "failure-tolerant")


def print_page_kernels(arm: Arm, task: Task, laws: Sequence[str] = DEFAULT_LAWS) -> str:
    """Print the kernels of a page as a JavaScript expression.

    Its value is a ``PrintedKernels`` of ``page/src/arm_page/data.ts``, which states the inputs and outputs of each kernel. The
    null space and the inverse kinematics are those of ``task``. The control laws move the tool point of the arm; there are none
    for an arm with too few joints for that. The last inputs of each kernel are the symbols of the geometry, if it has some.
    """
    q, geometry = kinematics.joint_symbols(arm), arm.symbols if isinstance(arm, SymbolicArm) else ()
    lines: list[str] = []
    members = []
    for name, program in make_page_programs(arm, task, q, geometry).items():
        lines.append("" if program is None else write_javascript(program, name, with_functions=False))
        members.append(f"{name}:null" if program is None else name)
    members_of_laws = []
    for number, label in enumerate(laws):
        lines.append(_write_law(arm, label, q, f"law{number}", geometry))
        members_of_laws.append(f"{json.dumps(label)}:law{number}")
    body = "".join(lines)
    return f"(()=>{{{define_functions(body)}{body}return {{{','.join(members)},laws:{{{','.join(members_of_laws)}}}}};\n}})()"


def make_page_programs(arm: Arm, task: Task, q: SX, geometry: Sequence[SX] = ()) -> dict[str, Program | None]:
    """Return the programs of the kernels by name, without the control laws, for joint symbols ``q`` (n,)."""
    return {
        "frames": Program("frames", [q, *geometry], [kinematics.body_poses(arm, q)]),
        "jacobian": Program("Jacobian", [q, *geometry], [ca.densify(kinematics.world_jacobian(arm, q))]),
        "nullSpace": Program("null space", [q, *geometry], [_null_space_basis(arm, task, q, geometry)]),
        "inverseKinematicsStep": _inverse_kinematics_program(arm, task, q, geometry),
        "accelerations": _accelerations_program(arm, q),
    }


def _null_space_basis(arm: Arm, task: Task, q: SX, geometry: Sequence[SX]) -> SX:
    """Return an orthonormal basis (n, n - m) of the null space of the task Jacobian, or (n, 0) without redundancy."""
    if arm.n <= task.m:
        return ca.SX(arm.n, 0)
    # All six rows have the same null space in every frame, and one frame has the fewest operations.
    jacobian = kinematics.invariant_jacobian(arm, q) if task.invariant and not geometry else task.jacobian(arm, q)
    # Joints that are not present are the last ones, and thereby add unit vectors at the end.
    basis = factor_householder(jacobian @ ca.diag(geometry[-1]) if geometry else jacobian).null_space_basis()
    return ca.vertcat(*[ca.horzcat(*row) for row in basis])


def _inverse_kinematics_program(arm: Arm, task: Task, q: SX, geometry: Sequence[SX]) -> Program:
    """Return ``q, target pose (3, 4), free joints (n,) -> next q, norm of the error at q``.

    Errors are in rad, and lengths in units of the arm's own length.
    """
    target, free = ca.SX.sym("target", 3, 4), ca.SX.sym("free", arm.n)
    error, jacobian = scaled_error_and_jacobian(arm, task, q, target[:, 3], target[:, :3])
    masked = ca.horzcat(*[jacobian[:, k] * free[k] for k in range(arm.n)])
    next_q, residual = damped_step_and_residual(arm, q, error, masked)
    return Program("inverse kinematics step", [q, target, free, *geometry], [next_q, ca.sqrt(residual)])


def _write_law(arm: Arm, label: str, q: SX, name: str, geometry: Sequence[SX]) -> str:
    """Write ``q, velocity of the tool point in the world (3,) -> joint rates`` in JavaScript."""
    velocity = ca.SX.sym("velocity", 3)
    law = by_name(label, arm, task="position" if geometry else default_path_task(arm, oriented=False))
    task_velocity = ca.sparsify(ca.SX(ca.DM(law.task.rows[:, :3]))) @ velocity
    return law.write_rates_in_javascript(name, q, task_velocity, [q, velocity, *geometry], with_functions=False)


def _accelerations_program(arm: Arm, q: SX) -> Program | None:
    """Return ``q, joint rates, free joints (n,) -> joint accelerations`` without torques, or None without inertial data."""
    if any(link is None for link in arm.links):
        return None
    rates, passive = ca.SX.sym("rates", arm.n), PassiveArm(arm)
    viscous = ca.SX(ca.DM([joint.friction for joint in arm.joints]))
    return Program("accelerations", [q, rates, passive.symbols["free"]], [passive.accelerations(q, rates, viscous)])
