"""A fault that is injected in the studio, and what the monitor makes of it: computed, and in the page."""

from __future__ import annotations

import re

import numpy as np
import pytest
from studio_pages import wait_for

import axe
from holdfast.core.errors import InputError
from holdfast.interface.studio import State
from holdfast.interface.studio.monitor_demo import MonitorDemo, monitor_html, simulate_monitor_demo
from holdfast.interface.studio.motions import PlayedMotion

pytest.importorskip("mujoco")
NAMES = ("a", "b")


def some(**more):
    """A lock of b at 1 s that is noticed at 1.2 s and named at 1.22 s, of 4 s."""
    time = np.linspace(0, 4, 81)
    values = np.stack((0.3 + 0 * time, np.where(time < 1, 0.2, 9.0)), axis=1)
    values[7, 0] = np.nan
    given = {
        "onset": 1.0,
        "alarm_time": 1.2,
        "joint": 1,
        "isolation_time": 1.22,
        "kind": "locked",
        "classification_time": 1.32,
        "findings": ("b is <locked>",),
        "inconclusive": ("a did not",),
    }
    return MonitorDemo(
        motion=PlayedMotion("m", time, "s", values), time=time, residuals={"torque residual": values}, **{**given, **more}
    )


def test_what_is_known_comes_with_time():
    before, noticed, known, end = (monitor_html(some(), NAMES, t) for t in (0.9, 1.21, 1.5, 4.0))
    assert "above it: none" in before
    assert "hf-named" not in noticed
    assert "b is &lt;locked&gt;" in known
    assert known.count("hf-named") == 1
    assert "a did not" not in known
    assert "a did not" in end
    points = [re.findall(r'points="([^"]*)"', text)[0].split() for text in (before, end)]
    assert len(points[0]) < len(points[1]) == 80  # one is not a number


@pytest.mark.parametrize(
    ("changes", "current", "sentence"),
    [
        ({}, 1.19, "No alarm so far."),
        ({}, 1.21, "Alarm 200 ms after the fault; joint: not identified."),
        ({}, 1.27, "Alarm 200 ms after the fault; joint: b."),
        ({}, 4.0, "Alarm 200 ms after the fault; joint: b, locked."),
        ({"kind": "unknown"}, 4.0, "Alarm 200 ms after the fault; joint: b."),
        (
            {"joint": None, "isolation_time": np.inf, "kind": "contact"},
            4.0,
            "Alarm 200 ms after the fault; joint: not identified.",
        ),
        ({"onset": 2.0}, 1.21, "Alarm at 1.200 s, before any fault; joint: not identified."),
        ({"onset": np.inf}, 1.21, "Alarm at 1.200 s, before any fault; joint: not identified."),
    ],
)
def test_the_sentence_about_the_alarm_follows_the_time(changes, current, sentence):
    html = monitor_html(some(**changes), NAMES, current)
    assert sentence in html
    assert ("data-alarm" in html) == (sentence != "No alarm so far.")


def test_there_must_be_a_target():
    with pytest.raises(InputError, match="there is no target"):
        simulate_monitor_demo(None, State("x", NAMES, (0.0, 0.0)), lambda *_: None)


def test_a_fault_in_the_page_is_named(studio, visit):
    page, window = visit(studio("panda", task="position"))
    page.get_by_role("tab", name="Watch").click()
    button = page.get_by_role("button", name="Move, fail and watch")
    wait_for(page, button.is_enabled)
    button.click()
    wait_for(page, lambda: window.monitor_demo is not None)
    window.request_action("time", 8.0)
    wait_for(page, lambda: page.locator(".hf-watch[data-alarm]").count() == 1)
    wait_for(page, lambda: "panda_joint4 is locked" in page.locator(".hf-watch").inner_text())
    by_page, by_python = page.locator(".hf-head").inner_text(), window.monitor_demo
    late = 1000 * (by_python.alarm_time - by_python.onset)
    assert by_page == f"Alarm {late:.0f} ms after the fault; joint: {window.state.names[by_python.joint]}, locked."
    assert "above it: panda_joint4" in page.locator(".hf-watch svg").first.get_attribute("aria-label")
    assert axe.serious(page) == []
    window.request_action("fault", ("limp", "panda_joint2", 2.0))
    window.request_action("time", 0.5)
    wait_for(page, lambda: page.locator(".hf-head").inner_text() == "No alarm so far.")
    page.get_by_role("button", name="Inject the fault now").click()
    wait_for(page, lambda: window.monitor_demo is not by_python)
    assert window.monitor_demo.onset == pytest.approx(0.5, abs=0.01)
    wait_for(page, lambda: "joint: panda_joint2" in page.locator(".hf-head").inner_text())
    page.get_by_role("button", name="Clear").first.click()
    wait_for(page, lambda: page.locator(".hf-watch").count() == 0)
    assert "--show" not in window.state.to_command()
