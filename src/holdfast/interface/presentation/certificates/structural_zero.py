"""Presentation of a structural zero."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.certificates.structure import StructuralZero
from holdfast.interface.presentation.certificates.verification import UNVERIFIED_NOTE
from holdfast.interface.presentation.presentation import Fact, Presentation


def to_dict(zero: StructuralZero) -> dict[str, Any]:
    """Return the claim, whether it is proved, and the changes of the geometry that make it exact; rad and m."""
    data = {"claim": present(zero).answer, "proved": zero.ok, "verified": False}
    return data | {"turned": zero.turned, "shifted": zero.shifted}


def present(zero: StructuralZero) -> Presentation:
    """Present the claim, or the reason for its failure."""
    name, lines = zero.claim.arm.joint_names[zero.claim.locked], [UNVERIFIED_NOTE]
    if zero.document is not None:
        answer = zero.document["claim"]
    else:
        reason = f"miss a common point by {zero.shifted:.4g} m" if np.isfinite(zero.shifted) else "are parallel"
        answer, lines = f"No structural zero was found for {name}: the axes before or behind it {reason}.", []
    facts = [Fact("largest rotation", zero.turned, "rad", digits=2), Fact("largest shift", zero.shifted, "m", digits=2)]
    return Presentation(f"Structural zero of {name}", answer, lines=lines, facts=facts)
