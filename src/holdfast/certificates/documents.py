"""Certificates as JSON documents; :mod:`holdfast.certificates.verifier` defines the keys."""

from __future__ import annotations

import base64
import zlib
from datetime import UTC, datetime
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast import __version__
from holdfast.certificates import verifier
from holdfast.certificates.claims import LockedTargetClaim, TargetClaim
from holdfast.certificates.kinds import Claim, find_claim_kind
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.tree import PROVED_TOKEN
from holdfast.certificates.verifier_parts.tree import Cell
from holdfast.core.errors import InputError
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_to_axis
from holdfast.model.arm.statics import links_with_payload

Document = dict[str, Any]


def format_claim(claim: Claim) -> str:
    """Return the sentence of a claim, with all of its numbers and the digest of the arm."""
    fields = _common_fields(claim, 0.0, 0)
    return verifier.claim_sentence(fields | {"arm_digest": verifier.compute_digest(fields["arm"])})


def build_document(
    claim: Claim, fields: Document, *, undecided: Fraction | None = None, refuted: Fraction = Fraction(0), **effort: Any
) -> Document:
    """Build the certificate of a claim with the fields that prove it, and with undecided and refuted fractions of its box.

    If ``undecided`` is None, the fields contain the volumes. ``effort`` contains the seconds and the number of nodes.
    """
    document = _common_fields(claim, **effort) | fields
    if undecided is not None:
        fractions = {"proved": 1 - undecided - refuted, "refuted": refuted, "undecided": undecided}
        powers = {key: (part.numerator, part.denominator.bit_length() - 1) for key, part in fractions.items()}
        document["volumes"] = {key: f"{numerator}/2^{power}" for key, (numerator, power) in powers.items()}
    document["arm_digest"] = verifier.compute_digest(document["arm"])
    document["claim"] = verifier.claim_sentence(document)
    return document | {"digest": verifier.compute_digest(document)}


def find_undecided_cells(document: Document) -> list[Cell]:
    """Return the cells of a reach certificate that are not proved."""
    tokens, box = verifier.decompress_payload(document["tree"], 2 * verifier.MAX_LEAVES, "tree"), document["target"]["box"]
    cells = verifier.iterate_cells(tokens, len(box) + (document["angle"] is not None))
    return [cell for token, cell in cells if token != PROVED_TOKEN]


def _common_fields(claim: Claim, seconds: float, nodes: int) -> Document:
    """Return the fields that define a claim and those that all certificates have, except digests and volumes."""
    common = {"format": "holdfast-certificate", "version": 1, "made_by": f"holdfast {__version__}"}
    common |= {"made_at": datetime.now(UTC).isoformat(timespec="seconds"), "seconds": seconds, "nodes": nodes}
    fields = {"kind": claim.kind, "arm": _encode_arm(claim.arm), "source": {"name": claim.arm.name}, "task": claim.task}
    return common | fields | find_claim_kind(claim).fields(claim)


def encode_target(claim: TargetClaim) -> Document:
    """Return the field about the targets of a claim."""
    axes = {"planar": "xy", "planar-pose": "xya"}.get(claim.task, "xyzRPY"[: len(claim.box)])
    rotation = None if claim.rotation is None else encode_floats(claim.rotation.ravel())
    return {"target": {"axes": axes, "box": encode_floats(claim.box), "orientation": rotation}}


def encode_target_claim(claim: LockedTargetClaim) -> Document:
    """Return the fields that define a claim about the targets of a box and a locked joint."""
    angle = None if claim.angle is None else encode_floats(claim.angle)
    return encode_target(claim) | {"locked": claim.locked, "angle": angle, "limits": encode_floats(claim.limits)}


def encode_limits(arm: Arm) -> list[list[str]]:
    """Return the limits of all joints as the file contains them."""
    limits: list[list[str]] = encode_floats(np.column_stack([arm.lower, arm.upper]))
    return limits


def encode_statics(arm: Arm) -> Document:
    """Return the fields with gravity and with the mass and its center of each link, the last one with the payload."""
    bodies = [
        {"mass": encode_floats(link.mass), "center": encode_floats(rotation_to_axis(joint.axis).T @ link.com)}
        for joint, link in zip(arm.joints, links_with_payload(arm), strict=True)
    ]
    return {"gravity": encode_floats(arm.gravity), "bodies": bodies}


def require_same_arm(document: Document, arm: Arm) -> None:
    """Raise an error if a certificate is about another arm.

    Raises:
        InputError: The certificate is about another arm; the message states its name and the difference.
    """
    stored_arm, given_arm = document["arm"], _encode_arm(arm)
    if stored_arm == given_arm:
        if "bodies" in document and document != document | encode_statics(arm):
            raise InputError(f"the certificate is about '{document['source']['name']}' with other masses, or other gravity")
        return
    stored, given = (
        [*((joint["name"], joint) for joint in fields["joints"]), ("the tool", fields["tool"])]
        for fields in (stored_arm, given_arm)
    )
    difference = f"its joints are {', '.join(name for name, _ in stored[:-1])}"
    if [name for name, _ in stored] == [name for name, _ in given]:
        difference = f"{next(one[0] for one, other in zip(stored, given, strict=True) if one != other)} differs"
    raise InputError(f"the certificate is about another arm, '{document['source']['name']}': {difference}")


def _encode_arm(arm: Arm) -> Document:
    chain, limits = CertificateChain.from_arm(arm), np.column_stack([arm.lower, arm.upper])
    frames = [
        {"rotation": encode_floats(rotation.ravel()), "origin": encode_floats(origin)}
        for rotation, origin in zip(chain.rotations, chain.origins, strict=True)
    ]
    joints = [
        {"name": joint.name, "type": "prismatic" if joint.prismatic else "revolute", **frame, "limits": encode_floats(interval)}
        for joint, frame, interval in zip(arm.joints, frames, limits, strict=False)
    ]
    return {"joints": joints, "tool": frames[-1]}


def encode_floats(values: NDArray[np.float64] | float) -> Any:
    """Return numbers as hexadecimal texts, nested in the shape of the array."""
    return [encode_floats(value) for value in np.asarray(values)] if np.ndim(values) else float(values).hex()


def compress_bytes(data: bytes) -> str:
    """Return a payload in the compressed form of the file."""
    return base64.b64encode(zlib.compress(data, 9)).decode()
