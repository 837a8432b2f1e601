"""The steps of docs/project/add-*.md, carried out in a copy: two files and a line each, and everything knows what is new."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = "\n".join(page.read_text(encoding="utf-8") for page in sorted((ROOT / "docs/project").glob("add-*.md")))
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
    section = PAGE.split(f"({anchor})=")[1].split("\n(")[0]
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
        shutil.copytree(ROOT / part, tmp_path / part, ignore=shutil.ignore_patterns("*.egg-info"))  # compiled files too
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    python = f"{tmp_path / 'src'}{os.pathsep}{tmp_path / 'tests'}"
    environment = {**os.environ, "PYTHONPATH": python, "HOLDFAST_BACKEND": "casadi", "NO_COLOR": "1", "COLUMNS": "200"}

    def call(*words):
        done = subprocess.run(
            [sys.executable, "-m", *words], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    return call


def test_all_walks_in_one_copy(run, tmp_path):
    """Two starts of pytest: what is missing is named, and what is complete is known everywhere."""

    def tests(*files, asked):
        code, told = run("pytest", "-q", "-n", "0", "-p", "no:cacheprovider", *files, "-k", " or ".join(asked))
        return code, told

    walks = {name: steps(anchor) for anchor, name, *_ in WALKS.values()}
    for file, _, line in walks.values():
        write(tmp_path, *file)
        write(tmp_path, *line)
    command_file, command_line, command_test = steps("add-a-command")
    write(tmp_path, *command_file)
    registry, imports = "tests/core/test_registry.py", "tests/interface/cli/test_imports.py"
    code, told = tests(registry, imports, asked=["has_an_oracle", "in_the_table"])
    assert code == 1
    for _, name, _, _, kind in WALKS.values():
        assert f"{kind} '{name}' has no oracle: add its value by another route to ORACLES['{kind}'] in tests/oracles.py" in told
    assert "no line of COMMAND_MODULES in src/holdfast/interface/cli/program.py names before.price" in told

    for _, oracle, _ in walks.values():
        write(tmp_path, *oracle)
    section = steps("add-a-report-section")
    for step in (command_line, command_test, *section):
        write(tmp_path, *step)
    values = [
        "tests/kinematics/indices/test_index_values.py",
        "tests/kinematics/indices/test_index_gradients.py",
        "tests/control/laws/test_laws.py",
    ]
    commands = ["tests/interface/cli/test_examples.py", "tests/interface/cli/test_price_command.py"]
    rows = ["against_singular_values and (planar or rows)", "test_laws and rates"]
    asked = [*walks, "oracles_are_of", "what_is_registered", "price", "in_the_table", "lists_every_command", *rows]
    code, told = tests(registry, imports, *values, *commands, section[2][0], asked=[*asked, Path(section[2][0]).stem])
    assert code == 0, told

    for _, name, words, said, _ in WALKS.values():
        code, told = run("holdfast", *words)
        assert code == 0, told
        assert said in told
        assert name in run("holdfast", words[0], "--help")[1]
    code, told = run("holdfast", "assess", "panda", "--task", "position", "--poses", "9", "--out", "results")
    assert code == 0, told
    assert "Distance from the joint limits" in (tmp_path / "results/report.html").read_text(encoding="utf-8")
    code, told = run("holdfast", "price", "planar-3r", "--error", "0.2")
    assert code == 0, told
    assert "pseudoinverse" in told


def test_walk_of_a_fault_kind(run, tmp_path):
    """One file and one line make a fault kind that files, commands, and injectors accept."""
    kind_file, kind_test, kind_line = steps("add-a-fault-kind")
    write(tmp_path, *kind_file)
    write(tmp_path, *kind_test)
    (tmp_path / "faults.yaml").write_text("faults: [{kind: one_sided, remaining: 0.5}]\n", encoding="utf-8")
    draw = ["holdfast", "faults", "draw", "faults.yaml", "--arm", "planar-3r"]
    code, told = run(*draw)
    assert code != 0
    assert "remaining" in told
    write(tmp_path, *kind_line)
    code, told = run("pytest", "-q", "-n", "0", "-p", "no:cacheprovider", kind_test[0], "tests/response/faults/test_kinds.py")
    assert code == 0, told
    code, told = run(*draw)
    assert code == 0, told
    assert "one_sided" in told


# ---- the walk of a claim kind ----------------------------------------------------------------------------------------


def claim_kind_steps():
    """Return where the page says to write the parts of a claim kind, and what."""
    section = PAGE.split("(add-a-claim-kind)=")[1].split("\n(")[0]
    return re.findall(r"^```python\n# ([^\n]+)\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)


def insert_after(folder, where, text):
    """Insert text after the import that the page names; without one, write it as in the other walks."""
    file, marker, module = where.partition(", after the import from ")
    if not marker:
        write(folder, where, text)
        return
    path = folder / file
    source, insertions = re.subn(
        rf"^from {re.escape(module)} import .*\n", lambda line: line[0] + text, path.read_text(encoding="utf-8"), flags=re.M
    )
    assert insertions == 1
    path.write_text(source, encoding="utf-8")


def test_the_walk_of_a_claim_kind(run, tmp_path):
    """Without its entry in the verifier the kind is named; with it the certificate is made, checked, and printed."""
    pytest.importorskip("flint", reason="python-flint is not installed")
    claim, verifier, import_line, entry, exports, test = claim_kind_steps()
    for step in (claim, verifier, exports, test):
        insert_after(tmp_path, *step)
    pytest_words = ("pytest", "-q", "-n", "0", "-p", "no:cacheprovider")
    code, told = run(*pytest_words, "tests/certificates/test_words.py", "-k", "same_kinds")
    assert code == 1
    assert "kind 'radius' is not in both: see CERTIFICATE_KINDS in verifier_parts/kinds.py and the stub of certificates" in told
    for step in (import_line, entry):
        insert_after(tmp_path, *step)
    code, told = run(*pytest_words, "tests/certificates/test_words.py", test[0], "-k", "same_kinds or radius")
    assert code == 0, told

    (tmp_path / "radius.py").write_text(
        "import holdfast as hf\n"
        "proof = hf.certify(hf.certificates.radius_claim(hf.arms.load('planar-3r'), 3.1))\n"
        "proof.write('a.certificate')\n",
        encoding="utf-8",
    )
    code, told = run("radius")
    assert code == 0, told
    code, told = run("holdfast", "certificate", "check", "a.certificate")
    assert code == 0, told
    assert "at most 3.1 m from the origin of joint1" in told
    done = subprocess.run(
        [sys.executable, "-E", "src/holdfast/certificates/verifier.py", "a.certificate"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "Proved: 100 %, undecided: 0 %. Leaves accepted: 1, rejected: 0" in done.stdout
