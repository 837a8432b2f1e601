"""Slices of a proof: what is hatched is what is undecided."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.collections import PatchCollection

import holdfast as hf
from holdfast.certificates import reach_claim, tolerant_claim


def hatched(axes):
    """Share of the box of an axes' first patch under the cells drawn on it, on a grid."""
    box = axes.patches[0].get_bbox()
    x, y = (np.linspace(*side, 2 * 256 + 1)[1::2] for side in ((box.x0, box.x1), (box.y0, box.y1)))
    found = np.zeros((256, 256), dtype=bool)
    (drawn,) = [each for each in axes.collections if isinstance(each, PatchCollection)]
    for path in drawn.get_paths():
        low, high = path.vertices.min(axis=0), path.vertices.max(axis=0)
        found |= ((x > low[0]) & (x < high[0]))[:, None] & ((y > low[1]) & (y < high[1]))[None]
    return found.mean()


def test_what_is_hatched_in_a_plane():
    claim = tolerant_claim(hf.arms.load("planar-3r"), (1.7, 1.0), 0.8, working_ranges={1: (0.3, 1.9)}, failures=[1])
    proof = hf.certify(claim, halvings=4)
    assert 0 < proof.tolerant < 1
    assert hatched(proof.plot().axes[0]) == pytest.approx(1 - float(proof.tolerant), abs=1e-12)


def test_slices_of_a_box():
    """Through the middle, and where most is undecided."""
    proof = hf.certify(reach_claim(hf.arms.load("panda"), (0.8, 0.0, 0.5), (0.3, 0.2, 0.2)), halvings=3)
    figure = proof.plot()
    assert [axes.get_title(loc="left") for axes in figure.axes[:2]] == ["y = 0 m", "x = 0.8 m"]
    assert 0 < proof.undecided < 1
    assert hatched(figure.axes[2]) > 0
