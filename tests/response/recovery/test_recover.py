"""The way home with known locks: what comes back starts, ends, stands, keeps limits and stays clear; and says so if not."""

from __future__ import annotations

import heapq
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.model.collision import Capsules, Clearance, LinkCapsule
from holdfast.response.recovery import RecoveryOutcome, goals
from holdfast.response.recovery.proofs.reach import prove_by_reach_bound


def limited(arm: hf.Arm, lower, upper) -> hf.Arm:
    from dataclasses import replace

    joints = [replace(j, lower=lo, upper=up) for j, lo, up in zip(arm.joints, lower, upper, strict=True)]
    return replace(arm, joints=tuple(joints))


def three_links(lower=-np.inf, upper=np.inf) -> hf.Arm:
    return hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=lower, upper=upper) for _ in range(3)], name="three")


def fine(q: np.ndarray, step: float = 1e-3) -> np.ndarray:
    parts = [q[:1]]
    for a, b in pairwise(q):
        parts.append(a + np.linspace(0, 1, int(np.abs(b - a).max() / step) + 2)[:, None] * (b - a))
    return np.concatenate(parts)


def hand(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """Pose of the tool by Pinocchio."""
    import pinocchio as pin

    model, tool = oracles.to_pinocchio(arm)
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    return data.oMf[tool].homogeneous


def assert_sound(result: hf.Recovery, at: np.ndarray, locked: dict[str, float], clearance: Clearance | None) -> None:
    """What every motion must be, whatever the ending."""
    arm, q = result.arm, result.q
    np.testing.assert_allclose(q[0], at, atol=1e-6)
    for name, value in locked.items():
        assert (q[:, arm.joint_index(name)] == value).all()
    assert (q >= arm.lower).all()
    assert (q <= arm.upper).all()
    if clearance is not None:
        assert clearance(fine(q)).min() >= result.margin
    length = sum(np.linalg.norm(np.diff(q, axis=0), axis=1))
    if result.metric == "travel":
        assert result.length == pytest.approx(length, rel=1e-9, abs=1e-9)
    assert result.length >= result.lower_bound * (1 - 1e-9)
    assert result.check().ok


@pytest.mark.parametrize(
    ("types", "locks", "task"),
    [("RRPRRRR", 1, "pose"), ("RRCRRP", 2, "position")],
)
def test_what_comes_back_is_sound_and_arrives(rng, types, locks, task):
    arm = oracles.random_arm(rng, types=types, limits=2.4)
    clearance = Clearance(arm, Capsules.along_links(arm, 0.02))
    moved = 0
    for case in range(2):
        ends = oracles.inside(arm, rng, 400)
        joints = sorted(rng.choice(arm.n, locks, replace=False).tolist())
        ends[:, joints] = ends[0, joints]
        ends = ends[clearance(ends) > 0.01]
        if len(ends) < 2:
            continue
        at, goal = ends[0], arm.forward_kinematics(ends[1])
        locked = {arm.joint_names[k]: float(at[k]) for k in joints}
        result = hf.recover(
            arm, locked, at, goal=goal, task=task, clearance=clearance, margin=0.002, samples=0, tries=1, seed=case
        )
        assert result.ending not in (
            RecoveryOutcome.PROVED_UNREACHABLE,
            RecoveryOutcome.LOCK_MISMATCH,
            RecoveryOutcome.START_TOO_CLOSE,
        ), result.reason
        assert result.proof is None
        if len(result.q):
            moved += 1
            assert_sound(result, at, locked, clearance)
        if result.ok:
            reached = hand(arm, result.q[-1])
            np.testing.assert_allclose(reached[:3, 3], goal[:3, 3], atol=3e-6)
            if task == "pose":
                assert Rotation.from_matrix(reached[:3, :3].T @ goal[:3, :3]).magnitude() < 3e-6
    assert moved


def test_a_configuration_that_the_lock_allows_is_reached_itself(rng):
    arm = hf.arms.load("panda")
    home = np.array(hf.arms.about("panda").home)
    at = home + np.where(np.arange(7) == 3, 0.0, rng.uniform(-0.3, 0.3, 7))
    result = hf.recover(arm, ["panda_joint4"], at, samples=0)
    assert result.ending == RecoveryOutcome.GOAL_REACHED
    assert result.relaxed is None
    np.testing.assert_allclose(result.q, [at, home], atol=1e-12)
    assert result.length == pytest.approx(np.linalg.norm(at - home))
    assert result.lower_bound == pytest.approx(result.length)
    assert result.require_ok() is result


def test_a_configuration_that_the_lock_forbids_is_never_home():
    arm = hf.arms.load("panda")
    home = np.array(hf.arms.about("panda").home)
    at = home.copy()
    at[[0, 3]] = 0.4, -2.2
    result = hf.recover(arm, {"panda_joint4": -2.2}, at, samples=0)
    assert result.ending == RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS
    assert result.relaxed is not None
    assert result.relaxed.names[0] == "panda_joint4"
    assert result.relaxed.misses[0] == pytest.approx(abs(home[3] + 2.2))
    assert "panda_joint4" in result.reason
    with pytest.raises(hf.HoldfastError, match="NOT met"):
        result.require_ok()


# ---- a maze --------------------------------------------------------------------------------------------------------


def maze(closed: bool = False) -> tuple[hf.Arm, Clearance]:
    """Three links, and a wall of the base along x: the last link must be drawn back to pass; closed, nothing passes."""
    arm = limited(three_links(), [-3.0, -2.6, -2.8], [3.0, 2.6, 2.8])
    links = [LinkCapsule(k, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), radius=0.05) for k in (1, 2)]
    wall = LinkCapsule(-1, (0.5 if closed else 2.2, 0.0, 0.0), (3.2, 0.0, 0.0), radius=0.08)
    return arm, Clearance(arm, Capsules((*links, wall)))


