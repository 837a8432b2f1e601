"""One browser for all tests of a process, and servers as people start them."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest

import chromium
from browser.line import Line
from browser.station import OPERATOR
from holdfast.teleop.protocol.protocol import Protocol, Training, read_protocol
from holdfast.teleop.trials.scenarios import Scenario
from holdfast.teleop.trials.stick import Joystick

# Every second picture: to draw is most of what a page costs here.
HALF = """
const whole = window.requestAnimationFrame.bind(window);
window.requestAnimationFrame = (draw) => whole(() => whole(draw));
"""


# Not for the whole session: Playwright keeps an event loop running, and other tests begin their own.
@pytest.fixture(scope="package")
def browser() -> Iterator:
    with chromium.opened(chromium.required) as opened:
        yield opened


@pytest.fixture(scope="package")
def protocol() -> Protocol:
    """Two short and easy tasks, healthy and failed, quickly compiled; 0.9 m/s at the most."""
    whole = read_protocol()
    tasks = whole.tasks.take(np.array([0, 1]))
    starts = whole.plants[0].position(tasks.q0)
    tasks.target[:] = starts + 0.35 * (tasks.target - starts)
    return replace(
        whole.with_tasks(tasks),
        rate=60.0,
        substeps=1,
        stick=Joystick(0.015, 0.0015),
        radius=0.12,
        subjects=12,
        training=Training(at_least=1, in_a_row=1, limit=6000.0, most=100, distance=0.7),
        scenarios=tuple(Scenario(k + 1, "pseudoinverse", failed) for k, failed in enumerate((False, True))),
    )


@dataclass(frozen=True)
class Served:
    """An experiment that is served: its folder, and the addresses that the command printed."""

    folder: Path
    station: str
    experimenter: str

    @classmethod
    def of(cls, folder: Path, process: subprocess.Popen[str]) -> Served:
        """What a server that has just been started says of itself."""
        assert process.stdout is not None
        station, experimenter = (re.sub(r"^\w+:\s+", "", process.stdout.readline()).strip() for _ in range(2))
        return cls(folder, station, experimenter)

    @property
    def port(self) -> int:
        port = urlsplit(self.station).port
        assert port is not None
        return port


def command_line(folder: Path, *options: str) -> list[str]:
    """'holdfast teleop serve' at any port that is free."""
    return [sys.executable, "-m", "holdfast", "teleop", "serve", "--data", str(folder), "--port", "0", *options]


@pytest.fixture(scope="package")
def serve(tmp_path_factory: pytest.TempPathFactory) -> Iterator:
    """``serve(protocol, *options)``: 'holdfast teleop serve' in a process of its own."""
    running: list[subprocess.Popen[str]] = []

    def served(protocol: Protocol, *options: str, folder: Path | None = None) -> Served:
        if folder is None:
            new = tmp_path_factory.mktemp("served")
            folder, options = new / "experiment", (*options, "--protocol", str(protocol.write(new / "protocol.yaml")))
        process = subprocess.Popen(command_line(folder, *options), stdout=subprocess.PIPE, text=True)
        running.append(process)
        return Served.of(folder, process)

    yield served
    for process in running:
        process.terminate()
        process.wait()
        process.stdout.close()  # type: ignore[union-attr]


@pytest.fixture(scope="package")
def experiment(serve, protocol) -> Served:
    """One that the tests share, each with subjects of its own."""
    return serve(protocol, "--tlx")


@pytest.fixture
def contexts(browser) -> Iterator:
    """``contexts(expected)``: a browser's profile; in the end, that nothing but the server was asked, and nothing went wrong.

    Errors in the console that ``expected`` is found in are none.
    """
    opened = []
    asked: list[str] = []
    troubles: list[str] = []

    def context(expected: str | None = None):
        made = browser.new_context(viewport={"width": 640, "height": 400})
        made.set_default_timeout(60_000)
        made.add_init_script(path=OPERATOR)
        made.add_init_script(HALF)
        made.on("request", lambda request: asked.append(request.url))
        made.on("page", lambda page: page.on("websocket", lambda socket: asked.append(socket.url)))
        made.on("weberror", lambda error: troubles.append(str(error.error)))

        def heard(message) -> None:
            if message.type in ("error", "warning") and not (expected is not None and expected in message.text):
                troubles.append(message.text)

        made.on("console", heard)
        opened.append(made)
        return made

    yield context
    for made in opened:
        made.close()
    assert troubles == []
    assert {urlsplit(url).hostname for url in asked} <= {"127.0.0.1"}


@pytest.fixture
def line(experiment) -> Iterator[Line]:
    """To the shared server; a test can cut it."""
    with_end = Line(experiment.port)
    yield with_end
    with_end.close()
