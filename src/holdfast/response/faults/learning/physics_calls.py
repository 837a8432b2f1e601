"""Insert faults into the model of an environment only while MuJoCo computes its motion.

An environment steps its model inside its ``step`` method, between other code that may read the model. MuJoCo has no callback
after a step in which a change could be undone. Therefore, the functions of MuJoCo's Python package that compute the motion are
replaced while a wrapped environment steps, in every module that has them. Derived here.
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

from holdfast.model.arm.formats.mjcf import import_mujoco
from holdfast.response.faults.injector import FaultInjector

_PHYSICS_FUNCTIONS = re.compile(r"mj_(step[12]?|forward(Skip)?|fwd[A-Z]\w+|Euler|RungeKutta|implicit)")


class PhysicsInterceptor:
    """Insert the faults of one injector during the MuJoCo functions that compute the motion of its data.

    Attributes:
        call_count: Number of calls of these functions.
    """

    def __init__(self, injector: FaultInjector) -> None:
        self.injector, self.call_count = injector, 0
        _find_function_aliases()

    @contextmanager
    def intercept(self) -> Iterator[None]:
        """Insert the faults in every computation inside a ``with`` block, and remove them after each."""
        key = id(self.injector.data)
        with _PATCH_LOCK:
            if not _WATCHED_MODELS:
                _rebind_functions(replaced=True)
            _WATCHED_MODELS[key] = self
        try:
            yield
        finally:
            with _PATCH_LOCK:
                del _WATCHED_MODELS[key]
                if not _WATCHED_MODELS:
                    _rebind_functions(replaced=False)

    def call_with_faults(self, function: Callable[..., Any], *args: Any, **named: Any) -> Any:
        """Call a function of MuJoCo with the faults in the model."""
        self.call_count += 1
        self.injector.insert()
        try:
            return function(*args, **named)
        finally:
            self.injector.restore()


_PATCH_LOCK = threading.Lock()
_WATCHED_MODELS: dict[int, PhysicsInterceptor] = {}  # by the address of MjData, because environments may step in threads
_REPLACED_FUNCTIONS: dict[str, tuple[Any, Any]] = {}  # a function of MuJoCo and its replacement, by name
_MODULE_BINDINGS: dict[tuple[int, str], tuple[dict[str, Any], str, Any, Any]] = {}  # names in modules bound to such a function


def _find_function_aliases() -> None:
    """Find the names under which modules have the functions; ``from mujoco import mj_step`` makes such a name as well."""
    mujoco = import_mujoco()
    with _PATCH_LOCK:
        for name in () if _REPLACED_FUNCTIONS else filter(_PHYSICS_FUNCTIONS.fullmatch, dir(mujoco)):
            function = getattr(mujoco, name)
            _REPLACED_FUNCTIONS[name] = function, _make_replacement(function)
        pairs_by_id = {id(function): pair for pair in _REPLACED_FUNCTIONS.values() for function in pair}
        for module in list(sys.modules.values()):
            namespace = vars(module) if isinstance(module, ModuleType) else {}
            for name, value in list(namespace.items()):
                if id(value) in pairs_by_id:
                    _MODULE_BINDINGS[id(namespace), name] = namespace, name, *pairs_by_id[id(value)]


def _rebind_functions(*, replaced: bool) -> None:
    """Exchange the functions; a name that other code has changed stays as it is."""
    for namespace, name, function, replacement in _MODULE_BINDINGS.values():
        old_function, new_function = (function, replacement) if replaced else (replacement, function)
        if namespace.get(name) is old_function:
            namespace[name] = new_function


def _make_replacement(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def call_replacement(*args: Any, **named: Any) -> Any:
        model, data = args[0] if args else named.get("m"), args[1] if len(args) > 1 else named.get("d")
        interceptor = _WATCHED_MODELS.get(id(data))
        if interceptor is None or model is not interceptor.injector.model or interceptor.injector.is_inserted:
            return function(*args, **named)
        return interceptor.call_with_faults(function, *args, **named)

    return call_replacement
