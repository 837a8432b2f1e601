"""Cache kernels and texts on disk, so that a second start need not build their expressions."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Callable
from functools import wraps
from typing import TypeVar, cast

from holdfast.core.typing import P, T
from holdfast.kernels import cache
from holdfast.kernels.input_digest import fingerprint
from holdfast.kernels.kernel import Kernel, default_backend
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import Program

K = TypeVar("K", Kernel, Loop)

_making: dict[str, threading.RLock] = {}  # by recipe, because a build may need other kernels, which have other recipes
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_making.clear)  # the threads that hold the locks do not exist in a child process


def cached_kernel(build: Callable[P, K]) -> Callable[P, K]:
    """Wrap ``build``, a function or method that returns a kernel or a loop, so that it runs only if its result is not cached.

    The result may depend only on the arguments and the sources of holdfast. The cache is not used if an argument has no digest
    (``holdfast.kernels.input_digest``), or if the function is not part of holdfast.
    """

    @wraps(build)
    def build_or_load(*args: P.args, **kwargs: P.kwargs) -> K:
        recipe = _digest_of_call(build, args, kwargs) if default_backend() != "casadi" else None
        if recipe is None:
            return build(*args, **kwargs)
        entry = cache.cache_key(recipe, "facts")
        with _making.setdefault(recipe, threading.RLock()):  # of several threads one builds, and the others load
            facts = cache.load_entry(entry)
            if facts is None:
                kernel = build(*args, **kwargs)
                cache.store_entry(entry, _encode_facts(kernel))
                _kernel_or_step(kernel).program.recipe = recipe
                return kernel
            return cast(K, _decode_facts(facts, recipe, lambda: _kernel_or_step(build(*args, **kwargs)).program))

    return build_or_load


def cached_json(build: Callable[P, T]) -> Callable[P, T]:
    """Wrap ``build``, which returns JSON data (text, number, or dictionary of texts), as :func:`cached_kernel` does."""

    @wraps(build)
    def build_or_load(*args: P.args, **kwargs: P.kwargs) -> T:
        recipe = _digest_of_call(build, args, kwargs)
        if recipe is None:
            return build(*args, **kwargs)
        data = cache.load_entry(recipe)
        if data is None:
            content = build(*args, **kwargs)
            cache.store_entry(recipe, json.dumps(content).encode())
            return content
        return cast(T, json.loads(data))

    return build_or_load


def _digest_of_call(build: Callable[..., object], args: object, kwargs: object) -> str | None:
    is_own = build.__module__.partition(".")[0] == "holdfast"
    return fingerprint(build.__module__, build.__qualname__, args, kwargs) if is_own else None


def _kernel_or_step(built: Kernel | Loop) -> Kernel:
    return built.step if isinstance(built, Loop) else built


def _encode_facts(built: Kernel | Loop) -> bytes:
    loop = [built.ahead, built.times] if isinstance(built, Loop) else None
    return json.dumps([loop, *_kernel_or_step(built).program.facts()]).encode()


def _decode_facts(facts: bytes, recipe: str, build: Callable[[], Program]) -> Kernel | Loop:
    loop, *program_facts = json.loads(facts)
    program = Program.from_facts(program_facts, build)
    program.recipe = recipe
    kernel = Kernel.from_program(program)
    return kernel if loop is None else Loop.from_step(kernel, *loop)
