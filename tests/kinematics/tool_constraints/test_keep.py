"""Rows kept along the whole motion: by Pinocchio's kinematics at every instant, by closed forms, and where it cannot be."""

from __future__ import annotations

from dataclasses import replace
from importlib.resources import files
from itertools import pairwise

import numpy as np
import pinocchio as pin
import pytest

import holdfast as hf
import oracles
from holdfast import tool_constraints
from holdfast.core.errors import InputError
from holdfast.kinematics.tool_constraints.manifold import ConstraintManifold
from holdfast.model.arm.task import task_from_rows
from holdfast.response.recovery import RecoveryOutcome, attempt
from holdfast.response.recovery.task_rows import make_row_solver
from holdfast.response.recovery.verification import verify_waypoints

URDF = files("holdfast.model.arms") / "data" / "panda.urdf"
DOWN = np.diag([1.0, -1.0, -1.0, 1.0])
FINE = 5e-4  # rad or m


@pytest.fixture(scope="module")
def panda():
    return hf.Arm.from_urdf(str(URDF), tip="panda_link8")


@pytest.fixture(scope="module")
def three():
    """Links of 1 m, each joint within 2.9 rad."""
    arm = hf.arms.load("planar-3r")
    return replace(arm, joints=tuple(replace(j, lower=-2.9, upper=2.9) for j in arm.joints))


def poses_on_the_way(arm, q):
    """Tool poses (N, 4, 4) by Pinocchio along straight pieces of joint space."""
    model, tool = oracles.to_pinocchio(arm)
    data = model.createData()
    out = []
    for a, b in pairwise(q):
        for s in np.linspace(0, 1, int(np.ceil(np.abs(b - a).max() / FINE)) + 1):
            pin.framesForwardKinematics(model, data, a + s * (b - a))
            out.append(data.oMf[tool].homogeneous.copy())
    return np.array(out)


def tilt(poses, down=(0, 0, -1)):
    return np.arccos(np.clip(poses[:, :3, 2] @ np.array(down, dtype=float), -1, 1))


def pointing_down(arm, q):
    solver = make_row_solver(arm, task_from_rows(["wx", "wy"], frame="tool"))
    return solver.solve(np.array([q]), DOWN[None], np.ones((1, 2)), np.ones(arm.n, dtype=bool))[0]


# ---- pieces --------------------------------------------------------------------------------------------------------------


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["RRR", "RPRR", "CRRPRR"])
def test_no_proved_piece_breaks_a_row(types, rng):
    arm = oracles.random_arm(rng, types=types, limits=2.5)
    a = oracles.inside(arm, rng, 60)
    b = a + rng.normal(0, 0.15, a.shape)
    for k in range(3):
        start = arm.forward_kinematics(a[k])
        kept = [
            tool_constraints.upright(0.3, axis=rng.normal(size=3), direction=start[:3, 2]),
            tool_constraints.rail(rng.normal(size=3), within=(0.15, 0.3)),
            tool_constraints.plane(rng.normal(size=3), frame="tool", within=(0.1, 0.1)),
        ]
        axis = start[:3, :3].T @ kept[0].direction + rng.normal(0, 0.05, 3)
        kept[0] = tool_constraints.upright(0.3, axis=axis, direction=kept[0].direction)
        for one in kept:
            one = one.anchor(start)
            manifold = ConstraintManifold(arm, [one], np.ones(arm.n, dtype=bool), (arm.lower, arm.upper))
            first, last = np.repeat(a[k : k + 1], 60, axis=0), a[k] + (b - a) * rng.uniform(0, 1, (60, 1))
            proved = manifold.prove_edges(first, last)
            held = []
            for x, y in zip(first, last, strict=True):
                away, turned = one.distances(oracles.forward(arm, x + np.linspace(0, 1, 101)[:, None] * (y - x)))
                held.append(away.max() <= one.within[0] + 1e-8 and turned.max() <= one.widest + 1e-8)
            held = np.array(held)
            assert not (proved & ~held).any()
            assert proved.any()
            assert (proved == held).mean() > 0.9  # and few that could be proved are not


# ---- extensions and boxes ------------------------------------------------------------------------------------------------


