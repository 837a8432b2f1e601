"""Text, tables, and JSON of certificates and of the verifier's results."""

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
from holdfast.certificates.verifier import format_percent
from holdfast.interface.presentation import results
from holdfast.interface.presentation.certificates import joint_boxes, slices
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

_FILE_NAMES = {
    "bundle": "certificates",
    "ceiling": "bound.certificate",
    "floor": "bound.certificate",
    "refutation": "out-of-reach.certificate",
    "structural-zero": "zero.certificate",
}
Found = Proof | TolerantProof | Refutation | ManipulabilityBound | CertificateCheck


def to_dict(result: Found | StructuralZero) -> dict[str, Any]:
    """Return fractions as exact rationals and as numbers, cell counts, and seconds; for a failure-tolerant box also
    its parts.
    """
    if isinstance(result, StructuralZero):
        data = {"claim": result.describe()[0], "proved": result.ok, "verified": False}
        return data | {"turned": result.turned, "shifted": result.shifted}
    shares, counts, witness = _decided_fractions(result), {"leaves": result.leaves}, dict[str, Any]()
    parts: Mapping[str, Found]
    if isinstance(result, CertificateCheck):
        claim, parts = result.claim, dict(zip(map(_lock_name, result.parts), result.parts, strict=True))
        counts |= {"accepted": result.accepted, "rejected": result.rejected}
    elif isinstance(result, TolerantProof):
        claim, parts = result.document()["claim"], {result.part_label(part_result): part_result for part_result in result.parts}
    else:
        claim, parts = result.document["claim"], {}
    if not isinstance(result, CertificateCheck):
        counts |= {"nodes": result.nodes, "finished": result.finished, "verified": False}
    if isinstance(result, Refutation):
        witness = {"witness": None if result.witness is None else result.witness.tolist()}
    if isinstance(result, ManipulabilityBound):
        witness = {"extreme": result.extreme.tolist(), "value": result.value}
    fractions = {
        key: {"value": float(part_result), "fraction": _format_fraction(part_result)} for key, part_result in shares.items()
    }
    data = {"claim": claim, **fractions, **counts, **witness, "seconds": result.seconds}
    return data | ({"parts": {name: to_dict(part_result) for name, part_result in parts.items()}} if parts else {})


def format_state(search_state: SearchState) -> str:
    """Format the progress of a search as one line: fractions are never rounded up to the whole or down to nothing."""
    shares = [f"{key} {format_percent(Fraction(min(getattr(search_state, key), 1.0)))}" for key in ("proved", "refuted")]
    open_fractions = [
        f"{name} {format_percent(Fraction(max(fraction, 0.0)), up=True)}"
        for name, fraction in (("undecided", search_state.undecided), ("open", search_state.open))
    ]
    return f"{', '.join([*shares, *open_fractions])}; {search_state.nodes:,} boxes"


def _decided_fractions(result: Found) -> dict[str, Fraction]:
    if isinstance(result, CertificateCheck):
        return {"refuted": result.refuted, "undecided": result.undecided, "tolerant": result.tolerant}
    fractions = {"proved": result.proved, "undecided": result.undecided}
    return fractions | {"tolerant": result.tolerant} if isinstance(result, TolerantProof) else fractions


def _lock_name(check: CertificateCheck) -> str:
    return check.locked or "healthy"


def story(result: Found | StructuralZero) -> PageContent:
    """Compose the report of the proof or check."""
    if isinstance(result, Proof | TolerantProof):
        return slices.story(result)
    return joint_boxes.story(result) if isinstance(result, Refutation | ManipulabilityBound) else results.story(result)


def next_steps(result: Found | StructuralZero, name: str) -> list[str]:
    """Suggest the check of the written certificate by independent code."""
    if isinstance(result, CertificateCheck):
        return [f"{name}.ok  # every cell was checked and accepted"]
    kind = result.claim.kind
    return [f'hf.check_certificate({name}.write("{_FILE_NAMES.get(kind, f"{kind}.certificate")}"))  # by other code']


def tables(result: Found | StructuralZero) -> list[TextTable]:
    """Tabulate fractions and cells; for a failure-tolerant box also those of each lock."""
    return [key_table(result)] if isinstance(result, StructuralZero) else [*_tabulate_locks(result), key_table(result)]


def key_table(result: Found | StructuralZero) -> TextTable:
    """Tabulate fractions and cells; for a structural zero the shift of the geometry."""
    if isinstance(result, StructuralZero):
        return TextTable(
            ["", ""], [["frames turned, rad", f"{result.turned:.2g}"], ["frames shifted, m", f"{result.shifted:.2g}"]]
        )
    if isinstance(result, CertificateCheck):
        rows = [
            ["accepted", f"{result.accepted:,}"],
            ["rejected", f"{result.rejected:,}"],
            ["refuted", "by a witness" if result.witnessed else format_percent(result.refuted)],
            ["undecided", "the rest" if result.witnessed else format_percent(result.undecided, up=True)],
        ]
        return TextTable(["", ""], rows)
    rows = [
        ["proved, not yet verified", format_percent(result.proved)],
        ["undecided", format_percent(result.undecided, up=True)],
    ]
    if isinstance(result, TolerantProof):
        rows.append(["targets proved whatever locks, at least", format_percent(result.tolerant)])
    return TextTable(["", ""], [*rows, ["cells proved", f"{result.leaves:,}"], ["cells looked at", f"{result.nodes:,}"]])


def _tabulate_locks(result: Found) -> list[TextTable]:
    """Tabulate the fractions and cells of each locked joint."""
    if isinstance(result, CertificateCheck):
        rows = [
            [
                _lock_name(part),
                format_percent(1 - part.refuted - part.undecided),
                format_percent(part.refuted),
                format_percent(part.undecided, up=True),
                *counts,
            ]
            for part in result.parts
            for counts in [[f"{part.accepted:,}", f"{part.rejected:,}"]]
        ]
        return [TextTable(["lock of", "proved", "refuted", "undecided", "accepted", "rejected"], rows)] if rows else []
    if isinstance(result, TolerantProof):
        header = ["lock of", "proved, not yet verified", "undecided", "cells", "s"]
        cells = [[f"{part.leaves:,}", f"{part.seconds:.1f}"] for part in result.parts]
        shares = [
            [result.part_label(part), format_percent(part.proved), format_percent(part.undecided, up=True)]
            for part in result.parts
        ]
        return [TextTable(header, [[*share, *count] for share, count in zip(shares, cells, strict=True)])]
    return []


def _format_fraction(fraction: Fraction) -> str:
    return f"{fraction.numerator}/{fraction.denominator}"
