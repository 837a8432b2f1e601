"""Access control: only pages served by this studio are admitted, so that no other web page can connect to it.

:mod:`holdfast.core.files.hosts` defines the rule. It does not apply to programs other than browsers, which run on this machine
or in a network that ``--host`` has admitted.
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

from holdfast.core.errors import HoldfastError
from holdfast.core.files.hosts import is_loopback_host, request_rejection_reason

# Largest message of a browser in bytes; a picture of the scene is smaller, and so is a part of an upload.
MAX_MESSAGE_BYTES = 8 << 20
_VISER_TITLE_HTML = "<title>Viser</title>"
_HEAD_END_HTML = "</head>"
_PATCH_LOCK = threading.Lock()


def is_own_request(hosts: Sequence[str], origins: Sequence[str], served: str) -> bool:
    """Return True if a request addresses this studio and comes from one of its pages or from no page.

    Args:
        hosts: ``Host`` headers of the request.
        origins: ``Origin`` headers of the request.
        served: Address on which the studio listens, as given by the user.
    """
    return (
        request_rejection_reason(
            hosts, origins, lambda name: name in ("localhost", served.lower()) or _is_safe_host_name(name, served)
        )
        is None
    )


def _is_safe_host_name(name: str, served: str) -> bool:
    """Return True if no other page can have this host name, because it is an address or this machine's own name."""
    is_exposed = not is_loopback_host(served.lower())
    try:
        return ipaddress.ip_address(name).is_loopback or is_exposed
    except ValueError:
        return is_exposed and name in (socket.gethostname().lower(), f"{socket.gethostname()}.local".lower())


class AccessFilter:
    """Request filter of a viser server, which rejects strangers and gives the page its title, style and script.

    Args:
        served: Address on which the studio listens.
    """

    def __init__(self, served: str) -> None:
        self._served = served
        self.was_consulted = False

    @contextmanager
    def filter_requests(self) -> Iterator[None]:
        """Install the filter in the viser server that starts inside the block, for all its requests.

        Raises:
            HoldfastError: The server did not call the filter, so that it would admit every request.
        """
        from websockets.asyncio import server as sockets

        original_serve = sockets.serve

        def serve_filtered(*positional: Any, process_request: Any = None, **options: Any) -> Any:
            if not getattr(process_request, "__module__", "").startswith("viser."):
                # The server of another caller, started at the same time.
                return original_serve(*positional, process_request=process_request, **options)

            def process_filtered(connection: Any, request: Any) -> Any:
                response = self._filter_response(request)
                return process_request(connection, request) if response is None else response

            self.was_consulted = True
            return original_serve(*positional, process_request=process_filtered, **(options | {"max_size": MAX_MESSAGE_BYTES}))

        with _PATCH_LOCK:  # viser has no option for a filter
            sockets.serve = serve_filtered  # type: ignore[misc,assignment]
            try:
                yield
            finally:
                sockets.serve = original_serve  # type: ignore[misc]
        if not self.was_consulted:
            raise HoldfastError("this version of viser cannot reject requests of other web pages; install viser 1.1")

    def _filter_response(self, request: Any) -> Any:
        """Return the page, a refusal, or None for a request that viser answers."""
        hosts, origins = (request.headers.get_all(name) for name in ("Host", "Origin"))
        if not is_own_request(hosts, origins, self._served):
            refusal = (
                "Refused: this studio answers only to pages that it has served itself; open the address that it printed.\n"
            )
            return _build_response(HTTPStatus.FORBIDDEN, refusal.encode(), "text/plain; charset=utf-8")
        if request.headers.get("Upgrade") is None and request.path.partition("?")[0] in ("/", "/index.html"):
            accepts_gzip = "gzip" in request.headers.get("Accept-Encoding", "")
            return _build_response(
                HTTPStatus.OK, self._gzipped_page if accepts_gzip else self._page_html, "text/html; charset=utf-8", accepts_gzip
            )
        return None

    @cached_property
    def _page_html(self) -> bytes:
        import viser

        page = (Path(viser.__file__).parent / "client" / "build" / "index.html").read_text(encoding="utf-8")
        package_files = resources.files("holdfast.interface.studio.page")
        style, script, legend = (
            package_files.joinpath(name).read_text("utf-8") for name in ("studio.css", "studio.js", "legend.html")
        )
        head_html = f"<style>{style}</style><template id=holdfast-legend>{legend}</template><script>{script}</script>"
        page = page.replace(_VISER_TITLE_HTML, "<title>holdfast studio</title>", 1)
        return page.replace(_HEAD_END_HTML, head_html + _HEAD_END_HTML, 1).encode()

    @cached_property
    def _gzipped_page(self) -> bytes:
        return gzip.compress(self._page_html, 5)


def _build_response(status: HTTPStatus, content: bytes, content_type: str, gzipped: bool = False) -> Any:
    from websockets import Headers
    from websockets.http11 import Response

    headers = Headers(
        {
            "Content-Type": content_type,
            "Content-Length": str(len(content)),
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Cache-Control": "no-store",
        }
        | ({"Content-Encoding": "gzip"} if gzipped else {})
    )
    return Response(status, status.phrase, headers, content)
