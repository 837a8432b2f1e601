"""Pages of proofs: pictures of boxes against their definition, and what is said once the verifier has looked."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.presentation.certificates.joint_boxes import LeafBoxes


def halved(rng, axes, most):
    """Leaves of a random bisection: places, depths."""
    waiting, leaves = [((0,) * axes, (0,) * axes)], []
    while waiting:
        place, depth = waiting.pop()
        if sum(depth) < most and rng.random() < 0.85:
            axis = int(rng.integers(axes))
            for upper in (0, 1):
                waiting.append(
                    (
                        tuple(2 * k + upper if a == axis else k for a, k in enumerate(place)),
                        tuple(d + (a == axis) for a, d in enumerate(depth)),
                    )
                )
        else:
            leaves.append((place, depth))
    return tuple(np.array(x) for x in zip(*leaves, strict=True))


def test_a_picture_shows_the_worst_of_the_other_axes(rng):
    place, depth = halved(rng, 3, 8)
    undecided = rng.random(len(place)) < 0.1
    leaves = LeafBoxes(np.tile([0.0, 1.0], (3, 1)), list("abc"), np.ones(3, bool), place, depth, undecided)
    worst, left = leaves.project_onto((0, 2))
    for i, j in rng.integers(0, 128, (40, 2)):
        point = (np.array([i, j]) + 0.5) / 128
        low, width = place[:, [0, 2]] * 0.5 ** depth[:, [0, 2]], 0.5 ** depth[:, [0, 2]]
        over = ((low <= point) & (point < low + width)).all(axis=1)
        assert worst[i, j] == depth[over].sum(axis=1).max()
        assert left[i, j] == undecided[over].any()
    deep = LeafBoxes(
        leaves.axis_ranges, leaves.axis_names, leaves.is_angle, place << 9, depth + 9, undecided
    )  # finer than a picture
    assert set(zip(*np.nonzero(deep.project_onto((0, 1))[1]), strict=True)) == {
        (k >> (d + 2), m >> (e + 2))
        for (k, m), (d, e) in zip((place << 9)[undecided][:, :2], depth[undecided][:, :2], strict=True)
    }


@pytest.mark.parametrize(("below", "refuted"), [(0.07, False), (0.06, True)])
def test_a_page_says_who_verified_it_and_what_was_found(below, refuted, panda, tmp_path):
    middle = np.deg2rad([-35, -45, 51, -111, -46, 84, -3])
    box = np.column_stack([middle - np.deg2rad(3), middle + np.deg2rad(3)])
    found = hf.certify(hf.certificates.ceiling_claim(panda, box, below))
    check = None if refuted else hf.check_certificate(found.write(tmp_path / "a.certificate"))
    html = found.report(tmp_path / "a.html", check=check, file="a.certificate").read_text(encoding="utf-8")
    assert ("it is not yet verified" in html) == refuted
    assert ("a program that is independent of the prover" in html) != refuted
    assert ("by a witness" in html) == ("The claim is false" in html) == found.refuted == refuted
    assert ("Smallest boxes, or largest undecided boxes" in html) != refuted
    assert found.document["digest"] in html
    assert "holdfast certificate check a.certificate" in html
    assert f"{found.value:.6f} occurs" in html
