"""The page's sources against what is kept in the package: the built files, the texts."""

import json
import re
import shutil
import subprocess
import tomllib
from importlib import resources
from pathlib import Path

import pytest

from holdfast.teleop.serve.app import STATIC_FOLDER
from holdfast.teleop.serve.texts import load_texts

PAGE = Path(__file__).parents[2] / "page"


@pytest.fixture(scope="module")
def node():
    """What the page is built with."""
    if shutil.which("node") is None:
        pytest.fail("the page is built again and compared, and there is no Node here: 'make test' installs it")
    if not (PAGE / "node_modules").is_dir():
        pytest.fail("the page is built again and compared, and its tools are not installed: 'make test' installs them")


def sources() -> str:
    return "\n".join(p.read_text(encoding="utf-8") for p in sorted(PAGE.glob("src/**/*.ts")))


@pytest.mark.usefixtures("node")
@pytest.mark.parametrize(("mode", "html"), [("station", "index.html"), ("experimenter", "experimenter.html")])
def test_the_built_page_is_the_page(tmp_path, mode, html):
    command = ["node_modules/.bin/vite", "build", "--mode", mode, "--outDir", str(tmp_path), "--logLevel", "error"]
    subprocess.run(command, cwd=PAGE, check=True, capture_output=True)
    built = {p.name: p.read_bytes() for p in tmp_path.iterdir()}
    assert {html, f"{mode}.js", f"{mode}.css"} <= built.keys()
    for name, content in built.items():
        assert (STATIC_FOLDER / name).read_bytes() == content, f"'{name}' is not what 'npm run build' makes; run it and commit"


@pytest.mark.usefixtures("node")
@pytest.mark.parametrize("mode", ["viewer", "arm_page", "any_arm", "studio"])
def test_the_built_view_is_the_view(tmp_path, mode):
    command = ["node_modules/.bin/vite", "build", "--mode", mode, "--outDir", str(tmp_path), "--logLevel", "error"]
    subprocess.run(command, cwd=PAGE, check=True, capture_output=True)
    [built] = tmp_path.iterdir()
    kept = resources.files("holdfast.interface.report").joinpath("templates", built.name).read_bytes()
    assert built.read_bytes() == kept, f"'{built.name}' is not what 'npm run build' makes; run it and commit"
    assert mode != "viewer" or len(kept) < 25_000  # every report holds it


@pytest.mark.usefixtures("node")
def test_types_and_unit_tests():
    for command in (["node_modules/.bin/tsc", "--noEmit"], ["node_modules/.bin/vitest", "run"]):
        done = subprocess.run(command, cwd=PAGE, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr


def test_every_text_is_there_and_used():
    code = sources()
    keys = set(load_texts().strings)
    literal = set(re.findall(r'"([a-z][a-z0-9_-]*)"', code))
    templates = re.findall(r"`((?:[a-z0-9_-]|\$\{[^{}`]*\})+)`", code)
    patterns = [re.sub(r"\$\{[^}]*\}", "[a-z0-9_-]+", t) for t in templates if "${" in t and re.search("[a-z]_|_[a-z]", t)]
    unused = {k for k in keys if k not in literal and not any(re.fullmatch(p, k) for p in patterns)}
    assert not unused
    asked = set(re.findall(r'texts\.get\("([^"]+)"', code))
    assert asked <= keys


@pytest.mark.parametrize(("mode", "html"), [("station", "index.html"), ("experimenter", "experimenter.html")])
def test_the_built_page_asks_no_other_host_and_needs_nothing_inline(mode, html):
    index = (STATIC_FOLDER / html).read_text(encoding="utf-8")
    assert not re.search(r"<style|<script(?![^>]*\bsrc=)|\bstyle=|\bon\w+=", index)
    for name in (html, f"{mode}.js", f"{mode}.css", "worker.js"):
        addresses = re.findall(
            r"(?:https?:)?//[a-z0-9-]+\.[a-z]{2,}[^\s\"'`)]*", (STATIC_FOLDER / name).read_text(encoding="utf-8")
        )
        assert [a for a in addresses if "//www.w3.org" not in a] == []  # names of XML are never asked for
    assert "@font-face" not in (STATIC_FOLDER / f"{mode}.css").read_text(encoding="utf-8")
    assert "eval(" not in (STATIC_FOLDER / f"{mode}.js").read_text(encoding="utf-8")


def test_the_lock_file_names_no_host():
    assert "resolved" not in (PAGE / "package-lock.json").read_text(encoding="utf-8")


def test_the_page_contains_no_package():
    lock = json.loads((PAGE / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    assert [name for name, p in lock.items() if name and not p.get("dev") and not p.get("optional")] == []


def test_every_python_package_is_named_with_its_licence():
    project = tomllib.loads((PAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    said = (PAGE.parent / "README.md").read_text(encoding="utf-8").split("## Source and licence")[1].lower()
    needed = [*project["dependencies"], *(x for extra in project["optional-dependencies"].values() for x in extra)]
    missing = [name for name in (re.match(r"[\w-]+", x)[0] for x in needed) if not re.search(rf"\b{name}\b", said)]
    assert set(missing) == {"holdfast-arms"}  # the extra "all" names the project itself
