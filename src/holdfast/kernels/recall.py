"""Kernels and texts that need not be built again: a second start finds them without making the expressions."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar, cast

from holdfast.kernels import cache
from holdfast.kernels.kernel import Kernel, default_backend
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import Program
from holdfast.kernels.recipe import digest_of

P = ParamSpec("P")
K = TypeVar("K", Kernel, Loop)
T = TypeVar("T")

_making: dict[str, threading.RLock] = {}  # by recipe: what a build needs in turn is of another recipe
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_making.clear)  # a child process has none of the threads that hold them


def recalled(build: Callable[P, K]) -> Callable[P, K]:
    """A function or method that builds a kernel or a loop, called only where its result is not known from before.

    What it builds may depend on nothing but its arguments and the sources of holdfast. Where an argument has no digest
    (``holdfast.kernels.recipe``), and outside of holdfast, whose sources count, it is called as ever.
    """

    @wraps(build)
    def from_memory(*args: P.args, **kwargs: P.kwargs) -> K:
        recipe = _recipe(build, args, kwargs) if default_backend() != "casadi" else None
        if recipe is None:
            return build(*args, **kwargs)
        entry = cache.key(recipe, "facts")
        with _making.setdefault(recipe, threading.RLock()):  # threads that need it at once: one builds, the others find it
            facts = cache.load(entry)
            if facts is None:
                made = build(*args, **kwargs)
                cache.store(entry, _facts(made))
                _kernel(made).program.recipe = recipe
                return made
            return cast(K, _known(facts, recipe, lambda: _kernel(build(*args, **kwargs)).program))

    return from_memory


def recalled_data(build: Callable[P, T]) -> Callable[P, T]:
    """As :func:`recalled`, of a function that gives what JSON takes: a text, a number, a dictionary of texts."""

    @wraps(build)
    def from_memory(*args: P.args, **kwargs: P.kwargs) -> T:
        recipe = _recipe(build, args, kwargs)
        if recipe is None:
            return build(*args, **kwargs)
        data = cache.load(recipe)
        if data is None:
            made = build(*args, **kwargs)
            cache.store(recipe, json.dumps(made).encode())
            return made
        return cast(T, json.loads(data))

    return from_memory


def _recipe(build: Callable[..., object], args: object, kwargs: object) -> str | None:
    ours = build.__module__.partition(".")[0] == "holdfast"
    return digest_of(build.__module__, build.__qualname__, args, kwargs) if ours else None


def _kernel(made: Kernel | Loop) -> Kernel:
    return made.step if isinstance(made, Loop) else made


def _facts(made: Kernel | Loop) -> bytes:
    loop = [made.ahead, made.times] if isinstance(made, Loop) else None
    return json.dumps([loop, *_kernel(made).program.facts()]).encode()


def _known(facts: bytes, recipe: str, build: Callable[[], Program]) -> Kernel | Loop:
    loop, *about = json.loads(facts)
    program = Program.known(about, build)
    program.recipe = recipe
    kernel = Kernel.of(program)
    return kernel if loop is None else Loop.of(kernel, *loop)
