"""What the jobs of one process share: compiled things, made once, whatever threads ask for them."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from holdfast.kernels import set_threads, thread_count

T = TypeVar("T")

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


def ready(job: Hashable, make: Callable[[], Any], alone: bool) -> None:
    """Make it now; ``alone``: this process computes several chunks side by side, each in one thread."""
    with _lock:
        if alone and thread_count() != 1:
            set_threads(1)
    shared(job, make)
