"""Presentation of a proof of a kind without a dedicated presentation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from holdfast.certificates import verifier
from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.proof import BisectionResult
from holdfast.interface.presentation.certificates.verification import (
    build_entries,
    describe_verification,
    list_check_instructions,
)
from holdfast.interface.presentation.presentation import Fact, Presentation

_FRACTION_KEYS = ("proved", "refuted", "undecided")
_VALUE_LABELS = {"energy": ("kinetic energy of the nudge", "J"), "drop_at_most": ("largest drop of the tool point", "m")}


def to_dict(proof: BisectionResult) -> dict[str, Any]:
    """Return the claim, its fractions as exact rationals and as numbers, numbers of its kind, cell counts, and seconds."""
    entries = {key: getattr(proof, key) for key in ("energy", "lower", "upper", "drop_at_most") if hasattr(proof, key)}
    return build_entries(proof, [key for key in _FRACTION_KEYS if hasattr(proof, key)], **entries)


def present(proof: BisectionResult, check: CertificateCheck | None = None, file: str | Path = "FILE") -> Presentation:
    """Present the claim with the proved fraction, and the verification; ``file`` is that of the certificate."""
    answer = verifier.qualify_claim(proof.document["claim"], proof.proved)
    facts = [Fact(key, float(getattr(proof, key)), style="percent") for key in _FRACTION_KEYS if hasattr(proof, key)]
    facts += [Fact(label, getattr(proof, key), unit) for key, (label, unit) in _VALUE_LABELS.items() if hasattr(proof, key)]
    method = list_check_instructions(proof.document, check, file)
    return Presentation("Proof", answer, lines=[describe_verification(check, False)], facts=facts, method=method)
