"""Advice to install holdfast names its own distribution, because the name ``holdfast`` on PyPI belongs to another project."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
OLD_ADVICE = re.compile(
    r"pip install (?:-\S+ )*['\"]?holdfast(?![\w-])|uvx holdfast(?![\w-])|(?<![\w.-])holdfast\\?\[[a-z,{.]+\\?\]"
)


def test_no_text_advises_to_install_the_other_holdfast():
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")
    texts = {".py", ".pyi", ".md", ".txt", ".ipynb", ".toml", ".yml", ".yaml", ".html", ".ts", ""}
    found = [
        f"{name}: {match.group()}"
        for name in listed
        if name and Path(name).suffix in texts and name != "CHANGELOG.md" and (ROOT / name).is_file()
        for match in OLD_ADVICE.finditer((ROOT / name).read_text(encoding="utf-8", errors="ignore"))
        if name != Path(__file__).relative_to(ROOT).as_posix()
    ]
    assert found == []


def test_the_distribution_offers_a_command_of_its_own_name():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["name"] == "holdfast-arms"
    assert project["scripts"] == {"holdfast": "holdfast.interface.cli:main", "holdfast-arms": "holdfast.interface.cli:main"}
