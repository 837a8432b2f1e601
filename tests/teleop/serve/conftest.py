"""A small protocol, a page of one line, and servers in processes of their own."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from holdfast.teleop.protocol.protocol import Training, read_protocol
from holdfast.teleop.records.records import Records
from holdfast.teleop.trials.scenarios import Scenario

PROGRAM = Path(__file__).with_name("serve_program.py")


@pytest.fixture(scope="session")
def protocol():
    whole = read_protocol()
    few = whole.with_tasks(whole.tasks.take(np.array([0, 9])), ["a", "b"])
    training = Training(at_least=1, in_a_row=1, limit=80.0, most=3)
    scenarios = tuple(Scenario(k + 1, "pseudoinverse", failed) for k, failed in enumerate((False, True)))  # compiled quickly
    return replace(few, training=training, scenarios=scenarios, subjects=6, cycle_limit=40, substeps=1)


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """A page and its texts: (static folder, texts file)."""
    folder = tmp_path_factory.mktemp("built")
    static = folder / "static"
    static.mkdir()
    (static / "index.html").write_text('<!doctype html><title>page</title><script type="module" src="/station.js"></script>')
    (static / "station.js").write_text("export {};")
    (static / "experimenter.html").write_text("<!doctype html><title>secret</title>")
    (folder / "en.yaml").write_text(
        "title: Welcome\nsubject: Hello {name}\nforms:\n"
        "- {name: consent, title: Consent, text: x, submit: ok, questions: [{name: agree, kind: check, label: I do}]}\n"
    )
    return static, folder / "en.yaml"


@dataclass
class Server:
    """A server that runs."""

    folder: Path
    process: subprocess.Popen[str]
    port: int

    @property
    def url(self) -> str:
        return f"ws://127.0.0.1:{self.port}/session"

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}"


@pytest.fixture(scope="session")
def start(built, protocol):
    """``start(folder, *token)``: serves the experiment in a folder, which is begun if it is not there."""
    running: list[subprocess.Popen[str]] = []

    def serve(folder: Path, *token: str) -> Server:
        if not folder.exists():
            Records.create(folder, protocol).close()
        process = subprocess.Popen(
            [sys.executable, str(PROGRAM), str(folder), *map(str, built), *token], stdout=subprocess.PIPE, text=True
        )
        running.append(process)
        return Server(folder, process, int(process.stdout.readline()))

    yield serve
    for process in running:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.fixture(scope="session")
def server(start, tmp_path_factory):
    """One that tests share, each with subjects of its own."""
    return start(tmp_path_factory.mktemp("served") / "experiment")


@pytest.fixture
def records(protocol, tmp_path):
    with Records.create(tmp_path / "experiment", protocol) as opened:
        yield opened


def dump(folder: Path) -> list[str]:
    """Everything in the records."""
    with Records.open(folder) as opened:
        return list(opened._db.iterdump())
