"""Draw poses in a region, solve, evaluate: the probability that the arm keeps what it needs when a joint locks."""

from __future__ import annotations

import json
import operator
import platform
import time
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.arm.serial import from_dict, to_dict
from holdfast.arm.task import Task
from holdfast.assess.distribution import Collector, Distribution, Interval
from holdfast.assess.region import Region, Sampling
from holdfast.errors import InputError, StoreError
from holdfast.indices import BY_NAME, Evaluation, Index, by_name
from holdfast.kernels import pool, thread_count
from holdfast.solve import solver
from holdfast.status import Status
from holdfast.study import Column, Store

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Rows = dict[str, NDArray[Any]]
Progress = Callable[[int, int], None]

_KEEP = 2_000_000  # rows held in memory unless asked otherwise
_CHUNK_BLOCKS = 8


@dataclass(frozen=True)
class Assessment:
    """What :func:`assess` found.

    Attributes:
        arm, region, index: Of the run.
        distribution: Of the index over the region.
        worst_counts: (F,) how often each failure is the worst, over reached and non-singular poses.
        poses, seed, sampling, restarts: Of the run.
        store: The results folder, if one was written.
        seconds: Time it took, or None if it was read from a folder.
        complete: False if the run was stopped before all poses were done.
    """

    arm: Arm
    region: Region
    index: Index
    distribution: Distribution
    worst_counts: NDArray[np.int64]
    poses: int
    seed: int
    sampling: Sampling
    restarts: int
    store: Store | None
    seconds: float | None
    complete: bool
    _rows: Rows | None = None

    def cdf(self, h: ArrayLike, reachable_only: bool = False) -> Array:
        """``F(h)``: share of poses whose index is below h; one without a configuration counts as 0 unless asked otherwise."""
        return self.distribution.cdf(h, reachable_only)

    def probability(self, at_least: float | None = None, at_most: float | None = None, reachable_only: bool = False) -> float:
        """Probability that the index meets a threshold: ``1 - F(h)``."""
        return self.distribution.probability(at_least, at_most, reachable_only)

    def interval(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        reachable_only: bool = False,
        confidence: float = 0.95,
    ) -> Interval:
        """That probability with its Wilson score interval."""
        return self.distribution.interval(at_least, at_most, reachable_only, confidence)

    @property
    def dataset(self) -> xr.Dataset:
        """Every pose with its configuration and index values, as an xarray dataset with units and provenance.

        Raises:
            InputError: The rows were not kept; give ``store`` or ``keep=True``.
        """
        import xarray as xr

        if self._rows is None:
            if self.store is not None:
                return self.store.dataset()
            raise InputError("the poses of this run were not kept (keep=False); assess again with store=PATH or keep=True")
        columns = {c.name: c for c in _columns(self.index, self.region)}
        data = {
            name: xr.DataArray(
                values,
                dims=("row", *[d for d, _ in columns[name].dims]),
                attrs={"units": columns[name].units, "long_name": columns[name].about},
            )
            for name, values in self._rows.items()
        }
        return xr.Dataset(
            data, attrs={"plan": json.dumps(_plan(self.arm, self.region, self.index, self.seed, self.sampling, self.restarts))}
        )

    def save(self, path: str | Path) -> Path:
        """Write the run as a results folder that :func:`load` and ``holdfast report`` read.

        Raises:
            StoreError: The folder exists with something else in it, or cannot be written.
            InputError: The rows were not kept.
        """
        target = Path(path)
        if self._rows is None:
            if self.store is not None and self.store.path.resolve() == target.resolve():
                return target
            raise InputError("the poses of this run were not kept, or are in another folder already; assess with store=PATH")
        store = _open_store(target, self.arm, self.region, self.index, self.poses, self.seed, self.sampling, self.restarts)
        with store.writing():
            for k in store.missing:
                start, stop = store.chunks[k]
                store.write(k, {name: values[start:stop] for name, values in self._rows.items()})
            store.note(**_provenance(self.seconds))
        return target

    def report(self, path: str | Path, threshold: float | None = None) -> Path:
        """Write a self-contained HTML report.

        Args:
            path: The file, replaced in one step.
            threshold: Value of the index that the task needs; half of the bound, or the median, if not given.

        Raises:
            StoreError: The file cannot be written.
        """
        from holdfast.assess.report import write

        return write(self, Path(path), threshold)


