"""Which tests ``make check`` leaves out: those in ``slow.txt``, written by ``pytest --write-slow`` from the time they take.

Tests are listed by file and function. What was not run keeps its line; what is new counts as quick.
"""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

LIST = Path(__file__).with_name("slow.txt")
LIMIT = 0.5  # s of processor time, set-up and processes that it starts included
WAIT = 3.0  # s by the clock, for what waits for a server or a browser
_TIMES = pytest.StashKey[dict[str, float]]()  # as parts of the limit


def name_of(nodeid: str) -> str:
    """``file::function``, of all its parameters."""
    return nodeid.split("[")[0]


def listed() -> set[str]:
    """The tests that are slow."""
    return set(LIST.read_text(encoding="utf-8").split())


def _is_there(name: str) -> bool:
    file, function = name.split("::")
    path = LIST.parents[1] / file
    return path.is_file() and f"def {function}(" in path.read_text(encoding="utf-8")


def _now() -> tuple[float, float]:
    return sum(os.times()[:4]), time.monotonic()


def pytest_addoption(parser):
    parser.addoption("--write-slow", action="store_true", help=f"write the tests above {LIMIT:g} s into {LIST.name}")


def pytest_configure(config):
    config.addinivalue_line("markers", f"slow: took more than {LIMIT:g} s of processor time when last measured; see slow.py")
    config.stash[_TIMES] = {}


def pytest_collection_modifyitems(items):
    slow = listed()
    for item in items:
        if name_of(item.nodeid) in slow:
            item.add_marker("slow")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    begin = _now()
    try:
        return (yield)
    finally:
        processor, clock = (end - start for start, end in zip(begin, _now(), strict=True))
        times = item.config.stash[_TIMES]
        times[name_of(item.nodeid)] = times.get(name_of(item.nodeid), 0.0) + max(processor / LIMIT, clock / WAIT)


def pytest_sessionfinish(session):
    times = session.config.stash[_TIMES]
    if hasattr(session.config, "workerinput"):
        session.config.workeroutput["times"] = times
    elif session.config.getoption("--write-slow"):
        slow = {name for name in listed() if name not in times and _is_there(name)}
        slow |= {name for name, spent in times.items() if spent > 1}
        LIST.write_text("".join(f"{name}\n" for name in sorted(slow)), encoding="utf-8")


def pytest_testnodedown(node):
    times = node.config.stash[_TIMES]
    for name, spent in getattr(node, "workeroutput", {}).get("times", {}).items():
        times[name] = times.get(name, 0.0) + spent
