"""The benchmark with a locked joint: problems, the validator against independent oracles and mutations, and the runner."""

from __future__ import annotations

import io
import json
import os
import signal
import tarfile

import numpy as np
import pytest
import yaml
from benchmarks.locked_planning import __main__ as command
from benchmarks.locked_planning.adapters import Answer, Holdfast, Planner
from benchmarks.locked_planning.goals import find_goal_configurations
from benchmarks.locked_planning.mesh_contacts import MeshContacts
from benchmarks.locked_planning.problems import LOCKS_FILE, Problem, draw, make_healthy, make_locked, read_problems
from benchmarks.locked_planning.results import check_verdicts, find_contradictions, read_results, round_path, write_verdicts
from benchmarks.locked_planning.robots import SELF_PAIRS, load_robot, write_files
from benchmarks.locked_planning.validator import SphereContacts, forward_kinematics, interpolate, signed_distances, validate

HALF_PI = np.pi / 2
PANDA = [  # translation of each joint, m, and its rotation about x, rad
    ((0, 0, 0.333), 0.0),
    ((0, 0, 0), -HALF_PI),
    ((0, -0.316, 0), HALF_PI),
    ((0.0825, 0, 0), HALF_PI),
    ((-0.0825, 0.384, 0), -HALF_PI),
    ((0, 0, 0), HALF_PI),
    ((0.088, 0, 0), HALF_PI),
]
LOWER, UPPER = [-2.9, -1.8, -2.9, -3.1, -2.9, 0.0, -2.9], [2.9, 1.8, 2.9, 0.0, 2.9, 3.8, 2.9]
START = np.array([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785])
SHAPES = [
    {"kind": "box", "size": [0.3, 0.5, 0.8]},
    {"kind": "cylinder", "radius": 0.2, "length": 0.7},
    {"kind": "capsule", "radius": 0.2, "length": 0.5},
    {"kind": "sphere", "radius": 0.3},
]


def pose(xyz, about_x=0.0):
    matrix = np.eye(4)
    matrix[1:3, 1:3] = [[np.cos(about_x), -np.sin(about_x)], [np.sin(about_x), np.cos(about_x)]]
    matrix[:3, 3] = xyz
    return matrix


def placed(shape, position=(0.0, 0.0, 0.0), quaternion=(0.0, 0.0, 0.0, 1.0), name="object"):
    return {"name": name, **shape, "position": list(position), "quaternion_xyzw": list(quaternion)}


@pytest.fixture(scope="module")
def robot():
    spheres = [((0, 0, 0.05), 0), ((0, -0.05, 0), 1), ((0, -0.1, 0), 2), ((0.05, 0.03, 0), 3), ((-0.05, 0.05, 0), 4)]
    spheres += [((0, 0.05, -0.2), 5), ((0.02, 0, 0), 6), ((0, 0, 0.1), 7), ((0.03, 0.03, 0.18), 7)]
    return {
        "lower": LOWER,
        "upper": UPPER,
        "joint_origins": [pose(*entry).tolist() for entry in PANDA],
        "tool": pose((0, 0, 0.21), 0.4).tolist(),
        "spheres": [{"link": link, "center": list(center), "radius": 0.05} for center, link in spheres],
        "self_pairs": SELF_PAIRS,
    }


def make_problem(robot, q_goal, objects=(), joint=None):
    goal = forward_kinematics(robot, np.asarray(q_goal, dtype=float)[None])[1][0]
    value = 0.0 if joint is None else float(START[joint])
    return Problem("scene/0001", START, goal, list(objects), joint, value, None if joint is not None else np.asarray(q_goal))


