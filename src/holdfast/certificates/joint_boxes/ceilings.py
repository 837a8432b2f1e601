"""What was found of a ceiling of relative manipulability, and the configuration that comes nearest to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents, verifier
from holdfast.certificates.claims import CeilingClaim
from holdfast.certificates.joint_boxes.halving import Halving
from holdfast.certificates.joint_boxes.refutations import Halved
from holdfast.certificates.joint_boxes.wrenches import Ceiling as Test
from holdfast.certificates.proof import early
from holdfast.certificates.taylor import Chain
from holdfast.indices import relative_manipulability
from holdfast.notice import Progress

Array = NDArray[np.float64]
_SAMPLES, _CLIMBERS, _CLIMBS = 20_000, 64, 80
_FINE = 10_000


@dataclass(frozen=True, kw_only=True)
class Ceiling(Halved):
    """What the prover found for a ceiling of relative manipulability. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        proved: Exact share of the box of configurations in which no value is above the threshold.
        best: (n,) rad, the best configuration of the box that was found.
        value: Least relative manipulability there: the greatest one of the box is at least this.
    """

    claim: CeilingClaim
    best: Array
    value: float

    @property
    def refuted(self) -> bool:
        """True if the best configuration is above the threshold."""
        return self.value > self.claim.threshold

    def describe(self) -> list[str]:
        """A few sentences for people."""
        at = ", ".join(f"{x:.4g}" for x in np.rad2deg(self.best))
        occurs = f"{self.value:.6f} occurs, at ({at}) deg"
        if self.refuted:
            return [self.document["claim"], f"Refuted by a witness: {occurs}."]
        return [
            self.document["claim"],
            f"Found by the prover, not yet verified: proved {verifier.per_cent(self.proved)} of the box, undecided "
            f"{verifier.per_cent(self.undecided, up=True)}{early(self.finished)}; {occurs}.",
            f"{self.leaves:,} boxes are proved, of {self.nodes:,} that were looked at; {self.seconds:.1f} s.",
        ]


def bounded(
    claim: CeilingClaim, halvings: int, seed: int, until: float, stop: Callable[[], bool], progress: Progress | None
) -> Ceiling:
    """What the search finds, as :func:`holdfast.certify` is asked."""
    began = perf_counter()

    def tell(closed: float) -> None:
        if progress is not None:
            progress(int(_FINE * closed), _FINE)

    best, value = _best(claim, np.random.default_rng(seed))
    tree, finished = Halving(claim.joint_box, halvings), True
    if value <= claim.threshold:
        finished = tree.run(Test(Chain.of(claim.arm), claim.locks, claim.threshold), until, stop, tell)
    seconds = perf_counter() - began
    return Ceiling(
        claim=claim,
        proved=1 - tree.undecided,
        undecided=tree.undecided,
        best=best,
        value=value,
        leaves=tree.leaves,
        nodes=tree.tested,
        finished=finished,
        seconds=seconds,
        document=documents.ceiling(claim, tree, best, seconds=seconds),
    )


def _best(claim: CeilingClaim, rng: np.random.Generator) -> tuple[Array, float]:
    """The best configuration of samples, corners among them, and of random climbs from the best of these."""
    index = relative_manipulability(claim.arm, claim.task, failures=list(claim.locks))
    low, high = claim.joint_box.T
    shares = np.concatenate([rng.random((_SAMPLES, len(low))), rng.integers(0, 3, (_SAMPLES // 4, len(low))) / 2])
    q = low + (high - low) * shares
    value = index(q)
    some = np.argsort(-value)[:_CLIMBERS]
    at, best = q[some], value[some]
    for step in 0.2 * 0.85 ** np.arange(_CLIMBS):
        moves = rng.normal(size=at.shape) * rng.integers(0, 2, at.shape) * step * (high - low)
        moved = np.clip(at + moves, low, high)
        value = index(moved)
        better = value > best
        at[better], best[better] = moved[better], value[better]
    return at[best.argmax()], float(best.max())
