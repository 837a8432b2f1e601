"""Records all that holdfast prints and writes for a fixed set of commands, and compares two records.

    python tools/record.py record OLD           what src/ beside this folder does, or --source; built pages with --docs
    python tools/record.py compare OLD NEW      and --pictures PAGE.html for those that differ; --only KEY ... with both

A change of the insides must leave the record as it is, or every difference must be meant. Commands are in
``recorded/commands.txt``, results of Python in ``recorded/results.py``; the help of every command comes with them.
What a command reads lies beside them. Pictures count by their pixels, or, as drawings, by their elements.
"""

from __future__ import annotations

import argparse
import base64
import importlib
import json
import os
import re
import shlex
import signal
import sqlite3
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path

HERE = Path(__file__).resolve().parent
INPUTS = HERE / "recorded"
sys.path.insert(0, str(INPUTS))

from records import compare, pixels  # noqa: E402

# Nothing of holdfast: a child imports that, in the order in which a user's process would.
FOREIGN = (
    "numpy scipy.stats scipy.optimize scipy.spatial casadi llvmlite.binding matplotlib.figure matplotlib.backends.backend_svg "
    "matplotlib.backends.backend_agg PIL.Image jinja2 pydantic yaml typer rich.console xarray zarr pandas pyarrow.parquet "
    "mujoco statsmodels.formula.api statsmodels.stats.power"
)
SETTINGS = {
    "HOLDFAST_LEVEL": "1", "HOLDFAST_THREADS": "1", "HOLDFAST_BACKEND": "", "HOLDFAST_NOTICES": "off",
    "OPENBLAS_NUM_THREADS": "1", "COLUMNS": "100", "TERM": "dumb", "NO_COLOR": "1", "TZ": "UTC", "LC_ALL": "C.UTF-8",
}  # fmt: skip

# ---- recording -----------------------------------------------------------------------------------------------------------


def record(folder: Path, source: Path, keys: list[str], pages: Path | None) -> int:
    """Write the record of all cases, or of those with the keys given."""
    if folder.exists() and any(folder.iterdir()):
        sys.exit(f"'{folder}' is not empty; give a new folder")
    for name in FOREIGN.split():
        with suppress(ModuleNotFoundError):
            importlib.import_module(name)
    os.environ.update(SETTINGS)
    sys.path.insert(0, str(source.resolve()))
    cases = {**commands(), "help": [], "results": []} | ({} if pages is None else {"docs": [str(pages.resolve())]})
    if unknown := set(keys) - set(cases):
        sys.exit(f"no case {', '.join(sorted(unknown))}; there are {', '.join(cases)}")
    broken: list[str] = []
    for key in keys or cases:
        begin = spent()
        with tempfile.TemporaryDirectory(prefix="holdfast-record-") as place:
            kept = CASES.get(key, ran)(Path(place), cases[key])
            paths = {str(Path(place).resolve()): "<folder>", str(INPUTS): "<inputs>", str(source.resolve()): "<source>"}
            for name, data in kept.items():
                file = folder / key / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(data if file.suffix == ".png" else texts(data, paths))
        print(f"{key:22} {len(kept):4} files  {spent() - begin:5.1f} s", flush=True)
        broken += [f"{key}/{name}" for name, data in kept.items() if b"Traceback (most recent" in data]
    if broken:
        print("a command or call ended in a traceback: " + ", ".join(broken))
    return int(bool(broken))


def spent() -> float:
    """Processor time of this process and its children, s."""
    return sum(os.times()[:4])


def commands() -> dict[str, list[str]]:
    """The commands of every key."""
    found: dict[str, list[str]] = {}
    for line in (INPUTS / "commands.txt").read_text().splitlines():
        if match := re.fullmatch(r"\[(.+)\]", line):
            at = found.setdefault(match[1], [])
        elif line and not line.startswith("#"):
            at.append(line)
    return found


def ran(place: Path, lines: list[str]) -> dict[str, bytes]:
    """What the commands of a case print and leave in a folder that begins with the inputs."""
    inputs = {file.name: file.read_bytes() for file in INPUTS.iterdir() if file.is_file() and file.suffix != ".py"}
    for name, data in inputs.items():
        (place / name).write_bytes(data)
    kept: dict[str, bytes] = {}
    for k, line in enumerate(lines, 1):
        words = shlex.split(line.lstrip("+!"))
        kept |= said(f"{k}", holdfast(place, words, stop=line.startswith("!")))
        if line.startswith("+"):
            kept |= said(f"{k}-json", holdfast(place, [*words, "--json"]))
    for file in sorted(place.rglob("*")):
        name = str(file.relative_to(place))
        if file.is_file() and inputs.get(name) != file.read_bytes():
            kept |= opened(name, file)
    return kept


def said(name: str, told: tuple[int, bytes, bytes]) -> dict[str, bytes]:
    """Output, errors and exit code as files, as far as there is anything to say."""
    code, out, err = told
    kept = {f"{name}.json" if out[:1] in (b"{", b"[") else f"{name}.out": out} if out else {}
    return kept | ({f"{name}.err": err + f"exit code {code}\n".encode()} if err or code else {})


def holdfast(place: Path, words: list[str], stop: bool = False) -> tuple[int, bytes, bytes]:
    """Exit code, output and errors of a command in a process of its own."""

    def main() -> None:
        sys.argv = ["holdfast", *words]
        importlib.import_module("holdfast.interface.cli").main()

    return apart(place, main, stop)


