"""Certificates and what the verifier says of them, in numbers and words."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.structure import StructuralZero
from holdfast.certificates.tree import SearchState
from holdfast.certificates.verifier import per_cent
from holdfast.present import results
from holdfast.present.certificates import joint_boxes, slices
from holdfast.present.printing import Rows
from holdfast.present.story import Story

Found = Proof | TolerantProof | Refutation | ManipulabilityBound | CertificateCheck


def to_dict(found: Found | StructuralZero) -> dict[str, Any]:
    """Shares as exact fractions and as numbers, cells, seconds; of a failure-tolerant box its parts as well."""
    if isinstance(found, StructuralZero):
        said = {"claim": found.describe()[0], "proved": found.ok, "verified": False}
        return said | {"turned": found.turned, "shifted": found.shifted}
    shares, counts, witness = _shares(found), {"leaves": found.leaves}, dict[str, Any]()
    parts: Mapping[str, Found]
    if isinstance(found, CertificateCheck):
        claim, parts = found.claim, dict(zip(map(_lock, found.parts), found.parts, strict=True))
        counts |= {"accepted": found.accepted, "rejected": found.rejected}
    elif isinstance(found, TolerantProof):
        claim, parts = found.document()["claim"], {found.named(part): part for part in found.parts}
    else:
        claim, parts = found.document["claim"], {}
    if not isinstance(found, CertificateCheck):
        counts |= {"nodes": found.nodes, "finished": found.finished, "verified": False}
    if isinstance(found, Refutation):
        witness = {"witness": None if found.witness is None else found.witness.tolist()}
    if isinstance(found, ManipulabilityBound):
        witness = {"extreme": found.extreme.tolist(), "value": found.value}
    written = {key: {"value": float(part), "fraction": _text(part)} for key, part in shares.items()}
    said = {"claim": claim, **written, **counts, **witness, "seconds": found.seconds}
    return said | ({"parts": {name: to_dict(part) for name, part in parts.items()}} if parts else {})


def state(now: SearchState) -> str:
    """One line of how far a search has come: shares are never rounded up to the whole or down to nothing."""
    shares = [f"{key} {per_cent(Fraction(min(getattr(now, key), 1.0)))}" for key in ("proved", "refuted")]
    rest = [
        f"{name} {per_cent(Fraction(max(part, 0.0)), up=True)}"
        for name, part in (("undecided", now.undecided), ("open", now.open))
    ]
    return f"{', '.join([*shares, *rest])}; {now.nodes:,} boxes"


def _shares(found: Found) -> dict[str, Fraction]:
    if isinstance(found, CertificateCheck):
        return {"refuted": found.refuted, "undecided": found.undecided, "tolerant": found.tolerant}
    said = {"proved": found.proved, "undecided": found.undecided}
    return said | {"tolerant": found.tolerant} if isinstance(found, TolerantProof) else said


def _lock(check: CertificateCheck) -> str:
    return check.locked or "healthy"


def story(found: Found | StructuralZero) -> Story:
    """What its page says."""
    if isinstance(found, Proof | TolerantProof):
        return slices.story(found)
    return joint_boxes.story(found) if isinstance(found, Refutation | ManipulabilityBound) else results.story(found)


def next_steps(found: Found | StructuralZero, name: str) -> list[str]:
    """What one does with it."""
    if isinstance(found, Proof):
        return [f'hf.check_certificate({name}.write("reach.certificate"))  # by other code']
    if isinstance(found, StructuralZero):
        return [f'hf.check_certificate({name}.write("zero.certificate"))  # by other code']
    if isinstance(found, ManipulabilityBound):
        return [f'hf.check_certificate({name}.write("bound.certificate"))  # by other code']
    if isinstance(found, Refutation):
        return [f'hf.check_certificate({name}.write("out-of-reach.certificate"))  # by other code']
    if isinstance(found, TolerantProof):
        return [f'hf.check_certificate({name}.write("certificates"))  # by other code']
    return [f"{name}.ok  # every cell was checked and accepted"]


def tables(found: Found | StructuralZero) -> list[Rows]:
    """Shares and cells; of a failure-tolerant box those of each lock."""
    return [key_table(found)] if isinstance(found, StructuralZero) else [*_by_lock(found), key_table(found)]


def key_table(found: Found | StructuralZero) -> Rows:
    """Shares and cells; of a structural zero how far the geometry was moved."""
    if isinstance(found, StructuralZero):
        return Rows(["", ""], [["frames turned, rad", f"{found.turned:.2g}"], ["frames shifted, m", f"{found.shifted:.2g}"]])
    if isinstance(found, CertificateCheck):
        rows = [
            ["accepted", f"{found.accepted:,}"],
            ["rejected", f"{found.rejected:,}"],
            ["refuted", "by a witness" if found.witnessed else per_cent(found.refuted)],
            ["undecided", "the rest" if found.witnessed else per_cent(found.undecided, up=True)],
        ]
        return Rows(["", ""], rows)
    rows = [["proved, not yet verified", per_cent(found.proved)], ["undecided", per_cent(found.undecided, up=True)]]
    if isinstance(found, TolerantProof):
        rows.append(["targets proved whatever locks, at least", per_cent(found.tolerant)])
    return Rows(["", ""], [*rows, ["cells proved", f"{found.leaves:,}"], ["cells looked at", f"{found.nodes:,}"]])


def _by_lock(found: Found) -> list[Rows]:
    """Of each part."""
    if isinstance(found, CertificateCheck):
        rows = [
            [_lock(p), per_cent(1 - p.refuted - p.undecided), per_cent(p.refuted), per_cent(p.undecided, up=True), *counts]
            for p in found.parts
            for counts in [[f"{p.accepted:,}", f"{p.rejected:,}"]]
        ]
        return [Rows(["lock of", "proved", "refuted", "undecided", "accepted", "rejected"], rows)] if rows else []
    if isinstance(found, TolerantProof):
        head = ["lock of", "proved, not yet verified", "undecided", "cells", "s"]
        cells = [[f"{p.leaves:,}", f"{p.seconds:.1f}"] for p in found.parts]
        shares = [[found.named(p), per_cent(p.proved), per_cent(p.undecided, up=True)] for p in found.parts]
        return [Rows(head, [[*share, *count] for share, count in zip(shares, cells, strict=True)])]
    return []


def _text(part: Fraction) -> str:
    return f"{part.numerator}/{part.denominator}"
