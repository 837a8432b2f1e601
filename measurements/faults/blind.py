"""Files of logs at 200 Hz, in three formats, for the command line alone: the right joint, a wrong one, or no alarm."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import fields, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import holdfast as hf
from holdfast.response.faults import Log
from measurements.faults.records import KINDS, LENGTH
from measurements.faults.store import COULOMB, VISCOUS, Store, of

RATE, EVERY = 200.0, 5  # Hz, of the logs; cycles of the simulation between their rows
CALIBRATION, SECONDS = 20, 20.0  # records, s of each
LATE = 4  # rows by which every second log has the tool's pose too late, which the command is told
SEEDS = 90_000
UNDECLARED = 10  # healthy logs with late poses, which the command is not told
FORMATS = ("npz", "csv", "parquet")


def thinned(log: Log, *, late: int = 0) -> Log:
    """A log of 200 Hz, whose poses are some rows late."""
    parts = {f.name: getattr(log, f.name)[::EVERY] for f in fields(Log)}
    found = Log(**parts)
    if not late:
        return found
    moved = (np.concatenate([np.full((late, parts[x].shape[1]), np.nan), parts[x][:-late]]) for x in ("x", "quat"))
    return replace(found, **dict(zip(("x", "quat"), moved, strict=True)))


def command(folder: Path, *words: str) -> str:
    """What ``holdfast`` prints; 3 is an alarm."""
    done = subprocess.run([sys.executable, "-m", "holdfast", *words], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        raise RuntimeError(done.stderr)
    return done.stdout


def calibrated(arm: hf.Arm) -> str:
    """Bounds, as the text of their file."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        logs = hf.diagnosis.simulate_logs(arm, SECONDS, seeds=range(SEEDS, SEEDS + CALIBRATION))
        files = [thinned(log).save(folder / f"{k}.npz").name for k, log in enumerate(logs)]
        friction = ("--coulomb", str(COULOMB), "--viscous", str(VISCOUS))
        command(folder, "calibrate", *files, "--arm", arm.name, *friction, "--out", "bounds.json")
        return (folder / "bounds.json").read_text(encoding="utf-8")


def diagnosed(arm: hf.Arm, bounds: str, number: int, log: Log, latency: float) -> dict[str, Any]:
    """What the command prints about one log whose poses are declared to be so late, s."""
    with tempfile.TemporaryDirectory() as place:
        folder, name = Path(place), f"log.{FORMATS[number % 3]}"
        log.save(folder / name)
        (folder / "bounds.json").write_text(bounds, encoding="utf-8")
        given = ("--arm", arm.name, "--bounds", "bounds.json", "--latency", str(latency), "--json")
        return dict(json.loads(command(folder, "diagnose", name, *given)))


def judged(arm: hf.Arm, bounds: str, number: int) -> dict[str, Any]:
    """What the command says of one log; every seventh is healthy, the others have a fault of any kind."""
    rng, events = np.random.default_rng([14, number]), []
    kind = None if number % 7 == 0 else sorted(KINDS)[rng.integers(len(KINDS))]
    if kind is not None:
        events = [*hf.faults.FaultModel([KINDS[kind]], seed=14).draw(arm, episode=number)]
    late = LATE * (number % 2)
    log = thinned(hf.diagnosis.simulate_log(arm, LENGTH, seed=SEEDS + 1000 + number, faults=events), late=late)
    said = diagnosed(arm, bounds, number, log, late / RATE)
    true = events[0].joint if events else None
    early = bool(said["alarm"] and (not events or said["time_s"] < events[0].onset))
    return {"kind": kind, "joint": true, "said": said["joint"], "named": said["kind"], "alarm": said["alarm"], "early": early}


def undeclared(arm: hf.Arm, bounds: str, number: int) -> dict[str, Any]:
    """What the command says of a healthy log whose poses are late, and which does not say so."""
    log = thinned(hf.diagnosis.simulate_log(arm, LENGTH, seed=SEEDS + 2000 + number), late=LATE)
    said = diagnosed(arm, bounds, number, log, 0.0)
    return {"alarm": said["alarm"], "named": said["kind"]}


def table(store: Store, count: int) -> list[str]:
    """How they came out."""
    bounds = store.get("blind bounds", partial(calibrated, store.arm))
    found = [store.get(f"blind {k}", partial(judged, store.arm, bounds, k)) for k in range(count)]
    faulty, healthy = ([one for one in found if bool(one["kind"]) is which] for which in (True, False))
    silent = [one for one in faulty if not one["alarm"]]
    right = [one for one in faulty if one["alarm"] and not one["early"] and one["said"] == one["joint"]]
    wrong = [one for one in faulty if one not in silent and one not in right]
    false = [one for one in healthy if one["alarm"]]
    unheard = ", ".join(f"{kind} {n}" for kind, n in Counter(one["kind"] for one in silent).items())
    late = [store.get(f"blind undeclared {k}", partial(undeclared, store.arm, bounds, k)) for k in range(UNDECLARED)]
    alarmed = [one["named"] for one in late if one["alarm"]]
    lines = [
        "## Files of logs",
        "",
        f"`holdfast diagnose` evaluates {count} logs of {RATE:g} Hz in {', '.join(FORMATS)} files, each from another robot. "
        "Every seventh log is healthy, and the others have a fault of any kind in the table above. `holdfast calibrate` sets "
        f"the thresholds from {CALIBRATION} robots with {SECONDS:g} s each. In every second log the tool pose is "
        f"{LATE / RATE * 1e3:g} ms late, and `--latency` states this.",
        "",
        f"Results for the {len(faulty)} faults: the correct joint is named in {of(len(right), len(faulty))}, no alarm in "
        f"{of(len(silent), len(faulty))} ({unheard or '-'}), a wrong joint or an alarm before the fault in "
        f"{of(len(wrong), len(faulty))}. False alarms in the healthy logs: {of(len(false), len(healthy))}.",
    ]
    lines += [f"* {one['kind']} of {one['joint']}, called {one['named']} of {one['said']}" for one in wrong]
    lines += [
        "",
        f"In {UNDECLARED} other healthy logs the poses are {LATE / RATE * 1e3:g} ms late, and `--latency` is not given. "
        f"Alarms in {of(len(alarmed), UNDECLARED)}, classified as {', '.join(sorted(set(alarmed))) or '-'}.",
    ]
    return [*lines, ""]