def apart(place: Path, work: Callable[[], None], stop: bool = False) -> tuple[int, bytes, bytes]:
    """Exit code, output and errors of ``work`` in a child that has all foreign packages, and none of holdfast's modules."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = os.fork()
        if not child:
            code = 70
            try:
                os.chdir(place)
                os.dup2(out.fileno(), 1)
                os.dup2(err.fileno(), 2)
                signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background of a shell it is ignored
                work()
                code = 0
            except SystemExit as end:
                code = end.code if isinstance(end.code, int) else int(end.code is not None)
            except BaseException:
                traceback.print_exc()
            finally:
                with suppress(BaseException):
                    sys.stdout.flush()
                    sys.stderr.flush()
                os._exit(code)
        end = time.monotonic() + 60
        while stop and time.monotonic() < end and b"http" not in os.pread(out.fileno(), 10_000, 0):
            time.sleep(0.1)
        if stop:
            os.kill(child, signal.SIGINT)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return code, os.pread(out.fileno(), 1 << 28, 0), os.pread(err.fileno(), 1 << 28, 0)


def helped(place: Path, _: list[str]) -> dict[str, bytes]:
    """The help of the program and of every command that is in a help."""
    kept: dict[str, bytes] = {}
    todo: list[list[str]] = [[]]
    while todo:
        words = todo.pop()
        told = holdfast(place, [*words, "--help"])
        kept |= said("-".join(["holdfast", *words]), told)
        todo += [[*words, name] for name in re.findall(r"(?m)^│ ([a-z][a-z-]*) {2,}", told[1].decode())]
    return kept


def returned(place: Path, _: list[str]) -> dict[str, bytes]:
    """What the entries of ``recorded/results.py`` return: numbers, texts, dictionaries and figures."""
    kept: dict[str, bytes] = {}
    names = apart(place, lambda: print(json.dumps(list(importlib.import_module("results").RESULTS))))[1]
    for name in json.loads(names):
        (place / name).mkdir()
        code, out, err = apart(place / name, lambda name=name: importlib.import_module("results").write(name))
        if out or err or code:
            kept |= said(name, (code, out, err))
        for file in sorted((place / name).rglob("*")):
            if file.is_file():
                kept |= opened(str(file.relative_to(place)), file)
    return kept


def built(_: Path, pages: list[str]) -> dict[str, bytes]:
    """The pages of the documentation that lie in a folder, with what they show of the programs that they ran."""
    root, kept = Path(pages[0]), {}
    for file in sorted(root.rglob("*.html")):
        kept |= opened(str(file.relative_to(root)), file)
    return kept


CASES: dict[str, Callable[[Path, list[str]], dict[str, bytes]]] = {"help": helped, "results": returned, "docs": built}


# ---- files ---------------------------------------------------------------------------------------------------------------


def opened(name: str, file: Path) -> dict[str, bytes]:
    """A file as what counts of it: texts for tables and databases, the drawings of a page apart."""
    data = file.read_bytes()
    if name.endswith((".sqlite-wal", ".sqlite-shm")):
        return {}
    if name.endswith(".sqlite"):
        with closing(sqlite3.connect(file)) as db:
            return {f"{name}.sql": "\n".join(db.iterdump()).encode()}
    if name.endswith(".parquet"):
        table = importlib.import_module("pyarrow.parquet").read_table(file)
        types = "".join(f"{field.name}: {field.type}\n" for field in table.schema)
        return {f"{name}.txt": (types + table.to_pandas().to_csv(index=False)).encode()}
    if name.endswith(".html"):
        drawings = re.findall(rb"<svg .*?</svg>", data, flags=re.DOTALL)
        kept = {f"{name}-{k}.svg": drawing for k, drawing in enumerate(drawings, 1)}
        return kept | {name: re.sub(rb"<svg .*?</svg>", b"<svg/>", data, flags=re.DOTALL)}
    return {name: data}


def texts(data: bytes, paths: dict[str, str]) -> bytes:
    """A text without the places where it was made, pictures in it as digests; anything else as it is."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return data
    for path, name in paths.items():
        text = text.replace(path, name)
    return re.sub(
        r"data:image/png;base64,([A-Za-z0-9+/=\s]+)", lambda m: f"png {pixels(base64.b64decode(m[1]))}", text
    ).encode()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    tasks = parser.add_subparsers(dest="task", required=True)
    new = tasks.add_parser("record")
    new.add_argument("folder", type=Path)
    new.add_argument("--only", nargs="+", default=[], metavar="KEY", help="some of the cases")
    new.add_argument("--source", type=Path, default=HERE.parent / "src", help="folder that holds the package")
    new.add_argument("--docs", type=Path, metavar="FOLDER", help="also these pages, as 'make docs' built them")
    two = tasks.add_parser("compare")
    two.add_argument("old", type=Path)
    two.add_argument("new", type=Path)
    two.add_argument("--only", nargs="+", default=[], metavar="KEY", help="some of the cases")
    two.add_argument("--pictures", type=Path, metavar="PAGE.html", help="all pictures that differ, side by side")
    given = parser.parse_args()
    if given.task == "record":
        sys.exit(record(given.folder, given.source, given.only, given.docs))
    sys.exit(compare(given.old, given.new, given.only, given.pictures))
