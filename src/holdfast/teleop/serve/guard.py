"""Access control: host and origin, the token, the experimenter's key, and rate limits."""

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

from holdfast.core.errors import InputError
from holdfast.core.files import hosts

_TOKEN_PATTERN = re.compile("[A-Za-z0-9_-]{12,128}")
_GUESSABLE_WORDS = ("password", "passwort", "qwerty", "letmein", "holdfast", "secret", "token", "study", "admin")
# _MAX_FAILED_ATTEMPTS and _ATTEMPTS_PER_SECOND: wrong tokens and keys of one address, at once and per second after that
_MAX_FAILED_ATTEMPTS = 200.0
_ATTEMPTS_PER_SECOND = 1.0
_MAX_ADDRESSES = 1024
_STATION_PATHS = ("/", "/experiment.json", "/arm.js", "/session")
_EXPERIMENTER_PATHS = ("/experimenter", "/live")


@dataclass(frozen=True)
class Guard:
    """Secrets that a request must contain.

    Attributes:
        token: Token of the stations' pages; None if only this computer can connect.
        key: Key of the experimenter.
        loopback: True if the Host header must name this computer.
    """

    token: str | None = None
    key: str = field(default_factory=lambda: secrets.token_urlsafe(18))
    loopback: bool = True

    def explain_foreign_request(self, scope: Scope) -> str | None:
        """Return the reason if a request is not from this server's pages, a typed address, or a link; None if it is."""
        headers = Headers(scope=scope)
        origins = headers.getlist("origin")
        host_fault = hosts.request_rejection_reason(
            headers.getlist("host"), origins, lambda name: not self.loopback or hosts.is_loopback_host(name)
        )
        if host_fault is not None:
            return host_fault
        is_read = scope["type"] == "http" and scope["method"] in ("GET", "HEAD")
        follows_link = is_read and headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
        if is_cross_origin_request(scope) and not origins and not follows_link:
            return "the request comes from a page of another host"
        return None

    def name_missing_secret(self, scope: Scope) -> str | None:
        """Return a message about the secret that a request lacks; None if it has everything that its path needs."""
        path = scope["path"]
        if any(path == prefix or path.startswith(prefix + "/") for prefix in _EXPERIMENTER_PATHS):
            return (
                None
                if self.has_experimenter_key(scope)
                else "the experimenter's key is missing or wrong; it is in the URL printed at the start"
            )
        if path in _STATION_PATHS and not (self.has_token(scope) or self.has_experimenter_key(scope)):
            return "the token is missing or wrong; it is in the URL that the server printed at its start"
        return None

    def has_token(self, scope: Scope) -> bool:
        """Return True if the token is in the query, or in the cookie of the page."""
        return self.token is None or any(
            _equals_secret(value, self.token)
            for value in (_query_value(scope, "token"), _cookie_value(scope, _cookie_name(self.token)))
        )

    def has_experimenter_key(self, scope: Scope) -> bool:
        """Return True if the key is in the query; no cookie has it, because a subject may use the experimenter's browser."""
        return _equals_secret(_query_value(scope, "key"), self.key)

    def has_secret_in_query(self, scope: Scope) -> bool:
        """Return True if the query has a token or a key, right or wrong; cookies, named after the token, do not count."""
        return (self.token is not None and bool(_query_value(scope, "token"))) or bool(_query_value(scope, "key"))

    def make_cookie(self, scope: Scope) -> str | None:
        """Return the cookie that admits the page's own requests; None if there is none to set."""
        if self.token is None or scope["path"] != "/":
            return None
        return f"{_cookie_name(self.token)}={self.token}; Path=/; HttpOnly; SameSite=Strict"


def is_cross_origin_request(scope: Scope) -> bool:
    """Return True if the browser states that a page of another server caused the request."""
    return Headers(scope=scope).get("sec-fetch-site", "none") not in ("same-origin", "none")


def check_token(token: str) -> None:
    """Check that a token cannot be guessed and fits into a URL.

    Raises:
        InputError: The token is shorter than 12 characters, has other characters than letters, digits, - and _, or is easily
            guessed: few different characters, a sequence, a repeated part, or hardly more than a common word.
    """
    example = "for example the output of 'openssl rand -hex 16'"
    if not _TOKEN_PATTERN.fullmatch(token):
        raise InputError(f"the token must have 12 to 128 letters, digits, - and _; {example}")
    lowered = token.lower()
    close_pairs = sum(abs(ord(first) - ord(second)) <= 1 for first, second in pairwise(lowered))
    remainder = lowered
    for word in _GUESSABLE_WORDS:
        remainder = remainder.replace(word, "")
    if (
        len(set(lowered)) < 6
        or close_pairs > len(lowered) / 2
        or lowered in (lowered + lowered)[1:-1]
        or len(set(remainder)) < 6
    ):
        raise InputError(f"the token is easily guessed; take a random one, {example}")


