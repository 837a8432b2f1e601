"""The command line: a thin face over the library."""

from holdfast.cli.app import main

__all__ = ["main"]
