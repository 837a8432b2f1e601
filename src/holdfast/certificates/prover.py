"""The search for proofs: one for each part of a claim."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import monotonic, perf_counter
from typing import TypedDict, Unpack, overload

import numpy as np

from holdfast.arguments import checked
from holdfast.certificates import documents, structure, verifier
from holdfast.certificates.claims import ROWS, OutOfReachClaim, ReachClaim, TolerantClaim
from holdfast.certificates.joint_boxes.bounds import ManipulabilityBound, bounded
from holdfast.certificates.joint_boxes.refutations import Refutation, refuted
from holdfast.certificates.joint_claims import BoundClaim, StructuralZeroClaim
from holdfast.certificates.proof import Proof, TolerantProof
from holdfast.certificates.search import Search
from holdfast.certificates.structure import StructuralZero
from holdfast.certificates.taylor import Reach
from holdfast.certificates.tool_paths import proof as motions
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.proof import PathProof
from holdfast.errors import InputError
from holdfast.notice import Progress, says

_FINE = 10_000  # of which progress is told: ten thousandths of all parts
_BEGIN = 4  # of the time limit, to begin with
_SLICE = 2.0  # s on a part, then on the next, so that one that is stopped has something of each
Stop = Callable[[], bool]


class How(TypedDict, total=False):
    """Arguments of :func:`certify`."""

    halvings: int | None
    time_limit: float | None
    seed: int
    progress: Progress | None
    stop: Stop


class _Part:
    """The search for a proof of one claim.

    Attributes:
        claim: The claim.
        closed: What share of it is proved, or as small as it may be.
        finished: The smallest cells were reached.
    """

    def __init__(self, claim: ReachClaim, halvings: int, seed: int, until: float = np.inf) -> None:
        began = perf_counter()
        self.claim, self.closed, self.finished = claim, 0.0, False
        root = claim.box if claim.angle is None else np.vstack([claim.box, claim.angle])
        reach = Reach(claim.arm, ROWS[claim.task], claim.locked, claim.limits, claim.rotation, claim.angle)
        self._search = Search(reach, root, halvings, seed, until)
        cells = self._search.pool.cells
        if verifier.MOST_LEAVES < cells < np.inf:
            raise InputError(
                f"single configurations prove so little of this box that it would take some {cells:.0e} cells; "
                "a smaller box or a narrower interval of the lock takes fewer"
            )
        self._seconds = perf_counter() - began

    def run(self, until: float, stop: Stop, tell: Callable[[], None]) -> None:
        """On with it until it is time (``monotonic``), or to stop."""
        began = perf_counter()
        self.finished = self._search.run(until, stop, partial(self._advance, tell))
        self._seconds += perf_counter() - began

    def _advance(self, tell: Callable[[], None], closed: float) -> None:
        self.closed = closed
        tell()

    def proof(self) -> Proof:
        """What is found so far."""
        tree = self._search.tree
        undecided = tree.undecided
        return Proof(
            claim=self.claim,
            proved=1 - undecided,
            undecided=undecided,
            leaves=len(tree.centre),
            nodes=self._search.nodes,
            finished=self.finished,
            seconds=self._seconds,
            document=documents.reach(self.claim, tree, undecided, seconds=self._seconds, nodes=self._search.nodes),
        )


@overload
def certify(claim: ReachClaim, **how: Unpack[How]) -> Proof: ...
@overload
def certify(claim: TolerantClaim, **how: Unpack[How]) -> TolerantProof: ...
@overload
def certify(claim: OutOfReachClaim, **how: Unpack[How]) -> Refutation: ...
@overload
def certify(claim: BoundClaim, **how: Unpack[How]) -> ManipulabilityBound: ...
@overload
def certify(claim: StructuralZeroClaim, **how: Unpack[How]) -> StructuralZero: ...
@overload
def certify(claim: PathClaim, **how: Unpack[How]) -> PathProof: ...
@checked
@says("searching for a proof")
def certify(
    claim: ReachClaim | TolerantClaim | OutOfReachClaim | BoundClaim | StructuralZeroClaim | PathClaim,
    *,
    halvings: int | None = None,
    time_limit: float | None = None,
    seed: int = 0,
    progress: Progress | None = None,
    stop: Stop = lambda: False,
) -> Proof | TolerantProof | Refutation | ManipulabilityBound | StructuralZero | PathProof:
    """Prove as much of a claim as can be: cells of targets and locked angles are halved until one configuration does for each.

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
    """
    if halvings is None:
        halvings = 16 if isinstance(claim, OutOfReachClaim | BoundClaim) else 6 if isinstance(claim, PathClaim) else 8
    if not 0 <= halvings <= 20:
        raise InputError(f"halvings is {halvings}; it must be from 0 to 20")
    if time_limit is not None and not time_limit > 0:
        raise InputError(f"time_limit is {time_limit}; it must be above 0, in seconds")
    end = np.inf if time_limit is None else monotonic() + time_limit

    def tell(closed: float, of: int = 1) -> None:
        if progress is not None:
            progress(int(_FINE * closed), _FINE * of)

    if isinstance(claim, OutOfReachClaim):
        return refuted(claim, halvings, seed, end, stop, tell)
    if isinstance(claim, PathClaim):
        return motions.proved(claim, halvings, end, stop, tell)
    if isinstance(claim, StructuralZeroClaim):
        return structure.proved(claim)
    if isinstance(claim, BoundClaim):
        return bounded(claim, halvings, seed, end, stop, tell)
    claims = claim.parts if isinstance(claim, TolerantClaim) else (claim,)
    ready, parts = monotonic() + (end - monotonic()) / _BEGIN, list[_Part]()
    for left, part in zip(range(len(claims), 0, -1), claims, strict=True):
        now = monotonic()
        parts.append(_Part(part, halvings, seed, now if stop() else now + (ready - now) / left))

    def tell_of_all() -> None:
        closed = sum(part.closed for part in parts)
        if int(_FINE * closed):
            tell(closed, len(parts))

    while (open_parts := [part for part in parts if not part.finished]) and monotonic() < end and not stop():
        for left, open_part in zip(range(len(open_parts), 0, -1), open_parts, strict=True):
            now = monotonic()
            open_part.run(now + min((end - now) / left, _SLICE), stop, tell_of_all)
    proofs = tuple(part.proof() for part in parts)
    return TolerantProof(claim=claim, parts=proofs) if isinstance(claim, TolerantClaim) else proofs[0]
