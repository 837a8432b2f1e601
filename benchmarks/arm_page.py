"""W22: the page of an arm in Chromium without a graphics card: size, first picture, and pictures during a drag.

The peer is the still page that viser's ``as_html`` writes of as many tubes; it can be rotated, but computes nothing.
Times are of headless Chromium: "paint" is the first contentful paint, and "ready" the time at which a drag can begin.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import re
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1] / "tests"))  # the browser of the tests

import chromium

SIZES = {"1200 x 800": (1200, 800), "390 x 800": (390, 800)}
LOADS = 15
PICTURES = 180
STEPS = ("healthy", "lock", "prepare", "power")
_PAINT = "performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? null"
_READY = "performance.getEntriesByName('arm page ready')[0]?.startTime ?? null"
# One move of the pointer for each picture, on a circle of 30 pixels around the ring; returns gaps and script times, ms.
_DRAG = """async count => {
  const ring = document.querySelector('.tool-handle'), box = ring.getBoundingClientRect();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const send = (type, k) => ring.dispatchEvent(new PointerEvent(type, {pointerId: 1, bubbles: true,
    clientX: x + 30 * Math.sin(k / 15), clientY: y + 30 * (1 - Math.cos(k / 15))}));
  HTMLElement.prototype.setPointerCapture = () => undefined;
  send('pointerdown', 0);
  const gaps = [], script = [];
  let before = null;
  for (let k = 0; k < count; k++) {
    const now = await new Promise(requestAnimationFrame);
    if (before !== null) gaps.push(now - before);
    before = now;
    const start = performance.now();
    send('pointermove', k);
    script.push(performance.now() - start);
  }
  send('pointerup', count);
  return [gaps, script];
}"""


def write_pages(folder: Path) -> dict[str, Path]:
    """Write the pages to compare, and return their files by name."""
    import viser
    from scipy.spatial import ConvexHull

    from holdfast import arms

    arm = arms.load("panda")
    pages = {"holdfast": folder / "holdfast.html", "viser, as_html": folder / "viser.html"}
    html = arm.page(pages["holdfast"]).to_html()
    scene, parts = (json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', html)[:2])
    frames = arm.frames(np.array(scene["arms"][0]["q"][0]))
    ring = np.array([[np.cos(t), np.sin(t), 0.3 * np.cos(3 * t)] for t in np.linspace(0, 2 * np.pi, 20, endpoint=False)])
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(port=0, verbose=False)
    for k, part in enumerate(parts):
        start, end, radius = np.array(part["tube"][:3]), np.array(part["tube"][3:6]), part["tube"][6]
        corners = np.vstack([start + radius * ring, end + radius * ring])
        pose = frames[part["frame"]]
        server.scene.add_mesh_simple(f"/part{k}", corners @ pose[:3, :3].T + pose[:3, 3], ConvexHull(corners).simplices)
    pages["viser, as_html"].write_text(server.scene.as_html(), encoding="utf-8")
    with contextlib.redirect_stdout(io.StringIO()):
        server.stop()
    return pages


def measure_load(browser, file: Path, size: tuple[int, int]) -> tuple[float, float]:
    """Return the first contentful paint and the time at which a drag can begin, ms; NaN where a page has none."""
    context = browser.new_context(viewport={"width": size[0], "height": size[1]})
    page = context.new_page()
    page.goto(file.as_uri())
    page.wait_for_timeout(700)
    times = [page.evaluate(f"() => {text}") for text in (_PAINT, _READY)]
    context.close()
    return tuple(float("nan") if time is None else float(time) for time in times)


def measure_drag(browser, file: Path, step: str) -> list[float]:
    """Return median and 95 % of the gap between pictures, and 95 % of the script of a move, ms."""
    context = browser.new_context(viewport={"width": 1200, "height": 800})
    page = context.new_page()
    page.goto(file.as_uri())
    page.wait_for_selector(".view3d-drawn")
    page.locator(f'[data-step="{step}"]').click()
    gaps, script = page.evaluate(_DRAG, PICTURES)
    context.close()
    return [float(np.median(gaps)), float(np.quantile(gaps, 0.95)), float(np.quantile(script, 0.95))]


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    print("### W22: the page of a Panda in Chromium, without a graphics card\n")
    with tempfile.TemporaryDirectory() as name, chromium.opened() as browser:
        pages = write_pages(Path(name))
        print("| page | kB | window | paint, ms | ready, ms |\n| --- | ---: | --- | ---: | ---: |")
        for label, size in SIZES.items():
            rounds = [{name: measure_load(browser, file, size) for name, file in pages.items()} for _ in range(LOADS)]
            for name, file in pages.items():
                paint, ready = (statistics.median(times[name][k] for times in rounds) for k in (0, 1))
                shown = "not interactive" if np.isnan(ready) else f"{ready:.0f}"
                print(f"| {name} | {file.stat().st_size / 1000:.0f} | {label} | {paint:.0f} | {shown} |")
        print("\n| drag in step | gap between pictures, ms | 95 % | script of a move, 95 %, ms |\n| --- | ---: | ---: | ---: |")
        for step in STEPS:
            median, late, script = measure_drag(browser, pages["holdfast"], step)
            print(f"| {step} | {median:.1f} | {late:.1f} | {script:.1f} |")
    print(f"\n{LOADS} loads and {PICTURES} moves each; medians.")


if __name__ == "__main__":
    main()
