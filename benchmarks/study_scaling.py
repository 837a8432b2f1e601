"""W12: studies. Scaling over threads, what Dask, a stop and a status cost, and memory against the number of samples.

Usage: python benchmarks/study_scaling.py [--seconds S] [--rounds R]   (S: length of a chunk, about; 1 unless given)

Prints one line for each figure, with the load of the machine, on which all of them depend. Ratios are medians over rounds in
which both ways ran one after the other, with the quartiles. What two programs of one thread each reach together is the most
that this machine gives to two threads, whatever they compute. Each round looks at a study at one go before and after the
one that was stopped. By the clock that says nothing finer than the machine is steady; so what a stop costs is also given as
processor time of the thread that plans, commits and looks at the folder, beside those that compute chunks.
A rented machine may get less than its processors; Linux counts what others took while somebody here wanted to compute (steal).
Scaling is given over all rounds, and over those in which they took less than 2 % of it.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

import numpy as np

STUDY = """
name: benchmark
seed: 1
poses: {poses}
chunk: {chunk}
arms: [pa10-9dof]
assess: {{regions: [joints.yaml], keep: counts}}
"""
JOINTS = "joints: {lower: [-1, -1, -1, -1, -1, -1, -1, -1, -1], upper: [1, 1, 1, 1, 1, 1, 1, 1, 1]}\n"


def study(folder: Path, chunks: int, chunk: int):
    from holdfast.studies import read_study_file

    file = folder / f"{chunks}x{chunk}.yaml"
    (folder / "joints.yaml").write_text(JOINTS)
    file.write_text(STUDY.format(poses=chunks * chunk, chunk=chunk))
    return read_study_file(file)


def timed(folder: Path, asked, runner, stop=None, part=(1, 1)) -> np.ndarray:
    """Seconds by the clock, of the processor for this thread, and taken by others on the machine."""
    from holdfast.core.sweeps import Study

    s = Study.create(folder, asked.name, asked.seed, cells=asked.cells, source=asked.text)
    begin = now()
    s.run(asked.cells, runner, stop=stop or (lambda: False), part=part)
    return now() - begin


def now() -> np.ndarray:
    file = Path("/proc/stat")
    taken = int(file.read_text().split("\n")[0].split()[8]) / os.sysconf("SC_CLK_TCK") if file.exists() else 0.0
    return np.array([time.perf_counter(), time.thread_time(), taken])


def after(count: int):
    """A stop once so many chunks were begun."""
    asked = iter(range(count))
    return lambda: next(asked, None) is None


def warm(folder: Path, asked, runner) -> None:
    """Let everybody compile and import."""
    timed(folder, asked, runner, part=(1, asked.cells[0].count))


def threads(count: int):
    from holdfast.core.sweeps import ThreadRunner
    from holdfast.kernels import set_threads, shared_pool

    set_threads(count)
    return ThreadRunner(count, shared_pool())


def size_of(folder: Path, seconds: float) -> int:
    """Poses of a chunk that takes about so long in one thread."""
    asked = study(folder, 1, 1 << 18)
    job = asked.cells[0].job
    job.prepare(alone=True)
    took = []
    for _ in range(20):
        begin = time.perf_counter()
        job.run(asked.cells[0].part(0, 1))
        took.append(time.perf_counter() - begin)
    return max(int(seconds / min(took) * (1 << 18)) // 16384, 1) * 16384


def memory(chunks: int, chunk: int) -> float:
    """Peak memory, MB, of a program of its own."""
    code = f"import study_scaling as w; w.alone({chunks}, {chunk})"
    done = subprocess.run([sys.executable, "-c", code], cwd=Path(__file__).parent, capture_output=True, text=True, check=True)
    return float(done.stdout)


def alone(chunks: int, chunk: int) -> None:
    with tempfile.TemporaryDirectory() as place:
        timed(Path(place) / "out", study(Path(place), chunks, chunk), threads(2))
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def rate(chunk: int, seconds: float) -> None:
    """Print chunks per second of one thread, from when a line comes in on."""
    with tempfile.TemporaryDirectory() as place:
        cell = study(Path(place), 1, chunk).cells[0]
        cell.job.prepare(alone=True)
        cell.job.run(cell.part(0, 1))
        print("ready", flush=True)
        input()
        begin, count = time.perf_counter(), 0
        while time.perf_counter() - begin < seconds:
            cell.job.run(cell.part(0, 1))
            count += 1
        print(count / (time.perf_counter() - begin), flush=True)


def together(programs: int, chunk: int, seconds: float) -> float:
    """Chunks per second of several programs of one thread each, side by side."""
    code = f"import study_scaling as w; w.rate({chunk}, {seconds})"
    options = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True, "cwd": Path(__file__).parent}
    running = [subprocess.Popen([sys.executable, "-c", code], **options) for _ in range(programs)]
    for p in running:
        p.stdout.readline()
    for p in running:
        p.stdin.write("\n")
        p.stdin.flush()
    return sum(float(p.communicate()[0]) for p in running)


def status(folder: Path, chunks: int) -> float:
    """Seconds of the question how far a study with so many chunks is."""
    from holdfast.core.sweeps import Study

    asked = study(folder, chunks, 1)
    s = Study.create(folder / "many", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    s.cell_folder(0).mkdir(parents=True)
    done = [f"{k} {'ab' * 16} 40000 1 0".encode() for k in range(chunks)]  # a checksum, bytes, seconds, and the machine
    (s.cell_folder(0) / "done.journal").write_bytes(b"".join(b"%s %08x\n" % (text, zlib.crc32(text)) for text in done))
    begin = time.perf_counter()
    assert Study.open(folder / "many").is_complete
    return time.perf_counter() - begin


def spread(values) -> str:
    low, median, high = np.percentile(values, [25, 50, 75])
    return f"{median:.3f} ({low:.3f} to {high:.3f})"


def say(what: str, value: str) -> None:
    print(f"{what:58} {value:>26}   load {os.getloadavg()[0]:.1f}", flush=True)


def dask(folder: Path, asked, rounds: int) -> None:
    """What one worker process costs, and what two gain. Apart from the rest: its client keeps a thread of this program busy."""
    from holdfast.core.sweeps import Cluster

    threads(1)
    with Cluster("local:1") as one, Cluster("local:2") as two:
        warm(folder / "warm3", asked, one)
        warm(folder / "warm4", asked, two)
        runs = [
            [
                timed(folder / f"{name}-{k}", asked, runner)[0]
                for name, runner in (("plain", threads(1)), ("worker", one), ("workers", two))
            ]
            for k in range(rounds)
        ]
    plain, worker, workers = np.array(runs).T
    say("Dask, 1 worker with 1 thread / 1 thread", spread(worker / plain))
    say("1 thread / Dask, 2 workers with 1 thread each", spread(plain / workers))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--chunks", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--no-dask", action="store_true")
    given = parser.parse_args()

    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        chunk = size_of(folder, given.seconds)
        asked = study(folder, given.chunks, chunk)
        say("configurations of a chunk, PA10 with 9 joints", f"{chunk:,}")
        warm(folder / "warm1", asked, threads(1))
        warm(folder / "warm2", asked, threads(2))
        ones, twos, resumed, ceilings = [], [], [], []
        for k in range(given.rounds):
            one = timed(folder / f"one{k}", asked, threads(1))
            again = timed(folder / f"again{k}", asked, threads(1), after(given.chunks))
            resumed.append(again + timed(folder / f"again{k}", asked, threads(1)))
            ones.append((one + timed(folder / f"one-more{k}", asked, threads(1))) / 2)
            twos.append(timed(folder / f"two{k}", asked, threads(2)))
            ceilings.append(together(2, chunk, 2 * given.seconds) / together(1, chunk, 2 * given.seconds))
            print(f"round {k + 1} of {given.rounds}: {ones[k]}, {twos[k]}", file=sys.stderr)
        one, two, again = np.array(ones), np.array(twos), np.array(resumed)
        say("rounds", f"{given.rounds}")
        say("1 thread", f"{np.median(one[:, 0]):.2f} s")
        say("2 threads", f"{np.median(two[:, 0]):.2f} s")
        say("taken by others meanwhile, of both processors", spread(two[:, 2] / two[:, 0] / 2))
        ratio, calm = one[:, 0] / two[:, 0], np.maximum(one[:, 2] / one[:, 0], two[:, 2] / two[:, 0]) / 2 < 0.02
        say("2 threads / 1", spread(ratio))
        say(f"the same, {calm.sum()} calm rounds", spread(ratio[calm]) if calm.any() else "none")
        say("two programs of one thread each / one", spread(ceilings))
        say("stopped and resumed / at one go, 1 thread", spread(again[:, 0] / one[:, 0]))
        say("a stop, beside the chunks, of the time at one go, %", spread(100 * (again[:, 1] - one[:, 1]) / one[:, 0]))
        speed = given.chunks * chunk / np.median(two[:, 0])
        say("1e9 configurations on 2 threads would take", f"{1e9 / speed / 60:.1f} min")
        size = sum(f.stat().st_size for f in (folder / "two0").rglob("*") if f.is_file())
        say("store, a chunk", f"{size / given.chunks / 1000:.1f} kB")
        say("status of 100,000 chunks", f"{status(folder, 100_000):.2f} s")
        if not given.no_dask:
            dask(folder, asked, given.rounds)
    for chunks in (4, 16, 64):
        say(f"peak memory, {chunks} chunks of 65,536 configurations", f"{memory(chunks, 65_536):.0f} MB")


if __name__ == "__main__":
    main()