def draw_constraints(rng, start):
    """One constraint of each kind, with cones and without, through a pose (4, 4) at the start."""
    normal, axis = rng.normal(size=(2, 3))
    direction = start[:3, :3] @ axis
    kept = [
        tool_constraints.upright(0.3, axis=axis, direction=direction),
        tool_constraints.upright(0.0, axis=axis, direction=direction),
        tool_constraints.rail(normal),
        tool_constraints.plane(normal, frame="tool", within=(0.05, 0.05)),
    ]
    turned = replace(kept[3], normals=np.zeros((0, 3)), turned=True, name="turned")
    return [constraint.anchor(start) for constraint in (*kept, turned)]


def hold(constraints, poses, slack=1e-7):
    return all(
        (away <= constraint.within[0] + slack).all() and (turned <= constraint.widest + slack).all()
        for constraint in constraints
        for away, turned in [constraint.distances(poses)]
    )


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["RRRRRRR", "RPRRCR"])
def test_extensions_come_nearer_and_hold_all_along(types, rng):
    arm = oracles.random_arm(rng, types=types, limits=2.5)
    scale, free = rng.uniform(0.5, 2.0, arm.n), rng.uniform(size=arm.n) < 0.8
    arrived = came_nearer = 0
    for q in oracles.inside(arm, rng, 6):
        kinds = draw_constraints(rng, arm.forward_kinematics(q))
        for constraints in ([kinds[0]], [kinds[1]], [kinds[2]], [kinds[4]], [kinds[0], kinds[3]]):
            limits = np.where(free, arm.lower, q), np.where(free, arm.upper, q)
            manifold = ConstraintManifold(arm, constraints, free, limits)
            targets = q + np.where(free, rng.normal(0, 0.4, (12, arm.n)), 0.0)
            targets[:6] = manifold.project(np.clip(targets[:6], *limits))
            may_arrive = manifold.is_satisfied(targets) & ((targets >= limits[0]) & (targets <= limits[1])).all(axis=1)
            is_largest = bool(rng.integers(2))
            paths, has_arrived = manifold.extend_paths(
                np.repeat(q[None], 12, axis=0),
                targets,
                scale,
                has_largest_joint_metric=is_largest,
                edges=None,
                resolution=1e-3,
            )
            arrived += has_arrived.sum()
            for index, (path, target, is_there) in enumerate(zip(paths, targets, has_arrived, strict=True)):
                points = np.concatenate([q[None], path])
                distances = np.linalg.norm((target - points) * scale, ord=np.inf if is_largest else 2, axis=1)
                assert (np.diff(distances) < 0).all()
                came_nearer += len(path) > 0
                assert not is_there or (path[-1] == target).all()
                assert may_arrive[index] or not is_there
                assert ((points >= limits[0] - 1e-12) & (points <= limits[1] + 1e-12)).all()
                dense = np.concatenate([a + np.linspace(0, 1, 9)[:, None] * (b - a) for a, b in pairwise(points)] or [points])
                assert hold(constraints, oracles.forward(arm, dense))
    assert arrived > 60
    assert came_nearer > 200


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["RRRRRRR", "RPRRCR"])
def test_rows_and_slopes_by_finite_differences(types, rng):
    arm = oracles.random_arm(rng, types=types, limits=2.5)
    for q in oracles.inside(arm, rng, 10):
        for constraint in draw_constraints(rng, arm.forward_kinematics(q)):
            manifold = ConstraintManifold(arm, [constraint], np.ones(arm.n, dtype=bool), (arm.lower, arm.upper))
            near = q + rng.normal(0, 0.25, arm.n)
            lengths, rows, slopes = (values[0] for values in manifold.evaluate_errors(near[None]))
            steps = near + 1e-6 * np.concatenate([np.zeros((1, arm.n)), np.eye(arm.n), -np.eye(arm.n)])
            away, turned = constraint.distances(oracles.forward(arm, steps))
            expected = []
            if len(constraint.normals):
                expected.append((away[0], away, rows[: len(constraint.normals)], 1.0))
            if constraint.widest < np.inf:
                length = 2 * np.sqrt(2) * np.sin(turned[0] / 2) if constraint.turned else np.sin(turned[0])
                rotation_rows = rows[len(constraint.normals) :]
                if constraint.angle and not constraint.turned:
                    assert (rotation_rows[0] > 0) == (turned[0] > constraint.angle)
                # The rows are the chord of the angle, which a rotation about their direction reduces by its slope.
                expected.append((length, 2 * np.sin(turned / 2), rotation_rows, np.cos(turned[0] / 2)))
            np.testing.assert_allclose(lengths, [length for length, *_ in expected], atol=1e-12)
            first_row = 0
            for _, errors, its_rows, factor in expected:
                its_slopes = slopes[first_row : first_row + len(its_rows)]
                first_row += len(its_rows)
                if np.linalg.norm(its_rows) > 0:
                    differences = (errors[1 : arm.n + 1] - errors[arm.n + 1 :]) / 2e-6
                    reduction = its_rows @ its_slopes / np.linalg.norm(its_rows)
                    np.testing.assert_allclose(differences, -reduction * factor, atol=1e-5)
            assert first_row == len(rows)


