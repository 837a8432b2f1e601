"""What the pages of proofs have in common: whether somebody else verified them, what they do not say, and how to check them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.certificates.checks import CertificateCheck
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.tool_paths.march import LockedPath
from holdfast.certificates.tool_paths.proof import PathProof
from holdfast.certificates.verifier import per_cent
from holdfast.present import results
from holdfast.present.printing import Rows
from holdfast.present.story import Story

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.reach import WorkingRanges

UNVERIFIED = "Found by the prover, not yet verified."
Found = Proof | TolerantProof | Refutation | ManipulabilityBound | PathProof


def write(
    found: Found,
    path: Path,
    command: str = "",
    drawn: Mapping[str, Figure] | None = None,
    check: CertificateCheck | None = None,
    file: str | Path = "FILE",
    ranges: WorkingRanges | None = None,
) -> Path:
    """The page of a proof.

    ``check``: What the verifier says of it, if it was asked; ``file``: where the certificate is; ``ranges``: the working
    ranges, if they were found by samples.
    """
    story: Story = found._presented("story")
    said = replace(
        story,
        answer=story.answer.replace(UNVERIFIED, _verified(found, check)),
        lines=[*(story.lines if check is None else check.describe()[:1]), *(ranges.describe() if ranges else [])],
        tables=[by_part(found, check), *(story.tables or []), *(ranges._presented("tables") if ranges else [])],
        method=[*story.method, *_how(found, check, file)],
    )
    return results.write(found, path, command, drawn, said)


def kept(text: str) -> str:
    """With a space that no line ends at."""
    return text.replace(" %", "\N{NO-BREAK SPACE}%")


def _verified(found: Found, check: CertificateCheck | None) -> str:
    """Who says so."""
    if check is None:
        return UNVERIFIED
    if check.ok and isinstance(found, Refutation | ManipulabilityBound) and found.refuted:
        return "Verified by code that shares nothing with the prover."
    if check.ok:
        return f"Verified: all {check.accepted:,} boxes are accepted by code that shares nothing with the prover."
    if check.rejected:
        return f"The verifier rejects {check.rejected:,} of {check.leaves:,} boxes: what they cover is undecided."
    return f"Sampled, not verified: {check.accepted:,} of {check.leaves:,} boxes are accepted."


def by_part(found: Found, check: CertificateCheck | None = None) -> Rows:
    """Shares, boxes and seconds of each part, and by whom it is verified."""
    parts = found.parts if isinstance(found, TolerantProof | PathProof) else (found,)
    checks = [None] * len(parts) if check is None else check.parts or (check,)
    rows = []
    for part, checked in zip(parts, checks, strict=True):
        shares = [per_cent(part.proved), "0 %", per_cent(part.undecided, up=True)]
        if isinstance(part, LockedPath):
            shares[1] = per_cent(part.refuted)
        elif not isinstance(part, Proof) and part.refuted:
            shares = ["0 %", "by a witness", "the rest"]
        rows.append([_name(found, part), *shares, f"{part.leaves:,}", f"{part.seconds:.1f}", *_by(checked)])
    names = ["lock of", "proved", "refuted", "undecided", "boxes", "search, s", "verified by", "check, s"]
    timed = any(row[-1] for row in rows)  # one check of all locks at once has a time of its own
    return Rows(names if timed else names[:-1], rows if timed else [row[:-1] for row in rows])


def _by(check: CertificateCheck | None) -> list[str]:
    """By whom, and the seconds it took."""
    if check is None:
        return ["nobody yet", ""]
    by = "verifier.py" if check.ok else f"not: {check.rejected:,} rejected" if check.rejected else "sampled"
    return [by, f"{check.seconds:.1f}" if check.seconds else ""]


def _name(found: Found, part: Found | LockedPath) -> str:
    if isinstance(part, LockedPath):
        return found.claim.arm.joint_names[part.joint]
    if isinstance(part, ManipulabilityBound):
        locks = part.claim.locks
        return "any one joint" if len(locks) == part.claim.arm.n else ", ".join(part.claim.arm.joint_names[k] for k in locks)
    assert not isinstance(part, TolerantProof | PathProof)
    return "healthy" if part.claim.locked < 0 else part.claim.arm.joint_names[part.claim.locked]


def _how(found: Found, check: CertificateCheck | None, file: str | Path) -> list[tuple[str, Any]]:
    """Digest, command and the verifier's versions."""
    from markupsafe import Markup

    document = found.document() if isinstance(found, TolerantProof) else found.document
    code = Markup("<code>{}</code>")
    told: list[tuple[str, Any]] = [
        ("Check it", code.format(f"holdfast certificate check {file}")),
        ("Digest of the certificate", code.format(document["digest"])),
    ]
    if check is not None:
        try:
            balls = f"python-flint {version('python-flint')}"
        except PackageNotFoundError:
            balls = "python-flint"
        told.append(("Verified with", f"verifier.py in ball arithmetic, {balls}, {check.seconds:.1f} s"))
    return told
