"""Ctrl-C: ends the program within a second, wherever it finds it.

``KeyboardInterrupt`` alone does not: it waits until a compiler or a kernel returns to Python, foreign modules swallow it
while they are imported, and at the end Python waits for threads that compute what nobody wants any more.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
import time
from typing import Any, NoReturn

STOPPED = 130
_PATIENCE = 0.8  # s, to put things in order


class Interrupt:
    """Raises ``KeyboardInterrupt`` at Ctrl-C, and ends the process if it is still there a moment later.

    What puts a handler of its own in place (a study, a server) is left alone, as is a program whose starter has Ctrl-C
    ignored.

    Attributes:
        asked: There was a Ctrl-C.
    """

    def __init__(self) -> None:
        self.asked = False
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            return
        self._reader, self._writer = socket.socketpair()
        self._writer.setblocking(False)
        signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)
        signal.signal(signal.SIGINT, self._raise)
        sys.unraisablehook = self._unraisable
        threading.Thread(target=self._watch, name="holdfast-interrupt", daemon=True).start()

    def end(self) -> NoReturn:
        """End the process now, threads or not."""
        os._exit(STOPPED)

    def _raise(self, *_: object) -> None:
        self.asked = True
        raise KeyboardInterrupt

    def _unraisable(self, what: Any) -> None:
        if not self.asked:  # otherwise it is our own exception, swallowed by a destructor
            sys.__unraisablehook__(what)

    def _watch(self) -> None:
        """In a thread: the signal is seen here also while the main thread is not in Python."""
        while signal.SIGINT not in self._reader.recv(16) or signal.getsignal(signal.SIGINT) != self._raise:
            pass
        time.sleep(_PATIENCE)
        os.write(2, b"holdfast: stopped\n")
        self.end()
