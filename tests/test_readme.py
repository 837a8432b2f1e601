"""The first page says what is true: its links lead somewhere, its commands exist, its Python runs."""

import html
import re
import shlex
import shutil
from importlib.resources import files
from pathlib import Path

import pytest

from holdfast.interface.cli.program import COMMAND_MODULES

ROOT = Path(__file__).parent.parent
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> str:
    return "\n".join(re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL))


def test_it_is_read_in_two_minutes():
    assert len(TEXT.splitlines()) <= 90


@pytest.mark.parametrize("link", sorted(set(re.findall(r"\]\((?!http)([^)#]+)", TEXT))))
def test_links_lead_somewhere(link: str):
    assert (ROOT / link).exists()


def test_its_commands_exist():
    called = [
        shlex.split(line, comments=True)
        for line in blocks("sh").replace("\\\n", " ").splitlines()
        if line.startswith("holdfast ")
    ]
    assert len(called) == 4
    assert {words[1] for words in called} <= set(COMMAND_MODULES)
    targets = re.findall(r"^make (\w+)", blocks("sh"), re.MULTILINE)
    assert targets == ["demo", "test"]


def test_its_python_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    shutil.copy(str(files("holdfast.model.arms") / "data" / "xarm7.urdf"), tmp_path / "my_robot.urdf")
    monkeypatch.chdir(tmp_path)
    code = blocks("python").replace("poses=2000", "poses=50")
    assert len(code.splitlines()) <= 7  # six lines and the blank one
    exec(compile(code, "README.md", "exec"), {})
    assert "95%" in capsys.readouterr().out
    assert (tmp_path / "report.html").stat().st_size > 10_000


def test_its_report_is_small_and_names_the_command_that_made_it():
    link = re.search(r"\]\((docs/_static/reports/\S+\.html)\)", TEXT).group(1)
    report = (ROOT / link).read_text(encoding="utf-8")
    assert len(report) <= 300_000
    command = re.search(r"^holdfast recover .*?(?<!\\)\n", TEXT, re.MULTILINE | re.DOTALL).group(0)
    assert shlex.join(shlex.split(command.replace("\\\n", " "))) in html.unescape(report)
