"""Search for proofs, one for each part of a claim."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import Any, TypedDict, Unpack, overload

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.claims import OutOfReachClaim, ReachClaim, TolerantClaim
from holdfast.certificates.hold_claims import HoldClaim, HoldProof
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

_PROGRESS_STEPS = 10_000  # steps of the reported progress: ten thousandths of all parts


class CertifyOptions(TypedDict, total=False):
    """Options of :func:`certify`, which documents them."""

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
def certify(claim: HoldClaim, **how: Unpack[CertifyOptions]) -> HoldProof: ...
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
    """Prove as much of a claim as possible by bisection, and return the result with its certificate.

    A box of targets is proved to be reached by bisecting cells of targets and locked values until one configuration proves
    each cell. It is proved to be out of reach by bisecting configurations and targets until distances exclude each box, or
    refuted by a configuration with its tool in the box. A ceiling of relative manipulability is proved by a wrench for each
    part of the box of configurations, and a floor by a motion. A structural zero needs no search, because its axes either meet
    or not. A path is proved by cells that follow each interval of lock instants and are matched at their shared faces. That an
    arm holds is proved or refuted by bounds of the gravity torques in each box of configurations.

    Args:
        claim: Claim of :func:`holdfast.certificates.reach_claim`, :func:`holdfast.certificates.tolerant_claim`,
            :func:`holdfast.certificates.out_of_reach_claim`, :func:`holdfast.certificates.ceiling_claim`,
            :func:`holdfast.certificates.floor_claim`, :func:`holdfast.certificates.structural_zero_claim`,
            :func:`holdfast.certificates.path_claim` or :func:`holdfast.certificates.hold_claim`.
        halvings: Largest number of bisections of each axis; smaller cells stay undecided. Default: 8; for joints 16, or 6
            for a hold claim; for lock instants, which are bisected within a segment at most 13 times, 6.
        time_limit: Time limit, s, after which all open cells are undecided. The parts of a failure-tolerant box get equal
            times, and the others use the time that one part leaves. None: no limit; then a seed determines the certificate.
        seed: Seed of all random samples.
        workers: Number of worker processes, which does not change the result. Each takes a part, or a piece of a large part.
        store: Folder for intermediate results, created if needed. The same call then resumes a search that was stopped or
            killed, and ends with the same certificate. None: results are not stored.
        state: Function that is called with a :class:`holdfast.certificates.SearchState` with the fractions that are proved,
            undecided and open.
        progress: Function that is called with the decided and the total volume, in ten thousandths of the parts' volumes.
        stop: Function that is called regularly; after it has returned True, all open cells are undecided.

    Returns:
        A :class:`holdfast.certificates.Proof`, or for the other claims a :class:`holdfast.certificates.TolerantProof`,
        :class:`holdfast.certificates.Refutation`, :class:`holdfast.certificates.ManipulabilityBound`,
        :class:`holdfast.certificates.StructuralZero`, :class:`holdfast.certificates.PathProof` or
        :class:`holdfast.certificates.HoldProof`. The prover found it, but it is not verified. :func:`check_certificate` checks
        its file; the explanation of certificates shows how to check it without holdfast.

    Raises:
        InputError: A number is out of range, or the box would take more than 2^24 cells.
        StoreError: The folder contains another search or other files, or cannot be written.
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