@pytest.mark.parametrize("angle", [0.0, 0.3])
def test_a_tool_that_points_exactly_away_is_turned_round(panda, angle, rng):
    q = rng.uniform(0.6 * panda.lower + 0.4 * panda.upper, 0.4 * panda.lower + 0.6 * panda.upper, (20, 7))
    projected = []
    for row, start in zip(q, panda.forward_kinematics(q), strict=True):
        constraint = tool_constraints.upright(angle, direction=-start[:3, 2]).anchor(start)
        manifold = ConstraintManifold(panda, [constraint], np.ones(7, dtype=bool), (panda.lower, panda.upper))
        assert not manifold.is_satisfied(row[None])[0]
        projected.append(manifold.is_satisfied(manifold.project(row[None]))[0])
    assert np.mean(projected) > 0.5


@pytest.mark.interpreted
@pytest.mark.parametrize("types", ["RRRRR", "RPRRC"])
def test_no_box_with_a_configuration_that_is_allowed_is_left_out(types, rng):
    arm = oracles.random_arm(rng, types=types, limits=2.5)
    left_out = tried = 0
    for q in oracles.inside(arm, rng, 8):
        for constraint in draw_constraints(rng, arm.forward_kinematics(q)):
            manifold = ConstraintManifold(arm, [constraint], np.ones(arm.n, dtype=bool), (arm.lower, arm.upper))
            half = rng.uniform(0, rng.choice([0.02, 0.1, 0.3]), arm.n)
            allowed = manifold.project(q + rng.normal(0, 0.5, (30, arm.n)))
            allowed = allowed[manifold.is_satisfied(allowed)]
            middle = allowed + rng.choice([-1.0, 1.0, 0.5], allowed.shape) * half
            assert not manifold.exclude_boxes(middle, half).any()
            anywhere = oracles.inside(arm, rng, 50)
            inside = (anywhere[:, None] + half * rng.uniform(-1, 1, (50, 200, arm.n))).reshape(-1, arm.n)
            is_met = manifold.is_satisfied(inside).reshape(50, 200).any(axis=1)
            is_left_out = manifold.exclude_boxes(anywhere, half)
            assert not (is_met & is_left_out).any()
            left_out, tried = left_out + is_left_out.sum(), tried + 50
    assert left_out > 0.5 * tried


@pytest.mark.parametrize("tilted", [False, True])
def test_first_and_last_joints_that_do_not_change_a_tilt(panda, tilted, rng):
    direction = [0.0, 0.1, -1.0] if tilted else [0.0, 0.0, -1.0]
    q = pointing_down(panda, [1.92, 1.35, 2.63, -1.39, -1.44, 0.5, 0.98])
    constraint = tool_constraints.upright(0.3, direction=direction).anchor(panda.forward_kinematics(q))
    free = np.array([True, True, False, True, True, True, True])
    limits = np.where(free, panda.lower, q), np.where(free, panda.upper, q)
    manifold = ConstraintManifold(panda, [constraint], free, limits)
    assert manifold.changing_joints.tolist() == [tilted, True, False, True, True, True, False]
    other = rng.uniform(*limits, (50, 7))
    turned = np.where(manifold.changing_joints | ~free, other, rng.uniform(*limits, (50, 7)))
    np.testing.assert_allclose(manifold.constraint_margins(turned), manifold.constraint_margins(other), atol=1e-12)
    rail = replace(constraint, normals=np.eye(3)[:1])
    assert ConstraintManifold(panda, [constraint, rail], free, limits).changing_joints.tolist() == free.tolist()


def test_too_many_constraints_are_refused(panda):
    q = np.array([0.0, -0.4, 0.0, -2.0, 0.0, 1.6, 0.0])
    keep = [tool_constraints.upright(0.3, direction=panda.forward_kinematics(q)[:3, 2])] * 25
    with pytest.raises(InputError, match="25 equations; at most 64 joints and 24 equations"):
        hf.recover(panda, ["panda_joint3"], q, goal=q + 0.1, task="pose", samples=0, clearance=False, keep=keep)


