"""Common parts of the reports of proofs: verification, scope, and instructions for the check."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.tool_paths.proof import LockedPath, PathProof
from holdfast.certificates.verifier import format_percent
from holdfast.interface.presentation import call_presenter, results
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable

if TYPE_CHECKING:
    from fractions import Fraction

    from matplotlib.figure import Figure

    from holdfast.certificates import WorkingRanges

SCOPE_NOTE = "collisions, torques, speed; links are rigid, the geometry is the file's, locks do not slip"
UNVERIFIED_NOTE = "Found by the prover, not yet verified."
Found = Proof | TolerantProof | Refutation | ManipulabilityBound | PathProof


def write(
    proof: Found,
    path: Path,
    command: str = "",
    drawn: Mapping[str, Figure] | None = None,
    check: CertificateCheck | None = None,
    file: str | Path = "FILE",
    ranges: WorkingRanges | None = None,
) -> Path:
    """Write the report of a proof.

    ``check``: What the verifier says of it, if it was asked; ``file``: where the certificate is; ``ranges``: the working
    ranges, if they were found by samples.
    """
    content: PageContent = call_presenter(proof, "story")
    report = replace(
        content,
        answer=content.answer.replace(UNVERIFIED_NOTE, _describe_verification(proof, check)),
        lines=[*(content.lines if check is None else check.describe()[:1]), *(ranges.describe() if ranges else [])],
        tables=[tabulate_parts(proof, check), *(content.tables or []), *(call_presenter(ranges, "tables") if ranges else [])],
        method=[*content.method, *_list_check_instructions(proof, check, file)],
    )
    return results.write(proof, path, command, drawn, report)


def add_legend(figure: Figure, colors: Mapping[str, str]) -> None:
    """Add a legend below a figure, with the color of each label and the hatching of what is undecided."""
    from matplotlib.patches import Patch

    from holdfast.interface.report.figures import EMPTY_COLOR, INK

    patches = [Patch(facecolor=color, edgecolor=INK, linewidth=0.6, label=label) for label, color in colors.items()]
    patches.append(Patch(facecolor=EMPTY_COLOR, edgecolor=INK, hatch="////", linewidth=0.3, label="undecided"))
    figure.legend(handles=patches, loc="outside lower center", ncols=len(patches))


def fraction_entry(fraction: Fraction) -> dict[str, Any]:
    """Return a fraction as a number and as an exact rational."""
    return {"value": float(fraction), "fraction": f"{fraction.numerator}/{fraction.denominator}"}


def bind_percent_sign(text: str) -> str:
    """Replace the space before a percent sign by one at which no line breaks."""
    return text.replace(" %", "\N{NO-BREAK SPACE}%")


def _describe_verification(proof: Found, check: CertificateCheck | None) -> str:
    """Describe who verified the proof, and with which result."""
    if check is None:
        return UNVERIFIED_NOTE
    if check.ok and isinstance(proof, Refutation | ManipulabilityBound) and proof.refuted:
        return "Verified by code that shares nothing with the prover."
    if check.ok:
        return f"Verified: all {check.accepted:,} boxes are accepted by code that shares nothing with the prover."
    if check.rejected:
        return f"The verifier rejects {check.rejected:,} of {check.leaves:,} boxes: what they cover is undecided."
    return f"Sampled, not verified: {check.accepted:,} of {check.leaves:,} boxes are accepted."


def tabulate_parts(proof: Found, check: CertificateCheck | None = None) -> TextTable:
    """Tabulate fractions, boxes, and seconds of each part, and its verifier."""
    parts = proof.parts if isinstance(proof, TolerantProof | PathProof) else (proof,)
    checks = [None] * len(parts) if check is None else check.parts or (check,)
    rows = []
    for part, checked in zip(parts, checks, strict=True):
        shares = [format_percent(part.proved), "0 %", format_percent(part.undecided, up=True)]
        if isinstance(part, LockedPath):
            shares[1] = format_percent(part.refuted)
        elif not isinstance(part, Proof) and part.refuted:
            shares = ["0 %", "by a witness", "the rest"]
        verifier_cells = ["nobody yet", ""]
        if checked is not None:
            outcome = f"not: {checked.rejected:,} rejected" if checked.rejected else "sampled"
            seconds = f"{checked.seconds:.1f}" if checked.seconds else ""
            verifier_cells = ["verifier.py" if checked.ok else outcome, seconds]
        rows.append([_part_name(proof, part), *shares, f"{part.leaves:,}", f"{part.seconds:.1f}", *verifier_cells])
    names = ["lock of", "proved", "refuted", "undecided", "boxes", "search, s", "verified by", "check, s"]
    has_check_times = any(row[-1] for row in rows)  # one check of all locks at once has a time of its own
    return TextTable(names if has_check_times else names[:-1], rows if has_check_times else [row[:-1] for row in rows])


def _part_name(proof: Found, part: Found | LockedPath) -> str:
    if isinstance(part, LockedPath):
        return proof.claim.arm.joint_names[part.joint]
    if isinstance(part, ManipulabilityBound):
        names = [part.claim.arm.joint_names[joint] for joint in part.claim.locks]
        return "any one joint" if len(names) == part.claim.arm.n else ", ".join(names)
    assert not isinstance(part, TolerantProof | PathProof)
    locked = getattr(part.claim, "locked", -1)  # a claim about no lock has no such attribute
    return "healthy" if locked < 0 else part.claim.arm.joint_names[locked]


def _list_check_instructions(proof: Found, check: CertificateCheck | None, file: str | Path) -> list[tuple[str, Any]]:
    """List the digest, the command that checks the certificate, and the versions of the verifier."""
    from markupsafe import Markup

    document = proof.document() if isinstance(proof, TolerantProof) else proof.document
    code = Markup("<code>{}</code>")
    entries: list[tuple[str, Any]] = [
        ("Check it", code.format(f"holdfast certificate check {file}")),
        ("Digest of the certificate", code.format(document["digest"])),
    ]
    if check is not None:
        flint = f"python-flint {version('python-flint')}"
        entries.append(("Verified with", f"verifier.py in ball arithmetic, {flint}, {check.seconds:.1f} s"))
    return entries