@pytest.fixture
def files(robot, tmp_path):
    """Archive with two problems, and the robot as JSON."""
    goal, objects = START + np.array([0.4, 0.1, 0, 0.1, 0.2, 0, 0.3]), []
    for name, kind, sizes in (("shelf", "box", [0.2, 0.3, 0.1]), ("can", "cylinder", [0.14, 0.03])):
        where = {"position": [0.1, -0.9, 0.3], "orientation": [0, 0, 0.6, 0.8]}
        objects.append({"id": name, "primitives": [{"type": kind, "dimensions": sizes}], "primitive_poses": [where]})
    names = [f"panda_joint{number}" for number in range(1, 8)]
    request = {
        "start_state": {"joint_state": {"name": ["finger", *names], "position": [0.06, *START.tolist()]}},
        "goal_constraints": [
            {"joint_constraints": [{"joint_name": name, "position": float(q)} for name, q in zip(names, goal, strict=True)]}
        ],
    }
    with tarfile.open(tmp_path / "problems.tar.bz2", "w:bz2") as archive:
        for name in ("box_panda/{}0001", "table_pick_panda/{}0041"):
            for part, data in (("scene", {"world": {"collision_objects": objects}}), ("request", request)):
                content = yaml.safe_dump(data).encode()
                entry = tarfile.TarInfo(f"problems/{name.format(part)}.yaml")
                entry.size = len(content)
                archive.addfile(entry, io.BytesIO(content))
    (tmp_path / "robot.json").write_text(json.dumps(robot))
    return tmp_path


def test_forward_kinematics_is_that_of_pinocchio(robot, tmp_path, rng):
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildModelFromUrdf(str(write_files(robot, tmp_path)))
    data = model.createData()
    for q in rng.uniform(LOWER, UPPER, (20, 7)):
        pinocchio.framesForwardKinematics(model, data, q)
        poses, tool = forward_kinematics(robot, q[None])
        for index in range(8):
            expected = data.oMf[model.getFrameId(f"link{index}")].homogeneous
            np.testing.assert_allclose(poses[0, index], expected, atol=1e-12)
        np.testing.assert_allclose(tool[0], data.oMf[model.getFrameId("tool")].homogeneous, atol=1e-12)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape["kind"])
def test_distances_are_those_to_sampled_surface_points(shape, rng):
    """The surface is sampled by bisection along random rays from the center, with a containment test written apart."""
    half = shape.get("length", 0.0) / 2

    def contains(p):
        if shape["kind"] == "box":
            return (np.abs(p) <= np.array(shape["size"]) / 2).all(axis=-1)
        beyond = np.abs(p[..., 2]) - half
        radial = p[..., 0] ** 2 + p[..., 1] ** 2
        if shape["kind"] == "cylinder":
            return (radial <= shape["radius"] ** 2) & (beyond <= 0)
        return radial + np.maximum(beyond, 0) ** 2 <= shape["radius"] ** 2

    rays = rng.normal(size=(200_000, 3))
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    near, far = np.zeros(len(rays)), np.full(len(rays), 2.0)
    for _ in range(40):
        middle = (near + far) / 2
        inside = contains(rays * middle[:, None])
        near, far = np.where(inside, middle, near), np.where(inside, far, middle)
    surface = rays * near[:, None]
    quaternion = np.array([0.2, -0.4, 0.5, 0.7]) / np.linalg.norm([0.2, -0.4, 0.5, 0.7])
    w, v = quaternion[3], quaternion[:3]
    points = rng.uniform(-0.5, 0.5, (60, 3))
    turned = points + 2 * np.cross(v, np.cross(v, points) + w * points) + [0.3, -0.2, 0.5]
    distances = signed_distances(placed(shape, (0.3, -0.2, 0.5), quaternion), turned)
    expected = np.array([np.linalg.norm(surface - p, axis=1).min() for p in points]) * np.where(contains(points), -1, 1)
    excess = np.abs(expected) - np.abs(distances)  # samples are never closer than the surface
    assert excess.min() > -1e-9
    assert excess.max() < 0.01
    assert np.median(excess) < 1e-4
    assert (np.sign(distances) == np.sign(expected)).all()
    assert (distances < 0).any()
    assert (distances > 0).any()


