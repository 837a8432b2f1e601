"""Compare public robot files with Pinocchio and MuJoCo, and write RESULTS.md and FILES.md.

Run ``python -m measurements.robot_files FOLDER``. FOLDER contains one folder per repository or package. A file ``.version``
in it, if there is one, states its commit and date.
"""

from __future__ import annotations

import re
import signal
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import replace
from datetime import date
from importlib.metadata import version
from multiprocessing import get_context
from pathlib import Path

from measurements.robot_files.compare import CONFIGURATIONS, MAX_CHAINS, SEED, TOLERANCE, Outcome, examine
from measurements.robot_files.files import RobotFile, find_robot_files

HERE = Path(__file__).parent
WORKERS = 2
TIME_LIMIT = 600  # s for one file


@contextmanager
def limit_time(seconds: int) -> Iterator[None]:
    """Raise TimeoutError if the block takes longer than ``seconds``."""

    def stop(*_: object) -> None:
        raise TimeoutError(f"took more than {seconds} s")

    signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)


def examine_in_time(file: RobotFile) -> Outcome:
    """Return the outcome of a file; one that takes too long has failed."""
    try:
        with limit_time(TIME_LIMIT):
            return examine(file)
    except TimeoutError as error:
        return Outcome(file, (), (), str(error))


# ---- tables ------------------------------------------------------------------------------------------------------


def write_results(outcomes: Sequence[Outcome], versions: dict[str, str]) -> str:
    """Return the text of RESULTS.md.

    Args:
        outcomes: One per file.
        versions: Commit and date of each repository.
    """
    expanded = [outcome for outcome in outcomes if not outcome.file.problem]
    states = Counter(outcome.state for outcome in expanded)
    chains = [comparison for outcome in expanded for comparison in outcome.comparisons]
    lines = [
        "# Public robot files, compared with Pinocchio and MuJoCo",
        "",
        f"Written by `python -m measurements.robot_files FOLDER` on {date.today()} with "
        + ", ".join(f"{name} {version(name)}" for name in ("pin", "mujoco", "xacro", "numpy"))
        + ". The robot files are not part of this repository.",
        "",
        f"- **{states['equal']} of {len(expanded)} files** open, and tool poses, Jacobians, and gravity torques of their "
        f"{len(chains)} chains equal those of the other library within {TOLERANCE:g} at {CONFIGURATIONS} random configurations "
        f"(seed {SEED}). Differences are relative to the largest entry if that is above 1.",
        f"- {states['sentence']} files end in one sentence. {states['different']} files differ, and {states['failed']} end in "
        "an error that is not a sentence.",
        f"- {sum('Error opening file' in outcome.sentences[-1] for outcome in expanded if outcome.state == 'sentence')} of the "
        "sentences name a file that was not downloaded: a mesh of 4 MiB or more, a submodule, or a file of another repository.",
        f"- {sum(bool(o.sentences) for o in expanded if o.comparisons)} of the files that open need an option that the first "
        "error message names, most often `--tip`. The measurement follows this advice.",
        f"- {sum(comparison.rounded for comparison in chains)} chains are equal only if Pinocchio, too, takes angles within "
        "1e-9 rad of a quarter turn as exact.",
        f"- {sum(comparison.torque is None for comparison in chains)} chains have a link without inertial data. Torques need "
        "such data, so only poses and Jacobians are compared.",
        f"- {len(outcomes) - len(expanded)} xacro files could not be expanded by the package `xacro` alone, because another "
        "package or an argument is missing. They are not counted above.",
        "",
        "[FILES.md](FILES.md) lists every file. URDF files are compared with Pinocchio, and MJCF files with MuJoCo. A file "
        "counts if it has at least 3 moving joints and no other file has the same links and joints. Of a robot with several "
        f"ends, at most {MAX_CHAINS} chains are compared.",
        "",
        "## Makers",
        "",
        *table_of_groups("maker", ((outcome.file.maker, outcome) for outcome in expanded)),
        "",
        "## Sources",
        "",
        "A licence is listed as the nearest package.xml or licence file states it, TODO included.",
        "",
        *table_of_sources(expanded, versions),
        "",
        "## Sentences",
        "",
        "Sentences of the same form are counted together.",
        "",
        *table_of_sentences(expanded),
    ]
    return "\n".join(lines) + "\n"


def name_source(outcome: Outcome) -> tuple[str, str]:
    """Return the repository or package of a file, and its path there."""
    place, _, path = outcome.file.label.partition("/")
    return place.replace("+", "/"), path


