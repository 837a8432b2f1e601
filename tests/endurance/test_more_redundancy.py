"""Motions of arms with more than one degree of redundancy, whose survival is a lower bound; joints that cannot move."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.errors import TaskError
from unit_links import timed


def planar(lengths, limits):
    joints = [hf.DH(a=length, alpha=0, lower=low, upper=high) for length, (low, high) in zip(lengths, limits, strict=True)]
    return hf.Arm.from_dh(joints, name=f"{len(lengths)}R")


@pytest.fixture(scope="module")
def four():
    """Four links of 1 m, narrow: not every lock can be survived."""
    machine = planar([1.0] * 4, [(-1.0, 1.2), (-0.2, 1.6), (-1.4, 0.4), (-0.5, 1.5)])
    path = timed([3.46, -0.39], [2.47, 0.28])
    return machine, path, hf.endure(machine, path, task="planar", samples=15, spacing=0.15, seed=1)


def test_a_lower_bound_is_called_so(four):
    _, _, best = four
    assert best.kind == "lower bound"
    assert 0.3 < best.survival < 1
    assert best.headline.startswith("at least ")
    assert best.bound is best.gap is best.never is None
    assert len(best.found.held) == 1
    assert any("a lower bound" in line for line in best.describe())


def test_what_is_said_to_be_survived_another_integrator_survives(four):
    """It integrates the branch with the locked joint and one more held; the motion itself goes on where it holds the joint."""
    _, _, best = four
    tried = best.inject(60, seed=3)
    assert tried.survived[tried.expected & tried.told].all()
    assert (~tried.survived).sum() > 3
    ((name, value),) = best.found.held.items()
    np.testing.assert_allclose(best.q[:, best.arm.joint_index(name)], value, atol=1e-9)


def test_the_motion_survives_what_a_judge_of_it_alone_says(four):
    machine, path, best = four
    again = hf.endurance_of(machine, best.q, path, task="planar", samples=15, seed=1)
    np.testing.assert_array_equal(again.survives, best.survives)
    assert again.kind == "lower bound"


def test_a_joint_that_cannot_move_is_no_redundancy():
    """A fourth link that stands still makes the third one longer, and nothing else."""
    limits = [(-1.2, 1.4), (-0.3, 1.8), (-1.6, 0.6)]
    path = timed([2.76, -2.67], [2.09, -1.67])
    options = {"task": "planar", "samples": 15, "spacing": 0.1, "rates": {"joint1": 1, "joint2": 2, "joint3": 1}}
    long = hf.endure(planar([1.0, 1.0, 2.0], limits), path, **options)
    stiff = hf.endure(planar([1.0] * 4, [*limits, (0.0, 0.0)]), path, **options)
    assert stiff.kind == "exact"
    assert 0 < long.survival < 1
    assert stiff.survival == pytest.approx(long.survival, abs=0.01)
    assert stiff.bound == pytest.approx(long.bound, abs=0.01)
    np.testing.assert_array_equal(stiff.q[:, 3], 0)


def test_detours_ask_for_one_degree_of_redundancy(four):
    machine, path, _ = four
    with pytest.raises(TaskError, match="detours are looked at with one"):
        hf.endure(machine, path, task="planar", mode="detour")
