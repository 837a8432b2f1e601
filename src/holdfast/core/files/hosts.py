"""Decide which requests a local server answers, by the host and the origin of the request.

A browser lets every web page send requests to this computer. The header ``Origin`` names the host of that page; ``Host``
reveals a page whose host name was given the address of this computer (DNS rebinding). Other programs send no ``Origin``.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Callable, Sequence
from urllib.parse import urlsplit

_HOST_PATTERN = re.compile(r"(?:[A-Za-z0-9._-]{1,253}|\[[0-9A-Fa-f:.]{2,45}\])(?::\d{1,5})?")


def request_rejection_reason(hosts: Sequence[str], origins: Sequence[str], is_own_host: Callable[[str], bool]) -> str | None:
    """Return the reason to reject a request, or None.

    Args:
        hosts: ``Host`` headers of the request; exactly one is right.
        origins: ``Origin`` headers of the request; at most one is right.
        is_own_host: Returns whether the server answers for a host name, which has lower case and no port or brackets.
    """
    host = hosts[0] if len(hosts) == 1 else ""
    name = _parse_host_name(host)
    if name is None or not is_own_host(name):
        return "the request names another host"
    own = (f"http://{host}".lower(), f"https://{host}".lower())
    if len(origins) > 1 or any(origin.lower() not in own for origin in origins):
        return "the request comes from a page of another host"
    return None


def is_loopback_host(name: str) -> bool:
    """Return whether a name or address always means this computer."""
    try:
        return ipaddress.ip_address(name).is_loopback
    except ValueError:
        return name == "localhost"


def _parse_host_name(host: str) -> str | None:
    try:
        return urlsplit(f"//{host}").hostname if _HOST_PATTERN.fullmatch(host) else None
    except ValueError:
        return None
