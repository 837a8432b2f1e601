"""Import of optional packages."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from holdfast.core.errors import HoldfastError


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
