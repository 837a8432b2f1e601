"""Dynamics of an arm without drives, as expressions for the steps of a fall."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import casadi as ca

from holdfast.control.falls.drop_points import DropPoints
from holdfast.control.simulation.system import LARGE_NUMBER, ColumnLayout, ParameterLayout, elementwise_min, make_state_loop
from holdfast.core.caching import cached_property
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import solve_spd
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.model.arm import dynamics, kinematics, statics
from holdfast.model.arm.model import Arm

TIME_ROUNDING_S = 1e-12  # s: two times that differ by less are equal
# Conditions without brakes and rebound in which all joints are free; programs for them are shorter.
PLAIN_CONDITIONS = dict.fromkeys(("load", "brake_torque", "brake_damping", "restitution"), 0.0)
PLAIN_CONDITIONS |= {"free": 1.0, "brake_time": LARGE_NUMBER}
FIXED_INERTIA = 1e100  # kg m^2 or kg; nothing accelerates it by as much as the rounding of a number


class PassiveArm:
    """Symbols of a row of falls, and the expressions that all steps need.

    The parameters of a row are the mask ``free`` of the joints that lose their torque (n,); Coulomb friction, stiction, and
    brake torque (n,), N m or N; the ``load`` share of friction (n,); viscous friction and the damping of the brakes (n,),
    N m s/rad or N s/m; the ``brake_time``, s; the coefficient of ``restitution`` of the stops; the end ``until``, s; the
    ``longest_step``, s; and the coordinates ``start_depth`` (P,) along gravity, m, of the points whose drop is computed. Under
    plain conditions those in ``PLAIN_CONDITIONS`` are constants.
    """

    steps_per_call = 1
    layout: ColumnLayout

    def __init__(self, arm: Arm, points: DropPoints | None = None, is_plain: bool = False) -> None:
        self.arm, self.points, self.is_plain = arm, points or DropPoints.choose(arm), is_plain
        self.made_of: object = arm, self.points, is_plain
        sizes = dict.fromkeys(("free", "coulomb", "stiction", "load", "viscous", "brake_torque", "brake_damping"), arm.n)
        sizes |= dict.fromkeys(("brake_time", "restitution", "until", "longest_step"), 1)
        sizes["start_depth"] = len(self.points.links)
        self.symbols = {name: ca.SX.sym(name, size) for name, size in sizes.items()}
        constants = PLAIN_CONDITIONS if is_plain else {}
        self.parameters = ParameterLayout(**{name: self.symbols[name] for name in sizes if name not in constants})
        self.symbols |= {name: ca.densify(ca.SX(value) * ca.SX.ones(sizes[name])) for name, value in constants.items()}

    @cached_property
    @cached_kernel
    def loop(self) -> Loop:
        """Loop that repeats the steps."""
        return make_state_loop("falls", self._build_call, self.layout, self.parameters.symbols, self.steps_per_call)

    def _build_call(self, parts: dict[str, SX]) -> dict[str, SX]:
        """Return the parts of a state after one call."""
        raise NotImplementedError

    def is_braked(self, time: SX) -> SX:
        """Return 1 if the brakes act at a time, else 0."""
        return ca.SX(0) if self.is_plain else time >= self.symbols["brake_time"] - TIME_ROUNDING_S

    def damping(self, time: SX) -> SX:
        """Return the viscous friction (n,), including that of the brakes."""
        return self.symbols["viscous"] + self.is_braked(time) * self.symbols["brake_damping"]

    def next_step(self, time: SX) -> SX:
        """Return the duration of the next step, s, which ends at the latest when the brakes act or the fall ends."""
        remaining, longest = self.symbols["until"] - time, self.symbols["longest_step"]
        step = ca.if_else(remaining <= longest * (1 + 1e-9), remaining, longest)
        return ca.if_else(self.is_braked(time), step, elementwise_min(step, self.symbols["brake_time"] - time))

    def drop(self, q: SX) -> SX:
        """Return the displacement along gravity, m, of the point that has dropped most."""
        rotation, position = kinematics.split_transform(self.arm.base)
        down, depths = ca.SX(self.arm.down), []
        depth, down = ca.dot(down, position), rotation.T @ down  # of the origin of a frame, and in its axes
        steps = kinematics.joint_transforms(self.arm, q)
        for link, (joint, step) in enumerate(zip(self.arm.joints, steps, strict=True)):
            for rotation, position in (kinematics.split_transform(joint.origin), step):
                depth, down = depth + ca.dot(down, position), rotation.T @ down
            depths += [
                depth + ca.dot(down, ca.SX(point))
                for point_link, point in zip(self.points.links, self.points.positions, strict=True)
                if point_link == link
            ]
        return largest(ca.vertcat(*depths) - self.symbols["start_depth"])

    def accelerations(self, q: SX, rates: SX, damping: SX) -> SX:
        """Return the joint accelerations (n,) with viscous friction alone; joints that are not free have none."""
        torques = -(dynamics.bias_torques(self.arm, q, rates) + damping * rates)
        return solve_selected(statics.inertia_matrix(self.arm, q), torques, self.symbols["free"], ca.SX(self.arm.n, 1))


def solve_selected(matrix: SX, right_side: SX, selected: SX, fixed: SX) -> SX:
    """Solve ``(A x)_i = b_i`` for the selected unknowns of a symmetric positive definite A, with all others fixed.

    Args:
        matrix: (n, n) matrix A.
        right_side: (n,) vector b.
        selected: (n,) 1 for an unknown, 0 for a fixed entry of x.
        fixed: (n,) values of the fixed entries.
    """
    remaining = ca.if_else(selected, right_side, FIXED_INERTIA * fixed)
    heavy = matrix + ca.diag(FIXED_INERTIA * (1 - selected))
    solution = ca.vertcat(*solve_spd([ca.horzsplit(row) for row in ca.vertsplit(heavy)], ca.vertsplit(ca.densify(remaining))))
    return ca.if_else(selected, solution, fixed)


@lru_cache(maxsize=16)
@cached_kernel
def energy_kernel(arm: Arm) -> Kernel:
    """Return the kernel ``q -> potential energy, inertia matrix (n, n)``, J and kg m^2."""
    q = kinematics.joint_symbols(arm)
    potential = statics.potential_energy(statics.composite_bodies(arm, q))
    return Kernel("energy of the arm", [q], [potential, ca.densify(statics.inertia_matrix(arm, q))])


def any_of(conditions: SX) -> SX:
    """Return 1 if any condition of a vector holds, else 0."""
    return ca.sum1(conditions) > 0


def largest(values: SX) -> SX:
    """Return the largest entry of a vector."""
    return _fold(ca.vertsplit(ca.densify(values)), lambda a, b: ca.if_else(a > b, a, b))


def _fold(values: list[SX], combine: Callable[[SX, SX], SX]) -> SX:
    result = values[0]
    for value in values[1:]:
        result = combine(result, value)
    return result
