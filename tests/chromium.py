"""The Chromium that looks at pages, for tests and for programs that take pictures."""

from __future__ import annotations

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
_SCENES = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]  # drawn by the processor


@contextmanager
def opened(missing: Callable[[str], object] = sys.exit, scenes: bool = False) -> Iterator[Browser]:
    """A headless Chromium.

    Args:
        missing: Is told in one sentence that there is none, and does not return.
        scenes: It draws three-dimensional scenes.
    """
    from playwright.sync_api import sync_playwright

    path = shutil.which("chromium") or shutil.which("google-chrome")
    if path is None:
        missing("pages are looked at in Chromium, and there is no 'chromium' here: apt-get install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=_FLAGS + (_SCENES if scenes else _FLAT))
        yield browser
        browser.close()