START, GOAL = np.array([0.9, -0.4, 0.3]), np.array([-0.9, -0.4, -0.3])


def test_around_a_wall_that_the_straight_line_runs_through():
    arm, clearance = maze()
    assert clearance(np.stack([START, GOAL])).min() > 0.05
    assert clearance(fine(np.stack([START, GOAL]))).min() < -0.02
    result = hf.recover(arm, {"joint2": -0.4}, START, goal=GOAL, clearance=clearance, margin=0.01, samples=0)
    assert result.ending == RecoveryOutcome.GOAL_REACHED, result.describe()
    assert_sound(result, START, {"joint2": -0.4}, clearance)
    np.testing.assert_allclose(result.q[-1], GOAL, atol=1e-9)
    assert len(result.q) > 2
    assert not result.legs[0].straight
    assert result.lower_bound == pytest.approx(np.linalg.norm(START - GOAL))
    # Two joints move: the shortest way over a fine grid, by Dijkstra with sixteen directions (at most 2.7 % too long).
    grid = shortest_on_grid(arm, clearance, 0.01, START, GOAL)
    assert 0.95 * grid < result.length < 1.02 * grid


def shortest_on_grid(arm: hf.Arm, clearance: Clearance, margin: float, start: np.ndarray, goal: np.ndarray) -> float:
    count = 241
    a, c = (np.linspace(arm.lower[k], arm.upper[k], count) for k in (0, 2))
    q = np.stack(np.meshgrid(a, c, indexing="ij"), axis=-1).reshape(-1, 2)
    free = (clearance(np.c_[q[:, 0], np.full(len(q), start[1]), q[:, 1]]) >= margin).reshape(count, count)
    place = [tuple(int(np.abs(x - v).argmin()) for x, v in zip((a, c), p[[0, 2]], strict=True)) for p in (start, goal)]
    steps = [(i, j) for i in range(-2, 3) for j in range(-2, 3) if abs(i) + abs(j) in (1, 3) or abs(i) == abs(j) == 1]
    size = {s: float(np.hypot(s[0] * (a[1] - a[0]), s[1] * (c[1] - c[0]))) for s in steps}
    best, heap = {place[0]: 0.0}, [(0.0, place[0])]
    while heap:
        d, at = heapq.heappop(heap)
        if at == place[1]:
            return d
        if d > best[at]:
            continue
        for s in steps:
            to = (at[0] + s[0], at[1] + s[1])
            if 0 <= to[0] < count and 0 <= to[1] < count and free[to] and d + size[s] < best.get(to, np.inf):
                best[to] = d + size[s]
                heapq.heappush(heap, (best[to], to))
    raise AssertionError("no way on the grid")


