"""Bounds of gravity torques and of potential energy over boxes of configurations, with the formulas of the verifier.

The numbers here have no error bounds; the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

import casadi as ca
import numpy as np

from holdfast.certificates.joint_boxes.halving import OPEN_TOKEN, BoxBisection
from holdfast.certificates.tree import PROVED_TOKEN
from holdfast.certificates.verifier_parts.tree import REFUTED_TOKEN
from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm import kinematics, statics
from holdfast.model.arm.model import Arm

ROUNDING_RATIO = 1e-10  # margin for the verifier's rounding, relative to the largest possible torques
_MINIMUM_TOLERANCE = 0.03
_MINIMUM_HALVINGS = 20
_MINIMUM_NODES = 1 << 15


@cached_kernel
def gravity_kernel(arm: Arm) -> Kernel:
    """Return the kernel from the middle and half widths (n,) of a box to energy, torques, and bounds of their change.

    The bounds are those of the energy after first order (n,), by joint, and of the torques (n, n), by torque and joint.
    """
    q, half, n = kinematics.joint_symbols(arm), ca.SX.sym("half", arm.n), arm.n
    bodies, up = statics.express_in_world(statics.composite_bodies(arm, q)), -arm.gravity
    axes = [ca.SX(3, 1) if arm.joints[k].prismatic else bodies.axes[k] for k in range(n)]
    angles = [0 if arm.joints[k].prismatic else half[k] for k in range(n)]
    columns, length = [statics.first_moment_rate(arm, bodies, k) for k in range(n)], float(np.linalg.norm(up))
    turned_up, last = [ca.cross(up, axis) for axis in axes], [ca.norm_2(column) for column in columns]
    first = [ca.fmin(length, ca.norm_2(turned_up[k]) + length * sum(angles[:k])) for k in range(n)]
    for k in (k for k in reversed(range(n)) if not arm.joints[k].prismatic):
        last[k] += sum(half[j] * last[j] for j in range(k + 1, n))
    energy_costs, torque_costs = ca.SX(n, 1), ca.SX(n, n)
    for a, b in combinations_with_replacement(range(n), 2):
        second, area = ca.dot(turned_up[a], columns[b]), half[a] * half[b]
        weight = angles[a] ** 3 if a == b else 3 * angles[a] * half[b] * (angles[a] + angles[b] + 2 * sum(angles[a + 1 : b]))
        energy_cost = area * (ca.fmax(-second, 0) / 2 if a == b else ca.fabs(second)) + weight / 6 * first[a] * last[b]
        for i, j in {(a, b), (b, a)}:
            torque_costs[i, j] += ca.fabs(second) * half[j]
        for j in (a, b):  # costs of a pair of joints are divided equally
            energy_costs[j] += energy_cost / 2
            for i in range(n):
                x, y, z = sorted((i, a, b))
                third = ca.fabs(ca.dot(turned_up[x], ca.cross(axes[y], columns[z]))) * area / (2 if a == b else 1)
                torque_costs[i, j] += (third + weight / 6 * first[min(i, a)] * last[max(i, b)]) / 2
    torques = ca.vertcat(*[ca.dot(up, column) for column in columns])
    outputs = [statics.potential_energy(bodies), torques, energy_costs, torque_costs]
    return Kernel("bounds of gravity", [q, half], [ca.densify(output) for output in outputs])


@dataclass(frozen=True, eq=False)
class HoldTest:
    """Test whether each gravity torque is between ``least`` and ``most`` (n,) in boxes, or that of some joint nowhere is."""

    arm: Arm
    least: FloatArray
    most: FloatArray

    @cached_property
    def _kernel(self) -> Kernel:
        return gravity_kernel(self.arm)

    def __call__(self, middle: FloatArray, half: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the tokens of boxes, and the gain of halving each joint."""
        n, rows = self.arm.n, self._kernel.rows(middle, half)
        torques, costs = rows[:, 1 : n + 1], rows[:, 2 * n + 1 :].reshape(-1, n, n)
        margin = ROUNDING_RATIO * statics.torque_scale(self.arm)
        change, excess = costs.sum(axis=2) + margin, np.maximum(torques - self.most, self.least - torques)
        tokens = np.where((excess < -change).all(axis=1), PROVED_TOKEN, OPEN_TOKEN)
        tokens = np.where((excess > change).any(axis=1), REFUTED_TOKEN, tokens)
        ratio = excess / change  # above 1: the joint moves in the whole box, below -1: it holds
        largest = ratio.max(axis=1, keepdims=True)  # above 0: some joint moves at the middle, and one joint suffices
        weights = np.where(largest > 0, ratio == largest, ratio > -1) / change
        return tokens, np.einsum("ni,nij->nj", weights, costs)


