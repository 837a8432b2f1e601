"""Search for proofs, one for each part of a claim."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import Any, TypedDict, Unpack, overload

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.claims import OutOfReachClaim, ReachClaim, TolerantClaim
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.joint_claims import BoundClaim, StructuralZeroClaim
from holdfast.certificates.kinds import Claim, find_claim_kind
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.search_pool import SearchBudget, StopCheck
from holdfast.certificates.structure import StructuralZero
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.proof import PathProof
from holdfast.certificates.tree import SearchState, StateCallback
from holdfast.core.errors import InputError
from holdfast.core.progress import Progress, reports_progress
from holdfast.core.sweeps.memory import SearchMemory
from holdfast.core.validation import check_arguments

_PROGRESS_STEPS = 10_000  # of which progress is told: ten thousandths of all parts


class CertifyOptions(TypedDict, total=False):
    """Options of :func:`certify`."""

    halvings: int | None
    time_limit: float | None
    seed: int
    workers: int
    store: str | Path | None
    progress: Progress | None
    state: StateCallback | None
    stop: StopCheck


@overload
def certify(claim: ReachClaim, **how: Unpack[CertifyOptions]) -> Proof: ...
@overload
def certify(claim: TolerantClaim, **how: Unpack[CertifyOptions]) -> TolerantProof: ...
@overload
def certify(claim: OutOfReachClaim, **how: Unpack[CertifyOptions]) -> Refutation: ...
@overload
def certify(claim: BoundClaim, **how: Unpack[CertifyOptions]) -> ManipulabilityBound: ...
@overload
def certify(claim: StructuralZeroClaim, **how: Unpack[CertifyOptions]) -> StructuralZero: ...
@overload
def certify(claim: PathClaim, **how: Unpack[CertifyOptions]) -> PathProof: ...
@overload
def certify(claim: Claim, **how: Unpack[CertifyOptions]) -> Any: ...
@check_arguments
@reports_progress("searching for a proof")
def certify(
    claim: Claim,
    *,
    halvings: int | None = None,
    time_limit: float | None = None,
    seed: int = 0,
    workers: int = 1,
    store: str | Path | None = None,
    progress: Progress | None = None,
    state: StateCallback | None = None,
    stop: StopCheck = lambda: False,
) -> Any:
    """Prove as much of a claim as possible by bisecting cells of targets and locked angles until one configuration proves each
    cell.

    That nothing of a box is reached is proved by halving the box of configurations with that of the targets, until distances
    tell each of them apart; or refuted by a configuration that is found in it. A ceiling of relative manipulability is proved
    by a wrench for each part of the box of configurations, a floor by a motion. A structural zero needs no search: axes meet,
    or they do not. That a path is finished is proved by cells of it behind each interval of lock instants, glued to each other.

    Args:
        claim: From :func:`holdfast.certificates.reach_claim`, :func:`holdfast.certificates.tolerant_claim`,
            :func:`holdfast.certificates.out_of_reach_claim`, :func:`holdfast.certificates.ceiling_claim`,
            :func:`holdfast.certificates.floor_claim`, :func:`holdfast.certificates.structural_zero_claim` or
            :func:`holdfast.certificates.path_claim`.
        halvings: Of each axis, at most: what is still undecided then stays so. Default: 8, of what is halved in joints 16,
            of lock instants 6: these are halved within a segment, at most 13 times.
        time_limit: s after which the rest is undecided; the parts of a failure-tolerant box get equal parts of it, and what
            one does not need the others get. Without it the same seed gives the same certificate.
        seed: Of all random draws.
        workers: Processes: each takes a part, or a piece of one that takes very many cells. What is found is the same.
        store: Folder that remembers what is done, made if need be: the same call resumes a search that was stopped or killed,
            and ends with the same certificate. None: nothing is remembered.
        state: Called with a :class:`holdfast.certificates.SearchState`: what is proved, undecided and open.
        progress: Called with what is decided and all, in ten thousandths of the parts' volumes.
        stop: Asked now and then; once it says True, the rest stays undecided.

    Returns:
        A :class:`holdfast.certificates.Proof`, of a failure-tolerant box a :class:`holdfast.certificates.TolerantProof`, of
        what is out of reach a :class:`holdfast.certificates.Refutation`, of a ceiling or floor a
        :class:`holdfast.certificates.ManipulabilityBound`, of a structural zero a
        :class:`holdfast.certificates.StructuralZero`, of a path a :class:`holdfast.certificates.PathProof`; found by the
        prover and not yet verified. Its file is checked by :func:`check_certificate`, or without holdfast; see the explanation
        of certificates.

    Raises:
        InputError: A number out of range, or a box that would take more than 2^24 cells.
        StoreError: The folder holds another search or something else, or cannot be written.
    """
    kind = find_claim_kind(claim)
    halvings = kind.halvings if halvings is None else halvings
    if not 0 <= halvings <= 20:
        raise InputError(f"halvings is {halvings}; it must be from 0 to 20")
    if time_limit is not None and not time_limit > 0:
        raise InputError(f"time_limit is {time_limit}; it must be above 0, in seconds")
    if workers < 1:
        raise InputError(f"workers is {workers}; it must be 1 or more")
    deadline, part_count = np.inf if time_limit is None else monotonic() + time_limit, len(claim.parts)

    def report_state(current: SearchState) -> None:
        decided = int(_PROGRESS_STEPS * part_count * (1 - current.open))
        if progress is not None and decided:
            progress(decided, _PROGRESS_STEPS * part_count)
        if state is not None:
            state(current)

    memory = None
    if store is not None and kind.halvings:
        sentences = [documents.format_claim(part) for part in claim.parts]
        memory = SearchMemory(store, {"kind": "certify", "format": 2, "claims": sentences, "halvings": halvings, "seed": seed})
    budget = SearchBudget(deadline=deadline, should_stop=stop, report_state=report_state, workers=workers, memory=memory)
    return kind.search(claim, halvings, seed, budget)
