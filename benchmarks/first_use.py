"""W14: how long a stranger waits: every command of the README and of the help, each in a process of its own, with an empty
kernel cache and with a filled one.

Filled is what the cold run left, for a command on one configuration; for a batch command, all its kernels on level 1, compiled
by a run before. ``--candidate before=CHECKOUT --candidate after=CHECKOUT`` measures checkouts beside each other, one command
at a time.
"""

from __future__ import annotations

import argparse
import ast
import contextlib
import os
import re
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import harness
from harness import Spread

HERE = Path(__file__).resolve().parents[1]
SINGLE = ("arms", "describe", "index", "susceptibility", "optimise", "follow", "power-loss", "simulate", "recover")
SINGLE += ("stationary-points",)
SINGLE += ("self-motion", "export", "report", "help", "import holdfast", "study new", "study status", "study verify")
SINGLE += ("cell check", "certificate show", "certify structural-zero", "ceiling", "faults draw", "records list")
SINGLE += (
    "records show",
    "records check",
    "study merge",
    "teleop allocation",
    "teleop protocol",
    "teleop texts",
    "teleop serve",
    "studio",
)
SERVERS = ("studio", "teleop serve")  # timed until they say where the page is

REGION = """name: in front of the robot
angles: deg
box: {center: [0.5, 0, 0.4], size: 0.3, rpy_center: [180, 0, 0], rpy_size: 40}
"""
PATH = """name: across
angles: deg
line:
  from: {xyz: [0.5, -0.25, 0.4], urdf_rpy: [180, 0, 0]}
  to: {xyz: [0.5, 0.25, 0.4], urdf_rpy: [180, 0, 0]}
timing: {duration: 8}
"""
FILES = {
    "path.yaml": PATH,
    "line.yaml": PATH,
    "cell.yaml": REGION,
    "bench.yaml": "objects: {table: {box: [0.8, 1.2, 0.04], pose: {xyz: [0.6, 0, -0.02]}}}\n",
    "faults.yaml": "faults: [{kind: locked, onset: {uniform: [0.3, 1.5]}}]\n",
    "motion.csv": "joint1_rad,joint2_rad,joint3_rad\n0.3,0.8,1.1\n0.35,0.77,1.15\n",
}
STUDY = "holdfast study new tools.yaml --arm panda --arm iiwa14 --poses 200 --chunk 100 --seed 1"
EXPERIMENT = "holdfast teleop run --simulated --operators 24 --seed 1 --out experiment"
CERTIFICATE = "holdfast certify reach planar-3r --box '1.5 0.5' --size 0.4 --lock joint2=0.9..1.1"
HEALTHY = "holdfast simulate-logs panda --records 2 --out healthy"
EARLIER = {  # what somebody has run before, not timed
    "report": ["holdfast assess planar-3r --poses 200 --seed 1 --out results"],
    "study run": [STUDY],
    "study status": [STUDY, "holdfast study run tools.yaml --out tools"],
    "study verify": [STUDY, "holdfast study run tools.yaml --out tools"],
    "study report": [STUDY, "holdfast study run tools.yaml --out tools"],
    "study merge": [STUDY, *(f"holdfast study run tools.yaml --out machine{k}/tools --part {k}/2" for k in (1, 2))],
    **{f"teleop {of}": [EXPERIMENT] for of in ("analyse", "backup", "export", "replay", "subjects", "verify")},
    **{f"certificate {of}": [CERTIFICATE] for of in ("check", "show")},
    "calibrate": [HEALTHY],
    "diagnose": [HEALTHY, "holdfast calibrate healthy/000000.npz healthy/000001.npz --arm panda --out bounds.json"],
}
GROUPS = ("bench", "cell", "certificate", "certify", "faults", "records", "study", "teleop")  # their commands have two words
ELSEWHERE = ("--scheduler", "/mnt/")  # needs another machine, or writes outside of the folder that is thrown away


