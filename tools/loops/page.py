"""The page of a Panda: a joint locks, the arm moves along its self-motion, and the same lock takes less.

The page of ``holdfast page panda`` in headless Chromium, operated by its own controls.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

import holdfast as hf
from tools.loops.film import SIZE, TICK, Shot

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
import chromium

STILL_MS = 2600


def shots(count: int = 24) -> Iterator[Shot]:
    """Locked, along the self-motion, locked again, and back."""
    with tempfile.TemporaryDirectory() as folder, chromium.opened() as browser:
        file = Path(folder) / "page.html"
        hf.arms.load("panda").page(file)
        viewport = {"width": SIZE[0], "height": SIZE[1]}
        page = browser.new_context(viewport=viewport, bypass_csp=True).new_page()
        page.goto(file.as_uri())
        page.wait_for_selector(".view3d-drawn")
        page.add_style_tag(content=".arm-about, .view3d-controls, .view3d-hint { display: none; }")

        def show(step: str, ms: int) -> Shot:
            page.locator(f'[data-step="{step}"]').click()
            return take(ms)

        def take(ms: int) -> Shot:
            page.evaluate("() => new Promise(f => requestAnimationFrame(() => requestAnimationFrame(f)))")
            return Image.open(BytesIO(page.screenshot())).convert("RGB"), ms

        page.locator('[data-step="prepare"]').click()
        start, best = page.evaluate("(() => { const { motion } = document.querySelector('.arm').armPage.steps.prepare;"
                                    " return [motion.start, motion.best]; })()")  # fmt: skip
        way = np.unique(np.linspace(start, best, count).round().astype(int))[:: 1 if start < best else -1]
        yield show("lock", STILL_MS)
        for ends, ms in ((way, TICK), (way[::-1], TICK // 2)):
            page.locator('[data-step="prepare"]').click()
            for index in ends.tolist():
                slider = page.locator(".step-controls input[type=range]").first
                slider.evaluate("(e, x) => { e.value = x; e.dispatchEvent(new Event('input')); }", index)
                yield take(ms)
            if ends is way:
                yield show("lock", STILL_MS)
