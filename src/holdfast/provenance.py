"""Versions of what made a result."""

from __future__ import annotations

from importlib.metadata import version


def versions(*names: str) -> dict[str, str]:
    """Versions of packages, of those that are installed."""
    found = {}
    for name in names:
        try:
            found[name] = version(name)
        except ModuleNotFoundError:
            continue
    return found
