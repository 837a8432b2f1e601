"""Presentation of the check of a certificate."""

from __future__ import annotations

from typing import Any

from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.verifier import format_percent, qualify_claim
from holdfast.interface.presentation.certificates.verification import build_fraction_entry
from holdfast.interface.presentation.presentation import Fact, Presentation, TableSpec


def to_dict(check: CertificateCheck) -> dict[str, Any]:
    """Return fractions as exact rationals and as numbers, cell counts, and seconds; for a bundle also its parts."""
    data = {
        "claim": check.claim,
        **{key: build_fraction_entry(getattr(check, key)) for key in ("refuted", "undecided", "tolerant")},
        **{key: getattr(check, key) for key in ("leaves", "accepted", "rejected", "seconds")},
    }
    return data | ({"parts": {_name_lock(part): to_dict(part) for part in check.parts}} if check.parts else {})


def present(check: CertificateCheck) -> Presentation:
    """Present the verified fraction of the claim, the summary of the verifier, and each part."""
    sampled = check.accepted + check.rejected < check.leaves
    proved = check.tolerant if check.parts else check.proved_fraction
    columns = ["lock of", "proved", "refuted", "undecided", "accepted", "rejected"]
    rows = [
        [
            _name_lock(part),
            format_percent(1 - part.refuted - part.undecided),
            format_percent(part.refuted),
            format_percent(part.undecided, up=True),
            part.accepted,
            part.rejected,
        ]
        for part in check.parts
    ]
    return Presentation(
        "Check of a certificate",
        qualify_claim(check.claim, proved, refuted=check.witnessed, sampled=sampled),
        lines=[check.summary],
        facts=[
            Fact("boxes accepted", check.accepted),
            Fact("boxes rejected", check.rejected),
            Fact("refuted", "by a witness" if check.witnessed else format_percent(check.refuted)),
            Fact("undecided", "the rest" if check.witnessed else format_percent(check.undecided, up=True)),
        ],
        tables=[TableSpec("", columns, rows)] if rows else [],
    )


def _name_lock(check: CertificateCheck) -> str:
    return check.locked or "healthy"
