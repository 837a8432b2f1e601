"""Paths followed clear of a cell: coal and finely sampled motions as judges, and MuJoCo's distance where spheres are exact."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import cells
import holdfast as hf
from holdfast.kinematics.path_following import tracking
from holdfast.kinematics.path_following.integration import _step_kernel, enforce_limits
from holdfast.model.cell import Box, Cell, Sphere
from holdfast.model.collision import Capsules, Clearance, LinkCapsule

MARGIN = 0.01  # m
# Few capsules, and the same for every test of an arm: what they compile takes the time here.
ENDS = Capsules(
    tuple(LinkCapsule(link, (1, 0, 0), (1, 0, 0), radius=0.05) for link in (1, 2))
)  # of the planar arm's outer links
START = np.array([-0.6, -0.5, 0, -2.2, 0, 1.7, 0.8])


@pytest.fixture(scope="module", autouse=True)
def fewer_steps():
    """A quarter of them: what is kept does not depend on it, to the digits below."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tracking, "_MIN_CONTROL_STEPS", 5000)
        yield


@pytest.fixture(scope="module")
def panda() -> hf.Arm:
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def path(panda):
    at = panda.forward_kinematics(START)[:3, 3]
    line = hf.paths.line(at, at * [1, -1, 1])
    return hf.paths.TimedPath(line, hf.paths.Trapezoid(5.0))


@pytest.fixture(scope="module")
def wish(panda):
    """Least-norm rates from a configuration of the first pose: all self-motion there is comes of the cell."""
    return {
        "minimise": hf.susceptibility.acceleration(panda, np.eye(7)[3]),
        "method": "none",
        "task": "position",
        "samples": 101,
        "q": START,
    }


@pytest.fixture(scope="module")
def plain(panda, path, wish):
    return hf.follow(panda, path, **wish)


@pytest.fixture(scope="module")
def forearm(panda):
    along = Capsules.along_links(panda, 0.06)
    return Clearance(panda, Capsules(tuple(part for part in along if part.link in (3, 4))), itself=False)


@pytest.fixture(scope="module")
def clearance(panda, plain, forearm):
    """A ball that the forearm of the plain motion goes through."""
    elbow, wrist = panda.frames(plain.q[60])[[4, 6], :3, 3]
    at = 0.3 * elbow + 0.7 * wrist + [0, 0.05, 0.12]
    cell = Cell([Sphere("ball", 0.08, pose=cells.placed(*at))], margin=MARGIN)
    return forearm.with_cell(cell)


@pytest.fixture(scope="module")
def motion(panda, path, wish, clearance):
    return hf.follow(panda, path, clearance=clearance, **wish)


def test_the_self_motion_keeps_clear_of_a_ball_that_it_would_hit(panda, plain, motion, clearance):
    fine = cells.finely(motion.q)
    assert clearance.margin_left(cells.finely(plain.q)).min() < -0.02
    assert clearance.margin_left(fine).min() > -1e-4
    assert motion.on_path
    assert (motion.task_share > 0.99).all()
    # coal, with the capsules themselves.
    assert cells.touches(panda, clearance.capsules, clearance.cell, plain.q).any()
    assert not cells.touches(panda, clearance.capsules, clearance.cell, fine[::4]).any()
    # Until it comes near it is the motion without the ball.
    early = plain.time < 0.5
    np.testing.assert_allclose(motion.q[early], plain.q[early], atol=1e-9)


