"""Who may ask: the right host and origin, the token, the experimenter's key; and how much, how fast."""

from __future__ import annotations

import hashlib
import re
import secrets
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from http.cookies import CookieError, SimpleCookie
from itertools import pairwise
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from holdfast.errors import InputError
from holdfast.files import hosts

_TOKEN = re.compile("[A-Za-z0-9_-]{12,128}")
_GUESSED = ("password", "passwort", "qwerty", "letmein", "holdfast", "secret", "token", "study", "admin")
_WRONG, _AGAIN = 200.0, 1.0  # wrong tokens and keys of one address at once, and a second after that
_ADDRESSES = 1024
_STATION = ("/", "/experiment.json", "/arm.js", "/session")
_EXPERIMENTER = ("/experimenter", "/live")


@dataclass(frozen=True)
class Guard:
    """What a request must show.

    Attributes:
        token: That pages of stations must have; None for none: only where nobody but this computer can ask.
        key: The experimenter's.
        loopback: Only names of this computer are right in the Host header.
    """

    token: str | None = None
    key: str = field(default_factory=lambda: secrets.token_urlsafe(18))
    loopback: bool = True

    def find_foreign_source(self, scope: Scope) -> str | None:
        """Return why a request does not come from this server's pages, a typed address, or a link; None if it does."""
        headers = Headers(scope=scope)
        origins = headers.getlist("origin")
        wrong = hosts.fault(headers.getlist("host"), origins, lambda name: not self.loopback or hosts.is_loopback(name))
        if wrong is not None:
            return wrong
        reads = scope["type"] == "http" and scope["method"] in ("GET", "HEAD")
        follows_link = reads and headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
        if comes_from_other_page(scope) and not origins and not follows_link:
            return "the request comes from a page of another host"
        return None

    def find_missing_secret(self, scope: Scope) -> str | None:
        """Return which secret a request lacks; None if it shows what its path needs."""
        path = scope["path"]
        if any(path == area or path.startswith(area + "/") for area in _EXPERIMENTER):
            return (
                None
                if self.is_experimenter(scope)
                else "the experimenter's key is missing or wrong; it is in the URL printed at the start"
            )
        if path in _STATION and not (self.has_token(scope) or self.is_experimenter(scope)):
            return "the token is missing or wrong; it is in the URL that the server printed at its start"
        return None

    def has_token(self, scope: Scope) -> bool:
        """The token is in the query, or in the cookie that the page was given with it."""
        return self.token is None or any(
            _same(given, self.token) for given in (_query(scope, "token"), _cookie(scope, _cookie_name(self.token)))
        )

    def is_experimenter(self, scope: Scope) -> bool:
        """The key is in the query. No cookie has it: a subject may sit at the browser that the experimenter used."""
        return _same(_query(scope, "key"), self.key)

    def shows(self, scope: Scope) -> bool:
        """Whether there is a token or a key in the query, right or wrong. Who guesses cannot know the cookie's name."""
        return (self.token is not None and bool(_query(scope, "token"))) or bool(_query(scope, "key"))

    def cookie(self, scope: Scope) -> str | None:
        """What the answer leaves in the browser, so that the page's own requests are let in."""
        if self.token is None or scope["path"] != "/":
            return None
        return f"{_cookie_name(self.token)}={self.token}; Path=/; HttpOnly; SameSite=Strict"


def comes_from_other_page(scope: Scope) -> bool:
    """Return whether the browser states that a page of another server caused the request."""
    return Headers(scope=scope).get("sec-fetch-site", "none") not in ("same-origin", "none")


def check_token(token: str) -> None:
    """Refuse a token that can be guessed, or that does not fit into a URL.

    Raises:
        InputError: It is shorter than 12 characters, has others than letters, digits, - and _, or is easily guessed: few
            different characters, a sequence, the same part again and again, hardly more than a common word.
    """
    example = "for example the output of 'openssl rand -hex 16'"
    if not _TOKEN.fullmatch(token):
        raise InputError(f"the token must have 12 to 128 letters, digits, - and _; {example}")
    low = token.lower()
    steps = sum(abs(ord(a) - ord(b)) <= 1 for a, b in pairwise(low))
    bare = low
    for word in _GUESSED:
        bare = bare.replace(word, "")
    if len(set(low)) < 6 or steps > len(low) / 2 or low in (low + low)[1:-1] or len(set(bare)) < 6:
        raise InputError(f"the token is easily guessed; take a random one, {example}")


