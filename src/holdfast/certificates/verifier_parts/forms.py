"""Common parts of the verifier: numbers, payloads, digests, errors, tasks."""

from __future__ import annotations

import base64
import hashlib
import json
import math
import zlib
from collections.abc import Iterable
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import Any

FOR_PEOPLE: dict[str, Any] = dict.fromkeys(("made_by", "made_at", "seconds", "nodes"), ...)
TASK_FORMS = {  # number of position rows and of rotation rows, and axes of targets
    "planar": (2, 0, "xy"),
    "planar-pose": (2, 1, "xya"),
    "position": (3, 0, "xyz"),
    "pointing": (3, 2, "xyz"),
    "pose": (3, 3, "xyz|xyzRPY"),
}
NUMBER_PATTERN = r"-?0x[01]\.[0-9a-f]{1,13}p[+-]\d{1,4}"
TEXT_PATTERN = "[^\0]*"
HASH_PATTERN = "[0-9a-f]{64}"
INTEGER_PATTERN = r"-?\d{1,40}"
RATIONAL_PATTERN = r"-?\d{1,60}/[1-9]\d{0,60}"
FRACTION_PATTERN = r"\d{1,60}/[1-9]\d{0,60}"
LIMITS_FORM = [f"{NUMBER_PATTERN}|-?inf", 2]
VOLUMES_FORM = dict.fromkeys(("proved", "refuted", "undecided"), r"\d{1,100}/2\^\d{1,3}")
parse_hex = float.fromhex


class CertificateRejected(ValueError):
    """Error for a file that cannot be checked."""


def require(condition: object, message: str) -> None:
    """Raise an error unless a condition holds."""
    if not condition:
        raise CertificateRejected(message)


def compute_digest(document: dict[str, Any]) -> str:
    """Compute the SHA-256 of the canonical JSON of an arm or a certificate, without its digest and the fields on its origin."""
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
        decompressor.eof and len(data) <= max_bytes and not decompressor.unused_data, f"{label} is truncated or holds too much"
    )
    return data


def require_task(document: dict[str, Any]) -> str:
    """Return the task of a certificate, which must be one of :data:`TASK_FORMS`."""
    require(document["task"] in TASK_FORMS, f"the task must be one of: {', '.join(TASK_FORMS)}")
    return str(document["task"])


def require_revolute(document: dict[str, Any]) -> None:
    """Require all joints of the arm of a certificate to be revolute."""
    all_revolute = all(joint["type"] == "revolute" for joint in document["arm"]["joints"])
    require(all_revolute, f"a {document['kind']} needs revolute joints only")


def qualify_claim(claim: str, proved: Fraction, *, refuted: bool = False, sampled: bool = False) -> str:
    """Return a claim with the proved fraction in front, unless every cell of the whole claim is verified."""
    if refuted or sampled:
        return f"{'False' if refuted else 'Sampled, not verified'}: {claim}"
    only = f"Proved for only {format_percent(proved)} of this claim: " if proved else "Not proved: "
    return claim if proved == 1 else only + claim


def format_percent(part: Fraction, up: bool = False) -> str:
    """Format a fraction in per cent, rounded down or up.

    Rounding never overstates proved fractions, and never understates undecided fractions.
    """
    if part in (0, 1):
        return f"{100 * int(part)} %"
    if part < Fraction(1, 10_000):
        return f"{round_to_two_digits(100 * part, up):g} %"
    millionths = math.ceil(part * 10**8) if up else math.floor(part * 10**8)
    if millionths == 10**8:
        return f"all but {round_to_two_digits(100 * (1 - part), False):g} %"
    return f"{millionths // 10**6}.{millionths % 10**6:06d} %"


def round_to_two_digits(x: Fraction, up: bool) -> Decimal:
    """Return the two-digit decimal below or above a fraction."""
    return Context(prec=2, rounding=ROUND_CEILING if up else ROUND_FLOOR).divide(Decimal(x.numerator), Decimal(x.denominator))
