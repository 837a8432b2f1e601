"""The size of a self-motion: a closed form for planar arms, winding numbers by hand, a full one of four joints."""

import numpy as np
import pytest

import holdfast as hf

TURN = 2 * np.pi


def arc(a, b, low, high):
    """Angles at which links a and b span a distance between low and high."""
    ends = np.clip([(x * x - a * a - b * b) / (2 * a * b) for x in (max(low, abs(a - b)), min(high, a + b))], -1, 1)
    return 2 * (np.arccos(ends[0]) - np.arccos(ends[1])) if ends[1] >= ends[0] else 0.0


def planar(lengths):
    return hf.Arm.from_dh([hf.DH(a=x, alpha=0) for x in lengths], name="planar")


@pytest.mark.interpreted
@pytest.mark.parametrize(("spacing", "error"), [(0.02, 2e-3), (0.005, 2e-4)])
def test_planar_arms_have_the_size_of_the_closed_form(spacing, error):
    """Two mirror images share the union of the joints that do not wind; of a 3R at 0.5 m joint 1 winds."""
    l1, l2, l3, r = 1.0, 1.0, 1.0, 0.5
    union = [arc(r, l1, abs(l2 - l3), l2 + l3), arc(l1, l2, abs(r - l3), r + l3), arc(l2, l3, abs(r - l1), r + l1)]
    found = hf.self_motion(planar((l1, l2, l3)), [r, 0.0], "planar", spacing=spacing, starts=16)
    assert len(found.components) == 2
    for c in found.components:
        assert c.closed
        assert abs(c.winding).tolist() == [1, 0, 0]
        assert c.ranges[0] == TURN == pytest.approx(union[0])
        np.testing.assert_allclose(c.ranges[1:], np.array(union[1:]) / 2, atol=error)
    assert found.size == pytest.approx(TURN + sum(union[1:]) / 2, abs=2 * error)
    assert not found.full


@pytest.mark.interpreted
def test_a_full_self_motion_of_four_joints():
    """The table of the specification, found by a search: winding numbers 1, -2, 1, 1 on the curve of length 19.184."""
    table = zip((0.3513, 0.7216, 0.8886, 0.8824), (0.8165, -0.5746, -2.36, 0), (0, 0.5749, -0.1472, 0.8259), strict=True)
    arm = hf.Arm.from_dh([hf.DH(a=a, alpha=alpha, d=d) for a, alpha, d in table], name="full")
    target = arm.forward_kinematics([0, 0.4967, 2.6507, -2.547])[:3, 3]
    found = hf.self_motion(arm, target, "position", spacing=0.05, starts=16)
    assert sorted(round(c.length, 1) for c in found.components) == [19.2, 20.5]
    best = min(found.components, key=lambda c: c.length)
    assert abs(best.winding).tolist() == [1, 2, 1, 1]
    assert found.full
    assert found.size == 4 * TURN
    # Neither the base nor the scale counts.
    larger = hf.Arm.from_dh([hf.DH(a=3 * r.a, alpha=r.alpha, d=3 * r.d) for r in hf.arms.dh_table(arm).rows], name="larger")
    assert hf.self_motion(larger, 3 * target, "position", spacing=0.05, starts=8).size == 4 * TURN


@pytest.mark.interpreted
def test_limits_cut_a_self_motion():
    arm = planar((1, 1, 1)).with_limits([-1, -3, -3], [1, 3, 3])
    found = hf.self_motion(arm, [1.5, 0.0], "planar", spacing=0.02, starts=32)
    spans = [np.ptp(c.q, axis=0).sum() for c in found.components]
    assert found.size == pytest.approx(max(spans), abs=2e-3)
    assert not found.full
    mixed = hf.self_motion(planar((1, 1, 1, 1)), [1.5, 0.0], "planar", spacing=0.5, starts=2)
    with pytest.raises(hf.TaskError, match="are no curves"):
        _ = mixed.size
