"""Which worker of pytest-xdist gets which tests, and in which order: what waits runs beside what computes.

A page in a browser is driven in real time and waits more than it computes. The folders with such tests go to one worker each,
from the beginning, so that the others have the processors meanwhile; every other file goes to the next worker that is free,
those with the most slow tests first, so that no long one is left for the end.
"""

from __future__ import annotations

from collections import Counter
from typing import Any

import pytest

import slow

PAGES = ("tests/browser/", "tests/interface/studio/")


def share_of(nodeid: str) -> str:
    """What one worker runs as a whole: a folder of pages, or a file."""
    return next((folder for folder in PAGES if nodeid.startswith(folder)), nodeid.split("::")[0])


def pytest_collection_modifyitems(config, items):
    if hasattr(config, "workerinput"):
        slow_ones = Counter(name.split("::")[0] for name in slow.listed())

        def place(item) -> tuple[int, int]:
            share = share_of(item.nodeid)
            return (PAGES.index(share), 0) if share in PAGES else (len(PAGES), -slow_ones[share])

        items.sort(key=place)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log) -> Any:
    if config.getvalue("dist") != "loadfile":
        return None
    from xdist.scheduler import LoadFileScheduling

    class Shares(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return share_of(nodeid)

    return Shares(config, log)
