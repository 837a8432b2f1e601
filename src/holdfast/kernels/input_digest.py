"""Digest of the inputs of an expression, so that an expression of the same inputs need not be built again.

Numbers, texts, arrays, enumerations, containers of them, dataclasses and objects of holdfast count by their values, together
with the sources of the package and the versions of holdfast, CasADi and NumPy. Functions and classes from outside holdfast have
no digest, so expressions that depend on them are always built.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from inspect import getattr_static
from pathlib import Path
from types import FunctionType
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.provenance import versions

_PACKAGE_FOLDER = Path(__file__).parents[1]
_UNRELATED_FOLDERS = {"interface", "static", "__pycache__"}  # no expression is built there, and lower layers do not import them


_known: WeakKeyDictionary[object, bytes] = WeakKeyDictionary()


class _NoDigestError(Exception):
    """Error: an input has no digest."""


def fingerprint(*parts: object) -> str | None:
    """Return the SHA-256 of the inputs of a computation; None if any input has no digest."""
    try:
        blocks = (block for part in (_sources_digest(), *parts) for block in _bytes_to_hash(part, ()))
        return _hash_blocks(blocks).hex()
    except _NoDigestError:
        return None


def _hash_blocks(blocks: Iterable[bytes]) -> bytes:
    hasher = hashlib.sha256()
    for block in blocks:
        hasher.update(len(block).to_bytes(8, "little") + block)
    return hasher.digest()


@functools.lru_cache(maxsize=1)
def _sources_digest() -> str:
    hasher, is_complete = hashlib.sha256(repr(versions("holdfast", "casadi", "numpy")).encode()), False
    for folder, folders, files in os.walk(_PACKAGE_FOLDER):
        folders[:] = sorted(set(folders) - _UNRELATED_FOLDERS)
        for name in sorted(file for file in files if file.endswith((".py", ".c", ".h", ".js", ".json"))):
            path, is_complete = f"{folder}/{name}", True
            hasher.update(path[len(str(_PACKAGE_FOLDER)) :].encode())
            with open(path, "rb") as file:  # noqa: PTH123  (pathlib takes as long again)
                hasher.update(file.read())
    if not is_complete:  # the sources are in an archive
        raise _NoDigestError
    return hasher.hexdigest()


def _bytes_to_hash(x: Any, inside: tuple[int, ...]) -> Iterator[bytes]:
    if id(x) in inside:
        raise _NoDigestError  # the object contains itself
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
        _require_holdfast_name(x)
        yield f"{x.__module__}.{x.__qualname__}".encode()
    elif isinstance(x, FunctionType):
        _require_holdfast_name(x)
        if x.__closure__:
            raise _NoDigestError
        yield f"{x.__module__}.{x.__qualname__}".encode()
    elif isinstance(x, functools.partial):
        yield from _sequence_blocks([x.func, x.args, x.keywords], inside)
    elif isinstance(x, Enum):
        _require_holdfast_name(kind)
        yield x.name.encode()
    elif isinstance(x, Mapping):
        yield from _sequence_blocks([item for pair in x.items() for item in pair], inside)
    elif kind in (tuple, list):
        yield from _sequence_blocks(x, inside)
    elif kind in (set, frozenset):  # whose order differs between runs
        yield from _sequence_blocks(sorted(b"".join(_sequence_blocks([item], inside)) for item in x), inside)
    elif hasattr(x, "made_of") or hasattr(x, "source_digest"):  # the second is an attribute of kernels and loops
        _require_holdfast_name(kind)
        source = x.made_of if hasattr(x, "made_of") else x.source_digest
        if source is None:
            raise _NoDigestError
        yield from _bytes_to_hash(source, inside)
    elif isinstance(x, Path):
        yield str(x).encode()
    elif _compares_by_identity(kind):  # an arm, which is part of everything that is made for it
        if x not in _known:
            _known[x] = _hash_blocks(_object_blocks(x, inside))
        yield _known[x]
    else:
        yield from _object_blocks(x, inside)


def _compares_by_identity(kind: Any) -> bool:
    """Return whether a class is a frozen dataclass that is equal only to itself."""
    settings = getattr(kind, "__dataclass_params__", None)
    return settings is not None and settings.frozen and not settings.eq


def _object_blocks(x: Any, inside: tuple[int, ...]) -> Iterator[bytes]:
    _require_holdfast_name(type(x))
    yield from _sequence_blocks([part for pair in _object_state(x) for part in pair], inside)


def _sequence_blocks(items: Any, inside: tuple[int, ...]) -> Iterator[bytes]:
    yield str(len(items)).encode()
    for item in items:
        yield from _bytes_to_hash(item, inside)


def _require_holdfast_name(kind: type | FunctionType) -> None:
    if kind.__module__.partition(".")[0] != "holdfast" or "<" in kind.__qualname__:
        raise _NoDigestError


def _object_state(x: Any) -> list[tuple[str, Any]]:
    """Return the content of an object without cached values."""
    if not (hasattr(x, "__dict__") or dataclasses.is_dataclass(x)):
        raise _NoDigestError
    state = {f.name: getattr(x, f.name) for f in dataclasses.fields(x)} if dataclasses.is_dataclass(x) else {}
    for name, value in dict(getattr(x, "__dict__", {})).items():  # a copy: other threads may cache meanwhile
        if not isinstance(getattr_static(type(x), name, None), (cached_property, functools.cached_property)):
            state[name] = value
    return sorted(state.items())
