"""What a person meets in the first five minutes: buttons that can do something, the tour, files, a phone, a dark room."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from studio_pages import send, wait_for

import axe

PLANAR = {"task": "planar"}
Q = (0.3, 0.8, 0.9)
ONE = {  # a button by which a tab is known
    "Move": "Back to the start",
    "Fail": "All healthy",
    "Choose": "Take the green one",
    "Motion": "Choose a target",
    "Region": "Assess around the tool",
    "File": "PNG of the scene",
}
VISER = ("Save Canvas", "Reset View", "Reset Panel Layout")
CRANE = Path(__file__).parent / "arms" / "inspection-crane.urdf"
ASLEEP = {  # in the first state: what there is nothing to do for
    "Move": ["Back to the start"],
    "Fail": ["All healthy"],
    "Choose": ["Take the green one", "Take the orange one", "Clear"],
    "Motion": ["Move under both laws", "Play", "Clear"],
    "Region": ["Clear"],
    "File": [],
}
FILES = ("PNG of the scene", "SVG drawing, side and top view")
DROP = """([name, text]) => { const data = new DataTransfer(); data.items.add(new File([text], name));
    document.body.dispatchEvent(new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true})); }"""


def said(page):
    return page.locator("[data-message]").first.inner_text()


def buttons(page, tab):
    """The buttons of a tab, each with its label."""
    page.get_by_role("tab", name=tab).click()
    wait_for(page, lambda: any(x.is_visible() for x in page.get_by_role("button", name=ONE[tab]).all()))
    shown = ((x.inner_text(), x) for x in page.query_selector_all("button") if x.is_visible())
    return [(name, x) for name, x in shown if name and name not in ("Take the 60-second tour", *VISER)]


def test_every_button_of_the_first_state_does_something_or_is_asleep(studio, visit):
    page, window = visit(studio("planar-3r", q=Q, **PLANAR))
    page.wait_for_selector("[data-worst]")
    wait_for(page, lambda: page.get_by_role("button", name="Take the 60-second tour").is_enabled())

    def calm():
        assert window.wait_until_done(60)
        wait_for(page, lambda: "..." not in said(page))
        assert page.locator("[data-bad]").count() == 0, said(page)

    for tab in ONE:
        found = buttons(page, tab)
        wait_for(page, lambda tab=tab, found=found: [name for name, x in found if not x.is_enabled()] == ASLEEP[tab])
        assert axe.serious(page) == []
        for name, button in [(name, x) for name, x in found if x.is_enabled()]:
            before = window.updates
            if name in FILES:
                with page.expect_download(timeout=60_000):
                    button.click()
            elif name == "Open an arm or a motion":
                with page.expect_file_chooser():
                    button.click()
            elif name.startswith("✓"):
                wait_for(page, lambda button=button: button.get_attribute("aria-pressed") == "true")
                button.click()
            else:
                button.click()
                wait_for(page, lambda before=before: window.updates > before)
            calm()
            window.player.pause()
            for what in ("clear", "heal", "home"):
                window.request_action(what)
            calm()
    # What a client asks that does not keep to its buttons is said, not done.
    for joint in range(3):
        window.request_action("fail", (joint, "locked"))
    window.request_action("fall")
    wait_for(page, lambda: page.locator("[data-bad]").count() == 1)
    assert "All joints are locked" in said(page)
    window.request_action("take0")
    wait_for(page, lambda: "no such ghost arm" in said(page))


def test_buttons_wake_when_they_can_work_and_toggles_show_the_state(studio, visit):
    page, window = visit(studio("planar-3r", q=Q, **PLANAR))
    buttons(page, "Fail")
    page.get_by_role("button", name="free", exact=True).nth(1).click()
    wait_for(page, lambda: page.get_by_role("button", name="✓ free").count() == 1)
    wait_for(page, lambda: page.get_by_role("button", name="✓ free", pressed=True).count() == 1)
    wait_for(page, lambda: page.get_by_role("button", name="healthy", exact=True, pressed=False).count() == 1)
    assert window.stage._joint_labels[1].text == "2 free"
    wait_for(page, page.get_by_role("button", name="Cut the power").is_enabled)
    page.get_by_role("button", name="All healthy").click()
    wait_for(page, lambda: page.get_by_role("button", name="✓ healthy").count() == 3)
    window.request_action("best-worst")
    assert window.wait_until_done(60)
    wait_for(page, lambda: dict(buttons(page, "Choose"))["Take the orange one"].is_enabled())
    assert not window.panel.slide.disabled
    for k in range(2):
        window.request_action("fail", (k, "locked"))
    assert window.wait_until_done(60)
    assert window.panel.slide.disabled  # no self-motion is left
    wait_for(page, lambda: not dict(buttons(page, "Choose"))["Take the orange one"].is_enabled())


def test_the_tour_on_a_phone_in_the_dark(studio, visit):
    page, window = visit(studio("planar-3r", q=Q, **PLANAR), 390, 780, color_scheme="dark")
    assert page.locator("html[data-mantine-color-scheme=dark]").count() == 1
    page.get_by_role("button", name="Take the 60-second tour").click()
    worst = window._reading.bars.worst

    def step(number):
        wait_for(page, lambda: page.locator(f"[data-tour='{number}']").count() == 1)
        assert window.wait_until_done(60)
        assert page.locator("[data-bad]").count() == 0, said(page)
        text = page.inner_text("[data-tour]")
        page.get_by_role("button", name="Done" if number == 6 else "Next").click()  # asleep until the step has been done
        return text

    first = np.array(window.q)
    assert window.state.names[worst] in step(1)
    wait_for(page, lambda: window.state.failed_joints == (worst,))
    assert "is locked" in step(2)
    wait_for(page, lambda: len(window.player.ghosts) == 2)
    assert window.state.failed_joints == ()
    better = window.player.ghosts[0]
    step(3)
    wait_for(page, lambda: window.state.failed_joints == (worst,))
    np.testing.assert_array_equal(window.q, better)
    np.testing.assert_allclose(window.machine.tool_pose(better)[:2, 3], window.machine.tool_pose(first)[:2, 3], atol=1e-6)
    assert "of the manipulability remains, compared with" in step(4)
    wait_for(page, lambda: window.state.show == "laws" and len(window.player.ghosts) == 2)
    step(5)
    wait_for(page, lambda: np.array_equal(window.q, first))
    assert (window.state.show, window.state.failed_joints) == ("arm", ())
    step(6)
    wait_for(page, lambda: page.locator("[data-tour]").count() == 0)
    # The controls have the whole width, at most the lower half or so, and fold.
    sheet = page.locator(".mantine-Paper-root[style*='bottom: 0']")
    box = sheet.bounding_box()
    assert (box["x"], box["width"]) == (0, 390)
    assert box["height"] <= 0.56 * 780
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    page.get_by_role("button", name="Hide controls").click()
    wait_for(page, lambda: sheet.bounding_box()["height"] < 80)
    assert page.get_by_role("button", name="Show controls").get_attribute("aria-expanded") == "false"
    page.get_by_role("button", name="Show controls").click()
    page.get_by_role("button", name="Take the 60-second tour").wait_for()


def test_an_arm_is_dropped_on_the_page_and_a_bad_file_changes_nothing(studio, visit):
    served = studio("planar-3r", q=Q, **PLANAR)
    page, window = visit(served)
    window.request_action("fail", (1, "locked"))
    assert window.wait_until_done(60)
    before = window.state
    page.evaluate(DROP, ["<b>x</b>.urdf", "<robot name='x'><link name='a'/></robot>"])
    wait_for(page, lambda: "no moving joint" in said(page))
    assert "nothing has changed" in said(page)
    # It stands out, and nothing beside it says that all went well.
    page.locator(".hf-alert").filter(has_text="no moving joint").wait_for()
    page.get_by_text("File received. The line above the controls").first.wait_for()
    assert page.get_by_text("successfully").count() == 0
    page.evaluate(DROP, ["notes.txt", "x"])
    wait_for(page, lambda: "cannot be opened here" in said(page))
    page.locator(".hf-alert").filter(has_text="cannot be opened here").wait_for()
    page.evaluate(DROP, ["big.urdf", " " * (4 * 2**20 + 1)])
    page.get_by_role("alert").filter(has_text="too large").wait_for()
    assert window.state == before
    send(page, CRANE)
    wait_for(page, lambda: served.windows.get(window.client.client_id, window) is not window)
    other = served.windows[window.client.client_id]
    assert other.wait_until_done(60)
    wait_for(page, lambda: "camera.stl" in said(page))
    assert other.state.arm == "inspection-crane.urdf"
    assert sorted(other.stage.figure.joints) == list(range(7))
    page.get_by_role("tab", name="Fail").click()
    page.get_by_role("button", name="locked", exact=True).nth(2).click()
    wait_for(page, lambda: other.state.failed_joints == (2,))
    wait_for(page, lambda: "luff locked" in page.locator("[data-worst]").first.inner_text())
    other.request_action("best-worst")  # in a process of its own
    assert other.wait_until_done(60)
    wait_for(page, lambda: len(other.player.ghosts) == 2)
    [aside] = served._own_processes.values()
    process = aside._process
    page.context.close()
    assert process.wait(20) is not None  # ended with its window
    assert served._own_processes == {}