def table_of_groups(title: str, grouped: Iterable[tuple[str, Outcome]]) -> list[str]:
    """Return a table with one row per group of files."""
    groups: dict[str, list[Outcome]] = defaultdict(list)
    for name, outcome in grouped:
        groups[name].append(outcome)
    lines = [f"| {title} | files | equal | one sentence | other | largest difference |", "|---|---|---|---|---|---|"]
    for name, outcomes in sorted(groups.items(), key=lambda group: (group[0] == "other", group[0].lower())):
        states = Counter(outcome.state for outcome in outcomes)
        lines.append(
            f"| {name} | {len(outcomes)} | {states['equal']} | {states['sentence']} | "
            f"{states['different'] + states['failed']} | {largest(outcomes)} |"
        )
    return lines


def largest(outcomes: Sequence[Outcome]) -> str:
    """Return the largest difference of the equal files, for a table."""
    differences = [
        max(comparison.pose, comparison.jacobian, comparison.torque or 0.0)
        for outcome in outcomes
        for comparison in outcome.comparisons
        if outcome.state == "equal"
    ]
    return f"{max(differences):.1e}" if differences else ""


def table_of_sources(outcomes: Sequence[Outcome], versions: dict[str, str]) -> list[str]:
    """Return a table of the repositories with the licences that they state for the files."""
    groups: dict[str, list[Outcome]] = defaultdict(list)
    for outcome in outcomes:
        groups[name_source(outcome)[0]].append(outcome)
    lines = ["| source | commit and its date, or version | licence | files | equal |", "|---|---|---|---|---|"]
    for name, members in sorted(groups.items(), key=lambda group: group[0].lower()):
        licences = ", ".join(name for name, _ in Counter(member.file.licence for member in members).most_common(4))
        equal = sum(member.state == "equal" for member in members)
        lines.append(f"| {name} | {versions.get(name, '')} | {escape_cell(licences)} | {len(members)} | {equal} |")
    return lines


def table_of_sentences(outcomes: Sequence[Outcome]) -> list[str]:
    """Return a table of the sentences in which files end, those of the same form together."""
    forms: dict[str, list[str]] = defaultdict(list)
    for outcome in outcomes:
        if outcome.state == "sentence":
            text = outcome.sentences[-1]
            forms[re.sub(r"'[^']*'(, '[^']*')*|\d[\d.e+-]*", "…", text.partition(": ")[2])[:60]].append(text)
    rows = sorted(forms.values(), key=len, reverse=True)
    return ["| files | example |", "|---|---|", *(f"| {len(texts)} | {escape_cell(texts[0], 600)} |" for texts in rows)]


def write_files(outcomes: Sequence[Outcome]) -> str:
    """Return the text of FILES.md: a table with one row per file."""
    lines = [
        "# Robot files one by one",
        "",
        "The table continues [RESULTS.md](RESULTS.md). Numbers are the largest differences of all compared chains.",
        "",
        "| file | maker | chains, joints | pose | Jacobian | torque | sentence |",
        "|---|---|---|---|---|---|---|",
    ]
    for outcome in sorted(outcomes, key=lambda outcome: outcome.file.label.lower()):
        if outcome.file.problem:
            continue
        compared = outcome.comparisons
        joints = ", ".join(str(comparison.joints) for comparison in compared)
        torques = [comparison.torque for comparison in compared if comparison.torque is not None]
        cells = [
            "/".join(name_source(outcome)),
            outcome.file.maker,
            joints,
            f"{max(comparison.pose for comparison in compared):.0e}" if compared else "",
            f"{max(comparison.jacobian for comparison in compared):.0e}" if compared else "",
            f"{max(torques):.0e}" if torques else "",
            "" if compared else escape_cell(outcome.failure or outcome.sentences[-1], 240),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def escape_cell(text: str, length: int = 120) -> str:
    """Return a text for a cell of a table, shortened to ``length`` characters."""
    return (text if len(text) <= length else f"{text[: length - 4]} ...").replace("|", "\\|").replace("<", "&lt;")


def hide_folder(outcome: Outcome, folder: Path) -> Outcome:
    """Return an outcome whose sentences name files relative to ``folder``."""
    return replace(outcome, sentences=tuple(sentence.replace(f"{folder}/", "") for sentence in outcome.sentences))


def main(folder: Path) -> None:
    """Compare all files below ``folder``, and write RESULTS.md and FILES.md."""
    versions = {}
    for place in folder.iterdir():
        with suppress(OSError):
            versions[place.name.replace("+", "/")] = (place / ".version").read_text().strip()
    with tempfile.TemporaryDirectory() as expanded, ProcessPoolExecutor(WORKERS, get_context("spawn")) as pool:
        files = list(find_robot_files(folder, Path(expanded)))
        outcomes = [hide_folder(outcome, folder) for outcome in pool.map(examine_in_time, files, chunksize=4)]
    (HERE / "RESULTS.md").write_text(write_results(outcomes, versions), encoding="utf-8")
    (HERE / "FILES.md").write_text(write_files(outcomes), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]).absolute())
