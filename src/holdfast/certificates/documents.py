"""Certificates as their files hold them; :mod:`holdfast.certificates.verifier` says what each key is."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Sequence
from datetime import UTC, datetime
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast import __version__
from holdfast.arm.model import Arm
from holdfast.certificates import verifier
from holdfast.certificates.claims import OutOfReachClaim, ReachClaim, TolerantClaim
from holdfast.certificates.joint_boxes.exclusion import Exclusion
from holdfast.certificates.joint_boxes.jobs import Bisection
from holdfast.certificates.joint_claims import BoundClaim, StructuralZeroClaim
from holdfast.certificates.target_boxes.jobs import Found
from holdfast.certificates.taylor import UNIT, Chain
from holdfast.certificates.tool_paths import cells
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.march import LockedPath
from holdfast.certificates.tool_paths.rings import rings_of
from holdfast.certificates.tree import PROVED
from holdfast.certificates.verified import paths
from holdfast.certificates.verified.tree import Cell
from holdfast.errors import InputError

Document = dict[str, Any]


def reach(claim: ReachClaim, found: Found, undecided: Fraction) -> Document:
    """The certificate of a search, of whose box a part is undecided."""
    return _signed(
        _common("reach", claim, found.seconds, found.nodes)
        | _asked(claim)
        | {
            "unit": UNIT.hex(),
            "tree": _packed(found.tree),
            "centres": _packed(found.centres.astype("<i4").tobytes()),
            "refutations": [],
            "volumes": _volumes(undecided),
        }
    )


def said(claim: ReachClaim | OutOfReachClaim | BoundClaim | PathClaim) -> str:
    """The sentence of a claim, which has all of its numbers and the digest of the arm."""
    kinds = {ReachClaim: "reach", OutOfReachClaim: "refutation", PathClaim: "path"}
    made = _common(claim.kind if isinstance(claim, BoundClaim) else kinds[type(claim)], claim, 0.0, 0) | _asked(claim)
    return verifier.sentence(made | {"arm_digest": verifier.digest(made["arm"])})


def bundle(claim: TolerantClaim, parts: Sequence[Document], worst: int, names: Sequence[str]) -> Document:
    """The certificate that names those of its parts, as files; of the worst part it has the volumes."""
    listed = [
        {"file": name, "digest": part["digest"], "locked": part["locked"]} for name, part in zip(names, parts, strict=True)
    ]
    spent = {key: sum(part[key] for part in parts) for key in ("seconds", "nodes")}
    return _signed(
        _common("bundle", claim, **spent)
        | {
            "limits": _hexes(np.column_stack([claim.arm.lower, claim.arm.upper])),
            "working_ranges": _hexes(claim.working_ranges),
            "locks": list(claim.locks),
            "parts": listed,
            "volumes": parts[worst]["volumes"],
        }
    )


def refutation(claim: OutOfReachClaim, found: Exclusion, *, seconds: float) -> Document:
    """The certificate of an exclusion, or of a witness that says the opposite."""
    lemmas = [
        {
            "link": lemma.link,
            "point": _hexes(lemma.point),
            "least": _hexes(lemma.least),
            "most": _hexes(lemma.most),
            "tree": _packed(lemma.tree),
        }
        for lemma in found.lemmas
    ]
    return _signed(
        _common("refutation", claim, seconds, found.nodes)
        | _asked(claim)
        | {
            "tree": _packed(found.tree),
            "lemmas": lemmas,
            "witness": None if found.witness is None else _hexes(found.witness),
            "volumes": _volumes(found.undecided),
        }
    )


def bound(claim: BoundClaim, found: Bisection, extreme: NDArray[np.float64], *, seconds: float) -> Document:
    """The certificate of a ceiling or a floor, with the configuration that was found to come nearest to it."""
    kept = {"tree": _packed(found.tree), "found": _hexes(extreme), "volumes": _volumes(found.undecided)}
    return _signed(_common(claim.kind, claim, seconds, found.nodes) | _asked(claim) | kept)


def structural_zero(claim: StructuralZeroClaim, snapped: list[Document], points: list[str]) -> Document:
    """The certificate of a structural zero: frames and points on axes, as exact fractions."""
    kept = {"locked": claim.locked, "snapped": snapped, "points": points, "volumes": _volumes(Fraction(0))}
    return _signed(_common("structural-zero", claim, 0.0, len(points)) | kept)


def path(claim: PathClaim, parts: Sequence[LockedPath]) -> Document:
    """The certificate of slabs of lock instants, of all locks; it has the volumes of the worst."""
    locks = []
    for part in parts:
        numbers = [x for slab in part.slabs for x in (slab.begin, slab.stop, len(slab.ends), *slab.ends)]
        rows = np.array([row for slab in part.slabs for row in slab.centres], "<i4")
        kept = {"joint": part.joint, "followers": list(part.followers)}
        kept |= {key: paths.text(getattr(part, key)) for key in ("proved", "refuted")}
        kept["refutations"] = [
            {"begin": one.begin, "stop": one.stop, "at": one.at, "tree": _packed(one.tree)} for one in part.never
        ]
        locks.append(kept | {"cells": _packed(np.array(numbers, "<i8").tobytes()), "centres": _packed(rows.tobytes())})
    refuted = next((part.joint for part in parts if part.never), None)
    rings = None if refuted is None else rings_of(claim, refuted)  # the points of all locks are the same
    points = [] if rings is None else [{"link": link, "place": _hexes(place)} for link, place in rings.points]
    return _signed(
        _common("path", claim, sum(part.seconds for part in parts), sum(part.nodes for part in parts))
        | _asked(claim)
        | {
            "unit": cells.UNIT.hex(),
            "locks": locks,
            "points": points,
            "pairs": [] if rings is None else [list(pair) for pair in rings.pairs],
            "volumes": paths.volumes([(part.proved, part.refuted) for part in parts]),
        }
    )


def _volumes(undecided: Fraction) -> Document:
    parts = {"proved": 1 - undecided, "refuted": Fraction(0), "undecided": undecided}
    return {key: f"{part.numerator}/2^{part.denominator.bit_length() - 1}" for key, part in parts.items()}


def undecided(document: Document) -> list[Cell]:
    """The cells of a reach certificate that are not proved."""
    tokens, box = verifier.unpacked(document["tree"], 2 * verifier.MOST_LEAVES, "tree"), document["target"]["box"]
    return [cell for token, cell in verifier.cells(tokens, len(box) + (document["angle"] is not None)) if token != PROVED]


def _common(
    kind: str,
    claim: ReachClaim | TolerantClaim | OutOfReachClaim | BoundClaim | StructuralZeroClaim | PathClaim,
    seconds: float,
    nodes: int,
) -> Document:
    made = {
        "format": "holdfast-certificate",
        "version": 1,
        "kind": kind,
        "arm": _stored(claim.arm),
        "source": {"name": claim.arm.name},
        "task": claim.task,
        "made_by": f"holdfast {__version__}",
        "made_at": datetime.now(UTC).isoformat(timespec="seconds"),
        "seconds": seconds,
        "nodes": nodes,
    }
    if isinstance(claim, BoundClaim | StructuralZeroClaim | PathClaim):
        return made
    return made | {"target": {"axes": _axes(claim), "box": _hexes(claim.box), "orientation": _turned(claim)}}


def _asked(claim: ReachClaim | OutOfReachClaim | BoundClaim | PathClaim) -> Document:
    """What a claim is about, besides arm, task and target."""
    if isinstance(claim, BoundClaim):
        return {"joint_box": _hexes(claim.joint_box), "threshold": _hexes(claim.threshold), "locks": list(claim.locks)}
    if isinstance(claim, PathClaim):
        return {
            "knots": _hexes(claim.knots),
            "tube": _hexes(claim.tube),
            "limits": _hexes(np.column_stack([claim.arm.lower, claim.arm.upper])),
            "during": list(claim.during),
            "locks": [{"joint": joint} for joint in claim.locks],
        }
    angle = None if claim.angle is None else _hexes(claim.angle)
    return {"locked": claim.locked, "angle": angle, "limits": _hexes(claim.limits)}


def _turned(claim: ReachClaim | TolerantClaim | OutOfReachClaim) -> list[str] | None:
    return None if claim.rotation is None else [x for row in _hexes(claim.rotation) for x in row]


def _axes(claim: ReachClaim | TolerantClaim | OutOfReachClaim) -> str:
    """Letters of a target's numbers."""
    return {"planar": "xy", "planar-pose": "xya"}.get(claim.task, "xyzRPY"[: len(claim.box)])


