"""What the search for motions found."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import ROWS
from holdfast.certificates.crew import Effort
from holdfast.certificates.proof import InParts, early, written
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.jobs import Job
from holdfast.certificates.tool_paths.march import LockedPath
from holdfast.certificates.verified import paths

Array = NDArray[np.float64]
Span = tuple[int, int]


@dataclass(frozen=True, kw_only=True)
class PathProof(InParts):
    """What the search for motions found. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        parts: Of each lock, in the order of the claim.
        document: The certificate, as its file holds it.
    """

    claim: PathClaim
    parts: tuple[LockedPath, ...]
    document: dict[str, Any]

    @property
    def ok(self) -> bool:
        """True if all is proved."""
        return self.proved == 1

    @property
    def refuted(self) -> Fraction:
        """Exact part of the lock instants at which nothing finishes the path, with the lock of which most is."""
        return max(part.refuted for part in self.parts)

    @property
    def undecided(self) -> Fraction:
        """Exact part of them that is neither proved nor refuted, with the lock of which most is."""
        return max(part.undecided for part in self.parts)

    @property
    def tolerant(self) -> Fraction:
        """Exact part of the lock instants that is proved whichever joint locks."""
        left = [gap for part in self.parts for gap in paths.gaps(part.spans, self.document)]
        return 1 - paths.share(left, self.document)

    def gaps(self, part: LockedPath) -> list[Span]:
        """Undecided intervals of lock instants."""
        return paths.gaps(part.spans + part.refuted_spans, self.document)

    def write(self, file: str | Path) -> Path:
        """Write the certificate.

        Raises:
            StoreError: The file cannot be written.
        """
        return written(self.document, Path(file))

    def describe(self) -> list[str]:
        """A few sentences for people."""
        whichever = f"; whichever joint locks, {verifier.per_cent(self.tolerant)}" if len(self.parts) > 1 else ""
        worst = min(self.parts, key=lambda part: part.proved)
        shares = f"proved {verifier.per_cent(worst.proved)}, "
        shares += f"refuted {verifier.per_cent(worst.refuted)}, " * bool(worst.refuted)
        shares += f"undecided {verifier.per_cent(worst.undecided, up=True)}"
        least = "" if self.ok else f" with a lock of {self.claim.arm.joint_names[worst.joint]}, of which least is proved"
        return [
            verifier.qualify_claim(self.document["claim"], self.tolerant),
            f"Found by the prover, not yet verified: of the lock instants {shares}{least}{whichever}{early(self.finished)}.",
            f"{self.leaves:,} cells, each glued to the next or with no configuration in it, of {self.nodes:,} that were looked "
            f"at; {self.seconds:.1f} s.",
        ]


def proved(claim: PathClaim, halvings: int, effort: Effort) -> PathProof:
    """As much of a claim as can be proved."""
    whole = claim.during[1] - claim.during[0]
    jobs = [Job.whole(claim, joint, _followers(claim, joint), halvings) for joint in claim.locks]
    parts = tuple(
        LockedPath(
            joint=job.joint, followers=job.followers, slabs=tuple(found.slabs),
            never=tuple(found.never),
            proved=Fraction(sum(slab.stop - slab.begin for slab in found.slabs), whole),
            refuted=Fraction(sum(one.stop - one.begin for one in found.never), whole), nodes=found.nodes,
            finished=found.finished, seconds=found.seconds,
        )
        for job, found in zip(jobs, effort.found(jobs), strict=True)
    )  # fmt: skip
    return PathProof(claim=claim, parts=parts, document=documents.path(claim, parts))


def _followers(claim: PathClaim, joint: int) -> tuple[int, ...]:
    """Which joints go on with the healthy motion after a lock: such that the others are farthest from singular on it."""
    rows = ROWS[claim.task]
    others = [k for k in range(claim.arm.n) if k != joint]
    if len(others) == len(rows):
        return ()
    slopes = claim.arm.jacobian(claim.knots)
    if claim.task == "pointing":  # turns about the tool's own axes
        tools = claim.arm.forward_kinematics(claim.knots)[:, :3, :3]
        slopes = np.concatenate([slopes[:, :3], tools.transpose(0, 2, 1) @ slopes[:, 3:]], axis=1)
    slopes = slopes[:, rows]
    choices = list(combinations(others, len(others) - len(rows)))
    least = [np.linalg.svd(np.delete(slopes, [joint, *left], axis=2), compute_uv=False)[:, -1].min() for left in choices]
    return choices[int(np.argmax(least))]
