"""Weighted sums of indices: arithmetic, what they refuse, and what the optimiser is given."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.registry import INDEX_REGISTRY, SUSCEPTIBILITY_REGISTRY
from holdfast.core.status import Status
from holdfast.kernels.linalg import factor_householder
from holdfast.kinematics.indices import (
    CustomIndex,
    NegatedObjective,
    WeightedSum,
    condition_number,
    manipulability,
    relative_manipulability,
)
from holdfast.model.arm import kinematics


def test_arithmetic_is_that_of_numbers(mixed8, rng):
    rho, kr = relative_manipulability(mixed8), manipulability(mixed8)
    q = oracles.inside(mixed8, rng, 20)
    total = 2 * rho + 0.5 * (kr + rho * 3)
    np.testing.assert_allclose(total(q), 2 * rho(q) + 0.5 * (kr(q) + 3 * rho(q)), rtol=1e-14)
    assert float(total(q[0])) == pytest.approx(float(total(q)[0]), rel=1e-15)
    assert [w for w, _ in total.terms] == [2, 0.5, 1.5]
    assert total.better == "larger"
    assert (-1 * total).better == "smaller"
    np.testing.assert_allclose((-total)(q), -total(q))
    assert total.own_task is not None
    assert "2 x relative manipulability" in total.name


def test_a_smaller_is_better_summand_needs_the_other_sign(mixed8, rng):
    rho, kappa = relative_manipulability(mixed8), condition_number(mixed8)
    with pytest.raises(hf.TaskError, match="change the sign"):
        rho + kappa
    total = rho - 0.01 * kappa
    q = oracles.inside(mixed8, rng, 5)
    np.testing.assert_allclose(total(q), rho(q) - 0.01 * kappa(q), rtol=1e-14)
    assert (0.01 * kappa - rho).better == "smaller"


@pytest.mark.parametrize("weight", [0, np.nan, np.inf, "much", None])
def test_weights_that_are_none(mixed8, weight):
    with pytest.raises(hf.InputError, match=r"weight|must be a sequence"):
        WeightedSum([(weight, relative_manipulability(mixed8))])


def test_what_does_not_belong_together(mixed8, mixed7):
    with pytest.raises(hf.InputError, match="use one arm"):
        relative_manipulability(mixed8) + relative_manipulability(mixed7, "position")
    with pytest.raises(hf.TaskError, match="use one"):
        relative_manipulability(mixed8) + relative_manipulability(mixed8, "position")
    with pytest.raises(hf.InputError, match="at least one"):
        WeightedSum([])
    with pytest.raises(TypeError):
        relative_manipulability(mixed8) + 1


def test_singular_rows_are_told():
    planar3 = hf.arms.load("planar-3r")
    rho = relative_manipulability(planar3, "planar")
    total = rho + manipulability(planar3, "planar")
    q = np.array([[0.0, 0.0, 0.0], [0.1, 0.5, 0.9]])
    assert total.row_statuses(q).tolist() == [Status.SINGULAR, Status.OK]


def test_exact_parts_are_the_values_and_their_slopes(mixed8, rng):
    own = CustomIndex(lambda j: ca.sumsqr(j[0, :]), mixed8, better="smaller")
    total = relative_manipulability(mixed8) + 3 * manipulability(mixed8) - 0.2 * own
    q = kinematics.joint_symbols(mixed8)
    j = kinematics.invariant_jacobian(mixed8, q)
    qr = factor_householder(j)
    rows = qr.null_space_basis()
    directions = [ca.vertcat(*[row[c] for row in rows]) for c in range(2)]
    parts = total.parts(q, j, qr, directions)
    value = sum(p.weight * ca.mmin(ca.vertcat(*p.values)) for p in parts)
    function = ca.Function("value", [q], [value, ca.horzcat(*directions)])
    # Differences of the sum along the manifold against the slopes of the functions that are lowest.
    slopes = ca.Function("slopes", [q], [ca.vertcat(*[ca.horzcat(*row) for row in p.slopes]) for p in parts])
    lowest = ca.Function("lowest", [q], [ca.vertcat(*p.values) for p in parts])
    checked = 0
    for x in oracles.inside(mixed8, rng, 12):
        at, null = (np.array(y) for y in function(x))
        np.testing.assert_allclose(at.item(), total(x), rtol=1e-9)
        gaps = [np.diff(np.sort(np.array(v).ravel())[:2]) / np.abs(np.array(v)).max() for v in lowest(x)]
        if min(float(g[0]) for g in gaps) < 1e-4:  # two functions tie: no one slope
            continue
        checked += 1
        mine = sum(p.weight * np.array(s)[np.array(v).argmin()] for p, s, v in zip(parts, slopes(x), lowest(x), strict=True))
        wanted = [(total(x + 1e-6 * d) - total(x - 1e-6 * d)) / 2e-6 for d in null.T]
        np.testing.assert_allclose(mine, wanted, rtol=1e-5, atol=1e-6 * max(1.0, np.abs(wanted).max()))
    assert checked


@pytest.mark.parametrize("name", [*INDEX_REGISTRY, *SUSCEPTIBILITY_REGISTRY])
def test_parts_of_every_objective_give_its_value(name, rng):
    arm = hf.arms.load("panda")
    objective = oracles.index_of(name, arm) if name in INDEX_REGISTRY else hf.susceptibility.by_name(name, arm)
    q = kinematics.joint_symbols(arm)
    j = kinematics.invariant_jacobian(arm, q)
    qr = factor_householder(j)
    directions = [ca.vertcat(*[row[0] for row in qr.null_space_basis()])]
    (part,) = objective.exact_parts(q, j, qr, directions)
    function = ca.Function("value", [q], [part.weight * ca.mmin(ca.vertcat(*part.values))])
    sign = 1 if objective.better == "larger" else -1
    for x in oracles.inside(arm, rng, 5):
        np.testing.assert_allclose(sign * float(function(x)), objective(x), rtol=1e-5)


@pytest.mark.parametrize("kind", ["torque", "sum"])
def test_the_worst_configuration_against_all_there_are(kind, rng):
    arm = hf.arms.load("planar-3r")
    rho, torque = relative_manipulability(arm, "planar"), hf.susceptibility.torque(arm, "worst-case")
    objective = {"torque": torque, "sum": rho - 0.3 * torque}[kind]
    worst = NegatedObjective(objective)
    assert worst.better == ("larger" if kind == "torque" else "smaller")
    for target in rng.uniform(-1.5, 1.5, (3, 2)):
        every = oracles.three_link_fibre(arm, target, 20_000)
        pose = arm.forward_kinematics(every[0])
        np.testing.assert_allclose(arm.forward_kinematics(every)[:, :3, 3], pose[None, :3, 3].repeat(len(every), 0), atol=1e-12)
        values = objective(every)
        found = hf.optimise(arm, pose, worst, task="planar", starts=64).value
        room = values.max() - values.min()
        if kind == "torque":
            assert found == pytest.approx(values.max(), abs=1e-3 * room)
        else:  # at the bottom of a crease, into which steps zigzag: never beyond it, and far down
            assert values.min() - 1e-3 * room <= found <= values.min() + 0.3 * room


def test_the_opposite_is_the_same_number(mixed8, rng):
    rho = relative_manipulability(mixed8)
    worst = NegatedObjective(rho)
    q = oracles.inside(mixed8, rng, 5)
    np.testing.assert_array_equal(worst(q), rho(q))
    assert (worst.better, (-1 * rho).better, NegatedObjective(worst).better) == ("smaller", "smaller", "larger")
    assert worst.own_task is rho.own_task
    assert worst.name == rho.name
    np.testing.assert_array_equal(worst.row_statuses(q), rho.row_statuses(q))


def test_reversed_finds_and_follows_the_worst(rng):
    arm = hf.arms.load("planar-3r")
    torque = hf.susceptibility.torque(arm)
    worst = torque.reversed()
    assert (worst.better, worst.reversed()) == ("larger", torque)
    q = oracles.inside(arm, rng, 5)
    np.testing.assert_array_equal(worst(q), torque(q))
    pose = np.eye(4)
    pose[:2, 3] = 0.6, -1.9
    found = hf.optimise(arm, pose, worst, seed=1, task="planar")
    curve = hf.self_motion(arm, pose, "planar", spacing=0.01)
    assert float(torque(found.q)) == pytest.approx(torque(curve.q).max(), rel=1e-3)
    assert float(torque(hf.optimise(arm, pose, torque, seed=1, task="planar").q)) < 0.5 * float(torque(found.q))
    ahead = hf.paths.line([0.6, -1.9, 0], [0.3, -1.9, 0])
    motion = hf.follow(arm, hf.paths.TimedPath(ahead, hf.paths.Constant(1)), maximise=torque, task="planar", seed=1)
    assert motion.objective.better == "larger"
    end = torque(hf.self_motion(arm, motion.poses[-1], "planar", spacing=0.01).q)
    assert motion.value[-1] > end.min() + 0.8 * (end.max() - end.min())
