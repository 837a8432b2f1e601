"""What the jobs of one process share: compiled things, made once, whatever threads ask for them."""

from __future__ import annotations

import ctypes
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from contextlib import suppress
from functools import lru_cache
from typing import Any, TypeVar

from holdfast.kernels import set_threads, thread_count

T = TypeVar("T")

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3  # of malloc.h
_MOST = 32  # cells whose compiled things are kept
_lock = threading.RLock()
_made: OrderedDict[Hashable, Any] = OrderedDict()


def shared(job: Hashable, make: Callable[[], T]) -> T:
    """What ``make`` gives for a job, made once."""
    with _lock:
        if job not in _made:
            _made[job] = make()
            while len(_made) > _MOST:
                _made.popitem(last=False)
        _made.move_to_end(job)
        found: T = _made[job]
        return found


@lru_cache(maxsize=1)
def _keep_memory() -> None:
    """Let this process keep memory from block to block.

    Dask's nanny has the C library give every larger array back at once; getting it again costs more than the equations:
    chunks took 1.7 times as long.
    """
    with suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for option, size in ((_MMAP_THRESHOLD, 32 << 20), (_TRIM_THRESHOLD, 256 << 20)):
            mallopt(option, size)


def ready(job: Hashable, make: Callable[[], Any], alone: bool) -> None:
    """Make it now; ``alone``: this process computes several chunks side by side, each in one thread."""
    with _lock:
        if alone:
            _keep_memory()
            if thread_count() != 1:
                set_threads(1)
    shared(job, make)
