"""Search for proofs that no target of a box is reached."""

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
    """Result of the prover for a claim that nothing is reached. It is not verified: :func:`check_certificate` does that.

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


def prove_out_of_reach(claim: OutOfReachClaim, halvings: int, seed: int, budget: SearchBudget) -> Refutation:
    """Search for a proof that nothing is reached, with the options of :func:`holdfast.certify`."""
    started = perf_counter()
    exclusion = search_witness_or_exclusion(claim, halvings, seed, budget)
    return Refutation.from_search(
        claim, encode_exclusion(exclusion), undecided=exclusion.undecided, leaves=exclusion.leaves, nodes=exclusion.nodes,
        finished=exclusion.finished, seconds=perf_counter() - started, witness=exclusion.witness,
    )  # fmt: skip


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