def assess(
    arm: Arm,
    region: Region,
    index: Index | str = "relative-manipulability",
    poses: int = 2000,
    seed: int = 0,
    sampling: Sampling = "random",
    restarts: int = 100,
    store: str | Path | None = None,
    keep: bool | None = None,
    progress: Progress | None = None,
    task: str | Task = "pose",
) -> Assessment:
    """The distribution of an index over a region.

    Each pose is solved by inverse kinematics from random starts; the configuration found is evaluated as it is (the
    paper's non-optimised sample). A region of joints is evaluated directly.

    Args:
        arm: The arm.
        region: Which poses, or configurations.
        index: An index of that arm, or its name.
        poses: Number of poses.
        seed: The same seed gives the same result, whatever the number of threads or chunks.
        sampling: ``random``, or ``sobol`` (scrambled; a power of two of poses is best).
        restarts: Random starts per pose before it counts as not reached.
        store: Folder for the results, written chunk by chunk; an existing folder of the same run is continued.
        keep: Hold every row in memory. Default: if there are no more than two million and there is no store.
        progress: Called with (poses done, poses in all).
        task: Of the index, if that is given by name.

    Raises:
        InputError: Options out of range, or an index of another arm.
        TaskError: The arm is not redundant for the task.
        StoreError: The folder cannot be used; nothing committed is lost.
        KeyboardInterrupt: Passed on after the chunk in hand; committed chunks stay, and the same call goes on.
    """
    if isinstance(index, str):
        index = by_name(index, arm, task)
    poses, seed, restarts = _whole("poses", poses, 1), _whole("seed", seed, 0), _whole("restarts", restarts, 1)
    _check(arm, region, index, poses, sampling, restarts)
    begin = time.monotonic()
    keep = (store is None and poses <= _KEEP) if keep is None else keep
    folder = None if store is None else _open_store(Path(store), arm, region, index, poses, seed, sampling, restarts)
    _compile(arm, region, index)
    tally = _Tally(index)
    kept: list[Rows] = []

    def take(rows: Rows) -> None:
        tally.add(rows)
        if keep:
            kept.append(rows)

    if folder is None:
        for start, rows in _blocks(arm, region, index, poses, seed, sampling, restarts, 0):
            take(rows)
            if progress is not None:
                progress(start + len(rows["status"]), poses)
    else:
        with folder.writing():
            was_complete = folder.complete
            _fill(folder, arm, region, index, poses, seed, sampling, restarts, progress)
            if not was_complete:
                spent = folder.notes.get("seconds") or 0.0
                folder.note(**_provenance(spent + time.monotonic() - begin))
        for rows in _stored(folder, index, region):
            take(rows)
    merged = {name: np.concatenate([r[name] for r in kept]) for name in kept[0]} if kept else None
    return Assessment(
        arm,
        region,
        index,
        tally.finish(),
        tally.worst,
        poses,
        seed,
        sampling,
        restarts,
        folder,
        time.monotonic() - begin,
        True,
        merged,
    )


def load(path: str | Path) -> Assessment:
    """The assessment in a results folder; of a run that was stopped, what is there.

    Raises:
        StoreError: Not a results folder of an assessment, or damaged.
    """
    store = Store.open(path)
    plan = store.plan
    if plan.get("kind") != "assess":
        raise StoreError(f"'{path}' is not an assessment; give the folder that `holdfast assess --out` wrote")
    try:
        arm = from_dict(plan["arm"])
        region = Region.from_dict(plan["region"])
        t = plan["task"]
        task = Task(t["name"], np.array(t["rows"]), t["frame"], t["length"])
        index = by_name(plan["index"], arm, task, [list(f) for f in plan["failures"]])
        seed, sampling, restarts = plan["seed"], plan["sampling"], plan["restarts"]
    except (KeyError, TypeError) as error:
        raise StoreError(f"'{path}' is damaged: its plan lacks {error}; start the run again in a new folder") from error
    tally = _Tally(index)
    for rows in _stored(store, index, region):
        tally.add(rows)
    return Assessment(
        arm,
        region,
        index,
        tally.finish(),
        tally.worst,
        store.rows,
        seed,
        sampling,
        restarts,
        store,
        store.notes.get("seconds"),
        store.complete,
    )


# ---- one block ---------------------------------------------------------------------------------------------------------


