"""Ctrl-C, wherever it finds the program: it ends soon, with exit code 130 and one line."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

COMMAND = ["simulate", "planar-3r", "--start", "0.3 0.5 0.7", "--target", "1.5,1.5", "--lock", "2"]

# Ctrl-C when a module begins to be imported.
IMPORT = """
import os, signal, sys
class Interrupted:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            sys.meta_path.remove(self)
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupted())
"""
# The same, and the importer does what foreign ones were seen to do with the exception.
SWALLOWED = """
import os, signal, sys, time
class Interrupted:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            sys.meta_path.remove(self)
            try:
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(1)
            except BaseException:
                {then}
sys.meta_path.insert(0, Interrupted())
"""
# Ctrl-C while the main thread is not in Python, and another thread computes on.
BUSY = """
import concurrent.futures, hashlib, os, signal, threading
from holdfast.control.simulation import closed_loop as place
def long(): hashlib.pbkdf2_hmac("sha256", b"", b"", {rounds})
def simulate(*_, **__):
    concurrent.futures.ThreadPoolExecutor().submit(long)
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    {work}
place.simulate = simulate
"""
DESTRUCTOR = """
import os, signal, time
from holdfast.control.simulation import closed_loop as place
class Last:
    def __del__(self): os.kill(os.getpid(), signal.SIGINT); time.sleep(1)
def simulate(*_, **__):
    Last()
    time.sleep(600)
place.simulate = simulate
"""


def ended(before, command=COMMAND):
    """Exit code and stderr of a simulation in a process in which ``before`` was run."""
    done = subprocess.run(
        [sys.executable, "-c", f"{before}\nfrom holdfast.interface.cli import main\nmain()", *command],
        capture_output=True,
        text=True,
        timeout=120,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize(
    "module", ["holdfast.interface.cli.program", "typer", "numpy", "holdfast.interface.cli.options", "casadi", "rich.table"]
)
def test_while_modules_are_imported(module):
    assert ended(IMPORT.format(module=module)) == (130, "holdfast: stopped\n")


@pytest.mark.parametrize("then", ["pass", "raise ImportError('no module')", "time.sleep(600)"])
@pytest.mark.parametrize("module", ["numpy", "casadi"])
def test_what_a_foreign_module_makes_of_it_does_not_matter(module, then):
    long = ["assess", "pa10-9dof", "--poses", "1000000"]  # what is over before the watcher looks is over
    code, said = ended(SWALLOWED.format(module=module, then=then), long)
    assert (code, said) == (130, "holdfast: stopped\n")


def test_threads_that_compute_are_not_waited_for():
    rounds = 2_000_000_000  # half an hour
    assert ended(BUSY.format(rounds=rounds, work="threading.Event().wait()")) == (130, "holdfast: stopped\n")


def test_a_main_thread_that_is_not_in_python():
    rounds = 2_000_000_000
    assert ended(BUSY.format(rounds=rounds, work="long()")) == (130, "holdfast: stopped\n")


def test_a_destructor_does_not_lose_it():
    assert ended(DESTRUCTOR) == (130, "holdfast: stopped\n")


def test_a_program_whose_starter_has_it_ignored_goes_on():
    done = subprocess.run(
        [sys.executable, "-c", f"{IMPORT.format(module='numpy')}\nfrom holdfast.interface.cli import main\nmain()", "arms"],
        capture_output=True,
        text=True,
        timeout=120,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "panda" in done.stdout
