"""What is released: the wheel, files that must agree, the workflow files, the conda recipe."""

from __future__ import annotations

import re
import shutil
import subprocess
import tomllib
import zipfile
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from tools import release

ROOT = Path(__file__).parents[1]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def steps(file: Path) -> list[dict]:
    """The steps of all jobs of a workflow."""
    return [step for job in yaml.safe_load(file.read_text(encoding="utf-8"))["jobs"].values() for step in job["steps"]]


# ---- the wheel -----------------------------------------------------------------------------------------------------------


def test_the_wheel_holds_the_package_and_nothing_else(tmp_path):
    """Installed elsewhere, and run, by ``make release``."""
    (wheel,) = release.build(ROOT, tmp_path, "wheel")
    assert wheel.name == f"holdfast_arms-{release.version(ROOT)}-py3-none-any.whl"
    assert release.amiss(ROOT, wheel) == []
    with zipfile.ZipFile(wheel) as pack:
        names = pack.namelist()
    needed = {
        "py.typed",
        "__init__.pyi",
        "model/arm/__init__.pyi",
        "model/arms/data/panda.urdf",
        "model/arms/data/licenses/Apache-2.0.txt",
    }
    needed |= {"interface/report/templates/page.html", "teleop/protocol/goel2003.yaml", "teleop/serve/texts/en.yaml"}
    needed |= {f"teleop/serve/static/{name}" for name in ("index.html", "station.js", "worker.js", "icon.svg")}
    assert {f"holdfast/{name}" for name in needed} <= set(names)
    assert {name.split("/")[0] for name in names} == {"holdfast", f"holdfast_arms-{release.version(ROOT)}.dist-info"}

    # One file less, one more, another requirement: each is told.
    worse = tmp_path / "worse" / wheel.name
    worse.parent.mkdir()
    with zipfile.ZipFile(wheel) as pack, zipfile.ZipFile(worse, "w") as other:
        for name in names:
            if name != "holdfast/py.typed":
                data = pack.read(name)
                other.writestr(name, data.replace(b"numpy>=2.0", b"numpy>=1.0") if name.endswith("METADATA") else data)
        other.writestr("tests/test_lazy.py", "")
    lacks, has, requires = release.amiss(ROOT, worse)
    assert (lacks, has) == (
        f"{wheel.name} lacks holdfast/py.typed",
        f"{wheel.name} has tests/test_lazy.py, which is not in src",
    )
    assert "numpy>=1.0" in requires


# ---- what must agree -----------------------------------------------------------------------------------------------------


@pytest.fixture
def checkout(tmp_path):
    """A repository that is ready: the files that name a version, committed."""
    for name in ("pyproject.toml", *release.VERSIONS):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    text = (tmp_path / "CHANGELOG.md").read_text(encoding="utf-8")
    heading = f"## {release.version(ROOT)} - 2026-12-01"
    (tmp_path / "CHANGELOG.md").write_text(re.sub("^## .*$", heading, text, count=1, flags=re.MULTILINE), encoding="utf-8")
    cited = re.sub("^date-released:.*\n", "", (tmp_path / "CITATION.cff").read_text(encoding="utf-8"), flags=re.MULTILINE)
    (tmp_path / "CITATION.cff").write_text(cited + "date-released: 2026-12-01\n", encoding="utf-8")
    git = ["git", "-c", "user.name=test", "-c", "user.email=test@example.org"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "ready"]):
        subprocess.run([*git, *command], cwd=tmp_path, check=True)
    return tmp_path