def test_contacts_are_those_of_all_pairs_of_spheres(robot, rng):
    """The bounding spheres never hide a contact."""
    objects = [placed(shape, rng.uniform(0.5, 0.9, 3), rng.normal(size=4)) for shape in SHAPES]
    q = rng.uniform(LOWER, UPPER, (300, 7))
    poses, _ = forward_kinematics(robot, q)
    centers = [poses[:, s["link"], :3, :3] @ s["center"] + poses[:, s["link"], :3, 3] for s in robot["spheres"]]
    gaps = [signed_distances(shape, center) - 0.05 for shape in objects for center in centers]
    for one, first in zip(centers, robot["spheres"], strict=True):
        for other, second in zip(centers, robot["spheres"], strict=True):
            if [first["link"], second["link"]] in SELF_PAIRS:
                gaps.append(np.linalg.norm(one - other, axis=1) - 0.1)
    expected = np.min(gaps, axis=0)
    distances, _ = SphereContacts(robot, objects).distances(q)
    assert 0.03 < (expected < 0).mean() < 0.9
    np.testing.assert_allclose(distances[expected < 0], expected[expected < 0], atol=1e-12)
    assert (distances <= expected + 1e-12).all()
    assert (distances[expected > 0] >= 0).all()


def test_a_valid_path_is_accepted_and_mutations_are_refused(robot):
    end = START + np.array([0.6, 0.2, 0.0, 0.1, -0.2, 0.1, 0.1])
    problem = make_problem(robot, end, joint=2).to_dict()
    turn = np.eye(7)
    middle = (START + end) / 2

    def kind(*path):
        verdict = validate(robot, problem, path)
        assert verdict.sentence.startswith("refused: " if verdict.kind else "accepted: ")
        return verdict.kind

    assert kind(START, end) == ""
    assert kind(START, middle + 0.01 * turn[0], end) == ""
    assert kind(START, middle + 2e-9 * turn[2], end) == "lock"
    assert kind(START, middle + 0.1 * turn[2], end) == "lock"
    assert kind(START + 2e-9 * turn[0], end) == "start"
    assert kind(START, middle + (1.9 - middle[1]) * turn[1], end) == "limits"
    assert kind(START, end + 0.004 * turn[0]) == "goal", "some 2 mm, and 0.2 deg"
    assert kind(START, end + 0.011 * turn[6]) == "goal", "0.6 deg about an axis through the tool's position"
    assert kind(START, end + 0.007 * turn[6]) == "", "0.4 deg"
    assert kind() == "path"
    assert kind(START[:6], end[:6]) == "path"
    assert kind(START, end * np.nan) == "path"
    assert validate(robot, problem, None).kind == "path"
    assert validate(robot, problem, [[1.0], [1.0, 2.0]]).kind == "path"


def test_an_overlap_of_a_millimetre_between_waypoints_is_refused(robot):
    """A thin needle stands where the tool's sphere passes halfway: its radius decides about 1 mm of overlap or of distance."""
    end = START + 0.8 * np.eye(7)[0]
    poses, _ = forward_kinematics(robot, ((START + end) / 2)[None])
    sphere = robot["spheres"][-1]
    center = poses[0, 7, :3, :3] @ sphere["center"] + poses[0, 7, :3, 3]
    for gap, kind in ((-1e-3, "contact"), (1e-3, "")):
        ball = placed({"kind": "sphere", "radius": 0.01}, center - [0, 0, 0.05 + 0.01 + gap], name="ball")
        verdict = validate(robot, make_problem(robot, end, [ball]).to_dict(), [START, end])
        assert verdict.kind == kind, verdict.sentence
        assert kind == "" or "link 7 and 'ball'" in verdict.sentence
        for waypoint in (START, end):
            assert (SphereContacts(robot, [ball]).distances(waypoint[None])[0] > 0.01).all()


def test_an_unknown_kind_of_object_is_an_error(robot):
    with pytest.raises(ValueError, match="kind of object 'cone' is cone"):
        signed_distances(placed({"kind": "cone"}, name="cone"), np.zeros((1, 3)))


def test_steps_of_a_path_are_at_most_two_milliradians_and_contain_the_waypoints():
    path = np.array([START, START + 0.1, START + 0.1, START - 0.0501])
    q, index = interpolate(path)
    assert np.abs(np.diff(q, axis=0)).max() <= 2e-3 + 1e-12
    np.testing.assert_allclose(q[np.isin(index, range(4))], path, atol=1e-12)