class Wrong:
    """Counts of wrong tokens and keys, by address.

    Args:
        clock: Seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._seen: dict[str, Bucket] = {}

    def count(self, address: str) -> None:
        """One more from an address."""
        bucket = self._seen.pop(address, None) or Bucket(_AGAIN, _WRONG, self._clock)
        self._seen[address] = bucket
        bucket.wait()
        if len(self._seen) > _ADDRESSES:
            del self._seen[next(iter(self._seen))]

    def must_wait(self, address: str) -> bool:
        """Return whether an address has shown more wrong tokens and keys than it may."""
        bucket = self._seen.get(address)
        return bucket is not None and bucket.wait(0) > 0


class Guarded:
    """An application behind a guard: refuses what is wrong, and puts the headers on what is right."""

    def __init__(self, app: ASGIApp, guard: Guard) -> None:
        self._app, self._guard = app, guard
        self._wrong = Wrong()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """As ASGI has it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        fault = self._guard.find_foreign_source(scope)
        waits = False
        if fault is None:
            fault = self._guard.find_missing_secret(scope)
            # A page of another server must not use up the attempts of the address whose browser shows that page.
            if fault is not None and self._guard.shows(scope) and not comes_from_other_page(scope):
                waits = self._count_wrong(scope)
        if waits:
            fault = "too many wrong tokens or keys came from this address; wait"
        if fault is not None and scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": fault})
            return
        if scope["type"] == "websocket":
            await self._app(scope, receive, send)
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in _headers(Headers(scope=scope).get("host", ""), fault is None).items():
                    headers.setdefault(name, value)  # a report has a stricter policy of its own
                cookie = self._guard.cookie(scope) if fault is None else None
                if cookie is not None:
                    headers["set-cookie"] = cookie
            await send(message)

        if fault is None:
            await self._app(scope, receive, with_headers)
        else:
            await PlainTextResponse(f"Refused: {fault}.\n", status_code=429 if waits else 403)(scope, receive, with_headers)

    def _count_wrong(self, scope: Scope) -> bool:
        """Count a wrong token or key, and return whether its address has shown too many."""
        client = scope.get("client")
        address = "" if client is None else client[0]
        waits = self._wrong.must_wait(address)
        if not waits:
            self._wrong.count(address)
        return waits


def _headers(host: str, known: bool) -> dict[str, str]:
    sockets = f" ws://{host} wss://{host}" if known else ""
    policy = f"default-src 'self'; connect-src 'self'{sockets}; frame-ancestors 'none'; base-uri 'none'; object-src 'none'"
    return {
        "content-security-policy": policy,
        "x-content-type-options": "nosniff",
        "referrer-policy": "no-referrer",
        "cross-origin-resource-policy": "same-origin",
        "cache-control": "no-store",
    }


class Bucket:
    """How many messages, or bytes, may pass: so many a second for ever, and so many at once after a pause.

    Args:
        rate: Per second.
        burst: At once.
        clock: Seconds.
    """

    def __init__(self, rate: float = 200.0, burst: float = 2000.0, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._at = burst, clock()

    def wait(self, count: float = 1) -> float:
        """Take one, or more; the seconds that it must wait."""
        at = self._clock()
        self._left = min(self._burst, self._left + (at - self._at) * self._rate) - count
        self._at = at
        return max(0.0, -self._left / self._rate)


def _same(given: str | None, secret: str) -> bool:
    return given is not None and secrets.compare_digest(given.encode(), secret.encode())


def _query(scope: Scope, name: str) -> str | None:
    try:
        values = parse_qs(scope["query_string"].decode("latin-1"), max_num_fields=20).get(name)
    except ValueError:
        return None
    return values[0] if values else None


def _cookie(scope: Scope, name: str) -> str | None:
    try:
        jar = SimpleCookie(Headers(scope=scope).get("cookie", ""))
    except CookieError:
        return None
    return jar[name].value if name in jar else None


def _cookie_name(token: str) -> str:
    # Cookies know no ports: two servers of one computer need two names.
    return f"holdfast-{hashlib.sha256(token.encode()).hexdigest()[:12]}"
