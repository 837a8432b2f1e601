"""Faults that are in the model of an environment only while MuJoCo computes its motion.

An environment steps its model inside its own ``step``, between code of its own that may read the model. MuJoCo has no callback
after a step in which a change could be undone, so the functions of MuJoCo's Python package that compute the motion are
replaced while a wrapped environment steps, wherever a module has them. Derived here.
"""

from __future__ import annotations

import re
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from types import ModuleType
from typing import Any

from holdfast.arm.mjcf import import_mujoco
from holdfast.faults.injector import FaultInjector

_PHYSICS_FUNCTIONS = re.compile(r"mj_(step[12]?|forward(Skip)?|fwd[A-Z]\w+|Euler|RungeKutta|implicit)")


class PhysicsCalls:
    """The faults of one injector, in its model only during the functions of MuJoCo that compute the motion of its data.

    Attributes:
        count: Number of these functions that were called.
    """

    def __init__(self, injector: FaultInjector) -> None:
        self.injector, self.count = injector, 0
        _find_bindings()

    @contextmanager
    def watch(self) -> Iterator[None]:
        """Insert the faults in every computation inside a ``with`` block, and take them out after each."""
        key = id(self.injector.data)
        with _PATCH_LOCK:
            if not _WATCHED_MODELS:
                _rebind(replaced=True)
            _WATCHED_MODELS[key] = self
        try:
            yield
        finally:
            with _PATCH_LOCK:
                del _WATCHED_MODELS[key]
                if not _WATCHED_MODELS:
                    _rebind(replaced=False)

    def call(self, function: Callable[..., Any], *args: Any, **named: Any) -> Any:
        """Call a function of MuJoCo with the faults in the model."""
        self.count += 1
        self.injector.insert()
        try:
            return function(*args, **named)
        finally:
            self.injector.restore()


_PATCH_LOCK = threading.Lock()
_WATCHED_MODELS: dict[int, PhysicsCalls] = {}  # by the address of MjData: environments may step in threads
_REPLACED_FUNCTIONS: dict[str, tuple[Any, Any]] = {}  # a function of MuJoCo and its replacement, by name
_MODULE_BINDINGS: dict[tuple[int, str], tuple[dict[str, Any], str, Any, Any]] = {}  # names in modules that mean such a function


def _find_bindings() -> None:
    """Find the names under which modules have the functions; ``from mujoco import mj_step`` makes such a name as well."""
    mujoco = import_mujoco()
    with _PATCH_LOCK:
        for name in () if _REPLACED_FUNCTIONS else filter(_PHYSICS_FUNCTIONS.fullmatch, dir(mujoco)):
            function = getattr(mujoco, name)
            _REPLACED_FUNCTIONS[name] = function, _replacement(function)
        pairs = {id(one): pair for pair in _REPLACED_FUNCTIONS.values() for one in pair}
        for module in list(sys.modules.values()):
            space = vars(module) if isinstance(module, ModuleType) else {}
            for name, value in list(space.items()):
                if id(value) in pairs:
                    _MODULE_BINDINGS[id(space), name] = space, name, *pairs[id(value)]


def _rebind(*, replaced: bool) -> None:
    """Exchange the functions; a name that somebody else has changed stays as it is."""
    for space, name, function, replacement in _MODULE_BINDINGS.values():
        before, after = (function, replacement) if replaced else (replacement, function)
        if space.get(name) is before:
            space[name] = after


def _replacement(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def replacement(*args: Any, **named: Any) -> Any:
        model, data = args[0] if args else named.get("m"), args[1] if len(args) > 1 else named.get("d")
        watch = _WATCHED_MODELS.get(id(data))
        if watch is None or model is not watch.injector.model or watch.injector.is_inserted:
            return function(*args, **named)
        return watch.call(function, *args, **named)

    return replacement