def _evaluate(arm: Arm, region: Region, index: Index, samples: Array, seed: int, number: int, restarts: int) -> Rows:
    from scipy.spatial.transform import Rotation

    count = len(samples)
    if region.kind == "joints":
        result = index.evaluate(samples)
        return {
            "q": samples,
            "status": result.status,
            "index": result.value,
            "by_failure": result.by_failure,
            "worst": _worst(result),
        }
    poses = region.poses(samples)
    child = np.random.SeedSequence(seed, spawn_key=(1, number))
    reach = solver(arm, index.task).solve(poses, child, restarts, 1e-6)
    ok = np.flatnonzero(reach.success)
    value, by_failure = np.full(count, np.nan), np.full((count, len(index.failures)), np.nan)
    worst, status = np.full(count, -1, dtype=np.int16), reach.status.copy()
    if ok.size:
        result = index.evaluate(reach.q[ok])
        value[ok], by_failure[ok], worst[ok], status[ok] = result.value, result.by_failure, _worst(result), result.status
    return {
        "position": poses[:, :3, 3],
        "quaternion": Rotation.from_matrix(poses[:, :3, :3]).as_quat(),
        "q": np.where(reach.success[:, None], reach.q, np.nan),
        "status": status,
        "index": value,
        "by_failure": by_failure,
        "worst": worst,
    }


def _compile(arm: Arm, region: Region, index: Index) -> None:
    """Compile in this thread, once, instead of in every worker at the same time."""
    index.evaluate(np.zeros((1, arm.n)))
    if region.kind == "box":
        solver(arm, index.task)


def _worst(result: Evaluation) -> NDArray[np.int16]:
    """Worst failure; none at a singular configuration, where all are equally bad."""
    return np.where(result.status == Status.OK, result.worst, -1).astype(np.int16)


def _columns(index: Index, region: Region) -> list[Column]:
    n, f = index.arm.n, len(index.failures)
    pose = [
        Column("position", "float64", (("axis", 3),), "m", "drawn position of the tool in the world"),
        Column("quaternion", "float64", (("xyzw", 4),), "1", "drawn orientation of the tool in the world, x y z w"),
    ]
    return [
        *(pose if region.kind == "box" else []),
        Column("q", "float64", (("joint", n),), "rad or m", "configuration; NaN where none was found"),
        Column("status", "uint8", (), "1", "0 ok, 1 not found, 3 singular, 255 not computed yet"),
        Column("index", "float64", (), index.unit, index.describe()),
        Column("by_failure", "float64", (("failure", f),), index.unit, f"{index.name} for each failure"),
        Column("worst", "int16", (), "1", "position of the worst failure in the list of failures; -1 if there is none"),
    ]


# ---- many blocks -------------------------------------------------------------------------------------------------------


