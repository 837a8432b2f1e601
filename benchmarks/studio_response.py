"""W11: the studio. How soon it is there, how often it draws, and whether it waits for long computations.

Run it with ``python benchmarks/studio_response.py``; the end-to-end numbers need Playwright and Chromium. They are taken once
with pictures that the processor draws, and once with the draw calls of the scene left out, as where a graphics card does them:
all
else (numbers, messages, scripts, layout, painting the controls, putting the page together) is done on the server's own cores.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

FLAGS = ["--no-sandbox", "--disable-background-networking", "--use-gl=angle"]
DRAWN = {
    "drawn by the processor": ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    "draw calls left out": ["--use-angle=null", "--ignore-gpu-blocklist"],
}
LOADS = 5  # of the page in one browser: the first is new to it
# Pictures in which something of the scene is drawn, or would be.
PICTURES = """(drawn) => { window.pictures = 0; let any = false;
    for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced']) {
        const real = WebGL2RenderingContext.prototype[name];
        WebGL2RenderingContext.prototype[name] = function (...a) { any = true; if (drawn) real.apply(this, a); };
    }
    const tick = () => { window.pictures += any; any = false; requestAnimationFrame(tick); };
    requestAnimationFrame(tick); }"""
WATCH = """() => { window.seen = 0; new MutationObserver(() => { window.seen += 1; }).observe(
    document.body, {subtree: true, childList: true, characterData: true}); }"""


@contextmanager
def started(arm: str) -> Iterator[tuple[float, str]]:
    """'holdfast studio ARM': when it was started, and the address it printed."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "holdfast", "studio", arm, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield begin, process.stdout.readline().split()[1]
        process.terminate()


def first_pictures(arm: str, browser, drawn: bool) -> list[float]:
    """Seconds from the start of the program until a browser has drawn the arm and its numbers, for each of some loads."""
    context = browser.new_context(viewport={"width": 1200, "height": 800})
    context.add_init_script(f"({PICTURES})({json.dumps(drawn)})")
    page, found = context.new_page(), []
    for _ in range(LOADS):
        with started(arm) as (begin, url):
            page.goto(url, wait_until="commit")
            page.wait_for_selector("[data-worst]")
            page.wait_for_function("window.pictures > 0", polling="raf")
            found.append(time.perf_counter() - begin)
            page.goto("about:blank")
    context.close()
    return found


def live(machine, q, seconds: float) -> float:
    """Updates per second of the numbers alone: frames, both bars, ellipsoids, losses."""
    from holdfast.interface.studio.scene.bars import bars_html, losses_html

    names, healthy, count, end = machine.arm.joint_names, ("healthy",) * machine.arm.n, 0, time.perf_counter() + seconds
    while time.perf_counter() < end:
        x = q + 0.2 * np.sin(0.1 * count)
        machine.arm.frames(x)
        reading = machine.read(x, (), "relative-manipulability", "torque")
        bars_html(reading.bars, "", names, healthy), bars_html(reading.weights, "", names, healthy)
        losses_html(machine.arm, machine.task, reading, ())
        count += 1
    return count / seconds


def moving(window, q, page, seconds: float) -> tuple[float, float]:
    """Updates per second while a joint is dragged, and the longest wait for one, s."""
    count, longest, end = 0, 0.0, time.perf_counter() + seconds
    while time.perf_counter() < end:
        begin, before = time.perf_counter(), window.updates
        window.ask("joint", (1, float(q[1] + 0.3 * np.sin(0.1 * count))))
        while window.updates == before:
            time.sleep(0.0005)
        longest = max(longest, time.perf_counter() - begin)
        count += 1
        if count % 10 == 0:
            page.wait_for_timeout(1)
    return count / seconds, longest


def dragged(studio, browser, drawn: bool, q, seconds: float) -> dict[str, float]:
    """A joint is dragged at 40 updates a second, as fast as it goes, and while two laws are computed beside it."""
    from holdfast.model.arm import pose_numbers

    out: dict[str, float] = {}
    page = browser.new_page(viewport={"width": 1200, "height": 800})
    page.add_init_script(f"({PICTURES})({json.dumps(drawn)})")
    known = set(studio.windows)
    page.goto(studio.url)
    page.wait_for_selector("[data-worst]")
    window = studio.windows[max(set(studio.windows) - known)]
    window.settle()
    page.wait_for_timeout(1000)
    page.evaluate(WATCH)

    def counts() -> tuple[float, int, int, int]:
        return (time.perf_counter(), window.updates, *page.evaluate("[window.pictures, window.seen]"))

    begin = before = counts()
    while time.perf_counter() - begin[0] < seconds:
        window.ask("joint", (1, float(q[1] + 0.3 * np.sin(10 * (time.perf_counter() - begin[0])))))
        page.wait_for_timeout(20)
    after = counts()
    for name, x, y in zip(("updates", "pictures", "changes of the numbers"), before[1:], after[1:], strict=True):
        out[f"{name}_per_s"] = (y - x) / (after[0] - before[0])
    out["updates_per_s_at_most"], out["longest_wait_s"] = moving(window, q, page, seconds)
    goal = pose_numbers(window.machine.hand(q))
    window.state = replace(window.state, target=(goal[0] - 0.1, goal[1] + 0.2, *goal[2:]))
    window.ask("laws", None)
    while not window.worker.busy:
        page.wait_for_timeout(5)
    rates, worst, begin_busy = [], 0.0, time.perf_counter()
    while window.worker.busy and time.perf_counter() - begin_busy < 120:
        rate, wait = moving(window, q, page, 0.5)
        rates.append(rate)
        worst = max(worst, wait)
    out["updates_per_s_while_busy"], out["longest_wait_while_busy_s"] = float(np.mean(rates)), worst
    page.close()
    return out


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--arm", default="panda")
    options.add_argument("--seconds", type=float, default=5.0)
    chosen = options.parse_args()

    from holdfast import arms
    from holdfast.interface.studio import State, serve

    served = []
    for _ in range(LOADS):
        with started(chosen.arm) as (begin, _):
            served.append(time.perf_counter() - begin)
    out: dict[str, object] = {"start_to_address_s": served}
    arm, q = arms.load(chosen.arm), np.array(arms.about(chosen.arm).home) + 0.1
    with serve(arm, State(chosen.arm, arm.joint_names, tuple(q)), port=0) as studio:
        studio.machine.evaluate_live_reading(q, (), "relative-manipulability", "torque")
        out["numbers_per_s"] = live(studio.machine, q, chosen.seconds)
        chromium = shutil.which("chromium") or shutil.which("google-chrome")
        if chromium is not None:
            from playwright.sync_api import sync_playwright

            with sync_playwright() as playwright:
                for how, flags in DRAWN.items():
                    browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS + flags)
                    drawn = how == next(iter(DRAWN))
                    first = first_pictures(chosen.arm, browser, drawn)
                    out[how] = {"start_to_first_picture_s": first, **dragged(studio, browser, drawn, q, chosen.seconds)}
                    browser.close()
    print(json.dumps(out, indent=2))


if __name__ == "__main__":
    main()
