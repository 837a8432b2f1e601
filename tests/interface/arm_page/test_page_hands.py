"""Further hands of the page of an arm: joints of the picture, rotations of the tool, sliders, and directions of self-motion."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast import arms

PAGE = "document.querySelector('.arm').armPage"


@pytest.fixture
def opened(browser, tmp_path):
    pages, faults = [], []

    def show(name):
        page = browser.new_page(viewport={"width": 1200, "height": 900}, reduced_motion="reduce")
        page.on("pageerror", lambda error: faults.append(f"{error} {error.stack}"))
        file = tmp_path / f"{len(pages)}.html"
        file.write_text(arms.load(name).page().to_html(), encoding="utf-8")
        page.goto(file.as_uri())
        page.wait_for_selector(".view3d-drawn")
        pages.append(page)
        return page

    yield show
    for page in pages:
        page.close()
    assert faults == []


def configuration(page) -> np.ndarray:
    return np.array(page.evaluate(f"Array.from({PAGE}.state.q)"))


def joint_pixels(page, arm) -> np.ndarray:
    """Pixels (n, 2) of the origins of the joints on the page."""
    frames = arm.frames(configuration(page))[1:-1, :3, 3].tolist()
    box = page.locator(".view3d-stage canvas").bounding_box()
    pixels = page.evaluate(f"points => points.map(point => {PAGE}.view.project(point))", frames)
    return np.array(pixels)[:, :2] + (box["x"], box["y"])


def test_a_click_on_a_joint_changes_its_condition(opened):
    arm, page = arms.load("planar-3r"), opened("planar-3r")
    x, y = joint_pixels(page, arm)[1]
    for condition in ("locked", "free", "healthy"):
        page.mouse.click(x, y)
        assert page.evaluate(f"{PAGE}.state.conditions") == ["healthy", condition, "healthy"]
    page.mouse.click(x + 200, y - 250)
    assert page.evaluate(f"{PAGE}.state.conditions") == ["healthy"] * 3


def angle_between(first, second) -> float:
    return float(np.arccos(np.clip((np.trace(first[:3, :3].T @ second[:3, :3]) - 1) / 2, -1, 1)))


def test_keys_rotate_the_tool_about_its_point(opened):
    arm, page = arms.load("panda"), opened("panda")
    page.get_by_role("button", name="Rotate the tool").click()
    handle = page.locator(".tool-handle")
    assert "rotate" in handle.get_attribute("aria-label")
    before = arm.forward_kinematics(configuration(page))
    handle.focus()
    page.keyboard.press("ArrowRight")
    after = arm.forward_kinematics(configuration(page))
    np.testing.assert_allclose(after[:3, 3], before[:3, 3], atol=1e-5)
    assert angle_between(before, after) == pytest.approx(4 * 0.02, abs=1e-5)
    page.keyboard.press("ArrowLeft")
    np.testing.assert_allclose(arm.forward_kinematics(configuration(page)), before, atol=1e-5)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_ring_rotates_the_tool_about_its_axis(opened, axis):
    arm, page = arms.load("panda"), opened("panda")
    page.get_by_role("button", name="Rotate the tool").click()
    page.wait_for_timeout(100)
    before = arm.forward_kinematics(configuration(page))
    ring = page.locator(".pose-rings path").nth(axis)
    x, y = page.evaluate(
        """path => { const point = path.getPointAtLength(0.31 * path.getTotalLength()).matrixTransform(path.getScreenCTM());
        return [point.x, point.y]; }""",
        ring.element_handle(),
    )
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 6, y + 5, steps=3)
    page.mouse.up()
    after = arm.forward_kinematics(configuration(page))
    np.testing.assert_allclose(after[:3, 3], before[:3, 3], atol=1e-5)
    np.testing.assert_allclose(after[:3, axis], before[:3, axis], atol=1e-5)
    assert angle_between(before, after) > 1e-3


def test_a_task_without_rotations_has_no_rings(opened):
    page = opened("planar-3r")  # whose task has no rotation
    assert page.get_by_role("button", name="Rotate the tool").count() == 0
    assert page.locator(".pose-rings path").count() == 0


def test_sliders_move_single_joints_and_locked_ones_are_disabled(opened):
    page = opened("panda")
    page.get_by_text("Move the joints").click()
    sliders = page.locator(".view3d-joint input")
    before = configuration(page)
    sliders.nth(2).focus()
    page.keyboard.press("ArrowRight")
    changed = configuration(page) != before
    assert changed.tolist() == [k == 2 for k in range(7)]
    page.locator(".bars button").nth(4).click()
    assert [sliders.nth(k).is_disabled() for k in range(7)] == [k == 4 for k in range(7)]
    shown = page.locator(".view3d-joint output").nth(2).inner_text()
    assert float(shown.rstrip("°")) == pytest.approx(np.degrees(configuration(page)[2]), abs=0.06)


def test_an_arm_with_more_redundancy_has_directions_of_self_motion(opened):
    arm, page = arms.load("pa10-9dof"), opened("pa10-9dof")
    page.locator('[data-step="prepare"]').click()
    menu, slider = page.get_by_role("combobox", name="Direction"), page.get_by_label("Configurations of this tool pose")
    assert menu.locator("option").count() == 1 + 3
    first, ways = configuration(page), []
    for direction in range(1, 4):
        page.evaluate(f"{PAGE}.setConfiguration({first.tolist()})")
        menu.select_option(str(direction))
        start = int(slider.input_value())
        step = 1 if start < int(slider.get_attribute("max")) else -1
        slider.evaluate(
            "(input, value) => { input.value = value; input.dispatchEvent(new Event('input')); }", str(start + step)
        )
        q = configuration(page)
        np.testing.assert_allclose(arm.forward_kinematics(q), arm.forward_kinematics(first), atol=1e-5)
        ways.append((q - first) / np.linalg.norm(q - first))
    assert np.linalg.svd(np.array(ways))[1][-1] > 0.3
    null_space = np.linalg.svd(arm.jacobian(first))[2][6:]
    np.testing.assert_allclose(np.linalg.norm(np.array(ways) @ null_space.T, axis=1), 1, atol=1e-2)


def test_the_self_motion_keeps_a_lock_where_motion_is_left(opened):
    arm, page = arms.load("pa10-9dof"), opened("pa10-9dof")
    page.locator('[data-step="prepare"]').click()
    page.locator(".bars button").nth(2).click()
    assert page.evaluate(f"{PAGE}.state.step") == "prepare"
    assert page.get_by_role("combobox", name="Direction").locator("option").count() == 1 + 2
    first = configuration(page)
    page.get_by_role("button", name="Go to the best").click()
    best = configuration(page)
    assert np.abs(best - first).max() > 1e-3
    assert best[2] == pytest.approx(first[2], abs=1e-12)
    np.testing.assert_allclose(arm.forward_kinematics(best), arm.forward_kinematics(first), atol=1e-5)
    panda = opened("panda")
    panda.locator(".bars button").nth(3).click()
    panda.locator('[data-step="prepare"]').click()  # no motion is left, so the lock goes
    assert panda.evaluate(f"{PAGE}.state.conditions") == ["healthy"] * 7


def test_names_of_joints_are_shown_on_request(opened):
    page = opened("panda")
    button = page.get_by_role("button", name="Names")
    assert button.get_attribute("aria-pressed") == "false"
    before = page.locator(".view3d-stage canvas").screenshot()
    button.click()
    page.wait_for_timeout(100)
    assert page.locator(".view3d-stage canvas").screenshot() != before