def test_that_nothing_leads_past_a_closed_wall_is_proved():
    arm, clearance = maze(closed=True)
    result = hf.recover(arm, ["joint2"], START, goal=GOAL, clearance=clearance, samples=0, tries=1)
    assert result.ending == RecoveryOutcome.PROVED_DISCONNECTED, result.describe()
    assert len(result.q) == 0
    assert not result.ok
    with pytest.raises(hf.StoreError, match="no waypoints"):
        result.to_csv("never.csv")


def test_the_same_seed_gives_the_same_way():
    arm, clearance = maze()
    runs = [
        hf.recover(arm, {"joint2": -0.4}, START, goal=GOAL, clearance=clearance, samples=0, tries=1, seed=s) for s in (3, 3, 4)
    ]
    np.testing.assert_array_equal(runs[0].q, runs[1].q)
    assert runs[0].q.shape != runs[2].q.shape or (runs[0].q != runs[2].q).any()


# ---- metrics and turns -----------------------------------------------------------------------------------------------


def test_a_joint_without_limits_takes_the_short_way_round():
    arm = three_links()
    result = hf.recover(arm, ["joint2"], [3.0, 0.5, 0.0], goal=[-3.0, 0.5, 0.1], samples=0)
    assert result.ok
    assert result.q[-1] == pytest.approx([2 * np.pi - 3.0, 0.5, 0.1])
    assert result.length == pytest.approx(np.hypot(2 * np.pi - 6.0, 0.1))


def test_time_is_that_of_the_slowest_joint():
    arm = hf.arms.load("panda")
    home = np.array(hf.arms.about("panda").home)
    at = home.copy()
    at[[0, 5]] += 0.5, -0.4
    result = hf.recover(arm, ["panda_joint2"], at, samples=0, metric="time")
    speed = np.array([j.velocity for j in arm.joints])
    assert result.unit == "s"
    assert result.length == pytest.approx(max(0.5 / speed[0], 0.4 / speed[5]))
    with pytest.raises(hf.InputError, match="velocity limits"):
        hf.recover(three_links(), ["joint1"], np.zeros(3), goal=np.zeros(3), metric="time")


def test_weights_change_which_configuration_is_nearest():
    """One position, two configurations of the two links that move: elbow left or right."""
    arm = three_links()
    at = np.array([0.0, 0.0, 1.2])
    pose = arm.forward_kinematics([0.1, 0.0, -1.0])
    near = hf.recover(arm, ["joint2"], at, goal=pose, samples=0, weights=[1.0, 1.0, 5.0])
    far = hf.recover(arm, ["joint2"], at, goal=pose, samples=0, weights=[5.0, 1.0, 1.0])
    assert near.found == far.found == 2
    assert near.q[-1, 2] * at[2] > 0
    assert far.q[-1, 2] * at[2] < 0


