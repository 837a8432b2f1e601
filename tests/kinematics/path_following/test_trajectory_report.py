"""The report of a motion: what it says, for arms in a plane and in space, with and without inertias."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.interface.presentation.arm.view import choose_views
from holdfast.interface.presentation.renderers import build_page, present
from holdfast.kinematics.indices import RelativeManipulability, susceptibility
from holdfast.kinematics.paths import TimedPath, Trapezoid, line

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check


@pytest.fixture(scope="module")
def calm(planar):
    path = TimedPath(line([1.8, -1.8, 0], [0.6, -1.8, 0]), Trapezoid(4.0))
    measure = susceptibility.torque(planar, "worst-case")
    return hf.follow(planar, path, minimise=measure, task="planar", best=True, rate_cap=3.0, samples=101)


@pytest.fixture(scope="module")
def stopped():
    arm = hf.arms.load("planar-3r")
    path = TimedPath(line([1.2, -0.1, 0], [0.3, -0.1, 0]), Trapezoid(4.0))
    return hf.follow(arm, path, minimise=susceptibility.swing_angle(arm, [0, 1, 0]), task="planar", samples=101)


def test_a_calm_motion(calm, tmp_path):
    file = replace(calm, torque_bound=5.0).report(tmp_path / "r.html", "holdfast follow x")
    html = file.read_text(encoding="utf-8").replace("\u00a0", " ")
    check(html)
    for text in (
        "The end effector stays on its path",
        "the same path without the objective",
        "best of each pose",
        "best continuous motion",
        "No events on the way: no algorithmic singularity",
        "at least",
        "holdfast follow x",
        calm.arm.fingerprint,
        "gravity alone",
    ):
        assert text in html, text
    assert "callout bad" not in html


def test_a_hand_off_its_path_is_the_first_thing_said(stopped):
    page = build_page(present(stopped))
    assert page.warnings[0].tone == "bad"
    assert "LEAVES ITS PATH" in page.warnings[0].text
    assert "The end effector leaves its path by up to" in page.headline


def test_slowness_by_joint(calm):
    found = calm.slowness(2.0)
    assert len(found) == 3
    whole = hf.path_following.slow_enough(calm.arm, calm.q, calm.qd, qdd=calm.qdd, bound=2.0)
    assert max(s.time_scale for s in found) == whole.time_scale
    gravity = calm.arm.gravity_torque(calm.q)
    for k, s in enumerate(found):
        off = np.abs(calm.torques(s.time_scale * 1.001) - gravity)[:, k]
        assert off.max() <= 2.0
        assert np.abs(calm.torques(s.time_scale * 0.99) - gravity)[:, k].max() > 2.0


def test_an_arm_in_space_without_inertia(rng, tmp_path):
    arm = replace(oracles.random_arm(rng, types="RRPR", base=False), joints=oracles.random_arm(rng, types="RRPR").joints)
    q = rng.uniform(-0.5, 0.5, 4)
    start = arm.forward_kinematics(q)
    path = TimedPath(line(start[:3, 3], start[:3, 3] + 0.02), Trapezoid(2.0))
    index = RelativeManipulability(arm, "position")
    t = hf.follow(arm, path, maximise=index, q=q, gain=1.0, samples=31)
    html = t.report(tmp_path / "r.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    check(html)
    assert "No torques:" in html
    assert 'class="view3d"' in html
    with pytest.raises(hf.ArmError):
        replace(t, torque_bound=1.0).report(tmp_path / "no.html")


def test_a_plane_is_seen_from_its_front(rng):
    arm = oracles.with_bodies(oracles.planar_arm(rng, 4), rng)
    normal = oracles.plane(arm)
    (view,) = choose_views(arm, np.zeros((1, 6, 3)))
    assert abs(view.right @ normal) < 1e-9
    assert abs(view.up @ normal) < 1e-9
    assert view.up @ -arm.gravity > 0
    np.testing.assert_allclose([view.right @ view.up, np.linalg.norm(view.right)], [0, 1], atol=1e-9)
