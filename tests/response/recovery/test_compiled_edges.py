"""Compiled checks, proofs and searches against the kernels for single configurations, on random arms and objects."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation
from tools import native

import cells
import holdfast as hf
import oracles
from holdfast.model.cell import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere
from holdfast.model.collision.capsules import LinkCapsule
from holdfast.model.collision.compiled import edges as compiled_edges
from holdfast.model.collision.compiled.edges import EdgeChecker, RouteSearch
from holdfast.response.recovery.space import MIN_RESOLVED_MOTION_M, FreeSpace, JointMetric

NEAR_M = 5e-5  # single precision, for arms of a few metres


def random_solid(rng: np.random.Generator, name: str) -> Solid:
    place = oracles.pose(Rotation.random(random_state=rng).as_matrix(), rng.uniform(-1.5, 1.5, 3))
    margin = float(rng.choice([0.0, 0.03]))
    match rng.integers(5):
        case 0:
            return Box(name, rng.uniform(0.05, 0.6, 3), pose=place, margin=margin)
        case 1:
            return Cylinder(name, rng.uniform(0.03, 0.3), rng.uniform(0.1, 0.8), pose=place, margin=margin)
        case 2:
            return Capsule(name, rng.uniform(0.03, 0.2), rng.uniform(0.1, 0.8), pose=place, margin=margin)
        case 3:
            return Sphere(name, rng.uniform(0.05, 0.3), pose=place, margin=margin)
    return HalfSpace(name, pose=oracles.pose(place[:3, :3], -2.5 * place[:3, 2]), margin=margin)


def random_clearance(rng: np.random.Generator, types: str) -> hf.Clearance:
    """An arm with two capsules or spheres on most links, and objects, of which one may touch a link."""
    arm = oracles.random_arm(rng, types=types, limits=2.5)
    parts = [LinkCapsule(-1, (0.0, 0.0, 0.0), (0.0, 0.0, 0.1), radius=0.03)]
    for link in range(arm.n):
        for _ in range(int(rng.integers(0, 3))):
            start = rng.uniform(-0.15, 0.15, 3)
            end = start + rng.uniform(-0.2, 0.2, 3) * rng.integers(2)
            parts.append(LinkCapsule(link, tuple(start), tuple(end), radius=float(rng.uniform(0.01, 0.05))))
    capsules = hf.Capsules(tuple(parts[k] for k in rng.permutation(len(parts))))
    objects = [random_solid(rng, f"object{k}") for k in range(6)]
    base = arm.base[:3, 3]
    objects = [solid for solid in objects if solid.signed_distance(np.stack([base, base + 0.1])).min() > 0.3]
    cell = hf.Cell(objects, margin=0.01, may_touch=[(objects[0].name, arm.joint_names[-1])] if objects else [])
    return hf.Clearance(arm, capsules, cell)


@pytest.fixture(params=["RRRRRRR", "RPRRCR", "CRP", "RRRRRRRRRR"])
def clearance(request, rng) -> hf.Clearance:
    """A clearance of which some configurations are in contact, and some are not."""
    while True:
        clearance = random_clearance(rng, request.param)
        if 0.1 < (clearance.margin_left(sample(clearance.arm, rng, 300)) > 0).mean() < 0.9:
            return clearance


def checker(clearance: hf.Clearance, margin: float = 0.0) -> EdgeChecker:
    arm = clearance.arm
    low, high = (np.where(np.isfinite(limit), limit, side * np.pi) for limit, side in ((arm.lower, -1), (arm.upper, 1)))
    return EdgeChecker(clearance, margin, clearance.lipschitz_bounds(low, high))


def sample(arm: hf.Arm, rng: np.random.Generator, count: int) -> np.ndarray:
    low, high = (np.where(np.isfinite(limit), limit, side * np.pi) for limit, side in ((arm.lower, -1), (arm.upper, 1)))
    return rng.uniform(low, high, (count, arm.n))


def test_a_configuration_is_in_contact_where_its_margin_is_below_zero(clearance, rng):
    q = sample(clearance.arm, rng, 4000)
    for required in (0.0, 0.02):
        room = clearance.margin_left(q) - required
        is_clear = np.abs(room) > NEAR_M
        assert 0 < (room > 0).sum() < len(q), "the draw has no contact, or nothing else"
        found = checker(clearance, required).check_edges(q, np.zeros_like(q))
        assert (found == (room > 0))[is_clear].all()
        assert (checker(clearance).check_edges(q, np.zeros_like(q), room=required) == (room > 0))[is_clear].all()


def test_a_checked_edge_is_in_contact_at_no_checked_configuration(clearance, rng):
    """The last configuration is always checked, and a long edge in contact over centimetres is always found."""
    a = sample(clearance.arm, rng, 600)
    difference = sample(clearance.arm, rng, 600) - a
    found = checker(clearance).check_edges(a, difference)
    assert (clearance.margin_left((a + difference)[found]) > -NEAR_M).all()
    for start, step in zip(a[found], difference[found], strict=True):
        path = start + np.linspace(0, 1, 400)[1:, None] * step
        assert clearance.margin_left(path).min() > -compiled_edges.CHECK_SPACING_M


def test_a_proved_edge_keeps_its_distance_and_the_others_are_those_that_halving_does_not_prove(clearance, rng):
    arm = clearance.arm
    a = sample(arm, rng, 400)
    b = a + rng.normal(size=a.shape) * rng.choice([0.05, 0.3], (len(a), 1))
    deviations = np.abs(rng.normal(size=a.shape)) * rng.choice([0.0, 0.01], (len(a), 1))
    space = FreeSpace(arm, np.ones(arm.n, dtype=bool), clearance, 0.005, np.concatenate([a, b]))
    assert space.edges is not None
    proved = space.edges.prove_edges(a, b - a, deviations, MIN_RESOLVED_MOTION_M)
    assert 20 < proved.sum() < len(a) - 20
    for index in np.flatnonzero(proved):
        path = a[index] + np.linspace(0, 1, 200)[:, None] * (b - a)[index]
        path = path + rng.uniform(-1, 1, path.shape) * deviations[index]
        assert clearance.margin_left(path).min() >= 0.005 - 1e-9
    space.edges = None  # the same proof by kernels for single configurations
    is_inside = space.are_within_limits(a) & space.are_within_limits(b)
    halved = space.are_segments_valid(a, b, deviations)
    # The two halve at different places, so edges that touch within the resolution may differ.
    differ = np.flatnonzero((proved & is_inside) != halved)
    assert len(differ) <= 0.02 * len(a)
    for index in differ:
        path = a[index] + np.linspace(0, 1, 2000)[:, None] * (b - a)[index]
        assert clearance.margin_left(path).min() < 0.005 + 0.2


def test_values_that_are_not_finite_are_never_proved(clearance, rng):
    q = sample(clearance.arm, rng, 40)
    q = q[clearance.margin_left(q) > 0.01]
    edges, still = checker(clearance), np.zeros_like(q)
    assert edges.prove_edges(q, still, None, 1e-3).all()
    for bad in (np.nan, np.inf):
        broken = q.copy()
        broken[:, -1] = bad
        assert not edges.prove_edges(broken, still, None, 1e-3).any()
        assert not edges.prove_edges(q, broken, None, 1e-3).any()


def test_what_the_compiled_code_does_not_know_is_left_to_the_kernels():
    arm = hf.arms.load("panda")
    triangle = np.array([[1.0, 0, 0], [1.2, 0, 0], [1, 0.2, 0], [1, 0, 0.2]])
    mesh = hf.cell.Mesh("wedge", (triangle, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    for known, cell in ((True, cells.bench()), (True, None), (False, hf.Cell([mesh]))):
        clearance = hf.Clearance(arm, cell=cell)
        space = FreeSpace(arm, np.ones(7, dtype=bool), clearance, 0.0, np.zeros((1, 7)))
        assert EdgeChecker.supports(clearance) == known == (space.edges is not None)


# ---- routes ---------------------------------------------------------------------------------------------------------------


def search_between(arm: hf.Arm, cell: hf.Cell | None, free: np.ndarray, q: np.ndarray, name: str = "travel"):
    clearance = hf.Clearance(arm, cell=cell, itself=False)
    space = FreeSpace(arm, free, clearance, 0.0, q)
    metric = JointMetric.for_arm(arm, name, None, free)  # type: ignore[arg-type]
    search = space.compiled_search(metric, q)
    assert isinstance(search, RouteSearch)
    return space, metric, search


def test_a_route_begins_and_ends_where_it_must_and_is_short():
    """The last link must be drawn back to pass a post; a locked joint does not move."""
    arm = hf.arms.load("planar-3r")
    cell = hf.Cell([Sphere("post", 0.15, pose=[2.7, 0.0, 0.0])])
    ends = np.array([[0.8, 0.2, -0.5], [-0.8, 0.2, -0.5]])
    space, metric, search = search_between(arm, cell, np.array([True, False, True]), ends)
    for seed in range(20):
        q, goal = search.search(ends[0], ends[1:], seed, max_rounds=5000, spacing=0.02, room=1e-3)
        assert goal == 0
        assert_allclose(q[[0, -1]], ends, atol=1e-6)
        assert_allclose(q[:, 1], 0.2, atol=1e-6)
        path = cells.finely(q)
        assert space.clearance.margin_left(path).min() > -2e-3
        shorter = search.shorten(q, seed, max_failures=200, spacing=0.01, room=1e-3)
        assert_allclose(shorter[[0, -1]], ends, atol=1e-6)
        before, after = (metric.cumulative_length(way)[-1] for way in (q, shorter))
        assert after <= before * (1 + 1e-6)
    again = [search.search(ends[0], ends[1:], 7, max_rounds=5000, spacing=0.02, room=1e-3)[0] for _ in range(2)]
    assert (again[0] == again[1]).all()


def test_a_joint_without_limits_takes_the_shorter_way_round():
    """The post stands in the shorter way of one joint, so that the other way is the only one."""
    rows = [hf.DH(a=1.0, alpha=0.0, d=0.0), hf.DH(a=0.5, alpha=0.0, d=0.0)]
    arm = hf.Arm.from_dh(rows)
    cell = hf.Cell([Sphere("post", 0.1, pose=[0.7, 0.0, 0.0])])
    ends = np.array([[0.6, 0.0], [-0.6 + 4 * np.pi, 0.0]])
    space, metric, _ = search_between(arm, cell, np.array([True, False]), ends)
    from holdfast.response.recovery.routes import find_route

    route = find_route(space, metric, ends[0], ends[1:], 4, np.random.default_rng(0))
    assert route is not None
    assert route.length == pytest.approx(2 * np.pi - 1.2, rel=1e-3)
    assert_allclose(np.cos(route.q[-1]), np.cos(ends[1]), atol=1e-12)


def test_a_goal_that_cannot_be_reached_ends_the_search(rng):
    arm = hf.arms.load("planar-3r")
    cell = hf.Cell([Sphere("ball", 0.2, pose=[0.8, 0, 0])])
    ends = np.array([[0.9, 0.3, 0.4], [-0.9, 0.3, 0.4]])
    _, _, search = search_between(arm, cell, np.array([True, False, False]), ends)
    assert search.search(ends[0], ends[1:], int(rng.integers(1000)), max_rounds=500, spacing=0.02, room=0.0) is None


def test_by_time_the_slowest_joint_counts():
    from dataclasses import replace

    arm = hf.arms.load("planar-3r")
    arm = replace(arm, joints=tuple(replace(j, velocity=v) for j, v in zip(arm.joints, (1.0, 0.1, 2.0), strict=True)))
    cell = hf.Cell([Sphere("post", 0.15, pose=[2.7, 0.0, 0.0])])
    ends = np.array([[0.8, 0.2, -0.5], [-0.8, 0.4, -0.5]])
    _, metric, search = search_between(arm, cell, np.ones(3, dtype=bool), ends, "time")
    q, _ = search.search(ends[0], ends[1:], 0, max_rounds=5000, spacing=0.02, room=1e-3)
    shorter = search.shorten(q, 0, max_failures=300, spacing=0.02, room=1e-3)
    seconds = [metric.cumulative_length(way)[-1] for way in (ends, shorter, q)]
    assert seconds == sorted(seconds)


def test_the_compiled_file_belongs_to_its_source():
    text = native.SOURCE.with_suffix(".ll").read_text()
    assert text.startswith(native.first_line() + "\n"), "run python -m tools.native"


def test_with_exact_distances_only_pairs_that_are_too_close_at_an_end_may_overlap(rng):
    """The capsule of the hand touches a shelf at the goal, although its mesh does not."""
    pytest.importorskip("coal")
    from holdfast.model.collision.exact.exact_clearance import with_exact_distances
    from holdfast.response.recovery.routes import find_route

    arm = hf.arms.load("panda")
    ends = np.array([[0.9, 0.3, 0.0, -1.9, 0.0, 2.2, 0.8], [-0.9, 0.3, 0.0, -1.9, 0.0, 2.2, 0.8]])
    tool = arm.forward_kinematics(ends[1])[:3, 3]
    shelf = Box("shelf", [0.2, 0.2, 0.1], pose=oracles.pose(position=tool - [0, 0, 0.063]))
    bound = hf.Clearance(arm, cell=hf.Cell([shelf, Sphere("ball", 0.1, pose=[0.6, 0, 0.5])]))
    exact = with_exact_distances(bound)
    assert exact is not None
    assert bound.margin_left(ends[1]) < 0 < exact.margin_left(ends).min()
    free = np.ones(7, dtype=bool)
    space, metric = FreeSpace(arm, free, exact, 0.0, ends), JointMetric.for_arm(arm, "travel", None, free)
    search = space.compiled_search(metric, ends)
    assert space.edges is None
    assert search is not None
    assert search.edges.check_edges(ends, np.zeros_like(ends)).all()
    q = sample(arm, rng, 3000)
    is_ball = np.array([name.endswith("ball") for name in bound.pair_names])
    touches_ball = bound.by_pair(q)[:, is_ball].min(axis=1) < -1e-4
    assert touches_ball.any()
    assert not search.edges.check_edges(q, np.zeros_like(q))[touches_ball].any()
    route = find_route(space, metric, ends[0], ends[1:], 2, rng)
    assert route is not None
    assert exact.margin_left(cells.finely(route.q, 0.02)).min() >= 0
