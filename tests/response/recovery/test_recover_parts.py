"""The parts of a recovery: rows, bounds on distances, waypoints in files."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.model.arm.task import as_task, task_from_rows
from holdfast.model.collision import Capsules, Clearance
from holdfast.response.recovery import check_waypoints, read_waypoints, routes, write_waypoints
from holdfast.response.recovery.space import FreeSpace, JointMetric
from holdfast.response.recovery.task_rows import make_row_solver

TASKS = ["pose", "pointing", "position", ["vx", "wy"], "tool"]


@pytest.mark.parametrize("which", range(len(TASKS)), ids=["pose", "pointing", "position", "rows", "tool-rows"])
def test_errors_of_rows_and_their_slopes(mixed5, rng, which):
    arm = mixed5
    task = task_from_rows(["vx", "vz", "wx", "wz"], "tool") if TASKS[which] == "tool" else as_task(arm, TASKS[which])
    solver = make_row_solver(arm, task)
    q = oracles.inside(arm, rng, 30)
    poses = oracles.forward(arm, oracles.inside(arm, rng, 30))
    made = oracles.forward(arm, q)
    away = poses[:, :3, 3] - made[:, :3, 3]
    in_tool = np.einsum("nji,nj->ni", made[:, :3, :3], away)
    turn = Rotation.from_matrix(poses[:, :3, :3] @ made[:, :3, :3].transpose(0, 2, 1)).as_rotvec()
    turn_in_tool = Rotation.from_matrix(made[:, :3, :3].transpose(0, 2, 1) @ poses[:, :3, :3]).as_rotvec()
    linear = in_tool if solver.rows.linear == "tool" else away
    angular = turn_in_tool if solver.rows.angular == "tool" else turn
    expected = np.c_[linear, angular] @ solver.rows.matrix.T
    np.testing.assert_allclose(solver.compute_errors(q, poses), expected, atol=1e-9)
    for k in range(5):
        if np.linalg.norm(turn[k]) > 3.0:
            continue
        target = np.repeat(poses[k][None], 200, axis=0)
        slope = oracles.slope(lambda x, target=target: solver.compute_errors(x, target[: len(x)]), q[k])
        np.testing.assert_allclose(solver.compute_jacobian(q[k], poses[k]), slope.T, atol=2e-6)


def test_names_of_rows():
    arm = hf.arms.load("panda")
    rows = make_row_solver(arm, as_task(arm, "pose")).rows
    assert rows.names == ("x", "y", "z", "about tool x", "about tool y", "about tool z")
    assert rows.units == ("m", "m", "m", "rad", "rad", "rad")
    assert make_row_solver(arm, as_task(arm, "pointing")).rows.names[0] == "tool x"


@pytest.mark.parametrize("types", ["RRPRR", "RRRRRR", "CPRRPR"])
def test_no_distance_changes_faster_than_its_bound(rng, types):
    arm = oracles.random_arm(rng, types=types, limits=2.0)
    clearance = Clearance(arm, Capsules.along_links(arm, 0.03))
    low = np.where(np.isfinite(arm.lower), arm.lower, -np.pi)
    high = np.where(np.isfinite(arm.upper), arm.upper, np.pi)
    low, high = (np.where(arm.prismatic, np.clip(x, -1, 1), x) for x in (low, high))
    bound = clearance.lipschitz_bounds(low, high)
    a, b = (rng.uniform(low, high, (4000, arm.n)) for _ in range(2))
    share = 10 ** rng.uniform(-3, 0, (4000, 1))
    b = a + share * (b - a)
    change = np.abs(clearance.by_pair(a) - clearance.by_pair(b))
    allowed = np.abs(b - a) @ bound.T
    assert (change <= allowed + 1e-9).all()
    assert (change > 0.3 * allowed).any()  # and it is not much too careful everywhere


def test_a_piece_that_is_called_clear_is_clear_and_little_else_is_refused(rng):
    arm = oracles.random_arm(rng, types="RRPRRR", limits=2.4)
    clearance = Clearance(arm, Capsules.along_links(arm, 0.03))
    free = np.ones(6, dtype=bool)
    space = FreeSpace(arm, free, clearance, 0.01, np.zeros((1, 6)))
    q = rng.uniform(arm.lower, arm.upper, (600, 6))
    q = q[space.are_valid(q)][:120]
    a, b = q[::2], q[1::2]
    a = a[: len(b)]
    said = space.are_segments_valid(a, b)
    least = np.array([clearance(x + np.linspace(0, 1, 3000)[:, None] * (y - x)).min() for x, y in zip(a, b, strict=True)])
    assert (least[said] >= 0.01).all()
    assert (least[~said] < 0.01 + 1e-3).all()
    assert said.any()
    assert (~said).any()


# ---- files -----------------------------------------------------------------------------------------------------------


def test_waypoints_come_back_bit_by_bit(tmp_path, mixed5, rng):
    q = oracles.inside(mixed5, rng, 7)
    file = write_waypoints(mixed5, q, tmp_path / "way.csv")
    np.testing.assert_array_equal(read_waypoints(mixed5, file), q)
    head = file.read_text().splitlines()[0].split(",")
    assert head == ["travel_rad", *(f"{j.name}_{j.unit}" for j in mixed5.joints)]
    table = np.loadtxt(file, delimiter=",", skiprows=1)
    np.testing.assert_allclose(np.diff(table[:, 0]), np.linalg.norm(np.diff(q, axis=0), axis=1))
    panda = hf.arms.load("panda")
    way = np.array(hf.arms.about("panda").home) + np.array([0.0, 0.1])[:, None] * np.eye(7)[0]
    table = np.loadtxt(write_waypoints(panda, way, tmp_path / "timed.csv"), delimiter=",", skiprows=1)
    assert (tmp_path / "timed.csv").read_text().startswith("time_s,")
    assert table[-1, 0] == pytest.approx(0.1 / panda.joints[0].velocity)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "column 'joint1_rad'"),
        ("joint1_rad,joint2_rad\n0,0\n", "column 'joint3_rad'"),
        ("joint1_rad,joint2_rad,joint3_rad,colour\n0,0,0,1\n", "'colour' is not known"),
        ("joint1_rad,joint2_rad,joint3_rad\n", "one line or more"),
        ("joint1_rad,joint2_rad,joint3_rad\n0,0\n", "line 2"),
        ("joint1_rad,joint2_rad,joint3_rad\n0,0,nan\n", "finite"),
        ("joint1_rad,joint2_rad,joint3_rad\n0,0,up\n", "line 2"),
    ],
    ids=["empty", "column", "unknown", "none", "short", "nan", "word"],
)
def test_a_wrong_file_of_waypoints_is_refused(tmp_path, text, sentence):
    arm = hf.arms.load("planar-3r")
    file = tmp_path / "way.csv"
    file.write_text(text)
    with pytest.raises(hf.InputError, match=sentence):
        read_waypoints(arm, file)
    with pytest.raises(hf.InputError, match="cannot be read"):
        read_waypoints(arm, tmp_path / "none.csv")


def test_a_replay_sees_what_is_wrong_between_waypoints():
    arm = hf.arms.load("panda")
    home = np.array(hf.arms.about("panda").home)
    bad = home.copy()
    bad[[1, 3]] = 2.0, -2.0  # beyond a limit, and joint 4 moves
    replay = check_waypoints(arm, [home, bad], {"panda_joint4": float(home[3])}, clearance=Clearance(arm))
    assert not replay.ok
    assert replay.beyond_limits == {"panda_joint2": pytest.approx(2.0 - arm.upper[1])}
    assert replay.locks_moved == {"panda_joint4": pytest.approx(abs(-2.0 - home[3]))}
    np.testing.assert_allclose(replay.poses[-1], oracles.forward(arm, bad[None])[0], atol=1e-9)
    other = home.copy()
    other[[1, 3, 5]] = 0.5, -2.9, 3.6
    fine = home + np.linspace(0, 1, 801)[:, None] * (other - home)
    clearance = Clearance(arm)
    replay = check_waypoints(arm, [home, other], (), clearance=clearance, margin=0.5)
    assert not replay.ok
    assert replay.least_clearance == pytest.approx(clearance.exact(fine).min(), abs=5e-3)
    assert any("VIOLATED" in line for line in replay.describe())


@pytest.mark.parametrize(("tries", "vain", "made"), [(0, 1, 0), (1, 1, 1), (4, 1, 1), (9, 2, 2), (3, None, 3)])
def test_searches_that_find_no_route_are_not_made_again_and_again(monkeypatch, tries, vain, made):
    """A sphere behind which the only free joint, whose limits close the other way round, cannot get."""
    rounds, connect = [], routes._search_compiled
    monkeypatch.setattr(routes, "_search_compiled", lambda *given: rounds.append(connect(*given)) or rounds[-1])
    arm = hf.arms.load("planar-3r")
    cell = hf.Cell([hf.cell.Sphere("ball", 0.2, pose=[0.8, 0, 0])])
    ends = np.array([[0.9, 0.3, 0.4], [-0.9, 0.3, 0.4]])
    space = FreeSpace(arm, np.array([True, False, False]), Clearance(arm, cell=cell, itself=False), 0.0, ends)
    metric = JointMetric.for_arm(arm, "travel", None, space.free)
    assert routes.find_route(space, metric, ends[0], ends[1:], tries, np.random.default_rng(0), max_failures=vain) is None
    assert rounds == [None] * made
