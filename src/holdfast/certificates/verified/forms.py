"""What a certificate must look like before anything in it is checked."""

from __future__ import annotations

import base64
import hashlib
import json
import math
import re
import zlib
from collections.abc import Iterable
from typing import Any

NUMBER, TEXT, HASH = r"-?0x[01]\.[0-9a-f]{1,13}p[+-]\d{1,4}", "[^\0]*", "[0-9a-f]{64}"
WHOLE, RATIONAL = r"-?\d{1,40}", r"-?\d{1,60}/[1-9]\d{0,60}"
LIMITS, FRAME = [f"{NUMBER}|-?inf", 2], {"rotation": [NUMBER, 9], "origin": [NUMBER, 3]}
ARM = {"joints": [{"name": TEXT, "type": "revolute|prismatic", "limits": LIMITS, **FRAME}, ...], "tool": FRAME}
FOR_PEOPLE: dict[str, Any] = dict.fromkeys(("made_by", "made_at", "seconds", "nodes"), ...)
VOLUMES = dict.fromkeys(("proved", "refuted", "undecided"), r"\d{1,100}/2\^\d{1,3}")
KINDS = "reach|bundle|refutation|ceiling|floor|structural-zero|path"
COMMON: dict[str, Any] = {"format": "holdfast-certificate", "version": range(1, 2), "kind": KINDS, "arm": ARM}
COMMON |= {"arm_digest": HASH, "source": ..., "claim": TEXT, "task": TEXT, "volumes": VOLUMES, "digest": HASH, **FOR_PEOPLE}
real = float.fromhex
UNIT, MOST_BYTES = 2.0**-24, 256 << 20


class Refused(ValueError):
    """A file that cannot be checked; one sentence."""


def need(good: object, sentence: str) -> None:
    """Refuse the file unless something holds."""
    if not good:
        raise Refused(sentence)


def fit(value: Any, form: Any, what: str) -> None:
    """A form: an object of these keys, a list [form, length], text of a pattern, a range of integers, null; ... is anything."""
    if isinstance(form, dict):
        odd = sorted(form.keys() ^ value.keys() if isinstance(value, dict) else form)[:1]
        need(not odd, f"{what} must be an object with the keys {', '.join(form)}: see {''.join(odd)[:40]!r}")
        for key, inner in form.items():
            fit(value[key], inner, f"{key} of {what}")
    elif isinstance(form, list):
        need(isinstance(value, list) and form[1] in (len(value), ...), f"{what} must be a list of {form[1]}")
        for one in value:
            fit(one, form[0], what)
    elif isinstance(form, str):
        need(isinstance(value, str) and re.fullmatch(form, value), f"{what} is {str(value)[:40]!r}; it must be like {form}")
    elif isinstance(form, range):
        need(type(value) is int and value in form, f"{what} must be a whole number from {form[0]} to {form[-1]}")
    else:
        need(form is ... or value is None, f"{what} must be null here")


def within(pairs: list[Any], outer: list[Any], what: str) -> None:
    """Refuse pairs that are upside down or go beyond others."""
    for (low, high), (least, most) in ([map(real, pair) for pair in both] for both in zip(pairs, outer, strict=True)):
        good = least <= low <= high <= most and low < math.inf and high > -math.inf
        need(good, f"{what}: {low!r} to {high!r} is upside down or goes beyond {least!r} to {most!r}")


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