@dataclass(frozen=True)
class Candidate:
    """A checkout, and the Python that runs it."""

    name: str
    checkout: Path
    python: str

    def command(self, words: list[str]) -> list[str]:
        if words[0] == "import":
            return [self.python, "-c", "import holdfast"]
        return [self.python, "-m", "holdfast", *words[1:]]

    def environment(self, cache: Path, level: str = "") -> dict[str, str]:
        """Kernel caches of holdfast, and of heyoka, which kept its own, inside ``cache``; all other caches as they are."""
        kept = {k: v for k, v in os.environ.items() if k not in ("PYTHONDONTWRITEBYTECODE", "HOLDFAST_BACKEND")}
        usual = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
        return {
            **kept,
            "HOLDFAST_LEVEL": level,
            "PYTHONPATH": str(self.checkout / "src"),
            "HOLDFAST_CACHE": str(cache / "holdfast"),
            "XDG_CACHE_HOME": str(cache),
            "MPLCONFIGDIR": os.environ.get("MPLCONFIGDIR", str(usual / "matplotlib")),  # its list of fonts takes seconds
        }


@dataclass(frozen=True)
class Took:
    """One run of one command."""

    processor: float
    wall: float
    failed: str = ""


def readme(checkout: Path) -> list[str]:
    """Every ``holdfast`` command of the README's shell blocks; one after && is a command of its own."""
    blocks = re.findall(r"```sh\n(.*?)```", (checkout / "README.md").read_text(), re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    parts = [part for line in lines for part in shlex.join(shlex.split(line, comments=True)).split("'&&'")]
    return [part.strip() for part in parts if part.strip().startswith("holdfast ")]


def examples(checkout: Path) -> list[str]:
    """The examples of every command's help, which is the docstring of its function."""
    found = []
    for file in sorted((checkout / "src/holdfast/interface/cli").rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef):
                found += re.findall(r"^Example: (holdfast .+)$", ast.get_docstring(node) or "", re.MULTILINE)
    return [shlex.join(shlex.split(text)) for text in found]


def name_of(command: str) -> str:
    """``index``, ``study new``."""
    words = shlex.split(command)
    if words[0] == "import":
        return command
    if words[1].startswith("-"):
        return "help"
    return " ".join(words[1 : 3 if words[1] in GROUPS else 2])


def prepare(command: str, folder: Path, candidate: Candidate, cache: Path) -> None:
    """The files that the command reads."""
    robot = (HERE / "src/holdfast/model/arms/data/panda.urdf").read_text()
    for old, new in (("panda_link0", "base_link"), ("panda_hand_tcp", "tool0")):
        robot = robot.replace(f'"{old}"', f'"{new}"')
    name = name_of(command)
    for file, text in {"my_robot.urdf": robot, **FILES}.items():
        if file in command and not name.startswith("study"):
            (folder / file).write_text(text)
    for earlier in EARLIER.get(name, []):
        words = shlex.split(earlier.replace("tools.yaml", "cell.yaml") if "cell.yaml" in command else earlier)
        run = candidate.command(words)
        subprocess.run(run, cwd=folder, env=candidate.environment(cache), check=True, capture_output=True)


def measure(command: str, candidate: Candidate, cache: Path, prepared: Path, limit: float, level: str = "") -> Took:
    """Seconds of the process and of those that it started."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        prepare(command, folder, candidate, prepared)
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        process = subprocess.Popen(
            candidate.command(shlex.split(command)),
            cwd=folder,
            env=candidate.environment(cache, level),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        failed = ""
        try:
            if name_of(command) in SERVERS:
                assert process.stdout is not None
                failed = "" if "http" in process.stdout.readline() else "said no address"
                wall = time.perf_counter() - start
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=limit)
            else:
                _, said = process.communicate(timeout=limit)
                wall = time.perf_counter() - start
                if process.returncode not in (0, 3):  # 3: it ran, and the answer is no
                    failed = (said.strip().splitlines() or [f"exit code {process.returncode}"])[-1]
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            wall, failed = time.perf_counter() - start, f"stopped after {limit:g} s"
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return Took(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall, failed)


def shown(runs: list[Took]) -> str:
    """Processor seconds, and wall seconds in brackets."""
    failed = next((r.failed for r in runs if r.failed), "")
    text = f"{median_of(runs).processor:.2f} ({median_of(runs).wall:.2f})"
    return f"{text}: {failed}" if failed else text


def median_of(runs: list[Took]) -> Took:
    """Of each number apart."""
    return Took(Spread.of([r.processor for r in runs]).median, Spread.of([r.wall for r in runs]).median)


def longer(cold: list[Took], filled: list[Took]) -> str:
    """By how much a cold run takes longer, of the processors and by the clock."""
    a, b = median_of(cold), median_of(filled)
    return f"{a.processor - b.processor:.2f} ({a.wall - b.wall:.2f})"


def main() -> None:
    own = argparse.ArgumentParser(add_help=False)
    own.add_argument("--candidate", action="append", default=[], metavar="[NAME=]CHECKOUT", help="may be given again")
    own.add_argument("--python", default=sys.executable, help="interpreter with the dependencies (default: this one)")
    own.add_argument("--only", action="append", default=[], metavar="TEXT", help="commands that hold this; may be given again")
    part = own.add_mutually_exclusive_group()
    part.add_argument("--single", action="store_true", help="only commands on one configuration, pose or motion")
    part.add_argument("--batch", action="store_true", help="only the others")
    own.add_argument("--limit", type=float, default=600.0, help="stop a command after so many seconds (default %(default)s)")
    chosen = harness.options(__doc__, rounds=1, parents=[own])
    candidates = []
    for text in chosen.candidate or [f"holdfast={HERE}"]:
        name, _, checkout = text.rpartition("=")
        candidates.append(Candidate(name or Path(checkout).name, Path(checkout).resolve(), chosen.python))
    commands = list(dict.fromkeys(["import holdfast", "holdfast --help", *readme(HERE), *examples(HERE)]))
    commands = [c for c in commands if all(word not in c for word in ELSEWHERE)]
    commands = [c for c in commands if any(word in c for word in chosen.only or [""])]
    if chosen.single or chosen.quick:
        commands = [c for c in commands if name_of(c) in SINGLE]
    if chosen.batch:
        commands = [c for c in commands if name_of(c) not in SINGLE]
    with tempfile.TemporaryDirectory() as kept:
        for c in candidates:  # bytecode is no part of this
            subprocess.run([c.python, "-m", "compileall", "-q", str(c.checkout / "src")], check=True)
        cold: dict[tuple[str, str], list[Took]] = {}
        filled: dict[tuple[str, str], list[Took]] = {}
        for command in commands:
            single = name_of(command) in SINGLE
            with contextlib.ExitStack() as stack:
                ready = {c.name: Path(stack.enter_context(tempfile.TemporaryDirectory())) for c in candidates}
                for c in [] if single else candidates:
                    measure(command, c, ready[c.name], Path(kept) / c.name, chosen.limit, level="1")
                for c in candidates * chosen.rounds:
                    harness.progress(f"{c.name}: {command}")
                    with tempfile.TemporaryDirectory() as cache:
                        for times, place in ((cold, Path(cache)), (filled, Path(cache) if single else ready[c.name])):
                            took = measure(command, c, place, Path(kept) / c.name, chosen.limit)
                            times.setdefault((command, c.name), []).append(took)
                            harness.progress(f"  {shown([took])}")
    for single, kind, state in ((True, "one configuration, pose, motion or file", "warm"), (False, "many", "level 1 there")):
        some = [x for x in commands if (name_of(x) in SINGLE) == single]
        columns = ["cold", state, *([] if single else ["longer by"])]
        lines = []
        for x in some:
            pairs = [(cold[x, c.name], filled[x, c.name]) for c in candidates]
            cells = [[shown(a), shown(b), *([] if single else [longer(a, b)])] for a, b in pairs]
            lines.append([f"`{x}`", *(cell for group in cells for cell in group)])
        if some:
            head = ["command", *(f"{c.name}: {column}" for c in candidates for column in columns)]
            print(harness.table(f"W14: first use, {kind}: processor seconds of a fresh process (wall)", head, lines))
    print(
        "Cold: empty kernel cache; warm: what the cold run left in it; level 1 there: what a run with `HOLDFAST_LEVEL=1` left."
        " Asked for: 2.0 and, without `--out`, 0.8 for one; at most 2.0 longer for many. Servers (`studio`, `teleop serve`)"
        " until they say where the page is, and their end."
    )


if __name__ == "__main__":
    main()
