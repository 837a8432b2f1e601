"""Studies on a Dask cluster of separate processes: the same bits, whatever of it is killed."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from toy import cells

from holdfast.core.errors import InputError, StoreError
from holdfast.core.sweeps import Cluster, Study, ThreadRunner, cluster

HERE = str(Path(__file__).parent)


def make(folder, some=None) -> Study:
    return Study.create(folder, "toy", 1, cells=cells() if some is None else some)


def bits(study: Study) -> dict[tuple[int, int], str]:
    return {(k, n): e.digest for k in range(len(study.cells)) for n, e in study.cell_entries(k).items()}


@pytest.fixture(scope="module")
def straight(tmp_path_factory) -> Study:
    """Computed by one thread without a stop."""
    study = make(tmp_path_factory.mktemp("straight") / "s")
    study.run(cells(), ThreadRunner(1))
    return study


class Processes:
    """A scheduler and workers, each a process of its own that may be killed; a new scheduler gets the address of the old."""

    def __init__(self, folder: Path) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self.port}"
        self._folder = folder
        self._running: list[subprocess.Popen] = []
        self.begin()

    def begin(self) -> None:
        self._scheduler = self._start("scheduler", "--port", str(self.port), "--no-dashboard")

    def worker(self, nanny: bool = True) -> None:
        self._start("worker", self.address, "--nthreads", "1", "--nanny" if nanny else "--no-nanny", "--no-dashboard")

    def kill_scheduler(self) -> None:
        self._scheduler.send_signal(signal.SIGKILL)
        self._scheduler.wait(30)

    def end(self) -> None:
        for process in reversed(self._running):
            process.kill()
            process.wait(30)

    def _start(self, what: str, *words: str) -> subprocess.Popen:
        env = {**os.environ, "PYTHONPATH": os.pathsep.join([HERE, *sys.path]), "PYTHONWARNINGS": "ignore"}
        command = [sys.executable, "-m", "dask", what, *words, "--host", "127.0.0.1"]
        with (self._folder / f"log{len(self._running)}").open("w") as log:
            self._running.append(subprocess.Popen(command, env=env, stdout=log, stderr=log, cwd=self._folder))
        return self._running[-1]


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    """A scheduler and a worker."""
    pytest.importorskip("distributed")
    processes = Processes(tmp_path_factory.mktemp("dask"))
    processes.worker()
    yield processes
    processes.end()


@pytest.mark.filterwarnings("default")
def test_the_same_bits_with_one_and_two_workers_and_a_killed_one(tmp_path, straight, dask):
    one = make(tmp_path / "one")
    with Cluster(dask.address, timeout=60) as there:
        assert one.run(cells(), there) == {}
        assert bits(one) == bits(straight)
        dask.worker()
        assert dask.address in there.about
        some = cells(kills=str(tmp_path / "killed"), slow=0.02)
        two = make(tmp_path / "two", some)
        seen = []
        two.run(some, there, lambda *x: seen.append(x), stop=lambda: len(seen) > 4)
        assert not two.is_complete
        two.run(some, there)
    assert (tmp_path / "killed").exists()
    assert bits(two) == bits(straight)
    assert "Dask" in two.runs[0]["on"]


@pytest.mark.filterwarnings("default")
def test_a_killed_scheduler_is_named_and_a_new_one_with_four_workers_finishes(tmp_path, straight, dask, monkeypatch):
    monkeypatch.setattr(cluster, "_SCHEDULER_TIMEOUT_S", 1.0)
    some = cells(slow=0.05)
    study = make(tmp_path / "s", some)

    def kill(done, *_):
        if done == 3:
            dask.kill_scheduler()

    with Cluster(dask.address, timeout=60) as there, pytest.raises(StoreError) as caught:
        study.run(some, there, kill)
    message = str(caught.value)
    assert f"the Dask scheduler at '{dask.address}' is gone; what was committed is safe" in message
    assert "\n" not in message
    left = bits(study)
    assert 3 <= len(left) < 10
    assert left.items() <= bits(straight).items()
    dask.begin()
    for _ in range(4):
        dask.worker(nanny=False)
    four = make(tmp_path / "four", some)
    with Cluster(dask.address, timeout=60) as there:
        there._client.wait_for_workers(4, 60)
        assert study.run(some, there) == {}
        assert four.run(some, there) == {}
    assert bits(study) == bits(four) == bits(straight)
    assert study.verify() == []


@pytest.mark.filterwarnings("default")
def test_schedulers_that_are_none():
    for address, words in (
        ("somewhere", "is not known; give its address"),
        ("local:0", "local:4"),
        ("tcp://127.0.0.1:9", "no Dask scheduler answers"),
    ):
        with pytest.raises(InputError, match=words):
            Cluster(address, timeout=0.5)


def test_without_dask_a_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'holdfast-arms\[cluster\]'"):
        Cluster("local:2")
