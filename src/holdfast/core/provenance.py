"""Versions of the packages that produced a result."""

from __future__ import annotations

from importlib.metadata import version

from holdfast import __version__


def versions(*names: str) -> dict[str, str]:
    """Return the versions of those of the named packages that are installed; ``holdfast`` reports its own version."""
    found = {}
    for name in names:
        try:
            found[name] = __version__ if name == "holdfast" else version(name)
        except ModuleNotFoundError:
            continue
    return found