# ---- motions -------------------------------------------------------------------------------------------------------------


def test_an_upright_transfer_with_a_locked_joint(panda):
    a = pointing_down(panda, [1.92, 1.35, 2.63, -1.39, -1.44, 0.5, 0.98])
    b = pointing_down(panda, [1.16, -0.04, 2.63, -3.07, 0.52, 3.1, 2.64])
    cone, bad, goal = np.deg2rad(5), {"panda_joint3": a[2]}, panda.forward_kinematics(b)
    free = hf.recover(panda, bad, a, goal=goal, samples=0, clearance=False)
    assert tilt(poses_on_the_way(panda, free.q)).max() > 2 * cone
    kept = hf.recover(panda, bad, a, goal=goal, samples=0, clearance=False, keep=tool_constraints.upright(cone))
    assert kept.ok
    poses = poses_on_the_way(panda, kept.q)
    assert tilt(poses).max() <= cone
    assert kept.verified.kept[0][1] == pytest.approx(tilt(poses).max(), abs=1e-3)
    np.testing.assert_allclose(poses[-1], goal, atol=1e-5)
    assert "upright" in "\n".join(kept.describe())
    assert kept.to_dict()["keep"][0]["angle"] == pytest.approx(cone)
    # What plans it and what looks at it are different code: a spoilt motion is refused.
    spoilt = np.concatenate([kept.q[:1], kept.q[:1] + 0.2 * np.eye(7)[5], kept.q])
    found = verify_waypoints(kept.degraded, a, spoilt, rows=make_row_solver(panda, kept.task).rows, constraints=kept.keep)
    assert "rotated away by" in str(found)
    replay = hf.recovery.check_waypoints(panda, spoilt, bad, keep="upright:5deg")
    assert not replay.ok
    assert "rotated away by" in "\n".join(replay.describe())
    assert kept.check().ok
    assert "All path constraints are satisfied." in kept.check().describe()


def test_a_planar_drawer_by_its_closed_form(three):
    """Two links that move, the last locked straight: the elbow follows from the distance, so the motion is known."""
    # Kept is the point alone on the line y = 0.5, by a plane across y; of three joints with one locked one motion is left.
    start = np.array([0.9, -1.2, 0.0])
    pose = three.forward_kinematics(start)
    goal = pose.copy()
    goal[0, 3] -= 1.0
    answer = hf.recover(
        three, {"joint3": 0.0}, start, goal=goal, task="planar", keep=tool_constraints.plane([0, 1, 0]), samples=0
    )
    assert answer.ok
    poses = poses_on_the_way(three, answer.q)
    assert np.abs(poses[:, 1, 3] - pose[1, 3]).max() <= 1e-3
    x, y = answer.q[:, 0], answer.q[:, 1]
    place = np.stack([np.cos(x) + 2 * np.cos(x + y), np.sin(x) + 2 * np.sin(x + y)], axis=1)
    np.testing.assert_allclose(place[:, 1], pose[1, 3], atol=1e-6)
    # Law of cosines for links of 1 m and 2 m; the elbow stays on its side.
    np.testing.assert_allclose(y, -np.arccos((place[:, 0] ** 2 + place[:, 1] ** 2 - 5) / 4), atol=1e-5)


def test_a_rail_keeps_place_and_orientation(panda):
    at = pointing_down(panda, [0.2, 0.3, 0.1, -1.9, 0.2, 2.2, 0.8])
    pose = panda.forward_kinematics(at)
    goal = pose.copy()
    goal[:3, 3] += 0.15 * pose[:3, 2] * -1
    answer = hf.recover(
        panda,
        {"panda_joint1": at[0]},
        at,
        goal=goal,
        samples=0,
        clearance=False,
        keep=tool_constraints.rail([0, 0, 1], frame="tool"),
    )
    assert answer.ok
    poses = poses_on_the_way(panda, answer.q)
    away = poses[:, :3, 3] - pose[:3, 3]
    assert np.linalg.norm(away - np.outer(away @ pose[:3, 2], pose[:3, 2]), axis=1).max() <= 1e-3
    assert np.arccos(np.clip((np.einsum("nij,ij->n", poses[:, :3, :3], pose[:3, :3]) - 1) / 2, -1, 1)).max() <= np.deg2rad(0.5)


