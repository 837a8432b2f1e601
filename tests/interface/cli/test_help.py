"""Every help page as it was when somebody looked at it, in windows of two widths; and what a shell is offered.

What changes is looked at, and written anew by ``pytest tests/interface/cli/test_help.py --write-help``.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest
import typer

from holdfast import arms
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY
from holdfast.interface.cli.program import build_app, main

STORED = Path(__file__).parent / "help"


def pages(capsys):
    """Each page under the words that show it."""
    program = typer.main.get_command(build_app())
    groups = {name: getattr(command, "commands", {}) for name, command in program.commands.items()}
    for path in [[], *([name] for name in groups), *([name, part] for name, parts in groups.items() for part in parts)]:
        words = [*path, "--help"]
        program(words, prog_name="holdfast", standalone_mode=False)
        yield " ".join(["holdfast", *words]), capsys.readouterr().out


@pytest.mark.parametrize("width", [80, 120])
def test_every_page_is_as_it_was_seen(width, capsys, monkeypatch, request):
    monkeypatch.setenv("COLUMNS", str(width))
    shown = ""
    for words, text in pages(capsys):
        lines = text.splitlines()
        assert max(map(len, lines)) <= width, words
        assert "…" not in text, words
        # Without the frames of the panels the text is half as long.
        shown += "".join(f"{line}\n" for line in [f"$ {words}", *(re.sub("[│╭╮╰╯]|─{3,}", "", x).rstrip() for x in lines)])
    file = STORED / f"{width}.txt"
    if request.config.getoption("--write-help"):
        file.write_text(shown, encoding="utf-8")
    seen = file.read_text(encoding="utf-8").splitlines()
    assert shown.splitlines() == seen, "look at what differs, then: pytest tests/interface/cli/test_help.py --write-help"


# ---- completion ----------------------------------------------------------------------------------------------------------


@pytest.fixture
def offered(monkeypatch, capsys):
    """What bash is told when the last word is to be completed."""

    def call(*words):
        for name, value in (("COMP_WORDS", " ".join(words)), ("COMP_CWORD", len(words) - 1)):
            monkeypatch.setenv(name, str(value))
        monkeypatch.setenv("_HOLDFAST_COMPLETE", "complete_bash")
        monkeypatch.setattr(sys, "argv", ["holdfast"])
        with pytest.raises(SystemExit):
            main()
        return capsys.readouterr().out.split()

    return call


def test_a_shell_is_offered_names(offered):
    assert offered("holdfast", "convergence") == ["convergence-map"]
    assert offered("holdfast", "study", "me") == ["merge"]
    assert offered("holdfast", "index", "pa") == [name for name in arms.names() if name.startswith("pa")] != []
    assert offered("holdfast", "assess", "panda", "--index", "") == list(INDEX_REGISTRY)
    assert offered("holdfast", "simulate", "panda", "--law", "fail") == ["failure-tolerant"]
    assert set(offered("holdfast", "compare-laws", "panda", "--law", "")) == set(LAW_REGISTRY)
    assert offered("holdfast", "susceptibility", "panda", "--measure", "") == list(SUSCEPTIBILITY_REGISTRY)
    assert offered("holdfast", "workspace", "panda", "--task", "planar-") == ["planar-pose"]
    assert offered("holdfast", "workspace", "panda", "--out", "res") == []  # the shell knows the folders
    assert "--optimise" in offered("holdfast", "assess", "panda", "--o")
