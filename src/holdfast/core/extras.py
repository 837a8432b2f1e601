"""Import of optional packages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from holdfast.core.errors import HoldfastError


class MissingModuleError(HoldfastError):
    """An optional package that is needed and not installed."""


EXTRA_OF_MODULE = {"matplotlib": "report", "zarr": "report"}  # packages that many modules import, by their extra


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
    """Check, without importing it, that a package of :data:`EXTRA_OF_MODULE` is installed, before work that needs it begins.

    Args:
        module: Name of the package.
        user: Option or object that needs the package, for the error message.

    Raises:
        MissingModuleError: The package is not installed; the message contains the command that installs it.
    """
    if find_spec(module) is None:
        raise _missing_module_error(module, user)


@contextmanager
def guard_imports(user: str) -> Iterator[None]:
    """Replace the error of a missing package of :data:`EXTRA_OF_MODULE` by the error of :func:`require_module`."""
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        if module not in EXTRA_OF_MODULE:
            raise
        raise _missing_module_error(module, user) from error


def _missing_module_error(module: str, user: str) -> MissingModuleError:
    extra = EXTRA_OF_MODULE[module]
    return MissingModuleError(
        f"{user} needs {module}, which is not installed; install it with: pip install 'holdfast-arms[{extra}]'"
    )
