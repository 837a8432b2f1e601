"""Search for proofs that no target of a box is reached, or for a configuration that refutes this."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents
from holdfast.certificates.claims import OutOfReachClaim
from holdfast.certificates.joint_boxes.exclusion import Exclusion, search_witness_or_exclusion
from holdfast.certificates.kinds import ClaimKind
from holdfast.certificates.proof import BisectionResult
from holdfast.certificates.search_pool import SearchBudget


@dataclass(frozen=True, kw_only=True)
class Refutation(BisectionResult):
    """Result of the prover for an out-of-reach claim, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        proved: Exact fraction of the pairs of target and configuration that are excluded.
        witness: (n,) configuration, rad, with its tool in the box, which refutes the claim and is in the document; None if
            none was found.
    """

    claim: OutOfReachClaim
    witness: NDArray[np.float64] | None

    @property
    def refuted(self) -> bool:
        """True if a witness was found."""
        return self.witness is not None


def prove_out_of_reach(claim: OutOfReachClaim, halvings: int, seed: int, budget: SearchBudget) -> Refutation:
    """Search for a proof that no target is reached, with the options of :func:`holdfast.certify`."""
    started = perf_counter()
    exclusion = search_witness_or_exclusion(claim, halvings, seed, budget)
    return Refutation.from_search(
        claim, encode_exclusion(exclusion), exclusion, seconds=perf_counter() - started, witness=exclusion.witness
    )


def encode_exclusion(exclusion: Exclusion) -> dict[str, Any]:
    """Return the fields of an exclusion, or of a witness that disproves the claim."""
    lemmas = [
        {"link": lemma.link, "tree": documents.compress_bytes(lemma.tree)}
        | {key: documents.encode_floats(getattr(lemma, key)) for key in ("point", "least", "most")}
        for lemma in exclusion.lemmas
    ]
    witness = None if exclusion.witness is None else documents.encode_floats(exclusion.witness)
    return {"tree": documents.compress_bytes(exclusion.tree), "lemmas": lemmas, "witness": witness}


REFUTATION_KIND = ClaimKind("refutation", prove_out_of_reach, documents.encode_target_claim, halvings=16)
