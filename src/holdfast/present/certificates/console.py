"""Certificates and what the verifier says of them, in numbers and words."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from holdfast.certificates.proof import CertificateCheck, Proof
from holdfast.certificates.verifier import per_cent
from holdfast.present.printing import Rows


def to_dict(found: Proof | CertificateCheck) -> dict[str, Any]:
    """Shares as exact fractions and as numbers, cells, seconds."""
    if isinstance(found, Proof):
        counts = {"leaves": found.leaves, "nodes": found.nodes, "finished": found.finished, "verified": False}
        claim, parts = found.document["claim"], {"proved": found.proved, "undecided": found.undecided}
    else:
        counts = {"leaves": found.leaves, "accepted": found.accepted, "rejected": found.rejected}
        claim, parts = found.claim, {"undecided": found.undecided, "tolerant": found.tolerant}
    written = {key: {"value": float(part), "fraction": _text(part)} for key, part in parts.items()}
    return {"claim": claim, **written, **counts, "seconds": found.seconds}


def next_steps(found: Proof | CertificateCheck, name: str) -> list[str]:
    """What one does with it."""
    if isinstance(found, Proof):
        return [f'hf.check_certificate({name}.write("reach.certificate"))  # by other code']
    return [f"{name}.ok  # every cell was checked and accepted"]


def tables(found: Proof | CertificateCheck) -> list[Rows]:
    """Shares and cells."""
    return [key_table(found)]


def key_table(found: Proof | CertificateCheck) -> Rows:
    """Shares and cells."""
    if isinstance(found, Proof):
        rows = [["proved, not yet verified", per_cent(found.proved)], ["undecided", per_cent(found.undecided, up=True)]]
        return Rows(["", ""], [*rows, ["cells proved", f"{found.leaves:,}"], ["cells looked at", f"{found.nodes:,}"]])
    rows = [
        ["accepted", f"{found.accepted:,}"],
        ["rejected", f"{found.rejected:,}"],
        ["undecided", per_cent(found.undecided, up=True)],
    ]
    return Rows(["", ""], rows)


def _text(part: Fraction) -> str:
    return f"{part.numerator}/{part.denominator}"
