"""Presentation of a proof of a kind without a dedicated presentation."""

from __future__ import annotations

from typing import Any

from holdfast.certificates import verifier
from holdfast.certificates.proof import BisectionResult
from holdfast.interface.presentation.certificates.verification import UNVERIFIED_NOTE, build_entries
from holdfast.interface.presentation.presentation import Fact, Presentation


def to_dict(proof: BisectionResult) -> dict[str, Any]:
    """Return the claim, its fractions as exact rationals and as numbers, cell counts, and seconds."""
    return build_entries(proof)


def present(proof: BisectionResult) -> Presentation:
    """Present the claim with the proved fraction."""
    answer = verifier.qualify_claim(proof.document["claim"], proof.proved)
    facts = [Fact(name, float(getattr(proof, name)), style="percent") for name in ("proved", "undecided")]
    return Presentation("Proof", answer, lines=[UNVERIFIED_NOTE], facts=facts)
