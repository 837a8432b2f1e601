"""The walks of docs/extending.md, carried out in a copy: two files and a line each, and everything knows what is new."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs/extending.md").read_text(encoding="utf-8")
TABLE = re.compile(r"(\S+), in \w+(?:\[(\".+\")\]|, after (\".+\"))")
INDEX = ["index", "planar-3r", "--task", "planar", "--q", "0.3 0.5 0.7", "--index"]
LAW = ["simulate", "planar-3r", "--start", "0.3 0.5 0.7", "--target", "1.5,1.5", "--lock", "2", "--json", "--law"]
WALKS = {
    "an index": ("add-an-index", "row-speed", [*INDEX, "row-speed:2"], "speed of row 2", "index"),
    "a control law": (
        "add-a-control-law",
        "plain-transpose",
        [*LAW, "plain-transpose:0.5"],
        "plain-transpose",
        "control law",
    ),
}


def steps(anchor):
    """What the page says to write, by where, in its order."""
    section = PAGE.split(f"({anchor})=")[1].split("\n(")[0].split("\n## Kernels")[0]
    blocks = re.findall(r"^```python\n# ([^\n]+)\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)
    assert len(blocks) == 3, "two files and a line"
    return blocks


def write(folder, where, text):
    """A new file, an entry of a table or list, or a line at the end of a stub."""
    if found := TABLE.match(where):
        file = folder / found[1]
        whole, entry = file.read_text(encoding="utf-8"), f"    {found[2] or found[3]}"
        (head,) = [start for start in (f"{entry}: ", f"{entry},") if start in whole]
        first, rest = whole.split(head, 1)
        line, _, others = rest.partition("\n")
        file.write_text(f"{first}{head}{line}\n{text}{others}", encoding="utf-8")
    else:
        file = folder / where
        assert file.exists() == where.endswith(".pyi")
        with file.open("a", encoding="utf-8") as out:
            out.write(text)


@pytest.fixture
def run(tmp_path):
    """A call of a module in a copy of sources and tests: its exit code, and what it said."""
    for part in ("src", "tests"):
        shutil.copytree(ROOT / part, tmp_path / part, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    python = f"{tmp_path / 'src'}{os.pathsep}{tmp_path / 'tests'}"
    environment = {**os.environ, "PYTHONPATH": python, "HOLDFAST_BACKEND": "casadi", "NO_COLOR": "1", "COLUMNS": "200"}

    def call(*words):
        done = subprocess.run(
            [sys.executable, "-m", *words], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    return call


@pytest.mark.parametrize("walk", WALKS)
def test_the_walk(walk, run, tmp_path):
    anchor, name, command, said, kind = WALKS[walk]

    def tests(*chosen, files=()):
        words = ["pytest", "-q", "-n", "0", "-p", "no:cacheprovider", "tests/test_registry.py", *files]
        return run(*words, "-k", " or ".join(chosen))

    file, oracle, line = steps(anchor)
    write(tmp_path, *file)
    write(tmp_path, *line)
    code, told = tests("has_an_oracle")
    assert code == 1
    assert f"{kind} '{name}' has no oracle: add its value by another route to ORACLES['{kind}'] in tests/oracles.py" in told
    write(tmp_path, *oracle)
    # One start of pytest for what the registry asks, and for the values.
    values = {"index": ("tests/indices/test_index_values.py", "tests/indices/test_index_gradients.py")}
    files = values.get(kind, ("tests/control/test_laws.py",))
    asked = "against_singular_values and (planar or rows)" if kind == "index" else "test_laws and rates"
    code, told = tests(name, "oracles_are_of", "what_is_registered", asked, files=files)
    assert code == 0, told
    code, told = run("holdfast", *command)
    assert code == 0, told
    assert said in told
    code, told = run("holdfast", command[0], "--help")
    assert name in told


def test_the_walk_to_a_section_of_the_report(run, tmp_path):
    file, line, test = steps("add-a-report-section")
    for step in (file, line, test):
        write(tmp_path, *step)
    code, told = run("pytest", "-q", "-n", "0", "-p", "no:cacheprovider", test[0])
    assert code == 0, told
    code, told = run("holdfast", "assess", "panda", "--task", "position", "--poses", "9", "--out", "results")
    assert code == 0, told
    assert "How near the joints are to their limits" in (tmp_path / "results/report.html").read_text(encoding="utf-8")


def test_the_walk_of_a_command(run, tmp_path):
    def tests(*chosen):
        return run("pytest", "-q", "-n", "0", "-p", "no:cacheprovider", *chosen)

    file, line, test = steps("add-a-command")
    write(tmp_path, *file)
    code, told = tests("tests/cli/test_imports.py", "-k", "in_the_table")
    assert code == 1
    assert "no line of COMMANDS in src/holdfast/cli/program.py names before.price" in told
    write(tmp_path, *line)
    write(tmp_path, *test)
    chosen = ["tests/cli/test_imports.py", "tests/cli/test_examples.py", "tests/cli/test_price_command.py"]
    code, told = tests(*chosen, "-k", "price or in_the_table or lists_every_command")
    assert code == 0, told
    code, told = run("holdfast", "price", "planar-3r", "--error", "0.2")
    assert code == 0, told
    assert "pseudoinverse" in told
