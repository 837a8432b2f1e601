"""The pictures of ``docs/how-to/studio.md``: ``python -m tests.interface.studio.tour docs/how-to/studio``.

The test suite takes the first of them as well, so that the tour cannot fall behind the page.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))
sys.path.insert(0, str(Path(__file__).parent))
from studio_pages import wait_for

import chromium

CRANE = str(Path(__file__).parent / "arms" / "inspection-crane.urdf")
PANDA = (0.0, -0.62, 0.18, -2.33, -0.15, 1.38, 0.73)  # rad
SIZE = {"width": 1200, "height": 780}


def open_page(browser, name, q, **state):
    """A studio of an arm, a page that has opened it, and the window behind."""
    from holdfast import arms
    from holdfast.interface.studio import State, serve

    arm = arms.load(name)
    served = serve(arm, State(name, arm.joint_names, tuple(float(x) for x in q), **state), port=0)
    page = browser.new_context(viewport=SIZE).new_page()
    page.set_default_timeout(120_000)
    page.goto(served.url)
    wait_for(page, lambda: bool(served.windows), 120)
    window = next(iter(served.windows.values()))
    window.wait_until_done(180)
    close = page.get_by_role("alert").get_by_role("button")  # the browser says that it draws without a graphics card
    if close.count():
        close.first.click()
    return served, page, window


def take(page, window, tab, file, *, down_to=None):
    """A screenshot of a tab, once the page has drawn what the window shows; scrolled down to the last such element."""
    window.wait_until_done(240)
    page.get_by_role("tab", name=tab).click()
    if down_to is not None:
        page.locator(down_to).last.scroll_into_view_if_needed()
    page.evaluate("() => new Promise(f => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(f))))")
    page.wait_for_timeout(1200)
    page.screenshot(path=file)


def panda_start(browser, folder):
    """What one sees first, and a joint that locks."""
    served, page, window = open_page(browser, "panda", PANDA)
    take(page, window, "Move", folder / "panda-start.png")
    window.request_action("fail", (3, "locked"))
    take(page, window, "Fail", folder / "panda-locked.png")
    return served, page, window


def panda_rest(served, page, window, folder):
    """Best and worst, two laws, a region."""
    from holdfast.model.arm.poses import pose_numbers

    window.request_action("heal")
    window.request_action("best-worst")
    take(page, window, "Choose", folder / "panda-best-worst.png")
    window.request_action("clear")
    window.request_action("fail", (3, "locked"))
    window.wait_until_done(60)
    hand = pose_numbers(window.machine.tool_pose(window.q))
    goal = (hand[0] - 0.15, hand[1] + 0.25, hand[2] + 0.1, *hand[3:])
    window.live.submit("goal", lambda: setattr(window, "state", replace(window.state, target=goal)))
    window.request_action("target")
    window.request_action("laws")
    window.wait_until_done(240)
    window.request_action("time", 12.0)
    take(page, window, "Motion", folder / "panda-two-laws.png")
    window.request_action("clear")
    window.request_action("heal")
    window.request_action("region")
    window.wait_until_done(240)
    best = int(np.nanargmax(window.cloud.values))
    window.request_action("point", best)
    take(page, window, "Region", folder / "panda-region.png")
    served.stop()


def pa10(browser, folder):
    """Ten parts, nine joints, and a joint that lets go."""
    from holdfast import arms

    q = np.array(arms.about("pa10-9dof").home)
    served, page, window = open_page(browser, "pa10-9dof", q + 0.2 * np.sin(np.arange(q.size)), index="minimum-singular-value")
    take(page, window, "Choose", folder / "pa10-bars.png")
    window.request_action("slide", 0.6)
    page.wait_for_timeout(1500)
    window.request_action("slide", 0.0)
    take(page, window, "Move", folder / "pa10-self-motion.png")
    served.stop()


def watching(browser, folder):
    """A joint locks while the arm moves, and a monitor names it."""
    served, page, window = open_page(browser, "panda", PANDA, task="position")
    page.get_by_role("tab", name="Watch").click()
    button = page.get_by_role("button", name="Move, fail and watch")
    wait_for(page, button.is_enabled)
    button.click()
    wait_for(page, lambda: window.monitor_demo is not None)
    window.request_action("time", 1.6)
    wait_for(page, lambda: page.locator(".hf-watch[data-alarm]").count() == 1)
    take(page, window, "Watch", folder / "panda-watch.png", down_to=".hf-watch li")
    served.stop()


def crane(browser, folder):
    """An arm of one's own, with the shapes of its file; a joint that lets go."""
    served, page, window = open_page(browser, CRANE, (0.1, 0.5, 0.3, 1.2, 0.4, 0.7, 0.2))
    window.request_action("fail", (2, "free"))
    window.wait_until_done(60)
    window.request_action("fall")
    window.wait_until_done(240)
    window.request_action("time", 0.35)
    take(page, window, "Fail", folder / "crane-fall.png")
    served.stop()


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    with chromium.opened(scenes=True) as browser:
        panda_rest(*panda_start(browser, folder), folder)
        pa10(browser, folder)
        watching(browser, folder)
        crane(browser, folder)
    for file in sorted(folder.glob("*.png")):
        print(file)


if __name__ == "__main__":
    main()