def test_meshes_touch_where_their_boxes_overlap(robot, files):
    pytest.importorskip("fcl")
    meshes = load_robot("meshes", files / "robot.json")
    assert {piece["link"] for piece in meshes["pieces"]} == set(range(8))
    poses, _ = forward_kinematics(meshes, START[None])
    corner = poses[0, 7, :3, :3] @ meshes["pieces"][-1]["vertices"][0] + poses[0, 7, :3, 3]  # of a finger
    for offset, touches in ((0.0495, True), (0.3, False)):
        ball = placed({"kind": "sphere", "radius": 0.05}, corner - [0, 0, offset])
        assert (MeshContacts(meshes, [ball]).distances(START[None])[0][0] < 0) == touches
    for shape in SHAPES:
        assert MeshContacts(meshes, [placed(shape, corner, name="x")]).distances(START[None])[1][0].endswith("'x'")
    q = np.random.default_rng(0).uniform(LOWER, UPPER, (150, 7))
    contacts = MeshContacts(meshes, [placed(shape, (0.4, 0.3, 0.6)) for shape in SHAPES[:2]])
    distances, _ = contacts.distances(q)
    contacts.reach[:] = 10.0
    assert 0.1 < (distances < 0).mean() < 0.9
    np.testing.assert_array_equal(contacts.distances(q)[0] < 0, distances < 0, "the bounding spheres hide a contact")
    folded = np.array([[0.0, 0.0, 0.0, -3.0, 0.0, 0.1, 0.0]])
    assert MeshContacts(meshes, []).distances(folded)[0][0] < 0, "the hand is inside the arm"


def test_the_robot_of_a_urdf_file_is_that_of_pinocchio(tmp_path, rng):
    pinocchio = pytest.importorskip("pinocchio")
    links = "".join(f'<link name="panda_link{k}"/>' for k in range(8))
    ball = '<collision><geometry><sphere radius="0.03"/></geometry><origin xyz="0.01 0.02 0.03"/></collision>'
    joints = "".join(
        f'<joint name="j{k}" type="revolute"><parent link="panda_link{k}"/><child link="panda_link{k + 1}"/><origin '
        f'xyz="{0.1 * k} 0.2 0.3" rpy="0.3 {0.1 * k} -0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="{k + 1}" velocity="1" '
        'effort="1"/></joint>'
        for k in range(7)
    )
    hand = '<origin xyz="0.1 0 0.2" rpy="0.1 0.2 -0.7"/>'
    tool = '<joint name="t" type="fixed"><parent link="hand"/><child link="panda_grasptarget"/><origin xyz="0 0 0.1"/></joint>'
    text = (
        f'<robot name="r">{links}<link name="hand">{ball}</link><link name="panda_grasptarget"/>{joints}{tool}'
        f'<joint name="h" type="fixed"><parent link="panda_link7"/><child link="hand"/>{hand}</joint></robot>'
    )
    (tmp_path / "panda_spherized.urdf").write_text(text)
    robot = load_robot("spheres", tmp_path / "panda_spherized.urdf")
    model = pinocchio.buildModelFromXML(text)
    data, q = model.createData(), rng.uniform(-1, 1, 7)
    pinocchio.framesForwardKinematics(model, data, q)
    poses, tool = forward_kinematics(robot, q[None])
    np.testing.assert_allclose(tool[0], data.oMf[model.getFrameId("panda_grasptarget")].homogeneous, atol=1e-12)
    (sphere,) = robot["spheres"]
    placed_center = data.oMf[model.getFrameId("hand")].act(np.array([0.01, 0.02, 0.03]))
    np.testing.assert_allclose(poses[0, 7, :3, :3] @ sphere["center"] + poses[0, 7, :3, 3], placed_center, atol=1e-12)
    assert (sphere["link"], sphere["radius"], robot["upper"][6]) == (7, 0.03, 7.0)


def test_the_archive_gives_the_problems_and_the_locked_problems(robot, files):
    data = read_problems(files / "problems.tar.bz2")
    assert [entry["id"] for entry in data] == ["box/0001", "table_pick/0041"]
    assert data[0]["objects"][1] == placed(
        {"kind": "cylinder", "length": 0.14, "radius": 0.03}, (0.1, -0.9, 0.3), (0, 0, 0.6, 0.8), "can"
    )
    healthy = make_healthy(data, robot)
    assert [problem.name for problem in healthy] == ["box/0001"], "table_pick/0041 starts in contact"
    locked = make_locked(healthy)
    assert len(locked) == 14
    for problem in locked:
        changed = problem.start - healthy[0].start
        assert problem.start[problem.joint] == problem.value
        assert not changed[np.arange(7) != problem.joint].any()
        assert (problem.value == healthy[0].start[problem.joint]) == problem.name.endswith("start")
    (files / "problems.json").write_text(json.dumps(data))
    assert read_problems(files / "problems.json") == data


