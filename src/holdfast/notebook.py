"""A line with a bar in the output of a notebook's cell, which changes in place: plain HTML, no widgets."""

from __future__ import annotations

import sys
import threading
import uuid
from html import escape
from typing import Any


def publisher() -> Any:
    """What displays in the cell that runs, where this is the kernel of a notebook; else None."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return None if getattr(shell, "kernel", None) is None else shell.display_pub


class Bar:
    """How far work is, below the cell that waits for it. It may be told from any thread.

    Args:
        publish: Of :func:`publisher`.
    """

    def __init__(self, publish: Any) -> None:
        self._publish, self._id = publish, uuid.uuid4().hex
        self._lock, self._said, self._ended = threading.Lock(), "", False

    def show(self, text: str, share: float | None = None, last: bool = False) -> None:
        """Say so in place of what was said before; with a bar if the share that is done is known.

        Args:
            text: For people.
            share: 0 to 1.
            last: Nothing more is said after this, whoever tries.
        """
        bar = "" if share is None else f'<progress style="width:12em;margin-right:.8em" max="1" value="{share:.3f}"></progress>'
        html = f'<div style="opacity:.75">{bar}{escape(text)}</div>'
        with self._lock:
            if self._ended or html == self._said:
                return
            data = {"text/html": html, "text/plain": f"holdfast: {text}"}
            self._publish.publish(data, transient={"display_id": self._id}, update=bool(self._said))
            self._said, self._ended = html, last
