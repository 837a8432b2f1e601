"""Property that is computed once and stored."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from functools import cached_property
else:
    from collections.abc import Callable
    from typing import Any

    class cached_property:
        """Property without the lock of Python 3.11, because a child process inherits a held lock and waits for it forever.

        Threads that read the property at once may compute it more than once; all of them get the value that was stored first.
        """

        def __init__(self, compute: Callable[[Any], Any]) -> None:
            self._compute, self.__doc__ = compute, compute.__doc__

        def __set_name__(self, owner: type, name: str) -> None:
            self._name = name
            if owner.__getstate__ is object.__getstate__:
                owner.__getstate__ = _given

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            return instance.__dict__.setdefault(self._name, self._compute(instance))

    def _given(self: Any) -> dict[str, Any]:
        """Return the state for a copy or another process: all attributes except computed ones, such as kernels."""
        made = type(self)
        return {name: x for name, x in self.__dict__.items() if not isinstance(getattr(made, name, None), cached_property)}


__all__ = ["cached_property"]
