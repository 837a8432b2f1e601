"""A joint locks, the lost direction appears, and the optimised configuration with the same tool point keeps it.

The page of an arm in headless Chromium, which the studio shows, too; needs what ``tests/interface/studio`` needs.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

import holdfast as hf
from holdfast.interface.report.palette import INK, ORANGE
from holdfast.kinematics.path_following import GradientProjection
from tools.loops.film import SIZE, TICK, Shot, caption

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
import chromium

START = np.deg2rad([0, 20, 0, -120, 0, 150, 45]) + 0.05 * np.sin(1 + np.arange(7))
JOINT = 1


def climb(arm: hf.Arm, index: hf.indices.Index, q: np.ndarray, count: int) -> np.ndarray:
    """(count, n) from q up the gradient of the index, the tool point still; evenly spaced in joint space."""
    law = GradientProjection(arm, index, gain=3.0, task="position", rate_cap=0.8, period=0.02)
    step, point, way = law.prepare(), arm.forward_kinematics(q)[:3, 3], [q]
    for _ in range(400):
        back = 5.0 * (point - arm.forward_kinematics(way[-1])[:3, 3])
        way.append(way[-1] + law.period * step(way[-1], np.r_[back, 0, 0, 0]))
    best = int(np.argmax(index(np.array(way))))
    path = np.array(way[: best + 1])
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    eased = 0.5 - 0.5 * np.cos(np.linspace(0, np.pi, count))
    return np.stack([np.interp(eased * length[-1], length, column) for column in path.T], axis=1)


def shots(count: int = 32) -> Iterator[Shot]:
    """Locked, sliding, locked again, and back."""
    arm = hf.arms.load("panda")
    index = hf.indices.relative_manipulability(arm, "position")
    way = climb(arm, index, START, count)
    with chromium.opened(scenes=True) as browser, TemporaryDirectory() as folder:
        file = Path(folder) / "panda.html"
        arm.page(file, q=START, task="position")
        page = browser.new_context(viewport={"width": SIZE[0], "height": SIZE[1]}).new_page()

        def shot(q: np.ndarray, text: str, ms: int, locked: bool = False) -> Shot:
            state = f"step=lock&locked={JOINT + 1}" if locked else "step=healthy"
            page.goto("about:blank")
            page.goto(f"{file.as_uri()}#{state}&q={','.join(f'{value:.6f}' for value in q)}")
            page.evaluate("() => new Promise(f => requestAnimationFrame(() => requestAnimationFrame(f)))")
            shown = Image.open(BytesIO(page.screenshot())).convert("RGB")
            return caption(shown, text, color=ORANGE if locked else INK), ms

        left = [f"{100 * index.by_joint(q)[JOINT]:.0f} % of the speed remains" for q in (way[0], way[-1])]
        yield shot(way[0], f"Joint 2 locks: {left[0]}\nalong the orange arrow, which it loses most", 2600, locked=True)
        for q in way:
            yield shot(q, "While healthy: choose a better configuration\nthe tool point stays in place", TICK)
        yield shot(way[-1], f"Joint 2 locks: {left[1]}\nthe same failure, in the optimised configuration", 2600, locked=True)
        for q in way[::-2]:
            yield shot(q, "While healthy\nback to the first configuration", TICK // 2)
