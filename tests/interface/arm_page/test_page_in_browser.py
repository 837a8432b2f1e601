"""The page of an arm in Chromium: its story, hands, keys, and numbers against Python's."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import yaml

import axe
import holdfast as hf
from holdfast import arms
from holdfast.core.errors import HoldfastError
from holdfast.interface.report.viewer import read_template
from wellformed import check

STEPS = ("healthy", "lock", "prepare", "undetected", "power")
LAST = "document.querySelector('.arm').armPage"


@pytest.fixture(scope="module")
def panda_html():
    return arms.load("panda").page().to_html()


@pytest.fixture
def opened(browser, tmp_path):
    """``opened(html)``: the page from disk, whose errors, console texts, and requests fail the test."""
    contexts, faults = [], []

    def show(html, width=1200, fragment="", **options):
        context = browser.new_context(viewport={"width": width, "height": 900}, offline=True, **options)
        contexts.append(context)
        context.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url))
        page = context.new_page()
        page.on("pageerror", lambda error: faults.append(f"{error} {error.stack}"))
        page.on("console", lambda message: faults.append(message.text))
        file = tmp_path / f"{len(contexts)}.html"
        file.write_text(html, encoding="utf-8")
        page.goto(file.as_uri() + fragment)
        return page

    yield show
    for context in contexts:
        context.close()
    assert faults == []


def headline(page) -> str:
    return page.locator(".arm-headline").first.inner_text().replace("\N{NO-BREAK SPACE}", " ")


def configuration(page) -> np.ndarray:
    return np.array(page.evaluate(f"Array.from({LAST}.state.q)"))


def enter(page, step):
    page.locator(f'.arm-steps [data-step="{step}"]').click()


def rest(page):
    """Wait until nothing has changed for a while, so that commands and address are written."""
    page.wait_for_timeout(600)


# ---- the file ------------------------------------------------------------------------------------------------------------


def test_the_file_is_whole_small_and_the_same_twice(panda_html):
    check(panda_html, 1)
    assert len(panda_html.encode()) <= 150_000
    assert not re.search(r"(?:https?:)?//[a-z0-9-]+\.[a-z]{2,}", panda_html.replace("http://www.w3.org/", ""))
    for banned in ("fetch(", "XMLHttpRequest", "innerHTML", "eval("):
        assert banned not in panda_html
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', panda_html)[1]
    assert "default-src 'none'" in policy
    assert "unsafe-eval" not in policy
    assert "unsafe-inline" not in policy.replace("style-src-attr 'unsafe-inline'", "")
    assert arms.load("panda").page().to_html() == panda_html


def test_every_headline_has_at_most_twelve_words():
    texts = yaml.safe_load(read_template("arm_page.yaml"))
    spoken = {key: text for key, text in texts.items() if not key.endswith(("about_text", "handle", "hint", "file_detail"))}
    assert {key for key, text in spoken.items() if len(re.sub(r"\{\w+\}", "x", text).split()) > 12} <= {"bar", "bound"}


def test_a_page_without_script_shows_the_answer(browser, panda_html, tmp_path):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    (tmp_path / "still.html").write_text(panda_html, encoding="utf-8")
    page.goto((tmp_path / "still.html").as_uri())
    values = page.locator(".bar-value").all_inner_texts()
    assert len(values) == 7
    assert page.locator(".bar-condition", has_text="worst").count() == 1
    assert page.locator(".view3d-stage svg").first.is_visible()
    context.close()


def test_names_from_a_file_are_never_read_as_html(opened):
    name = "</script><img src=x onerror=alert(1)>"
    plain = arms.load("planar-3r")
    joints = tuple(replace(joint, name=f"{name}{k}") for k, joint in enumerate(plain.joints))
    page = opened(replace(plain, name=name, joints=joints).page().to_html())
    for step in STEPS:
        enter(page, step)
    rest(page)
    assert page.locator("img").count() == 0
    assert name in page.locator(".bar-name").first.inner_text()


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"laws": ["pseudoinverse"]}, "laws has 1 name; the page compares two control laws"),
        ({"laws": ["pseudoinverse", "none"]}, "none"),
        ({"target": [0.1, 0.2]}, r"target has shape \(2,\)"),
        ({"q": [0.1, 0.2]}, "q for 'planar-3r' has 2 values"),
        ({"locked": ["elbow"]}, "no joint 'elbow'"),
        ({"beside": [arms.load("planar-3r")]}, "two arms have the name 'planar-3r'"),
    ],
)
def test_bad_input_gets_a_sentence(options, sentence):
    with pytest.raises(HoldfastError, match=sentence):
        arms.load("planar-3r").page(**options)


# ---- numbers -------------------------------------------------------------------------------------------------------------


def number(text: str, unit: str) -> float:
    return float(re.search(rf"([\d.]+) {unit}", text.replace("\N{NO-BREAK SPACE}", " "))[1])


def test_each_step_shows_what_python_computes(opened, panda_html):
    arm = arms.load("panda")
    page = opened(panda_html, reduced_motion="reduce")
    q = configuration(page)
    index = hf.indices.relative_manipulability(arm)
    fractions = index.evaluate(q).by_failure
    shown = [number(text, "%") for text in page.locator(".bar-value").all_inner_texts()]
    np.testing.assert_allclose(shown, 100 * fractions, atol=0.5)
    np.testing.assert_allclose(page.evaluate(f"Array.from({LAST}.fractions)"), fractions, atol=1e-12)
    enter(page, "lock")
    worst = int(fractions.argmin())
    assert headline(page) == f"Joint {worst + 1} is locked: the tool keeps {100 * fractions[worst]:.1f} % of its speed."
    enter(page, "prepare")
    page.get_by_role("button", name="Go to the best").click()
    best = index.evaluate(configuration(page)).by_failure.min()
    np.testing.assert_allclose(arm.forward_kinematics(configuration(page)), arm.forward_kinematics(q), atol=1e-6)
    optimum = hf.optimise(arm, arm.forward_kinematics(q), index, initial=q).value
    assert 0.9 * float(np.squeeze(optimum)) <= best <= float(np.squeeze(optimum)) + 1e-9
    page.evaluate(f"{LAST}.setConfiguration({q.tolist()})")
    enter(page, "undetected")
    story = json.loads(page.locator(".arm-data script").text_content())["story"]
    for k in (0, 1):
        law = hf.laws.by_name(story["laws"][k]["slug"], arm, task="position", gain=2.0, speed_limit=0.25)
        deviation = hf.simulate(law, q, story["target"], locked=[worst], time_limit=12.0).line_deviation()
        assert number(page.locator(".law-key").nth(k).inner_text(), "mm") == pytest.approx(1000 * deviation, abs=0.6)
    enter(page, "power")
    drop = float(hf.power_loss(arm, q, duration=0.2).drop_at(0.15))
    assert number(headline(page), "mm.") == pytest.approx(1000 * drop, abs=0.6) if drop < 0.1 else True


# ---- hands and keys ------------------------------------------------------------------------------------------------------


def handle_center(page):
    box = page.locator(".tool-handle").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_a_drag_moves_the_tool_and_keeps_locked_joints(opened, panda_html):
    page = opened(panda_html)
    page.wait_for_selector(".view3d-drawn")
    first, (x, y) = configuration(page), handle_center(page)
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 11):
        page.mouse.move(x + 3 * k, y + 2 * k)
    page.wait_for_timeout(100)
    second = configuration(page)
    assert not np.allclose(first, second)
    assert np.hypot(*np.subtract(handle_center(page), (x + 30, y + 20))) < 2  # the ring is where the pointer is
    page.evaluate(f"{LAST}.selectCondition(3, 'locked')")  # a lock during a drag
    for k in range(1, 11):
        page.mouse.move(x + 30, y + 20 + 2 * k)
    page.mouse.up()
    assert configuration(page)[3] == second[3]
    page.mouse.move(*handle_center(page))
    page.mouse.down()
    page.mouse.move(5, 5, steps=5)
    assert "Not reached" in headline(page) or "Out of reach" in headline(page)
    page.mouse.up()
    arm = arms.load("panda")
    assert (configuration(page) >= arm.lower).all()
    assert (configuration(page) <= arm.upper).all()


def test_a_finger_drags_the_ring_and_a_second_one_is_ignored(opened, panda_html):
    page = opened(panda_html, width=390, has_touch=True)
    page.wait_for_selector(".view3d-drawn")
    first, (x, y) = configuration(page), handle_center(page)
    send = """([type, pointerId, x, y]) => document.querySelector('.tool-handle').dispatchEvent(
        new PointerEvent(type, {pointerId, clientX: x, clientY: y, bubbles: true, pointerType: 'touch'}))"""
    page.evaluate("HTMLElement.prototype.setPointerCapture = () => undefined")
    for event in (["pointerdown", 1, x, y], ["pointerdown", 2, 0, 0], ["pointermove", 2, 300, 300]):
        page.evaluate(send, event)
    np.testing.assert_array_equal(configuration(page), first)
    page.evaluate(send, ["pointermove", 1, x + 20, y])
    second = configuration(page)
    assert not np.allclose(first, second)
    page.evaluate(send, ["pointercancel", 1, x, y])
    page.evaluate(send, ["pointermove", 1, x + 90, y])
    np.testing.assert_allclose(configuration(page), second, atol=1e-5)


def test_the_story_runs_by_keyboard_alone(opened, panda_html):
    page = opened(panda_html)
    page.wait_for_selector(".view3d-drawn")
    first = configuration(page)
    page.locator(".tool-handle").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("PageUp")
    assert not np.allclose(first, configuration(page))
    seen = []
    for step in STEPS:
        page.locator(f'[data-step="{step}"]').focus()
        page.keyboard.press("Enter")
        seen.append(headline(page))
    assert len(set(seen)) == 5
    rest(page)
    assert page.locator("[aria-live]").first.text_content().replace("\N{NO-BREAK SPACE}", " ") == headline(page)


def test_a_state_is_in_the_address(opened, panda_html):
    page = opened(panda_html)
    page.locator(".bars button").nth(4).click()
    page.locator(".bars button").nth(5).click()
    page.locator(".bars button").nth(5).click()
    rest(page)
    fragment = page.evaluate("location.hash")
    again = opened(panda_html, fragment=fragment)
    assert again.evaluate(f"{LAST}.state.conditions") == ["healthy"] * 4 + ["locked", "free", "healthy"]
    np.testing.assert_allclose(configuration(again), configuration(page), atol=1e-6)
    assert headline(again) == headline(page)
    strange = opened(panda_html, fragment="#step=none&q=1,2,x&locked=99,-1&brake=1e9&arm=other")
    assert strange.evaluate(f"{LAST}.state.step") == "healthy"


def test_nothing_moves_without_input_under_reduced_motion(opened, panda_html):
    page = opened(panda_html, reduced_motion="reduce")
    for step in STEPS:
        enter(page, step)
        rest(page)
        page.evaluate(
            "() => { const ask = window.requestAnimationFrame; window.pictures = 0;"
            " window.requestAnimationFrame = (f) => { window.pictures++; return ask.call(window, f); }; }"
        )
        page.wait_for_timeout(200)
        assert page.evaluate("window.pictures") == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1200, 390])
def test_every_step_is_accessible(opened, panda_html, scheme, width):
    page = opened(panda_html, width=width, color_scheme=scheme)
    page.locator(".arm-commands").evaluate("details => { details.open = true; }")
    for step in STEPS:
        enter(page, step)
        rest(page)
        assert axe.serious(page) == []
    if width == 390:
        page.set_viewport_size({"width": 320, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= 320


def test_it_runs_in_a_sandboxed_frame(opened):
    frame = arms.load("planar-3r").page()._repr_html_().replace("onload=", "data-onload=")
    page = opened(f"<!DOCTYPE html><title>t</title>{frame}")
    inner = page.frame_locator("iframe")
    inner.locator('[data-step="lock"]').click()
    assert "is locked" in inner.locator(".arm-headline").inner_text()
    rest(page)


def test_a_report_contains_the_page_of_its_arm(opened, tmp_path):
    arm = arms.load("planar-3r")
    index = hf.indices.relative_manipulability(arm, "planar")
    best = hf.optimise(arm, arm.forward_kinematics([0.3, 0.8, 0.4]), index)
    best.report(tmp_path / "report.html")
    frame = opened((tmp_path / "report.html").read_text(encoding="utf-8")).frame_locator("iframe")
    shown = [number(text, "%") for text in frame.locator(".bar-value").all_inner_texts()]
    np.testing.assert_allclose(shown, 100 * index.by_joint(best.q), atol=0.51)
    frame.locator(".bars button").nth(1).click()
    assert "Joint 2 is locked" in frame.locator(".arm-headline").inner_text().replace("\N{NO-BREAK SPACE}", " ")
    assert frame.locator(".arm-steps").count() == 0


def test_a_menu_shows_another_arm(opened):
    html = arms.load("planar-3r").page(beside=[arms.load("panda"), arms.load("ur5")]).to_html()
    page = opened(html)
    page.get_by_label("Arm").select_option("panda")
    assert page.locator(".arm:visible .bars button").count() == 7
    page.get_by_label("Arm").select_option("ur5")
    page.locator('.arm:visible [data-step="prepare"]').click()
    assert "Every joint counts" in page.locator(".arm:visible .arm-headline").inner_text()


# ---- commands ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["panda", "planar-3r"])
def test_copied_commands_run_and_give_the_shown_numbers(opened, cli, capsys, name):
    import shlex

    page = opened(arms.load(name).page().to_html(), reduced_motion="reduce")
    for step in STEPS:
        enter(page, step)
        rest(page)
        shell, python = (page.locator(f".command-{kind}").first.text_content() for kind in ("shell", "python"))
        for line in shell.splitlines():
            words = shlex.split(line)
            assert words[0] == "holdfast"
            code, out, error = cli(*words[1:])
            assert (code, error) == (0, ""), line
        capsys.readouterr()
        exec(compile(python, step, "exec"), {})
        printed = [float(x) for x in re.findall(r"\d+\.?\d*(?:e-?\d+)?", capsys.readouterr().out)]
        text = headline(page)
        if step in ("healthy", "lock"):
            assert min(printed) == pytest.approx(page.evaluate(f"Math.min(...{LAST}.fractions)"), rel=1e-6)
        elif step == "power":
            unit, scale = ("mm.", 1000) if "mm." in text else ("cm.", 100)
            assert number(text, unit) == pytest.approx(scale * printed[0], abs=0.6)
            assert any(f"{round(scale * printed[0])}" in line or "drop" in line for line in out.splitlines())
        elif step == "undetected":
            keys = page.locator(".law-key").all_inner_texts()
            for key, value in zip(keys, printed, strict=False):
                unit, scale = ("mm", 1000) if "\N{NO-BREAK SPACE}mm" in key else ("cm", 100)
                assert number(key, unit) == pytest.approx(scale * value, abs=0.6)
