"""Shared fixtures: a seeded generator, a kernel cache of our own, a few arms."""

from __future__ import annotations

import gc
import os
import shutil
import sys
import tempfile
import zlib
from pathlib import Path

import hypothesis
import numpy as np
import pytest

import chromium
import holdfast as hf
import oracles
from holdfast import arms, control
from holdfast.kernels import set_backend, set_threads

# No test asks how long something takes: on a busy machine hypothesis would call it a failure.
hypothesis.settings.register_profile("holdfast", deadline=None)
hypothesis.settings.load_profile("holdfast")

pytest_plugins = ["slow", "workers"]
gc.set_threshold(50_000)  # of 700: looking for circles again and again is a twelfth of the time

_DRAW = 20120831
_MADE: list[str] = []
# Every kind of page is drawn in these.
PAGES = (
    "tests/interface/report/",
    "tests/interface/presentation/",
    "tests/studies/assessment/",
    "tests/teleop/test_analysis.py",
    "tests/test_papers",
)
_LAID_OUT = [True]
# Solvers that are kept for an arm. Built-in arms are the same objects in every test, so one that was made on CasADi's machine
# would serve later tests too, and differ in the last bits from what these compile; so would kernels that the arms keep.
_KEPT = {
    "solvers.inverse_kinematics": "_cached_solver",
    "solvers.self_motions": "_cached_tracer",
    "reach.extrema": "_cached_critical_points",
}
_INTERPRETED = [False]


def pytest_addoption(parser):
    parser.addoption(
        "--draw", type=int, default=_DRAW, metavar="SEED", help=f"seed of all random test inputs (default {_DRAW})"
    )
    parser.addoption(
        "--write-help", action="store_true", help="write the help pages that tests/interface/cli/test_help.py compares with"
    )


def pytest_configure(config):
    # Workers of pytest-xdist inherit the folder and share what is compiled; only the process that made it removes it.
    if not hasattr(config, "workerinput"):
        folder = os.environ.get("HOLDFAST_TESTS_CACHE")
        if not folder:
            folder = tempfile.mkdtemp(prefix="holdfast-tests-")
            _MADE.append(folder)
        os.environ["HOLDFAST_CACHE"] = folder
    config.addinivalue_line("markers", "interpreted: kernels made in the test run on CasADi's machine; for arms of its own.")
    config.addinivalue_line("markers", "gpu: needs an NVIDIA GPU and its driver.")
    config.addinivalue_line("markers", "rough: figures of its pages are not laid out; others of their kind are.")
    # Node is installed beside Python, whether or not the environment was activated.
    os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    os.environ["HOLDFAST_NOTICES"] = "off"  # they depend on how long something takes
    os.environ["_TYPER_FORCE_DISABLE_TERMINAL"] = "1"  # colours where tests run as a job of GitHub
    for name in ("HOLDFAST_BACKEND", "HOLDFAST_THREADS", "COLUMNS", "FORCE_COLOR", "TERMINAL_WIDTH", "TTY_COMPATIBLE"):
        os.environ.pop(name, None)
    _lay_out_where_pages_are_the_subject()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    # Matplotlib takes as long to lay a figure out as to draw it; where pages are not the subject nobody looks at the layout.
    _LAID_OUT[:] = [item.nodeid.startswith(PAGES) and item.get_closest_marker("rough") is None]
    if _INTERPRETED[0] and item.get_closest_marker("interpreted") is None and "HOLDFAST_BACKEND" not in os.environ:
        _forget_what_arms_keep()
    return (yield)


def _forget_what_arms_keep() -> None:
    _INTERPRETED[:] = [False]
    for module, name in _KEPT.items():
        if (found := sys.modules.get(f"holdfast.{module}")) is not None:
            getattr(found, name).cache_clear()
    for name in arms.names():
        arm = arms.load(name)
        for kept in vars(arm).keys() - arm.__getstate__().keys():
            del vars(arm)[kept]


def _lay_out_where_pages_are_the_subject() -> None:
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    whole = ConstrainedLayoutEngine.execute

    def execute(engine, figure):
        if _LAID_OUT[0]:
            whole(engine, figure)

    ConstrainedLayoutEngine.execute = execute


