"""Handling of Ctrl-C, which ends the program within a second during any computation.

``KeyboardInterrupt`` alone is not sufficient: it waits until a compiler or a kernel returns to Python, third-party modules
suppress it during their import, and at exit Python waits for threads whose results are no longer needed.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
import time
from typing import Any, NoReturn

STOPPED_EXIT_CODE = 130
_GRACE_PERIOD_S = 0.8  # s, for cleaning up


class InterruptHandler:
    """Handler that raises ``KeyboardInterrupt`` at Ctrl-C, and ends the process if it still runs shortly afterwards.

    Code that installs its own handler (a study, a server) keeps it, and a parent process that ignores Ctrl-C is respected.

    Attributes:
        was_requested: True after a Ctrl-C.
    """

    def __init__(self) -> None:
        self.was_requested = False
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            return
        self._reader, self._writer = socket.socketpair()
        self._writer.setblocking(False)
        signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)
        signal.signal(signal.SIGINT, self._raise_interrupt)
        sys.unraisablehook = self._filter_unraisable
        threading.Thread(target=self._wait_for_signal, name="holdfast-interrupt", daemon=True).start()

    def end_process(self) -> NoReturn:
        """End the process immediately, even if threads are running."""
        os._exit(STOPPED_EXIT_CODE)

    def _raise_interrupt(self, *_: object) -> None:
        self.was_requested = True
        raise KeyboardInterrupt

    def _filter_unraisable(self, unraisable: Any) -> None:
        if not self.was_requested:  # otherwise it is the KeyboardInterrupt, raised in a destructor
            sys.__unraisablehook__(unraisable)

    def _wait_for_signal(self) -> None:
        """Wait in a thread for the signal, which arrives there even while the main thread does not run Python code."""
        while signal.SIGINT not in self._reader.recv(16) or signal.getsignal(signal.SIGINT) != self._raise_interrupt:
            pass
        time.sleep(_GRACE_PERIOD_S)
        os.write(2, b"holdfast: stopped\n")
        self.end_process()
