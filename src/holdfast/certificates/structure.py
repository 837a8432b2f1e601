"""Structural zeros: joints between a spherical shoulder and a spherical wrist, whose lock removes all relative manipulability
in every configuration.

A force along the line from shoulder to wrist has no moment about the axes through one of these points, so it has a moment only
about the axis of the joint between them. The arm therefore cannot move that joint and keep its tool still. That axes meet is an
exact identity, which a file with a few digits of pi/2 does not satisfy. It is proved in rational arithmetic for a geometry
close to that of the file.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.certificates import documents, verifier
from holdfast.certificates.joint_claims import StructuralZeroClaim
from holdfast.certificates.kinds import ClaimKind
from holdfast.certificates.proof import CertificateResult
from holdfast.certificates.taylor import CertificateChain
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray

_QUARTER_TURN_TOLERANCE_RAD = 1e-4  # rad, largest angle between a rotation and quarter turns
_POINT_DIGITS = 9  # decimals of points on axes, m
_QUATERNION_SCALE = 2**24


@dataclass(frozen=True, kw_only=True)
class StructuralZero(CertificateResult):
    """Result of the search for a structural zero, with the changes of the geometry that make it exact.

    Attributes:
        claim: Claim that was searched.
        ok: True if the axes before the joint meet in one point, and those behind it in another.
        turned: Largest angle by which a frame was rotated, rad.
        shifted: Largest distance by which a frame was shifted, or would have to be, m.
        document: The certificate in the form of its file; None without a proof.
    """

    claim: StructuralZeroClaim
    ok: bool
    turned: float
    shifted: float
    document: dict[str, Any] | None

    def write(self, file: str | Path) -> Path:
        """Write the certificate to ``file`` and return its path.

        Raises:
            InputError: There is no proof.
            StoreError: The file cannot be written.
        """
        if self.document is None:
            raise InputError("there is no certificate: " + self.describe()[0])
        return super().write(file)


def prove_structural_zero(claim: StructuralZeroClaim) -> StructuralZero:
    """Prove a structural zero if the geometry is within the tolerance of a geometry whose axes meet exactly."""
    chain, n, k = CertificateChain.from_arm(claim.arm), claim.arm.n, claim.locked
    rotations = [_nearest_integer_quaternion(rotation) for rotation in chain.rotations[:n]]
    points, shift = [Fraction(0)] * n, 0.0
    origins = [[Fraction(float(number)) for number in origin] for origin in chain.origins[:n]]
    for first, last in ((0, k - 1), (k + 1, n - 1)):
        for axis in range(first, last + 1):
            neighbor = axis if axis < last else axis - 1  # the pair of axes whose meeting point is taken
            if first == last:
                continue
            heights = chain.closest_points_on_axes(neighbor)
            if heights is None:
                return StructuralZero(claim=claim, ok=False, turned=0.0, shifted=np.inf, document=None)
            points[axis] = Fraction(str(round(heights[axis - neighbor], _POINT_DIGITS)))
        for axis in range(first + 1, last + 1):
            rotation_rows = verifier.rotation_from_quaternion(rotations[axis])
            exact_origin = [-row[2] * points[axis] for row in rotation_rows]
            exact_origin[2] += points[axis - 1]
            changes = (exact - original for exact, original in zip(exact_origin, origins[axis], strict=True))
            shift = max(shift, *(abs(float(change)) for change in changes))
            origins[axis] = exact_origin
    if shift > claim.tolerance:
        return StructuralZero(claim=claim, ok=False, turned=0.0, shifted=shift, document=None)

    def format_fractions(numbers: list[Fraction]) -> list[str]:
        return [f"{number.numerator}/{number.denominator}" for number in numbers]

    frames = [
        {"rotation": [str(number) for number in rotation], "origin": format_fractions(origin)}
        for rotation, origin in zip(rotations, origins, strict=True)
    ]
    fields = {"snapped": frames, "points": format_fractions(points)}
    document = documents.build_document(claim, fields, undecided=Fraction(0), seconds=0.0, nodes=n)
    rotation_error, position_error = verifier.bound_frame_errors(document)
    return StructuralZero(claim=claim, ok=True, turned=rotation_error, shifted=position_error, document=document)


def _nearest_integer_quaternion(rotation: FloatArray) -> tuple[int, int, int, int]:
    """Return an integer quaternion of quarter turns about the axes if they are close, otherwise one with many digits."""
    from scipy.spatial.transform import Rotation

    rounded = np.round(rotation)
    if np.abs(rotation - rounded).max() < _QUARTER_TURN_TOLERANCE_RAD and np.allclose(rounded @ rounded.T, np.eye(3)):
        x, y, z, w = Rotation.from_matrix(rounded).as_quat()
        integers = np.round(np.array([w, x, y, z]) * 2 / min(abs(number) for number in (w, x, y, z) if abs(number) > 0.1) / 2)
        return tuple(int(number) for number in integers)  # type: ignore[return-value]
    x, y, z, w = Rotation.from_matrix(rotation).as_quat()
    return tuple(round(float(number) * _QUATERNION_SCALE) for number in (w, x, y, z))  # type: ignore[return-value]


STRUCTURAL_ZERO_KIND = ClaimKind(
    "structural-zero", lambda claim, *_: prove_structural_zero(claim), lambda claim: {"locked": claim.locked}
)
