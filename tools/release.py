"""A release: what must agree, the files, what is in them, and the main job from them without this repository.

``python -m tools.release`` tries everything and changes nothing but ``dist/``; with ``--tag`` the commit gets its tag, which
``.github/workflows/release.yml`` publishes. Every fault is one sentence, and the exit code is 2.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import time
import tomllib
import venv
import zipfile
from pathlib import Path

from packaging.requirements import Requirement

ROOT = Path(__file__).parents[1]
MAIN_JOB = "assess pa10-9dof --poses 2000 --seed 1 --out demo"
_DATE = r"\d{4}-\d{2}-\d{2}"
# Where else the version is written, and how.
VERSIONS = {
    "src/holdfast/__init__.py": r'^__version__ = "(.+)"$',
    "CITATION.cff": r"^version: (.+)$",
    "conda/recipe.yaml": r"^  version: ([^$\s]+)$",
    "CHANGELOG.md": rf"\A# [\s\S]*?^## (\S+)(?: - {_DATE}| \(unreleased\))?$",
}


def version(root: Path) -> str:
    """The version of pyproject.toml."""
    return str(tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"])


def disagreements(root: Path) -> list[str]:
    """Files that name another version than pyproject.toml, or another day than the changelog."""
    said, found = [], {}
    for name, pattern in VERSIONS.items():
        match = re.search(pattern, (root / name).read_text(encoding="utf-8"), re.MULTILINE)
        found[name] = match[1] if match else "no version"
        if found[name] != version(root):
            said.append(f"{name} says {found[name]}, pyproject.toml {version(root)}")
    day = re.search(rf"^## {re.escape(version(root))} - ({_DATE})$", (root / "CHANGELOG.md").read_text(encoding="utf-8"), re.M)
    cited = re.search(rf"^date-released: ({_DATE})$", (root / "CITATION.cff").read_text(encoding="utf-8"), re.M)
    if day is None:
        said.append(f"CHANGELOG.md has no line '## {version(root)} - YYYY-MM-DD'")
    elif cited is None or cited[1] != day[1]:
        said.append(f"CITATION.cff has no line 'date-released: {day[1]}', the day in CHANGELOG.md")
    return said


def _git(root: Path, *arguments: str) -> str:
    return subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=True).stdout.rstrip()


def unready(root: Path) -> list[str]:
    """What in the checkout is not committed, and a tag of this version that is already at another commit."""
    said = [f"not committed: {line[3:]}" for line in _git(root, "status", "--porcelain").splitlines()]
    tag = f"v{version(root)}"
    if tag in _git(root, "tag").split() and _git(root, "rev-list", "-1", tag) != _git(root, "rev-parse", "HEAD"):
        said.append(f"the tag {tag} is at another commit; a version is released once")
    return said


def build(root: Path, folder: Path, *targets: str) -> list[Path]:
    """Build the ``targets`` (``sdist``, ``wheel``) of a checkout, with the hatchling that is installed."""
    before = set(folder.glob("*"))
    command = [sys.executable, "-m", "hatchling", "build", "-d", str(folder), *(f"-t{target}" for target in targets)]
    subprocess.run(command, cwd=root, capture_output=True, text=True, check=True)
    return sorted(set(folder.glob("*")) - before)


def wanted(root: Path) -> set[str]:
    """What a wheel holds beside its metadata: everything that lies in the package, and nothing else."""
    source = root / "src"
    return {
        path.relative_to(source).as_posix()
        for path in (source / "holdfast").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def amiss(root: Path, wheel: Path) -> list[str]:
    """What a wheel lacks or has too much, its licence and its metadata included."""
    with zipfile.ZipFile(wheel) as pack:
        names = set(pack.namelist())
        about = f"holdfast_arms-{version(root)}.dist-info/"
        metadata = pack.read(about + "METADATA").decode() if about + "METADATA" in names else ""
        wrong = pack.testzip()
    held = {name for name in names if not name.startswith(about)}
    said = [f"{wheel.name} lacks {name}" for name in sorted(wanted(root) - held)]
    said += [f"{wheel.name} has {name}, which is not in src" for name in sorted(held - wanted(root))]
    said += [
        f"{wheel.name} lacks {name}"
        for name in ("METADATA", "WHEEL", "entry_points.txt", "licenses/LICENSE")
        if about + name not in names
    ]
    said += [f"{wheel.name}: {wrong} is damaged"] if wrong else []
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    required = {Requirement(line) for line in re.findall(r"^Requires-Dist: (.+)$", metadata, re.M) if "extra ==" not in line}
    if required != {Requirement(line) for line in project["dependencies"]}:
        said.append(f"{wheel.name} requires {', '.join(sorted(map(str, required)))}")
    return said


def of_sdist(root: Path, sdist: Path, wheel: Path, folder: Path) -> list[str]:
    """Whether a source archive, unpacked elsewhere, builds the same wheel to the byte."""
    with tarfile.open(sdist) as pack:
        pack.extractall(folder, filter="data")
    (again,) = build(folder / sdist.name.removesuffix(".tar.gz"), folder, "wheel")[-1:]
    same = hashlib.sha256(again.read_bytes()).digest() == hashlib.sha256(wheel.read_bytes()).digest()
    return [] if same else [f"{sdist.name} builds another wheel than the checkout"]


def tried(files: list[Path]) -> list[str]:
    """Install each file into a bare environment, far from this repository, and run the main job with it; what that took."""
    said = []
    with tempfile.TemporaryDirectory(prefix="holdfast-release-") as name:
        away = Path(name)
        venv.create(away / "venv", with_pip=True)
        scripts = away / "venv" / ("Scripts" if os.name == "nt" else "bin")
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "HOLDFAST_", "VIRTUAL_ENV"))}
        env = {**kept, "PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}", "HOLDFAST_CACHE": str(away / "cache")}

        def run(*command: str) -> tuple[str, float]:
            begin = time.monotonic()
            done = subprocess.run(
                [str(scripts / command[0]), *command[1:]], cwd=away, env=env, capture_output=True, text=True, check=False
            )
            if done.returncode:
                raise SystemExit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
            return done.stdout, time.monotonic() - begin

        for file in files:
            wheel = file.suffix == ".whl"
            options = [f"{file}[report]"] if wheel else ["--no-deps", "--force-reinstall", str(file)]
            _, installing = run("python", "-m", "pip", "install", "-q", *options)
            home, _ = run("python", "-c", "import holdfast; print(holdfast.__file__)")
            if not home.startswith(str(away)):
                raise SystemExit(f"holdfast was imported from {home.strip()}, not from {file.name}")
            _, working = run("holdfast", *MAIN_JOB.split())
            page = away / "demo" / "report.html"
            size = page.stat().st_size / 1e3
            said.append(f"{file.name}: installed in {installing:.0f} s, main job in {working:.1f} s, report of {size:.0f} kB")
            page.unlink()
        site = sum(path.stat().st_size for path in (away / "venv").rglob("*") if path.is_file())
        said.append(f"the environment, pip included: {site / 1e6:.0f} MB")
    return said


def main() -> None:
    """Check, build, try; with ``--tag`` tag."""
    parser = argparse.ArgumentParser(prog="python -m tools.release", description=__doc__)
    parser.add_argument("--tag", action="store_true", help="tag the commit if nothing is wrong")
    parser.add_argument("--no-try", action="store_true", help="do not install what was built (some hundred MB)")
    given = parser.parse_args()
    dist = ROOT / "dist"
    dist.mkdir(exist_ok=True)
    for old in dist.iterdir():
        old.unlink()
    faults = [*disagreements(ROOT), *unready(ROOT)]
    (sdist,), (wheel,) = build(ROOT, dist, "sdist"), build(ROOT, dist, "wheel")
    with tempfile.TemporaryDirectory(prefix="holdfast-release-") as name:
        faults += [*amiss(ROOT, wheel), *of_sdist(ROOT, sdist, wheel, Path(name))]
    for file in (wheel, sdist):
        print(f"{file.name}: {file.stat().st_size / 1e6:.2f} MB")
    for line in [] if given.no_try else tried([wheel, sdist]):
        print(line)
    for fault in faults:
        print(f"release: {fault}", file=sys.stderr)
    if faults:
        sys.exit(2)
    tag = f"v{version(ROOT)}"
    if given.tag:
        _git(ROOT, "tag", "--annotate", tag, "--message", f"holdfast {version(ROOT)}")
        print(f"{tag} is tagged; push it to publish: git push origin {tag}")
    else:
        print(f"nothing is wrong; --tag would tag {tag}")


if __name__ == "__main__":
    main()
