"""Exceptions of holdfast.

Every message is one sentence that names the thing, says what was wrong and what would be right.
The command line prints it and exits with code 2.
"""

from __future__ import annotations

_MAX_MESSAGE_LETTERS = 1000  # letters


class HoldfastError(Exception):
    """Base class: catch this to catch every error that holdfast raises on purpose."""

    def __str__(self) -> str:
        text = super().__str__()  # which may quote what stands in a file: of any length, with signs that steer a terminal
        if not text.isprintable():
            text = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
        return (
            text
            if len(text) <= _MAX_MESSAGE_LETTERS
            else f"{text[: _MAX_MESSAGE_LETTERS * 3 // 4]} ... {text[-_MAX_MESSAGE_LETTERS // 4 :]}"
        )


class ArmError(HoldfastError, ValueError):
    """An arm description (URDF, DH table, Python) that cannot be used.

    Attributes:
        tip: A link that the arm may be meant to end at, where the file leaves that open; else None.
    """

    def __init__(self, *words: object, tip: str | None = None) -> None:
        super().__init__(*words)
        self.tip = tip


class TaskError(HoldfastError, ValueError):
    """A task, failure set or index that does not fit the arm."""


class InputError(HoldfastError, ValueError):
    """A configuration, pose, region or option with a wrong shape, range or value."""


class KernelError(HoldfastError, RuntimeError):
    """An expression that cannot be compiled into a batched kernel."""


class StoreError(HoldfastError, RuntimeError):
    """A results folder that is damaged, foreign, or not writable."""
