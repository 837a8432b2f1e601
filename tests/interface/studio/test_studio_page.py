"""The page of the studio in Chromium: its further steps, indices, objects, files, and keys, against what Python computes."""

from __future__ import annotations

import re

import numpy as np
import pytest

import axe
import holdfast as hf
from holdfast import arms
from holdfast.interface.studio import State, serve
from holdfast.model.arm.poses import pose_from_quaternion

PAGE = "document.querySelector('.arm').armPage"
PLANAR = {"q": [0.3, 0.8, -0.5], "task": "planar"}
STEPS = ("lock", "choose", "laws", "region", "watch", "file")  # the page without a server is tested elsewhere


@pytest.fixture
def visit(browser):
    """``visit(studio)``: its page, whose errors fail the test."""
    contexts, faults = [], []

    def show(studio, path="/", width=1200, **options):
        context = browser.new_context(viewport={"width": width, "height": 900}, **{"reduced_motion": "reduce"} | options)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: faults.append(f"{error} {error.stack}"))
        page.goto(studio.url + path)
        page.wait_for_selector(".view3d-drawn")
        return page

    yield show
    for context in contexts:
        context.close()
    assert faults == []


def enter(page, step):
    page.locator(f'.arm-steps [data-step="{step}"]').click()


def click(page, name):
    page.get_by_role("button", name=name).click()


def finish(page):
    """Wait until the server has answered, and nothing has changed for a while."""
    page.locator("progress").wait_for(state="hidden", timeout=120_000)
    page.wait_for_timeout(700)


def headline(page) -> str:
    return page.locator(".arm-headline").inner_text()


def configuration(page) -> np.ndarray:
    return np.array(page.evaluate(f"Array.from({PAGE}.state.q)"))


def ghosts(page) -> np.ndarray:
    return np.array(page.evaluate(f"{PAGE}.step.ghosts.map(q => Array.from(q))"))


def select(page, label, option):
    page.get_by_role("combobox", name=label, exact=True).select_option(option)


# ---- numbers -------------------------------------------------------------------------------------------------------------


def test_bars_show_any_index_as_python_computes_it(studio, visit):
    arm = arms.load("planar-3r")
    page = visit(studio("planar-3r", **PLANAR))
    for label in ("minimum-singular-value", "relative-manipulability"):
        select(page.locator(".arm-panel > .studio-menu"), "Bars show", label)
        finish(page)
        values = hf.indices.by_name(label, arm, "planar").evaluate(configuration(page)).by_failure
        shown = [float(re.sub(r"[^\d.e-]", "", text)) for text in page.locator(".bar-value").all_inner_texts()]
        scale, tolerance = (100, 0.5) if label == "relative-manipulability" else (1, 5e-3)
        np.testing.assert_allclose(shown, scale * values, rtol=tolerance if scale == 1 else 0, atol=0.51 if scale == 100 else 0)
        worst = [text == "worst" for text in page.locator(".bar-condition").all_inner_texts()]
        assert worst.index(True) == int(np.argmin(values))
        assert "joint locks" in page.locator(".bars-note").first.inner_text()


def test_the_best_and_the_worst_configuration_have_the_same_tool_pose(studio, visit):
    arm = arms.load("planar-3r")
    page = visit(studio("planar-3r", **PLANAR))
    enter(page, "choose")
    assert page.get_by_role("button", name="Take the green one").is_disabled()
    click(page, "Best and worst")
    finish(page)
    found, now = ghosts(page), configuration(page)
    index = hf.indices.relative_manipulability(arm, "planar")
    positions = arm.forward_kinematics(np.array([*found, now]))[:, :2, 3]
    np.testing.assert_allclose(positions[:2], positions[[2, 2]], atol=1e-6)
    best, worst, value = (float(index(q)) for q in (*found, now))
    assert best >= value >= worst
    numbers = [float(text) for text in re.findall(r"[\d.]+(?:e-\d+)?(?=[,;])", headline(page))]
    np.testing.assert_allclose(numbers, [best, worst], rtol=5e-3, atol=1e-9)
    assert "--show=best-worst" in page.locator(".command-studio").text_content()
    click(page, "Take the green one")
    np.testing.assert_allclose(configuration(page), found[0])
    assert ghosts(page).size == 0


