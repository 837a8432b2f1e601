"""A line between pages and a server that a test can cut: loopback has no other way to lose a network."""

from __future__ import annotations

import socket
import threading
from contextlib import suppress


class Line:
    """Forwards TCP connections to a port of this computer.

    Args:
        port: Of the server.

    Attributes:
        port: To connect to instead.
    """

    def __init__(self, port: int) -> None:
        self._server = port
        self._whole = True
        self._lock = threading.Lock()
        self._ends: set[socket.socket] = set()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        threading.Thread(target=self._listen, daemon=True).start()

    def cut(self) -> None:
        """All connections are lost, and new ones too."""
        with self._lock:
            self._whole = False
            ends, self._ends = self._ends, set()
        for end in ends:
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def mend(self) -> None:
        """New connections come through again."""
        with self._lock:
            self._whole = True

    def close(self) -> None:
        """No more."""
        self.cut()
        self._listener.close()

    def _listen(self) -> None:
        with suppress(OSError):  # closed
            while True:
                here, _ = self._listener.accept()
                self._connect(here)

    def _connect(self, here: socket.socket) -> None:
        with self._lock:
            if not self._whole:
                here.close()
                return
            there = socket.create_connection(("127.0.0.1", self._server))
            self._ends |= {here, there}
        for one, other in ((here, there), (there, here)):
            threading.Thread(target=self._pump, args=(one, other), daemon=True).start()

    def _pump(self, source: socket.socket, sink: socket.socket) -> None:
        with suppress(OSError):
            while data := source.recv(65536):
                sink.sendall(data)
        for end in (source, sink):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)
        with self._lock:
            self._ends -= {source, sink}
        source.close()
