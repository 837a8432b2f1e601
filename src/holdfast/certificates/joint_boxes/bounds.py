"""What was found of a ceiling or a floor of relative manipulability, and the configuration that comes nearest to it."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents, verifier
from holdfast.certificates.crew import Effort
from holdfast.certificates.joint_boxes.halving import Test, need_room
from holdfast.certificates.joint_boxes.jobs import halved, summed
from holdfast.certificates.joint_boxes.kernels import Floor
from holdfast.certificates.joint_boxes.wrenches import Ceiling
from holdfast.certificates.joint_claims import BoundClaim
from holdfast.certificates.proof import Halved, early
from holdfast.certificates.taylor import Chain
from holdfast.certificates.tree import UNDECIDED
from holdfast.indices import relative_manipulability

Array = NDArray[np.float64]
_SAMPLES, _CLIMBERS, _CLIMBS = 20_000, 64, 80
_ROWS = {"pose": [0, 1, 2, 3, 4, 5], "planar-pose": [2, 3, 4]}  # of screws: axes, then moments


@dataclass(frozen=True, kw_only=True)
class ManipulabilityBound(Halved):
    """What the prover found for a bound of relative manipulability. It is not verified: :func:`check_certificate` does that.

    Attributes:
        claim: What was asked.
        proved: Exact share of the box of configurations in which the bound holds.
        extreme: (n,) rad, the best configuration of the box that was found; of a floor, the worst.
        value: Least relative manipulability there. The greatest of the box is from this to the ceiling; the lowest from the
            floor to this.
    """

    claim: BoundClaim
    extreme: Array
    value: float

    @property
    def refuted(self) -> bool:
        """True if that configuration is beyond the threshold."""
        return _sign(self.claim) * (self.value - self.claim.threshold) > 0

    def describe(self) -> list[str]:
        """A few sentences for people."""
        at = ", ".join(f"{x:.4g}" for x in np.rad2deg(self.extreme))
        occurs = f"{self.value:.6f} occurs, at ({at}) deg"
        if self.refuted:
            return [
                verifier.qualify_claim(self.document["claim"], self.proved, refuted=True),
                f"Refuted by a witness: {occurs}.",
            ]
        return [
            verifier.qualify_claim(self.document["claim"], self.proved),
            f"Found by the prover, not yet verified: proved {verifier.per_cent(self.proved)} of the box, undecided "
            f"{verifier.per_cent(self.undecided, up=True)}{early(self.finished)}; {occurs}.",
            f"{self.leaves:,} boxes are proved, of {self.nodes:,} that were looked at; {self.seconds:.1f} s.",
        ]


def bounded(claim: BoundClaim, halvings: int, seed: int, effort: Effort) -> ManipulabilityBound:
    """What the search finds, as :func:`holdfast.certify` is asked."""
    began = perf_counter()
    extreme, value = _extreme(claim, np.random.default_rng(seed))
    tree, chain = summed(bytes([UNDECIDED]), claim.arm.n, 1, True), Chain.of(claim.arm)
    test: Test = Ceiling(chain, claim.locks, claim.threshold)
    if claim.kind == "floor":
        test = Floor(chain, _ROWS[claim.task], claim.locks, claim.threshold)
    if _sign(claim) * (value - claim.threshold) <= 0:
        advice = f"a smaller box, or a threshold farther from {value:.4g}, which occurs, takes fewer"
        need_room(test, claim.joint_box, halvings, seed, advice)
        tree = halved(test, claim.joint_box, halvings, effort)
    seconds = perf_counter() - began
    return ManipulabilityBound(
        claim=claim,
        proved=1 - tree.undecided,
        undecided=tree.undecided,
        extreme=extreme,
        value=value,
        leaves=tree.leaves,
        nodes=tree.nodes,
        finished=tree.finished,
        seconds=seconds,
        document=documents.bound(claim, tree, extreme, seconds=seconds),
    )


def _sign(claim: BoundClaim) -> float:
    return 1.0 if claim.kind == "ceiling" else -1.0


def _extreme(claim: BoundClaim, rng: np.random.Generator) -> tuple[Array, float]:
    """The best or worst configuration of samples, corners among them, and of random climbs from some of these."""
    index = relative_manipulability(claim.arm, claim.task, failures=list(claim.locks))
    (low, high), sign = claim.joint_box.T, _sign(claim)
    shares = np.concatenate([rng.random((_SAMPLES, len(low))), rng.integers(0, 3, (_SAMPLES // 4, len(low))) / 2])
    q = low + (high - low) * shares
    value = sign * index(q)
    some = np.argsort(-value)[:_CLIMBERS]
    at, best = q[some], value[some]
    for step in 0.2 * 0.85 ** np.arange(_CLIMBS):
        moves = rng.normal(size=at.shape) * rng.integers(0, 2, at.shape) * step * (high - low)
        moved = np.clip(at + moves, low, high)
        value = sign * index(moved)
        better = value > best
        at[better], best[better] = moved[better], value[better]
    return at[best.argmax()], sign * float(best.max())
