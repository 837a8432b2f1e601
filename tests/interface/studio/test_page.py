"""The page itself, in a headless Chromium."""

from __future__ import annotations

import threading
import xml.etree.ElementTree as ET
from dataclasses import replace

import matplotlib.image
import numpy as np
from scipy.spatial.transform import Rotation
from studio_pages import send, wait_for

import holdfast as hf
from holdfast.model.arm.poses import pose_numbers

PLANAR = {"task": "planar"}


def text_of(page):
    return page.locator("[data-message]").first.inner_text()


def test_page_shows_the_worst_joint_and_asks_nobody_else(studio, visit):
    served = studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR)
    page, window = visit(served)
    page.wait_for_selector("[data-worst]")
    rho = hf.indices.relative_manipulability(window.machine.arm, "planar")
    worst = window.machine.arm.joint_names[int(rho.worst_joint(window.q))]
    assert page.locator("[data-worst]").first.get_attribute("data-worst") == worst
    shown = page.locator("[data-worst]").first.inner_text()
    for name, value in zip(window.machine.arm.joint_names, rho.by_joint(window.q), strict=True):
        assert name in shown
        assert f"{value:.3g}" in shown
    assert page.hosts == {f"127.0.0.1:{served.port}"}
    assert page.locator("canvas").count() >= 1


def test_one_click_locks_a_joint_and_the_command_line_says_so(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    page.get_by_role("tab", name="Fail").click()
    page.get_by_role("button", name="locked", exact=True).nth(1).click()
    wait_for(page, lambda: window.state.conditions[1] == "locked")
    window.wait_until_done(60)
    name = window.state.names[1]
    wait_for(page, lambda: f"{name} has failed" in page.inner_text("body"))
    assert window.panel.sliders[1].disabled
    page.get_by_role("tab", name="File").click()
    wait_for(page, lambda: f"--lock={name}" in page.inner_text("[data-command]"))
    page.get_by_role("tab", name="Fail").click()
    page.get_by_role("button", name="All healthy").click()
    wait_for(page, lambda: not window.state.failed_joints)


def test_a_joint_is_moved_by_its_slider_and_the_rest_stands(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    page.wait_for_selector("[data-worst]")  # what is typed before the first numbers are shown may be overwritten by them
    box = page.get_by_role("textbox").first
    box.fill("40")
    box.press("Enter")
    wait_for(page, lambda: abs(window.q[0] - np.radians(40)) < 1e-6)
    np.testing.assert_allclose(window.q[1:], [0.8, 0.9])


def test_the_hand_is_dragged_and_says_when_it_cannot_follow(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    pose = window.machine.tool_pose(window.machine.arm.check_configurations([0.4, 0.7, 0.9]))
    numbers = np.array(pose_numbers(pose))
    window.request_action("hand", ("update", numbers[:3], numbers[3:]))
    assert window.wait_until_done(60)
    np.testing.assert_allclose(window.machine.tool_pose(window.q)[:2, 3], pose[:2, 3], atol=1e-5)
    window.request_action("hand", ("end", numbers[:3] + np.array([50, 0, 0]), numbers[3:]))
    assert window.wait_until_done(60)
    wait_for(page, lambda: "Out of reach" in text_of(page))
    np.testing.assert_allclose(window.stage.gizmo.position, window.machine.tool_pose(window.q)[:3, 3], atol=1e-9)


def on_screen(camera, place):
    """Where a point in the world is drawn, pixels; the camera looks along its z axis, with y down."""
    w, x, y, z = camera.wxyz
    seen = Rotation.from_quat([x, y, z, w]).inv().apply(place - camera.position)
    scale = 0.5 * camera.image_height / np.tan(camera.fov / 2)
    return 0.5 * camera.image_width + scale * seen[0] / seen[2], 0.5 * camera.image_height + scale * seen[1] / seen[2]


def test_a_mouse_drags_the_hand_locks_a_joint_and_opens_a_point(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR), 900, 620)
    camera, machine = window.client.camera, window.machine
    q, hand = window.q, machine.tool_pose(window.q)

    def grabbed():
        places = [hand[:3, 3] + hand[:3, 0] * 0.17 * machine.size * share for share in (0.55, 1.6)]
        first, last = (on_screen(camera, place) for place in places)
        # The handle must have been drawn under the mouse before it can be taken; with a slow processor that takes a while.
        page.mouse.move(*first)
        page.wait_for_timeout(1200)
        page.mouse.down()
        page.wait_for_timeout(300)
        for share in np.linspace(0, 1, 8):
            page.mouse.move(*((1 - share) * np.array(first) + share * np.array(last)))
            page.wait_for_timeout(120)
        page.mouse.up()
        page.wait_for_timeout(300)
        return np.linalg.norm(window.q - q) > 0.1

    wait_for(page, grabbed)  # again, as long as the handle is not drawn yet
    wait_for(page, lambda: window.dragged is None)
    assert window.wait_until_done(60)
    np.testing.assert_allclose(window.stage.gizmo.position, machine.tool_pose(window.q)[:3, 3], atol=1e-9)

    window.request_action("home")
    assert window.wait_until_done(60)

    def pressed():
        page.mouse.click(*on_screen(camera, machine.arm.frames(window.q)[2, :3, 3]))
        page.wait_for_timeout(400)
        return window.state.conditions[1] != "healthy"

    wait_for(page, pressed)
    window.request_action("heal")
    window.request_action("region")
    assert window.wait_until_done(60)
    cloud = window.cloud
    at = np.array([on_screen(camera, place) for place in cloud.points])
    hand_at = np.array(on_screen(camera, machine.tool_pose(window.q)[:3, 3]))
    far = np.isfinite(cloud.q).all(axis=1) & (np.linalg.norm(at - hand_at, axis=1) > 70) & (at[:, 0] < 480) & (at[:, 1] > 60)
    chosen = int(np.flatnonzero(far)[0])

    def opened():
        page.mouse.click(*at[chosen])
        page.wait_for_timeout(200)
        return window.stage.chosen is not None

    wait_for(page, opened)
    assert window.wait_until_done(60)
    assert np.nanmin(np.abs(cloud.q - window.q).max(axis=1)) == 0


def test_two_windows_have_two_arms(studio, visit):
    served = studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR)
    first, one = visit(served)
    _, two = visit(served)
    one.request_action("fail", (0, "locked"))
    one.request_action("joint", (1, -0.5))
    assert one.wait_until_done()
    assert two.wait_until_done()
    assert one.state.conditions[0] == "locked"
    assert two.state.conditions[0] == "healthy"
    assert two.q[1] == 0.8
    first.context.close()
    wait_for_windows = threading.Event()
    for _ in range(500):
        if len(served.windows) == 1:
            break
        wait_for_windows.wait(0.02)
    assert list(served.windows.values()) == [two]


def test_pictures_can_be_saved(studio, visit, tmp_path):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), conditions=("healthy", "locked", "free"), **PLANAR), 700, 500)
    page.get_by_role("tab", name="File").click()
    with page.expect_download(timeout=60_000) as download:
        page.get_by_role("button", name="SVG drawing").click()
    download.value.save_as(tmp_path / "view.svg")
    drawing = (tmp_path / "view.svg").read_text()
    assert ET.fromstring(drawing).tag.endswith("svg")
    assert f"{window.state.names[1]} locked" in drawing
    with page.expect_download(timeout=60_000) as download:
        page.get_by_role("button", name="PNG of the scene").click()
    download.value.save_as(tmp_path / "view.png")
    picture = matplotlib.image.imread(tmp_path / "view.png")
    assert picture.shape[:2] == (500, 700)
    assert len(np.unique(picture.reshape(-1, picture.shape[2]), axis=0)) > 50
    assert window.stage.gizmo.visible


