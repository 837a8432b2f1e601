"""What a certificate claims, in words made from its numbers; its decimals are the shortest that mean the same doubles."""

from __future__ import annotations

import hashlib
import json
import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import Any

from .forms import real, spans
from .paths import SEGMENT
from .zeros import snap


def sentence(document: dict[str, Any]) -> str:
    """The claim of a certificate, made from its other keys."""
    names = [joint["name"] for joint in document["arm"]["joints"]]
    said = {"path": _path, "structural-zero": _zero, "ceiling": _bound, "floor": _bound}.get(document["kind"], _target)
    return f"{said(document, names)} arm {document['arm_digest'][:12]}."


def _zero(document: dict[str, Any], names: list[str]) -> str:
    near = "{} rad and {} m".format(*(f"{_two_digits(Fraction(x), True):g}" if x else "0" for x in snap(document)))
    text = f"For every configuration of an arm whose frames are within {near} of the file's, relative manipulability of the"
    return f"{text} pose after a lock of {names[document['locked']]} is 0;"


def _bound(document: dict[str, Any], names: list[str]) -> str:
    text = f"For every configuration with {spans(names, document['joint_box'])}, the least relative manipulability of the "
    text += f"{document['task']} after a lock of one of {', '.join(names[k] for k in document['locks'])} is at "
    return f"{text}{'most' if document['kind'] == 'ceiling' else 'least'} {real(document['threshold'])!r}; angles in rad,"


def _path(document: dict[str, Any], names: list[str]) -> str:
    knots, (first, last), locked = document["knots"], document["during"], [names[one["joint"]] for one in document["locks"]]
    metres, radians = map(real, document["tube"])
    made = hashlib.sha256(json.dumps(knots, separators=(",", ":")).encode()).hexdigest()[:12]
    text = (
        f"The healthy arm moves along {len(knots) - 1} straight segments between configurations {made}. For every instant from "
    )
    text += f"knot {first / SEGMENT!r} to knot {last / SEGMENT!r} at which one of {', '.join(locked)} locks "
    text += f"where it is, one continuous motion within the limits ({spans(names, document['limits'])}) begins there with that "
    text += f"joint at rest and takes the tool along the rest of the {document['task']} path"
    if metres or radians:
        off = f" and {radians!r} rad" if "pose" in document["task"] else ""
        text += f", or along any continuous path that is within {metres!r} m{off} of it and begins on it"
    return f"{text}; angles in rad,"


def _target(document: dict[str, Any], names: list[str]) -> str:
    target, kind, turned = document["target"], document["kind"], ""
    axes = [{"R": "roll", "P": "pitch", "Y": "yaw", "a": "yaw"}.get(axis, axis) for axis in target["axes"]]
    given = [real(x) for x in target["orientation"] or ()]
    if given:
        turned = (
            f" and the tool's z axis along {given[2::3]}" if document["task"] == "pointing" else f" and the rotation {given}"
        )
    turned += " and the rotation Rz(yaw) Ry(pitch) Rx(roll)" * ("R" in target["axes"])
    text = f"For every {document['task']} target with {spans(axes, target['box'])}{turned}"
    kept = f"configuration within the limits ({spans(names, document['limits'])})"
    if kind == "bundle":
        ranges, locked = spans(names, document["working_ranges"]), [names[i] for i in document["locks"]]
        text += f", a configuration within the working ranges ({ranges}) reaches it, and after a lock of any one of "
        text += f"{', '.join(locked)} at any value of its range"
    elif document["locked"] >= 0:
        text += f", and every value {spans(['from'], [document['angle']])} at which {names[document['locked']]} may be locked"
    kept += " with that value" * (kind == "bundle" or document["locked"] >= 0)
    text += f" and every {kept}: the tool is elsewhere" if kind == "refutation" else f", a {kept} reaches it"
    return f"{text}; lengths in m, angles in rad, base frame,"


def qualify_claim(claim: str, proved: Fraction, *, refuted: bool = False, sampled: bool = False) -> str:
    """Return a claim as it may be printed: with the proved fraction in front, unless every cell of all of it is verified."""
    if refuted or sampled:
        return f"{'False' if refuted else 'Sampled, not verified'}: {claim}"
    only = f"Proved for only {per_cent(proved)} of this claim: " if proved else "Not proved: "
    return claim if proved == 1 else only + claim


def per_cent(part: Fraction, up: bool = False) -> str:
    """A share in per cent, rounded down, or up: what is proved is never said to be more, what is undecided never less."""
    if part in (0, 1):
        return f"{100 * int(part)} %"
    if part < Fraction(1, 10_000):
        return f"{_two_digits(100 * part, up):g} %"
    millionths = math.ceil(part * 10**8) if up else math.floor(part * 10**8)
    if millionths == 10**8:
        return f"all but {_two_digits(100 * (1 - part), False):g} %"
    return f"{millionths // 10**6}.{millionths % 10**6:06d} %"


def _two_digits(x: Fraction, up: bool) -> Decimal:
    """The decimal of two digits above or below."""
    return Context(prec=2, rounding=ROUND_CEILING if up else ROUND_FLOOR).divide(Decimal(x.numerator), Decimal(x.denominator))
