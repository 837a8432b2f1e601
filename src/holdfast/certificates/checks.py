"""Checks of certificate files."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from time import monotonic

from holdfast.certificates import verifier
from holdfast.certificates.documents import require_same_arm
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm


@dataclass(frozen=True, kw_only=True)
class CertificateCheck(Result):
    """Result of the verifier for a certificate.

    Attributes:
        claim: Claim as a sentence, with its proved fraction.
        locked: Name of the locked joint; empty for a healthy arm and for a bundle.
        leaves: Number of cells.
        accepted: Number of accepted cells.
        rejected: Number of rejected cells; the part that they cover counts as undecided.
        undecided: Exact fraction of targets and locked values that is undecided; for a bundle in its worst part.
        tolerant: Lower bound of the fraction of targets that is proved for every locked value and lock.
        seconds: Measured time, s.
        summary: Summary by the verifier in one sentence.
        parts: Results for the parts of a bundle: the healthy arm, then each lock.
        refuted: For a path, exact fraction of the lock instants after which no motion finishes it, in its worst part.
        witnessed: True if a configuration shows that the claim is false.
    """

    claim: str
    locked: str
    leaves: int
    accepted: int
    rejected: int
    undecided: Fraction
    tolerant: Fraction
    seconds: float
    summary: str
    parts: tuple[CertificateCheck, ...] = ()
    refuted: Fraction = Fraction(0)
    witnessed: bool = False

    @property
    def ok(self) -> bool:
        """True if every cell was checked and accepted."""
        return self.rejected == 0 and self.accepted == self.leaves

    @property
    def proved_fraction(self) -> Fraction:
        """Exact fraction of the claim that is proved; for a bundle in its worst part."""
        return min((part.proved_fraction for part in self.parts), default=1 - self.undecided - self.refuted)


class CheckStopped(HoldfastError):
    """Error for a check of a certificate that reached its time limit."""


@check_arguments
@reports_progress("checking the certificate")
def check_certificate(
    file: str | Path, *, arm: Arm | None = None, sample: int | None = None, workers: int = 1, time_limit: float | None = None
) -> CertificateCheck:
    """Check a certificate with the verifier, which shares only the wording of the claim with the prover.

    Args:
        file: Path of the certificate, or of the folder that contains it; the parts of a bundle lie in the same folder.
        arm: Arm that the certificate must be about, to the last digit of its geometry and limits. None: any arm.
        sample: Number of random cells of each part to check. The result is then sampled, not verified. None: all cells.
        workers: Number of worker processes.
        time_limit: Time limit, s, after which the check ends without a result. None: no limit.

    Raises:
        HoldfastError: The time limit was reached; nothing is verified.
        InputError: The file cannot be checked or is about another arm, or python-flint is not installed (extra ``certify``).
    """
    file = find_certificate_file(Path(file))
    if workers < 1 or (sample is not None and sample < 1):
        raise InputError("sample and workers must be 1 or more")
    try:
        if arm is not None:
            require_same_arm(verifier.load_certificate(Path(file)), arm)
        deadline = math.inf if time_limit is None else monotonic() + time_limit

        def raise_if_late(checked_leaves: int) -> None:
            if monotonic() > deadline:
                raise CheckStopped(f"the check was not finished within {time_limit:g} s; nothing is verified")

        return _convert_verdict(verifier.verify(file, sample=sample, workers=workers, progress=raise_if_late))
    except verifier.CertificateRejected as error:
        raise InputError(str(error)) from error


def require_flint() -> None:
    """Raise an error if python-flint, which the check needs, is not installed.

    Raises:
        InputError: The package is not installed.
    """
    if find_spec("flint") is None:
        raise InputError("checking a certificate needs python-flint; install it with: pip install 'holdfast-arms[certify]'")


def find_certificate_file(path: Path) -> Path:
    """Return the certificate in a folder, for a bundle the one that lists its parts; return any other path unchanged."""
    if not path.is_dir():
        return path
    files = sorted(path.glob("*.certificate"))
    # The names of the parts of a bundle begin with the name of the bundle.
    whole = [file for file in files if all(other.stem.startswith(file.stem) for other in files)]
    if len(whole) != 1:
        number = f"{len(files)} certificates, of which none is a bundle of the others" if files else "no certificate"
        raise InputError(f"'{path}' is a folder that holds {number}; give the name of a certificate")
    return whole[0]


def _convert_verdict(verdict: verifier.CertificateVerdict) -> CertificateCheck:
    locked_index = verdict.document.get("locked", -1)
    names = [joint["name"] for joint in verdict.document["arm"]["joints"]]
    return CertificateCheck(
        claim=verdict.document["claim"], locked=names[locked_index] if locked_index >= 0 else "",
        **{key: getattr(verdict, key) for key in ("leaves", "accepted", "rejected", "undecided", "seconds", "summary")},
        tolerant=verdict.tolerant_fraction, refuted=verdict.false, witnessed=verdict.refuted,
        parts=tuple(map(_convert_verdict, verdict.parts)),
    )  # fmt: skip