class FailedAttempts:
    """Counts of wrong tokens and keys, by address.

    Args:
        clock: Function that returns the time in s.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._limiters: dict[str, RateLimiter] = {}

    def count_attempt(self, address: str) -> None:
        """Count one attempt from an address."""
        limiter = self._limiters.pop(address, None) or RateLimiter(_ATTEMPTS_PER_SECOND, _MAX_FAILED_ATTEMPTS, self._clock)
        self._limiters[address] = limiter
        limiter.reserve_and_get_wait()
        if len(self._limiters) > _MAX_ADDRESSES:
            del self._limiters[next(iter(self._limiters))]

    def has_too_many_failures(self, address: str) -> bool:
        """Return True if an address has sent more wrong tokens and keys than allowed."""
        limiter = self._limiters.get(address)
        return limiter is not None and limiter.reserve_and_get_wait(0) > 0


class GuardedApp:
    """Application behind a guard, which rejects invalid requests and sets headers on valid ones."""

    def __init__(self, app: ASGIApp, guard: Guard) -> None:
        self._app, self._guard = app, guard
        self._attempts = FailedAttempts()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handle a request by the ASGI protocol."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        fault = self._guard.explain_foreign_request(scope)
        must_wait = False
        if fault is None:
            fault = self._guard.name_missing_secret(scope)
            # A page of another server must not use up the attempts of the address whose browser shows that page.
            if fault is not None and self._guard.has_secret_in_query(scope) and not is_cross_origin_request(scope):
                must_wait = self._count_attempt(scope)
        if must_wait:
            fault = "too many wrong tokens or keys came from this address; wait a moment"
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
                for name, value in _security_headers(Headers(scope=scope).get("host", ""), fault is None).items():
                    headers.setdefault(name, value)  # a report has its own stricter policy
                cookie = self._guard.make_cookie(scope) if fault is None else None
                if cookie is not None:
                    headers["set-cookie"] = cookie
            await send(message)

        if fault is None:
            await self._app(scope, receive, with_headers)
        else:
            await PlainTextResponse(f"Refused: {fault}.\n", status_code=429 if must_wait else 403)(scope, receive, with_headers)

    def _count_attempt(self, scope: Scope) -> bool:
        """Count a wrong token or key, and return True if its address has sent too many."""
        client = scope.get("client")
        address = "" if client is None else client[0]
        must_wait = self._attempts.has_too_many_failures(address)
        if not must_wait:
            self._attempts.count_attempt(address)
        return must_wait


def _security_headers(host: str, is_allowed: bool) -> dict[str, str]:
    sockets = f" ws://{host} wss://{host}" if is_allowed else ""
    policy = f"default-src 'self'; connect-src 'self'{sockets}; frame-ancestors 'none'; base-uri 'none'; object-src 'none'"
    return {
        "content-security-policy": policy,
        "x-content-type-options": "nosniff",
        "referrer-policy": "no-referrer",
        "cross-origin-resource-policy": "same-origin",
        "cache-control": "no-store",
    }


class RateLimiter:
    """Rate limit of messages or bytes: ``rate`` per second in the long run, and up to ``burst`` at once after a pause.

    Args:
        rate: Units per second.
        burst: Units at once.
        clock: Function that returns the time in s.
    """

    def __init__(self, rate: float = 200.0, burst: float = 2000.0, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._allowance, self._updated_at = burst, clock()

    def reserve_and_get_wait(self, count: float = 1) -> float:
        """Take ``count`` units of the allowance, and return the seconds to wait before they may be used."""
        now = self._clock()
        self._allowance = min(self._burst, self._allowance + (now - self._updated_at) * self._rate) - count
        self._updated_at = now
        return max(0.0, -self._allowance / self._rate)


def _equals_secret(value: str | None, secret: str) -> bool:
    return value is not None and secrets.compare_digest(value.encode(), secret.encode())


def _query_value(scope: Scope, name: str) -> str | None:
    try:
        values = parse_qs(scope["query_string"].decode("latin-1"), max_num_fields=20).get(name)
    except ValueError:
        return None
    return values[0] if values else None


def _cookie_value(scope: Scope, name: str) -> str | None:
    try:
        cookies = SimpleCookie(Headers(scope=scope).get("cookie", ""))
    except CookieError:
        return None
    return cookies[name].value if name in cookies else None


def _cookie_name(token: str) -> str:
    # Cookies are shared between ports, so two servers on one computer need two names.
    return f"holdfast-{hashlib.sha256(token.encode()).hexdigest()[:12]}"