def _signed(document: Document) -> Document:
    """With the sentence of the claim and the digests."""
    document["arm_digest"] = verifier.digest(document["arm"])
    document["claim"] = verifier.sentence(document)
    return document | {"digest": verifier.digest(document)}


def need_arm(document: Document, arm: Arm) -> None:
    """Refuse a certificate of another arm.

    Raises:
        InputError: With its name, and what differs.
    """
    theirs, ours = document["arm"], _stored(arm)
    if theirs == ours:
        return
    names = [[joint["name"] for joint in one["joints"]] for one in (theirs, ours)]
    what = f"its joints are {', '.join(names[0])}"
    if names[0] == names[1]:
        pairs = zip([*names[0], "the tool"], [*theirs["joints"], theirs["tool"]], [*ours["joints"], ours["tool"]], strict=True)
        what = f"{next(name for name, a, b in pairs if a != b)} differs"
    raise InputError(f"the certificate is about another arm, '{document['source']['name']}': {what}")


def _stored(arm: Arm) -> Document:
    chain, limits = Chain.of(arm), np.column_stack([arm.lower, arm.upper])
    frames = [
        {"rotation": _hexes(turn.ravel()), "origin": _hexes(place)}
        for turn, place in zip(chain.rotations, chain.origins, strict=True)
    ]
    joints = zip(arm.joints, frames, limits, strict=False)
    stored = [
        {"name": joint.name, "type": "prismatic" if joint.prismatic else "revolute", **frame, "limits": _hexes(pair)}
        for joint, frame, pair in joints
    ]
    return {"joints": stored, "tool": frames[-1]}


def _hexes(values: NDArray[np.float64] | float) -> Any:
    return [_hexes(x) for x in np.asarray(values)] if np.ndim(values) else float(values).hex()


def _packed(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, 9)).decode()
