"""Kinds of certificates, with the form of the file, the sentence of the claim, and the verifier of the leaves for each kind."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .bounds import CeilingVerifier, FloorVerifier, bound_claim_schema, describe_bound
from .distances import RefutationVerifier, refutation_schema
from .holding import HoldVerifier, describe_hold, hold_claim_schema
from .paths import describe_path, path_claim_schema
from .targets import ReachVerifier, bundle_claim_schema, describe_targets, reach_claim_schema
from .zeros import StructuralZeroVerifier, describe_structural_zero, structural_zero_schema


@dataclass(frozen=True)
class CertificateKind:
    """Kind of certificate.

    ``form`` returns the form of the additional keys for a document, whose common keys are checked, and its number of joints.
    ``sentence`` returns the claim of a document with given joint names. ``verifier`` is the :class:`LeafVerifier` for the
    leaves of the tree, or None for a path and a bundle.
    """

    form: Callable[[dict[str, Any], int], dict[str, Any]]
    sentence: Callable[[dict[str, Any], list[str]], str]
    verifier: Any = None


CERTIFICATE_KINDS = {
    "reach": CertificateKind(reach_claim_schema, describe_targets, ReachVerifier),
    "bundle": CertificateKind(bundle_claim_schema, describe_targets),
    "refutation": CertificateKind(refutation_schema, describe_targets, RefutationVerifier),
    "ceiling": CertificateKind(bound_claim_schema, describe_bound, CeilingVerifier),
    "floor": CertificateKind(bound_claim_schema, describe_bound, FloorVerifier),
    "structural-zero": CertificateKind(structural_zero_schema, describe_structural_zero, StructuralZeroVerifier),
    "hold": CertificateKind(hold_claim_schema, describe_hold, HoldVerifier),
    "nudge": CertificateKind(hold_claim_schema, describe_hold, HoldVerifier),
    "path": CertificateKind(path_claim_schema, describe_path),
}


def claim_sentence(document: dict[str, Any]) -> str:
    """Return the claim of a certificate as a sentence that is made from its other keys.

    Decimals are the shortest that represent the same doubles.
    """
    names = [joint["name"] for joint in document["arm"]["joints"]]
    return f"{CERTIFICATE_KINDS[document['kind']].sentence(document, names)} arm {document['arm_digest'][:12]}."
