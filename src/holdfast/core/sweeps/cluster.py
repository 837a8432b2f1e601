"""Compute chunks on a Dask cluster; only the local process writes files."""

from __future__ import annotations

import logging
import queue
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from holdfast.core.errors import InputError, StoreError
from holdfast.core.labels import is_count
from holdfast.core.sweeps.runner import ChunkResult, ChunkTask, Stop, compute_chunk

_POLL_INTERVAL_S = 0.5  # s between queries of the scheduler
_SCHEDULER_TIMEOUT_S = 15.0  # s without contact after which the scheduler counts as lost
_STOP_GRACE_S = 10.0  # s that chunks in progress get after a stop request
_LOCAL_PREFIX = "local:"


class Cluster:
    """Dask cluster with its scheduler at ``address`` (``tcp://HOST:8786`` or a scheduler file), or a local cluster.

    ``local:4`` starts four worker processes on this machine; ``timeout`` limits the connection, s. Use it in ``with``.

    Raises:
        InputError: The extra ``cluster`` is not installed, or no scheduler answers.
    """

    def __init__(self, address: str, timeout: float = 20.0) -> None:
        try:
            import distributed
        except ImportError as error:
            raise InputError(
                "a scheduler needs Dask, which is not installed; install it with: pip install 'holdfast-arms[cluster]'"
            ) from error
        for part in ("client", "core", "comm"):  # hide its tracebacks; relevant errors come back as one sentence
            logging.getLogger(f"distributed.{part}").setLevel(logging.CRITICAL)
        self.address = address
        self._own: Any = None
        if address.startswith(_LOCAL_PREFIX):
            count = address.removeprefix(_LOCAL_PREFIX)
            if not is_count(count) or int(count) < 1:
                raise InputError(f"scheduler '{address}' is not known; write local:4 for four worker processes")
            self._own = distributed.LocalCluster(
                n_workers=int(count), threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
            )
        elif "://" not in address and not address.endswith(".json"):
            raise InputError(
                f"scheduler '{address}' is not known; give its address such as tcp://HOST:8786, its scheduler file (.json), "
                "or local:4 for local worker processes"
            )
        try:
            if address.endswith(".json"):
                self._client = distributed.Client(scheduler_file=address, timeout=timeout, set_as_default=False)
            else:
                place = address if self._own is None else self._own
                self._client = distributed.Client(place, timeout=timeout, set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            raise InputError(
                f"no Dask scheduler answers at '{address}'; start one with 'dask scheduler', and workers with "
                "'dask worker ADDRESS'"
            ) from error

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(Exception):  # a lost scheduler cannot be closed
            self._client.close(timeout=2)
        if self._own is not None:
            with suppress(Exception):
                self._own.close(timeout=5)

    @property
    def about(self) -> str:
        """Address of the scheduler."""
        return f"Dask at {self.address}"

    def results(self, tasks: Iterator[ChunkTask], stop: Stop) -> Iterator[ChunkResult]:
        """Yield the results of ``tasks`` until ``stop()``; see :meth:`holdfast.core.sweeps.Runner.results`."""
        finished: queue.SimpleQueue[Any] = queue.SimpleQueue()
        waiting: dict[str, tuple[Any, ChunkTask]] = {}
        looked, capacity, last_contact = 0.0, 1, time.monotonic()
        retries: list[ChunkTask] = []  # tasks whose results were lost with the connection
        has_more, polled_at = True, 0.0
        try:
            while True:
                now = time.monotonic()
                if now - looked > _POLL_INTERVAL_S:
                    looked = now
                    if self._client.status == "running":
                        last_contact, capacity = now, 2 * self._count_threads() + 1
                    elif now - last_contact > _SCHEDULER_TIMEOUT_S or self._client.status == "closed":
                        raise self._lost_scheduler_error()
                while (retries or has_more) and len(waiting) < capacity and self._client.status == "running" and not stop():
                    task = retries.pop() if retries else next(tasks, None)
                    if task is None:
                        has_more = False
                        break
                    future = self._client.submit(compute_chunk, task, pure=False)
                    waiting[future.key] = future, task
                    future.add_done_callback(finished.put)
                if not waiting and (stop() or not (retries or has_more)):
                    return
                try:
                    future = finished.get(timeout=_POLL_INTERVAL_S)
                except queue.Empty:
                    if stop():
                        polled_at = polled_at or now
                        if now - polled_at > _STOP_GRACE_S:  # far and slow workers are abandoned
                            return
                    continue
                _, task = waiting.pop(future.key)
                if future.status in ("cancelled", "lost"):
                    retries.append(task)
                    continue
                yield self._collect_result(future, task)
        finally:
            with suppress(Exception):
                self._client.cancel([future for future, _ in waiting.values()])

    def _count_threads(self) -> int:
        return sum(w["nthreads"] for w in self._client.scheduler_info(n_workers=-1)["workers"].values())

    def _lost_scheduler_error(self) -> StoreError:
        return StoreError(
            f"the Dask scheduler at '{self.address}' is gone; what was committed is safe: start it and run the same command "
            "again"
        )

    def _collect_result(self, future: Any, task: ChunkTask) -> ChunkResult:
        from distributed import KilledWorker

        try:
            result: ChunkResult = future.result(timeout=60)
        except KilledWorker as error:
            raise StoreError(
                f"rows {task.chunk.start + 1} to {task.chunk.stop} of a cell made several workers crash, perhaps for lack "
                "of memory; give the workers more, or write a study file with a smaller chunk"
            ) from error
        except (TimeoutError, OSError) as error:
            raise self._lost_scheduler_error() from error
        except ImportError as error:
            raise StoreError(f"a worker lacks a package ({error}); install the same versions on every machine") from error
        finally:
            future.release()
        return result