# ---- what cannot be ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("radius", "word"), [(2.95, "at most"), (0.5, "at least")])
def test_beyond_the_circles_it_is_proved(radius, word):
    arm, angle = three_links(), 0.8
    first = 2 * np.cos(angle / 2)  # joint1 to joint3, joint2 standing
    pose = oracles.pose(None, [radius, 0.0, 0.0])
    result = hf.recover(arm, {"joint2": angle}, [0.0, angle, 0.3], goal=pose, samples=0)
    assert result.ending == RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS
    assert result.proof is not None
    assert word in result.proof
    bound = first + 1 if radius > 2 else first - 1
    assert f"{bound:.4g} m" in result.proof
    # x kept: y misses what the circle leaves; y kept: so does x.
    misses = {c.names: c.misses[0] for c in result.choices}
    if radius < 1:
        assert misses["y",] == pytest.approx(np.sqrt(bound**2 - radius**2), abs=1e-5)
    assert misses["x",] == pytest.approx(abs(radius - bound), abs=1e-5)
    assert set(misses) == ({("x",), ("y",)} if radius < 1 else {("x",)})
    assert_sound(result, np.array([0.0, angle, 0.3]), {"joint2": angle}, None)


def test_what_the_failed_arm_reaches_is_never_proved_unreachable(rng):
    for types in ("RRRRRR", "PRRPR", "RPRCRP", "PPRRC"):
        arm = oracles.random_arm(rng, types=types, limits=2.0)
        q = oracles.inside(arm, rng, 200)
        q = np.clip(q, np.maximum(arm.lower, -9), np.minimum(arm.upper, 9))
        free = rng.random(arm.n) < 0.6
        if not free.any():
            free[0] = True
        q[:, ~free] = q[0, ~free]
        for pose in oracles.forward(arm, q):
            assert prove_by_reach_bound(arm, free, q[0], pose, True, None) is None
            assert prove_by_reach_bound(arm, free, q[0], pose, False, None) is None
        away = oracles.pose(None, [50.0, 0, 0])
        finite = np.isfinite(arm.lower[arm.prismatic & free]).all()
        assert not finite or "at most" in (prove_by_reach_bound(arm, free, q[0], away, True, None) or "")


def test_the_turn_about_the_tool_is_given_up_first():
    """Five joints for a full pose that differs from one they reach by a turn about the tool's z axis."""
    arm = hf.arms.load("panda")
    at = np.array([0.2, -0.5, 0.3, -2.0, 0.4, 1.8, 0.6])
    locked = ["panda_joint3", "panda_joint7"]
    moved = at + np.array([0.4, 0.3, 0.0, 0.2, -0.3, 0.2, 0.0])
    pose = arm.forward_kinematics(moved) @ oracles.pose(Rotation.from_euler("z", 0.4).as_matrix())
    result = hf.recover(arm, locked, at, goal=pose, samples=0)
    assert result.ending == RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS
    assert result.relaxed is not None
    assert result.relaxed.names == ("about tool z",)
    assert result.relaxed.units == ("rad",)
    assert result.relaxed.misses[0] <= 0.4 + 1e-6
    reached = hand(arm, result.q[-1])
    np.testing.assert_allclose(reached[:3, 3], pose[:3, 3], atol=3e-6)
    np.testing.assert_allclose(reached[:3, 2], pose[:3, 2], atol=3e-6)
    turn = Rotation.from_matrix(reached[:3, :3].T @ pose[:3, :3]).magnitude()
    assert turn == pytest.approx(result.relaxed.misses[0], abs=1e-5)
    pointing = hf.recover(arm, locked, at, goal=pose, task="pointing", samples=0)
    assert pointing.ending == RecoveryOutcome.GOAL_REACHED


def test_what_is_polished_of_a_goal_out_of_reach_is_not_the_same_again(monkeypatch):
    """Most random starts of this goal end at one configuration, at a limit."""
    polished: dict[int, list[np.ndarray]] = {}

    def kept(search, pose, q, lost):
        polished.setdefault(lost[0], []).append(q)
        return q

    monkeypatch.setattr(goals, "_minimize_row_errors", kept)
    arm, at = hf.arms.load("planar-3r"), np.deg2rad([20, 40, 60])
    result = hf.recover(arm, {"joint2": at[1]}, at, goal=oracles.pose(None, [0.3, 0.2, 0]), task="planar", samples=0)
    assert result.ending == RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS
    assert set(polished) == {0, 1}
    for some in polished.values():
        assert len(some) > 1
        assert np.abs(np.array(some)[:, None] - some).max(axis=2)[np.triu_indices(len(some), 1)].min() > 1e-4


