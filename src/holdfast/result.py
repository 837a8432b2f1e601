"""What an analysis returns: it computes, and what draws and writes it lies above and is looked up by name."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class Result:
    """Base of what an analysis returns; no fields, so that any dataclass can derive from it."""

    __slots__ = ()

    def _presented(self, function: str, *arguments: Any, **options: Any) -> Any:
        """What a function of the module that presents this class makes of it; that module is imported only now."""
        from holdfast.present import PRESENTERS

        name = next(each.__name__ for each in type(self).__mro__ if each.__name__ in PRESENTERS)
        return getattr(import_module(PRESENTERS[name]), function)(self, *arguments, **options)
