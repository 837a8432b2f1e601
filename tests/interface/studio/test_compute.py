"""What runs beside the page: best and worst of a pose, and motions that are over before they begin."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.studio import State
from holdfast.interface.studio.compute import find_best_and_worst, simulate_laws
from holdfast.interface.studio.machine import CompiledArm
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
    motions = simulate_laws(machine, state(machine, q, target=tuple(at), laws=("pseudoinverse", "damped:0.1")), lambda *_: None)
    for motion in motions:
        np.testing.assert_array_equal(motion["q"][0], q)


def test_an_infinite_value_is_null(machine):
    """Stretched, no joint moves the tool along the arm, so the condition number of the pose is infinite."""
    found = find_best_and_worst(machine, state(machine, (0.3, 0.0, 0.0), objective="condition-number"), lambda *_: None)
    assert found["values"][1:] == [None, None]
    assert found["q"][1] == [0.3, 0.0, 0.0]
