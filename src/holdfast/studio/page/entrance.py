"""Who may come in: only pages that the studio itself has served, so that no other page can reach into it.

The rule is that of :mod:`holdfast.files.hosts`. Programs other than browsers run on this machine, or in a network that
``--host`` has let in.
"""

from __future__ import annotations

import gzip
import ipaddress
import socket
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from http import HTTPStatus
from importlib import resources
from pathlib import Path
from typing import Any

from holdfast.errors import HoldfastError
from holdfast.files.hosts import fault, is_loopback

LARGEST = 8 << 20  # bytes of one message of a browser: a picture of the scene has less, and so has a part of an upload
_TITLE, _HEAD = "<title>Viser</title>", "</head>"
_PATCHING = threading.Lock()


def welcome(hosts: Sequence[str], origins: Sequence[str], served: str) -> bool:
    """Whether a request is for this studio, and of a page of it or of no page at all.

    Args:
        hosts: Its ``Host`` headers.
        origins: Its ``Origin`` headers.
        served: The address that the studio listens on, as it was given.
    """
    return fault(hosts, origins, lambda name: name in ("localhost", served.lower()) or _is_here(name, served)) is None


def _is_here(name: str, served: str) -> bool:
    """Whether a name is one that no other page can have: an address, or this machine's own name."""
    anywhere = not is_loopback(served.lower())
    try:
        return ipaddress.ip_address(name).is_loopback or anywhere
    except ValueError:
        return anywhere and name in (socket.gethostname().lower(), f"{socket.gethostname()}.local".lower())


class Entrance:
    """What a viser server asks first: it refuses strangers, and gives the page a title, a style and a script of its own.

    Args:
        served: The address that the studio listens on.
    """

    def __init__(self, served: str) -> None:
        self._served = served
        self.asked = False

    @contextmanager
    def before(self) -> Iterator[None]:
        """A block in which a viser server starts: this is what it asks about every request.

        Raises:
            HoldfastError: It did not ask: then nothing would be refused.
        """
        from websockets.asyncio import server as sockets

        real = sockets.serve

        def serve(*given: Any, process_request: Any = None, **options: Any) -> Any:
            if not getattr(process_request, "__module__", "").startswith("viser."):
                return real(*given, process_request=process_request, **options)  # somebody else's, at the same time

            def answer(connection: Any, request: Any) -> Any:
                found = self._answer(request)
                return process_request(connection, request) if found is None else found

            self.asked = True
            return real(*given, process_request=answer, **(options | {"max_size": LARGEST}))

        with _PATCHING:  # viser has no place for this
            sockets.serve = serve  # type: ignore[misc,assignment]
            try:
                yield
            finally:
                sockets.serve = real  # type: ignore[misc]
        if not self.asked:
            raise HoldfastError("this version of viser cannot be kept from pages of others; install viser 1.1")

    def _answer(self, request: Any) -> Any:
        """The page, a refusal, or None where viser is to answer."""
        hosts, origins = (request.headers.get_all(name) for name in ("Host", "Origin"))
        if not welcome(hosts, origins, self._served):
            text = "Refused: this studio answers only to pages that it has served itself; open the address that it printed.\n"
            return _response(HTTPStatus.FORBIDDEN, text.encode(), "text/plain; charset=utf-8")
        if request.headers.get("Upgrade") is None and request.path.partition("?")[0] in ("/", "/index.html"):
            packed = "gzip" in request.headers.get("Accept-Encoding", "")
            return _response(HTTPStatus.OK, self._packed if packed else self._page, "text/html; charset=utf-8", packed)
        return None

    @cached_property
    def _page(self) -> bytes:
        import viser

        page = (Path(viser.__file__).parent / "client" / "build" / "index.html").read_text(encoding="utf-8")
        own = resources.files("holdfast.studio.page")
        style, script, legend = (own.joinpath(name).read_text("utf-8") for name in ("studio.css", "studio.js", "legend.html"))
        added = f"<style>{style}</style><template id=holdfast-legend>{legend}</template><script>{script}</script>"
        page = page.replace(_TITLE, "<title>holdfast studio</title>", 1)
        return page.replace(_HEAD, added + _HEAD, 1).encode()

    @cached_property
    def _packed(self) -> bytes:
        return gzip.compress(self._page, 5)


def _response(status: HTTPStatus, content: bytes, kind: str, packed: bool = False) -> Any:
    from websockets import Headers
    from websockets.http11 import Response

    headers = Headers(
        {
            "Content-Type": kind,
            "Content-Length": str(len(content)),
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Cache-Control": "no-store",
        }
        | ({"Content-Encoding": "gzip"} if packed else {})
    )
    return Response(status, status.phrase, headers, content)