def test_two_laws_move_to_a_target_that_is_dragged(studio, visit):
    arm = arms.load("planar-3r")
    page = visit(studio("planar-3r", **PLANAR, conditions=("healthy", "locked", "healthy"), show="laws"))
    assert page.evaluate(f"{PAGE}.state.step") == "laws"  # the command line asks for this step, which begins at once
    finish(page)
    for _ in range(100):  # a busy machine shows the arms of both laws later
        if ghosts(page).shape == (2, 3):
            break
        page.wait_for_timeout(100)
    assert ghosts(page).shape == (2, 3)
    page.locator(".target-handle").focus()
    for _ in range(3):
        page.keyboard.press("ArrowLeft")
    assert ghosts(page).size == 2 * 3  # the target has moved, not the arm
    click(page, "Move under both laws")
    finish(page)
    target = pose_from_quaternion(*np.split(np.array(page.evaluate(f"{PAGE}.studio.target")), [3]))
    ends = ghosts(page)
    np.testing.assert_allclose(ends[:, 1], configuration(page)[1])
    for q, text in zip(ends, page.locator(".law-key").all_inner_texts(), strict=True):
        law = hf.laws.by_name(text.partition(":")[0], arm, task="planar")
        run = hf.simulate(law, configuration(page), target[:2, 3], locked=[1])
        np.testing.assert_allclose(q, run.path(samples=240, until=min(float(run.time), 15 / law.gain)).q[-1], atol=1e-6)
        assert run.ending_sentence() in text
    assert page.locator(".view3d-overlay .overlay-trail").count() == 2
    slider = page.get_by_label("Time of the motion")
    slider.focus()
    page.keyboard.press("Home")
    np.testing.assert_allclose(ghosts(page), [configuration(page)] * 2)


def test_a_region_has_points_that_are_selected(studio, visit):
    arm = arms.load("planar-3r")
    page = visit(studio("planar-3r", **PLANAR))
    enter(page, "region")
    click(page, "Assess around the tool")
    finish(page)
    points = np.array(page.evaluate(f"{PAGE}.view.scene.points"))
    assert points.shape == (1200, 3)
    cloud = page.evaluate(f"{PAGE}.step.cloud.q")
    number = next(k for k, q in enumerate(cloud) if q is not None)
    box = page.locator("canvas").bounding_box()
    x, y, _ = page.evaluate(f"{PAGE}.view.project({points[number].tolist()})")
    page.mouse.click(box["x"] + x, box["y"] + y)
    chosen = page.evaluate(f"{PAGE}.step.chosen")
    np.testing.assert_allclose(arm.forward_kinematics(configuration(page))[:2, 3], points[chosen, :2], atol=1e-4)
    page.get_by_label("Point").focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate(f"{PAGE}.step.chosen") == chosen + 1
    unreached = next((k for k, q in enumerate(cloud) if q is None), None)
    if unreached is not None:
        page.evaluate(f"{PAGE}.view.choose({unreached})")
        assert headline(page) == "No configuration was found for this pose."
    enter(page, "healthy")
    assert page.evaluate(f"{PAGE}.view.scene.points.length") == 0


def test_a_monitor_detects_a_fault_of_the_chosen_joint(studio, visit):
    page = visit(studio("panda"))
    enter(page, "watch")
    select(page, "Joint", "panda_joint2")
    select(page, "Fault", "limp")
    click(page, "Move, fail and watch")
    finish(page)
    watch = page.evaluate(f"{PAGE}.step.watch")
    assert headline(page) == f"Alarm {round(1000 * (watch['alarm'] - watch['onset']))} ms after the fault."
    assert page.locator(".signal").count() == len(watch["signals"])
    assert page.locator(".signal-named").count() >= 1
    isolated = watch["isolated"]["joint"]
    polyline = page.locator(".signal").first.locator("polyline")
    assert polyline.count() == 7
    assert isolated == 1
    slider = page.get_by_label("Time of the motion")
    slider.focus()
    page.keyboard.press("Home")
    assert headline(page) == "No alarm so far."
    assert page.locator(".signal-alarm").count() == 0
    assert not page.locator(".studio-list li", has_text="isolates").count()
    assert page.evaluate(f"{PAGE}.studio.fault")[:2] == ["limp", "panda_joint2"]


