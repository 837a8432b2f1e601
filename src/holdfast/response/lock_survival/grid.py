"""Self-motion curves of every pose of a path as numbered nodes with their neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.self_motions import SelfMotion
from holdfast.model.arm.model import Arm

if TYPE_CHECKING:
    from scipy.spatial import KDTree


@dataclass(frozen=True, eq=False)
class CurveNodes:
    """The P nodes of all self-motion curves of one pose.

    Attributes:
        arm: The arm.
        q: (P, n) configurations, rad and m.
        curve: (P,) index of the curve of each node.
        previous, following: (P,) neighbours along the curve; at an open end the node itself.
        pieces: (P, n) difference from each node to the following one, rad and m.
        embedded: (P, e) coordinates whose Euclidean distance is that of configurations: (cos, sin) of joints without limits.
        spacing: Largest distance between neighbours, rad (and m).
    """

    arm: Arm
    q: FloatArray
    curve: IndexArray
    previous: IndexArray
    following: IndexArray
    pieces: FloatArray
    embedded: FloatArray
    spacing: float

    @classmethod
    def from_self_motion(cls, arm: Arm, self_motion: SelfMotion) -> CurveNodes:
        """Return the nodes of a self-motion manifold of curves."""
        previous, following, curves = [], [], []
        first_node = 0
        for component_index, component in enumerate(self_motion.components):
            size = len(component.q)
            node_numbers = np.arange(first_node, first_node + size)
            ends = (node_numbers[-1], node_numbers[0]) if component.closed else (node_numbers[0], node_numbers[-1])
            previous.append(np.concatenate([[ends[0]], node_numbers[:-1]]))
            following.append(np.concatenate([node_numbers[1:], [ends[1]]]))
            curves.append(np.full(size, component_index))
            first_node += size
        empty = [np.empty(0, dtype=np.int64)]
        return cls._create(
            arm,
            self_motion.q,
            self_motion.spacing,
            *(np.concatenate(parts or empty).astype(np.int64) for parts in (curves, previous, following)),
        )

    @classmethod
    def from_configuration(cls, arm: Arm, q: FloatArray, spacing: float) -> CurveNodes:
        """Return a single configuration (n,) as nodes."""
        zero = np.zeros(1, dtype=np.int64)
        return cls._create(arm, q[None], spacing, zero, zero, zero)

    @classmethod
    def _create(
        cls, arm: Arm, q: FloatArray, spacing: float, curve: IndexArray, previous: IndexArray, following: IndexArray
    ) -> CurveNodes:
        return cls(
            arm,
            q,
            curve,
            previous,
            following,
            joint_space.joint_difference(arm, q[following], q),
            embed_configurations(arm, q),
            spacing,
        )

    @cached_property
    def _search_tree(self) -> KDTree:
        return joint_space.build_tree(self.arm, self.q)

    def locate_on_curves(self, q: FloatArray) -> tuple[IndexArray, FloatArray, BoolArray]:
        """Return for q (N, n) the node behind it along its curve (N,), the fraction of the segment to the next node (N,), 0 to
        1, and a flag (N,) that is True on a curve.
        """
        if not len(self.q):
            return np.zeros(len(q), dtype=np.int64), np.zeros(len(q)), np.zeros(len(q), dtype=bool)
        distances, nearest = self._search_tree.query(joint_space.wrap_joints_to_positive(self.arm, q))
        previous_nodes, next_nodes = self.previous[nearest], self.following[nearest]
        is_ahead = (
            np.einsum(
                "ij,ij->i",
                joint_space.joint_difference(self.arm, q, self.q[nearest]),
                self.pieces[nearest] + self.pieces[previous_nodes],
            )
            > 0
        )
        nodes_behind = np.where(is_ahead & (next_nodes != nearest), nearest, previous_nodes)
        segments = self.pieces[nodes_behind]
        projections = np.einsum("ij,ij->i", joint_space.joint_difference(self.arm, q, self.q[nodes_behind]), segments)
        fractions = np.clip(projections / np.maximum(np.einsum("ij,ij->i", segments, segments), 1e-300), 0.0, 1.0)
        return nodes_behind, fractions, np.asarray(distances <= self.spacing)


def make_nodes(arm: Arm, self_motions: Sequence[SelfMotion]) -> list[CurveNodes]:
    """Return the nodes of every pose."""
    return [CurveNodes.from_self_motion(arm, self_motion) for self_motion in self_motions]


def embed_configurations(arm: Arm, q: FloatArray) -> FloatArray:
    """Return coordinates (N, e) of q (N, n): unlimited revolute joints as cosine and sine, the others unchanged."""
    turning = joint_space.is_unlimited(arm)
    return np.concatenate([q[:, ~turning], np.cos(q[:, turning]), np.sin(q[:, turning])], axis=1)


def compute_squared_distances(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return squared distances (N, P) of rows a (N, e) from rows b (P, e), clipped at 0 against rounding."""
    product = a @ b.T
    product *= -2
    product += np.einsum("ij,ij->i", a, a)[:, None]
    product += np.einsum("ij,ij->i", b, b)
    return np.maximum(product, 0.0, out=product)
