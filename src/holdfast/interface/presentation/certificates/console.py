"""Text, tables, and JSON of certificates and of the verifier's results."""

from __future__ import annotations

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
from holdfast.interface.presentation.certificates.pages import fraction_entry
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
    is_check, parts = isinstance(result, CertificateCheck), list[tuple[str, Found]]()
    keys = ["refuted", "undecided", "tolerant"] if is_check else ["proved", "undecided"]
    counts, extra = ["leaves", "nodes", "finished"], dict[str, Any]()
    if isinstance(result, CertificateCheck):
        claim, parts = result.claim, [(_lock_name(part), part) for part in result.parts]
        counts = ["leaves", "accepted", "rejected"]
    elif isinstance(result, TolerantProof):
        claim, parts, keys = (
            result.document()["claim"],
            [(result.part_label(part), part) for part in result.parts],
            [*keys, "tolerant"],
        )
    else:
        claim = result.document["claim"]
    if isinstance(result, Refutation):
        extra = {"witness": None if result.witness is None else result.witness.tolist()}
    if isinstance(result, ManipulabilityBound):
        extra = {"extreme": result.extreme.tolist(), "value": result.value}
    data = {"claim": claim} | {key: fraction_entry(getattr(result, key)) for key in keys}
    data |= {key: getattr(result, key) for key in counts} | ({} if is_check else {"verified": False})
    data |= extra | {"seconds": result.seconds}
    return data | ({"parts": {name: to_dict(part) for name, part in parts}} if parts else {})


def format_state(search_state: SearchState) -> str:
    """Format the progress of a search as one line: fractions are never rounded up to the whole or down to nothing."""
    shares = [f"{key} {format_percent(Fraction(min(getattr(search_state, key), 1.0)))}" for key in ("proved", "refuted")]
    open_fractions = [
        f"{name} {format_percent(Fraction(max(fraction, 0.0)), up=True)}"
        for name, fraction in (("undecided", search_state.undecided), ("open", search_state.open))
    ]
    return f"{', '.join([*shares, *open_fractions])}; {search_state.nodes:,} boxes"


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
        rows = [["frames turned, rad", f"{result.turned:.2g}"], ["frames shifted, m", f"{result.shifted:.2g}"]]
        return TextTable(["", ""], rows)
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
        header = ["lock of", "proved", "refuted", "undecided", "accepted", "rejected"]
        rows = []
        for part in result.parts:
            shares = [format_percent(1 - part.refuted - part.undecided), format_percent(part.refuted)]
            undecided, counts = format_percent(part.undecided, up=True), [f"{part.accepted:,}", f"{part.rejected:,}"]
            rows.append([_lock_name(part), *shares, undecided, *counts])
        return [TextTable(header, rows)] if rows else []
    if isinstance(result, TolerantProof):
        header = ["lock of", "proved, not yet verified", "undecided", "cells", "s"]
        rows = []
        for proof in result.parts:
            shares = [format_percent(proof.proved), format_percent(proof.undecided, up=True)]
            rows.append([result.part_label(proof), *shares, f"{proof.leaves:,}", f"{proof.seconds:.1f}"])
        return [TextTable(header, rows)]
    return []