def test_power_loss_uses_dry_friction(studio, visit):
    page = visit(studio("panda"))
    enter(page, "power")
    page.get_by_label("Dry friction, N m").fill("500")
    page.keyboard.press("Tab")
    finish(page)
    assert "holds" in page.locator(".step-controls").inner_text()
    click(page, "Cut the power")
    finish(page)
    np.testing.assert_allclose(ghosts(page)[0], configuration(page), atol=1e-3)
    page.get_by_label("Dry friction, N m").fill("0")
    page.keyboard.press("Tab")
    click(page, "Cut the power")
    finish(page)
    assert np.abs(ghosts(page)[0] - configuration(page)).max() > 0.3
    page.get_by_label("Dry friction, N m").fill("3")
    page.keyboard.press("Tab")
    click(page, "Stow")
    finish(page)
    assert "The arm holds: " in page.locator(".step-controls").inner_text()
    page.wait_for_function(f"Math.max(...{PAGE}.step.ghosts[0].map((q, k) => Math.abs(q - {PAGE}.state.q[k]))) > 0.1")


# ---- objects -------------------------------------------------------------------------------------------------------------


def test_an_object_is_moved_by_keys_until_the_arm_touches_it(visit):
    arm, pose = arms.load("planar-3r"), np.eye(4)
    pose[:3, 3] = 0.9, 1.6, 0.0
    cell = hf.cell.Cell([hf.cell.Sphere("ball", 0.1, pose=pose)], name="bench")
    with serve(arm, State("planar-3r", arm.joint_names, (0.3, 0.4, 0.2), task="planar"), port=0, cell=cell) as page_server:
        page = visit(page_server)
        finish(page)
        clearance = page.locator(".studio-clearance")
        page.locator(".studio-clearance", has_text="ball").wait_for()
        assert page.locator(".overlay-nearest").count() == 1
        select(page, "Move an object", "ball")
        handle = page.locator(".object-handle")
        handle.focus()
        before = np.array(page.evaluate(f"{PAGE}.view.project({pose[:3, 3].tolist()})"))
        page.keyboard.press("ArrowDown")
        page.wait_for_timeout(300)
        moved = page.evaluate(f"{PAGE}.studio.moved")
        assert moved[0][0] == "ball"
        after = np.array(page.evaluate(f"{PAGE}.view.project({moved[0][1][:3]})"))
        assert after[1] > before[1] + 1
        assert abs(after[0] - before[0]) < 1
        elbow = arm.frames(configuration(page))[2, :3, 3].tolist()
        page.evaluate(f"{PAGE}.moveObject([1,0,0,{elbow[0]},0,1,0,{elbow[1]},0,0,1,{elbow[2]}])")
        finish(page)
        assert "studio-error" in clearance.get_attribute("class")
        assert page.locator(".overlay-nearest").count() == 0
        assert "--move=ball=" in page.locator(".command-studio").text_content()
        enter(page, "file")
        with page.expect_download() as download:
            click(page, "Save the cell")
        assert download.value.suggested_filename == "bench.yaml"
        finish(page)
        assert "--cell=bench.yaml" in page.locator(".studio-status").inner_text()


# ---- files ---------------------------------------------------------------------------------------------------------------

