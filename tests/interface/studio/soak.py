"""Scripted use of the studio for as long as one likes: memory must stay flat.

``python -m tests.interface.studio.soak --minutes 60`` opens the page in a headless Chromium, and drags, fails, chooses, plays,
assesses, and opens and closes windows all that time. It fails if the memory of the server, once warm, grows.
"""

from __future__ import annotations

import argparse
import gc
import resource
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))
import chromium

ALLOWED = 0.05  # growth of the resident memory, as a share, from the first third (warm) to the end
SLACK = 16.0  # MB that are forgiven anyway


def resident() -> float:
    """Resident memory of this process now, MB."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / 1e6
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def one_round(window, page, rng: np.random.Generator, arm) -> None:
    """Everything that a person does, a little of each."""
    from holdfast.model.arm.poses import pose_numbers

    for k in range(60):
        window.request_action("joint", (int(rng.integers(arm.n)), float(rng.uniform(-0.5, 0.5))))
        if k % 10 == 0:
            page.wait_for_timeout(5)
    window.wait_until_done()
    for _ in range(30):
        hand = np.array(pose_numbers(window.machine.tool_pose(window.q)))
        window.request_action("hand", ("update", hand[:3] + rng.normal(0, 0.02, 3), hand[3:]))
        window.wait_until_done()
    k = int(rng.integers(arm.n))
    for condition in ("locked", "free", "healthy"):
        window.request_action("fail", (k, condition))
    window.request_action("index", str(rng.choice(["relative-manipulability", "minimum-singular-value"])))
    window.request_action("best-worst")
    window.wait_until_done(120)
    window.request_action("take0")
    window.request_action("fail", (k, "locked"))
    hand = np.array(pose_numbers(window.machine.tool_pose(window.q)))
    goal = (*(hand[:3] + rng.normal(0, 0.1, 3)).tolist(), *hand[3:].tolist())
    window.wait_until_done(120)
    window.live.submit("goal", lambda: setattr(window, "state", replace(window.state, target=goal)))
    window.request_action("laws", ("pseudoinverse", "damped:0.1"))
    window.request_action("laws")
    window.wait_until_done(120)
    for t in np.linspace(0, 3, 20):
        window.request_action("time", float(t))
        window.wait_until_done()
    window.request_action("clear")
    window.request_action("heal")
    window.request_action("region")
    page.wait_for_timeout(50)
    window.request_action("region")  # the newer one cancels the older
    window.wait_until_done(120)
    window.request_action("point", int(rng.integers(1000)))
    window.request_action("clear")
    window.request_action("home")
    window.wait_until_done(120)


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=60.0)
    options.add_argument("--arm", default="planar-3r")
    chosen = options.parse_args()

    from holdfast import arms
    from holdfast.interface.studio import State, serve

    rng, arm = np.random.default_rng(0), arms.load(chosen.arm)
    state = State(chosen.arm, arm.joint_names, arms.about(chosen.arm).home, task=arms.about(chosen.arm).task)
    sizes: list[tuple[float, float]] = []
    begin = time.monotonic()
    with chromium.opened(scenes=True) as browser, serve(arm, state, port=0) as studio:
        rounds = 0
        while time.monotonic() - begin < 60 * chosen.minutes:
            # A page that is opened and closed again is part of the use; Chromium's own memory is not ours.
            context = browser.new_context(viewport={"width": 640, "height": 480})
            page = context.new_page()
            page.goto(studio.url)
            while not studio.windows:
                page.wait_for_timeout(20)
            window = next(iter(studio.windows.values()))
            window.wait_until_done()
            for _ in range(3):
                one_round(window, page, rng, arm)
                rounds += 1
                gc.collect()
                sizes.append((time.monotonic() - begin, resident()))
                print(f"{sizes[-1][0]:8.0f} s  round {rounds:4d}  {sizes[-1][1]:8.1f} MB  {window.updates} updates", flush=True)
                if time.monotonic() - begin > 60 * chosen.minutes:
                    break
            context.close()
            while studio.windows:
                time.sleep(0.02)
    third = sizes[len(sizes) // 3][1]
    last = float(np.median([size for _, size in sizes[-3:]]))
    print(f"resident after the first third {third:.1f} MB, at the end {last:.1f} MB")
    if last > third * (1 + ALLOWED) + SLACK:
        sys.exit(f"memory grew by {last - third:.1f} MB")


if __name__ == "__main__":
    main()
