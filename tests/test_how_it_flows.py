"""The steps of docs/project/how-it-flows.md: each function exists in the named file, and the calls happen in that order."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs/project/how-it-flows.md").read_text(encoding="utf-8")
STEP = re.compile(r"^\d+\. `(holdfast\.[\w.]+)`\s+\(`(src/holdfast/[\w/]+\.py)`\)", re.MULTILINE)
WALKS = dict(part.split("\n", 1) for part in PAGE.split("\n## ")[1:])
SETUP = """
import numpy as np
import holdfast as hf
arm = hf.arms.load("panda")
law = hf.control.damped(arm, 0.02, task="position", gain=2.0, speed_limit=0.25)
start, goal = [0.0, 0.0, 0.0, -1.5, 0.0, 1.5, 0.0], [0.3, 0.4, 0.6]
"""
CALLS = {
    "An assessment": "hf.assess(arm, poses=20)",
    "A simulated motion": "hf.simulate(law, start, goal, locked=[1])",
    "A motion with a fault": (
        'hf.simulate_faults(law, start, goal, faults=[hf.faults.FaultEvent("locked", arm.joint_names[2], 0.05)],'
        ' react="known", plan=False, time_limit=0.2)'
    ),
}
FILE_LIMITS = {"An assessment": 8, "A simulated motion": 5, "A motion with a fault": 8}  # files that explain the call
# The threads of a pool are traced only where the profile is set before they start, so each call has its own process.
TRACE = """
import sys, threading
from test_how_it_flows import find_code
names = {find_code(name): name for name in sys.argv[1:]}
def trace(frame, event, argument):
    if event == "call" and frame.f_code in names:
        called.append(names[frame.f_code])
called = []
threading.setprofile(trace)
sys.setprofile(trace)
%s
sys.setprofile(None)
print(*called, sep="\\n")
"""


def find_code(name):
    """Return the code object of a function by its dotted name, without decorators."""
    parts = name.split(".")
    for count in range(len(parts) - 1, 0, -1):
        try:
            found = import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            found = getattr(found, part)
        while hasattr(found, "__wrapped__"):
            found = found.__wrapped__
        return found.__code__
    raise LookupError(name)


def test_an_assessment_is_in_at_most_eight_files(tmp_path):
    """Every function of the package that runs is in a file that the page names."""
    named = set(re.findall(r"`(src/holdfast/[\w/]+\.py)`", WALKS["An assessment"]))
    assert len(named) <= 8
    package = ROOT / "src/holdfast/studies/assessment"
    code = f"""import sys, threading
{SETUP}
files = set()
def trace(frame, event, argument):
    if event == "call" and frame.f_code.co_name != "<module>" and not frame.f_code.co_name[0].isupper():
        files.add(frame.f_code.co_filename)
threading.setprofile(trace)
sys.setprofile(trace)
{CALLS["An assessment"]}
sys.setprofile(None)
print(*files, sep="\\n")
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    used = {Path(file).resolve() for file in done.stdout.split("\n") if Path(file).resolve().parent == package.resolve()}
    assert {file.relative_to(ROOT.resolve()).as_posix() for file in used} <= named


def test_the_page_has_three_walks_of_eight_to_twelve_steps():
    assert set(WALKS) == set(CALLS)
    for title, text in WALKS.items():
        numbers = [int(number) for number in re.findall(r"^(\d+)\. ", text, re.MULTILINE)]
        assert numbers == list(range(1, len(numbers) + 1)), title
        assert 8 <= len(numbers) <= 12, title
        assert len(STEP.findall(text)) == len(numbers), title


@pytest.mark.parametrize("title", CALLS)
def test_a_call_is_understood_from_few_files(title):
    assert len({file for _, file in STEP.findall(WALKS[title])}) <= FILE_LIMITS[title]


@pytest.mark.parametrize("name", sorted(set(re.findall(r"`(holdfast\.[\w.]+)`", PAGE))))
def test_every_function_of_the_page_exists(name):
    code = find_code(name)
    files = {file for step, file in STEP.findall(PAGE) if step == name}
    assert all(Path(code.co_filename).samefile(ROOT / file) for file in files)


@pytest.mark.parametrize("title", CALLS)
def test_the_functions_are_called_in_this_order(title, tmp_path):
    if title == "A motion with a fault":
        pytest.importorskip("mujoco")
    names = [name for name, _ in STEP.findall(WALKS[title])]
    code = f"import sys\nsys.path.insert(0, {str(Path(__file__).parent)!r})\n{SETUP}{TRACE % CALLS[title]}"
    done = subprocess.run(
        [sys.executable, "-c", code, *names], cwd=tmp_path, capture_output=True, text=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    called = iter(done.stdout.split())
    missing = [name for name in names if name not in called]  # each is searched after the one before
    assert not missing, f"not called, or not in this order: {missing}"
