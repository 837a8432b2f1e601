"""The failure-tolerant workspace: closed form against triangles at sampled locks, sampled region against closed form."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import InputError, TaskError, arms, certify, tolerant_workspace
from holdfast.certificates import make_workspace_claim
from holdfast.certificates.suggestions.workspace_claims import find_inner_box
from holdfast.kinematics.workspace.samples import with_artificial_limits


@pytest.fixture(scope="module")
def unit3() -> hf.Arm:
    return arms.load("planar-3r")


def within(angle, low, high):
    return (angle - low + 1e-9) % (2 * np.pi) <= high - low + 2e-9


def brute(lengths, limits, points, locks=161):
    """Parts of the region at points (N, 2): reached within the limits, and with each joint at sampled angles of its range."""
    a, b, c = lengths
    z = points @ np.array([1, 1j])
    r = np.abs(z)
    healthy = np.zeros(len(z), dtype=bool)
    survives = np.ones((len(z), 3), dtype=bool)
    for first in np.linspace(*limits[0], locks):
        left = z - a * np.exp(1j * first)
        survives[:, 0] &= (np.abs(left) >= abs(b - c)) & (np.abs(left) <= b + c)
        with np.errstate(invalid="ignore"):
            third = np.arccos((np.abs(left) ** 2 - b * b - c * c) / (2 * b * c))
        for s in (1, -1):
            second = np.angle(left) - np.angle(b + c * np.exp(1j * s * third)) - first
            healthy |= within(second, *limits[1]) & within(s * third, *limits[2])
    for k, (one, two, other) in ((1, (a, b, c)), (2, (b, c, a))):
        for angle in np.linspace(*limits[k], locks):
            joined = np.abs(one + two * np.exp(1j * angle))
            survives[:, k] &= (r >= abs(joined - other)) & (r <= joined + other)
    return healthy, survives


def test_the_closed_form_against_triangles(rng):
    total = 0
    for _ in range(4):
        lengths = rng.uniform(0.6, 1.2, 3)
        arm = hf.Arm.from_dh([hf.DH(a=x, alpha=0.0) for x in lengths], name="3R")
        middle, half = np.array([0.3, *rng.uniform(-1.8, 1.8, 2)]), rng.uniform(0.1, [0.5, 1.2, 1.2])
        limits = np.stack([middle - half, middle + half], axis=1)
        region = tolerant_workspace(arm, task="planar", limits=limits)
        some = rng.choice(len(region.points), 4000, replace=False)
        healthy, survives = brute(lengths, limits, region.points[some, :2])
        # Sampled locks differ only in a thin rim.
        assert (healthy != region.within[some]).mean() < 3e-3
        assert ((survives & region.within[some, None]) != region.survives[some]).any(axis=1).mean() < 3e-3
        cell = (2 * lengths.sum() / 160) ** 2
        assert region.inside.sum() * cell == pytest.approx(region.size, abs=0.08 * np.sqrt(region.size) + 3 * cell)
        assert region.size_interval[1] - region.size_interval[0] < 0.01
        total += region.inside.sum()
    assert total > 50


def test_a_tilted_arm_with_axes_up_and_down_has_the_same_area(rng):
    arm = oracles.planar_arm(rng, 3)
    turns = np.array([arm.joints[k].origin[:3, :3] for k in range(3)])
    offset = np.arctan2(turns[:, 1, 0], turns[:, 0, 0])
    sign = np.array([j.axis[2] for j in arm.joints])
    lengths = [arm.joints[1].origin[0, 3], arm.joints[2].origin[0, 3], arm.tool[0, 3]]
    plain = hf.Arm.from_dh([hf.DH(a=x, alpha=0.0) for x in lengths], name="3R")
    links = np.array([[-0.3, 0.4], [0.2, 1.6], [-0.5, 1.4]])
    # The origin of a joint turns first: angle of the link = turn of the origin + sign q. Link k begins at joint k.
    angle = np.array([offset[0], offset[1], offset[2]])
    limits = np.sort(sign[:, None] * (links - angle[:, None]), axis=1)
    tilted = tolerant_workspace(arm, task="planar", limits=limits)
    flat = tolerant_workspace(plain, task="planar", limits=links)
    # Joints 2 and 3 are what counts; the first only by its width, and the mirror image of a region is as large.
    assert tilted.size == pytest.approx(flat.size, rel=1e-3)
    assert tilted.points @ np.cross(*tilted.task.rows[:, :3]) == pytest.approx(
        tilted.arm.base[:3, 3] @ np.cross(*tilted.task.rows[:, :3])
    )


def test_the_best_limits_of_equal_links(unit3):
    """Our optimum; `python -m papers.tolerant_workspace` compares it with brute force over a grid of limits."""
    region = tolerant_workspace(unit3, task="planar", optimise=True)
    assert region.exact
    assert region.optimised
    assert region.size == pytest.approx(3.5621, abs=1e-3)
    np.testing.assert_allclose(np.degrees(region.limits), [[-18.3, 18.3], [-111.3, 111.3], [-111.3, 111.3]], atol=0.5)
    assert region.healthy_size == pytest.approx(9 * np.pi)


def test_without_limits_nothing_is_sure(unit3):
    region = tolerant_workspace(unit3, task="planar")
    assert region.size == pytest.approx(0, abs=1e-6)
    assert region.lost_to.shape == (3,)


def test_the_sampled_region_agrees_with_the_closed_form(unit3):
    limits = np.radians([[-18.3, 18.3], [-100, 100], [-100, 100]])
    exact = tolerant_workspace(unit3, task="planar", limits=limits)
    sampled = tolerant_workspace(unit3, task=["vx", "vy"], limits=limits, points=1500, angles=13)
    assert not sampled.exact
    assert sampled.size_interval[0] < exact.size < sampled.size_interval[1]
    assert sampled.healthy_size == pytest.approx(exact.healthy_size, rel=0.05)
    assert sampled.size_interval[0] < sampled.size < sampled.size_interval[1]


def test_the_map_of_the_exact_region_has_its_size(unit3):
    """The area in closed form against cells counted on the grid."""
    region = tolerant_workspace(unit3, "planar", {0: (-0.3, 0.3), 1: (-1.9, 1.9), 2: (-1.9, 1.9)})
    data = region.to_xarray()
    cell = float((data.u[1] - data.u[0]) * (data.v[1] - data.v[0]))
    assert float(data.inside.sum()) * cell == pytest.approx(region.size, rel=0.01)
    assert float(data.healthy.sum()) * cell == pytest.approx(region.healthy_size, rel=0.01)
    np.testing.assert_allclose(data.position.sel(axis="x").values, np.broadcast_to(data.u.values, (len(data.v), len(data.u))))
    assert (data.inside == data.survives.all("joint") & data.within).all()
    sampled = tolerant_workspace(hf.arms.load("panda"), points=20, angles=2)
    assert sampled.to_xarray().sizes == {"point": 20, "joint": 7, "end": 2, "axis": 3}


def test_limits_of_any_arm_are_looked_for(flat4):
    region = tolerant_workspace(flat4, task="planar", optimise=True, points=300, angles=12)
    assert region.size > 1.0
    given = tolerant_workspace(flat4, task="planar", limits=region.limits, points=300, angles=12, seed=1)
    assert given.size == region.size
    # What it says holds at other angles than those tried.
    inside = region.points[region.inside][:20]
    inner = with_artificial_limits(flat4, region.limits)
    assert hf.solve_ik(inner, [oracles.pose(None, p) for p in inside], task="planar").success.all()
    for joint, (low, high) in enumerate(region.limits):
        for angle in np.linspace(low, high, 5):
            lost = ~hf.reachable_when_locked(flat4, inside[:, :2], {joint: angle}, task="planar").success
            assert lost.mean() <= 0.1


def test_a_spatial_arm_with_turns():
    arm = arms.load("panda")
    down = np.diag([1.0, -1.0, -1.0])
    region = tolerant_workspace(arm, task="pointing", limits={3: (-2.0, -1.2)}, rotation=down, points=60, angles=3)
    assert region.unit == "m^3"
    assert region.points.shape == (60, 3)
    assert (region.inside <= region.within).all()
    assert (region.within <= region.healthy).all()


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"task": "planar-pose"}, TaskError, "no region survives a lock"),
        ({"limits": np.zeros((2, 2))}, InputError, r"they must be \(3, 2\)"),
        ({"limits": {"joint1": (1.0, -1.0)}}, InputError, "limits of joint 'joint1' are 1 to -1"),
        ({"limits": {1: (-4.0, 0.0)}}, InputError, "beyond the arm's own"),
        ({"limits": {"elbow": (0.0, 1.0)}}, InputError, "has no joint 'elbow'"),
        ({"limits": {0: (0.0, 1.0)}, "optimise": True}, InputError, "not both"),
        ({"points": 0}, InputError, "points is 0"),
        ({"angles": 1}, InputError, "angles 1"),
        ({"confidence": 95}, InputError, "confidence is 95"),
        ({"rotation": np.ones((3, 3))}, InputError, "rotation must be"),
        ({"task": ["vx"]}, TaskError, "does not hold a point"),
    ],
)
def test_errors(unit3, options, error, message):
    with pytest.raises(error, match=message):
        tolerant_workspace(unit3, **{"task": "planar", **options})


@pytest.mark.parametrize("axes", [2, 3])
def test_a_box_of_points_inside(rng, axes):
    low, high = rng.uniform(0.1, 0.3, axes), rng.uniform(0.6, 0.9, axes)
    points = rng.random((4000, axes))
    box = find_inner_box(points, ((points > low) & (points < high)).all(axis=1))
    assert (box[:, 0] >= low).all()
    assert (box[:, 1] <= high).all()
    assert np.prod(np.diff(box)) > 0.5 * np.prod(high - low)
    assert find_inner_box(points, points[:, 0] > 2) is None


def test_what_the_sample_suggests_is_proved(unit3):
    """The region is exact here, so the box that is suggested can be."""
    region = tolerant_workspace(unit3, "planar", limits=np.radians([(-30, 30), (20, 100), (20, 100)]))
    claim = make_workspace_claim(region)
    np.testing.assert_array_equal(claim.working_ranges, region.limits)
    assert np.prod(np.diff(claim.box)) > 0.1
    proof = certify(claim, halvings=6)
    assert proof.tolerant > 0.99
