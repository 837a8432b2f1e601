"""Pool of threads for the whole process; kernels release the GIL while they run."""

from __future__ import annotations

import os
import threading
from concurrent.futures import ThreadPoolExecutor

from holdfast.core.labels import is_count

_THREAD_PREFIX = "holdfast-pool"
_lock = threading.Lock()
_pool: ThreadPoolExecutor | None = None
_count: int | None = None


def thread_count() -> int:
    """Return the number of threads: :func:`set_threads`, else ``HOLDFAST_THREADS``, else the processors of this process."""
    if _count is not None:
        return _count
    setting = os.environ.get("HOLDFAST_THREADS", "")
    if is_count(setting) and int(setting) > 0:
        return int(setting)
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else (os.cpu_count() or 1)


def set_threads(count: int | None) -> None:
    """Use ``count`` threads from now on; None restores the default. Results do not depend on the number."""
    global _pool, _count
    if count is not None and count < 1:
        from holdfast.core.errors import InputError

        raise InputError(f"number of threads is {count}; it must be 1 or more")
    with _lock:
        if _pool is not None:
            _pool.shutdown(wait=True)
        _pool, _count = None, count


def in_pool() -> bool:
    """Return True inside a task of the pool, where waiting for the pool could deadlock."""
    return threading.current_thread().name.startswith(_THREAD_PREFIX)


def _after_fork() -> None:
    """Reset the pool in a child process, which has none of its parent's threads."""
    global _pool, _lock
    _pool, _lock = None, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def shared_pool() -> ThreadPoolExecutor:
    """Return the shared pool, which is created at first use."""
    global _pool
    with _lock:
        if _pool is None:
            _pool = ThreadPoolExecutor(thread_count(), thread_name_prefix=_THREAD_PREFIX)
        return _pool
