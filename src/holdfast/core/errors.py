"""Exceptions of holdfast.

Every message is one sentence that names the thing, the value that was found, and what would be right.
The command line prints it and exits with code 2.
"""

from __future__ import annotations

_MAX_MESSAGE_LETTERS = 1000  # characters


class HoldfastError(Exception):
    """Base class of the errors that holdfast raises on purpose; catch it to catch all of them."""

    def __str__(self) -> str:
        text = super().__str__()  # may quote a file: any length, with characters that control a terminal
        if not text.isprintable():
            text = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
        return (
            text
            if len(text) <= _MAX_MESSAGE_LETTERS
            else f"{text[: _MAX_MESSAGE_LETTERS * 3 // 4]} ... {text[-_MAX_MESSAGE_LETTERS // 4 :]}"
        )


class ArmError(HoldfastError, ValueError):
    """An arm description (URDF, DH table, Python) that cannot be used; ``words`` are the message.

    Attributes:
        tip: Name of a link that may be the intended end of the arm if the file leaves this open; else None.
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