def test_a_motion_is_opened_scrubbed_and_played(studio, visit, tmp_path):
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    path = hf.simulate(law, [0.3, 0.8, 0.9], [1.0, 1.2]).path(samples=30, until=4.0)
    head = ",".join(["time_s", *(f"{j.name}_rad" for j in arm.joints), "tool_x_m", "tool_y_m", "tool_z_m", "error"])
    np.savetxt(
        tmp_path / "run.csv", np.column_stack([path.time, path.q, path.x, path.error]), delimiter=",", header=head, comments=""
    )
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    send(page, tmp_path / "run.csv")
    wait_for(page, lambda: window.state.show == "file" and not window.panel.time.disabled)
    window.request_action("time", 2.0)
    assert window.wait_until_done(60)
    np.testing.assert_allclose(window.q, [np.interp(2.0, path.time, path.q[:, k]) for k in range(3)], atol=1e-6)
    window.request_action("play")
    wait_for(page, lambda: window.state.time > 2.5)
    window.request_action("play")
    shown = window.q
    send(page, {"name": "bad.csv", "mimeType": "text/csv", "buffer": b"time_s,joint1_rad\n0,1\n"})
    wait_for(page, lambda: "bad.csv" in text_of(page) and "is missing" in text_of(page))
    np.testing.assert_array_equal(window.q, shown)


def test_moving_under_both_laws_before_a_drag_says_what_to_do(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    page.get_by_role("tab", name="Motion").click()
    move = page.get_by_role("button", name="Move under both laws")
    assert move.is_disabled()
    page.get_by_role("button", name="Choose a target").click()
    wait_for(page, move.is_enabled)  # the target is away from the tool, where the arm gets
    move.click()
    wait_for(page, lambda: "reaches the target" in text_of(page))
    assert len(window.player.ghosts) == 2
    # Asked for by a command line: no error either.
    at = (*pose_numbers(window.machine.tool_pose(window.q)),)
    other, second = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), target=at, show="laws", **PLANAR))
    wait_for(other, lambda: "Drag the second handle away" in text_of(other))
    assert second.wait_until_done(60)


