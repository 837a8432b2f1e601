"""An arm and its copies in other sizes, from 1 mm to 1 km and beyond, do the same."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.control import Damped, Pseudoinverse
from holdfast.control.convergence.healthy_cost import measure_healthy_cost
from holdfast.control.simulation import RunOutcome, simulate
from holdfast.kinematics.solvers import solve_ik
from holdfast.model.arm.task import as_task
from holdfast.response.recovery.proofs.reach import prove_by_reach_bound
from holdfast.studies.designs import design_space
from holdfast.studies.designs.evaluation import Evaluator
from holdfast.studies.designs.family import Family

# A power of two rounds nothing: such a copy does the same to the last bit. The others are 1 mm and 1 km exactly.
EXACT, ROUNDED = [2.0**-10, 2.0**10], [1e-3, 1e3]


def scaled(arm, size):
    """A copy of an arm of turning joints."""

    joints = tuple(replace(j, origin=resized(j.origin, size)) for j in arm.joints)
    return hf.Arm(name=arm.name, joints=joints, base=resized(arm.base, size), tool=resized(arm.tool, size))


def resized(targets, size):
    """Poses (..., 4, 4), or positions, for the copy."""
    out = np.array(targets)
    if out.shape[-2:] == (4, 4):
        out[..., :3, 3] *= size
        return out
    return out * size


@pytest.fixture(scope="module")
def links():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def bent(generator):
    """Four turning joints in space, nothing aligned."""
    return oracles.random_arm(generator("scaled arm"), types="CCCC")


@pytest.mark.parametrize("size", [*EXACT, *ROUNDED, 1.0])
def test_the_unit_is_a_power_of_two_near_the_arm_s_links_end_to_end(bent, size):
    arm = scaled(bent, size)
    whole = sum(np.linalg.norm(j.origin[:3, 3]) for j in arm.joints[1:]) + np.linalg.norm(arm.tool[:3, 3])
    unit = arm.length_unit
    assert np.log2(unit) == np.round(np.log2(unit))
    assert 2**-0.5 <= unit / whole <= 2**0.5
    assert hf.Arm(name="point", joints=(hf.Joint("a", "continuous", np.eye(4), axis=[0, 0, 1]),)).length_unit == 1.0


def cases(rng, arm, task, count):
    q0 = rng.uniform(-np.pi, np.pi, (count, arm.n))
    target = arm.forward_kinematics(rng.uniform(-np.pi, np.pi, (count, arm.n)))
    return q0, target, rng.integers(0, arm.n, count)


@pytest.fixture(scope="module")
def moved(bent, generator):
    """``moved(task, size)``: the same motions at a size; those at size 1, which every other is compared with, once."""

    @cache
    def at(task, size):
        arm = bent if task == "position" else oracles.random_arm(generator("scaled seven"), types="C" * 7)
        q0, target, locked = cases(generator(f"scaled {task}"), arm, task, 12)
        resized_arm = arm if size == 1.0 else scaled(arm, size)
        return simulate(Pseudoinverse(resized_arm, task), q0, resized(target, size), locked=locked, time_limit=60.0)

    return at


@pytest.mark.parametrize(
    ("size", "task"), [(EXACT[0], "pose"), (ROUNDED[1], "pose"), (EXACT[1], "position"), (ROUNDED[0], "position")]
)
def test_motions(moved, task, size):
    own, other = moved(task, 1.0), moved(task, size)
    assert (own.code == RunOutcome.CONVERGED).any()
    np.testing.assert_array_equal(own.code, other.code)
    np.testing.assert_array_equal(own.reason, other.reason)
    if size in EXACT:
        np.testing.assert_array_equal(own.q_final, other.q_final)
        np.testing.assert_array_equal(own.time, other.time)
        np.testing.assert_array_equal(own.path_length * size, other.path_length)
        np.testing.assert_array_equal(own.x_final, resized(other.x_final, 1 / size))
    rest = own.code <= RunOutcome.STUCK
    np.testing.assert_allclose(own.x_final[rest], resized(other.x_final[rest], 1 / size), atol=1e-6)


@pytest.mark.parametrize("size", [*EXACT, 1e-6, 1e6])
def test_runs_that_converge_are_not_called_stuck(links, rng, size):
    """The failed arm is a planar 2R whose target is in its ring: it converges but for sinks, which this target has none of."""
    q0 = np.column_stack([rng.uniform(-np.pi, np.pi, 30), np.full(30, np.pi / 4), rng.uniform(-np.pi, np.pi, 30)])
    for law in (Pseudoinverse(scaled(links, size), "planar"), Damped(scaled(links, size), 0.05, planar(links, size))):
        runs = simulate(law, q0, [1.5 * size, 1.5 * size], locked=[1])
        assert list(runs.outcome) == ["converged"] * 30


def planar(arm, size):
    """Damping is in the unit of the Jacobian: it scales with the characteristic length."""
    return as_task(arm, "planar", length=size)


@pytest.mark.interpreted
@pytest.mark.parametrize("size", [EXACT[1], ROUNDED[0]])
def test_cycles_and_the_least_error(links, rng, size):
    q0, x = rng.uniform(-2, 2, (6, 3)), rng.uniform(-4, 4, (6, 2))
    own, other = (
        simulate(
            Pseudoinverse(scaled(links, s), "planar", speed_limit=0.05 * s), q0, x * s, locked=[0], cycles=True, radius=0.1 * s
        )
        for s in (1.0, size)
    )
    np.testing.assert_array_equal(own.code, other.code)
    # When it counts as standing still depends on the unit, and with it, by a cycle or two, on how much that was rounded.
    np.testing.assert_allclose(own.time, other.time, atol=0 if size in EXACT else 2)
    # An upper bound, which a search that creeps along a stretched arm may leave a little too high.
    np.testing.assert_allclose(own.least_error(), other.least_error() / size, atol=0 if size in EXACT else 0.02)


@pytest.mark.parametrize("size", [*EXACT, *ROUNDED, 1e-6, 1e6])
def test_points_of_rest_are_the_published_ones(links, size):
    """The table of the planar arm with unit links, target (1.5, 1.5), joint 2 locked at 100 and at 140 degrees."""
    law = Pseudoinverse(scaled(links, size), "planar")
    points = hf.stationary_points(law, [1.5 * size, 1.5 * size], {1: np.deg2rad(100.0)})
    assert sorted(points.kinds) == ["saddle", "saddle", "saddle", "solution", "solution", "source"]
    source = points.q[[k == "source" for k in points.kinds]]
    np.testing.assert_allclose(np.rad2deg(source), [[-42.4502, 100, -50]], atol=1e-3)
    points = hf.stationary_points(law, [1.5 * size, 1.5 * size], {1: np.deg2rad(140.0)})
    sink = [k == "sink" for k in points.kinds]
    np.testing.assert_allclose(np.rad2deg(points.q[sink]), [[-10.5639, 140, -70]], atol=1e-3)
    np.testing.assert_allclose(points.eigenvalues[sink], [[-0.12823, -1.63856]], atol=1e-4)
    assert points.error[sink] / size == pytest.approx(error_at(points.q[sink][0]), rel=1e-9)


def error_at(q):
    s = np.cumsum(q)
    return np.hypot(np.cos(s).sum() - 1.5, np.sin(s).sum() - 1.5)


@pytest.mark.parametrize("size", EXACT)
@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_copies_have_the_same_points_of_rest(links, size, damping):
    def points(s):
        task = planar(links, s)
        law = Damped(scaled(links, s), damping, task) if damping else Pseudoinverse(scaled(links, s), task)
        return hf.stationary_points(law, [0.9 * s, 0.0], {2: 2.0})

    own, other = points(1.0), points(size)
    assert len(own)
    assert own.kinds == other.kinds
    np.testing.assert_allclose(own.q, other.q, atol=1e-9)
    np.testing.assert_allclose(own.error * size, other.error, rtol=1e-9, atol=1e-12 * size)


@pytest.mark.parametrize("size", [*ROUNDED, 1e-6, 1e6])
def test_joint_bounds_are_the_closed_form(links, size):
    bounds = hf.joint_bounds(scaled(links, size), [1.5 * size, 1.5 * size], "planar", seed=3)
    r = np.hypot(1.5, 1.5)
    half, bend = np.arccos((r * r - 3) / (2 * r)), 2 * np.arccos((r - 1) / 2)
    np.testing.assert_allclose(bounds[0], [(np.pi / 4 - half, np.pi / 4 + half)], atol=1e-8)
    np.testing.assert_allclose(bounds[1:], [[(-bend, bend)]] * 2, atol=1e-8)


@pytest.fixture(scope="module")
def measures(links):
    """``measures(size)`` of the workspace; those at size 1, which every other is compared with, once."""

    @cache
    def at(s):
        law = Pseudoinverse(scaled(links, s), "planar")
        return hf.workspace(law, [1.5 * s, 1.5 * s], np.array([[2.0, -1.4], [1.0, 1.0]]) * s, configurations=8, points=2)

    return at


@pytest.mark.parametrize("size", [*ROUNDED, 1e6])
def test_workspace(measures, size):
    own, other = measures(1.0), measures(size)
    for mine, others in zip(own.measures.values(), other.measures.values(), strict=True):
        np.testing.assert_allclose(mine, others, atol=1e-6)


@pytest.mark.parametrize("size", [*EXACT, *ROUNDED])
def test_inverse_kinematics(bent, rng, size):
    poses = bent.forward_kinematics(rng.uniform(-np.pi, np.pi, (20, 4)))
    found = solve_ik(scaled(bent, size), resized(poses, size), task="position")
    assert found.success.all()
    tip = oracles.forward(scaled(bent, size), found.q)[:, :3, 3]
    # What is asked for is metres; a small arm is as much nearer.
    assert (np.linalg.norm(tip - size * poses[:, :3, 3], axis=1) <= 1e-6 * min(2 * size, 1)).all()


@pytest.mark.parametrize("size", [*EXACT, *ROUNDED])
def test_what_a_law_costs_the_healthy_arm(links, rng, size):
    q0, goals = rng.uniform(-2, 2, (6, 3)), links.forward_kinematics(rng.uniform(0.5, 1.5, (6, 3)))
    own, other = (
        measure_healthy_cost(Pseudoinverse(scaled(links, s), "planar"), q0, resized(goals, s), False, 0.1) for s in (1.0, size)
    )
    assert np.isfinite(own.time).all()
    np.testing.assert_allclose(own.deviation * size, other.deviation, rtol=1e-6, atol=1e-6 * size)
    # Which samples are far enough to count depends on the unit, and that is rounded.
    np.testing.assert_allclose(own.angle, other.angle, atol=1e-9 if size in EXACT else 1e-2)
    np.testing.assert_allclose(own.time, other.time, rtol=1e-6 if size in EXACT else 0.05)


@pytest.mark.parametrize("size", [*EXACT, *ROUNDED, 1.0])
def test_the_way_back_keeps_its_rows_as_exactly(bent, generator, size):
    """The joint stands where it is, so its rows can all be met, and are, as exactly by an arm of any size."""
    arm, q = scaled(bent, size), generator("scaled recovery").uniform(-2, 2, 4)
    goal = arm.forward_kinematics(np.where(np.arange(4) == 1, q, q + 0.4))
    found = hf.recover(arm, 1, q, goal=goal, task="position", samples=0, clearance=False)
    assert found.ok
    missed = np.linalg.norm(oracles.forward(arm, found.q[-1:])[0, :3, 3] - goal[:3, 3])
    assert missed <= 2e-6 * min(2 * size, 1)


@pytest.mark.parametrize("size", [1e-3, 1.0])
def test_designs_are_on_a_pose_if_they_are_as_near_as_their_size_asks(links, size):
    arm, q = scaled(links, size), np.array([[0.3, 0.5, 0.7]])
    pose = arm.forward_kinematics(q)
    evaluator = Evaluator(Family(design_space(arm, {"a1": (0.5 * size, 1.5 * size)}), task="planar"), pose)
    near, off = q + np.array([0.0, 0.0, 1e-7]), q + np.array([0.0, 0.0, 1e-5])  # of a link's length
    assert evaluator.on_pose(np.array([[size]]), np.array([0]), near).all()
    assert not evaluator.on_pose(np.array([[size]]), np.array([0]), off).any()


@pytest.mark.parametrize("size", [*EXACT, 1.0])
def test_a_run_with_bodies_is_stuck_where_the_arm_s_size_says_so(links, size):
    """Two joints locked, the target off the circle of the third: 4e-3 of a link, which is 4e-6 m for the smallest arm."""
    pytest.importorskip("mujoco")
    arm = oracles.with_bodies(scaled(links, size), np.random.default_rng(0))
    q = np.array([0.3, 0.5, 0.7])
    target = arm.forward_kinematics(q + np.array([0.0, 0.0, 0.01]))[:2, 3] * (1 + 1e-3)
    run = hf.simulate_physics(Pseudoinverse(arm, "planar"), q, target, locked=[0, 1])
    assert (run.outcome, str(run.kinematic.outcome)) == ("stuck", "stuck")
    assert run.error[-1] / size == pytest.approx(3.9e-3, rel=0.05)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_proofs_that_a_goal_is_out_of_reach(links, size):
    arm = scaled(links, size)
    goal = np.eye(4)
    goal[0, 3] = 3 * size * (1 + 2e-7)
    free = np.ones(3, dtype=bool)
    assert prove_by_reach_bound(arm, free, np.zeros(3), goal, False, np.array([0.0, 0.0, 1.0]))