def test_trouble_at_the_start_is_said_and_nothing_moves():
    arm = hf.arms.load("panda")
    home = np.array(hf.arms.about("panda").home)
    found = hf.recover(arm, {"panda_joint4": -1.0}, home, samples=0)
    assert found.ending == RecoveryOutcome.LOCK_MISMATCH
    assert "panda_joint4" in found.reason
    beyond = home.copy()
    beyond[1] = 2.5
    found = hf.recover(arm, ["panda_joint4"], beyond, samples=0)
    assert found.ending == RecoveryOutcome.START_OUTSIDE_LIMITS
    assert "panda_joint2" in found.reason
    folded = home.copy()
    folded[[1, 3, 5]] = 0.0, -3.0, 0.2
    clearance = Clearance(arm)
    assert clearance(folded) < 0.3
    found = hf.recover(
        arm, ["panda_joint4"], folded, samples=0, clearance=clearance, margin=float(clearance.exact(folded)) + 0.01
    )
    assert found.ending == RecoveryOutcome.START_TOO_CLOSE
    for ending in RecoveryOutcome:
        assert ending.sentence
    assert len(found.q) == 0
    assert not found.ok


BAD = [
    ({"locked": {}}, "no joint is locked"),
    ({"locked": ["joint1", "joint2", "joint3"]}, "all 3 joints"),
    ({"locked": {"elbow": 1.0}}, "no joint 'elbow'"),
    ({"locked": {"joint1": np.nan}}, "finite number"),
    ({"locked": {"joint1": 0.0, 0: 0.0}}, "locked twice"),
    ({"at": [[0.0] * 3] * 2}, "one configuration"),
    ({"at": [0.0, np.inf, 0.0]}, "NaN or infinity"),
    ({"goal": "away"}, "'away' is not known"),
    ({"goal": [0.0, 1.0]}, "shape"),
    ({"goal": None}, "no goal and no path"),
    ({"goal": [0.0, 0.0, 4.0]}, "outside its limits"),
    ({"metric": "money"}, "'money' is not known"),
    ({"weights": [1.0, 2.0]}, "weights"),
    ({"starts": 0}, "starts is 0"),
    ({"margin": 0.1}, "margin has no effect"),
    ({"task": "pirouette"}, "not known"),
]


@pytest.mark.parametrize(("change", "sentence"), BAD, ids=[b[1].replace(" ", "-") for b in BAD])
def test_bad_input_is_one_clear_sentence(change, sentence):
    given = {"locked": ["joint1"], "at": [0.1, 0.2, 0.3], "goal": [0.1, 0.0, 0.0], "samples": 0} | change
    with pytest.raises((hf.InputError, hf.TaskError), match=sentence):
        hf.recover(three_links(-3.0, 3.0), **given)


# ---- what is left ----------------------------------------------------------------------------------------------------


def test_what_is_left_is_the_ring(rng):
    """Links of 1 m, joint2 standing: between two circles about joint1, known exactly."""
    arm, angle = three_links(), float(rng.uniform(0.6, 2.4))
    left = hf.recover(arm, {"joint2": angle}, [0.1, angle, 0.3], goal=[0.0, angle, 0.2], samples=400).left
    assert left is not None
    radius = np.linalg.norm(left.position[:, :2], axis=1)
    first = 2 * np.cos(angle / 2)
    inside = (radius < first + 1) & (radius > abs(first - 1))
    sure = (np.abs(radius - first - 1) > 1e-3) & (np.abs(radius - abs(first - 1)) > 1e-3)
    assert left.healthy.all()
    assert (left.locked == inside)[sure].all()
    assert left.left is not None
    assert left.left.value == pytest.approx(left.locked.mean())
    assert left.left.low < left.left.value < left.left.high or left.locked.all()


