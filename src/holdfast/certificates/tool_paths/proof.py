"""What the search for motions found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from time import monotonic, perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import ROWS
from holdfast.certificates.proof import InParts, early, written
from holdfast.certificates.taylor import Chain
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import Following
from holdfast.certificates.tool_paths.march import LockedPath, March
from holdfast.certificates.tree import SearchState, Tell

Array = NDArray[np.float64]
Span = tuple[int, int]

_SLICE = 2.0  # s on a lock, then on the next, so that one that is stopped has something of each


@dataclass(frozen=True, kw_only=True)
class PathProof(InParts):
    """What the search for motions found. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        parts: Of each lock, in the order of the claim.
        document: The certificate, as its file holds it.
    """

    claim: PathClaim
    parts: tuple[LockedPath, ...]
    document: dict[str, Any]

    @property
    def tolerant(self) -> Fraction:
        """Exact part of the lock instants that is proved whichever joint locks."""
        left = [gap for part in self.parts for gap in self.gaps(part)]
        return 1 - verifier.paths.share(left, self.document)

    def gaps(self, part: LockedPath) -> list[Span]:
        """Undecided intervals of lock instants."""
        return verifier.paths.gaps(part.spans, self.document)

    def write(self, file: str | Path) -> Path:
        """Write the certificate.

        Raises:
            StoreError: The file cannot be written.
        """
        return written(self.document, Path(file))

    def describe(self) -> list[str]:
        """A few sentences for people."""
        whichever = f"; whichever joint locks, {verifier.per_cent(self.tolerant)}" if len(self.parts) > 1 else ""
        worst = min(self.parts, key=lambda part: part.proved)
        name = self.claim.arm.joint_names[worst.joint]
        return [
            self.document["claim"],
            f"Found by the prover, not yet verified: of the lock instants proved {verifier.per_cent(self.proved)}, undecided "
            f"{verifier.per_cent(self.undecided, up=True)}{'' if self.ok else f', at most, with a lock of {name}'}"
            f"{whichever}{early(self.finished)}.",
            f"{self.leaves:,} cells are proved and glued, of {self.nodes:,} that were looked at; {self.seconds:.1f} s.",
        ]


class _Lock:
    """The search for one lock."""

    def __init__(self, claim: PathClaim, chain: Chain, joint: int, halvings: int) -> None:
        rows = ROWS[claim.task]
        self.joint, self.followers = joint, _followers(claim, joint, rows)
        tube = np.repeat(claim.tube, [min(3, rows), max(0, rows - 3)]) if claim.tube.any() else np.empty(0)
        limits = np.column_stack([claim.arm.lower, claim.arm.upper])
        following = Following(chain, claim.knots, rows, [joint, *self.followers], tube, limits)
        self.march, self.finished, self._seconds = March(following, claim.during, halvings), False, 0.0

    def run(self, until: float, stop: Callable[[], bool], tell: Callable[[], None]) -> None:
        """On with it until it is time (``monotonic``), or to stop."""
        began = perf_counter()
        self.finished = self.march.run(until, stop, tell)
        self._seconds += perf_counter() - began

    def found(self, during: Span) -> LockedPath:
        """What is proved so far."""
        slabs = tuple(sorted(self.march.proved, key=lambda slab: slab.begin))
        proved = Fraction(sum(slab.stop - slab.begin for slab in slabs), during[1] - during[0])
        return LockedPath(
            joint=self.joint, followers=self.followers, slabs=slabs, proved=proved, nodes=self.march.nodes,
            finished=self.finished, seconds=self._seconds,
        )  # fmt: skip


def proved(claim: PathClaim, halvings: int, end: float, stop: Callable[[], bool], tell: Tell) -> PathProof:
    """As much of a claim as can be proved until it is time (``monotonic``), or to stop."""
    chain, whole = Chain.of(claim.arm), claim.during[1] - claim.during[0]
    locks = [_Lock(claim, chain, joint, halvings) for joint in claim.locks]

    def told() -> None:
        done = sum(slab.stop - slab.begin for lock in locks for slab in lock.march.proved) / (whole * len(locks))
        closed = sum(lock.march.closed for lock in locks) / (whole * len(locks))
        nodes = sum(lock.march.nodes for lock in locks)
        tell(SearchState(proved=done, undecided=closed - done, open=1 - closed, nodes=nodes))

    while (left := [lock for lock in locks if not lock.finished]) and monotonic() < end and not stop():
        for count, lock in zip(range(len(left), 0, -1), left, strict=True):
            now = monotonic()
            lock.run(now + min((end - now) / count, _SLICE), stop, told)
    parts = tuple(lock.found(claim.during) for lock in locks)
    return PathProof(claim=claim, parts=parts, document=documents.path(claim, parts))


def _followers(claim: PathClaim, joint: int, rows: int) -> tuple[int, ...]:
    """Which joints go on with the healthy motion after a lock: such that the others are farthest from singular on it."""
    others = [k for k in range(claim.arm.n) if k != joint]
    if len(others) == rows:
        return ()
    slopes = claim.arm.jacobian(claim.knots)[:, :rows]
    choices = list(combinations(others, len(others) - rows))
    least = [np.linalg.svd(np.delete(slopes, [joint, *left], axis=2), compute_uv=False)[:, -1].min() for left in choices]
    return choices[int(np.argmax(least))]