def test_a_tool_path_without_orientation_is_followed_upright(panda):
    at = pointing_down(panda, [0.2, 0.3, 0.1, -1.9, 0.2, 2.2, 0.8])
    here = panda.forward_kinematics(at)[:3, 3]
    there = here + np.array([0.15, -0.2, 0.1])
    path = hf.paths.line(here, there)
    ask = {"goal": None, "path": path, "samples": 0, "clearance": False}
    plain = hf.recover(panda, {"panda_joint5": at[4]}, at, **ask)
    assert tilt(poses_on_the_way(panda, plain.q)).max() > np.deg2rad(20)
    answer = hf.recover(panda, {"panda_joint5": at[4]}, at, **ask, keep=tool_constraints.upright(0))
    assert answer.ok
    poses = poses_on_the_way(panda, answer.q)
    assert tilt(poses).max() <= np.deg2rad(0.5)
    np.testing.assert_allclose(poses[-1, :3, 3], there, atol=1e-5)
    answer = hf.recover(panda, {"panda_joint5": at[4]}, at, **ask, keep="plane:1,0,0")
    assert (answer.verdict.answer, answer.verdict.kind) == ("proved infeasible", "a pose of the path")


def test_upright_in_a_cell(panda):
    """Round a ball that is in the way of the upright motion without a cell."""
    a = pointing_down(panda, [1.92, 1.35, 2.63, -1.39, -1.44, 0.5, 0.98])
    b = pointing_down(panda, [1.16, -0.04, 2.63, -3.07, 0.52, 3.1, 2.64])
    ask = {"goal": panda.forward_kinematics(b), "samples": 0, "keep": "upright:15deg"}
    plain = hf.recover(panda, {"panda_joint3": a[2]}, a, **ask, clearance=False)
    assert plain.ok
    tool = poses_on_the_way(panda, plain.q)[:, :3, 3]
    ball = tool[len(tool) // 2]
    shape = hf.Clearance(
        panda, hf.Capsules.along_links(panda, 0.02), hf.Cell([hf.cell.Sphere("ball", 0.06, pose=ball)]), itself=False
    )
    answer = hf.recover(panda, {"panda_joint3": a[2]}, a, **ask, clearance=shape)
    assert answer.ok
    poses = poses_on_the_way(panda, answer.q)
    assert tilt(poses).max() <= np.deg2rad(15)
    assert np.linalg.norm(poses[:, :3, 3] - ball, axis=1).min() >= 0.06


# ---- where it cannot be -----------------------------------------------------------------------------------------------------


def test_a_line_through_what_the_arm_cannot_reach_is_not_called_infeasible_without_a_proof(three, monkeypatch):
    """Both ends of the line can be reached; between them it passes nearer to the base than links of 1 m and 2 m allow."""
    start, end = np.array([0.2, 2.3, 0.0]), np.array([2.2, 2.3, 0.0])
    a, b = (three.forward_kinematics(q) for q in (start, end))
    across = np.cross([0, 0, 1], b[:3, 3] - a[:3, 3])
    nearest = abs(a[:3, 3] @ across) / np.linalg.norm(across)
    assert nearest < 1 < np.linalg.norm(a[:3, 3])
    ask = {"goal": b, "task": "planar", "samples": 0}
    assert hf.recover(three, {"joint3": 0.0}, start, **ask).ok
    proved = hf.recover(three, {"joint3": 0.0}, start, **ask, keep=tool_constraints.plane(across), tries=1)
    assert (proved.verdict.kind, proved.ending) == ("disconnected", RecoveryOutcome.PROVED_DISCONNECTED)
    monkeypatch.setattr(attempt, "prove_goal_disconnected", lambda *_, **__: None)
    for tries, verdict in ((1, "undecided"), (4, "argued infeasible")):
        answer = hf.recover(three, {"joint3": 0.0}, start, **ask, keep=tool_constraints.plane(across), tries=tries)
        assert (answer.verdict.answer, answer.ending) == (verdict, RecoveryOutcome.NO_ROUTE_FOUND)
    assert "exhausted all that is connected" in str(answer.verdict)


def test_a_start_and_a_goal_that_break_a_row(panda):
    at = np.array([0, -0.3, 0, -2.2, 0, 2.6, 0.8])
    leaning = float(tilt(panda.forward_kinematics(at)[None])[0])
    goal = panda.forward_kinematics(pointing_down(panda, at))
    ask = {"samples": 0, "clearance": False}
    answer = hf.recover(panda, [2], at, goal=goal, keep=tool_constraints.upright(0.9 * leaning), **ask)
    assert (answer.ending, answer.verdict.kind) == (RecoveryOutcome.START_VIOLATES_CONSTRAINTS, "start")
    assert f"rotated away by {np.rad2deg(leaning):.4g} deg" in answer.reason
    goal = panda.forward_kinematics(at)
    goal[0, 3] += 0.05
    for wanted, task in ((goal, None), (goal, "position"), (at + 0.1 * np.eye(7)[0], None)):
        answer = hf.recover(panda, [2], at, goal=wanted, task=task, keep=["plane:1,0,0", "upright:1.5"], **ask)
        assert (answer.verdict.answer, answer.verdict.kind) == ("proved infeasible", "rows kept")
        assert "m off the plane" in str(answer.verdict)
    assert hf.recover(panda, [2], at, goal=goal, task="position", keep="plane:0,1,0", **ask).ok


def test_a_goal_that_leaves_the_row_free_meets_it(panda):
    """A place alone is asked for; the orientation there is that which is kept."""
    at = pointing_down(panda, [0.2, 0.3, 0.1, -1.9, 0.2, 2.2, 0.8])
    goal = panda.forward_kinematics(at)
    goal[:3, 3] += [0.1, 0.1, 0.05]
    goal[:3, :3] = np.eye(3)
    answer = hf.recover(
        panda, {"panda_joint5": at[4]}, at, goal=goal, task="position", keep="upright:0", samples=0, clearance=False
    )
    assert answer.ok
    poses = poses_on_the_way(panda, answer.q)
    np.testing.assert_allclose(poses[-1][:3, 3], goal[:3, 3], atol=1e-5)
    assert tilt(poses).max() <= np.deg2rad(0.5)


# ---- labels and bad input ---------------------------------------------------------------------------------------------------


def same(a, b):
    one, other = a.to_dict(), b.to_dict()
    numbers = ("normals", "direction", "axis", "angle", "within")
    near = all(np.allclose(one.pop(name) or 0, other.pop(name) or 0, rtol=1e-14) for name in numbers)
    return near and one == other


def test_labels_say_what_the_functions_say():
    assert same(tool_constraints.by_label("upright:10deg"), tool_constraints.upright(10 * np.pi / 180))
    assert same(
        tool_constraints.by_label("upright:angle=0.1,axis=1,0,0,direction=0,0,1"),
        tool_constraints.upright(0.1, axis=[1, 0, 0], direction=[0, 0, 1]),
    )
    assert same(tool_constraints.by_label("rail:direction=0,0,1,frame=tool"), tool_constraints.rail([0, 0, 1], frame="tool"))
    wiping = tool_constraints.plane([0, 0, 2], angle=3 * np.pi / 180, within=(2 * 1e-3, np.pi / 180))
    assert same(tool_constraints.by_label("plane:normal=0,0,2,angle=3deg,within=2mm,1deg"), wiping)


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: tool_constraints.upright(2.0), "below pi/2"),
        (lambda: tool_constraints.upright(np.nan), "from 0 to below"),
        (lambda: tool_constraints.rail([0, 0, 0]), "not all of them 0"),
        (lambda: tool_constraints.rail([0, 1]), "three finite numbers"),
        (lambda: tool_constraints.plane([0, 0, 1], frame="world"), "use 'base' or 'tool'"),
        (lambda: tool_constraints.plane([0, 0, 1], pose=np.zeros((2, 2))), "pose has shape"),
        (lambda: tool_constraints.plane([0, 0, 1], within=(0, 0)), "within is"),
        (lambda: tool_constraints.by_label("upwards:3"), "use one of upright, rail, plane"),
        (lambda: tool_constraints.by_label("upright"), "write for example upright:10deg"),
        (lambda: tool_constraints.by_label("upright:ten"), "not a number"),
        (lambda: tool_constraints.by_label("rail:direction=0,0,1,angle=3"), "setting 'angle' is not known"),
        (
            lambda: hf.recover(hf.arms.load("planar-3r"), [1], np.ones(3), keep=[3.0]),
            "it must be a ToolConstraint",
        ),
        (lambda: hf.recover(hf.arms.load("planar-3r"), [1], np.ones(3), keep=3.0), "keep is 3.0"),
    ],
)
def test_bad_input_is_one_sentence(bad, words):
    with pytest.raises(InputError, match=words.replace("(", r"\(")) as caught:
        bad()
    assert "\n" not in str(caught.value)