def pytest_collection_finish():
    gc.collect()
    gc.freeze()  # modules and tests stay to the end: nobody looks for circles in them


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item):
    # Compiling for arms that a test makes, asks about a few rows and throws away takes nearly all of its time.
    with pytest.MonkeyPatch.context() as patch:
        if item.get_closest_marker("interpreted") and not os.environ.get("HOLDFAST_COMPILED"):
            patch.setenv("HOLDFAST_BACKEND", "casadi")
        try:
            return (yield)
        finally:
            _INTERPRETED[0] |= "HOLDFAST_BACKEND" in os.environ


def pytest_unconfigure(config):
    for folder in _MADE:
        shutil.rmtree(folder, ignore_errors=True)


def pytest_report_header(config):
    return f"holdfast: random inputs from --draw {config.getoption('--draw')}"


def pytest_terminal_summary(terminalreporter):
    blind = [report for report in terminalreporter.stats.get("skipped", ()) if chromium.NONE in str(report.longrepr)]
    if blind:
        sentence = str(blind[0].longrepr[2]).removeprefix("Skipped: ")
        terminalreporter.write_line(f"NO BROWSER, {len(blind)} TESTS SKIPPED: {sentence}", red=True, bold=True)


@pytest.fixture(scope="session")
def generator(request):
    """``generator(name)``: a generator for fixtures that live longer than one test."""
    seed = request.config.getoption("--draw")
    return lambda name: np.random.default_rng([seed, zlib.crc32(name.encode())])


@pytest.fixture
def rng(request, generator):
    """A generator of this test alone: its numbers do not depend on which other tests run."""
    return generator(request.node.nodeid)


@pytest.fixture
def threads():
    """``set_threads``, put back afterwards."""
    yield set_threads
    set_threads(None)


@pytest.fixture
def gpu(monkeypatch):
    """Two GPUs that are none, for ``kernels.set_backend("cuda")``; a :class:`fake_driver.FakeDriver`."""
    from fake_driver import FakeDriver
    from holdfast.kernels.gpu import driver, launch

    fake = FakeDriver()
    monkeypatch.setattr(driver, "_driver_functions", lambda: fake)
    monkeypatch.setattr(launch, "make_ptx", fake.ptx)
    driver.get_device.cache_clear()
    yield fake
    set_backend(None)
    if fake.live:
        gc.collect()
    assert not fake.live, "memory on the device that nobody gave back"
    driver.get_device.cache_clear()


@pytest.fixture(scope="session")
def pa10() -> hf.Arm:
    """The 9-joint PA10 of the paper, typed in from its Table I, not taken from the library."""
    return oracles.pa10_nine()


@pytest.fixture(scope="session")
def pa10_7() -> hf.Arm:
    return arms.load("pa10-7dof")


@pytest.fixture(scope="session")
def three() -> control.Pseudoinverse:
    """The pseudoinverse of the arm of the published examples."""
    return control.Pseudoinverse(arms.load("planar-3r"), "planar")


@pytest.fixture(scope="session")
def mixed5(generator) -> hf.Arm:
    """Five joints, one of them sliding: small enough for many compilations."""
    return oracles.random_arm(generator("mixed5"), types="RPRRR", limits=2.0)


@pytest.fixture(scope="session")
def mixed7(generator) -> hf.Arm:
    """Seven joints, one of them sliding, nothing aligned."""
    return oracles.random_arm(generator("mixed7"), types="RRPRRRR", limits=2.0)


@pytest.fixture(scope="session")
def mixed8(generator) -> hf.Arm:
    """Eight joints, two of them sliding, nothing aligned."""
    return oracles.random_arm(generator("mixed8"), types="RPRRRPRR", limits=2.0)


@pytest.fixture(scope="session")
def planar4(generator) -> hf.Arm:
    """Four parallel axes in a tilted plane."""
    return oracles.planar_arm(generator("planar4"), 4)


@pytest.fixture(scope="session")
def flat4() -> hf.Arm:
    """Four parallel axes along the world's z, links of 1, 0.8, 0.6 and 0.4 m: straight and singular at q = 0."""
    return hf.Arm.from_dh([hf.DH(a=a, alpha=0.0) for a in (1.0, 0.8, 0.6, 0.4)], name="flat4")
