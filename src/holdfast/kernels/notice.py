"""Word of silent work that takes a while."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

_LONG = 1.0  # s


@contextmanager
def long(what: str, seconds: float) -> Iterator[None]:
    """Say on stderr what is being done if it is expected to take more than a second, and for how long."""
    if seconds > _LONG:
        print(f"holdfast: {what}, about {seconds:.0f} s", file=sys.stderr, flush=True)
    yield
