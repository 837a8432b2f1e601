"""W11: the studio. How soon it is there, how often it draws, and whether it waits for long computations.

Run it with ``python benchmarks/w11_studio.py``; the end-to-end numbers need Playwright and Chromium. Software rendering in a
headless browser shares the cores with the server, so the numbers of a person's own browser are better.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np

FLAGS = ["--no-sandbox", "--disable-background-networking", "--use-gl=angle", "--use-angle=swiftshader"]
FLAGS += ["--enable-unsafe-swiftshader"]
WATCH = """() => { window.seen = 0; new MutationObserver(() => { window.seen += 1; }).observe(
    document.body, {subtree: true, childList: true, characterData: true}); }"""
FRAMES = """() => { window.frames_ = 0; const f = () => { window.frames_ += 1; requestAnimationFrame(f); }; f(); }"""


def start_up(arm: str) -> float:
    """Seconds from the start of the program until its page is served."""
    begin = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-m", "holdfast", "studio", arm, "--port", "0"], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    process.stdout.readline()
    took = time.perf_counter() - begin
    process.terminate()
    process.wait()
    return took


def live(machine, q, seconds: float) -> float:
    """Updates per second of the numbers alone: frames, both bars, ellipsoids, losses."""
    from holdfast.studio.bars import bars_html, losses_html

    names, healthy, count, end = machine.arm.joint_names, ("healthy",) * machine.arm.n, 0, time.perf_counter() + seconds
    while time.perf_counter() < end:
        x = q + 0.2 * np.sin(0.1 * count)
        machine.frames(x)
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
        if page is not None and count % 10 == 0:
            page.wait_for_timeout(1)
    return count / seconds, longest


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--arm", default="panda")
    options.add_argument("--seconds", type=float, default=5.0)
    chosen = options.parse_args()

    from holdfast import arms
    from holdfast.arm.poses import pose_numbers
    from holdfast.studio import State, serve

    out: dict[str, float] = {}
    start_up(chosen.arm)
    out["start_to_page_served_s"] = start_up(chosen.arm)
    arm, q = arms.load(chosen.arm), np.array(arms.about(chosen.arm).home) + 0.1
    with serve(arm, State(chosen.arm, arm.joint_names, tuple(q)), port=0) as studio:
        studio.machine.read(q, (), "relative-manipulability", "torque")
        out["numbers_per_s"] = live(studio.machine, q, chosen.seconds)
        chromium = shutil.which("chromium") or shutil.which("google-chrome")
        if chromium is not None:
            from playwright.sync_api import sync_playwright

            with sync_playwright() as playwright:
                browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
                page = browser.new_page(viewport={"width": 1200, "height": 800})
                begin = time.perf_counter()
                page.goto(studio.url)
                while not studio.windows or next(iter(studio.windows.values())).updates == 0:
                    page.wait_for_timeout(5)
                page.wait_for_selector("[data-worst]")
                out["page_to_first_picture_s"] = time.perf_counter() - begin
                window = next(iter(studio.windows.values()))
                window.settle()
                page.evaluate(WATCH), page.evaluate(FRAMES)
                seen = page.evaluate("() => [window.seen, window.frames_]")
                out["updates_per_s"], out["longest_wait_s"] = moving(window, q, page, chosen.seconds)
                after = page.evaluate("() => [window.seen, window.frames_]")
                out["changes_in_the_browser_per_s"] = (after[0] - seen[0]) / chosen.seconds
                out["frames_drawn_per_s"] = (after[1] - seen[1]) / chosen.seconds
                goal = pose_numbers(window.machine.hand(q))
                window.state = replace(window.state, target=(goal[0] - 0.1, goal[1] + 0.2, *goal[2:]))
                window.ask("laws", None)
                worst, rates = 0.0, []
                while not window.work.busy:
                    page.wait_for_timeout(5)
                begin = time.perf_counter()
                while window.work.busy and time.perf_counter() - begin < 120:
                    rate, wait = moving(window, q, page, 0.5)
                    rates.append(rate)
                    worst = max(worst, wait)
                out["busy_s"] = time.perf_counter() - begin
                out["updates_per_s_while_busy"], out["longest_wait_while_busy_s"] = float(np.mean(rates)), worst
                browser.close()
    print(json.dumps({k: round(v, 3) for k, v in out.items()}, indent=2))


if __name__ == "__main__":
    main()