def _blocks(
    arm: Arm, region: Region, index: Index, poses: int, seed: int, sampling: Sampling, restarts: int, first: int
) -> Generator[tuple[int, Rows], None, None]:
    """Blocks in order, a few ahead of the consumer at work in the pool."""
    size = region.block
    source = region.blocks(first, seed, sampling)
    numbers = iter(range(first, -(-poses // size)))
    waiting: deque[tuple[int, Future[Rows]]] = deque()

    def submit() -> None:
        number = next(numbers, None)
        if number is not None:
            samples = next(source)[: poses - number * size]
            task = pool().submit(_evaluate, arm, region, index, samples, seed, number, restarts)
            waiting.append((number * size, task))

    try:
        for _ in range(2 * thread_count()):
            submit()
        while waiting:
            start, task = waiting.popleft()
            rows = task.result()
            submit()
            yield start, rows
    finally:
        for _, task in waiting:
            task.cancel()


def _fill(
    store: Store,
    arm: Arm,
    region: Region,
    index: Index,
    poses: int,
    seed: int,
    sampling: Sampling,
    restarts: int,
    progress: Progress | None,
) -> None:
    missing, chunks = store.missing, store.chunks
    done = poses - sum(chunks[k][1] - chunks[k][0] for k in missing)
    if progress is not None:
        progress(done, poses)
    while missing:
        # Chunks that follow one another share one stream of blocks, so that the workers never wait for a chunk's end.
        length = next((i for i, k in enumerate(missing) if k != missing[0] + i), len(missing))
        span, missing = missing[:length], missing[length:]
        stream = _blocks(arm, region, index, chunks[span[-1]][1], seed, sampling, restarts, chunks[span[0]][0] // region.block)
        with closing(stream):
            for k in span:
                start, stop = chunks[k]
                parts = [next(stream)[1] for _ in range(-(-(stop - start) // region.block))]
                store.write(k, {name: np.concatenate([p[name] for p in parts]) for name in parts[0]})
                done += stop - start
                if progress is not None:
                    progress(done, poses)


def _stored(store: Store, index: Index, region: Region) -> Iterator[Rows]:
    names = [c.name for c in _columns(index, region)]
    for k in store.done:
        rows = store.read(k, names)
        lost = _lost(rows)
        if lost is not None:
            raise StoreError(
                f"'{store.path}' is damaged: chunk {k + 1} is marked done but its '{lost}' is lost; "
                "start the run again in a new folder"
            )
        yield rows


def _lost(rows: Rows) -> str | None:
    """A column whose values are the fill value where there must be one: its file is gone."""
    status = rows["status"]
    if (status == Status.NOT_COMPUTED).any():
        return "status"
    reached = (status == Status.OK) | (status == Status.SINGULAR)
    for name, values in rows.items():
        if values.dtype.kind == "f" and np.isnan(values if name in ("position", "quaternion") else values[reached]).any():
            return name
    return "worst" if (rows["worst"][status == Status.OK] < 0).any() else None


class _Tally:
    def __init__(self, index: Index) -> None:
        self._collector = Collector(index.better, index.bound)
        self._failures = len(index.failures)
        self.worst = np.zeros(self._failures, dtype=np.int64)

    def add(self, rows: Rows) -> None:
        reached = (rows["status"] == Status.OK) | (rows["status"] == Status.SINGULAR)
        singular = int((rows["status"] == Status.SINGULAR).sum())
        self._collector.add(rows["index"][reached], int((~reached).sum()), singular)
        worst = rows["worst"]
        self.worst += np.bincount(worst[worst >= 0], minlength=self._failures)

    def finish(self) -> Distribution:
        return self._collector.finish()


# ---- plan and checks ---------------------------------------------------------------------------------------------------


def _plan(arm: Arm, region: Region, index: Index, seed: int, sampling: Sampling, restarts: int) -> dict[str, Any]:
    t = index.task
    return {
        "kind": "assess",
        "arm": to_dict(arm),
        "fingerprint": arm.fingerprint,
        "region": region.to_dict(),
        "index": index.slug,
        "task": {"name": t.name, "rows": t.rows.tolist(), "frame": t.frame, "length": t.length},
        "failures": [[arm.joint_names[k] for k in f] for f in index.failures],
        "seed": seed,
        "sampling": sampling,
        "restarts": restarts,
        "seeds": "poses of block b: SeedSequence(seed, spawn_key=(0, b)); starts of block b: (1, b); "
        f"{region.block} poses per block",
    }


def _open_store(
    path: Path, arm: Arm, region: Region, index: Index, poses: int, seed: int, sampling: Sampling, restarts: int
) -> Store:
    plan = _plan(arm, region, index, seed, sampling, restarts)
    if index.slug not in BY_NAME:
        raise InputError(f"index '{index.name}' is your own function, which a folder cannot hold; assess without a store")
    return Store.create(path, plan, _columns(index, region), poses, _CHUNK_BLOCKS * region.block)


def _provenance(seconds: float | None) -> dict[str, Any]:
    packages = ("holdfast", "numpy", "scipy", "casadi", "heyoka", "xarray", "zarr")
    found = {}
    for name in packages:
        try:
            found[name] = version(name)
        except ModuleNotFoundError:
            continue
    return {
        "seconds": seconds,
        "finished": datetime.now(UTC).isoformat(timespec="seconds"),
        "versions": found,
        "python": platform.python_version(),
        "machine": platform.machine(),
        "threads": thread_count(),
    }


def _whole(what: str, value: Any, least: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if number < least:
        raise InputError(f"{what} is {value}; it must be {least} or more, and whole")
    return number


def _check(arm: Arm, region: Region, index: Index, poses: int, sampling: str, restarts: int) -> None:
    if index.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the index belongs to '{index.arm.name}', not to '{arm.name}'; make it with the arm you assess")
    if poses < 1:
        raise InputError(f"poses is {poses}; it must be 1 or more")
    if restarts < 1:
        raise InputError(f"restarts is {restarts}; it must be 1 or more")
    if sampling not in ("random", "sobol"):
        raise InputError(f"sampling '{sampling}' is not known; use 'random' or 'sobol'")
    if region.kind == "joints" and len(region.center) != arm.n:
        raise InputError(f"the region has {len(region.center)} joints, '{arm.name}' has {arm.n}; they must agree")
