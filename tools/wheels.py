"""Which package has a wheel for which system and Python: asked of pip, written into ``docs/platforms.md``.

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

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "platforms.md"
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
HEAD = f"| package | {' | '.join(SYSTEMS)} |"
ALL, NONE = "yes", "**no**"

_TEXT = """\
<!-- Written by `python -m tools.wheels`: change that, not this page. -->

# Systems and wheels

Which of the packages that holdfast needs can be installed without a compiler, asked of pip on {day} for the versions in
`requirements.lock` and Python {first} to {last}. Linux means glibc 2.28 or later, macOS 14 or later. *yes*: there is a wheel
for all these versions of Python; otherwise those for which there is one. A wheel does not mean that holdfast has run there:
[](limits.md) says where it has.

## What every command needs

{needed}

`hatchling`, `editables`, `pathspec`, `pluggy`, `tomlkit` and `trove-classifiers` only build holdfast itself; `colorama` is for
Windows alone.

## What the extras add

The packages that the extras name, at the versions of `requirements-test.lock`; what these need in turn was not asked for.

{more}
"""

Wheels = dict[str, dict[str, list[str]]]  # by package and system, the Pythons for which there is one


def locked(*names: str) -> dict[str, str]:
    """The versions of the packages in the locks ``names``, without those for one system only."""
    found = {}
    for name in names:
        for package, version in re.findall(r"^([a-z0-9._-]+)==(\S+)", (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE):
            found[package] = version
    return found


def extras() -> dict[str, str]:
    """The versions of what the extras name, beyond what the main job needs."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = {re.match(r"[a-z0-9._-]+", line)[0] for lines in project["optional-dependencies"].values() for line in lines}
    versions = locked("requirements-test.lock")
    return {name: versions[name] for name in sorted(named - locked("requirements.lock").keys())}


def there(packages: dict[str, str], system: str, python: str) -> set[str]:
    """Those of ``packages`` for which pip finds a wheel."""
    wanted = dict(packages)
    target = [part for platform in SYSTEMS[system] for part in ("--platform", platform)]
    while wanted:
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "report.json"
            command = [
                sys.executable,
                "-m",
                "pip",
                "install",
                "--dry-run",
                "--ignore-installed",
                "--no-deps",
                "--quiet",
                "--only-binary",
            ]
            command += [":all:", "--target", folder, "--report", str(report), "--python-version", python, *target]
            done = subprocess.run(
                [*command, *(f"{name}=={version}" for name, version in wanted.items())],
                capture_output=True,
                text=True,
                check=False,
            )
            if done.returncode == 0:
                found = {item["metadata"]["name"] for item in json.loads(report.read_text(encoding="utf-8"))["install"]}
                return {re.sub(r"[-_.]+", "-", name).lower() for name in found}
            missing = re.search(r"No matching distribution found for ([\w.-]+)==", done.stderr)
            if missing is None:
                raise SystemExit(f"pip failed for {system}, Python {python}:\n{done.stderr}")
            del wanted[missing[1]]
    return set()


def asked(packages: dict[str, str]) -> Wheels:
    """For each package and system, the Pythons with a wheel."""
    wheels: Wheels = {name: {system: [] for system in SYSTEMS} for name in packages}
    for system in SYSTEMS:
        for python in PYTHONS:
            for name in there(packages, system, python):
                wheels[name][system].append(python)
            print(f"{system}, Python {python}", flush=True)
    return wheels


def table(packages: dict[str, str], wheels: Wheels) -> list[str]:
    """The rows of a table: yes, no, or the Pythons with a wheel."""

    def cell(pythons: list[str]) -> str:
        return ALL if pythons == list(PYTHONS) else ", ".join(pythons) or NONE

    rows = [
        f"| {name} {version} | {' | '.join(cell(wheels[name][system]) for system in SYSTEMS)} |"
        for name, version in packages.items()
    ]
    return [HEAD, "|---" * (len(SYSTEMS) + 1) + "|", *rows]


def main() -> None:
    """Ask, and write the page."""
    needed, more = locked("requirements.lock"), extras()
    wheels = asked({**needed, **more})
    page = _TEXT.format(
        day=f"{datetime.now(UTC):%d %B %Y}",
        first=PYTHONS[0],
        last=PYTHONS[-1],
        needed="\n".join(table(needed, wheels)),
        more="\n".join(table(more, wheels)),
    )
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
