"""What an expression is made of, as a digest: an expression of the same parts need not be built again.

Numbers, texts, arrays, enumerations, containers of them, dataclasses and objects of holdfast count by their values, together
with the sources of the package and the versions of holdfast, CasADi and NumPy. A function of somebody else's, or an object of
a class of somebody else's, has no digest: what is made of it is always built.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import os
from collections.abc import Iterator, Mapping
from enum import Enum
from inspect import getattr_static
from pathlib import Path
from types import FunctionType
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from holdfast.caching import cached_property
from holdfast.provenance import versions

_PACKAGE = Path(__file__).parents[1]
_DRAWING = {"cli", "present", "report", "__pycache__"}  # no expression is built there, and nothing below imports them


_known: WeakKeyDictionary[object, tuple[bytes, ...]] = WeakKeyDictionary()


class _Unknown(Exception):
    """A part without a digest."""


def digest_of(*parts: object) -> str | None:
    """SHA-256 of what something is made of; None if any part of it has no digest."""
    try:
        h = hashlib.sha256(_sources().encode())
        for part in parts:
            for piece in _pieces(part, ()):
                h.update(len(piece).to_bytes(8, "little") + piece)
    except _Unknown:
        return None
    return h.hexdigest()


@functools.lru_cache(maxsize=1)
def _sources() -> str:
    h, found = hashlib.sha256(repr(versions("holdfast", "casadi", "numpy")).encode()), False
    for folder, folders, files in os.walk(_PACKAGE):
        folders[:] = sorted(set(folders) - _DRAWING)
        for name in sorted(file for file in files if file.endswith((".py", ".c"))):
            path, found = f"{folder}/{name}", True
            h.update(path[len(str(_PACKAGE)) :].encode())
            with open(path, "rb") as file:  # noqa: PTH123  (pathlib takes as long again)
                h.update(file.read())
    if not found:  # they lie in an archive
        raise _Unknown
    return h.hexdigest()


def _pieces(x: Any, inside: tuple[int, ...]) -> Iterator[bytes]:
    if id(x) in inside:
        raise _Unknown  # it holds itself
    kind, inside = type(x), (*inside, id(x))
    yield f"{kind.__module__}.{kind.__qualname__}".encode()
    if x is None or kind in (bool, int, str, bytes):
        yield repr(x).encode()
    elif kind is float:
        yield x.hex().encode()
    elif isinstance(x, np.ndarray | np.generic) and x.dtype.kind in "biuf":
        yield f"{x.dtype}{x.shape}".encode()
        yield x.tobytes()
    elif isinstance(x, type):
        _ours(x)
        yield f"{x.__module__}.{x.__qualname__}".encode()
    elif isinstance(x, FunctionType):
        _ours(x)
        if x.__closure__:
            raise _Unknown
        yield f"{x.__module__}.{x.__qualname__}".encode()
    elif isinstance(x, Enum):
        _ours(kind)
        yield x.name.encode()
    elif isinstance(x, Mapping):
        yield from _several([item for pair in x.items() for item in pair], inside)
    elif kind in (tuple, list):
        yield from _several(x, inside)
    elif kind in (set, frozenset):  # whose order differs from start to start
        yield from _several(sorted(b"".join(_several([item], inside)) for item in x), inside)
    elif hasattr(x, "made_of"):
        _ours(kind)
        if x.made_of is None:
            raise _Unknown
        yield from _pieces(x.made_of, inside)
    elif isinstance(x, Path):
        yield str(x).encode()
    elif _identical(kind):  # an arm: a part of all that is made for it
        if x not in _known:
            _known[x] = tuple(_of_ours(x, inside))
        yield from _known[x]
    else:
        yield from _of_ours(x, inside)


def _identical(kind: Any) -> bool:
    """A frozen dataclass that is equal to nothing but itself."""
    settings = getattr(kind, "__dataclass_params__", None)
    return settings is not None and settings.frozen and not settings.eq


def _of_ours(x: Any, inside: tuple[int, ...]) -> Iterator[bytes]:
    _ours(type(x))
    yield from _several([part for pair in _state(x) for part in pair], inside)


def _several(items: Any, inside: tuple[int, ...]) -> Iterator[bytes]:
    yield str(len(items)).encode()
    for item in items:
        yield from _pieces(item, inside)


def _ours(kind: type | FunctionType) -> None:
    if kind.__module__.partition(".")[0] != "holdfast" or "<" in kind.__qualname__:
        raise _Unknown


def _state(x: Any) -> list[tuple[str, Any]]:
    """What an object holds, without what it only caches."""
    if not (hasattr(x, "__dict__") or dataclasses.is_dataclass(x)):
        raise _Unknown
    state = {f.name: getattr(x, f.name) for f in dataclasses.fields(x)} if dataclasses.is_dataclass(x) else {}
    for name, value in dict(getattr(x, "__dict__", {})).items():  # a copy: other threads may cache meanwhile
        if not isinstance(getattr_static(type(x), name, None), (cached_property, functools.cached_property)):
            state[name] = value
    return sorted(state.items())