def test_the_stored_locks_are_complete_and_within_limits():
    rows = [line.split(",") for line in LOCKS_FILE.read_text().splitlines()]
    values = np.array([row[1:] for row in rows], dtype=float)
    assert len({row[0] for row in rows}) == len(values) == 699
    assert ((values > [-2.9671, -1.8326, -2.9671, -3.1416, -2.9671, -0.0873, -2.9671]).all(axis=0)).all()
    assert ((values < [2.9671, 1.8326, 2.9671, 0.0873, 2.9671, 3.8223, 2.9671]).all(axis=0)).all()


def test_the_draw_is_fixed(robot):
    problems = [Problem(str(k), START, np.eye(4), [], 0) for k in range(1000)]
    assert len({problem.name for problem in draw(problems)}) == 700
    assert [problem.name for problem in draw(problems)[:3]] == ["88", "624", "770"]


def test_goal_configurations_meet_the_pose_and_keep_the_lock(robot):
    problem = make_problem(robot, START + np.array([0.6, 0.2, 0.0, 0.1, -0.2, 0.1, 0.1]), joint=2)
    goals = find_goal_configurations(robot, problem, SphereContacts(robot, []))
    assert len(goals)
    for goal in goals:
        assert validate(robot, {**problem.to_dict(), "start": goal}, [goal]).is_accepted


class Straight(Planner):
    """Planner of the tests: a straight line to the nearest goal configuration."""

    package = module = "numpy"

    def solve(self, problem, goals, seconds):
        return Answer("solved", np.array([problem.start, goals[0]]))


class Pessimist(Straight):
    def solve(self, problem, goals, seconds):
        return Answer("proved infeasible", None, "boxes")


def test_a_run_writes_the_table_resumes_and_finds_contradictions(files, monkeypatch, capsys):
    monkeypatch.setattr(command, "ADAPTERS", {"straight": Straight, "pessimist": Pessimist})
    out, verdicts = files / "out", files / "verdicts.json"
    words = ["--problems", str(files / "problems.tar.bz2"), "--robot", str(files / "robot.json"), "--out", str(out)]
    assert command.main([*words, "--count", "5", "--verdicts", str(verdicts)]) == 0
    lines = (out / "results.jsonl").read_text().splitlines()
    assert len(lines) == 12, "two planners, one healthy and five locked problems"
    table = (out / "RESULTS.md").read_text()
    assert "| spheres | healthy | straight " in table
    assert "straight (spheres)" not in table
    assert "box/0001 (spheres): pessimist proved it infeasible, and the validator accepted the path of straight" in table
    assert command.main([*words, "--count", "5"]) == 0
    assert (out / "results.jsonl").read_text().splitlines() == lines
    assert command.main([*words, "--check", str(verdicts)]) == 0
    assert command.main([*words, "--export", str(files / "problems.jsonl")]) == 0
    exported = [json.loads(line) for line in (files / "problems.jsonl").read_text().splitlines()]
    assert [exported[0]["name"], exported[14]["name"], exported[14]["lock"]["joint"]] == ["box/0001", "box/0001/j7/random", 6]
    data = json.loads(verdicts.read_text())
    entry = next(entry for entry in data["verdicts"].values() if "path" in entry)
    entry["path"][-1][0] += 0.1
    verdicts.write_text(json.dumps(data))
    capsys.readouterr()
    assert command.main([*words, "--check", str(verdicts)]) == 1
    assert "from the goal" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "sentence"),
    [(("--count", "0"), "count is 0; it must be 1 or more"), (("--seconds", "nan"), "seconds is nan; it must be above 0")],
)
def test_numbers_out_of_bounds_are_refused(words, sentence, capsys):
    with pytest.raises(SystemExit):
        command.main(words)
    assert sentence in capsys.readouterr().err


class Interrupted(Straight):
    def solve(self, problem, goals, seconds):
        if problem.name.endswith("j2/start"):
            os.kill(os.getpid(), signal.SIGINT)
        if problem.name.endswith("j3/start"):
            raise RuntimeError("singular")
        return super().solve(problem, goals, seconds)