def test_what_is_left_of_a_region_counts_what_the_healthy_arm_reaches():
    arm = three_links()
    region = hf.Region.box([2.5, 0.0, 0.0], [2.0, 0.2, 0.0], name="strip")
    found = hf.recover(arm, {"joint2": 0.0}, np.zeros(3), goal=np.zeros(3), region=region, samples=300)
    left = found.left
    assert left is not None
    radius = np.linalg.norm(left.position[:, :2], axis=1)
    assert (left.healthy == (radius < 3))[np.abs(radius - 3) > 1e-2].all()
    assert left.of_region is not None
    assert left.healthy_of_region is not None
    assert left.of_region.value <= left.healthy_of_region.value < 1
    assert "strip" in left.describe()[0]
    assert list(found.figures()) == ["motion", "left"]


# ---- the rest of a path ----------------------------------------------------------------------------------------------


def test_the_rest_of_a_path_is_followed_and_then_home():
    arm = three_links(-2.9, 2.9)
    at = np.array([0.3, 0.7, 0.9])
    here = arm.forward_kinematics(at)[:3, 3]
    path = hf.paths.line(here, here + np.array([-0.5, -0.4, 0.0]))
    result = hf.recover(arm, ["joint2"], at, goal=[0.2, 0.7, 0.1], path=path, samples=0)
    assert result.ok, result.describe()
    assert [leg.name for leg in result.legs] == ["along the path", "to the goal"]
    assert_sound(result, at, {"joint2": 0.7}, None)
    assert result.rest is not None
    assert result.rest.finished
    along = result.legs[0]
    for share, q in zip(result.rest.share, result.q[along.first : along.last + 1], strict=True):
        np.testing.assert_allclose(hand(arm, q)[:3, 3], path.pose(share)[:3, 3], atol=3e-6)
    np.testing.assert_allclose(result.q[-1], [0.2, 0.7, 0.1], atol=1e-9)
    alone = hf.recover(arm, ["joint2"], at, goal=None, path=path, samples=0)
    assert alone.ok
    assert alone.goal_pose is None


def test_a_path_out_of_reach_is_not_finished_though_home_is_reached():
    arm = three_links(-2.9, 2.9)
    at = np.array([0.3, 0.7, 0.9])
    here = arm.forward_kinematics(at)[:3, 3]
    path = hf.paths.line(here, here + np.array([2.5, 2.5, 0.0]))
    result = hf.recover(arm, ["joint2"], at, goal=[0.2, 0.7, 0.1], path=path, samples=0)
    assert result.ending in (RecoveryOutcome.PATH_UNFINISHED, RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS)
    assert not result.ok
    rest = result.rest
    assert rest is not None
    assert not rest.finished
    assert rest.first_lost is not None
    # The hand leaves the circle that it can reach where the line does.
    bound = 2 * np.cos(0.35) + 1
    radius = np.linalg.norm(path.pose(rest.share)[:, :2, 3], axis=1)
    assert rest.share[radius > bound][0] == rest.first_lost
    assert rest.furthest < rest.first_lost
    np.testing.assert_allclose(result.q[-1], [0.2, 0.7, 0.1], atol=1e-9)


def test_a_path_is_approached_if_the_hand_is_not_on_it():
    arm = hf.arms.load("panda")
    at = np.array(hf.arms.about("panda").home)
    there = arm.forward_kinematics(at + np.array([0.3, 0.1, 0.0, 0.0, 0.1, 0.1, 0.0]))[:3, 3]
    path = hf.paths.line(there, there + np.array([-0.05, 0.1, 0.05]))
    result = hf.recover(arm, ["panda_joint4"], at, goal=None, path=path, samples=0)
    assert result.ok, result.describe()
    assert [leg.name for leg in result.legs] == ["to the path", "along the path"]
    assert_sound(result, at, {"panda_joint4": at[3]}, Clearance(arm))
    np.testing.assert_allclose(hand(arm, result.q[-1])[:3, 3], path.pose(1.0)[:3, 3], atol=3e-6)
    assert list(result.figures()) == ["motion"]