def test_the_motion_says_what_it_kept_clear_of(motion, clearance, tmp_path):
    kept = [e for e in motion.events if e.kind == "kept clear"]
    assert kept
    assert any("at the required distance of 10 mm from ball" in e.text for e in kept)
    np.testing.assert_allclose(motion.clearance, clearance(motion.q))
    data = motion.to_dict()
    assert data["least_clearance"]["m"] == pytest.approx(motion.clearance.min())
    assert data["least_clearance"]["pair"].endswith("& ball")
    assert data["clearance"]["cell"]["objects"] == ["ball"]
    with motion.to_csv(tmp_path / "motion.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["clearance_m"]) for row in rows] == motion.clearance.tolist()
    assert any(line.startswith("Smallest clearance 10") for line in motion.describe())


def test_a_cell_out_of_reach_changes_no_motion(panda, path, wish, plain, forearm):
    far = Cell([Box("far", [1, 1, 1], pose=cells.placed(5, 0, 0))])
    told = hf.follow(panda, path, clearance=forearm, cell=far, **wish)
    np.testing.assert_allclose(told.q, plain.q, atol=1e-9)
    assert [e.kind for e in told.events] == [e.kind for e in plain.events]
    assert told.clearance.min() > 2


def test_where_the_self_motion_has_no_way_out_the_end_effector_stops_before_the_object():
    """The tip of a planar arm is led into a wall: position and orientation of the tip are prescribed but for its turn."""
    arm = hf.arms.load("planar-3r")
    wall = Cell([Box("wall", [1, 6, 1], pose=cells.placed(2.3, 0, 0))], margin=0.02)  # its face is at 1.8 m
    line = hf.paths.TimedPath(hf.paths.line([1.2, 0.3, 0], [2.2, 0.3, 0]), hf.paths.Trapezoid(4.0))
    wish = {"minimise": hf.susceptibility.torque(arm, "worst-case"), "task": "planar", "samples": 101}
    motion = hf.follow(arm, line, clearance=Clearance(arm, ENDS, wall, itself=False), margin=0.01, **wish)
    x = arm.forward_kinematics(motion.q)[:, 0, 3]
    assert x.max() == pytest.approx(1.8 - 0.05 - 0.02 - 0.01, abs=1e-3)
    assert x.max() <= 1.72 + 1e-6
    assert not motion.on_path
    slowed = next(e for e in motion.events if e.kind == "end effector slowed")
    assert "wall leaves joint3 no motion that keeps up" in slowed.text
    # On the line the tip is 0.3 m above the axis: it stops when the path passes there, however late.
    assert slowed.start == pytest.approx(np.interp(1.72, line.pose(motion.time)[:, 0, 3], motion.time), abs=0.15)


def test_the_best_motion_drops_configurations_that_are_not_clear():
    arm = hf.arms.load("planar-3r")
    line = hf.paths.TimedPath(hf.paths.line([1.4, 0.2, 0], [1.4, 0.8, 0]), hf.paths.Trapezoid(4.0))
    wish = {
        "minimise": hf.susceptibility.torque(arm, "worst-case"),
        "task": "planar",
        "samples": 31,
        "best": True,
        "spacing": 0.1,
    }
    free = hf.follow(arm, line, **wish)
    at = arm.frames(free.best_path[15])[3, :3, 3]
    cell = Cell([Sphere("ball", 0.1, pose=cells.placed(*at))], margin=MARGIN)
    clearance = Clearance(arm, ENDS, cell, itself=False)
    told = hf.follow(arm, line, clearance=clearance, **wish)
    assert clearance.margin_left(free.best_path).min() < 0
    found = np.isfinite(told.best_path).all(axis=1)
    assert found.any()
    assert clearance.margin_left(told.best_path[found]).min() >= -1e-12  # every sample is a pose of the grid
    assert (told.best_value >= free.best_value - 1e-9).all()


def test_starts_and_margins_that_keep_nothing_are_refused(panda, path, wish, plain, forearm):
    inside = Cell([Sphere("ball", 0.1, pose=cells.placed(*panda.frames(plain.q[0])[4, :3, 3]))])
    with pytest.raises(hf.InputError, match=r"at the start q the arm .*panda_joint\d & ball"):
        hf.follow(panda, path, clearance=forearm, cell=inside, **wish)
    with pytest.raises(hf.InputError, match="margin has no effect"):
        hf.follow(panda, path, margin=0.1, **wish)


def test_two_rows_are_enough_where_a_third_thing_is_in_the_way(rng):
    """Self-motion of one dimension between random limits: that of a search over all of them, if any keeps them all."""
    arm, step = hf.arms.load("planar-3r"), 1e-3
    objective = hf.susceptibility.torque(arm, "worst-case")
    law = hf.path_following.GradientProjection(arm, objective, 3.0, task="planar", period=None)
    kernel = _step_kernel(law, step, False, 1.0, True)
    columns, out = np.zeros((3 + 19 + 8, kernel.lanes)), np.zeros((9, kernel.lanes))
    once, third = kernel.bind_arrays(columns, out), 0
    for _ in range(300):
        q = rng.uniform(-2, 2, 3)
        columns[:3] = q[:, None]
        pose = arm.forward_kinematics(q)
        columns[3:15] = np.concatenate([pose[:3, 3] + [1e-3, 0, 0], pose[:3, :3].ravel()])[:, None]
        columns[22:] = 0
        once()
        free = out[3:6, 0].copy()  # rates of the task and the self-motion wanted
        null = np.linalg.svd(arm.jacobian(q)[:2])[2][2]
        slopes = rng.normal(size=(5, 3))
        limits = np.column_stack([slopes, slopes @ (free + rng.normal() * null) - rng.exponential(0.3, 5)])
        a, b = slopes @ null, limits[:, 3] - slopes @ free
        low, high = (b / a)[a > 0].max(initial=-np.inf), (b / a)[a < 0].min(initial=np.inf)
        enforce_limits(once, columns, out, limits)
        two = np.array([(b / a)[:2][a[:2] > 0].max(initial=-np.inf), (b / a)[:2][a[:2] < 0].min(initial=np.inf)])
        if low > high or two[0] > two[1] or np.abs(a).min() < 0.1:
            continue
        third += not low <= np.clip(0, *two) <= high
        np.testing.assert_allclose(out[3:6, 0], free + np.clip(0, low, high) * null, atol=1e-6)
    assert third > 20
