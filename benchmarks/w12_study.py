"""W12: studies. Scaling over threads, what Dask, a stop and a status cost, and memory against the number of samples.

Usage: python benchmarks/w12_study.py [--seconds S]   (S: length of a chunk, about; 1 unless given)

Prints one line for each figure, with the load of the machine, on which all of them depend.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

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
    from holdfast.studies import read

    file = folder / f"{chunks}x{chunk}.yaml"
    (folder / "joints.yaml").write_text(JOINTS)
    file.write_text(STUDY.format(poses=chunks * chunk, chunk=chunk))
    return read(file)


def timed(folder: Path, asked, runner, stop=None, part=(1, 1)) -> float:
    from holdfast.study import Study

    s = Study.create(folder, asked.name, asked.seed, asked.cells, asked.text)
    begin = time.perf_counter()
    s.run(asked.cells, runner, stop=stop or (lambda: False), part=part)
    return time.perf_counter() - begin


def after(count: int):
    """A stop once so many chunks were begun."""
    asked = iter(range(count))
    return lambda: next(asked, None) is None


def warm(folder: Path, asked, runner) -> None:
    """Let everybody compile and import."""
    timed(folder, asked, runner, part=(1, asked.cells[0].count))


def threads(count: int):
    from holdfast.kernels import pool, set_threads
    from holdfast.study import Threads

    set_threads(count)
    return Threads(count, pool())


def size_of(folder: Path, seconds: float) -> int:
    """Poses of a chunk that takes about so long in one thread."""
    asked = study(folder, 1, 1 << 18)
    job = asked.cells[0].job
    job.prepare(alone=True)
    job.run(asked.cells[0].part(0, 1))
    begin = time.perf_counter()
    job.run(asked.cells[0].part(0, 1))
    return max(int(seconds / (time.perf_counter() - begin) * (1 << 18)) // 16384, 1) * 16384


def memory(chunks: int, chunk: int) -> float:
    """Peak memory, MB, of a program of its own."""
    code = f"import w12_study as w; w.alone({chunks}, {chunk})"
    done = subprocess.run([sys.executable, "-c", code], cwd=Path(__file__).parent, capture_output=True, text=True, check=True)
    return float(done.stdout)


def alone(chunks: int, chunk: int) -> None:
    with tempfile.TemporaryDirectory() as place:
        timed(Path(place) / "out", study(Path(place), chunks, chunk), threads(2))
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def status(folder: Path, chunks: int) -> float:
    """Seconds of the question how far a study with so many chunks is."""
    from holdfast.study import Study
    from holdfast.study.journal import Entry, line

    asked = study(folder, chunks, 1)
    s = Study.create(folder / "many", asked.name, asked.seed, asked.cells, asked.text)
    s.folder(0).mkdir(parents=True)
    entry = Entry("ab" * 16, 40_000, 1.0, 0)
    (s.folder(0) / "done.journal").write_bytes(b"".join(line(k, entry) for k in range(chunks)))
    begin = time.perf_counter()
    assert Study.open(folder / "many").complete
    return time.perf_counter() - begin


def say(what: str, value: str) -> None:
    print(f"{what:58} {value:>16}   load {os.getloadavg()[0]:.1f}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--chunks", type=int, default=12)
    parser.add_argument("--no-dask", action="store_true")
    given = parser.parse_args()
    from holdfast.study import Cluster

    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        chunk = size_of(folder, given.seconds)
        asked = study(folder, given.chunks, chunk)
        say("configurations of a chunk, PA10 with 9 joints", f"{chunk:,}")
        warm(folder / "warm1", asked, threads(1))
        one = timed(folder / "one", asked, threads(1))
        say("1 thread", f"{one:.2f} s")
        warm(folder / "warm2", asked, threads(2))
        two = timed(folder / "two", asked, threads(2))
        say("2 threads", f"{two:.2f} s")
        say("2 threads / 1", f"{one / two:.2f} x")
        rate = given.chunks * chunk / two
        say("1e9 configurations on 2 threads would take", f"{1e9 / rate / 60:.1f} min")
        size = sum(f.stat().st_size for f in (folder / "two").rglob("*") if f.is_file())
        say("store, a chunk", f"{size / given.chunks / 1000:.1f} kB")
        first = timed(folder / "again", asked, threads(1), after(given.chunks))
        second = timed(folder / "again", asked, threads(1))
        say("stopped and resumed / at one go, 1 thread", f"{(first + second) / one:.3f} x")
        if not given.no_dask:
            with Cluster("local:1") as cluster:
                warm(folder / "warm3", asked, cluster)
                dask = timed(folder / "dask", asked, cluster)
            say("Dask, 1 worker with 1 thread / 1 thread", f"{dask / one:.3f} x")
        say("status of 100,000 chunks", f"{status(folder, 100_000):.2f} s")
    for chunks in (4, 16, 64):
        say(f"peak memory, {chunks} chunks of 65,536 configurations", f"{memory(chunks, 65_536):.0f} MB")


if __name__ == "__main__":
    main()
