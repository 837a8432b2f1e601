"""What the jobs of one process share: compiled things, made once, whatever threads ask for them."""

from __future__ import annotations

import ctypes
import threading
from abc import ABC, abstractmethod
from collections import OrderedDict
from collections.abc import Callable, Hashable
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Generic, TypeVar

from holdfast.kernels.threads import set_threads, thread_count

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


@dataclass(frozen=True, eq=False)
class PlannedJob(ABC, Generic[T]):
    """A job that is defined by its plan, and compiles something for all its chunks: once in a process.

    Subclasses are ``@dataclass(frozen=True, eq=False)``: a dataclass that compares makes its own hash, and a plan has none.

    Attributes:
        plan: Arm and all else that defines the values, as JSON data.
    """

    plan: dict[str, Any]

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)

    def __hash__(self) -> int:
        return hash((type(self), self.plan["fingerprint"], self.plan.get("law")))

    @abstractmethod
    def compiled(self) -> T:
        """What it needs, made from the plan."""

    @property
    def made(self) -> T:
        """What :meth:`compiled` gives, made once."""
        return shared(self, self.compiled)

    def prepare(self, alone: bool) -> None:
        """See :class:`holdfast.engine.Job`."""
        with _lock:
            if alone:
                _keep_memory()
                if thread_count() != 1:
                    set_threads(1)
        shared(self, self.compiled)