class EnergySearch:
    """Search for the least energy above a start (n,), with the work of friction (n,), on the faces of a box or within it."""

    def __init__(self, arm: Arm, start: FloatArray, friction: FloatArray) -> None:
        self._arm, self._start, self._friction, self._kernel = arm, start, friction, gravity_kernel(arm)
        self._start_energy = self._kernel(start, np.zeros(arm.n))[0]
        self._margin = ROUNDING_RATIO * float(statics.torque_scale(arm).max())

    def run(self, joint_box: FloatArray, *, enough: float = -np.inf, on_faces: bool = True) -> tuple[float, bytes]:
        """Return a lower bound of the least energy, J, and the tree of the bisection that proves it.

        The last axis of the bisection numbers lower and upper faces; those at limits do not count. If the least energy is below
        ``enough``, the search ends with -infinity.
        """
        self._joint_box, self._enough, self._on_faces = joint_box, enough, on_faces
        self._least = self._bound = np.inf
        faces = [0, 1 << (2 * self._arm.n - 1).bit_length()] if on_faces else [2 * self._arm.n, 2 * self._arm.n + 1]
        numbers = np.arange(*faces)[:, None] + 0.5
        nearest = np.hstack([np.tile(self._start, (len(numbers), 1)), numbers])  # points of the faces, where energies are small
        self._test_boxes(nearest, 0.5 * np.eye(self._arm.n + 1)[[-1] * len(numbers)])
        bisection = BoxBisection(np.vstack([joint_box, faces]), _MINIMUM_HALVINGS)
        if not bisection.run(self._test_boxes, max_nodes=_MINIMUM_NODES):
            self._enough = np.inf  # so that the remaining boxes count as they are
            bisection.run(self._test_boxes)
        return -np.inf if self._least < enough else self._bound - 2 * self._margin, bisection.tree.preorder_tokens()

    def _test_boxes(self, middle: FloatArray, half: FloatArray) -> tuple[IndexArray, FloatArray]:
        n, (joint, side), is_single = self._arm.n, divmod(middle[:, -1].astype(np.int64), 2), half[:, -1] <= 0.5
        on_face, middle, half = joint < n, middle[:, :-1].copy(), half[:, :-1].copy()
        pinned = np.flatnonzero(on_face), joint[on_face]
        places = self._joint_box[joint[on_face], side[on_face]]
        middle[pinned], half[pinned] = places, 0.0
        counts = on_face.copy() if self._on_faces else is_single
        counts[pinned[0]] &= places != np.where(side[on_face], self._arm.upper[pinned[1]], self._arm.lower[pinned[1]])
        energy, torques, costs, _ = np.split(self._kernel.rows(middle, half), [1, n + 1, 2 * n + 1], axis=1)
        offset, value = middle - self._start, energy[:, 0] - self._start_energy
        with np.errstate(invalid="ignore", divide="ignore"):
            balance = np.nan_to_num(np.clip(-torques / self._friction, -1, 1))
        force = self._friction * np.where(np.abs(offset) >= half, np.sign(offset), balance)
        slope = torques + force
        lower = np.where(counts, value + (force * offset - np.abs(slope) * half - costs).sum(axis=1), np.inf)
        lowest = np.where(np.abs(force) < self._friction, self._start, middle - np.sign(slope) * half)  # for the linear bound
        upper = self._kernel.rows(lowest, 0 * half)[:, 0] - self._start_energy + np.abs(lowest - self._start) @ self._friction
        self._least = min(self._least, float(upper[counts & is_single].min(initial=np.inf)))
        gap = _MINIMUM_TOLERANCE * abs(self._least) + self._margin
        is_last = is_single & (~counts | (lower >= self._least - gap) | (self._least < self._enough))
        self._bound = min(self._bound, float(lower[is_last].min(initial=np.inf)))
        return np.where(is_last, PROVED_TOKEN, OPEN_TOKEN), np.column_stack([np.where(is_single, costs.T, 0.0).T, ~is_single])


def bound_drop(arm: Arm, q: FloatArray, joint_box: FloatArray) -> float:
    """Return an upper bound of the height, m, by which the tool point can be below that at ``q`` (n,) within a box (n, 2)."""
    bare = replace(statics.links_with_payload(arm)[0], mass=0.0, com=np.zeros(3), inertia=np.zeros((3, 3)))
    point = replace(bare, mass=1.0, com=arm.tool[:3, 3])  # the energy of 1 kg at the tool point is its height
    search = EnergySearch(replace(arm, links=(bare,) * arm.n, payload=point), q, np.zeros(arm.n))
    return 1e-9 - search.run(joint_box, on_faces=False)[0] / max(float(np.linalg.norm(arm.gravity)), 1e-9)