def test_an_interrupted_run_resumes_and_an_error_is_a_record(files, monkeypatch):
    monkeypatch.setattr(command, "ADAPTERS", {"interrupted": Interrupted})
    monkeypatch.setattr(command, "draw", lambda problems: problems)
    words = ["--problems", str(files / "problems.tar.bz2"), "--robot", str(files / "robot.json"), "--out", str(files / "out")]
    handler = signal.getsignal(signal.SIGINT)
    assert command.main([*words, "--arm", "locked"]) == 130
    assert signal.getsignal(signal.SIGINT) is handler
    first = (files / "out" / "results.jsonl").read_text().splitlines()
    assert json.loads(first[-1])["problem"] == "box/0001/j2/start"
    with (files / "out" / "results.jsonl").open("a") as lines:
        lines.write('{"track": "sphe')  # cut off by a power loss
    assert command.main([*words, "--arm", "locked"]) == 0
    records = read_results(files / "out" / "results.jsonl")
    assert len({record["problem"] for record in records}) == 14
    assert [record["note"] for record in records if record["problem"].endswith("j3/start")] == [
        "error: RuntimeError('singular')"
    ]


def test_missing_files_are_named(files, monkeypatch, capsys):
    monkeypatch.delenv("MOTIONBENCHMAKER_PANDA", raising=False)
    monkeypatch.delenv("VAMP_PANDA_SPHERES", raising=False)
    assert command.main([]) == 2
    assert "no file of the robot is given" in capsys.readouterr().err
    assert command.main(["--robot", str(files / "robot.json")]) == 2
    assert "MOTIONBENCHMAKER_PANDA" in capsys.readouterr().err
    assert command.main(["--robot", str(files / "robot.json"), "--problems", "nothing.json"]) == 2
    assert "nothing.json, does not exist" in capsys.readouterr().err


def test_rounded_paths_stay_valid_and_other_formats_are_refused(robot, tmp_path):
    problem = make_problem(robot, START + 0.123456789 * np.eye(7)[0], joint=2)
    path = [START, START + 0.123456789 * np.eye(7)[0]]
    rounded = round_path(robot, problem, path, SphereContacts)
    assert rounded[1][0] == 0.1235
    record = {"planner": "a", "track": "spheres", "problem": problem.name, "verdict": "solved", "path": [list(q) for q in path]}
    assert write_verdicts(tmp_path / "v.json", [record], "a", "spheres", robot, [problem], SphereContacts) == 1
    assert check_verdicts(tmp_path / "v.json", robot, [problem], SphereContacts) == []
    (tmp_path / "v.json").write_text('{"format": "other"}')
    with pytest.raises(ValueError, match="must be locked-planning-verdicts/1"):
        check_verdicts(tmp_path / "v.json", robot, [problem], SphereContacts)


def test_a_refused_path_is_no_contradiction():
    record = {"track": "spheres", "problem": "p", "planner": "a", "verdict": "solved", "violation": "contact"}
    proof = {**record, "planner": "b", "verdict": "proved infeasible", "violation": ""}
    assert find_contradictions([record, proof]) == []
    assert len(find_contradictions([{**record, "violation": ""}, proof])) == 1


def test_recover_solves_a_healthy_and_a_locked_problem_and_proves_a_lock(robot, tmp_path):
    planner = Holdfast(robot, write_files(robot, tmp_path))
    post = placed({"kind": "box", "size": [0.1, 0.1, 0.4]}, (0.45, 0.25, 0.6), name="post")
    end = START + np.array([0.9, 0.1, 0.0, 0.1, 0.1, 0.0, 0.1])
    for joint in (None, 2):
        problem = make_problem(robot, end, [post], joint)
        answer = planner.solve(problem, np.zeros((0, 7)), 20.0)
        assert answer.verdict == "solved", answer.note
        assert validate(robot, problem.to_dict(), answer.path).is_accepted
    far = Problem("scene/0002", START, pose((3.0, 0, 0)), [], 0, 0.0)
    assert planner.solve(far, np.zeros((0, 7)), 20.0)[::2] == ("proved infeasible", "reach bound")
