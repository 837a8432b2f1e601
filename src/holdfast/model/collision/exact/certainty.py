"""Certain contacts, and the parts of the shape that prevent certainty.

A contact is certain if it is between bodies that lie within the arm: meshes and primitives that were read, and capsules that
were given as its shape. Capsules that cover a shape, or whose radius is assumed, may overlap although the arm does not.
"""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.collision.capsules import link_name
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.engines import is_library_installed

_ROUNDING_M = 1e-9  # m


def name_certain_contacts(clearance: Clearance, q: FloatArray, margin: float = 0.0) -> list[str]:
    """Name for each configuration (N, n) two bodies that are certainly closer than allowed; empty if none is known.

    Args:
        clearance: Collision model with the margins of its objects.
        q: (N, n) configurations, rad and m, finite.
        margin: Required distance between all bodies, m, in addition to the margins of objects.
    """
    names, exactness, arm = [""] * len(q), clearance.exactness, clearance.arm
    own_count = len(clearance.capsules) - clearance.capsules.held
    if clearance.capsules.shape is None and exactness.are_all_shapes_known:
        distances = clearance.self_only.by_pair(q)
        for index, pair in enumerate(clearance.pairs):
            for touching in np.flatnonzero(distances[:, index] < margin - _ROUNDING_M) if max(pair) < own_count else ():
                names[touching] = clearance.pair_names[index]
    inner_objects, solids = exactness.inner_objects_and_sources
    if solids and len(inner_objects.spheres.link) and clearance.cell is not None:
        allowed = margin + np.array([clearance.cell.margin_of(solid) for solid in solids])
        links = np.unique(inner_objects.spheres.link)
        for row, link, index in np.argwhere(inner_objects.link_distances(q) < allowed - _ROUNDING_M).tolist():
            names[row] = f"{link_name(arm, int(links[link]))} & {solids[index].name}"
    unnamed = np.array([row for row, name in enumerate(names) if not name], dtype=np.int64)
    if unnamed.size and is_library_installed():
        for row, name in zip(unnamed.tolist(), exactness.name_known_contacts(q[unnamed], margin), strict=True):
            names[row] = name
    return names


def describe_unknown_shape(clearance: Clearance | None) -> str:
    """Return a clause on the shape that is not known exactly; empty if every contact can be decided."""
    if clearance is None or not clearance.pair_names:
        return ""
    capsules, arm = clearance.capsules, clearance.arm
    shape, source_phrase = capsules.shape, capsules.without_held.describe(arm)
    if shape is None and capsules.is_assumed(arm):
        return f"the shape of the arm was not read: {source_phrase}"
    if shape is None and capsules.covers:
        return f"the shapes that the capsules contain were not read: {source_phrase}"
    if shape is not None and shape.missing:
        links = ", ".join(link_name(arm, link) for link in sorted({item.link for item in shape.missing}))
        return f"the shape of {links} was not read ({shape.missing[0].what})"
    if (shape is not None or clearance.cell is not None) and not is_library_installed():
        return "exact distances need python-fcl, which is not installed (pip install 'holdfast-arms[cell]')"
    return ""