CRANE = """<robot name="crane"><link name="base"/><link name="a"/><link name="b"/>
<joint name="slew" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
<joint name="luff" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""


def test_an_arm_and_a_motion_are_opened(studio, visit, tmp_path):
    server = studio("planar-3r", **PLANAR)
    page = visit(server)
    enter(page, "file")
    motion = b"time_s,joint1_rad,joint2_rad,joint3_rad\n0,0,0,0\n2,1,0.5,0.25"
    page.get_by_label("Open a file").set_input_files({"name": "m.csv", "mimeType": "text/csv", "buffer": motion})
    finish(page)
    np.testing.assert_allclose(ghosts(page), [[1, 0.5, 0.25]])
    assert "m.csv: 2 rows" in page.locator(".law-key").inner_text()
    for name, content, sentence in (
        ("<img src=x>.txt", b"1", "cannot be opened here"),
        ("bad.csv", b"time_s\n1", "bad.csv"),
        ("large.urdf", b"x" * ((4 << 20) + 1), "too large"),
    ):
        page.get_by_label("Open a file").set_input_files({"name": name, "mimeType": "text/plain", "buffer": content})
        finish(page)
        assert sentence in page.locator(".studio-status").inner_text()
        assert "studio-error" in page.locator(".studio-status").get_attribute("class")
    assert page.locator("img").count() == 0
    page.evaluate(
        """text => { const files = new DataTransfer(); files.items.add(new File([text], 'crane.urdf'));
        document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: files, bubbles: true, cancelable: true})); }""",
        CRANE,
    )
    page.wait_for_url(re.compile(r"/arm/1/"))
    assert page.locator(".bar-name").all_inner_texts() == ["slew", "luff"]
    finish(page)
    assert "crane.urdf" in page.locator(".command-studio").text_content()


def test_the_view_is_saved_as_a_picture_and_as_a_drawing(studio, visit):
    page = visit(studio("planar-3r", **PLANAR))
    enter(page, "file")
    for button, begin in (("PNG", b"\x89PNG"), ("SVG drawing", b"<svg")):
        with page.expect_download() as download:
            click(page, button)
        content = download.value.path().read_bytes()
        assert content.startswith(begin)
        assert len(content) > 2000


# ---- state, keys, and several windows ------------------------------------------------------------------------------------


def test_the_command_restores_the_view(studio, visit):
    names = arms.load("panda").joint_names
    page = visit(studio("panda", conditions=("healthy",) * 3 + ("locked",) + ("healthy",) * 3))
    assert page.evaluate(f"{PAGE}.state.step") == "lock"
    finish(page)
    command = page.locator(".command-studio").text_content()
    assert f"--lock={names[3]}" in command
    q = [float(x) for x in re.search(r"--q=(\S+)", command)[1].split(",")]
    np.testing.assert_allclose(q, configuration(page))


def test_the_command_line_opens_a_motion_at_a_time(studio, visit, tmp_path):
    (tmp_path / "m.csv").write_text("time_s,joint1_rad,joint2_rad,joint3_rad\n0,0,0,0\n2,1,0.5,0.25\n")
    page = visit(studio("planar-3r", **PLANAR, show="file", file=str(tmp_path / "m.csv"), time=1.0))
    finish(page)
    np.testing.assert_allclose(ghosts(page), [[0.5, 0.25, 0.125]])
    command = page.locator(".command-studio").text_content()
    assert command.endswith(f"--show=file --file={tmp_path}/m.csv --time=1.0")


def test_two_windows_are_independent(studio, visit):
    server = studio("planar-3r", **PLANAR)
    first, second = visit(server), visit(server)
    first.locator(".bars button").nth(1).click()
    enter(second, "choose")
    click(second, "Best and worst")
    finish(second)
    assert second.evaluate(f"{PAGE}.state.conditions") == ["healthy"] * 3
    assert first.evaluate(f"{PAGE}.state.conditions")[1] == "locked"
    assert ghosts(second).shape == (2, 3)


def test_a_computation_is_cancelled_and_a_stopped_server_is_reported(studio, visit):
    server = studio("panda")
    page = visit(server)
    enter(page, "region")
    click(page, "Assess around the tool")
    page.get_by_role("button", name="Cancel").click()
    assert page.locator(".studio-status").inner_text() == "The computation was cancelled."
    assert page.locator("progress").is_hidden()
    enter(page, "choose")
    click(page, "Best and worst")
    finish(page)
    assert ghosts(page).shape == (2, 7)
    server.stop()
    page.locator(".bars button").nth(1).click()
    page.wait_for_timeout(500)
    assert "studio-error" in page.locator(".studio-status").get_attribute("class")


@pytest.mark.parametrize(("scheme", "width"), [("light", 1200), ("dark", 390)])
def test_every_step_is_accessible(studio, visit, scheme, width):
    page = visit(studio("planar-3r", **PLANAR), width=width, color_scheme=scheme)
    for details in page.locator(".arm details").all():
        details.evaluate("details => { details.open = true; }")
    seen = []
    for step in STEPS:
        page.locator(f'.arm-steps [data-step="{step}"]').focus()
        page.keyboard.press("Enter")
        finish(page)
        assert axe.serious(page) == []
        seen.append(headline(page))
        assert len(seen[-1].split()) <= 12
    assert page.locator(".arm [aria-live]").first.text_content() == seen[-1]
    if width == 390:
        page.set_viewport_size({"width": 320, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= 320


def test_the_page_without_a_server_has_no_texts_of_the_studio(browser):
    html = arms.load("planar-3r").page().to_html()
    assert "studio_" not in html
    assert "fetch(" not in html
