"""Which package has a wheel for which system and Python: asked of pip, written into ``docs/project/platforms.md``.

``python -m tools.wheels`` asks for every package of ``requirements.lock`` and, of the extras, for those that pyproject.toml
names, at the locked versions. It needs the network and takes minutes, and belongs to ``make lock``:
``tests/test_platforms.py`` compares the page with the locks.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
import tomllib
from datetime import UTC, datetime
from pathlib import Path

from packaging.requirements import Requirement

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "project" / "platforms.md"
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
# What pip is to take a system for. Older wheels of the same system do, too: pip knows so of macOS, and is told of Linux.
SYSTEMS = {
    **{
        f"Linux {name}": [*(f"manylinux_2_{minor}_{arch}" for minor in range(28, 4, -1)), f"manylinux2014_{arch}"]
        for name, arch in (("x86-64", "x86_64"), ("arm64", "aarch64"))
    },
    "macOS x86-64": ["macosx_14_0_x86_64"],
    "macOS arm64": ["macosx_14_0_arm64"],
    "Windows x86-64": ["win_amd64"],
    "Windows arm64": ["win_arm64"],
}
# What decides in a lock whether a system gets a line of it.
_MARKERS = {
    system: {"sys_platform": platform, "platform_machine": machine}
    for system, platform, machine in (
        ("Linux x86-64", "linux", "x86_64"),
        ("Linux arm64", "linux", "aarch64"),
        ("macOS x86-64", "darwin", "x86_64"),
        ("macOS arm64", "darwin", "arm64"),
        ("Windows x86-64", "win32", "AMD64"),
        ("Windows arm64", "win32", "ARM64"),
    )
}
HEAD = f"| package | {' | '.join(SYSTEMS)} |"
ALL, NONE, NOT_NEEDED = "yes", "**no**", "not needed"

_TEXT = """\
---
orphan: true
---

<!-- Written by `python -m tools.wheels`, which keeps the section on interpreters: for the rest, change that, not this page. -->

# Systems and wheels

This page shows on which systems you can install holdfast without a compiler. It lists the packages for which pip found a
wheel on {day}, for the versions in `requirements.lock` and Python {first} to {last}. Linux means glibc 2.28 or later, and
macOS means 14 or later. In the tables, *yes* means a wheel for all these Python versions. Otherwise the cell lists the
Python versions with a wheel. A wheel does not mean that holdfast has run there.
[Limits](../evidence/limits.md) lists the systems on which it has run.

{summary}

{interpreters}## Packages for every command and for reports

{needed}

matplotlib, zarr, and their dependencies belong to the extra `report`. `hatchling`, `editables`, `pathspec`, `pluggy`,
`tomlkit`, and `trove-classifiers` are needed only to build holdfast. A version in parentheses is the one that this system gets
instead.

## Packages of the extras

The table contains the packages that the extras name, at the versions of `requirements-test.lock`. It does not contain the
dependencies of these packages, nor PyTorch, JAX, and cuda-bindings, because the tests of every change do not need them.

{more}
"""

Packages = dict[str, dict[str, str]]  # by system and name, the version
Wheels = dict[str, dict[str, list[str]]]  # by system and name, the Pythons for which there is a wheel


def locked(name: str = "requirements.lock") -> Packages:
    """What each system gets by a lock."""
    lines = re.findall(r"^[a-z0-9._-]+==.*?(?= *\\?$)", (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)
    wanted = [Requirement(line) for line in lines]
    return {
        system: {one.name: str(one.specifier)[2:] for one in wanted if one.marker is None or one.marker.evaluate(markers)}
        for system, markers in _MARKERS.items()
    }


def extras() -> Packages:
    """What the extras name, beyond what every command and a report need."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = {Requirement(line).name for lines in project["optional-dependencies"].values() for line in lines}
    every, tests = locked(), locked("requirements-test.lock")
    return {
        system: {name: tests[system][name] for name in sorted(named & tests[system].keys() - every[system].keys())}
        for system in SYSTEMS
    }


def there(packages: dict[str, str], system: str, python: str) -> set[str]:
    """Those of ``packages`` for which pip finds a wheel."""
    wanted = dict(packages)
    target = [part for platform in SYSTEMS[system] for part in ("--platform", platform)]
    while wanted:
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "report.json"
            options = ["--dry-run", "--ignore-installed", "--no-deps", "--quiet", "--only-binary", ":all:"]
            options += ["--target", folder, "--report", str(report), "--python-version", python, *target]
            names = [f"{name}=={version}" for name, version in wanted.items()]
            command = [sys.executable, "-m", "pip", "install", *options, *names]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode == 0:
                found = {item["metadata"]["name"] for item in json.loads(report.read_text(encoding="utf-8"))["install"]}
                return {re.sub(r"[-_.]+", "-", name).lower() for name in found}
            missing = re.search(r"No matching distribution found for ([\w.-]+)==", done.stderr)
            if missing is None:
                raise SystemExit(f"pip failed for {system}, Python {python}:\n{done.stderr}")
            del wanted[missing[1]]
    return set()


def asked(packages: Packages) -> Wheels:
    """For each system and package, the Pythons with a wheel."""
    wheels: Wheels = {}
    for system, versions in packages.items():
        found = {python: there(versions, system, python) for python in PYTHONS}
        wheels[system] = {name: [python for python in PYTHONS if name in found[python]] for name in versions}
        print(system, flush=True)
    return wheels


def table(packages: Packages, wheels: Wheels) -> list[str]:
    """The rows of a table: yes, no, or the Pythons with a wheel; with the version where it is another."""
    versions = {name: version for system in reversed(SYSTEMS) for name, version in packages[system].items()}

    def cell(name: str, system: str) -> str:
        version = packages[system].get(name)
        if version is None:
            return NOT_NEEDED
        pythons = wheels[system][name]
        said = ALL if pythons == list(PYTHONS) else ", ".join(pythons) or NONE
        return said if version == versions[name] else f"{said} ({version})"

    rows = [
        f"| {name} {versions[name]} | {' | '.join(cell(name, system) for system in SYSTEMS)} |" for name in sorted(versions)
    ]
    return [HEAD, "|---" * (len(SYSTEMS) + 1) + "|", *rows]


def summary(wheels: Wheels) -> list[str]:
    """The rows of a table: for which Pythons everything that a system needs has a wheel, and what has not."""
    rows = ["| system | Python versions with all wheels | packages without a wheel for some version |", "|---|---|---|"]
    for system, found in wheels.items():
        complete = [python for python in PYTHONS if all(python in pythons for pythons in found.values())]
        lacking = [name for name, pythons in found.items() if pythons != list(PYTHONS)]
        rows.append(f"| {system} | {', '.join(complete) or NONE} | {', '.join(lacking)} |")
    return rows


def main() -> None:
    """Ask, and write the page."""
    needed, more = locked(), extras()
    interpreters = re.search(r"^## Interpreters.*?(?=^## )", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    wheels = asked({system: {**needed[system], **more[system]} for system in SYSTEMS})
    page = _TEXT.format(
        day=f"{datetime.now(UTC):%d %B %Y}",
        first=PYTHONS[0],
        last=PYTHONS[-1],
        interpreters=interpreters.group() if interpreters else "",
        summary="\n".join(summary({system: {name: wheels[system][name] for name in needed[system]} for system in SYSTEMS})),
        needed="\n".join(table(needed, wheels)),
        more="\n".join(table(more, wheels)),
    )
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
