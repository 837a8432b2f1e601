"""Certificates as JSON documents; :mod:`holdfast.certificates.verifier` defines the keys."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Sequence
from datetime import UTC, datetime
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from holdfast import __version__
from holdfast.certificates import verifier
from holdfast.certificates.claims import OutOfReachClaim, ReachClaim, TolerantClaim
from holdfast.certificates.joint_boxes.exclusion import Exclusion
from holdfast.certificates.joint_boxes.jobs import Bisection
from holdfast.certificates.joint_claims import BoundClaim, StructuralZeroClaim
from holdfast.certificates.kinds import Claim, find_claim_kind
from holdfast.certificates.target_boxes.jobs import TargetBoxResult
from holdfast.certificates.taylor import CENTER_UNIT, CertificateChain
from holdfast.certificates.tool_paths import cells
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.loop_closure import make_loop_closure_exclusion
from holdfast.certificates.tool_paths.march import LockedPath
from holdfast.certificates.tree import PROVED_TOKEN
from holdfast.certificates.verifier_parts import paths
from holdfast.certificates.verifier_parts.tree import Cell
from holdfast.core.errors import InputError
from holdfast.model.arm.model import Arm

Document = dict[str, Any]
TargetClaim: TypeAlias = ReachClaim | TolerantClaim | OutOfReachClaim


def build_reach_document(claim: ReachClaim, result: TargetBoxResult, undecided: Fraction) -> Document:
    """Build the certificate of a search that left the fraction ``undecided`` of the box open."""
    return _add_claim_and_digests(
        _common_fields(claim, result.seconds, result.nodes)
        | {
            "unit": CENTER_UNIT.hex(),
            "tree": compress_bytes(result.tree),
            "centres": compress_bytes(result.centers.astype("<i4").tobytes()),
            "refutations": [],
            "volumes": _format_volume_fractions(undecided),
        }
    )


def format_claim(claim: Claim) -> str:
    """Return the sentence of a claim, with all of its numbers and the digest of the arm."""
    fields = _common_fields(claim, 0.0, 0)
    return verifier.claim_sentence(fields | {"arm_digest": verifier.compute_digest(fields["arm"])})


def build_document(claim: Claim, fields: Document, *, undecided: Fraction, seconds: float, nodes: int) -> Document:
    """Build the certificate of a claim with the fields that prove it, with the fraction ``undecided`` of its box open."""
    return _add_claim_and_digests(
        _common_fields(claim, seconds, nodes) | fields | {"volumes": _format_volume_fractions(undecided)}
    )


def build_bundle_document(
    claim: TolerantClaim, parts: Sequence[Document], worst_index: int, file_names: Sequence[str]
) -> Document:
    """Build the certificate that lists its parts as files; its volumes are those of the worst part."""
    part_entries = [
        {"file": name, "digest": part["digest"], "locked": part["locked"]} for name, part in zip(file_names, parts, strict=True)
    ]
    effort_sums = {key: sum(part[key] for part in parts) for key in ("seconds", "nodes")}
    return _add_claim_and_digests(
        _common_fields(claim, **effort_sums)
        | {
            "parts": part_entries,
            "volumes": parts[worst_index]["volumes"],
        }
    )


def build_exclusion_document(claim: OutOfReachClaim, exclusion: Exclusion, *, seconds: float) -> Document:
    """Build the certificate of an exclusion, or of a witness that disproves the claim."""
    lemmas = [
        {
            "link": lemma.link,
            "point": encode_floats(lemma.point),
            "least": encode_floats(lemma.least),
            "most": encode_floats(lemma.most),
            "tree": compress_bytes(lemma.tree),
        }
        for lemma in exclusion.lemmas
    ]
    return _add_claim_and_digests(
        _common_fields(claim, seconds, exclusion.nodes)
        | {
            "tree": compress_bytes(exclusion.tree),
            "lemmas": lemmas,
            "witness": None if exclusion.witness is None else encode_floats(exclusion.witness),
            "volumes": _format_volume_fractions(exclusion.undecided),
        }
    )


def build_bound_document(claim: BoundClaim, bisection: Bisection, extreme: NDArray[np.float64], *, seconds: float) -> Document:
    """Build the certificate of an upper or lower bound, with the extreme configuration that the search found."""
    fields = {
        "tree": compress_bytes(bisection.tree),
        "found": encode_floats(extreme),
        "volumes": _format_volume_fractions(bisection.undecided),
    }
    return _add_claim_and_digests(_common_fields(claim, seconds, bisection.nodes) | fields)


def build_structural_zero_document(
    claim: StructuralZeroClaim, snapped_frames: list[Document], axis_heights: list[str]
) -> Document:
    """Build the certificate of a structural zero: frames and points on axes, as exact fractions."""
    fields = {"snapped": snapped_frames, "points": axis_heights, "volumes": _format_volume_fractions(Fraction(0))}
    return _add_claim_and_digests(_common_fields(claim, 0.0, len(axis_heights)) | fields)


def build_path_document(claim: PathClaim, parts: Sequence[LockedPath]) -> Document:
    """Build the certificate of slabs of lock instants for all locks; its volumes are those of the worst lock."""
    locks = []
    for part in parts:
        numbers = [number for slab in part.slabs for number in (slab.begin, slab.stop, len(slab.ends), *slab.ends)]
        centers = np.array([center for slab in part.slabs for center in slab.centers], "<i4")
        entry = {"joint": part.joint, "followers": list(part.followers)}
        entry |= {key: paths.format_fraction(getattr(part, key)) for key in ("proved", "refuted")}
        entry["refutations"] = [
            {
                "begin": interval.begin,
                "stop": interval.stop,
                "at": interval.path_instant,
                "tree": compress_bytes(interval.tree),
            }
            for interval in part.refuted_intervals
        ]
        locks.append(
            entry | {"cells": compress_bytes(np.array(numbers, "<i8").tobytes()), "centres": compress_bytes(centers.tobytes())}
        )
    refuted_joint = next((part.joint for part in parts if part.refuted_intervals), None)
    exclusion = (
        None if refuted_joint is None else make_loop_closure_exclusion(claim, refuted_joint)
    )  # the points of all locks are the same
    points = (
        [] if exclusion is None else [{"link": link, "place": encode_floats(position)} for link, position in exclusion.points]
    )
    return _add_claim_and_digests(
        _common_fields(claim, sum(part.seconds for part in parts), sum(part.nodes for part in parts))
        | {
            "unit": cells.PATH_CENTER_UNIT.hex(),
            "locks": locks,
            "points": points,
            "pairs": [] if exclusion is None else [list(pair) for pair in exclusion.pairs],
            "volumes": paths.format_worst_fractions([(part.proved, part.refuted) for part in parts]),
        }
    )


def _format_volume_fractions(undecided: Fraction) -> Document:
    fractions = {"proved": 1 - undecided, "refuted": Fraction(0), "undecided": undecided}
    return {key: f"{fraction.numerator}/2^{fraction.denominator.bit_length() - 1}" for key, fraction in fractions.items()}


def find_undecided_cells(document: Document) -> list[Cell]:
    """Return the cells of a reach certificate that are not proved."""
    tokens, box = verifier.decompress_payload(document["tree"], 2 * verifier.MAX_LEAVES, "tree"), document["target"]["box"]
    return [
        cell
        for token, cell in verifier.iterate_cells(tokens, len(box) + (document["angle"] is not None))
        if token != PROVED_TOKEN
    ]


def _common_fields(claim: Claim, seconds: float, nodes: int) -> Document:
    """Return the fields that define a claim and those that all certificates have, except digests and volumes."""
    return {
        "format": "holdfast-certificate",
        "version": 1,
        "kind": claim.kind,
        "arm": _encode_arm(claim.arm),
        "source": {"name": claim.arm.name},
        "task": claim.task,
        "made_by": f"holdfast {__version__}",
        "made_at": datetime.now(UTC).isoformat(timespec="seconds"),
        "seconds": seconds,
        "nodes": nodes,
    } | find_claim_kind(claim).fields(claim)


def encode_target(claim: TargetClaim) -> Document:
    """Return the field about the targets of a claim."""
    target = {"axes": _target_axis_letters(claim), "box": encode_floats(claim.box), "orientation": _encode_rotation(claim)}
    return {"target": target}


def encode_target_claim(claim: ReachClaim | OutOfReachClaim) -> Document:
    """Return the fields that define a claim about the targets of a box and a locked joint."""
    angle = None if claim.angle is None else encode_floats(claim.angle)
    return encode_target(claim) | {"locked": claim.locked, "angle": angle, "limits": encode_floats(claim.limits)}


def encode_limits(arm: Arm) -> list[list[str]]:
    """Return the limits of all joints as the file contains them."""
    limits: list[list[str]] = encode_floats(np.column_stack([arm.lower, arm.upper]))
    return limits


def _encode_rotation(claim: TargetClaim) -> list[str] | None:
    return None if claim.rotation is None else [number for row in encode_floats(claim.rotation) for number in row]


def _target_axis_letters(claim: TargetClaim) -> str:
    """Return the letters of a target's coordinates."""
    return {"planar": "xy", "planar-pose": "xya"}.get(claim.task, "xyzRPY"[: len(claim.box)])


