"""What 'make test' needs beside Python: every package locked with digests, and one loud line where there is no browser."""

import os
import re
import subprocess
import sys
import tomllib
from importlib.metadata import distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import slow
import workers

ROOT = Path(__file__).parents[1]
LOCKS = {"run": ["requirements.lock"], "uv": ["requirements-uv.lock"]}
LOCKS |= {group: ["requirements.lock", f"requirements-{group}.lock"] for group in ("test", "docs")}
PROBE = """
import chromium

def test_page():
    with chromium.opened(chromium.required):
        pass
"""


def asked_for(group: str) -> list[str]:
    """What pyproject.toml names for running with reports, and for a group."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    groups = project["dependency-groups"]
    report = project["project"]["optional-dependencies"]["report"]
    return [*project["project"]["dependencies"], *report, *groups["build"], *groups.get(group, [])]


@pytest.mark.parametrize("group", ["run", "test"])
def test_the_locks_name_everything_that_is_installed_for_a_group(group):
    """Followed through what the packages say of themselves, for the Python that runs this test."""
    locked = {
        canonicalize_name(found[1])
        for name in LOCKS[group]
        for found in re.finditer(r"^([A-Za-z0-9._-]+)==", (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)
    }
    seen: set[tuple[str, frozenset[str]]] = set()
    ahead = [Requirement(text) for text in asked_for(group)]
    while ahead:
        wanted = ahead.pop()
        key = (canonicalize_name(wanted.name), frozenset(wanted.extras))
        if key in seen or (wanted.marker is not None and not wanted.marker.evaluate({"extra": ""})):
            continue
        seen.add(key)
        for text in distribution(wanted.name).requires or ():
            needed = Requirement(text)
            if needed.marker is None or any(needed.marker.evaluate({"extra": extra}) for extra in ("", *wanted.extras)):
                needed.marker = None
                ahead.append(needed)
    assert len(seen) > 20
    assert {name for name, _ in seen} - locked == set()


@pytest.mark.parametrize("name", sorted({name for names in LOCKS.values() for name in names}))
def test_every_line_of_a_lock_is_a_version_with_digests_and_names_no_host(name):
    text = (ROOT / name).read_text(encoding="utf-8").replace("\\\n", " ")
    for line in text.splitlines():
        assert re.fullmatch(r"[a-z0-9._-]+==\S+( ; [^#@/]+?)? +(--hash=sha256:[0-9a-f]{64} *)+", line), line[:80]


@pytest.mark.parametrize("required", ["", "1"])
def test_without_a_browser_tests_of_pages_are_skipped_loudly_and_fail_where_it_is_required(tmp_path, required):
    (tmp_path / "test_probe.py").write_text(PROBE, encoding="utf-8")
    nowhere = str(tmp_path / "nowhere")
    path = os.pathsep.join([str(ROOT / "src"), str(ROOT / "tests")])
    env = {**os.environ, "PATH": nowhere, "PLAYWRIGHT_BROWSERS_PATH": nowhere, "PYTHONPATH": path}
    env["HOLDFAST_REQUIRE_BROWSER"] = required
    command = [sys.executable, "-m", "pytest", "-p", "conftest", "-p", "no:cacheprovider", "--rootdir", ".", "."]
    done = subprocess.run(command, env=env, cwd=tmp_path, capture_output=True, text=True, check=False)
    loud = "NO BROWSER, 1 TESTS SKIPPED" in done.stdout
    assert (done.returncode, loud) == ((1, False) if required else (0, True)), done.stdout
    assert "pages are looked at in Chromium, and there is none here" in done.stdout


def test_what_waits_for_pages_is_shared_by_folder_and_the_rest_by_file():
    named = {folder: [str(path.relative_to(ROOT)) for path in (ROOT / folder).glob("test_*.py")] for folder in workers.PAGES}
    assert all(len(files) > 1 for files in named.values())
    assert {workers.share_of(f"{file}::test_it[a/b]") for files in named.values() for file in files} == set(workers.PAGES)
    assert workers.share_of("tests/model/arm/test_urdf.py::test_it[a::b]") == "tests/model/arm/test_urdf.py"


def test_every_package_has_tests_that_are_quick():
    """'make check' says something of each: its tests are those that slow.txt does not list."""
    tests = ROOT / "tests"
    every = {
        f"tests/{file.relative_to(tests).as_posix()}::{name}"
        for file in tests.rglob("test_*.py")
        for name in re.findall(r"^def (test_\w+)", file.read_text(encoding="utf-8"), re.MULTILINE)
    }
    quick = {name.split("/")[1] for name in every - slow.listed()}
    assert {path.name for path in tests.iterdir() if path.is_dir() and any(path.rglob("test_*.py"))} - quick <= {"browser"}
