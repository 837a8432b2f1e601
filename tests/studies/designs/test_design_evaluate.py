"""What designs are worth and how that changes, against hf.optimise on each arm by itself, differences and closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.kernels import compiled
from holdfast.studies.designs import design_space
from holdfast.studies.designs.evaluation import Evaluated, Evaluator
from holdfast.studies.designs.family import Family
from holdfast.studies.designs.gradient import sensitivity


def alone(space, values, poses, starts=128):
    """What hf.optimise finds for one design."""
    arm = space.arm_of(values)
    return hf.optimise(arm, poses, hf.indices.relative_manipulability(arm, "planar"), starts=starts)


def test_designs_are_worth_what_each_is_worth_alone(space3, found3, poses3):
    best = alone(space3, found3.values[3], poses3)
    np.testing.assert_array_equal(best.success, found3.reached[3])
    gap = (best.value - found3.value[3])[best.success]
    assert (gap > 1e-3).mean() < 0.15  # neighbours' configurations stand in for random starts
    assert gap.max() < 0.3
    assert gap.min() > -0.1


def test_configurations_keep_pose_limits_and_value(space3, found3, poses3):
    for i, x in enumerate(found3.values):
        arm, ok = space3.arm_of(x), found3.reached[i]
        q = found3.q[i][ok]
        assert ((q >= arm.lower) & (q <= arm.upper)).all()
        np.testing.assert_allclose(oracles.forward(arm, q)[:, :2, 3], poses3[ok, :2, 3], atol=1.1e-6)
        np.testing.assert_allclose(hf.indices.relative_manipulability(arm, "planar")(q), found3.value[i][ok], atol=1e-9)
        assert (found3.miss[i][~ok] > 1e-6).all()
        assert (found3.miss[i][ok] == 0).all()
        assert (found3.value[i][~ok] == 0).all()


def test_the_same_bits_for_any_number_of_threads(evaluator3, found3, threads):
    threads(1)
    again = evaluator3(found3.values)
    for name in Evaluated.__dataclass_fields__:
        np.testing.assert_array_equal(getattr(again, name), getattr(found3, name))


def test_many_designs_are_computed_by_better_code_from_the_first_step_on(space3, found3, poses3, tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))
    for worth in ("REPAYING_WORK", "REPAYING_WORK_OF_SHORT"):
        monkeypatch.setattr(compiled, worth, 10)
    family = Family(space3, task="planar")
    again = Evaluator(family, poses3)(found3.values)
    assert {k._compiled.level for k in (family.inverse.step, family.ascent)} == {1}
    np.testing.assert_array_equal(again.value, found3.value)


def test_no_designs(evaluator3, space3):
    assert evaluator3(np.empty((0, len(space3.parameters)))).value.shape == (0, len(evaluator3.poses))


def test_gradients_are_differences_of_what_is_optimised_anew(space3, evaluator3, found3, poses3):
    rows = np.flatnonzero(found3.reached[0])
    s = sensitivity(evaluator3, found3.take([0]), rows)
    assert s.exact.mean() > 0.95
    h = 1e-5
    for name in ("a2", "upper3"):  # a length, and a limit that is a parameter itself
        k = space3.names.index(name)
        step = h * np.eye(len(space3.names))[k]
        sides = [alone(space3, space3.start + sign * step, poses3[rows], 32) for sign in (1, -1)]
        # The same optimum on both sides: where another one takes over, differences mean nothing.
        near = np.all([np.abs(x.q - s.q).max(axis=1) < 1e-2 for x in sides], axis=0) & s.exact
        assert near.sum() >= 5
        difference = (sides[0].value - sides[1].value) / (2 * h)
        # Those of hf.optimise are themselves only as exact as its last steps.
        error = np.abs(difference - s.gradient[:, k])[near]
        assert np.median(error) < 1e-6
        assert np.quantile(error, 0.8) < 1e-3
    limited = s.gradient[:, space3.names.index("upper3")]
    assert (limited >= -1e-12).all()  # more room is never worse
    assert (s.gradient[:, space3.names.index("lower2")] <= 1e-12).all()


def test_exact_optima_balance(space3, evaluator3, found3):
    """Values after Newton's method are no less, and their differences along the design give the gradient to 1e-6."""
    rows = np.flatnonzero(found3.reached.reshape(-1))[:40]
    s = sensitivity(evaluator3, found3, rows)
    value = found3.value.reshape(-1)[rows]
    assert (s.value >= value - 1e-6).all()
    direction, h = np.array([0.3, -0.5, 0.4, 0.2, -0.3]), 1e-6
    sides = []
    for sign in (1, -1):
        values = found3.values + sign * h * direction
        moved = evaluator3._search_configurations(values, found3.q[:, :, None], 0)
        sides.append(sensitivity(evaluator3, moved, rows))
    same = np.all([np.abs(x.q - s.q).max(axis=1) < 1e-3 for x in sides], axis=0) & s.exact & sides[0].exact & sides[1].exact
    assert same.sum() > 0.5 * len(rows)
    difference = (sides[0].value - sides[1].value) / (2 * h)
    np.testing.assert_allclose(difference[same], (s.gradient @ direction)[same], atol=1e-5)


def test_a_pose_beyond_reach_misses_by_the_rest_of_the_way():
    """Links 1, 0.8, 0.6 stretched towards a point: the miss is the distance less 2.4 m, its slope by each length -1."""
    arm = hf.Arm.from_dh([hf.DH(a=a, alpha=0.0) for a in (1.0, 0.8, 0.6)])
    space = design_space(arm, {"a1": (0.5, 1.5), "a2": (0.5, 1.5), "a3": (0.3, 1.0)})
    pose = oracles.pose(None, [3.0, 1.0, 0.0])
    evaluator = Evaluator(Family(space, task="planar"), pose[None])
    found = evaluator(space.start[None])
    assert not found.reached.any()
    s = sensitivity(evaluator, found, np.array([0]))
    assert s.value[0] == pytest.approx(2.4 - np.hypot(3, 1), abs=1e-9)
    np.testing.assert_allclose(s.gradient[0], 1.0, atol=1e-7)
    assert s.exact.all()