def _add_claim_and_digests(document: Document) -> Document:
    """Return the document with the sentence of the claim and the digests."""
    document["arm_digest"] = verifier.compute_digest(document["arm"])
    document["claim"] = verifier.claim_sentence(document)
    return document | {"digest": verifier.compute_digest(document)}


def require_same_arm(document: Document, arm: Arm) -> None:
    """Raise an error if a certificate is about another arm.

    Raises:
        InputError: With its name, and what differs.
    """
    stored_arm, given_arm = document["arm"], _encode_arm(arm)
    if stored_arm == given_arm:
        return
    joint_names = [[joint["name"] for joint in arm_fields["joints"]] for arm_fields in (stored_arm, given_arm)]
    difference = f"its joints are {', '.join(joint_names[0])}"
    if joint_names[0] == joint_names[1]:
        pairs = zip(
            [*joint_names[0], "the tool"],
            [*stored_arm["joints"], stored_arm["tool"]],
            [*given_arm["joints"], given_arm["tool"]],
            strict=True,
        )
        difference = f"{next(name for name, stored_joint, given_joint in pairs if stored_joint != given_joint)} differs"
    raise InputError(f"the certificate is about another arm, '{document['source']['name']}': {difference}")


def _encode_arm(arm: Arm) -> Document:
    chain, limits = CertificateChain.from_arm(arm), np.column_stack([arm.lower, arm.upper])
    frames = [
        {"rotation": encode_floats(rotation.ravel()), "origin": encode_floats(origin)}
        for rotation, origin in zip(chain.rotations, chain.origins, strict=True)
    ]
    joints = zip(arm.joints, frames, limits, strict=False)
    joint_entries = [
        {
            "name": joint.name,
            "type": "prismatic" if joint.prismatic else "revolute",
            **frame,
            "limits": encode_floats(interval),
        }
        for joint, frame, interval in joints
    ]
    return {"joints": joint_entries, "tool": frames[-1]}


def encode_floats(values: NDArray[np.float64] | float) -> Any:
    """Return numbers as hexadecimal texts, nested as the array is."""
    return [encode_floats(value) for value in np.asarray(values)] if np.ndim(values) else float(values).hex()


def compress_bytes(data: bytes) -> str:
    """Return a payload as the file contains it."""
    return base64.b64encode(zlib.compress(data, 9)).decode()
