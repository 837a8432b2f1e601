"""Common parts of the presentations of proofs: verification, parts, scope, and instructions for the check."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from importlib.metadata import version
from pathlib import Path
from typing import Any

from markupsafe import Markup

from holdfast.certificates import WorkingRanges
from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.proof import BisectionResult, Proof, TolerantProof
from holdfast.certificates.tool_paths.proof import LockedPath, PathProof
from holdfast.certificates.verifier import format_percent, qualify_claim
from holdfast.interface import report
from holdfast.interface.presentation.certificates import working_ranges
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.report.palette import EMPTY_COLOR, INK

SCOPE_NOTE = "collisions, torques, speed. Assumptions: links are rigid, the geometry is that of the file, locks do not slip"
UNVERIFIED_NOTE = "The prover found this proof; it is not yet verified."
Found = Proof | TolerantProof | Refutation | ManipulabilityBound | PathProof


def build_entries(
    proof: Found | BisectionResult, keys: Sequence[str] = ("proved", "undecided"), **entries: Any
) -> dict[str, Any]:
    """Return fractions as exact rationals and as numbers, cell counts, entries of one kind of proof, and seconds."""
    return {
        "claim": _certificate(proof)["claim"],
        **{key: build_fraction_entry(getattr(proof, key)) for key in keys},
        **{key: getattr(proof, key) for key in ("leaves", "nodes", "finished")},
        "verified": False,
        **entries,
        "seconds": proof.seconds,
    }


def build_fraction_entry(fraction: Fraction) -> dict[str, Any]:
    """Return a fraction as a number and as an exact rational."""
    return {"value": float(fraction), "fraction": f"{fraction.numerator}/{fraction.denominator}"}


def _certificate(proof: Found | BisectionResult) -> dict[str, Any]:
    document: dict[str, Any] = proof.document() if isinstance(proof, TolerantProof) else proof.document
    return document


def find_proved_fraction(proof: Found, check: CertificateCheck | None) -> Fraction:
    """Return the proved fraction of the whole claim: that of the verifier if there is a check, else that of the prover."""
    if check is None:
        return proof.tolerant if isinstance(proof, TolerantProof | PathProof) else proof.proved
    return check.tolerant if isinstance(proof, TolerantProof | PathProof) else check.proved_fraction


def present_proof(
    proof: Found,
    *,
    title: str,
    answer: str,
    fraction_phrase: str,
    cell_phrase: str,
    facts: Sequence[Fact] = (),
    list_tables: Callable[[], Sequence[TableSpec]] = list,
    gaps: Sequence[str] = (),
    figures: Mapping[str, FigureSpec],
    method: Sequence[tuple[str, Any]],
    check: CertificateCheck | None = None,
    file: str | Path = "FILE",
    ranges: WorkingRanges | None = None,
) -> Presentation:
    """Present a proof: the proved and the undecided fraction of the claim, and whether it is verified.

    The phrases follow the proved fraction and the number of cells; ``gaps`` are the undecided intervals of each part. The
    numbers of ``check``, the result of the verifier, replace those of the prover. ``file`` is the file of the certificate, and
    ``ranges`` are working ranges found by sampling.
    """
    document, is_refuted = _certificate(proof), isinstance(proof, Refutation | ManipulabilityBound) and proof.refuted
    whole = find_proved_fraction(proof, check)
    lines = [qualify_claim(document["claim"], whole, refuted=is_refuted)] if check is None else check.describe()
    if not (proof.finished or is_refuted):
        lines.append("The search stopped before it reached the smallest cells.")
    is_composite = isinstance(proof, TolerantProof | PathProof)
    suffix = "" if check is not None and check.ok else ", not yet verified"
    if is_refuted:
        counts = [Fact("", "refuted", phrase="by one configuration")]
    else:
        proved, undecided = (proof.proved, proof.undecided) if check is None else (check.proved_fraction, check.undecided)
        counts = [
            Fact(f"proved{' for every lock' * is_composite}{suffix}", format_percent(whole), phrase=fraction_phrase),
            *[Fact("proved in the worst part", format_percent(proved))] * is_composite,
            Fact("undecided", format_percent(undecided, up=True)),
            Fact("cells proved", proof.leaves, phrase=cell_phrase),
            Fact("cells examined", proof.nodes),
            Fact("search time", proof.seconds, "s", digits=3),
        ]
    found_ranges = None if ranges is None else working_ranges.present(ranges)
    if found_ranges is not None:
        lines += [found_ranges.answer, *found_ranges.lines]
    return Presentation(
        title,
        f"{answer} {describe_verification(check, is_refuted)}",
        lines=lines,
        facts=[*counts, *facts],
        tables=lambda: [
            _tabulate_parts(proof, check, gaps), *list_tables(), *(found_ranges.list_tables() if found_ranges else ())
        ],
        figures=figures,
        method=[*method, *list_check_instructions(document, check, file)],
        arm=proof.claim.arm,
    )  # fmt: skip


def describe_verification(check: CertificateCheck | None, is_refuted: bool) -> str:
    """Describe the result of the verification."""
    if check is None:
        return UNVERIFIED_NOTE
    if check.ok and is_refuted:
        return "Verified by a program that is independent of the prover."
    if check.ok:
        return f"Verified: a program that is independent of the prover accepts all {check.accepted:,} boxes."
    if check.rejected:
        return f"The verifier rejects {check.rejected:,} of {check.leaves:,} boxes; what they contain is undecided."
    return f"Sampled, not verified: the verifier checked a sample and accepts {check.accepted:,} of {check.leaves:,} boxes."


def _tabulate_parts(proof: Found, check: CertificateCheck | None, gaps: Sequence[str]) -> TableSpec:
    """Tabulate fractions, cells, search time and verification of each part."""
    parts = proof.parts if isinstance(proof, TolerantProof | PathProof) else (proof,)
    checks = [None] * len(parts) if check is None else check.parts or (check,)
    columns: list[Column] = [
        *("lock of", "proved", "refuted", "undecided"),
        *["undecided between knots"] * bool(gaps),
        "cells",
        Header("search, s", digits=3),
        "verified by",
        Header("check, s", digits=3),
    ]
    rows = []
    for index, (part, checked) in enumerate(zip(parts, checks, strict=True)):
        shares = [format_percent(part.proved), "0 %", format_percent(part.undecided, up=True)]
        if isinstance(part, LockedPath):
            shares[1] = format_percent(part.refuted)
        elif not isinstance(part, Proof) and part.refuted:
            shares = ["0 %", "by a witness", "the rest"]
        outcome, seconds = "not yet", None
        if checked is not None:
            outcome = f"not: {checked.rejected:,} rejected" if checked.rejected else "sampled"
            outcome, seconds = "verifier.py" if checked.ok else outcome, checked.seconds or None
        rows.append([_name_part(proof, part), *shares, *gaps[index : index + 1], part.leaves, part.seconds, outcome, seconds])
    if not any(row[-1] for row in rows):  # a check of all locks at once has no time for each part
        columns, rows = columns[:-1], [row[:-1] for row in rows]
    return TableSpec("", columns, rows, on_console=len(parts) > 1)


def _name_part(proof: Found, part: Found | LockedPath) -> str:
    names = proof.claim.arm.joint_names
    if isinstance(part, LockedPath):
        return names[part.joint]
    if isinstance(part, ManipulabilityBound):
        locks = part.claim.locks
        return "any one joint" if len(locks) == len(names) else ", ".join(names[joint] for joint in locks)
    assert not isinstance(part, TolerantProof | PathProof)
    locked = getattr(part.claim, "locked", -1)  # claims without a lock have no such attribute
    return "healthy" if locked < 0 else names[locked]


def list_check_instructions(
    document: Mapping[str, Any], check: CertificateCheck | None, file: str | Path
) -> list[tuple[str, Any]]:
    """List the digest, the command that checks the certificate, and the versions of the verifier."""
    code = Markup("<code>{}</code>")
    entries: list[tuple[str, Any]] = [
        ("Command that checks it", code.format(f"holdfast certificate check {file}")),
        ("Digest of the certificate", code.format(document["digest"])),
    ]
    if check is not None:
        flint = f"python-flint {version('python-flint')}"
        entries.append(("Verified with", f"verifier.py in ball arithmetic, {flint}, {check.seconds:.1f} s"))
    return entries


def add_legend(figure: report.Figure, colors: Mapping[str, str]) -> None:
    """Add a legend below a figure, with the color of each label and the hatching for undecided parts."""
    patches = [report.Patch(facecolor=color, edgecolor=INK, linewidth=0.6, label=label) for label, color in colors.items()]
    patches.append(report.Patch(facecolor=EMPTY_COLOR, edgecolor=INK, hatch="////", linewidth=0.3, label="undecided"))
    figure.legend(handles=patches, loc="outside lower center", ncols=len(patches))
