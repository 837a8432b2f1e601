"""What tests, the soak and the guided tour of the studio share."""

from __future__ import annotations

import time


def wait_for(page, condition, seconds=60.0):
    """Let the page live until a condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "the page did not get there in time"
        page.wait_for_timeout(20)


def send(page, file):
    """Select a file in the page, a path or what Playwright takes in its place."""
    page.get_by_role("tab", name="File").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="Open an arm or a motion").click()
    chooser.value.set_files(file)
