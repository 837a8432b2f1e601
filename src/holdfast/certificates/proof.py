"""What the prover found."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from fractions import Fraction
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from holdfast.caching import cached_property
from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import ReachClaim, TolerantClaim
from holdfast.files.output import made, replaced
from holdfast.result import Result

SUFFIX = ".certificate"


@dataclass(frozen=True, kw_only=True)
class Halved(Result):
    """What the halving of a box found. It is not verified: :func:`check_certificate` does that.

    Attributes:
        proved, undecided: Exact parts of the box.
        leaves: Boxes that are proved, those of lemmas among them.
        nodes: Boxes that were looked at.
        finished: False if it was stopped, or the time limit was spent, before the smallest boxes were reached.
        seconds: Measured.
        document: The certificate, as its file holds it.
    """

    proved: Fraction
    undecided: Fraction
    leaves: int
    nodes: int
    finished: bool
    seconds: float
    document: dict[str, Any]

    @property
    def ok(self) -> bool:
        """True if nothing is undecided."""
        return self.undecided == 0

    def write(self, file: str | Path) -> Path:
        """Write the certificate.

        Raises:
            StoreError: The file cannot be written.
        """
        return written(self.document, Path(file))


@dataclass(frozen=True, kw_only=True)
class Proof(Halved):
    """What the prover found for a claim. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        proved: Exact share of targets and locked angles that is proved.
        undecided: The rest: neither proved nor refuted.
    """

    claim: ReachClaim

    def describe(self) -> list[str]:
        """A few sentences for people."""
        return [
            verifier.qualify_claim(self.document["claim"], self.proved),
            f"Found by the prover, not yet verified: proved {verifier.per_cent(self.proved)}, "
            f"undecided {verifier.per_cent(self.undecided, up=True)}{early(self.finished)}.",
            f"{self.leaves:,} cells are proved, each by one configuration, of {self.nodes:,} that were looked at; "
            f"{self.seconds:.1f} s.",
        ]


class InParts(Result):
    """What the searches for the parts of a claim found. It is not verified: :func:`check_certificate` does that."""

    __slots__ = ()
    parts: tuple[Any, ...]

    @property
    def ok(self) -> bool:
        """True if nothing is undecided."""
        return self.undecided == 0

    @property
    def proved(self) -> Fraction:
        """Exact share that is proved, of the part of which least is."""
        return Fraction(min(part.proved for part in self.parts))

    @property
    def undecided(self) -> Fraction:
        """The rest of it."""
        return 1 - self.proved

    @property
    def leaves(self) -> int:
        """Cells that are proved."""
        return sum(part.leaves for part in self.parts)

    @property
    def nodes(self) -> int:
        """Cells that were looked at."""
        return sum(part.nodes for part in self.parts)

    @property
    def finished(self) -> bool:
        """False if a part was stopped before the smallest cells were reached."""
        return all(part.finished for part in self.parts)

    @property
    def seconds(self) -> float:
        """Measured."""
        return float(sum(part.seconds for part in self.parts))


@dataclass(frozen=True, kw_only=True)
class TolerantProof(InParts):
    """What the prover found for a failure-tolerant box. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        parts: Of the healthy arm, then of each lock of the claim.
    """

    claim: TolerantClaim
    parts: tuple[Proof, ...]

    @property
    def worst(self) -> Proof:
        """The part of which most is undecided."""
        return max(self.parts, key=lambda part: part.undecided)

    @cached_property
    def tolerant(self) -> Fraction:
        """At least this share of the targets is proved while healthy, and for every lock at every locked angle."""
        count = len(self.claim.box)
        unproved = {cell[:count] for part in self.parts for cell in documents.undecided(part.document)}
        return 1 - verifier.covered(unproved, [verifier.MOST_STEPS])

    def named(self, part: Proof) -> str:
        """``healthy``, or the joint that locks in a part."""
        return "healthy" if part.claim.locked < 0 else self.claim.arm.joint_names[part.claim.locked]

    def document(self, stem: str = "tolerant") -> dict[str, Any]:
        """The certificate that names those of its parts, as its file holds it."""
        parts = [part.document for part in self.parts]
        return documents.bundle(self.claim, parts, self.parts.index(self.worst), self._names(stem))

    def _names(self, stem: str) -> list[str]:
        """Files of the parts; joints by their number, as their names may hold anything."""
        locks = [part.claim.locked + 1 for part in self.parts]
        return [f"{stem}-{f'lock-of-joint-{k}' if k else 'healthy'}{SUFFIX}" for k in locks]

    def write(self, file: str | Path) -> Path:
        """Write the certificate, and those of its parts beside it.

        Args:
            file: The file; a folder, which is made if need be and gets ``tolerant.certificate``; or an archive of these
                files (``.zip``), which the verifier takes as it is.

        Returns:
            The file, which is what :func:`check_certificate` takes.

        Raises:
            StoreError: A file cannot be written.
        """
        path = Path(file)
        if path.suffix == ".zip":
            return self._archived(path)
        if path.is_dir() or not path.suffix:
            path = made(path) / f"tolerant{SUFFIX}"
        stem = re.sub(r"[^A-Za-z0-9_-]", "-", path.stem).lstrip("-") or "tolerant"
        for part, name in zip(self.parts, self._names(stem), strict=True):
            part.write(path.with_name(name))
        return written(self.document(stem), path)

    def _archived(self, path: Path) -> Path:
        """One file, the bundle first; the same parts make the same bytes."""
        names, packed = ["tolerant" + SUFFIX, *self._names("tolerant")], BytesIO()
        with ZipFile(packed, "w", ZIP_DEFLATED) as archive:
            for name, document in zip(names, [self.document(), *(part.document for part in self.parts)], strict=True):
                archive.writestr(ZipInfo(name), encoded(document), ZIP_DEFLATED, 9)
        replaced(path, packed.getvalue(), "certificate")
        return path

    def describe(self) -> list[str]:
        """A few sentences for people."""
        worst = "the healthy arm" if self.worst.claim.locked < 0 else f"a lock of {self.named(self.worst)}"
        most = "" if self.ok else f", at most, with {worst}"
        return [
            verifier.qualify_claim(self.document()["claim"], self.tolerant),
            f"Found by the prover, not yet verified: whatever locks, proved {verifier.per_cent(self.tolerant)} of the targets "
            f"at least; undecided {verifier.per_cent(self.undecided, up=True)}{most}{early(self.finished)}.",
            f"{self.leaves:,} cells are proved, each by one configuration, of {self.nodes:,} that were looked at; "
            f"{self.seconds:.1f} s.",
        ]


def early(finished: bool) -> str:
    """What is said of a search that ended early."""
    return "" if finished else "; the search was stopped before the smallest cells were reached"


def written(document: dict[str, Any], path: Path) -> Path:
    """The file of a certificate."""
    replaced(path, encoded(document), "certificate")
    return path


def encoded(document: dict[str, Any]) -> bytes:
    """What the file of a certificate holds."""
    return (json.dumps(document, sort_keys=True, indent=1) + "\n").encode()
