"""Certificates checked."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.certificates import verifier
from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.result import Result


@dataclass(frozen=True, kw_only=True)
class CertificateCheck(Result):
    """What the verifier says of a certificate.

    Attributes:
        claim: The sentence that is proved, as far as it is.
        locked: Name of the locked joint; empty of a healthy arm, and of a bundle.
        leaves, accepted, rejected: Cells; what a rejected one covers counts as undecided.
        refuted: Of a path, exact share of the lock instants at which nothing finishes it; of a bundle in its worst part.
        undecided: Exact share of targets and locked angles; of a bundle in its worst part.
        tolerant: At least this share of the targets is proved, for every locked value and lock.
        seconds: Measured.
        said: The verifier's own sentence.
        parts: Of a bundle: the healthy arm, then each lock.
        witnessed: A configuration shows that the claim is false.
    """

    claim: str
    locked: str
    leaves: int
    accepted: int
    rejected: int
    undecided: Fraction
    tolerant: Fraction
    seconds: float
    said: str
    parts: tuple[CertificateCheck, ...] = ()
    refuted: Fraction = Fraction(0)
    witnessed: bool = False

    @property
    def ok(self) -> bool:
        """True if every cell was checked and accepted."""
        return self.rejected == 0 and self.accepted == self.leaves

    def describe(self) -> list[str]:
        """A few sentences for people."""
        return [self.claim, self.said]


@checked
@says("checking the certificate")
def check_certificate(
    file: str | Path, *, arm: Arm | None = None, sample: int | None = None, workers: int = 1
) -> CertificateCheck:
    """Check a certificate by the verifier, which shares nothing with the prover but the sentence of the claim.

    Args:
        file: The certificate; the parts of a bundle lie beside it.
        arm: The arm that it must be about, to the last digit of its geometry and limits; None: it may be any.
        sample: Only so many cells of each part, drawn at random: then it is sampled, not verified.
        workers: Processes.

    Raises:
        InputError: A file that cannot be checked or is about another arm, or python-flint is not installed (extra
            ``certify``).
    """
    if workers < 1 or (sample is not None and sample < 1):
        raise InputError("sample and workers must be 1 or more")
    try:
        if arm is not None:
            from holdfast.certificates.documents import need_arm

            need_arm(verifier.load(Path(file)), arm)
        return _of(verifier.verify(file, sample=sample, workers=workers))
    except verifier.Refused as error:
        raise InputError(str(error)) from error


def _of(found: verifier.Verdict) -> CertificateCheck:
    locked = found.document.get("locked", -1)
    return CertificateCheck(
        claim=found.document["claim"],
        locked=found.document["arm"]["joints"][locked]["name"] if locked >= 0 else "",
        leaves=found.leaves,
        accepted=found.accepted,
        rejected=found.rejected,
        undecided=found.undecided,
        tolerant=found.tolerant,
        seconds=found.seconds,
        said=found.sentence,
        parts=tuple(map(_of, found.parts)),
        refuted=found.false,
        witnessed=found.refuted,
    )
