"""Structural zeros: joints between a spherical shoulder and a spherical wrist, whose lock costs everything anywhere.

A force along the line from shoulder to wrist has no moment about the axes that go through one of these points: about none but
that of the joint between. So the arm cannot move that joint and keep its tool still. That axes meet is an identity between
numbers, which no file with a few digits of pi/2 fulfils: it is proved, in rationals, of a geometry near that of the file.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import documents, verifier
from holdfast.certificates.joint_claims import StructuralZeroClaim
from holdfast.certificates.proof import written
from holdfast.certificates.taylor import Chain
from holdfast.errors import InputError
from holdfast.result import Result

Array = NDArray[np.float64]

_TURN, _DIGITS = 1e-4, 9  # rad, of a rotation from quarter turns; of points on axes, m
_QUATERNION = 2**24


@dataclass(frozen=True, kw_only=True)
class StructuralZero(Result):
    """Whether a lock of one joint costs everything by structure, and by how much the geometry was moved to say so exactly.

    Attributes:
        claim: What was asked.
        ok: The axes before the joint meet in one point, and those behind it in another.
        turned: rad, by which a frame was turned at most.
        shifted: m, by which a frame was shifted at most, or would have to be.
        document: The certificate, as its file holds it; None without a proof.
    """

    claim: StructuralZeroClaim
    ok: bool
    turned: float
    shifted: float
    document: dict[str, Any] | None

    def write(self, file: str | Path) -> Path:
        """Write the certificate.

        Raises:
            InputError: There is no proof.
            StoreError: The file cannot be written.
        """
        if self.document is None:
            raise InputError("there is no certificate: " + self.describe()[0])
        return written(self.document, Path(file))

    def describe(self) -> list[str]:
        """A sentence for people, or two."""
        if self.document is not None:
            return [self.document["claim"], "Found by the prover, not yet verified."]
        name = self.claim.arm.joint_names[self.claim.locked]
        by = f"miss a common point by {self.shifted:.4g} m" if np.isfinite(self.shifted) else "are parallel"
        return [f"No structural zero was found for {name}: axes before it, or behind it, {by}."]


def proved(claim: StructuralZeroClaim) -> StructuralZero:
    """The proof, if the geometry is within the tolerance of one whose axes meet exactly."""
    chain, n, k = Chain.of(claim.arm), claim.arm.n, claim.locked
    rotations = [_snapped(turn) for turn in chain.rotations[:n]]
    points, shift = [Fraction(0)] * n, 0.0
    origins = [[Fraction(float(x)) for x in place] for place in chain.origins[:n]]
    for first, last in ((0, k - 1), (k + 1, n - 1)):
        for axis in range(first, last + 1):
            other = axis if axis < last else axis - 1  # the pair of axes whose meeting point is taken
            if first == last:
                continue
            near = chain.nearest(other)
            if near is None:
                return StructuralZero(claim=claim, ok=False, turned=0.0, shifted=np.inf, document=None)
            points[axis] = Fraction(str(round(near[axis - other], _DIGITS)))
        for axis in range(first + 1, last + 1):
            turn_by = verifier.exact_rotation(rotations[axis])
            meant = [-row[2] * points[axis] for row in turn_by]
            meant[2] += points[axis - 1]
            shift = max(shift, *(abs(float(a - b)) for a, b in zip(meant, origins[axis], strict=True)))
            origins[axis] = meant
    if shift > claim.tolerance:
        return StructuralZero(claim=claim, ok=False, turned=0.0, shifted=shift, document=None)
    snapped = [
        {"rotation": [str(x) for x in turn], "origin": [f"{x.numerator}/{x.denominator}" for x in place]}
        for turn, place in zip(rotations, origins, strict=True)
    ]
    written_points = [f"{x.numerator}/{x.denominator}" for x in points]
    document = documents.structural_zero(claim, snapped, written_points)
    turned, shifted = verifier.snap(document)
    return StructuralZero(claim=claim, ok=True, turned=turned, shifted=shifted, document=document)


def _snapped(turn: Array) -> tuple[int, int, int, int]:
    """A quaternion of whole numbers: of quarter turns about the axes if these are near, else of many digits."""
    from scipy.spatial.transform import Rotation

    near = np.round(turn)
    if np.abs(turn - near).max() < _TURN and np.allclose(near @ near.T, np.eye(3)):
        x, y, z, w = Rotation.from_matrix(near).as_quat()
        whole = np.round(np.array([w, x, y, z]) * 2 / min(abs(v) for v in (w, x, y, z) if abs(v) > 0.1) / 2)
        return tuple(int(v) for v in whole)  # type: ignore[return-value]
    x, y, z, w = Rotation.from_matrix(turn).as_quat()
    return tuple(round(float(v) * _QUATERNION) for v in (w, x, y, z))  # type: ignore[return-value]
