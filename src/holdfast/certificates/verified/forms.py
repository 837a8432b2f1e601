"""Common parts of the verifier: numbers, payloads, digests, errors, tasks."""

from __future__ import annotations

import base64
import hashlib
import json
import zlib
from collections.abc import Iterable
from typing import Any

FOR_PEOPLE: dict[str, Any] = dict.fromkeys(("made_by", "made_at", "seconds", "nodes"), ...)
TASK_FORMS = {  # how many rows of the place, how many of the rotation, and axes of targets
    "planar": (2, 0, "xy"),
    "planar-pose": (2, 1, "xya"),
    "position": (3, 0, "xyz"),
    "pointing": (3, 2, "xyz"),
    "pose": (3, 3, "xyz|xyzRPY"),
}
parse_hex = float.fromhex


class CertificateRejected(ValueError):
    """Error for a file that cannot be checked."""


def require(condition: object, message: str) -> None:
    """Raise an error unless a condition holds."""
    if not condition:
        raise CertificateRejected(message)


def compute_digest(document: dict[str, Any]) -> str:
    """Compute the SHA-256 of the canonical JSON of a certificate, without its digest and the fields about its making, or of an
    arm.
    """
    signed = {key: value for key, value in document.items() if key != "digest" and key not in FOR_PEOPLE}
    return hashlib.sha256(json.dumps(signed, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def format_intervals(names: Iterable[str], pairs: Iterable[list[str]]) -> str:
    """Format intervals as text; decimals are the shortest that represent the same doubles."""
    return ", ".join(f"{name} {' to '.join(repr(parse_hex(x)) for x in pair)}" for name, pair in zip(names, pairs, strict=True))


def decompress_payload(text: str, max_bytes: int, label: str) -> bytes:
    """Decompress a payload of at most ``max_bytes`` bytes."""
    decompressor = zlib.decompressobj()
    try:
        data = decompressor.decompress(base64.b64decode(text, validate=True), max_bytes + 1)
    except (ValueError, zlib.error) as error:
        raise CertificateRejected(f"{label} cannot be unpacked: {error}") from None
    require(
        decompressor.eof and len(data) <= max_bytes and not decompressor.unused_data, f"{label} is cut off or holds too much"
    )
    return data
