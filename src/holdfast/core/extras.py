"""Import of optional packages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from holdfast.core.errors import HoldfastError

REPORT_MODULES = ("matplotlib", "zarr")  # packages of the extra "report", which many modules import


class MissingModuleError(HoldfastError):
    """A package of the extra "report" is not installed, and ``user``, an option or an object, needs it."""

    def __init__(self, module: str, user: str) -> None:
        super().__init__(f"{user} needs {module}, which is not installed; install it with: pip install 'holdfast-arms[report]'")


def import_extra(module: str, extra: str, title: str | None = None) -> Any:
    """Import an optional package.

    Args:
        module: Name of the package.
        extra: Extra of holdfast that installs the package.
        title: Name of the package in the error message; default: the name of the module.

    Raises:
        HoldfastError: The package is not installed; the message contains the command that installs it.
    """
    try:
        return import_module(module)
    except ImportError as error:
        raise HoldfastError(
            f"{title or module} is needed here and is not installed; install holdfast-arms[{extra}] "
            f"(pip install 'holdfast-arms[{extra}]')"
        ) from error


def require_module(module: str, user: str) -> None:
    """Check, without importing it, that a package of the extra "report" is installed, before work that needs it begins.

    Raises:
        MissingModuleError: The package is not installed.
    """
    if find_spec(module) is None:
        raise MissingModuleError(module, user)


@contextmanager
def guard_imports(user: str) -> Iterator[None]:
    """Raise :class:`MissingModuleError` if the code in the context imports a package of the extra that is not installed."""
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        if module not in REPORT_MODULES:
            raise
        raise MissingModuleError(module, user) from error
