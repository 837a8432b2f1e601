"""Sentences of claims, made from the numbers of certificates; decimals are the shortest that represent the same doubles."""

from __future__ import annotations

import hashlib
import json
import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import Any

from .forms import format_intervals, parse_hex
from .paths import SEGMENT_INSTANTS
from .zeros import bound_snap_errors


def claim_sentence(document: dict[str, Any]) -> str:
    """Return the claim of a certificate as a sentence, made from its other keys."""
    names = [joint["name"] for joint in document["arm"]["joints"]]
    format_claims = {"path": _path_claim, "structural-zero": _structural_zero_claim}
    format_claims |= {"ceiling": _bound_claim, "floor": _bound_claim}
    format_claim = format_claims.get(document["kind"], _target_claim)
    return f"{format_claim(document, names)} arm {document['arm_digest'][:12]}."


def _structural_zero_claim(document: dict[str, Any], names: list[str]) -> str:
    tolerance = "{} rad and {} m".format(
        *(f"{_two_digits(Fraction(error), True):g}" if error else "0" for error in bound_snap_errors(document))
    )
    text = f"For every configuration of an arm whose frames are within {tolerance} of the file's, "
    return f"{text}relative manipulability of the pose after a lock of {names[document['locked']]} is 0;"


def _bound_claim(document: dict[str, Any], names: list[str]) -> str:
    text = f"For every configuration with {format_intervals(names, document['joint_box'])}, the least relative "
    text += f"manipulability of the {document['task']} after a lock of one of "
    text += f"{', '.join(names[lock] for lock in document['locks'])} is at "
    return f"{text}{'most' if document['kind'] == 'ceiling' else 'least'} {parse_hex(document['threshold'])!r}; angles in rad,"


def _path_claim(document: dict[str, Any], names: list[str]) -> str:
    knots, (first, last), locked = document["knots"], document["during"], [names[lock["joint"]] for lock in document["locks"]]
    metres, radians = map(parse_hex, document["tube"])
    knots_digest = hashlib.sha256(json.dumps(knots, separators=(",", ":")).encode()).hexdigest()[:12]
    text = f"The healthy arm moves along {len(knots) - 1} straight segments between configurations {knots_digest}. "
    text += f"For every instant from knot {first / SEGMENT_INSTANTS!r} to knot {last / SEGMENT_INSTANTS!r} at which one of "
    text += f"{', '.join(locked)} locks where it is, one continuous motion within "
    text += f"the limits ({format_intervals(names, document['limits'])}) begins there with that joint at rest and takes "
    text += f"the tool along the rest of the {document['task']} path"
    if metres or radians:
        angle_note = f" and {radians!r} rad" if "pose" in document["task"] else ""
        text += f", or along any continuous path that is within {metres!r} m{angle_note} of it and begins on it"
    return f"{text}; angles in rad,"


def _target_claim(document: dict[str, Any], names: list[str]) -> str:
    target, kind, orientation_note = document["target"], document["kind"], ""
    axes = [{"R": "roll", "P": "pitch", "Y": "yaw", "a": "yaw"}.get(axis, axis) for axis in target["axes"]]
    orientation = [parse_hex(number) for number in target["orientation"] or ()]
    if orientation:
        is_pointing = document["task"] == "pointing"
        orientation_note = f" and the tool's z axis along {orientation[2::3]}"
        orientation_note = orientation_note if is_pointing else f" and the rotation {orientation}"
    orientation_note += " and the rotation Rz(yaw) Ry(pitch) Rx(roll)" * ("R" in target["axes"])
    text = f"For every {document['task']} target with {format_intervals(axes, target['box'])}{orientation_note}"
    configuration = f"configuration within the limits ({format_intervals(names, document['limits'])})"
    if kind == "bundle":
        ranges, locked = format_intervals(names, document["working_ranges"]), [names[lock] for lock in document["locks"]]
        text += f", a configuration within the working ranges ({ranges}) reaches it, and after a lock of any one of "
        text += f"{', '.join(locked)} at any value of its range"
    elif document["locked"] >= 0:
        text += f", and every value {format_intervals(['from'], [document['angle']])} at which "
        text += f"{names[document['locked']]} may be locked"
    configuration += " with that value" * (kind == "bundle" or document["locked"] >= 0)
    text += f" and every {configuration}: the tool is elsewhere" if kind == "refutation" else f", a {configuration} reaches it"
    return f"{text}; lengths in m, angles in rad, base frame,"


def qualify_claim(claim: str, proved: Fraction, *, refuted: bool = False, sampled: bool = False) -> str:
    """Return a claim as it may be printed: with the proved fraction in front, unless every cell of all of it is verified."""
    if refuted or sampled:
        return f"{'False' if refuted else 'Sampled, not verified'}: {claim}"
    only = f"Proved for only {format_percent(proved)} of this claim: " if proved else "Not proved: "
    return claim if proved == 1 else only + claim


def format_percent(part: Fraction, up: bool = False) -> str:
    """Format a fraction in per cent, rounded down or up, so that proved fractions are never overstated and undecided ones never
    understated.
    """
    if part in (0, 1):
        return f"{100 * int(part)} %"
    if part < Fraction(1, 10_000):
        return f"{_two_digits(100 * part, up):g} %"
    millionths = math.ceil(part * 10**8) if up else math.floor(part * 10**8)
    if millionths == 10**8:
        return f"all but {_two_digits(100 * (1 - part), False):g} %"
    return f"{millionths // 10**6}.{millionths % 10**6:06d} %"


def _two_digits(x: Fraction, up: bool) -> Decimal:
    """Return the decimal of two digits below or above a fraction."""
    return Context(prec=2, rounding=ROUND_CEILING if up else ROUND_FLOOR).divide(Decimal(x.numerator), Decimal(x.denominator))
