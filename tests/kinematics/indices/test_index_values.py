"""Values of all indices: against singular values in numpy, published numbers, long doubles, and laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

import holdfast as hf
import oracles
from holdfast import indices
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.model.arm.task import Task, task_from_rows
from holdfast.model.failure_modes import failure_sets

INVARIANT = ("relative-manipulability", "manipulability")
BASE_FREE = [name for name, entry in INDEX_REGISTRY.items() if "base-free" in entry.properties]

# arm, task, frame, failures, length
CASES = {
    "PA10 pose": ("pa10", "pose", "base", "single", 1.0),
    "PA10 pointing, long": ("pa10", "pointing", "tool", "single", 2.5),
    "PA10 position, sets": ("pa10", "position", "base", [(0, 1), (5, 3), 8], 1.0),
    "mixed pose, short": ("mixed8", "pose", "base", "single", 0.3),
    "mixed pose, pairs": ("mixed8", "pose", "base", [(0, 1), (7, 2), (3, 4)], 1.0),
    "mixed pointing, sets": ("mixed8", "pointing", "tool", [("j1", "j4"), 7, (0, 2, 5), "j2"], 1.0),
    "mixed position, pairs": ("mixed5", "position", "base", "pairs", 1.0),
    "mixed rows": ("mixed5", ["vz", "wx", "wy"], "base", "single", 0.5),
    "mixed rows of the tool": ("mixed5", ["vx", "wz", "wy"], "tool", [(0, 1), (4, 2), 3], 0.5),
    "one row, quadruples": ("mixed5", ["vy"], "base", 4, 1.0),
    "planar": ("planar4", "planar", "base", "pairs", 2.0),
    "planar pose": ("planar4", "planar-pose", "base", "single", 1.0),
}


@pytest.fixture(scope="module")
def make(request):
    """``make(case)``: arm, task, failure sets and the Jacobian of the oracle."""

    def of(case):
        arm_name, task, frame, failures, length = CASES[case]
        arm = request.getfixturevalue(arm_name)
        given = task if isinstance(task, str) else task_from_rows(task, frame=frame)
        return arm, given, failures, length, lambda q: oracles.task_jacobian(arm, q, task, frame, length)

    return of


@pytest.mark.parametrize("case", CASES)
def test_against_singular_values(case, make, rng):
    arm, task, failures, length, jacobian = make(case)
    sets = failure_sets(arm, failures)
    q = oracles.inside(arm, rng, 120)
    j = jacobian(q)
    cond = oracles.condition(j)
    for name in INDEX_REGISTRY:
        index = oracles.index_of(name, arm, task, failures, length)
        assert index.failures == sets
        e = index.evaluate(q)
        truth = oracles.index(name, j, sets, index)
        assert e.by_failure.shape == truth.shape == (120, len(sets))
        if name in INVARIANT:
            scale = 1.0 if name == "relative-manipulability" else np.linalg.svd(j, compute_uv=False).prod(-1)[:, None] ** 2
            error = np.abs(e.by_failure**2 - truth**2) / scale
            assert (error <= (200 * oracles.EPS * cond)[:, None]).all(), name
        elif name == "condition-number":
            np.testing.assert_allclose(1 / e.by_failure, 1 / truth, atol=1e-14)
        elif name == "geometric-mean-singular-value":
            np.testing.assert_allclose(
                e.by_failure**index.task.m, truth**index.task.m, atol=1e-13 * np.max(truth) ** index.task.m
            )
        elif "Abdi 2012" in INDEX_REGISTRY[name].properties:
            np.testing.assert_allclose(e.by_failure, truth, atol=1e-14 * j.shape[2] * np.abs(j).max())
        else:  # the oracle may be as ill-conditioned as the reduced Jacobian
            kept = np.stack([oracles.condition(np.delete(j, list(s), axis=2)) for s in sets], axis=1)
            assert (np.abs(e.by_failure - truth) <= 100 * oracles.EPS * (kept * np.abs(truth) + np.abs(j).max())).all(), name
        worst = oracles.worst(index.better, e.by_failure)
        np.testing.assert_array_equal(e.value, worst)
        np.testing.assert_array_equal(e.by_failure[np.arange(120), e.worst], worst)
        assert (e.status == 0).all()
        np.testing.assert_allclose(index(q), e.value, rtol=1e-15)
        alone = index.worst_case(q)
        np.testing.assert_allclose(alone.value, e.value, rtol=1e-15)
        np.testing.assert_allclose(e.by_failure[np.arange(120), alone.worst], worst, rtol=1e-15)
        np.testing.assert_array_equal(alone.status, e.status)


def test_published_values_of_the_nominal_configuration(pa10):
    """Section 6 of probabilistic-tolerance.md."""
    rho = [0.61245, 0.12725, 0.67622, 0.47972, 0.66629, 0.76427, 0.79161, 0.41179, 0.31151]
    kr = [0.481213, 0.099983, 0.531322, 0.376928, 0.523519, 0.600497, 0.621979, 0.323552, 0.244761]
    low = [0.343474, 0.060262, 0.343474, 0.212061, 0.343474, 0.315362, 0.343474, 0.234484, 0.161155]
    q = oracles.NOMINAL
    for name, values, digits, worst in (
        ("relative-manipulability", rho, 1e-5, 0.127251),
        ("manipulability", kr, 5e-7, 0.099983),
        ("minimum-singular-value", low, 5e-7, 0.060262),
    ):
        index = indices.by_name(name, pa10)
        np.testing.assert_allclose(index.by_joint(q), values, atol=digits)
        assert index(q) == pytest.approx(worst, abs=5e-7)
        assert index.worst_joint(q) == 1
    assert indices.condition_number(pa10)(q) == pytest.approx(35.5947, abs=5e-5)
    assert indices.condition_number(pa10).worst_joint(q) == 1
    position = indices.relative_manipulability(pa10, "position")
    assert position.worst_joint(q) == 1
    assert position(q) == pytest.approx(0.2097, abs=5e-5)


def test_nominal_indices_do_not_depend_on_the_first_and_last_joint(pa10, rng):
    q = np.repeat(oracles.NOMINAL[None], 20, 0)
    q[:, [0, 8]] = rng.uniform(-3, 3, (20, 2))
    for name in BASE_FREE:
        values = oracles.index_of(name, pa10).by_joint(q)
        np.testing.assert_allclose(values, np.broadcast_to(values[:1], values.shape), rtol=1e-12)


@pytest.mark.skipif(not oracles.LONG, reason="long double is double here")
@pytest.mark.parametrize("kind", ["PA10", "alternating", "straight planar"])
def test_rho_keeps_nine_digits_up_to_a_condition_of_1e7(kind, pa10, flat4, rng):
    arm, task = {
        "PA10": lambda: (pa10, "pose"),
        "alternating": lambda: (oracles.alternating_arm(rng, 8), "pose"),
        "straight planar": lambda: (flat4, "planar"),
    }[kind]()
    index = indices.relative_manipulability(arm, task)
    q = oracles.near_singular(rng, arm.n, 400, 1e-7, 1e-1)
    if task == "planar":
        q[:, 0] = rng.uniform(-3, 3, 400)
    if task == "pose":
        j = oracles.jacobian(arm, q.astype(np.longdouble))
    else:
        j = oracles.jacobian(arm, q.astype(np.longdouble))[:, :2]
    cond = oracles.condition(j.astype(float))
    assert ((cond > 1e6) & (cond < 2e7)).sum() > 5  # the draw reaches where it hurts
    near = cond < 2e7
    rho = np.array([oracles.rho_long(x) for x in j[near]])
    error = np.abs(index.by_joint(q[near]) - rho).max(axis=1)
    assert error.max() < 1e-9
    assert (error <= 1e-15 * cond[near] + 1e-14).all()


@pytest.mark.parametrize("case", ["PA10 pose", "PA10 pointing, long", "mixed pose, short", "mixed rows", "planar pose"])
def test_laws_of_rho(case, make, rng):
    arm, task, _, length, _ = make(case)
    index = indices.relative_manipulability(arm, task, length=length)
    m = index.task.m
    q = oracles.inside(arm, rng, 500)
    rho = index.by_joint(q)
    np.testing.assert_allclose((rho**2).sum(axis=1), arm.n - m, atol=1e-10)
    assert index.bound == pytest.approx(np.sqrt((arm.n - m) / arm.n), rel=1e-15)
    assert (index(q) <= index.bound + 1e-12).all()
    assert ((rho >= 0) & (rho <= 1 + 1e-14)).all()
    with_bound = indices.relative_manipulability(arm, task, [0, 1], length=length)
    assert with_bound.bound is None


def test_the_bound_is_attained_where_all_rho_are_equal():
    """Three unit sliding joints at 120 degrees in a plane: rho = sqrt(1/3) each."""
    joints = [
        hf.Joint(f"s{k}", "prismatic", np.eye(4), axis=np.array([np.cos(a), np.sin(a), 0]))
        for k, a in enumerate(np.radians([0, 120, 240]))
    ]
    index = indices.relative_manipulability(hf.Arm(name="star", joints=tuple(joints)), ["vx", "vy"])
    assert index.bound == pytest.approx(np.sqrt(1 / 3))
    np.testing.assert_allclose(index.by_joint([0.1, 0.2, 0.3]), index.bound, rtol=1e-15)


def sliding(directions):
    """An arm of sliding joints along (n, 3) directions: their transpose is the Jacobian of a position."""
    joints = tuple(hf.Joint(f"s{k}", "prismatic", np.eye(4), axis=np.array(d)) for k, d in enumerate(directions))
    return hf.Arm(name="slides", joints=joints)


def test_the_bound_of_pairs_is_attained_by_the_axes_of_an_icosahedron():
    golden = (1 + np.sqrt(5)) / 2
    corners = np.array([[0, 1, golden], [0, -1, golden]]) / np.hypot(1, golden)
    axes = np.concatenate([np.roll(corners, k, axis=1) for k in range(3)])
    index = indices.relative_manipulability(sliding(axes), "position", 2)
    assert index.bound == pytest.approx(np.sqrt(1 / 5))
    assert index.bound_note == ""
    assert index(np.zeros(6)) == pytest.approx(index.bound, rel=1e-12)


@pytest.mark.parametrize("n", [4, 5])
def test_the_bound_of_two_of_two_is_that_of_a_regular_star(n, rng):
    """The closed form by a regular star, and a search over Jacobians that comes near it and never beyond: QR and minors."""
    m = n - 2
    best = 2 / n * np.sin(np.pi / n)
    angle = np.pi * np.arange(n) / n
    star = np.sqrt(2 / n) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    jacobian = np.linalg.svd(star.T)[2][2:]
    directions = np.zeros((n, 3))
    directions[:, :m] = jacobian.T
    # Joint axes have length 1 (rho knows no scale of rows, but of columns it does): the star's columns are equal already.
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    index = indices.relative_manipulability(sliding(directions), ["vx", "vy", "vz"][:m], 2)
    assert index(np.zeros(n)) == pytest.approx(best, rel=1e-12)
    assert index.bound == pytest.approx(best, rel=1e-12)
    assert index.is_attained
    assert index.bound_note == ""

    def least(x):
        basis = np.linalg.qr(x.reshape(n, 2))[0]
        return min(abs(np.linalg.det(basis[[i, j]])) for i in range(n) for j in range(i))

    found = max(-minimize(lambda x: -least(x), rng.normal(size=2 * n), method="Nelder-Mead").fun for _ in range(12))
    assert 0.8 * best < found <= best + 1e-12


@pytest.mark.parametrize("arm_name", ["pa10", "mixed7"])
def test_rho_is_blind_to_base_tool_orientation_and_row_units(arm_name, request, rng):
    arm = request.getfixturevalue(arm_name)
    q = oracles.inside(arm, rng, 40)
    kr = indices.manipulability(arm).by_joint(q)
    rho = indices.relative_manipulability(arm).by_joint(q)
    j = oracles.jacobian(arm, q)
    tolerance = 1e-13 * oracles.condition(j)[:, None]
    moved = arm.with_base(oracles.random_pose(rng))
    turned = replace(moved, tool=arm.tool @ oracles.pose(oracles.random_pose(rng)[:3, :3]))
    shifted = replace(arm, tool=arm.tool @ oracles.random_pose(rng))
    for other in (turned, shifted):
        assert (np.abs(indices.relative_manipulability(other).by_joint(q) - rho) <= tolerance).all()
        np.testing.assert_allclose(indices.manipulability(other).by_joint(q), kr, rtol=1e-6, atol=1e-13)
    length = 0.1
    assert (np.abs(indices.relative_manipulability(arm, length=length).by_joint(q) - rho) <= 100 * tolerance).all()
    # Three linear rows divided by the length.
    scaled = indices.manipulability(arm, length=length).by_joint(q) * length**3
    np.testing.assert_allclose(scaled, kr, rtol=1e-6, atol=1e-12)
    assert not np.allclose(indices.mean_singular_value(arm, length=length)(q), indices.mean_singular_value(arm)(q), rtol=1e-3)


def test_partial_tasks_depend_on_length_as_their_rows_say(mixed5, rng):
    q = oracles.inside(mixed5, rng, 20)
    for task, linear in (("position", 3), (["vx", "wy"], 1), (["wx", "wy"], 0)):
        one, other = (indices.manipulability(mixed5, task, length=x).by_joint(q) for x in (1.0, 0.2))
        np.testing.assert_allclose(other, one * 0.2**-linear, rtol=1e-9, atol=1e-12)


def test_the_unit_of_a_sliding_joint_changes_rho(mixed8, rng):
    """The law has a limit: rho depends on the unit of a single column. A joint that moves 1000 times as far is another arm."""
    q = oracles.inside(mixed8, rng, 1)
    j = oracles.jacobian(mixed8, q)
    scaled = j * np.where(mixed8.prismatic, 1000.0, 1.0)
    sets = failure_sets(mixed8)
    assert not np.allclose(*(oracles.index("relative-manipulability", x, sets) for x in (j, scaled)), atol=1e-2)
    np.testing.assert_allclose(
        indices.relative_manipulability(mixed8).by_joint(q), oracles.index("relative-manipulability", j, sets), atol=1e-9
    )


def test_the_elbow_of_the_seven_joint_pa10_is_a_single_point_of_failure(pa10_7, rng):
    q = oracles.inside(pa10_7, rng, 2000)
    cond = oracles.condition(oracles.jacobian(pa10_7, q))
    index = indices.relative_manipulability(pa10_7)
    rho = index.by_joint(q)
    assert (rho[:, 3] <= 1e-14 * cond).all()
    good = cond < 1e4
    assert good.mean() > 0.9
    np.testing.assert_array_equal(index.worst_joint(q[good]), 3)
    np.testing.assert_allclose(index.gradient(q[good]), 0, atol=1e-6)
    assert np.median(rho[:, [0, 1, 2, 4, 5, 6]].min(axis=1)) > 0.01  # only the elbow


def test_a_joint_that_does_not_move_the_task_has_rho_one(pa10, rng):
    """The tool point lies on axis 9, so position does not feel joint 9."""
    q = oracles.inside(pa10, rng, 50)
    index = indices.relative_manipulability(pa10, "position")
    np.testing.assert_allclose(index.by_joint(q)[:, 8], 1.0, atol=1e-14)
    locked = [
        indices.manipulability(pa10, "position", [8]).by_joint(q)[:, 0],
        np.linalg.svd(pa10.jacobian(q)[:, :3])[1].prod(-1),
    ]
    np.testing.assert_allclose(*locked, rtol=1e-12)


@pytest.mark.parametrize("name", INDEX_REGISTRY)
def test_locking_a_joint_is_deleting_its_column(name, mixed7, rng):
    """An arm built with joint 2 welded at its present angle has the reduced Jacobian: the same arm by another door."""
    task = Task("own", np.linalg.qr(rng.normal(size=(6, 6)))[0][:4])
    index = oracles.index_of(name, mixed7, task, [(2, 5)])
    q = oracles.inside(mixed7, rng, 1)[0]
    joints, pending = [], np.eye(4)
    for k, joint in enumerate(mixed7.joints):
        origin = pending @ joint.origin
        if k in (2, 5):
            pending = origin @ oracles._motion(joint, q[k : k + 1])[0][0]
        else:
            joints.append(replace(joint, origin=origin))
            pending = np.eye(4)
    welded = hf.Arm(name="welded", joints=tuple(joints), base=mixed7.base, tool=pending @ mixed7.tool)
    rest = np.delete(q, [2, 5])
    kept, whole = task.rows @ welded.jacobian(rest), task.rows @ mixed7.jacobian(q)
    assert index(q) == pytest.approx(oracles.ORACLES["index"][name](kept[None], whole[None], index)[0], rel=1e-10)
