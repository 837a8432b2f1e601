"""Results of a run, the published verdicts, and the table."""

from __future__ import annotations

import json
import platform
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.locked_planning.problems import Problem
from benchmarks.locked_planning.validator import Json, validate

FORMAT = "locked-planning-verdicts/1"
DIGITS = (4, 6, 9)  # of waypoints in a file of verdicts: the first that keeps the path valid


def read_results(file: Path) -> list[Json]:
    """Return the records of a run; a last line that an interrupt cut off is ignored."""
    records = []
    for line in file.read_text().splitlines() if file.exists() else []:
        try:
            records.append(json.loads(line))
        except json.JSONDecodeError:
            continue
    return records


def is_accepted(record: Json) -> bool:
    """Return True if the planner claims a path and the validator accepts it."""
    return record["verdict"] == "solved" and not record["violation"]


def path_length(path: Any) -> float:
    """Return the Euclidean length of a path in joint space, rad."""
    return float(np.linalg.norm(np.diff(np.asarray(path), axis=0), axis=1).sum())


def find_contradictions(records: Iterable[Json]) -> list[str]:
    """Return a sentence for each problem that one planner proved infeasible and another one solved."""
    solved: dict[tuple[str, str], list[str]] = {}
    proved: dict[tuple[str, str], list[str]] = {}
    for record in records:
        chosen = solved if is_accepted(record) else proved if record["verdict"] == "proved infeasible" else {}
        chosen.setdefault((record["track"], record["problem"]), []).append(record["planner"])
    return [
        f"{problem} ({track}): {', '.join(proved[track, problem])} proved it infeasible, and the validator accepted the path "
        f"of {', '.join(solved[track, problem])}"
        for track, problem in sorted(solved.keys() & proved.keys())
    ]


def make_table(records: list[Json]) -> str:
    """Return the results as a page in Markdown."""
    best: dict[tuple[str, str], float] = {}
    for record in filter(is_accepted, records):
        key = record["track"], record["problem"]
        best[key] = min(best.get(key, np.inf), record["length"])
    groups: dict[tuple[str, str, str], list[Json]] = {}
    for record in records:
        groups.setdefault((record["track"], record["kind"], record["planner"]), []).append(record)
    lines = [
        "# Planning with a locked joint: results",
        "",
        f"Measured on {platform.machine()} with Python {platform.python_version()}, one problem at a time, planners in turns. "
        "[README.md](README.md) describes the columns and the command that writes this page.",
        "",
        "| track | arm | planner | problems | solved | proved infeasible | undecided | refused by the validator "
        "| ms if solved, median / 95 % | ms if not, median / 95 % | path length / best, median |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for (track, kind, planner), rows in sorted(groups.items()):
        accepted = [row for row in rows if is_accepted(row)]
        verdicts = [row["verdict"] for row in rows]
        counts = (
            len(rows),
            len(accepted),
            verdicts.count("proved infeasible"),
            verdicts.count("undecided"),
            verdicts.count("solved") - len(accepted),
        )
        times = [_describe_times([row for row in rows if (row["verdict"] == "solved") == solved]) for solved in (True, False)]
        ratios = [row["length"] / max(best[track, row["problem"]], 1e-12) for row in accepted]
        length = f"{np.median(ratios):.3f}" if ratios else ""
        name = f"{planner} {rows[0]['version']}"
        lines.append(f"| {track} | {kind} | {name} | {' | '.join(map(str, counts))} | {' | '.join(times)} | {length} |")
    contradictions = find_contradictions(records)
    lines += ["", "## Contradictions", "", *(f"- {line}" for line in contradictions or ["None."])]
    return "\n".join(lines) + "\n"


def _describe_times(rows: list[Json]) -> str:
    """Return the median and the 95 % quantile of the processor times, ms."""
    times = [1e3 * row["processor_s"] for row in rows if row["processor_s"] is not None]
    return " / ".join(f"{x:.3g}" if x < 1000 else f"{x:.0f}" for x in np.quantile(times, [0.5, 0.95])) if times else ""


def round_path(robot: Json, problem: Problem, path: Any, make_contacts: Any) -> list[list[float]] | None:
    """Return the path with as few digits as keep it valid, the start and the lock in full; None if no rounding does."""
    for digits in DIGITS:
        q = np.round(np.asarray(path, dtype=float), digits)
        q[0] = problem.start
        if problem.joint is not None:
            q[:, problem.joint] = problem.value
        if validate(robot, problem.to_dict(), q, make_contacts).is_accepted:
            return [[float(x) for x in row] for row in q]
    return None


def write_verdicts(
    file: Path, records: list[Json], planner: str, track: str, robot: Json, problems: Any, make_contacts: Any
) -> int:
    """Write the verdicts of a planner with a witness path or the kind of proof, and return their number."""
    by_name = {problem.name: problem for problem in problems}
    verdicts: Json = {}
    for record in records:
        if record["planner"] != planner or record["track"] != track or record["problem"] not in by_name:
            continue
        entry: Json = {"verdict": record["verdict"]}
        if record["verdict"] == "solved":
            path = round_path(robot, by_name[record["problem"]], record["path"], make_contacts)
            entry = {"verdict": "undecided"} if path is None else {**entry, "path": path}
        elif record["verdict"] == "proved infeasible":
            entry["proof"] = record["note"]
        verdicts[record["problem"]] = entry
    head = json.dumps({"format": FORMAT, "track": track, "planner": planner})[:-1]
    lines = [f"{json.dumps(name)}: {json.dumps(verdicts[name], separators=(',', ':'))}" for name in sorted(verdicts)]
    file.write_text(head + ', "verdicts": {\n' + ",\n".join(lines) + "\n}}\n")
    return len(verdicts)


def check_verdicts(file: Path, robot: Json, problems: Any, make_contacts: Any) -> list[str]:
    """Return a sentence for each witness path of a file of verdicts that the validator refuses.

    Raises:
        ValueError: The file has another format.
    """
    data, by_name = json.loads(file.read_text()), {problem.name: problem for problem in problems}
    if data.get("format") != FORMAT:
        raise ValueError(f"the format of {file} is {data.get('format')}; it must be {FORMAT}")
    refused = []
    for name, entry in data["verdicts"].items():
        if name not in by_name:
            refused.append(f"{name}: there is no such problem")
        elif entry["verdict"] == "solved":
            verdict = validate(robot, by_name[name].to_dict(), entry.get("path"), make_contacts)
            refused += [] if verdict.is_accepted else [f"{name}: {verdict.sentence}"]
    return refused
