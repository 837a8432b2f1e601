"""Search for certified upper and lower bounds of relative manipulability, with the most extreme configuration found."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.joint_boxes.halving import BoxTest, bisect_box, require_feasible_box_count, summarize_tree
from holdfast.certificates.joint_boxes.kernels import ManipulabilityFloorTest
from holdfast.certificates.joint_boxes.wrenches import ManipulabilityCeilingTest
from holdfast.certificates.joint_claims import BoundClaim
from holdfast.certificates.kinds import ClaimKind
from holdfast.certificates.proof import BisectionResult
from holdfast.certificates.search_pool import SearchBudget
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.tree import UNDECIDED_TOKEN
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices import relative_manipulability

_SAMPLE_COUNT = 20_000
_LOCAL_SEARCH_COUNT = 64
_LOCAL_SEARCH_STEPS = 80
_SCREW_ROWS = {"pose": [0, 1, 2, 3, 4, 5], "planar-pose": [2, 3, 4]}  # rows of screws: axes, then moments


@dataclass(frozen=True, kw_only=True)
class ManipulabilityBound(BisectionResult):
    """Result of the prover for a bound of relative manipulability, not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        proved: Exact fraction of the box of configurations in which the bound holds.
        extreme: (n,) best configuration of the box that was found, rad; for a floor the worst one.
        value: Least relative manipulability at ``extreme``. The maximum over the box lies between this value and the ceiling;
            the minimum lies between the floor and this value.
    """

    claim: BoundClaim
    extreme: FloatArray
    value: float

    @property
    def refuted(self) -> bool:
        """True if the extreme configuration is beyond the threshold."""
        return _maximization_sign(self.claim) * (self.value - self.claim.threshold) > 0


def prove_manipulability_bound(claim: BoundClaim, halvings: int, seed: int, budget: SearchBudget) -> ManipulabilityBound:
    """Search for a proof of a bound claim with the options of :func:`holdfast.certify`."""
    started = perf_counter()
    extreme, value = _search_extreme(claim, np.random.default_rng(seed))
    bisection, chain = summarize_tree(bytes([UNDECIDED_TOKEN]), 1, True), CertificateChain.from_arm(claim.arm)
    test: BoxTest = ManipulabilityCeilingTest(chain, claim.locks, claim.threshold)
    if claim.kind == "floor":
        test = ManipulabilityFloorTest(chain, _SCREW_ROWS[claim.task], claim.locks, claim.threshold)
    if _maximization_sign(claim) * (value - claim.threshold) <= 0:
        advice = f"use a smaller box, or a threshold farther from {value:.4g}, which occurs"
        require_feasible_box_count(test, claim.joint_box, halvings, seed, advice)
        bisection = bisect_box(test, claim.joint_box, halvings, budget)
    fields = {"tree": documents.compress_bytes(bisection.tree), "found": documents.encode_floats(extreme)}
    return ManipulabilityBound.from_search(
        claim, fields, bisection, seconds=perf_counter() - started, extreme=extreme, value=value
    )


def _maximization_sign(claim: BoundClaim) -> float:
    return 1.0 if claim.kind == "ceiling" else -1.0


def _search_extreme(claim: BoundClaim, rng: np.random.Generator) -> tuple[FloatArray, float]:
    """Return the best or worst of sampled configurations and corners, refined by random local searches from some of them."""
    index = relative_manipulability(claim.arm, claim.task, failures=list(claim.locks))
    (lower, upper), sign = claim.joint_box.T, _maximization_sign(claim)
    inside, corners = rng.random((_SAMPLE_COUNT, len(lower))), rng.integers(0, 3, (_SAMPLE_COUNT // 4, len(lower))) / 2
    fractions = np.concatenate([inside, corners])
    q = lower + (upper - lower) * fractions
    values = sign * index(q)
    best_rows = np.argsort(-values)[:_LOCAL_SEARCH_COUNT]
    candidates, best_values = q[best_rows], values[best_rows]
    for step_size in 0.2 * 0.85 ** np.arange(_LOCAL_SEARCH_STEPS):
        moves = rng.normal(size=candidates.shape) * rng.integers(0, 2, candidates.shape) * step_size * (upper - lower)
        trials = np.clip(candidates + moves, lower, upper)
        values = sign * index(trials)
        improved = values > best_values
        candidates[improved], best_values[improved] = trials[improved], values[improved]
    return candidates[best_values.argmax()], sign * float(best_values.max())


def _encode_bound_claim(claim: BoundClaim) -> dict[str, Any]:
    box, threshold = (documents.encode_floats(values) for values in (claim.joint_box, claim.threshold))
    return {"joint_box": box, "threshold": threshold, "locks": list(claim.locks)}


CEILING_KIND = ClaimKind("ceiling", prove_manipulability_bound, _encode_bound_claim, halvings=16)
FLOOR_KIND = ClaimKind("floor", prove_manipulability_bound, _encode_bound_claim, halvings=16)
