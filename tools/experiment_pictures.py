"""Takes the pictures of "Run your own experiment": ``python tools/experiment_pictures.py`` writes docs/_static/experiment/.

Needs Chromium, Playwright and the extras ``teleop`` and ``stats``. A short experiment is served, and the person of
the browser's tests sits down at it.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import Page

ROOT = Path(__file__).parents[1]
OUT = ROOT / "docs" / "_static" / "experiment"
sys.path.insert(0, str(ROOT / "tests"))

import chromium  # noqa: E402
from browser.conftest import Served, command_line  # noqa: E402
from browser.station import OPERATOR, Station  # noqa: E402
from holdfast.teleop.protocol.protocol import Training, read_protocol  # noqa: E402
from holdfast.teleop.rehearsal import simulate_experiment  # noqa: E402


def keep(page: Page, name: str) -> None:
    """Write what a page shows, as a small file."""
    page.wait_for_timeout(300)
    shown = Image.open(BytesIO(page.screenshot())).convert("RGB")
    # Without kmeans, by how often a colour occurs, the few lines and dots would lose theirs.
    few = shown.quantize(256, kmeans=4, dither=Image.Dither.NONE)
    few.save(OUT / f"{name}.png", optimize=True)


def begin(folder: Path) -> None:
    """An experiment that three simulated operators have done."""
    whole = read_protocol("goel2003-smooth")
    few = whole.with_tasks(whole.tasks.take(np.array([0, 3, 6, 9, 13, 19])), whole.notes[:6])
    training = Training(at_least=1, in_a_row=1, limit=900.0, most=20, distance=2.0)
    short = replace(few, name="Three links, pilot", training=training, subjects=12)
    simulate_experiment(folder, short, 3, seed=4).close()


def take(served: Served) -> None:
    """Sit down, and go as far as the first rating."""
    with chromium.opened() as browser:
        context = browser.new_context(viewport={"width": 1280, "height": 720})
        context.set_default_timeout(120_000)
        context.add_init_script(path=OPERATOR)
        station = Station(context, served.station)
        station.at("setup").wait_for()
        station.operator("pad.id = 'Extreme 3D Pro (STANDARD GAMEPAD)'")
        station.operator("pad.connected = true")
        station.page.locator("[data-testid=device-gamepad]:checked").wait_for()
        station.operator("push(0.55, 0.5)")
        keep(station.page, "set-up")
        station.operator("push(0, 0)")
        station.at("setup-continue").click()
        station.at("code").fill("P04")
        station.at("join").click()
        station.at("form-consent").wait_for()
        keep(station.page, "consent")
        station.fill()
        station.at("instructions-1").wait_for()
        keep(station.page, "instructions")
        station.learn()
        station.steer()
        station.at("trials-begin").click()
        station.under_way()
        station.operator("goal = 'target'")
        watcher = browser.new_context(viewport={"width": 1280, "height": 720}).new_page()
        watcher.goto(served.experimenter)
        watcher.locator("[data-testid=live][data-steering=true]").wait_for(timeout=120_000)
        # The same on every computer.
        for testid, text in (("folder", "/home/lab/experiment"), ("station-url", "http://127.0.0.1:8000/")):
            watcher.get_by_test_id(testid).evaluate("(element, text) => { element.textContent = text; }", text)
        keep(watcher, "experimenter")
        keep(station.page, "trial")
        station.at("rating").wait_for()
        keep(station.page, "rating")


def main() -> None:
    """Take them all."""
    OUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "experiment"
        begin(folder)
        with subprocess.Popen(command_line(folder), stdout=subprocess.PIPE, text=True) as process:
            try:
                take(Served.of(folder, process))
            finally:
                process.terminate()


if __name__ == "__main__":
    main()
