"""Narrow gaps: what the bound calls blocked and exact distances do not, against coal and MuJoCo in steps of 2 mrad."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.model.collision import geometry

import cells
import holdfast as hf
import oracles
from holdfast.model.cell import Sphere
from holdfast.model.collision.exact import engines
from holdfast.model.collision.exact.exact_clearance import ExactClearance, with_exact_distances
from holdfast.response.recovery import RecoveryOutcome, check_waypoints

REACH, WIDTH, BALL = 3.0, 0.05, 0.2
ENDS = np.array([[0.5, 0, 0], [-0.5, 0, 0]])


@pytest.fixture(scope="module")
def arm():
    made = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0) for _ in range(3)], name="three")
    joints = [replace(j, lower=-x, upper=x) for j, x in zip(made.joints, (3.0, 2.6, 2.8), strict=True)]
    return replace(made, joints=tuple(joints))


@pytest.fixture(scope="module")
def slim(arm):
    return hf.Clearance(arm, hf.Capsules.along_links(arm, WIDTH), itself=False)


def beyond(gap: float) -> hf.Cell:
    """A ball that the tip of the stretched arm passes with so much room, m."""
    return hf.Cell([Sphere("ball", BALL, pose=cells.placed(REACH + WIDTH + BALL + gap, 0, 0))])


def turned(arm, clearance, cell, **options):
    """Joint 1 alone moves: the stretched arm past the ball."""
    locked = {"joint2": 0.0, "joint3": 0.0}
    return hf.recover(arm, locked, ENDS[0], goal=ENDS[1], clearance=clearance, cell=cell, samples=0, tries=0, **options)


@pytest.fixture(params=["coal", "fcl"])
def library(request, monkeypatch):
    """The only one that is installed."""
    pytest.importorskip(request.param)
    monkeypatch.setattr(engines, "find_spec", lambda name: name == request.param or None)
    return request.param


def test_a_narrow_gap_is_passed_by_exact_distances_and_said_so(arm, slim, library, tmp_path):
    cell = beyond(0.0025)
    straight = cells.finely(ENDS)
    assert not cells.touches(arm, slim.capsules, cell, straight).any()
    assert slim.with_cell(cell).margin_left(straight).min() < 0
    found = turned(arm, slim, cell)
    assert found.ending == RecoveryOutcome.GOAL_REACHED
    assert isinstance(found.clearance, ExactClearance)
    np.testing.assert_allclose(found.q[[0, -1]], ENDS, atol=1e-9)
    assert not cells.touches(arm, slim.capsules, cell, cells.finely(found.q)).any()
    by = {"coal": "coal", "fcl": "python-fcl"}[library]
    assert any(f"Exact distances ({by}" in line for line in found.describe())
    check = found.check()
    assert check.ok
    assert -1e-9 <= check.least_room <= 0.0025 + 1e-9
    assert found.to_dict()["clearance"]["cell"]["distances"] == "exact"
    assert f"exact ({by}" in " ".join(found.report(tmp_path / "page.html").read_text().split())
    # Who replays the file has only the cell.
    assert check_waypoints(arm, found.q, clearance=slim, cell=cell).ok


def test_what_the_bound_finds_is_by_the_bound(arm, slim):
    found = turned(arm, slim, beyond(0.05))
    assert found.ending == RecoveryOutcome.GOAL_REACHED
    assert not isinstance(found.clearance, ExactClearance)
    assert found.to_dict()["clearance"]["cell"]["distances"] == "bound"


@pytest.mark.parametrize(("gap", "options"), [(-0.001, {}), (0.004, {"margin": 0.005})])
def test_a_gap_that_is_closed_or_too_narrow_for_the_margin_stays_so(arm, slim, library, gap, options):
    found = turned(arm, slim, beyond(gap), **options)
    assert found.ending == RecoveryOutcome.NO_ROUTE_FOUND
    assert not len(found.q)
    assert ") find no more" in found.reason
    assert not check_waypoints(arm, ENDS, clearance=slim, cell=beyond(gap), **options).ok


def test_without_a_library_the_bound_decides(arm, slim, monkeypatch):
    monkeypatch.setattr(engines, "find_spec", lambda name: None)
    found = turned(arm, slim, beyond(0.0025))
    assert found.ending == RecoveryOutcome.NO_ROUTE_FOUND
    assert "exact" not in found.reason


def test_a_panda_leaves_and_reaches_what_the_bound_calls_too_close(rng):
    arm, cell = hf.arms.load("panda"), geometry.of_primitives()
    clearance, mujoco = hf.Clearance(arm, cell=cell), geometry.InMujoco(cell)
    q = oracles.inside(arm, rng, 3000)
    q = q[clearance.margin_left(q) < 0]
    q = q[clearance.exact(q) > 0.01][0]
    sharp = with_exact_distances(clearance)
    near = q + rng.uniform(-0.1, 0.1, (40, 7)) * (np.arange(7) != 3)
    other = near[sharp.margin_left(near) > 0.005][0]
    found = hf.recover(arm, ["panda_joint4"], q, goal=other, cell=cell, samples=0, tries=1)
    assert found.ending == RecoveryOutcome.GOAL_REACHED, found.describe()
    way = cells.finely(found.q)
    assert not mujoco.touches(way).any()
    assert sharp.margin_left(way).min() >= 0 > clearance.margin_left(way).min()


def test_every_pair_is_bounded_by_the_exact_distance_of_what_is_nearest(rng):
    arm, cell = hf.arms.load("panda"), geometry.of_primitives()
    clearance = hf.Clearance(arm, cell=cell)
    sharp = with_exact_distances(clearance)
    q = oracles.inside(arm, rng, 400)
    exact, bound = clearance.exact(q), clearance(q)
    near = bound < 0.02
    assert near.sum() > 50
    np.testing.assert_allclose(sharp(q)[near & (exact > 0)], exact[near & (exact > 0)], atol=2e-6)
    np.testing.assert_array_equal(sharp(q)[~near], bound[~near])
    assert (sharp.by_pair(q) >= clearance.by_pair(q)).all()
    np.testing.assert_array_equal(sharp.by_pair(q).min(axis=1), sharp(q))
    assert sharp(q[0]) == sharp(q[:1])[0]
    assert with_exact_distances(sharp) is None
    assert with_exact_distances(hf.Clearance(arm, hf.Capsules.along_links(arm))) is None, (
        "capsules that are the shape are exact"
    )
    assert isinstance(with_exact_distances(hf.Clearance(arm)), ExactClearance)
    assert isinstance(sharp.with_cell(cells.bench()), ExactClearance)
    assert sharp.with_cell(None).cell is None
