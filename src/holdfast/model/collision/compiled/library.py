"""Machine code of ``route_search.cpp``, and of the file that it includes, for this processor.

``tools/native.py`` compiles the source to ``route_search.ll``, the language of LLVM, from which llvmlite makes machine code. So
no compiler is needed to install or to run holdfast.
"""

from __future__ import annotations

import hashlib
from ctypes import CFUNCTYPE, c_double, c_float, c_int64, c_uint64, c_void_p
from functools import lru_cache
from pathlib import Path
from typing import Any

from holdfast.core.progress import long_task
from holdfast.kernels import cache
from holdfast.kernels.llvm.machine_code import LoadedCode, compile_llvm_text

LLVM_FILE = Path(__file__).with_name("route_search.ll")
_COMPILE_SECONDS = 0.3  # measured
_CODE_LEVEL = 2  # of the code generator


def list_fields(kind: Any, names: str) -> list[tuple[str, Any]]:
    """Return fields of a structure that have the same type."""
    return [(name, kind) for name in names.split()]


class RouteSearchLibrary:
    """Functions of ``route_search.cpp``; each argument that is a pointer is an address."""

    def __init__(self) -> None:
        self._code = LoadedCode(_load_object_code())
        self.check_edges = self._bind("check_edges", None, c_void_p, c_void_p, c_void_p, c_int64, c_float, c_float, c_void_p)
        self.prove_edges = self._bind("prove_edges", None, c_void_p, c_void_p, c_void_p, c_void_p, c_int64, c_double, c_void_p)
        self.search_route = self._bind(
            "search_route", c_int64, c_void_p, c_void_p, c_void_p, c_void_p, c_int64, c_uint64, c_void_p, c_void_p
        )
        self.check_spans = self._bind("check_spans", c_int64, c_void_p, c_void_p, c_int64, c_void_p, c_int64, c_void_p)
        self.prove_constraints = self._bind("prove_constraints", None, *(c_void_p,) * 4, c_int64, c_void_p)
        self.exclude_boxes = self._bind("exclude_boxes", None, c_void_p, c_void_p, c_void_p, c_int64, c_void_p)
        self.evaluate_errors = self._bind("evaluate_errors", None, c_void_p, c_void_p, c_int64, *(c_void_p,) * 3)
        self.extend_paths = self._bind("extend_paths", None, c_void_p, c_void_p, c_void_p)
        self.shorten = self._bind("shorten", c_int64, c_void_p, c_void_p, c_void_p, c_int64, c_uint64)

    def _bind(self, name: str, result: Any, *arguments: Any) -> Any:
        return CFUNCTYPE(result, *arguments)(self._code.find_function(name))


@lru_cache(maxsize=1)
def load_library() -> RouteSearchLibrary:
    """Return the functions, compiled once for each processor."""
    return RouteSearchLibrary()


def _load_object_code() -> bytes:
    text = LLVM_FILE.read_text()
    key = cache.cache_key(hashlib.sha256(text.encode()).hexdigest(), "route search", _CODE_LEVEL)
    data = cache.load_entry(key)
    if data is None:
        with long_task("compiling the search for a route", _COMPILE_SECONDS):
            data = compile_llvm_text(text, _CODE_LEVEL)
        cache.store_entry(key, data)
    return data
