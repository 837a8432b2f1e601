"""Objects around the arm: where the arm is nearest to one, and how they are moved and saved."""

from __future__ import annotations

import numpy as np
import pytest
from studio_requests import Page

import holdfast as hf
from holdfast import arms
from holdfast.interface.studio import State, serve
from holdfast.model.arm.poses import pose_numbers


def at(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


CELL = hf.Cell(
    [
        hf.cell.Box("table", [0.8, 1.2, 0.04], pose=at(0.6, 0, -0.02)),
        hf.cell.Sphere("ball", 0.12, pose=at(0.1, 0.6, 0.9)),
        hf.cell.Cylinder("post", 0.05, 1.0, pose=at(0.1, -0.6, 0.5)),
    ],
    name="bench / 2",
)


@pytest.fixture(scope="module")
def page():
    arm = arms.load("panda")
    q = tuple(float(x) for x in arms.about("panda").home)
    with serve(arm, State("panda", arm.joint_names, q), port=0, cell=CELL) as studio:
        yield Page(studio.url)


def test_the_page_has_the_objects_of_the_cell(page):
    objects = page.data["studio"]["objects"]
    assert [each["name"] for each in objects] == [solid.name for solid in CELL]
    for each, solid in zip(objects, CELL, strict=True):
        np.testing.assert_array_equal(np.reshape(each["pose"], (3, 4)), solid.pose[:3])


def test_a_ball_is_moved_until_the_arm_is_blocked_and_the_cell_is_saved(page, tmp_path):
    arm, q = arms.load("panda"), np.array(page.state["q"])
    clear = hf.Clearance.by_default(arm, CELL)
    gap = clear.obstacles.find_nearest_gap(q)
    reading = page.ask("reading")
    assert reading["clearance"] == f"Closest: {clear.obstacles.names[gap.pair]}, at least {gap.distance:.3g} m."
    np.testing.assert_allclose(reading["nearest"]["arm"], gap.on_arm)
    np.testing.assert_allclose(reading["nearest"]["object"], gap.on_object)
    assert not reading["nearest"]["blocked"]
    hand = arm.forward_kinematics(q)
    moved = [["ball", list(pose_numbers(hand))]]
    reading = page.ask("reading", moved=moved)
    assert reading["clearance"].startswith("In collision: ")
    assert (reading["nearest"]["name"], reading["nearest"]["blocked"]) == ("ball", True)
    assert "--move=ball=" in reading["command"]
    saved = page.ask("cell-file", moved=moved)
    assert saved["name"] == "bench-2.yaml"
    (tmp_path / saved["name"]).write_text(saved["text"])
    back = hf.Cell.load(tmp_path / saved["name"])
    assert back.digest == CELL.with_poses({"ball": hand}).digest != CELL.digest
    assert "--cell=bench-2.yaml" in saved["command"]
    assert "--move" not in saved["command"]


def test_the_best_configuration_does_not_touch_a_moved_object(page):
    arm, clear = arms.load("panda"), hf.Clearance.by_default(arms.load("panda"), CELL)
    first = page.ask("best-worst")["q"][0]
    elbow = at(*arm.frames(np.array(first))[4, :3, 3])
    blocked = clear.with_cell(CELL.with_poses({"ball": elbow}))
    assert blocked.obstacles.find_nearest_gap(np.array(first)).distance < 0
    found = page.ask("best-worst", moved=[["ball", list(pose_numbers(elbow))]])
    assert blocked.obstacles.find_nearest_gap(np.array(found["q"][0])).distance > 0
    assert np.abs(np.subtract(found["q"][0], first)).max() > 0.01


def test_an_object_on_the_base_is_said_and_loses_nothing(page):
    reading = page.ask("reading", moved=[["ball", list(pose_numbers(at(0, 0, 0.05)))]])
    assert "may_touch" in reading["clearance"]
    assert reading["nearest"] is None
    assert len(reading["index"]["values"]) == 7
    assert page.ask("reading")["clearance"].startswith("Closest: ")


def test_an_object_that_is_not_there_is_named(page):
    assert "lamp" in page.ask("reading", moved=[["lamp", [0, 0, 0, 0, 0, 0, 1]]])["clearance"]
    assert "lamp" in page.ask("cell-file", moved=[["lamp", [0, 0, 0, 0, 0, 0, 1]]])


def test_where_it_is_nearest_is_on_both_surfaces(rng):
    arm = arms.load("panda")
    clear = hf.Clearance.by_default(arm, CELL)
    for q in rng.uniform(arm.lower, arm.upper, (20, arm.n)):
        gap = clear.obstacles.find_nearest_gap(q)
        solid = CELL.objects[clear.obstacles.pairs[gap.pair][1]]
        assert abs(solid.signed_distance(gap.on_object)) < 1e-5
        if gap.distance > 0:
            np.testing.assert_allclose(np.linalg.norm(gap.on_arm - gap.on_object), gap.distance, atol=1e-5)
