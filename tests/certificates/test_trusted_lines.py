"""The documentation says how many lines of the verifier one has to trust, for each claim: counted, and seen at work."""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.certificates import verifier

pytest.importorskip("flint", reason="python-flint is not installed")
ROOT = Path(verifier.__file__).parent
MODULES = {"verifier": ROOT / "verifier.py"} | {file.stem: file for file in (ROOT / "verifier_parts").glob("*.py")}
PAGE = (Path(__file__).parents[2] / "docs" / "evidence" / "certificates.md").read_text(encoding="utf-8")


def code(file):
    """How many lines there are besides docstrings, comments and blank ones."""
    text, said = file.read_text(encoding="utf-8"), set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node) is not None:
            said |= set(range(node.body[0].lineno, node.body[0].end_lineno + 1))
    lines = ((k, line.strip()) for k, line in enumerate(text.splitlines(), 1) if k not in said)
    return sum(bool(line) and not line.startswith("#") for _, line in lines)


def rows():
    """The table of the page: of each claim its modules, and the number."""
    found = re.findall(r"^\| ([a-z ,]+) \| ((?:`\w+`(?:, )?)+) \| ([\d,]+) \|$", PAGE, re.MULTILINE)
    return {claim: (re.findall(r"`(\w+)`", modules), int(number.replace(",", ""))) for claim, modules, number in found}


def test_the_page_counts_right():
    (whole,) = re.findall(r"it has ([\d,]+) lines of Python", PAGE)
    assert int(whole.replace(",", "")) == sum(map(code, MODULES.values()))
    assert f"These are {whole} lines of code in all" in verifier.__doc__
    common = rows()["all"]
    for claim, (modules, number) in rows().items():
        used = set(modules) | set(common[0])
        assert number == sum(code(MODULES[name]) for name in used), claim
    assert {name for modules, _ in rows().values() for name in modules} == MODULES.keys() - {"__init__"}


def claims():
    three, four, c = hf.arms.load("planar-3r"), hf.arms.load("panda"), hf.certificates
    middle = np.radians([40, 20, -30, -90, 30, 120, 0])
    box = np.column_stack([middle - 0.01, middle + 0.01])
    motion = np.array([0.3, 1.6, 0.7]) + np.linspace(0, 1, 4)[:, None] * [0.2, -1.2, -0.5]
    return {
        "reached": c.reach_claim(three, [1.5, 0.5], 0.1, locked={"joint2": (0.9, 1.0)}),
        "out of reach": c.out_of_reach_claim(three, (2.6, 1.4), 0.1, locked={1: (0.6, 0.8)}),
        "a ceiling": c.ceiling_claim(four, box, 0.3),
        "a floor": c.floor_claim(four, box, 0.01),
        "a structural zero": c.structural_zero_claim(hf.arms.load("iiwa14"), "lbr_iiwa_joint_4"),
        "an arm that holds, or survives a nudge": c.hold_claim(
            four, middle - 0.01, middle + 0.01, friction=hf.Friction(coulomb=90.0)
        ),
        "a path": c.path_claim(three, motion, task="planar", failures=[0]),
    }


@pytest.mark.parametrize("claim", claims())
def test_no_other_module_is_at_work(claim, tmp_path):
    """What is called while a certificate is checked."""
    file, called = hf.certify(claims()[claim]).write(tmp_path / "a.certificate"), set()
    sys.setprofile(lambda frame, *_: called.add(frame.f_code.co_filename))
    try:
        verdict = verifier.verify(file)
    finally:
        sys.setprofile(None)
    assert verdict.rejected == 0 < verdict.accepted
    at_work = {name for name, path in MODULES.items() if str(path) in called}
    assert at_work <= set(rows()[claim][0]) | set(rows()["all"][0])
    assert "verifier" in at_work
