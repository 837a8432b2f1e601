"""What runs beside the page: best and worst of a pose, and motions that are over before they begin."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.studio import State
from holdfast.interface.studio.compute import find_best_and_worst
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.motions import simulate_law_motions
from holdfast.kinematics.solvers import optima
from holdfast.model.arm.poses import pose_numbers
from holdfast.model.arm.task import as_task


@pytest.fixture(scope="module")
def machine():
    arm = hf.arms.load("planar-3r")
    return CompiledArm(arm, as_task(arm, "planar"))


def state(machine, q, **more):
    return State("planar-3r", machine.arm.joint_names, tuple(q), task="planar", **more)


@pytest.mark.parametrize("objective", ["relative-manipulability", "condition-number"])
def test_where_the_arm_is_counts_as_best_and_worst(machine, monkeypatch, objective):
    """A search that found nothing better or worse than the middling."""
    index = machine.get_index(objective)
    sign = 1.0 if index.better == "larger" else -1.0
    draws = np.random.default_rng(5).uniform(-2, 2, (200, 3))
    low, middle, high = draws[np.argsort(sign * np.asarray(index(draws)))[[5, 100, 195]]]

    def found(arm, pose, wanted, **_):
        return SimpleNamespace(q=middle, value=float(index(middle)), success=True)

    monkeypatch.setattr(optima, "optimise", found)
    for q, place in ((low, 1), (high, 0)):
        extremes = find_best_and_worst(machine, state(machine, q, objective=objective), lambda *_: None)
        best, worst, here = extremes["values"]
        assert here == float(index(q))
        assert sign * best >= sign * here >= sign * worst
        np.testing.assert_array_equal(extremes["q"][place], q)
        assert extremes["values"][place] == here
        np.testing.assert_array_equal(extremes["q"][1 - place], middle)


def test_a_target_where_the_hand_is_is_no_error(machine):
    q = (0.3, 0.8, 0.9)
    at = pose_numbers(machine.tool_pose(np.array(q)))
    assert machine.pose_error_norm(np.array(q), machine.tool_pose(np.array(q))) == 0
    motions = simulate_law_motions(
        machine, state(machine, q, target=tuple(at), laws=("pseudoinverse", "damped:0.1")), lambda *_: None
    )
    for motion in motions:
        np.testing.assert_array_equal(motion.q[0], q)


def test_how_far_the_hand_is_from_its_target_is_seen_by_the_task(machine):
    q = np.array([0.3, 0.8, 0.9])
    pose = machine.tool_pose(q)
    pose[:3, 3] += [0.03, 0.04, 7.0]  # a planar task does not look up
    assert machine.pose_error_norm(q, pose) == pytest.approx(0.05)
