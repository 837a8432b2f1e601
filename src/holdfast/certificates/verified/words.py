"""What a certificate claims, in words made from its numbers."""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import Any

from . import paths
from .forms import real, spans
from .zeros import snap


def sentence(document: dict[str, Any]) -> str:
    """The claim of a certificate, made from its other keys; its decimals are the shortest that mean the same doubles."""
    if document["kind"] == "path":
        return paths.sentence(document)
    names = [joint["name"] for joint in document["arm"]["joints"]]
    if document["kind"] == "structural-zero":
        near = "{} rad and {} m".format(*(f"{_two_digits(Fraction(x), True):g}" if x else "0" for x in snap(document)))
        text = f"For every configuration of an arm whose frames are within {near} of the file's, relative manipulability of the"
        return f"{text} pose after a lock of {names[document['locked']]} is 0; arm {document['arm_digest'][:12]}."
    if document["kind"] in ("ceiling", "floor"):
        least = f"the least relative manipulability of the {document['task']} after a lock of one of "
        least += (
            f"{', '.join(names[k] for k in document['locks'])} is at {'most' if document['kind'] == 'ceiling' else 'least'} "
        )
        least += repr(real(document["threshold"]))
        text = f"For every configuration with {spans(names, document['joint_box'])}, {least}"
        return f"{text}; angles in rad, arm {document['arm_digest'][:12]}."
    target = document["target"]
    axes = [{"R": "roll", "P": "pitch", "Y": "yaw", "a": "yaw"}.get(axis, axis) for axis in target["axes"]]
    turned, given = "", [real(x) for x in target["orientation"] or ()]
    if given:
        turned = (
            f" and the tool's z axis along {given[2::3]}" if document["task"] == "pointing" else f" and the rotation {given}"
        )
    turned += " and the rotation Rz(yaw) Ry(pitch) Rx(roll)" * ("R" in target["axes"])
    text = f"For every {document['task']} target with {spans(axes, target['box'])}{turned}"
    kept = f"a configuration within the limits ({spans(names, document['limits'])})"
    if document["kind"] == "bundle":
        text += (
            f", a configuration within the working ranges ({spans(names, document['working_ranges'])}) reaches it, and after"
        )
        text += f" a lock of any one of {', '.join(names[i] for i in document['locks'])} at any value of its range"
        kept += " with that value"
    elif document["locked"] >= 0:
        text += f", and every value {spans(['from'], [document['angle']])} at which {names[document['locked']]} may be locked"
        kept += " with that value"
    if document["kind"] == "refutation":
        text, kept = f"{text} and every configuration{kept.removeprefix('a configuration')}: the tool is elsewhere", ""
    ends = f", {kept} reaches it" if kept else ""
    return f"{text}{ends}; lengths in m, angles in rad, base frame, arm {document['arm_digest'][:12]}."


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
