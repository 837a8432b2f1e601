"""What takes too long for every day: 'make soak' runs this and prints a table.

Options are variables of the environment, as the tests have them:

    HOLDFAST_STATIONS   stations at once, 8
    HOLDFAST_RATE       messages per second of each, 60
    HOLDFAST_SECONDS    of this load, 600
    HOLDFAST_FUZZ       malformed messages, 100000, read, and once more over the network
    HOLDFAST_OUTAGE     seconds without network in mid-trial, in a browser, 30
    HOLDFAST_KILLS      of a program that writes records, 40
    HOLDFAST_FLIPS      single bits changed in a folder of records, 10000
    HOLDFAST_CHANGES    single bits, and as many digits, changed in each file of assessments, studies and experiments, 2000
    HOLDFAST_SILENT     sockets that begin a request and do not end it, while 8 stations work for 30 s, 1500
    HOLDFAST_ROUNDS     of two child processes forked, of two spawned, and of four threads, while kernels are made, 1000 each
    HOLDFAST_INPUTS     mutated input files of every kind, 40000
    HOLDFAST_WATCHED    random records that the monitor in C and that in Python watch, 10000
    HOLDFAST_COMPILED   1: random arms with compiled kernels, where the daily tests interpret them

The load is served in a process of its own, on loopback. Ends with 1 if a cycle was lost, a trial differs when it is replayed,
a message changed anything, a changed bit of data went unseen, an input file ended in anything but a value or a sentence, a
process or thread waited for ever, the monitor in C says anything else than that in Python, or the 99th percentile of the
acknowledgements is above 50 ms, 100 ms among silent sockets.
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "teleop" / "serve"))

from load import Figures, load  # noqa: E402
from silent import attacked  # noqa: E402

import fuzz_inputs  # noqa: E402

MOST, MOST_ATTACKED = 50.0, 100.0  # ms
LOG = 1_000_000  # bytes
FUZZED = ("teleop/serve/test_serve_messages.py", "teleop/serve/test_serve_server.py")
OUTAGE = ("browser/test_session.py",)
KILLED = ("teleop/test_records.py",)
FLIPPED = ("cli/test_teleop_verify_command.py",)
CHANGED = ("assessment/test_changed_files.py", "engine/test_changed_study.py", "teleop/test_changed_records.py")
ROUNDS = ("kernels/test_kernel_levels.py",)
STARTED = {"fork": "child_process and fork", "spawn": "child_process and spawn", "threads": "threads_make"}
COMPILED = ("arm", "test_kinematics.py")


def _tests(files: tuple[str, ...], which: str, name: str, value: str) -> tuple[bool, float]:
    """Run some tests with an option; whether they passed, and how long they took, s."""
    command = [sys.executable, "-m", "pytest", "-q", "-k", which, *(str(HERE / f) for f in files)]
    begin = time.monotonic()
    done = subprocess.run(command, env={**os.environ, name: value}, cwd=HERE.parent)
    return done.returncode == 0, time.monotonic() - begin


def main() -> int:
    """Run all of it; the exit code."""

    def option(name: str, default: str) -> str:
        return os.environ.get(f"HOLDFAST_{name}", default)

    fuzz, outage, kills = option("FUZZ", "100000"), option("OUTAGE", "30"), option("KILLS", "40")
    with tempfile.TemporaryDirectory() as folder:
        stations, rate, seconds = option("STATIONS", "8"), option("RATE", "60"), option("SECONDS", "600")
        figures: Figures = load(Path(folder), int(stations), float(rate), float(seconds))
    attack = attacked(int(option("SILENT", "1500")), 8, 60.0, 30.0)
    fuzzed, fuzz_s = _tests(FUZZED, "malformed", "HOLDFAST_FUZZ", fuzz)
    kept, outage_s = _tests(OUTAGE, "network", "HOLDFAST_OUTAGE", outage)
    survived, kills_s = _tests(KILLED, "killed", "HOLDFAST_KILLS", kills)
    flips = option("FLIPS", "10000")
    seen, flips_s = _tests(FLIPPED, "changed_bit", "HOLDFAST_FLIPS", flips)
    changes = option("CHANGES", "2000")
    refused, changes_s = _tests(CHANGED, "changed", "HOLDFAST_CHANGES", changes)
    rounds = option("ROUNDS", "1000")
    alive = {kind: _tests(ROUNDS, which, "HOLDFAST_ROUNDS", rounds) for kind, which in STARTED.items()}
    inputs = fuzz_inputs.fuzz(int(option("INPUTS", "40000")), fuzz_inputs.SEED, os.cpu_count() or 1)
    compiled, compiled_s = _tests(COMPILED, "interpreted", "HOLDFAST_COMPILED", option("COMPILED", "1"))

    watched = option("WATCHED", "10000")
    same = subprocess.run([sys.executable, str(HERE / "diagnosis" / "c_monitor.py"), watched]).returncode == 0

    begin, middle, end = figures.memory
    rows = [
        ("stations, messages/s of each, s", f"{figures.stations}, {figures.rate:g}, {figures.seconds:g}"),
        ("cycles sent", f"{figures.sent}"),
        ("cycles lost", f"{figures.lost}"),
        ("trials that differ when replayed", f"{figures.differing}"),
        ("acknowledged after p50, p99, at most, ms", f"{figures.p50:.1f}, {figures.p99:.1f}, {figures.longest:.1f}"),
        ("memory of the server: begin, half-way, end, MiB", f"{begin:.0f}, {middle:.0f}, {end:.0f}"),
        ("of one core", f"{figures.busy:.0%}"),
        (f"{fuzz} malformed messages, twice", f"{'all refused, nothing changed' if fuzzed else 'FAILED'} ({fuzz_s:.0f} s)"),
        (f"{outage} s without network in mid-trial", f"{'nothing lost' if kept else 'FAILED'} ({outage_s:.0f} s)"),
        (f"{kills} times killed", f"{'nothing lost' if survived else 'FAILED'} ({kills_s:.0f} s)"),
        (f"{flips} bits changed", f"{'all of data seen' if seen else 'FAILED'} ({flips_s:.0f} s)"),
        (f"{changes} bits and digits of stored files", f"{'all refused' if refused else 'FAILED'} ({changes_s:.0f} s)"),
        (f"{attack.sockets} silent sockets: p99, ms; lost; log", f"{attack.p99:.1f}; {attack.lost}; {attack.log} B"),
        (
            f"{inputs.counts.total()} mutated input files",
            f"{len(inputs.failed)} failed, the longest took {inputs.slowest:.1f} s (case {inputs.slowest_case})",
        ),
        *(
            (f"{rounds} rounds of {kind}", f"{'no deadlock' if well else 'FAILED'} ({took:.0f} s)")
            for kind, (well, took) in alive.items()
        ),
        (f"{watched} records, the monitor in C", "as in Python" if same else "FAILED"),
        ("random arms, compiled", f"{'as they should be' if compiled else 'FAILED'} ({compiled_s:.0f} s)"),
    ]
    print(f"\nSoak test, {time.strftime('%Y-%m-%d')}, Python {platform.python_version()}, {os.cpu_count()} cores")
    for name, value in rows:
        print(f"  {name:<50} {value}")
    for cause in inputs.causes():
        print(f"  tests/fuzz_inputs.py: {cause}")
    passed = fuzzed and kept and survived and seen and refused and compiled and same
    lost = figures.lost != 0 or figures.differing != 0 or attack.lost != 0
    slow = figures.p99 > MOST or attack.p99 > MOST_ATTACKED or attack.log > LOG
    return int(lost or slow or bool(inputs.failed) or not (passed and all(well for well, _ in alive.values())))


if __name__ == "__main__":
    sys.exit(main())
