"""Contacts that are certain, and which shape is not known where others are not.

A contact is certain if it is between bodies that lie within the arm: meshes and primitives that were read, and capsules that
were given as its shape. Capsules that cover a shape, or whose radius is assumed, may overlap where the arm does not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.clearance.capsules import link_name
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.engines import installed

Array = NDArray[np.float64]

_ROUNDING = 1e-9  # m


def certain_contacts(clearance: Clearance, q: Array, margin: float = 0.0) -> list[str]:
    """Name, for each configuration (N, n), two things that are certainly closer than they may be; empty where none is known.

    Args:
        clearance: What may not touch, and the margins of its objects.
        q: (N, n) rad and m, finite.
        margin: m, kept between all of them, beyond the margins of objects.
    """
    names, exactness, arm = [""] * len(q), clearance.exactness, clearance.arm
    own = len(clearance.capsules) - clearance.capsules.held
    if clearance.capsules.shape is None and exactness.parts_known:
        gaps = clearance.alone.by_pair(q)
        for k, pair in enumerate(clearance.pairs):
            for touching in np.flatnonzero(gaps[:, k] < margin - _ROUNDING) if max(pair) < own else ():
                names[touching] = clearance.pair_names[k]
    inner, solids = exactness.inner
    if solids and len(inner.balls.link) and clearance.cell is not None:
        allowed = margin + np.array([clearance.cell.margin_of(solid) for solid in solids])
        links = np.unique(inner.balls.link)
        for row, link, k in np.argwhere(inner.distances(q) < allowed - _ROUNDING).tolist():
            names[row] = f"{link_name(arm, int(links[link]))} & {solids[k].name}"
    left = np.array([row for row, name in enumerate(names) if not name], dtype=np.int64)
    if left.size and installed():
        for row, name in zip(left.tolist(), exactness.known_contacts(q[left], margin), strict=True):
            names[row] = name
    return names


def unknown_shape(clearance: Clearance | None) -> str:
    """Say which shape is not known exactly, a clause that names it; empty if every contact can be decided."""
    if clearance is None or not clearance.pair_names:
        return ""
    capsules, arm = clearance.capsules, clearance.arm
    shape, about = capsules.shape, capsules.own.describe(arm)
    if shape is None and capsules.assumed(arm):
        return f"the shape of the arm was not read: {about}"
    if shape is None and capsules.covers:
        return f"the shapes that the capsules contain were not read: {about}"
    if shape is not None and shape.missing:
        links = ", ".join(link_name(arm, link) for link in sorted({item.link for item in shape.missing}))
        return f"the shape of {links} was not read ({shape.missing[0].what})"
    if (shape is not None or clearance.cell is not None) and not installed():
        return "exact distances need python-fcl, which is not installed (pip install 'holdfast[cell]')"
    return ""
