"""What tests, the soak and the guided tour of the studio share."""

from __future__ import annotations

import time


def wait_for(page, condition, seconds=60.0):
    """Let the page live until a condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "the page did not get there in time"
        page.wait_for_timeout(20)
