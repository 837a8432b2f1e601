"""Results of the prover."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from fractions import Fraction
from io import BytesIO
from pathlib import Path
from typing import Any, Self
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import ReachClaim, TolerantClaim
from holdfast.certificates.kinds import ClaimKind
from holdfast.certificates.search_pool import SearchBudget
from holdfast.certificates.target_boxes.jobs import TargetBoxJob, TargetBoxResult
from holdfast.certificates.taylor import CENTER_UNIT
from holdfast.certificates.tree import compute_undecided_fraction
from holdfast.core.caching import cached_property
from holdfast.core.files.output import make_folder, replace_file
from holdfast.core.result import Result

CERTIFICATE_SUFFIX = ".certificate"


class CertificateResult(Result):
    """Result that contains a certificate, which is not verified until :func:`check_certificate` checks it."""

    __slots__ = ()
    document: Any

    def write(self, file: str | Path) -> Path:
        """Write the certificate to ``file`` and return its path.

        Raises:
            StoreError: The file cannot be written.
        """
        return write_document(self.document, Path(file))


@dataclass(frozen=True, kw_only=True)
class BisectionResult(CertificateResult):
    """Result of bisecting a box, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        proved: Exact fraction of the box that is proved.
        undecided: Exact fraction of the box that is undecided.
        leaves: Number of proved boxes, including those of lemmas.
        nodes: Number of examined boxes.
        finished: False if the search was stopped, or its time limit reached, before the smallest boxes were reached.
        seconds: Measured time, s.
        document: The certificate in the form of its file.
    """

    claim: Any
    proved: Fraction
    undecided: Fraction
    leaves: int
    nodes: int
    finished: bool
    seconds: float
    document: dict[str, Any]

    @classmethod
    def from_search(cls, claim: Any, fields: dict[str, Any], search: Any = None, *, seconds: float, **values: Any) -> Self:
        """Return the result of a search, which contains the numbers of leaves and so on, with the certificate of ``fields``."""
        values |= {key: getattr(search, key) for key in ("undecided", "leaves", "nodes", "finished")} if search else {}
        undecided, refuted = values["undecided"], values.get("refuted", Fraction(0))
        document = documents.build_document(
            claim, fields, undecided=undecided, refuted=refuted, seconds=seconds, nodes=values["nodes"]
        )
        counts: dict[str, Any] = {"proved": 1 - undecided - refuted, "seconds": seconds}
        return cls(claim=claim, document=document, **counts, **values)

    @property
    def ok(self) -> bool:
        """True if the whole claim is proved."""
        return self.proved == 1


@dataclass(frozen=True, kw_only=True)
class Proof(BisectionResult):
    """Result of the prover for a reach claim, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        proved: Exact fraction of targets and locked values that is proved.
        undecided: Exact fraction that is neither proved nor refuted.
    """

    claim: ReachClaim


class CompositeResult(CertificateResult):
    """Results of the searches for the parts of a claim, not verified until :func:`check_certificate` checks them."""

    __slots__ = ()
    parts: tuple[Any, ...]

    @property
    def ok(self) -> bool:
        """True if nothing is undecided."""
        return self.undecided == 0

    @property
    def proved(self) -> Fraction:
        """Exact proved fraction of the part with the smallest proved fraction."""
        return Fraction(min(part.proved for part in self.parts))

    @property
    def undecided(self) -> Fraction:
        """Exact unproved fraction of the part with the smallest proved fraction."""
        return 1 - self.proved

    @property
    def leaves(self) -> int:
        """Number of proved cells."""
        return sum(part.leaves for part in self.parts)

    @property
    def nodes(self) -> int:
        """Number of examined cells."""
        return sum(part.nodes for part in self.parts)

    @property
    def finished(self) -> bool:
        """False if a part was stopped before the smallest cells were reached."""
        return all(part.finished for part in self.parts)

    @property
    def seconds(self) -> float:
        """Measured time, s."""
        return float(sum(part.seconds for part in self.parts))


@dataclass(frozen=True, kw_only=True)
class TolerantProof(CompositeResult):
    """Result of the prover for a failure-tolerant box, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        parts: Results for the healthy arm, then for each lock of the claim.
    """

    claim: TolerantClaim
    parts: tuple[Proof, ...]

    @property
    def worst(self) -> Proof:
        """Part with the largest undecided fraction."""
        return max(self.parts, key=lambda part: part.undecided)

    @cached_property
    def tolerant(self) -> Fraction:
        """Lower bound of the fraction of targets that is proved for the healthy arm and for every lock at every value."""
        axis_count = len(self.claim.box)
        unproved = {cell[:axis_count] for part in self.parts for cell in documents.find_undecided_cells(part.document)}
        return 1 - verifier.compute_covered_volume(unproved, [verifier.MAX_COVER_STEPS])

    def part_label(self, part: Proof) -> str:
        """Return ``healthy``, or the name of the joint that locks in ``part``."""
        return "healthy" if part.claim.locked < 0 else self.claim.arm.joint_names[part.claim.locked]

    def document(self, stem: str = "tolerant") -> dict[str, Any]:
        """Return the certificate that lists its parts, whose file names begin with ``stem``, in the form of its file."""
        entries = [
            {"file": name, "digest": part.document["digest"], "locked": part.document["locked"]}
            for name, part in zip(self._part_files(stem), self.parts, strict=True)
        ]
        fields = {"parts": entries, "volumes": self.worst.document["volumes"]}
        return documents.build_document(self.claim, fields, seconds=self.seconds, nodes=self.nodes)

    def _part_files(self, stem: str) -> list[str]:
        """Return the file names of the parts; they contain joint numbers because joint names may contain any character."""
        joint_numbers = [part.claim.locked + 1 for part in self.parts]
        return [f"{stem}-{f'lock-of-joint-{number}' if number else 'healthy'}{CERTIFICATE_SUFFIX}" for number in joint_numbers]

    def write(self, file: str | Path) -> Path:
        """Write the certificate, and those of its parts next to it, and return the path for :func:`check_certificate`.

        Args:
            file: Path of the file; of a folder, which is created if needed and gets ``tolerant.certificate``; or of an
                archive of these files (``.zip``), which the verifier also accepts.

        Raises:
            StoreError: A file cannot be written.
        """
        path = Path(file)
        if path.suffix == ".zip":
            return self._write_archive(path)
        if path.is_dir() or not path.suffix:
            path = make_folder(path) / f"tolerant{CERTIFICATE_SUFFIX}"
        stem = re.sub(r"[^A-Za-z0-9_-]", "-", path.stem).lstrip("-") or "tolerant"
        for part, name in zip(self.parts, self._part_files(stem), strict=True):
            part.write(path.with_name(name))
        return write_document(self.document(stem), path)

    def _write_archive(self, path: Path) -> Path:
        """Write one archive with the bundle first; equal parts result in equal bytes."""
        names, buffer = ["tolerant" + CERTIFICATE_SUFFIX, *self._part_files("tolerant")], BytesIO()
        with ZipFile(buffer, "w", ZIP_DEFLATED) as archive:
            for name, document in zip(names, [self.document(), *(part.document for part in self.parts)], strict=True):
                archive.writestr(ZipInfo(name), encode_document(document), ZIP_DEFLATED, 9)
        replace_file(path, buffer.getvalue(), "certificate")
        return path


def write_document(document: dict[str, Any], path: Path) -> Path:
    """Write a certificate and return its path."""
    replace_file(path, encode_document(document), "certificate")
    return path


def encode_document(document: dict[str, Any]) -> bytes:
    """Return the file content of a certificate."""
    return (json.dumps(document, sort_keys=True, indent=1) + "\n").encode()


def _prove_parts(parts: tuple[ReachClaim, ...], halvings: int, seed: int, budget: SearchBudget) -> tuple[Proof, ...]:
    results = budget.run_jobs([TargetBoxJob(part, halvings, seed, index) for index, part in enumerate(parts)])
    return tuple(_build_proof(part, result) for part, result in zip(parts, results, strict=True))


def _build_proof(claim: ReachClaim, result: TargetBoxResult) -> Proof:
    fields = {
        "unit": CENTER_UNIT.hex(),
        "tree": documents.compress_bytes(result.tree),
        "centres": documents.compress_bytes(result.centers.astype("<i4").tobytes()),
        "refutations": [],
    }
    return Proof.from_search(
        claim, fields, undecided=compute_undecided_fraction(result.tree), leaves=len(result.centers), nodes=result.nodes,
        finished=result.finished, seconds=result.seconds,
    )  # fmt: skip


def _prove_tolerant(claim: TolerantClaim, halvings: int, seed: int, budget: SearchBudget) -> TolerantProof:
    return TolerantProof(claim=claim, parts=_prove_parts(claim.parts, halvings, seed, budget))


def _encode_tolerant_claim(claim: TolerantClaim) -> dict[str, Any]:
    ranges, limits = documents.encode_floats(claim.working_ranges), documents.encode_limits(claim.arm)
    return documents.encode_target(claim) | {"limits": limits, "working_ranges": ranges, "locks": list(claim.locks)}


REACH_KIND = ClaimKind(
    "reach", lambda claim, *options: _prove_parts((claim,), *options)[0], documents.encode_target_claim, halvings=8
)
TOLERANT_KIND = ClaimKind("bundle", _prove_tolerant, _encode_tolerant_claim, halvings=8)
