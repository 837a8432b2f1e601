"""Objects around the arm: where it comes nearest is said and shown, and an object can be dragged until the arm is blocked."""

from __future__ import annotations

import numpy as np
import pytest
from studio_pages import wait_for

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


@pytest.fixture
def cell_studio():
    arm = arms.load("panda")
    q = tuple(float(x) for x in arms.about("panda").home)
    page = serve(arm, State("panda", arm.joint_names, q), port=0, cell=CELL)
    yield page
    page.stop()


def test_a_ball_is_dragged_until_the_arm_is_blocked_and_the_cell_is_saved(cell_studio, visit, tmp_path):
    page, window = visit(cell_studio)
    clear = hf.Clearance.by_default(window.machine.arm, CELL)
    gap = clear.obstacles.find_nearest_gap(window.q)
    wait_for(
        page,
        lambda: (
            f"Closest (red line): {clear.obstacles.names[gap.pair]}, at least {gap.distance:.3g} m" in page.inner_text("body")
        ),
    )
    window.request_action("pick", "ball")
    hand = window.machine.tool_pose(window.q)
    window.request_action("object", ("ball", pose_numbers(hand)))
    assert window.wait_until_done(60)
    wait_for(page, lambda: "In collision: " in page.inner_text("body") and "ball" in page.inner_text("body"))
    assert tuple(window.objects._handles["ball"].color) == (190, 30, 45)
    assert window.state.moved == (("ball", pose_numbers(hand)),)
    assert "--move=ball=" in window.state.to_command()
    page.get_by_role("tab", name="File").click()
    with page.expect_download() as download:
        page.get_by_role("button", name="Save the cell").click()
    assert download.value.suggested_filename == "bench-2.yaml"
    download.value.save_as(tmp_path / "bench-2.yaml")
    back = hf.Cell.load(tmp_path / "bench-2.yaml")
    assert back.digest == CELL.with_poses({"ball": hand}).digest != CELL.digest
    wait_for(page, lambda: "To open it, run in its folder: holdfast studio panda" in page.inner_text("body"))
    assert "--cell=bench-2.yaml" in page.inner_text("body")


def test_an_object_on_the_base_is_said_and_loses_nothing(cell_studio, visit):
    page, window = visit(cell_studio)
    window.request_action("object", ("ball", pose_numbers(at(0, 0, 0.05))))
    assert window.wait_until_done(60)
    wait_for(page, lambda: "may_touch" in page.inner_text("body"))
    window.request_action("object", ("ball", pose_numbers(at(0.1, 0.6, 0.9))))
    assert window.wait_until_done(60)
    wait_for(page, lambda: "Closest (red line): " in page.inner_text("body"))


def test_where_it_is_nearest_is_on_both_surfaces(rng):
    arm = arms.load("panda")
    clear = hf.Clearance.by_default(arm, CELL)
    for q in rng.uniform(arm.lower, arm.upper, (20, arm.n)):
        gap = clear.obstacles.find_nearest_gap(q)
        solid = CELL.objects[clear.obstacles.pairs[gap.pair][1]]
        assert abs(solid.signed_distance(gap.on_object)) < 1e-5
        if gap.distance > 0:
            np.testing.assert_allclose(np.linalg.norm(gap.on_arm - gap.on_object), gap.distance, atol=1e-5)