def test_what_is_ready_is_ready_and_every_fault_is_told(checkout):
    assert [*release.disagreements(checkout), *release.unready(checkout)] == []
    subprocess.run(["git", "tag", f"v{release.version(ROOT)}"], cwd=checkout, check=True)
    assert release.unready(checkout) == []  # the workflow runs at the tag
    for name, old, new, told in (
        ("src/holdfast/__init__.py", '__version__ = "', '__version__ = "9', "src/holdfast/__init__.py says 9"),
        ("CITATION.cff", "\nversion: ", "\nversion: 9", "CITATION.cff says 9"),
        ("conda/recipe.yaml", "\n  version: ", "\n  version: 9", "conda/recipe.yaml says 9"),
        ("CHANGELOG.md", "\n## ", "\n## Unreleased\n\n## ", "CHANGELOG.md says Unreleased"),
        ("CHANGELOG.md", " - 2026-12-01", " - soon", "CHANGELOG.md has no line"),
        ("CITATION.cff", "date-released: 2026-12-01", "", "CITATION.cff has no line 'date-released: 2026-12-01'"),
    ):
        right = (checkout / name).read_text(encoding="utf-8")
        (checkout / name).write_text(right.replace(old, new, 1), encoding="utf-8")
        assert any(told in line for line in release.disagreements(checkout)), told
        assert release.unready(checkout) == [f"not committed: {name}"]
        (checkout / name).write_text(right, encoding="utf-8")
    again = ["git", "-c", "user.name=test", "-c", "user.email=test@example.org", "commit", "-qm", "more", "--allow-empty"]
    subprocess.run(again, cwd=checkout, check=True)
    assert release.unready(checkout) == [f"the tag v{release.version(ROOT)} is at another commit; a version is released once"]


def test_every_file_names_the_version_of_the_package():
    said = [line for line in release.disagreements(ROOT) if "Unreleased" not in line and "YYYY" not in line]
    assert said == []


def test_the_recipe_needs_what_the_package_needs():
    recipe = yaml.safe_load((ROOT / "conda" / "recipe.yaml").read_text(encoding="utf-8"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    needed = {line.replace(" ", "").replace("matplotlib-base", "matplotlib") for line in recipe["requirements"]["run"]}
    here = [Requirement(line) for line in [*project["dependencies"], *project["optional-dependencies"]["report"]]]
    linux = [one for one in here if one.marker is None or one.marker.evaluate({"sys_platform": "linux"})]
    assert needed == {*(f"{one.name}{one.specifier}" for one in linux), f"python{project['requires-python']}"}
    assert recipe["build"]["python"]["entry_points"] == [f"holdfast = {project['scripts']['holdfast']}"]


# ---- the workflow files --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("file", WORKFLOWS, ids=lambda file: file.stem)
def test_a_workflow_does_what_a_checkout_can_do(file):
    """Its commands are those of the Makefile; the schema is compared by ``make release``."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    runs = [line.strip() for step in steps(file) for line in step.get("run", "").splitlines()]
    for target in (found for line in runs for found in re.findall(r"^make (\S+)", line)):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target
    for line in runs:
        if line.startswith("holdfast "):
            assert line == f"holdfast {release.MAIN_JOB}"
            assert line.removeprefix("holdfast") in makefile
        if "-m pytest" in line:
            (same,) = re.findall(r'^\t\$\(BIN\)/(python -m pytest .*-m "not slow".*)$', makefile, re.MULTILINE)
            assert re.sub(r"-n \d", "-n $(WORKERS)", line) == same
        for name in re.findall(r"(\S*requirements\S*\.lock)", line):
            assert (ROOT / name).is_file()
    assert all(re.fullmatch(r"[\w./-]+@(v\d+|release/v\d+)", step["uses"]) for step in steps(file) if "uses" in step)
    assert "Not run so far" in file.read_text(encoding="utf-8")


def test_the_main_job_runs_on_every_system():
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "check.yml").read_text(encoding="utf-8"))["jobs"]
    rows = jobs["main-job"]["strategy"]["matrix"]["include"]
    systems = {row["system"].split(" (")[0] for row in rows}
    assert systems == {f"{name} {kind}" for name in ("Linux", "macOS", "Windows") for kind in ("x86-64", "arm64")}
    least = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["requires-python"]
    assert f">={min((row['python'] for row in rows), key=lambda text: int(text.split('.')[1]))}" == least
