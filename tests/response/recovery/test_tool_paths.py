"""Tool paths finished by arms that have self-motion left, against floods over grids of closed forms."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.response.recovery import attempt, continuation
from holdfast.response.recovery.ladder_graph import LadderGraph
from holdfast.response.recovery.proofs import path_proof, reach

JUMP = 0.35


@pytest.fixture(scope="module")
def three():
    return hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=-2.9, upper=2.9) for _ in range(3)], name="three")


def on_a_grid(point, low, high, step):
    """Configurations (N, 3) of three unit links at a point, within limits: the first joint on a grid."""
    first = np.arange(low[0], high[0] + 1e-12, step)
    along = point - np.stack([np.cos(first), np.sin(first)], axis=1)
    cosine = (np.square(along).sum(axis=1) - 2) / 2
    first, along, bend = first[abs(cosine) <= 1], along[abs(cosine) <= 1], np.arccos(cosine[abs(cosine) <= 1])
    found = []
    for third in (bend, -bend):
        second = np.arctan2(along[:, 1], along[:, 0]) - np.arctan2(np.sin(third), 1 + np.cos(third)) - first
        found.append(np.stack([first, (second + np.pi) % (2 * np.pi) - np.pi, third], axis=1))
    every = np.concatenate(found)
    return every[((every >= low) & (every <= high)).all(axis=1)]


def flooded(points, low, high, step=0.03):
    """Whether any chain of such configurations leads through all points, by steps of at most 0.35 rad of each joint."""
    alive = on_a_grid(points[0], low, high, step)
    for point in points[1:]:
        every = on_a_grid(point, low, high, step)
        near = np.abs(every[:, None] - alive[None]).max(axis=2) <= JUMP
        alive = every[near.any(axis=1)] if len(alive) else alive[:0]
    return len(alive) > 0


def drawn(three, rng):
    """Ranges that are left of the joints, a configuration within them, and a line from its tool point to that of another."""
    width, middle = rng.uniform(0.5, 1.4, 3), rng.uniform(-1.4, 1.4, 3)
    low, high = middle - width, middle + width
    here, there = (rng.uniform(low, high) for _ in range(2))
    path = hf.paths.line(*(three.forward_kinematics(q)[:3, 3] for q in (here, there)))
    return low, high, here, path


def finished(three, low, high, here, path):
    ranges = {name: (a, b) for name, a, b in zip(three.joint_names, low, high, strict=True)}
    return hf.recover(three, hf.Degraded(three, ranges=ranges), here, goal=None, path=path, samples=0, task="planar")


def test_a_path_is_finished_where_a_flood_finds_a_way(three, rng):
    agreed, lost = 0, 0
    for _ in range(8):
        low, high, here, path = drawn(three, rng)
        result = finished(three, low, high, here, path)
        whole = flooded(path.pose(result.rest.share)[:, :2, 3], low, high)
        assert result.ok or not whole
        agreed, lost = agreed + (result.ok == whole), lost + (not whole)
        if result.ok:
            q = result.q
            assert ((q >= low - 1e-12) & (q <= high + 1e-12)).all()
            assert np.abs(np.diff(q[result.legs[-1].first :], axis=0)).max() <= JUMP
            places = np.exp(1j * np.cumsum(q[result.legs[-1].first :], axis=1)).sum(axis=1)
            want = path.pose(result.rest.share)
            np.testing.assert_allclose(places, want[:, 0, 3] + 1j * want[:, 1, 3], atol=3e-6)
    assert agreed >= 7  # a passage may be narrower than the grid of the flood


# Drawn at random; followed from each start alone these end at half of the path or never begin.
DRAWS = (2, 45)


@pytest.mark.parametrize("draw", DRAWS)
def test_the_self_motion_is_used_where_following_alone_ends_early(three, draw, monkeypatch):
    rng = np.random.default_rng(1)
    for _ in range(draw + 1):
        low, high, here, path = drawn(three, rng)
    result = finished(three, low, high, here, path)
    assert result.ok
    assert result.rest.graph > 0
    monkeypatch.setattr(continuation, "search_ladder_graph", lambda *_: LadderGraph([], 0, 0))
    monkeypatch.setattr(continuation, "_REFINEMENT_FACTOR", 1)
    for name in ("follow_to_furthest_point", "follow_with_relaxed_rows"):
        monkeypatch.setattr(attempt, name, lambda made, *_: (made, []))
    alone = finished(three, low, high, here, path)
    assert not alone.ok
    assert flooded(path.pose(result.rest.share)[:, :2, 3], low, high)


def test_a_panda_with_narrow_ranges_keeps_its_pose_along_a_line():
    arm = hf.arms.load("panda")
    low = np.array([-1.28, -0.33, -2.2, -2.48, -0.98, 1.31, 0.8])
    high = np.array([0.38, 0.51, -0.84, -1.61, 0.25, 2.27, 1.97])
    here = np.array([-0.21, 0.14, -1.02, -2.31, -0.85, 1.69, 0.96])
    there = arm.forward_kinematics([-0.36, 0.15, -2.02, -1.86, -0.29, 1.72, 1.88])
    path = hf.paths.line(arm.forward_kinematics(here), there)
    result = hf.recover(
        arm,
        hf.Degraded(arm, ranges=dict(zip(arm.joint_names, zip(low, high, strict=True), strict=True))),
        here,
        goal=None,
        path=path,
        samples=0,
        clearance=False,
    )
    assert result.verdict.is_solved
    assert result.rest.graph > 0
    assert ((result.q >= low - 1e-12) & (result.q <= high + 1e-12)).all()
    along = result.legs[-1]
    model, tool = oracles.to_pinocchio(arm)
    data = model.createData()
    for share, q in zip(result.rest.share[::9], result.q[along.first : along.last + 1 : 9], strict=True):
        pin.framesForwardKinematics(model, data, q)
        np.testing.assert_allclose(data.oMf[tool].homogeneous, path.pose(share), atol=3e-6)


def test_waypoints_are_added_where_straight_lines_of_joints_leave_the_path():
    arm = hf.Arm.from_dh([hf.DH(a=0.3, alpha=0.0) for _ in range(3)], name="short")
    path = hf.paths.line([0.8999, 0, 0], [0.75, 0, 0])  # the two links that still move begin almost stretched
    bend = np.arccos((0.8999 - 0.3) / 0.6)
    answer = hf.recover(arm, {"joint1": 0.0}, [0, bend, -2 * bend], goal=None, path=path, task="planar", samples=0)
    assert answer.ok
    share = answer.rest.share
    assert len(share) == len(answer.rest.found) == len(answer.q)
    assert len(share) > 22, "one pose every 7 mm is not enough: 1.4 mm off the path"
    s = np.linspace(0, 1, 41)
    fine = (answer.q[:-1, None] + s[:, None] * np.diff(answer.q, axis=0)[:, None]).reshape(-1, 3)
    tool = 0.3 * np.exp(1j * np.cumsum(fine, axis=1)).sum(axis=1)
    places = (share[:-1, None] + s * np.diff(share)[:, None]).ravel()
    assert np.abs(tool - (0.8999 - 0.1499 * places)).max() < 6e-4


def test_a_stretched_arm_follows_nothing_of_a_path_outwards():
    three = hf.arms.load("planar-3r")
    here = np.array([0.3, 0.0, 0.0])
    begin = three.forward_kinematics(here)
    end = begin.copy()
    end[:3, 3] *= 1.1
    path = hf.paths.line(begin, end)
    result = hf.recover(three, ["joint2"], here, goal=None, path=path, task="planar", samples=0, relax=False)
    assert result.rest.furthest == 0
    assert result.verdict.answer == "proved infeasible"


def test_a_motion_that_skips_a_pose_without_a_configuration_is_no_motion():
    """Between two samples of this path, the range of joint 4 ends for 2 mm; longer steps jump over it."""
    arm = hf.arms.load("panda")
    here = [-1.0971989, -0.6380594, 2.8203341, -1.500031, 1.8260665, 2.59821, 1.0025361]
    corners = [
        [-0.198852, 0.7942947, 0.3015827],
        [-0.0403057, 0.8726561, 0.208188],
        [-0.0466779, 0.8484047, 0.1770229],
        [-0.2052242, 0.7700433, 0.2704175],
        [-0.2115964, 0.745792, 0.2392524],
        [-0.05305, 0.8241533, 0.1458577],
    ]
    poses = np.tile(np.eye(4), (len(corners), 1, 1))
    poses[:, :3, :3] = Rotation.from_rotvec([-2.086085, -0.172162, 0.781469]).as_matrix()
    poses[:, :3, 3] = corners
    degraded = hf.Degraded(arm, ranges={"panda_joint4": (-1.936404, -1.235636)})
    options = {"task": "pointing", "path": hf.paths.sequence(poses), "clearance": False, "samples": 0, "relax": False}
    result = hf.recover(arm, degraded, here, goal=None, **options)
    assert result.verdict.kind == "a pose of the path"
    assert result.rest.furthest < 0.294


def test_joints_that_move_fast_beside_a_singularity_are_followed():
    """Two axes of the shoulder nearly line up, so that a joint turns by 0.36 rad within 9 mm of the line, and does not jump."""
    arm = hf.arms.load("panda")
    here = np.array([-2.152, 0.157, 1.279, -1.452, -0.426, 2.96, 1.842])
    begin = arm.forward_kinematics(here)
    end = begin.copy()
    end[:3, 3] += [0.0517, 0.2555, -0.1485]
    path = hf.paths.line(begin, end)
    result = hf.recover(arm, ["panda_joint7"], here, goal=None, path=path, samples=0, clearance=False)
    assert result.ok
    q = result.q[result.legs[-1].first :]
    assert np.abs(q[:, 6] - here[6]).max() == 0
    np.testing.assert_allclose(oracles.forward(arm, q), path.pose(result.rest.share), atol=1e-5)


def test_no_motion_along_a_line_is_proved_and_what_may_be_missed_is_said():
    """Links of 1 and 2 m; the elbow would have to bend by more than it may half-way, where the line is nearest."""
    arm = hf.arms.load("planar-3r")
    here = np.array([0.0, 0.0, 0.0])
    point, bend = np.array([-0.3, 1.0002]), np.arccos((0.09 + 1.0002**2 - 5) / 4)
    here[1] = bend
    here[0] = np.arctan2(*point[::-1]) - np.arctan2(2 * np.sin(bend), 1 + 2 * np.cos(bend))
    poses = np.tile(np.eye(4), (2, 1, 1))
    poses[:, :2, 3] = point, point * [-1, 1]
    for most, within in ((3.1, True), (3.1232, False)):
        bad = hf.Degraded(arm, locked={"joint3": 0.0}, ranges={"joint2": (0.1, most)})
        result = hf.recover(
            arm, bad, here, goal=None, path=hf.paths.line(*poses), task="planar", samples=0, tolerance=(1e-4, 1e-4)
        )
        assert result.verdict.answer == "proved infeasible"
        assert result.verdict.kind in ("a pose of the path", "disconnected")
        assert result.proved_within == within
        assert ("this also holds for misses" if within else "not proved for misses") in result.verdict.why


def test_a_leg_after_others_is_proved_within_the_tolerance(monkeypatch):
    """The line of the test above follows another leg, which ends at its beginning and is easy; no pose is proved here."""
    monkeypatch.setattr(path_proof, "prove_within_tolerance", lambda *_: None)
    monkeypatch.setattr(path_proof, "search_pose", lambda *_: (None, None))
    arm = hf.arms.load("planar-3r")
    corners = np.array([[-0.3, 1.2], [-0.3, 1.0002], [0.3, 1.0002]])
    bend = np.arccos((corners[0] @ corners[0] - 5) / 4)
    here = np.array([np.arctan2(*corners[0][::-1]) - np.arctan2(2 * np.sin(bend), 1 + 2 * np.cos(bend)), bend, 0.0])
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, :2, 3] = corners
    path = hf.paths.sequence(poses)
    for most, answer, within in ((3.1, "proved", True), (3.1232, "proved", False), (3.139, "solved", False)):
        bad = hf.Degraded(arm, locked={"joint3": 0.0}, ranges={"joint2": (0.1, most)})
        result = hf.recover(arm, bad, here, goal=None, path=path, task="planar", samples=0, tolerance=(1e-4, 1e-4))
        assert result.verdict.answer.startswith(answer)
        assert result.verdict.kind == ("disconnected" if answer == "proved" else "")
        assert result.proved_within == within


def test_a_second_search_with_exact_distances_repeats_no_proof_about_the_path(monkeypatch):
    pytest.importorskip("coal")
    arm, rng, poses = hf.arms.load("panda"), np.random.default_rng(5), []
    search_boxes = reach.all_configurations

    def count_searches(*request, **options):
        poses.append((request[1].tobytes(), options["tolerance"]))
        return search_boxes(*request, **options)

    attempts = []
    monkeypatch.setattr(reach, "all_configurations", count_searches)
    monkeypatch.setattr(attempt, "follow_with_relaxed_rows", lambda rest, *_: attempts.append(rest) or (rest, []))
    here = rng.uniform(arm.lower, arm.upper)
    begin = arm.forward_kinematics(here)
    end = begin.copy()
    end[:3, 3] += [-0.2, 0.2, 0.1]
    result = hf.recover(arm, ["panda_joint2"], here, goal=None, path=hf.paths.line(begin, end), samples=0)
    assert result.verdict.kind == "a pose of the path"
    assert len(attempts) == 2
    assert len(poses) == len(set(poses)) > 0
