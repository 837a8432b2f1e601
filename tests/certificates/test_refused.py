"""Claims that would take more boxes than a certificate may have are refused beforehand, with an estimate."""

from __future__ import annotations

import re

import numpy as np
import pytest

import holdfast as hf
from holdfast.certificates import ceiling_claim, out_of_reach_claim, reach_claim
from holdfast.certificates.joint_boxes import halving
from holdfast.certificates.joint_boxes.halving import OPEN_TOKEN, BoxBisection, require_feasible_box_count, summarize_tree
from holdfast.certificates.taylor import ReachSolver
from holdfast.core.errors import InputError


def along_first(size):
    """A test that decides boxes of a width along the first axis."""

    def test(middle, half):
        return np.where(half[:, 0] <= size, 0, OPEN_TOKEN), np.where([True, False], half, 0.0)

    return test


def test_the_estimate_of_a_uniform_tree_is_exact():
    box, deep = np.array([[0.0, 1.0], [0.0, 1.0]]), 25
    require_feasible_box_count(along_first(2.0**-25), box, 60, 0, "")  # 2^24 boxes
    with pytest.raises(InputError, match=r"about 3e[+]07 boxes; ask for less"):
        require_feasible_box_count(along_first(2.0**-26), box, 60, 0, "ask for less")
    require_feasible_box_count(along_first(2.0**-26), box, deep - 1, 0, "")  # there is nothing more to halve
    tree = BoxBisection(box, 60)
    tree.run(along_first(2.0**-11))
    assert summarize_tree(tree.tree.preorder_tokens(), tree.tested, True).leaves == 2**10


def test_poses_in_a_wide_box(panda):
    rpy = np.column_stack([[np.pi - 0.17, -0.17, -0.17], [np.pi + 0.17, 0.17, 0.17]])
    for joint, at in (("panda_joint4", (-2.1, -1.1)), ("panda_joint1", (-0.5, 0.5))):
        with pytest.raises(InputError, match=r"about \de[+]\d\d cells and .*; with 1/\d+ of each edge and of the"):
            hf.certify(reach_claim(panda, [0.5, 0, 0.5], 0.1, rpy=rpy, locked={joint: at}))


def test_bounds_and_distances(panda, monkeypatch):
    monkeypatch.setattr(halving, "MAX_LEAVES", 16)
    ready = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
    box = np.column_stack([ready - 0.1, ready + 0.1])
    with pytest.raises(InputError, match=r"about \de[+]\d\d boxes; use a smaller box, or a threshold farther from 0.01"):
        hf.certify(ceiling_claim(panda, box, 0.0125))
    monkeypatch.setattr(halving, "MAX_LEAVES", 0)
    with pytest.raises(InputError, match=r"about \de[+]\d\d boxes; use a smaller box, or a narrower interval"):
        hf.certify(out_of_reach_claim(panda, [0.5, 0, -0.3], 0.015, locked={1: (-0.35, -0.26)}))


def test_targets_without_configurations(three, capsys, monkeypatch):
    """Of a box that the arm reaches in part it is said how much is not; of one that it does not reach nothing is looked for."""
    monkeypatch.delenv("HOLDFAST_NOTICES", raising=False)
    corner = reach_claim(three, [2.6, 1.2], 0.6)
    hf.certify(corner, halvings=1)
    lost, drawn = map(
        int, re.search(r"no configuration was found for (\d+) of (\d+) sampled targets", capsys.readouterr().err).groups()
    )
    axes = (np.linspace(*side, 200) for side in corner.box)
    assert lost / drawn == pytest.approx((np.hypot(*np.meshgrid(*axes)) > 3).mean(), abs=0.12)  # four deviations
    hf.certify(reach_claim(three, [1.5, 0.5], 0.2), halvings=1)
    assert "no configuration" not in capsys.readouterr().err
    for size, said in ((0.1, f"any of {drawn} sampled targets"), (0.0, "this target")):
        with pytest.raises(InputError, match=f"with joint2 locked, no configuration was found for {said}") as refusal:
            hf.certify(reach_claim(three, [2.9, 0], size, locked={1: (1.0, 1.1)}))
        assert "prove" not in str(refusal.value).replace("try to prove the opposite", "")


@pytest.mark.parametrize(("centre", "size"), [((2.6, 1.2), 0.6), ((2.2, 2.2), 0.5), ((3.0, 0.0), 0.4)])
def test_the_counts_are_those_of_a_count_by_hand(three, capsys, monkeypatch, centre, size):
    """Three links of 1 m reach whatever is within 3 m, so the targets that were drawn can be counted without any search."""
    monkeypatch.delenv("HOLDFAST_NOTICES", raising=False)
    sampled, solved = [], ReachSolver.solve_inverse_kinematics

    def noted(self, q, targets, *options, **named):
        sampled.append(np.unique(targets, axis=0))
        return solved(self, q, targets, *options, **named)

    monkeypatch.setattr(ReachSolver, "solve_inverse_kinematics", noted)
    hf.certify(reach_claim(three, list(centre), size), halvings=1)
    said = capsys.readouterr().err
    lost = int((np.linalg.norm(sampled[0], axis=1) > 3).sum())
    assert f"no configuration was found for {lost} of {len(sampled[0])} sampled targets" in said
    assert "prove" not in said
