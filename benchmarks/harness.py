"""Timing in alternating rounds, and the tables that come of it."""

from __future__ import annotations

import os

os.environ.setdefault("OMP_WAIT_POLICY", "passive")  # OpenMP threads that spin after their work would slow the next contender

import argparse
import datetime
import platform
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

Array = np.ndarray
Function = Callable[[Array], Any]

PACKAGES = (
    "holdfast-arms",
    "numpy",
    "scipy",
    "casadi",
    "llvmlite",
    "jax",
    "numba",
    "pin",
    "roboticstoolbox-python",
    "pytracik",
    "ssik",
    "pin-pink",
    "mink",
    "mujoco",
    "coal",
    "python-fcl",
    "daqp",
    "proxsuite",
)


class MissingError(Exception):
    """Something a peer needs that pip does not install, such as a compiler; the message goes into the table."""


@dataclass(frozen=True)
class Contender:
    """One way to compute the workload.

    Attributes:
        name: Row of the table.
        make: Imports, builds and compiles, and returns the function of row-major configurations that is timed.
        rows: Configurations per timed call: the batch this contender is best at, or fewer if it is slow.
        note: Right column of the table.
    """

    name: str
    make: Callable[[], Function]
    rows: int
    note: str = ""


@dataclass(frozen=True)
class Spread:
    """Median, smallest and largest of one number over the rounds."""

    median: float
    least: float
    most: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Spread:
        return cls(statistics.median(values), min(values), max(values))

    def __str__(self) -> str:
        return f"{number(self.median)} ({number(self.least)} to {number(self.most)})"


def number(x: float) -> str:
    """Three digits, without an exponent where people can read it."""
    return f"{x:.0f}" if abs(x) >= 100 else f"{x:.3g}"


def seconds(call: Callable[[], object], clock: Callable[[], float] = time.perf_counter) -> float:
    start = clock()
    call()
    return clock() - start


def alternate(
    first: Callable[[], object], second: Callable[[], object], rounds: int, clock: Callable[[], float] = time.perf_counter
) -> tuple[list[float], list[float]]:
    """Seconds of both, measured one after the other ``rounds`` times, so that a busy moment hits both; each warmed up."""
    first()
    second()
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(rounds):
        times[0].append(seconds(first, clock))
        times[1].append(seconds(second, clock))
    return times


def largest_error(
    function: Function, q: Array, expected: Array, scale: Array | float = 1.0, read: Callable[[Any], Array] = np.asarray
) -> float:
    return float((np.abs(read(function(q)) - expected) / scale).max())


def race(
    title: str,
    candidate: Contender,
    peers: Sequence[Contender],
    q: Array,
    sample: Array,
    expected: Array,
    rounds: int,
    scale: Array | float = 1.0,
    read: Callable[[Any], Array] = np.asarray,
) -> str:
    """Time the candidate against each peer in turn.

    Args:
        title: Of the table.
        candidate: Ours.
        peers: The others; one that cannot be imported, built or run gets a row that says so.
        q: (N, n) configurations; a contender takes the first ``rows`` of them.
        sample: (M, n) configurations on which every contender is checked.
        expected: What it must give there, by an independent route.
        rounds: Of candidate and peer.
        scale: By which errors are divided.
        read: Makes an array like ``expected`` of what a contender returns; not timed.

    Returns:
        A markdown table.
    """
    ours = candidate.make()
    error = largest_error(ours, sample, expected, scale, read)
    own_rates: list[float] = []
    lines: list[list[str]] = []
    for peer in peers:
        progress(f"{title}: {peer.name}")
        try:
            build = time.perf_counter()
            theirs = peer.make()
            peer_error = largest_error(theirs, sample, expected, scale, read)
            build = time.perf_counter() - build
            a, b = q[: candidate.rows], q[: peer.rows]
            first, second = alternate(lambda a=a: ours(a), lambda b=b, f=theirs: f(b), rounds)
        except ImportError as missing:
            lines.append([peer.name, "-", "-", "-", f"not installed: {missing.name}"])
            continue
        except MissingError as missing:
            lines.append([peer.name, "-", "-", "-", f"not available: {missing}"])
            continue
        except Exception as failure:  # one broken peer must not cost the others their rows
            lines.append(
                [peer.name, "-", "-", "-", f"failed: {type(failure).__name__}: {str(failure)[:80]}".replace("\n", " ")]
            )
            continue
        own = [len(a) / t / 1e6 for t in first]
        their = [len(b) / t / 1e6 for t in second]
        own_rates += own
        ratio = Spread.of([x / y for x, y in zip(own, their, strict=True)])
        note = "; ".join(filter(None, [f"batch {len(b)}", f"ready after {build:.1f} s" if build > 0.5 else "", peer.note]))
        lines.append([peer.name, number(statistics.median(their)), str(ratio), f"{peer_error:.0e}", note])
    rate = number(statistics.median(own_rates)) if own_rates else "-"
    lines.insert(0, [f"**{candidate.name}**", rate, "1", f"{error:.0e}", f"batch {candidate.rows}"])
    return table(title, ["contender", "M/s", "holdfast is faster by (range)", "largest error", "note"], lines)


def table(title: str, head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """Markdown; every column but the first and the last is numbers."""
    rule = ["---", *["---:"] * (len(head) - 2), "---"]
    return "\n".join([f"### {title}", "", *("| " + " | ".join(cells) + " |" for cells in [head, rule, *lines]), ""])


def environment() -> str:
    """One line: when, on what, with which versions."""
    now = datetime.datetime.now(datetime.UTC)
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    parts = [f"{now:%Y-%m-%d %H:%M} UTC", processor(), f"{os.cpu_count()} cores", f"load {load:.2f}"]
    parts.append(f"python {platform.python_version()}")
    for package in PACKAGES:
        try:
            parts.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            parts.append(f"{package} not installed")
    return ", ".join(parts)


def processor() -> str:
    try:
        fields = dict(
            [part.strip() for part in line.split(":", 1)]
            for line in Path("/proc/cpuinfo").read_text().splitlines()
            if ":" in line
        )
        return f"{fields['model name']} (family {fields['cpu family']}, model {fields['model']})"
    except (OSError, KeyError):
        return platform.processor() or platform.machine()


def progress(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def options(description: str | None, rounds: int = 5, parents: Sequence[argparse.ArgumentParser] = ()) -> argparse.Namespace:
    """``--rounds`` and ``--quick``, the same for every workload, and what ``parents`` add."""
    parser = argparse.ArgumentParser(description=description, parents=list(parents))
    parser.add_argument("--rounds", type=int, default=rounds, help="rounds of candidate and peer (default %(default)s)")
    parser.add_argument("--quick", action="store_true", help="one round on small batches: does it run, not how fast")
    chosen = parser.parse_args()
    if chosen.quick:
        chosen.rounds = 1
    return chosen