def test_a_fall_plays_by_itself_and_who_takes_the_slider_stops_it(studio, visit):
    conditions = ("healthy", "free", *["healthy"] * 5)
    page, window = visit(studio("iiwa14", q=hf.arms.about("iiwa14").home, conditions=conditions))
    page.get_by_role("tab", name="Fail").click()
    page.get_by_role("button", name="Cut the power").click()
    wait_for(page, lambda: window.player.is_playing and window.state.time > 0.1)
    before = np.array(window.player.ghosts[0])
    wait_for(page, lambda: np.abs(window.player.ghosts[0] - before).max() > 0.01)
    assert np.argmax(np.abs(window.player.ghosts[0] - before)) == 1
    window.request_action("time", 0.35)
    assert window.wait_until_done(60)
    assert (window.player.is_playing, window.state.time) == (False, 0.35)
    assert window.panel.play.label == "Play"


def test_ghosts_do_not_outlive_what_they_are_of(studio, visit):
    _, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))

    def haunted(ask):
        window.request_action("best-worst")
        assert window.wait_until_done(60)
        assert len(window.stage.ghosts) == 2
        ask()
        assert window.wait_until_done(60)
        left = len(window.stage.ghosts)
        assert (left == 0) or window.state.show == "best-worst"
        return left

    assert haunted(lambda: window.request_action("take0")) == 2  # of the same pose
    assert haunted(lambda: window.request_action("fail", (1, "healthy"))) == 2  # as it was
    assert haunted(lambda: window.request_action("joint", (0, 0.5))) == 0
    assert haunted(lambda: window.request_action("fail", (1, "locked"))) == 0
    assert haunted(lambda: window.request_action("heal")) == 0
    pose = np.array(pose_numbers(window.machine.tool_pose(np.array([0.4, 0.7, 0.9]))))
    assert haunted(lambda: window.request_action("hand", ("update", pose[:3], pose[3:]))) == 0
    assert haunted(lambda: window.request_action("home")) == 0
    assert haunted(lambda: window.request_action("region")) == 0


def test_what_takes_long_is_shown_beside_the_arm_and_cleared(studio, visit):
    target = (*pose_numbers(hf.arms.load("planar-3r").forward_kinematics([0.3, 0.9, 0.5])),)
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), target=target, show="laws", **PLANAR))
    assert window.wait_until_done(60)
    assert len(window.stage.ghosts) == 2
    wait_for(page, lambda: "pseudoinverse: reaches the target" in text_of(page))  # settled here is not drawn there
    window.request_action("best-worst")
    assert window.wait_until_done(60)
    window.request_action("take1")
    assert window.wait_until_done(60)
    np.testing.assert_allclose(window.q, window.player.ghosts[1])
    window.request_action("clear")
    window.request_action("region")
    assert window.wait_until_done(60)
    sound = int(np.flatnonzero(np.isfinite(window.cloud.q).all(axis=1))[3])
    window.request_action("point", sound)
    assert window.wait_until_done(60)
    np.testing.assert_allclose(window.q, window.cloud.q[sound])
    window.request_action("clear")
    assert window.wait_until_done(60)
    assert window.state.show == "arm"
    assert window.stage.ghosts == []
    assert window.stage.cloud is None


def test_the_page_goes_on_while_something_long_is_under_way(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    page.wait_for_selector("[data-worst]")  # see above
    started, given_up = threading.Event(), threading.Event()

    def endless(check):
        started.set()
        try:
            while True:
                check()
                threading.Event().wait(0.002)
        finally:
            given_up.set()

    window.worker.submit(endless)
    assert started.wait(10)
    before = window.updates
    box = page.get_by_role("textbox").first
    box.fill("25")
    box.press("Enter")
    wait_for(page, lambda: window.updates > before and abs(window.q[0] - np.radians(25)) < 1e-6)
    assert not given_up.is_set()
    window.request_action("best-worst")  # newer: the older one gives way
    assert window.wait_until_done(60)
    assert given_up.is_set()
    assert len(window.stage.ghosts) == 2


def test_sliding_along_the_self_motion_leaves_the_hand(studio, visit):
    page, window = visit(studio("planar-3r", q=(0.3, 0.8, 0.9), **PLANAR))
    hand, q = window.machine.tool_pose(window.q), window.q
    window.request_action("slide", 1.0)
    wait_for(page, lambda: np.linalg.norm(window.q - q) > 0.1)
    window.request_action("slide", 0.0)
    assert window.wait_until_done(60)
    np.testing.assert_allclose(window.machine.tool_pose(window.q)[:2, 3], hand[:2, 3], atol=1e-4)
    window.request_action("fail", (0, "locked"))
    window.request_action("slide", 1.0)
    wait_for(page, lambda: "no self-motion" in text_of(page))


def test_joint_names_are_escaped(studio, visit):
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0)] * 3, name="<b>arm</b>")
    joints = list(arm.joints)
    joints[0] = replace(joints[0], name="<img src=x onerror=alert(1)>")
    page, _ = visit(studio("odd", arm=replace(arm, joints=tuple(joints)), q=(0.3, 0.8, 0.9), **PLANAR))
    page.wait_for_selector("[data-worst]")
    assert page.locator("img[src=x]").count() == 0
