"""What the other modules take for granted: numbers, payloads, digests, refusals, tasks."""

from __future__ import annotations

import base64
import hashlib
import json
import zlib
from collections.abc import Iterable
from typing import Any

FOR_PEOPLE: dict[str, Any] = dict.fromkeys(("made_by", "made_at", "seconds", "nodes"), ...)
TASKS = {  # how many rows of the place, how many of the rotation, and axes of targets
    "planar": (2, 0, "xy"),
    "planar-pose": (2, 1, "xya"),
    "position": (3, 0, "xyz"),
    "pointing": (3, 2, "xyz"),
    "pose": (3, 3, "xyz|xyzRPY"),
}
real = float.fromhex


class Refused(ValueError):
    """A file that cannot be checked; one sentence."""


def need(good: object, sentence: str) -> None:
    """Refuse the file unless something holds."""
    if not good:
        raise Refused(sentence)


def digest(document: dict[str, Any]) -> str:
    """SHA-256 of the canonical JSON of a certificate, without its digest and when and by what it was made; or of an arm."""
    kept = {key: value for key, value in document.items() if key != "digest" and key not in FOR_PEOPLE}
    return hashlib.sha256(json.dumps(kept, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def spans(names: Iterable[str], pairs: Iterable[list[str]]) -> str:
    """Intervals for people; decimals are the shortest that mean the same doubles."""
    return ", ".join(f"{name} {' to '.join(repr(real(x)) for x in pair)}" for name, pair in zip(names, pairs, strict=True))


def unpacked(text: str, most: int, what: str) -> bytes:
    """What a payload holds, of which never more than ``most`` bytes are made."""
    opened = zlib.decompressobj()
    try:
        data = opened.decompress(base64.b64decode(text, validate=True), most + 1)
    except (ValueError, zlib.error) as error:
        raise Refused(f"{what} cannot be unpacked: {error}") from None
    need(opened.eof and len(data) <= most and not opened.unused_data, f"{what} is cut off or holds too much")
    return data
