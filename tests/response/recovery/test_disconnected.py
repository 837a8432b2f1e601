"""Goals that no motion leads to, against floods over grids whose distances are worked out by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.ndimage import label

import holdfast as hf
import oracles
from holdfast.interface.presentation import call_presenter
from holdfast.model.arm.task import task_from_rows
from holdfast.model.collision import Capsules
from holdfast.response.recovery import RecoveryOutcome, attempt
from holdfast.response.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.response.recovery.proofs.blocked_cells import BlockedCells, LinkPoints
from holdfast.response.recovery.proofs.flood import (
    _generate_connected_regions,
    find_confined_regions,
)
from holdfast.response.recovery.space import FreeSpace, JointMetric
from holdfast.response.recovery.task_rows import make_row_solver

CELL = Path(__file__).parents[3] / "examples" / "cells" / "fail-active.yaml"
THICK, BALL = 0.05, 0.2  # m
COUNT = 180  # of the grid of the flood, each way


def three_links(limit=np.inf):
    return hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=-limit, upper=limit) for _ in range(3)], name="three")


def among(arm, centres, radius=BALL):
    balls = [hf.cell.Sphere(f"ball{k}", radius, pose=[*c, 0]) for k, c in enumerate(centres)]
    return hf.Clearance(arm, Capsules.along_links(arm, THICK), hf.Cell(balls), itself=False)


def ends(q):
    return np.concatenate([np.zeros((len(q), 1)), np.cumsum(np.exp(1j * np.cumsum(q, axis=1)), axis=1)], axis=1)


def room(centres, q):
    """(N,) what is left between three links and the balls, by projection."""
    points, least = ends(q), np.full(len(q), np.inf)
    for c in centres @ [1, 1j]:
        for k in range(3):
            a, d = points[:, k], points[:, k + 1] - points[:, k]
            s = np.clip(((c - a) * d.conj()).real, 0, 1)
            least = np.minimum(least, np.abs(a + s * d - c))
    return least - BALL - THICK


def flooded(free, round_, start, goal, corners):
    """Whether two cells of a grid (COUNT, COUNT) are joined, round its edges if joints turn round and round."""
    names, _ = label(free, np.ones((3, 3)) if corners else None)
    if round_:
        for one, other in ((names[0], names[-1]), (names[:, 0], names[:, -1])):
            for shift in (-1, 0, 1) if corners else (0,):
                for a, b in zip(one, np.roll(other, shift), strict=True):
                    if a and b and a != b:
                        names[names == b] = a
    return names[start] == names[goal] != 0


@pytest.mark.parametrize("limit", [np.inf, 2.8], ids=["round", "limited"])
def test_a_proof_is_never_against_a_flood_and_hardly_ever_missing(rng, limit):
    arm = three_links(limit)
    edge = min(limit, np.pi)
    axis = -edge + (np.arange(COUNT) + 0.5) * 2 * edge / COUNT
    grid = np.zeros((COUNT, COUNT, 3))
    grid[..., 0], grid[..., 2] = np.meshgrid(axis, axis, indexing="ij")
    proved = apart = 0
    for case in range(3):
        centres = rng.uniform(-2.4, 2.4, (4, 2))
        centres = centres[np.linalg.norm(centres, axis=1) > 0.4]
        grid[..., 1] = rng.uniform(-1, 1)
        left = room(centres, grid.reshape(-1, 3)).reshape(COUNT, COUNT)
        free = np.argwhere(left > 0.05)
        if len(free) < 2:
            continue
        # Two that are not joined, if there are any.
        start = tuple(free[rng.integers(len(free))])
        goals = [tuple(free[k]) for k in rng.integers(len(free), size=12)]
        goal = next((g for g in goals if not flooded(left > 0, np.isinf(limit), start, g, True)), goals[0])
        joined = flooded(left > 0, np.isinf(limit), start, goal, False)
        a, b = grid[start], grid[goal]
        space = FreeSpace(arm, np.array([True, False, True]), among(arm, centres), 0.0, np.stack([a, b]))
        proof = next(find_confined_regions(space, a, b[None]), None)
        assert proof is None or not joined
        never = not flooded(left > -0.03, np.isinf(limit), start, goal, True)
        apart, proved = apart + never, proved + (never and proof is not None)
        if case < 1:  # a pose of the tool has another configuration, which may be joined
            pose, shape = arm.forward_kinematics(b), among(arm, centres)
            found = hf.recover(arm, {"joint2": a[1]}, a, goal=pose, task="planar", clearance=shape, samples=0, tries=1)
            assert found.verdict.kind != "disconnected" or proof is not None
    assert proved >= 0.8 * apart
    assert apart >= 1


def test_three_joints_cannot_get_past_what_is_always_in_the_way():
    arm = three_links()
    ranges = {"joint1": (-0.7, 0.7), "joint2": (-0.3, 0.3), "joint3": (-0.3, 0.3)}
    shape = among(arm, np.array([[2.0, 0.0]]), 0.3)
    start, goal = np.array([-0.6, 0.1, 0.0]), np.array([0.6, -0.1, 0.1])
    bad = hf.Degraded(arm, ranges=ranges)
    found = hf.recover(arm, bad, start, goal=goal, clearance=shape, samples=0, tries=1)
    assert (found.ending, found.verdict.answer, found.verdict.kind) == (
        RecoveryOutcome.PROVED_DISCONNECTED,
        "proved infeasible",
        "disconnected",
    )
    assert "joint1 and joint2 and joint3 that are connected to the start" in found.verdict.why


@pytest.fixture(scope="module")
def ring():
    """Joint 2 is locked, and balls close the ways of the other two."""
    arm = hf.arms.load("planar-3r")
    return arm, among(arm, np.array([[2.6, 0.4], [1.0, 0.5], [-1.0, -0.6]])), np.array([-0.9, 0.4, 0.3])


@pytest.mark.parametrize("kind", ["configuration", "pose", "path"])
def test_the_verdict_says_that_it_is_proved(ring, kind, monkeypatch):
    arm, shape, start = ring
    there = np.array([1.5, 0.4, 0.3])
    pose = arm.forward_kinematics(there)
    asked = {"goal": there}
    if kind == "pose":
        asked = {"goal": pose, "task": "planar"}
    elif kind == "path":
        monkeypatch.setattr(attempt, "find_route", lambda *_, **__: None)
        onwards = arm.forward_kinematics(np.add(there, [0.1, 0, 0]))
        asked = {"goal": None, "task": "planar", "path": hf.paths.line(pose[:3, 3], onwards[:3, 3])}
    found = hf.recover(arm, ["joint2"], start, clearance=shape, samples=0, tries=1, **asked)
    assert (found.verdict.answer, found.verdict.kind) == ("proved infeasible", "disconnected"), found.verdict
    assert not found.ok
    assert not len(found.q)
    assert "up to floating point" in found.proof
    assert "disconnected" in call_presenter(found, "present").answer
    assert found.to_dict()["verdict"]["kind"] == "disconnected"


def test_rows_kept_close_ways_too(rng):
    """A tool that must stay near a line cannot bring its arm from one side of it to the other."""
    arm = three_links(2.8)
    start = np.array([-0.3, 0.5, 0.4])
    keep = [hf.tool_constraints.plane([0, 1, 0], within=(0.04, 0.2)).anchor(arm.forward_kinematics(start))]
    axis = -2.8 + (np.arange(COUNT) + 0.5) * 5.6 / COUNT
    grid = np.zeros((COUNT, COUNT, 3))
    grid[..., 0], grid[..., 2] = np.meshgrid(axis, axis, indexing="ij")
    grid[..., 1] = 0.5
    off = np.abs(ends(grid.reshape(-1, 3))[:, 3].imag - ends(start[None])[0, 3].imag).reshape(COUNT, COUNT)
    at = tuple(np.abs(axis - start[k]).argmin() for k in (0, 2))
    space = FreeSpace(arm, np.array([True, False, True]), None, 0.0, start[None], constraints=keep)
    proved = 0
    for goal in rng.permutation(np.argwhere(off < 0.02))[:8]:
        proof = next(find_confined_regions(space, start, grid[tuple(goal)][None]), None)
        assert proof is None or not flooded(off <= 0.04, False, at, tuple(goal), False)
        assert proof is not None or flooded(off <= 0.07, False, at, tuple(goal), True)
        proved += proof is not None
    assert 0 < proved < 8


def test_a_gripper_that_cannot_get_past_the_forearm_keeps_the_last_joint_where_it_is(rng):
    """An open one, with joint 6 locked near its end; the exact sign of many configurations in between says the same."""
    panda = hf.arms.load("panda")
    clearance = hf.Clearance.by_default(panda, hf.Cell.load(CELL))
    start, goal = np.array([[0.3, 0.2, 0.1, -1.8, 0.0, 0.05, 1.0], [-0.3, 0.4, -0.5, -1.2, 0.5, 0.05, -2.2]])
    between = rng.uniform(panda.lower, panda.upper, (500, 7))
    between[:, 5], between[:, 6] = 0.05, rng.uniform(-1.2, 0.0, 500)
    assert clearance.sign(np.stack([start, goal])).all()
    assert not clearance.sign(between).any()
    for aim in ({"goal": goal}, {"goal": panda.forward_kinematics(goal), "task": "pose"}):
        found = hf.recover(panda, ["panda_joint6"], start, clearance=clearance, samples=0, tolerance=(1e-3, 0.01), **aim)
        assert (found.verdict.answer, found.verdict.kind) == ("proved infeasible", "disconnected"), found.verdict
        assert "the values of panda_joint7 that are connected" in found.proof
        assert found.proved_within
    there = goal.copy()
    there[6] = 1.1
    assert hf.recover(panda, ["panda_joint6"], start, goal=there, clearance=clearance, samples=0).ok


@pytest.mark.interpreted
def test_a_first_link_between_two_balls_stays_there_whatever_the_others_do():
    """Where the second and later links are does not matter; the balls are 0.6 m out, at 1 rad to both sides."""
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=-2.8, upper=2.8) for _ in range(4)], name="four")
    shape = among(arm, 0.6 * np.array([[np.cos(1), np.sin(1)], [np.cos(1), -np.sin(1)]]))
    start, there, here = np.zeros(4), np.array([2.0, 0, 0, 0]), np.array([0.4, 2.0, -1.0, 0.5])
    space = FreeSpace(arm, np.ones(4, dtype=bool), shape, 0.0, np.stack([start, there]))
    flood = next(iter(find_confined_regions(space, start, there[None])))
    edge = 1 - np.arcsin((BALL + THICK) / 0.6)
    most = np.abs(flood.lower + (flood.cells + 0.5) * flood.cell_widths)[:, 0].max() + flood.cell_widths[0] / 2
    assert edge <= most < edge + 0.35
    assert not list(find_confined_regions(space, start, np.stack([there, here])))


@pytest.mark.parametrize("limit", [np.inf, 2.8], ids=["round", "limited"])
def test_a_box_that_a_flood_misses_holds_nothing_that_it_got_to(limit, rng):
    arm = three_links(limit)
    space = FreeSpace(arm, np.ones(3, dtype=bool), None, 0.0, np.zeros((1, 3)))
    edge, seen = min(limit, np.pi), np.clip(rng.uniform(-0.8, 0.8, (20, 3)).cumsum(axis=0), -2.8, 2.8)

    def blocked(q, half):  # but about a way
        return np.abs(q[:, None, [0, 2]] - seen[:, [0, 2]]).max(axis=2).min(axis=1) > 0.5

    flood = next(
        f for f in _generate_connected_regions(space, seen[0], np.array([0, 2]), blocked, 80_000) if f.cells_per_joint == 32
    )
    assert 20 < len(flood.cells) < 1000
    middle, half = rng.uniform(-edge, edge, (400, 3)), rng.uniform(0, 0.4, (400, 3))
    missed = flood.excludes_boxes(middle, half)
    inside = (middle[:, None] + half[:, None] * rng.uniform(-1, 1, (1, 100, 3)))[..., [0, 2]]
    if np.isinf(limit):
        inside = np.arctan2(np.sin(inside), np.cos(inside))
    middles = flood.lower + (flood.cells + 0.5) * flood.cell_widths
    held = np.abs(inside[..., None, :] - middles).max(axis=3) <= edge / 32
    held = held.any(axis=(1, 2))
    assert not (missed & held).any()
    assert (missed | held).mean() > 0.8


# ---- tool constraints ------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def crane():
    """A yaw joint, three parallel pitch joints, and a roll joint: the tool points down where the pitch angles add up to 0."""
    rows = [(0.0, np.pi / 2, 0.4), (0.4, 0.0, 0.0), (0.4, 0.0, 0.0), (0.0, np.pi / 2, 0.0), (0.0, 0.0, 0.1)]
    return hf.Arm.from_dh([hf.DH(a=a, alpha=alpha, d=d, lower=-2.97, upper=2.97) for a, alpha, d in rows], name="crane")


def test_upright_sheets_a_revolution_apart_are_proved_disconnected(crane):
    start, goal = np.deg2rad([0, 60, -100, 40, 0]), np.deg2rad([70, 100, 130, 130, 20])
    pose = crane.forward_kinematics(goal)
    np.testing.assert_allclose(pose[:3, 2], [0, 0, -1], atol=1e-12)
    # The pitch angles of both elbow solutions add up to 360 and -360 degrees; with the yaw joint turned round they add up to 0.
    narrow = hf.Degraded(crane, ranges={"joint1": (-1.4, 1.4)})
    asked = {"goal": pose, "clearance": False, "samples": 0, "tolerance": (1e-3, 1e-2)}
    found = hf.recover(crane, narrow, start, keep="upright:5deg", **asked)
    assert (found.verdict.answer, found.verdict.kind) == ("proved infeasible", "disconnected"), found.verdict
    assert "joint2 and joint3 and joint4 that are connected" in found.verdict.why
    assert hf.recover(crane, narrow, start, **asked).ok
    assert hf.recover(crane, hf.Degraded(crane, ranges={"joint5": (-2.9, 2.9)}), start, keep="upright:5deg", **asked).ok


def test_a_flood_along_a_constraint_contains_all_that_walks_reach(rng):
    panda, keep = hf.arms.load("panda"), hf.tool_constraints.upright(np.deg2rad(3))
    free, solver = np.arange(7) != 4, make_row_solver(panda, task_from_rows(["wx", "wy"], frame="tool"))
    excluded = checked = 0
    for locked in (2.25, -2.11, 0.4):
        q = np.where(free, rng.uniform(panda.lower, panda.upper, (200, 7)), locked)
        q = solver.solve(q, np.tile(np.diag([1.0, -1, -1, 1]), (200, 1, 1)), np.ones((200, 2)), free)
        constraint = keep.anchor(np.diag([1.0, -1, -1, 1]))
        limits = np.where(free, panda.lower, q[0]), np.where(free, panda.upper, q[0])
        limited = replace(
            panda, joints=tuple(replace(j, lower=a, upper=b) for j, a, b in zip(panda.joints, *limits, strict=True))
        )
        space = FreeSpace(limited, free, None, 0.0, q[:1], constraints=[constraint])
        q = q[space.are_valid(q)]
        metric, nodes = JointMetric.for_arm(panda, "travel", None, free), q[:1]
        for _ in range(25):
            sources = nodes[rng.integers(len(nodes), size=48)]
            paths, _ = space.extend_paths(metric, sources, np.where(free, rng.normal(0, 1.5, sources.shape), 0.0))
            nodes = np.concatenate([nodes, *paths])
        joints, blocked = np.flatnonzero(space.manifold.changing_joints), BlockedCells(space).are_blocked_without_objects
        assert joints.tolist() == [1, 2, 3, 5]
        for flood in _generate_connected_regions(space, q[0], joints, blocked, 100_000):
            assert not flood.excludes_boxes(nodes, np.zeros_like(nodes)).any()
            is_excluded = flood.excludes_boxes(q, np.zeros_like(q))
            excluded, checked = excluded + is_excluded.sum(), checked + len(q)
    assert 0.05 * checked < excluded < 0.9 * checked


# ---- bounds ----------------------------------------------------------------------------------------------------------


@pytest.mark.interpreted
def test_no_point_moves_farther_than_its_bound(rng):
    arm = oracles.random_arm(rng, types="RRPRRR", limits=2.0)
    points = LinkPoints(np.array([0, 2, 3, 5, 5]), rng.normal(0, 0.2, (5, 3)))
    q = oracles.inside(arm, rng, 20)
    shares = []
    for size in (0.01, 0.1, 0.6):
        half = rng.uniform(0, size, arm.n) * (rng.uniform(size=arm.n) < 0.7)
        most = points.bound_motion(arm, arm.frames(q), half)
        places = points.world_positions(arm.frames(q))
        for _ in range(60):
            other = points.world_positions(arm.frames(q + half * rng.choice([-1, 1, rng.uniform(-1, 1)], q.shape)))
            moved = np.linalg.norm(other - places, axis=2)
            assert (moved <= most + 1e-12).all()
            shares.append((moved / np.maximum(most, 1e-12)).max())
    assert max(shares) > 0.7


def test_a_box_that_is_blocked_holds_nothing_that_is_clear(rng):
    centres = np.array([[1.4, 0.5], [-0.7, -1.2]])
    blocked = BlockedBoxes(among(three_links(2.8), centres, 0.5), 0.0)
    middle, half = rng.uniform(-2.8, 2.8, (3000, 3)), rng.uniform(0, 0.2, (3000, 3))
    found = blocked(middle, half)
    assert 100 < found.sum() < 2000
    inside = middle[found, None] + half[found, None] * rng.uniform(-1, 1, (1, 60, 3))
    corners = middle[found, None] + half[found, None] * np.array([(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])
    q = np.concatenate([inside, corners], axis=1).reshape(-1, 3)
    assert (room(centres, q) + BALL - 0.5).max() < 0
    assert blocked.blocker_names == "ball0, ball1"
    touching = room(centres, middle) + BALL - 0.5 < -1e-3
    assert (blocked(middle, 0 * half) >= touching).mean() > 0.97, "balls do not fill a link; nearly all that touches is seen"


@pytest.mark.parametrize("bodies", [False, True])
def test_a_box_in_which_the_arm_blocks_itself_holds_nothing_that_is_clear(bodies, rng):
    """Of capsules, and of bodies that capsules cover, beside fcl."""
    arm = hf.arms.load("panda")
    clearance = hf.Clearance.by_default(arm)
    if not bodies:
        clearance = hf.Clearance(arm, replace(clearance.capsules, shape=None, source=""))
    blocked = BlockedBoxes(clearance, 0.0)
    middle = rng.uniform(arm.lower, arm.upper, (3000, 7))
    half = rng.uniform(0, 0.03, middle.shape)
    found = blocked(middle, half)
    assert 20 < found.sum() < 600
    q = (middle[found, None] + half[found, None] * rng.choice([-1, 0, 1], (1, 4, 7))).reshape(-1, 7)
    assert not clearance.sign(q).any()
    assert " & " in blocked.blocker_names


def test_poses_without_a_clear_configuration_are_proved_to_have_none(rng):
    """Against configurations of closed forms, one every half degree of the first joint."""
    arm, proved, known = three_links(2.8), 0, 0
    for _ in range(24):
        centres, target = rng.uniform(-1.6, 1.6, (2, 2)), rng.uniform(-1.8, 1.8, 2)
        pose = np.eye(4)
        pose[:2, 3] = target
        first = np.arange(-2.8, 2.8, np.deg2rad(0.5))
        along = target @ [1, 1j] - np.exp(1j * first)
        first, along = first[np.abs(along) <= 2], along[np.abs(along) <= 2]
        bend = np.arccos(np.clip(np.abs(along) ** 2 / 2 - 1, -1, 1))
        every = [np.stack([first, np.angle(along) - b / 2 - first, b], axis=1) for b in (bend, -bend)]
        q = np.concatenate(every)
        q[:, 1] = (q[:, 1] + np.pi) % (2 * np.pi) - np.pi
        q = q[(np.abs(q) <= 2.8).all(axis=1)]
        most = (room(centres, q) + BALL - 0.6).max(initial=-np.inf)
        blocked = BlockedBoxes(among(arm, centres, 0.6), 0.0)
        found = hf.all_configurations(arm, pose, "planar", blocked=blocked, most_boxes=60_000)
        assert not (found.proved_empty and most > 0)
        known += most < -0.02
        proved += most < -0.02 and found.proved_empty
    assert known >= 3
    assert proved >= known - 1


def test_a_joint_that_is_looked_at_in_one_place_blocks_only_where_all_its_places_do():
    arm, seen = hf.arms.load("panda"), []

    def blocked(middle, half):
        seen.append(half[:, 6])
        return np.zeros(len(middle), dtype=bool)

    pose = arm.forward_kinematics(np.array([0.3, 0.2, 0.0, -1.8, 0.0, 2.0, 0.8]))
    hf.all_configurations(arm, pose, "position", blocked=blocked, most_boxes=20_000)
    np.testing.assert_allclose(np.concatenate(seen), (arm.upper[6] - arm.lower[6]) / 2)
