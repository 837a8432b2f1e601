"""A person at a station: does on the page what people do."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from playwright.sync_api import BrowserContext, Locator, Page

OPERATOR = Path(__file__).with_name("operator.js")
PATIENCE = 60.0  # s: the computer may be busy


class Station:
    """One tab with the page of a station, and the person before it.

    Args:
        context: Of the browser.
        url: Of the page.
    """

    def __init__(self, context: BrowserContext, url: str) -> None:
        self.context, self.url = context, url
        self.page: Page = context.new_page()
        self.page.goto(url)

    def at(self, testid: str) -> Locator:
        """An element of the page."""
        return self.page.get_by_test_id(testid)

    @property
    def said(self) -> dict[int, dict[str, Any]]:
        """Every message of the session by its number, also those of tabs that are closed, however often each was sent."""
        messages = [json.loads(text) for text in self.page.evaluate("operator.said()")]
        return {message["seq"]: message for message in messages}

    def until(self, true: Callable[[], bool], what: str) -> None:
        """Wait for something."""
        end = time.monotonic() + PATIENCE
        while not true():
            assert time.monotonic() < end, f"waited for {what}; phases {self.operator('phases')}"
            self.page.wait_for_timeout(30)

    def operator(self, what: str) -> Any:
        """Of the person's stick and eyes: see operator.js."""
        return self.page.evaluate(f"operator.{what}")

    # ---- before the trials -----------------------------------------------------------------------------------------

    def set_up(self, device: str) -> None:
        """Choose a stick, and try it."""
        self.at("setup").wait_for()
        if device == "gamepad":
            self.operator("pad.connected = true")
        else:
            self.at(f"device-{device}").check()
        self.page.locator(f"[data-testid=device-{device}]:checked").wait_for()
        self.at("setup-continue").click()

    def calibrate(self) -> None:
        """A gamepad of its own kind: other axes, the wrong way round, not quite at rest in the middle."""
        self.operator("right = {axis: 2, centre: 0.1, range: -0.8}")
        self.operator("up = {axis: 3, centre: -0.05, range: 0.9}")
        self.operator("trigger = 6")
        self.operator("push(0, 0)")
        self.operator("pad.connected = true")
        self.at("calibrate").click()
        said = self.at("setup-message")
        for text, push in (("to the right", "push(1, 0)"), ("forward", "push(0, 1)")):
            said.filter(has_text=text).wait_for()
            self.operator(push)
            said.filter(has_text="release").wait_for()
            self.operator("push(0, 0)")
        said.filter(has_text="Press the button").wait_for()
        self.operator("pad.buttons[6].pressed = true")
        said.filter(has_text="Done.").wait_for()
        self.operator("pad.buttons[6].pressed = false")
        self.at("setup-continue").click()

    def join(self, code: str) -> None:
        """Take part, and fill in the first two forms."""
        self.at("code").fill(code)
        self.at("join").click()
        self.fill()

    def fill(self) -> None:
        """Consent, and say something of oneself."""
        self.at("informed").check()
        self.at("agreed").check()
        self.at("submit").click()
        self.at("age-25-34").check()
        self.at("hand-left").check()
        self.at("games-never").check()
        self.at("robots-once").check()
        self.at("submit").click()

    def learn(self) -> None:
        """Instructions and practice, of which nothing is recorded: both tasks are given up."""
        for part in (1, 2):
            self.at(f"instructions-{part}").get_by_test_id("instructions-next").click()
        for _ in range(2):
            self.started()
            self.page.keyboard.press("Escape")
            self.ended()
        self.at("practice-done").click()
        self.at("training-begin").click()

    def enter(self, code: str, device: str = "gamepad") -> None:
        """Up to the first task of the training."""
        self.set_up(device)
        self.join(code)
        self.learn()

    # ---- trials ----------------------------------------------------------------------------------------------------

    def count(self, phase: str) -> int:
        """How many trials came into a phase so far."""
        return self.page.evaluate("phase => operator.phases.filter((p) => p === phase).length", phase)

    def started(self) -> None:
        """Start the trial that waits."""
        self.page.locator("[data-testid=trial][data-phase=waiting]").wait_for()
        begun = self.count("running")
        self.page.keyboard.press("Space")
        self.until(lambda: self.count("running") > begun, "the start of a trial")

    def ended(self) -> None:
        """Wait for the end of all trials that were begun."""
        self.until(lambda: self.operator("phase") == "over", "the end of a trial")
        self.page.locator("[data-testid=trial][data-phase=over]").wait_for(state="detached")

    def steer(self) -> None:
        """One trial with the gamepad, from trigger to target."""
        over = self.count("over")
        self.operator("trials = 1")
        self.until(lambda: self.count("over") > over, "the end of a trial")

    def steer_keys(self) -> None:
        """One trial with the arrow keys, from space to target."""
        self.started()
        held: set[str] = set()
        while self.operator("phase") == "running":
            x, y = self.operator("way")
            wanted = {"ArrowRight"} if x > 0.5 else {"ArrowLeft"} if x < -0.5 else set()
            wanted |= {"ArrowUp"} if y > 0.5 else {"ArrowDown"} if y < -0.5 else set()
            if wanted and math.hypot(x, y) < 5:
                wanted.add("Shift")
            for key in held - wanted:
                self.page.keyboard.up(key)
            for key in sorted(wanted - held, key="Shift".__ne__):
                self.page.keyboard.down(key)
            held = wanted

    def steer_pointer(self) -> None:
        """One trial with the mouse, from the button to the target."""
        begun = self.count("running")
        self.at("start").click()
        self.until(lambda: self.count("running") > begun, "the start of a trial")
        box = self.at("velocity-1").bounding_box()
        assert box is not None
        centre = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        reach = 0.4 * min(box["width"], box["height"])
        self.page.mouse.move(*centre)
        self.page.mouse.down()
        while self.operator("phase") == "running":
            x, y = self.operator("way")
            far = math.hypot(x, y)
            size = 0 if far < 0.6 else reach * min(1, far / 5) / far
            self.page.mouse.move(centre[0] + size * x, centre[1] - size * y)
        self.page.mouse.up()

    def rate(self, step: int) -> None:
        """Say how difficult it was, a step from 1; by key, or by button where it is even."""
        self.at("rating").wait_for()
        if step % 2:
            self.page.keyboard.press(str(step))
        else:
            self.at(f"rating-{step}").click()
        self.at("rating").wait_for(state="detached")

    def settled(self) -> None:
        """Wait until everything is on the server's disk."""
        self.page.locator("[data-testid=connection][data-online=true][data-waiting='0']").wait_for()

    def under_way(self) -> None:
        """Begin a trial that does not end, and wait until some cycles of it were sent."""
        self.operator("goal = 'about'")
        self.operator("cycles = 0")
        self.operator("trials = 1")
        self.until(lambda: self.operator("cycles") > 10, "some cycles")

    def leave(self) -> None:
        """Close the tab as people do: the page hears of it."""
        with self.page.expect_event("close"):
            self.page.close(run_before_unload=True)
