"""The animation of a stick figure and the figures over time."""

from __future__ import annotations

import json
import re
import subprocess
from shutil import which

import numpy as np
import pytest
from wellformed import check

import chromium
from holdfast.report import page
from holdfast.report.animations import Motion, animation, shown_seconds
from holdfast.report.views import View

X, Y, Z = np.eye(3)
SIDE = View(X, Z, "Side view")
TOP = View(X, Y, "Top <view>")


@pytest.fixture
def motion(rng):
    chain = rng.normal(size=(11, 4, 3)).cumsum(axis=1)
    readings = [f"frame {k} </script> & <b>" for k in range(11)]
    return Motion(np.linspace(0, 5, 11), chain, np.array([False, True, False, False]), chain[:, -1], readings)


def drawn(motion, views):
    return str(animation(motion, views, "motion", 'An arm "in" <motion>'))


def data(html):
    return json.loads(re.search(r"var data = (\{.*\});", html)[1])


def test_it_is_well_formed_and_reaches_for_nothing(motion):
    html = page.render(
        page.Page("t", "h", [page.Section("", [page.Picture(animation(motion, [SIDE, TOP], "motion", "An arm"), "c")])])
    )
    check(html, scripts=1)
    assert "&lt;b&gt;" in html


def test_all_that_moves_is_drawn_to_one_scale(motion):
    found = data(drawn(motion, [SIDE, TOP]))
    assert found["seconds"] == 5
    assert found["readings"] == list(motion.readings)
    frames = np.array(found["frames"])
    assert frames.shape == (2, 11, 4, 2)
    flat = [motion.chain @ np.stack([v.right, v.up], axis=1) for v in (SIDE, TOP)]
    scales = []
    for view, expected in zip(frames, flat, strict=True):
        shown = view.reshape(-1, 2) * [1, -1]
        points = expected.reshape(-1, 2)
        scale = np.ptp(shown[:, 0]) / np.ptp(points[:, 0])
        np.testing.assert_allclose(shown - shown.mean(axis=0), scale * (points - points.mean(axis=0)), atol=0.15)
        scales.append(scale)
    assert scales[0] == pytest.approx(scales[1], rel=1e-2)


def test_everything_is_inside_the_drawing(motion):
    html = drawn(motion, [SIDE])
    width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', html).groups())
    frames = np.array(data(html)["frames"])
    assert (frames >= 0).all()
    assert (frames[..., 0] <= width).all()
    assert (frames[..., 1] <= height).all()


def test_people_with_a_keyboard_can_use_it(motion):
    html = drawn(motion, [SIDE])
    assert '<button type="button">Play</button>' in html
    assert re.search(r'<input type="range" min="0" max="10" value="0" step="1" aria-label="[^"]+" aria-valuetext=', html)
    assert 'aria-label="An arm &#34;in&#34; &lt;motion&gt;"' in html
    assert "focus-visible" in html


@pytest.mark.skipif(which("node") is None, reason="needs Node.js to parse JavaScript")
def test_the_script_is_javascript(motion, tmp_path):
    file = tmp_path / "a.js"
    file.write_text(re.search(r"<script>(.*?)</script>", drawn(motion, [SIDE]), re.DOTALL)[1])
    subprocess.run(["node", "--check", str(file)], check=True)


BUSY = "setInterval(() => { const t = performance.now(); while (performance.now() - t < 25); }, 30);"


def test_play_plays_every_time_also_on_a_busy_page(motion, tmp_path):
    """While a page is busy, the first frame after a click carries a time from before the click."""
    report = page.Page("t", "h", [page.Section("", [page.Picture(animation(motion, [SIDE], "motion", "An arm"), "c")])])
    file = page.write(report, tmp_path / "motion.html")
    with chromium.opened(chromium.required) as browser:
        opened, errors = browser.new_page(), []
        opened.on("pageerror", lambda error: errors.append(str(error)))
        opened.add_init_script(BUSY)
        opened.goto(file.as_uri())
        slider, button = opened.locator("#motion input"), opened.locator("#motion button")
        for _ in range(20):
            button.click()
            opened.wait_for_function("() => document.querySelector('#motion input').value > 0")
            assert not errors
            button.click()
            assert button.inner_text() == "Play"
            slider.fill("0")
        button.click()
        opened.wait_for_function("() => document.querySelector('#motion button').textContent === 'Play'")
        assert slider.input_value() == "10"
        assert not errors


def test_a_motion_is_played_so_that_it_can_be_followed():
    assert shown_seconds(np.array([0.0, 0.5])) == 3
    assert shown_seconds(np.array([0.0, 7.0])) == 7
    assert shown_seconds(np.array([0.0, 3600.0])) == 20


def test_an_arm_that_stands_still_can_be_drawn():
    still = Motion(np.linspace(0, 1, 3), np.zeros((3, 2, 3)), np.zeros(2, dtype=bool), np.zeros((3, 3)), ["a", "b", "c"])
    assert np.isfinite(data(drawn(still, [SIDE]))["frames"]).all()
