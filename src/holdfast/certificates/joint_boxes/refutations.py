"""What was found of a claim that nothing of a box is reached."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import OutOfReachClaim
from holdfast.certificates.crew import Effort
from holdfast.certificates.joint_boxes.exclusion import exclude
from holdfast.certificates.proof import Halved, early


@dataclass(frozen=True, kw_only=True)
class Refutation(Halved):
    """What the prover found for a claim that nothing is reached. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        proved: Exact share of pairs of target and configuration that are told apart.
        witness: (n,) rad, a configuration whose tool is in the box: the claim is false, and the document says so. None: none
            was found.
    """

    claim: OutOfReachClaim
    witness: NDArray[np.float64] | None

    @property
    def refuted(self) -> bool:
        """True if a witness was found."""
        return self.witness is not None

    def describe(self) -> list[str]:
        """A few sentences for people."""
        if self.witness is not None:
            at = ", ".join(f"{x:.4g}" for x in np.rad2deg(self.witness))
            return [
                verifier.qualify_claim(self.document["claim"], self.proved, refuted=True),
                f"Refuted by a witness: at ({at}) deg the tool is in the box.",
            ]
        return [
            verifier.qualify_claim(self.document["claim"], self.proved),
            f"Found by the prover, not yet verified: proved {verifier.per_cent(self.proved)} of all pairs of target and "
            f"configuration, undecided {verifier.per_cent(self.undecided, up=True)}{early(self.finished)}.",
            f"{self.leaves:,} boxes are told apart, of {self.nodes:,} that were looked at; {self.seconds:.1f} s.",
        ]


def refuted(claim: OutOfReachClaim, halvings: int, seed: int, effort: Effort) -> Refutation:
    """What the search finds, as :func:`holdfast.certify` is asked."""
    began = perf_counter()
    found = exclude(claim, halvings, seed, effort)
    seconds = perf_counter() - began
    return Refutation(
        claim=claim,
        proved=1 - found.undecided,
        undecided=found.undecided,
        witness=found.witness,
        leaves=found.leaves,
        nodes=found.nodes,
        finished=found.finished,
        seconds=seconds,
        document=documents.refutation(claim, found, seconds=seconds),
    )
