"""Run planners on the problems: ``python -m benchmarks.locked_planning --planner holdfast --planner ompl --count 20``.

Ctrl-C stops after the current problem; the same command resumes.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.locked_planning.adapters import ADAPTERS, Answer, Planner
from benchmarks.locked_planning.goals import find_goal_configurations
from benchmarks.locked_planning.mesh_contacts import MeshContacts
from benchmarks.locked_planning.problems import Problem, draw, make_healthy, make_locked, read_problems
from benchmarks.locked_planning.results import check_verdicts, make_table, path_length, read_results, write_verdicts
from benchmarks.locked_planning.robots import load_robot, write_files
from benchmarks.locked_planning.validator import Floats, Json, SphereContacts, validate

CONTACTS: dict[str, Any] = {"spheres": SphereContacts, "meshes": MeshContacts}


def run_problem(planner: Planner, problem: Problem, goals: Floats, seconds: float) -> Json:
    """Return the answer of a planner with its times as a record."""
    if planner.needs_goals and not len(goals):
        answer = Answer("undecided", None, "no goal configuration found")
        times: Json = {"processor_s": None, "wall_s": None}
    else:
        wall, processor = time.perf_counter(), time.process_time()
        try:
            answer = planner.solve(problem, goals, seconds)
        except Exception as error:  # of another package; the run goes on, and the record contains the message
            answer = Answer("undecided", None, f"error: {error!r}")
        times = {"processor_s": time.process_time() - processor, "wall_s": time.perf_counter() - wall}
    path = None if answer.path is None else answer.path.tolist()
    return {"verdict": answer.verdict, "note": answer.note, "path": path, **times}


def run_track(options: argparse.Namespace, track: str, problems: list[Problem], robot: Json, interrupts: list[int]) -> None:
    """Run every planner on every problem of a track that has no record yet, the planners in turns."""
    file = options.out / "results.jsonl"
    done = {(row["track"], row["problem"], row["planner"]) for row in read_results(file)}
    planners: dict[str, Planner] = {}
    urdf = write_files(robot, options.work / track)

    def find_goals(problem: Problem) -> Floats:
        return find_goal_configurations(robot, problem, CONTACTS[track](robot, problem.objects))

    warm_up = next((problem for problem in problems if len(find_goals(problem))), problems[0])
    for name in options.planner or ADAPTERS:
        adapter = ADAPTERS[name]
        if adapter.missing():
            print(f"{name} is skipped: {adapter.missing()}", file=sys.stderr)
        elif track not in adapter.tracks:
            print(f"{name} is skipped on the track {track}, which it does not support", file=sys.stderr)
        elif any((track, problem.name, name) not in done for problem in problems):
            planners[name] = adapter(robot, urdf)
            run_problem(planners[name], warm_up, find_goals(warm_up), options.seconds)  # compiles and imports
    with file.open("a+b") as stored:
        stored.seek(-min(1, stored.tell()), os.SEEK_END)
        if stored.read() not in (b"", b"\n"):
            stored.write(b"\n")  # ends a line that an interrupt cut off
    with file.open("a") as lines:
        for number, problem in enumerate(problems):
            open_planners = {name: one for name, one in planners.items() if (track, problem.name, name) not in done}
            if not open_planners:
                continue
            goals = find_goals(problem)
            for name, planner in open_planners.items():
                if interrupts:
                    return
                record = run_problem(planner, problem, goals, options.seconds)
                solved = record["verdict"] == "solved"
                verdict = validate(robot, problem.to_dict(), record["path"], CONTACTS[track]) if solved else None
                record["violation"], record["check"] = (verdict.kind, verdict.sentence) if verdict else ("", "")
                record["length"] = path_length(record["path"]) if solved else None
                head = {"track": track, "kind": problem.kind, "problem": problem.name, "planner": name}
                lines.write(json.dumps({**head, "version": planner.version(), **record}) + "\n")
                lines.flush()
                progress = (
                    f"{track}, {problem.kind} {number + 1} of {len(problems)}: {name} {record['verdict']} {record['check']}"
                )
                print(f"\r{progress[:118]:118}", end="", file=sys.stderr)
    print(file=sys.stderr)


def main(arguments: list[str] | None = None) -> int:
    """Run the planners, write the results and the table, and return 130 after Ctrl-C."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.locked_planning", description=__doc__)
    parser.add_argument("--problems", type=Path, help="MotionBenchMaker's archive of the Panda, or problems as JSON")
    parser.add_argument("--robot", type=Path, help="VAMP's panda_spherized.urdf, or a robot as JSON")
    parser.add_argument("--track", choices=CONTACTS, action="append", help="may be repeated; default: spheres")
    parser.add_argument("--arm", choices=("healthy", "locked"), action="append", help="may be repeated; default: both")
    parser.add_argument("--all-locked", action="store_true", help="all 9,786 locked problems, not the fixed draw of 700")
    parser.add_argument("--count", type=int, help="first problems of each draw; default: all")
    parser.add_argument("--planner", choices=ADAPTERS, action="append", help="may be repeated; default: all that are installed")
    parser.add_argument("--seconds", type=float, default=10.0, help="time limit of a problem")
    parser.add_argument("--out", type=Path, default=Path("locked-planning"), help="folder of results.jsonl and RESULTS.md")
    parser.add_argument("--verdicts", type=Path, help="also write the verdicts of the first planner and track to this file")
    parser.add_argument("--export", type=Path, help="only write all problems to this file, one JSON object per line")
    parser.add_argument("--check", type=Path, help="only check the paths of this file of verdicts")
    options = parser.parse_args(arguments)
    if options.count is not None and options.count < 1:
        parser.error(f"count is {options.count}; it must be 1 or more")
    if not options.seconds > 0:
        parser.error(f"seconds is {options.seconds:g}; it must be above 0")
    tracks = options.track or ["spheres"]
    try:
        robots = {track: load_robot(track, options.robot) for track in tracks}
        healthy = make_healthy(read_problems(options.problems), load_robot("spheres", options.robot))
    except (FileNotFoundError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    locked = make_locked(healthy)
    if options.export:
        rows = [json.dumps({"name": problem.name, **problem.to_dict()}) for problem in [*healthy, *locked]]
        options.export.write_text("\n".join(rows) + "\n")
        print(f"written: {options.export} with {len(rows)} problems")
        return 0
    if options.check:
        refused = check_verdicts(options.check, robots[tracks[0]], [*healthy, *locked], CONTACTS[tracks[0]])
        print("\n".join([*refused, f"{len(refused)} paths are refused"]))
        return 1 if refused else 0
    sets = {"healthy": draw(healthy), "locked": locked if options.all_locked else draw(locked)}
    interrupts: list[int] = []
    previous_handler = signal.signal(signal.SIGINT, lambda number, _: interrupts.append(number))
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        options.work = Path(folder)
        for track in tracks:
            for arm in options.arm or sets:
                run_track(options, track, sets[arm][: options.count], robots[track], interrupts)
    signal.signal(signal.SIGINT, previous_handler)
    records = read_results(options.out / "results.jsonl")
    (options.out / "RESULTS.md").write_text(make_table(records))
    print(f"written: {options.out / 'RESULTS.md'}")
    if options.verdicts:
        first = (options.planner or list(ADAPTERS))[0]
        problems, track = [*healthy, *locked], tracks[0]
        count = write_verdicts(options.verdicts, records, first, track, robots[track], problems, CONTACTS[track])
        print(f"written: {options.verdicts} with {count} verdicts")
    return 130 if interrupts else 0


if __name__ == "__main__":
    sys.exit(main())
