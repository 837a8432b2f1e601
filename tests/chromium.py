"""The Chromium that looks at pages, for tests and for programs that take pictures."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Browser

# Nothing is asked of other hosts.
_FLAGS = [
    "--no-sandbox",
    "--disable-background-networking",
    "--disable-quic",
    "--no-first-run",
    "--disable-component-update",
    "--disable-sync",
]
_FLAT = ["--disable-gpu"]
# Drawn by the processor. SwiftShader draws the scenes alone: the page around them would cost it more than all scenes of a test.
_SCENES = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing"]


NONE = "pages are looked at in Chromium, and there is none here"


def required(sentence: str) -> None:
    """Tests of pages fail without a browser where ``HOLDFAST_REQUIRE_BROWSER`` is 1, as in CI, and are skipped elsewhere."""
    import pytest

    (pytest.fail if os.environ.get("HOLDFAST_REQUIRE_BROWSER") == "1" else pytest.skip)(sentence)


def path() -> str | None:
    """The system's Chromium; none where Playwright has its own."""
    return next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "google-chrome"))), None)


@contextmanager
def opened(missing: Callable[[str], object] = sys.exit, scenes: bool = False) -> Iterator[Browser]:
    """A headless Chromium: the system's, else the one that Playwright has downloaded.

    Args:
        missing: Is told in one sentence that there is none, and does not return.
        scenes: It draws three-dimensional scenes.
    """
    from playwright.sync_api import Error, sync_playwright

    with sync_playwright() as playwright:
        try:
            browser = playwright.chromium.launch(executable_path=path(), args=_FLAGS + (_SCENES if scenes else _FLAT))
        except Error as error:
            why = " ".join(error.message.split())[:160]
            missing(f"{NONE}: 'apt-get install chromium', or 'playwright install --with-deps chromium' ({why})")
        yield browser
        browser.close()
