"""Parts of the decision after an alarm, against least squares and closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.decision import AlarmDecision
from holdfast.response.diagnosis.kinds import FaultClassifier
from holdfast.response.diagnosis.sensors import Sensors


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


@pytest.fixture
def decision(panda):
    """A decision without torques, at 1 kHz."""
    unseen, same = np.full(7, np.inf), np.ones(7)
    numbers = {"rate": 1000.0, "position": 2e-3, "angle": 4e-3, "factor": 1.5, "hours": 0.1, "logs": 1, "alarms": None}
    arrays = {"torque": unseen, "change": unseen, "tracking": 0.01 * same, "coulomb": same, "viscous": same, "scales": same}
    bounds = Bounds(fingerprint="", joints=panda.joint_names, speed=same, **numbers, **arrays)
    settings = {"time": 0.9, "level": np.zeros(7), "joints": np.ones(7, dtype=bool), "torques": False}
    return AlarmDecision(panda, bounds, Sensors(position=0.5e-3, angle=2e-3), **settings, tool=True, tool_alone=True)


def test_the_next_joint_is_judged_by_least_squares(panda, decision, rng):
    """Each sample of the pose has an error of its own of each joint, weighted by the deviations of position and angle."""
    q = np.array(hf.arms.about("panda").home)
    jacobian, weight, left = panda.jacobian(q), np.repeat([1 / 0.5e-3, 1 / 2e-3], 3), np.zeros(7)
    for k in range(1, 9):
        residual = -0.002 * k * jacobian[:, 3] + rng.normal(0, 0.2, 6) / weight
        decision.add_tool_pose(2.0, residual, jacobian)
        for joint in range(7):
            left[joint] += np.linalg.lstsq((jacobian * weight[:, None])[:, [joint]], residual * weight)[1][0]
        first, second = np.sort(left)[:2]
        if second - first > 28:
            break
    assert k > 1
    found = decision.current_verdict(last=True)
    assert found.joint == panda.joint_names[3] == panda.joint_names[left.argmin()]
    assert f"worse by {second - first:.3g} squared deviations" in found.evidence[1]


def test_a_record_that_ends_with_its_alarm_names_the_joint_with_the_largest_residual(panda, decision):
    still, tracking = np.zeros(7), np.array([0.1, 0.2, 0.3, 0.2, 1.4, 0.3, 0.2])
    decision._sensor_suspected = False
    for _ in range(3):
        decision.add_cycle(still, still, (still, still, still, still), still, tracking)
    assert decision.current_verdict(last=True).joint == panda.joint_names[4]
    assert decision.current_verdict().joint is None


@pytest.mark.parametrize("sign", [-1, 1])
def test_the_uncertainty_of_a_loss_is_reached_by_the_worst_residual(sign):
    """A residual that is off by as much as that of a healthy arm can be, always against the torque or always with it."""
    torque, largest, loss = 4.0 + np.sin(np.arange(100.0)), 0.6, 0.5
    kinds = FaultClassifier(0, coulomb=0.05, bounds=(2.0, 0.01), largest=largest, noise=2e-5, torques=True)
    for k, given in enumerate(torque.tolist()):
        kinds.add_cycle(3e-4 * k - 1e-3, 3e-4 * k, 1.0, (-loss * given + sign * largest, given, 0.0))
    found = kinds.classify("rad", ())
    assert abs(found["loss"] - loss) == pytest.approx(found["uncertainty"], rel=1e-12)
    assert found["uncertainty"] == pytest.approx(0.15, abs=0.01)
