"""Parts of curves: pieces get shorter even where the way back to the pose leads somewhere else."""

from __future__ import annotations

import numpy as np

import holdfast as hf
from holdfast.kinematics.solvers.clear_parts import MIN_BOUNDED_CHANGE, CurveConstraint
from holdfast.kinematics.solvers.curve_tracing import Component


class Astray:
    """Brings back to the pose what lies below 1 as it is, and everything else to anywhere."""

    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0)] * 2, name="any")

    def __init__(self, rng):
        self.rng = rng

    def project_onto_poses(self, q, poses):
        return np.where(q[:, :1] < 1, q, self.rng.uniform(-20, 20, q.shape)), np.ones(len(q), dtype=bool), None


def test_a_part_ends_where_the_curve_is_lost(rng):
    q = np.column_stack([np.linspace(0, 2, 9), np.zeros(9)])
    whole = Component(q=q, closed=False, bounded_by=(0, None), length=2.0)
    # A room of which less is left than any of the pieces may use up, so that all are halved.
    clear = CurveConstraint(lambda q: np.full((len(q), 1), 0.01), np.ones((1, 2)), ["room"])
    (part,) = clear.find_feasible_parts(Astray(rng), np.eye(4), whole)
    assert part.bounded_by == (0, None)
    np.testing.assert_array_equal(part.q[0], q[0])
    assert 1 - MIN_BOUNDED_CHANGE <= part.q[-1, 0] <= 1
    assert np.diff(part.q[:, 0]).max() <= 0.02
