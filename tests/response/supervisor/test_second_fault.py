"""A second joint fails while the arm goes on without the first: it is named, braked and left out as well."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.response.faults import FaultEvent

pytest.importorskip("mujoco")
BODY = hf.Body(3)
STARTS = {"panda": [0.3, 0.2, 0.2, -1.7, 0.3, 1.7, 0.2], "iiwa14": [0.3, 0.5, 0.2, -1.5, 0.3, 1.0, 0.2]}


@pytest.fixture(scope="module", params=list(STARTS))
def made(request):
    """A law, where it starts, its goal, and a monitor of healthy motions there and elsewhere."""
    arm, start = hf.arms.load(request.param), np.array(STARTS[request.param])
    law = hf.control.damped(arm, 0.02, task="position", gain=2.0, speed_limit=0.25)
    here = arm.forward_kinematics(start)[:3, 3]
    goals = here + np.array([[0.0, -0.6, 0.0], [-0.2, -0.2, 0.3], [0.1, 0.3, -0.2]])
    logs = [hf.simulate_faults(law, start, goal, body=BODY, seed=k, time_limit=4).log() for k, goal in enumerate(goals)]
    bounds = hf.diagnosis.calibrate(arm, logs, factor=3.0, coulomb=[0.5] * arm.n, viscous=[0.3] * arm.n)
    return law, start, goals[0], hf.diagnosis.Monitor(arm, bounds)


@pytest.mark.parametrize(("first", "second"), [("locked", "limp"), ("sensor_freeze", "locked"), ("limp", "sensor_freeze")])
def test_both_joints_are_named_braked_and_left_out_and_no_other(made, first, second):
    law, start, goal, monitor = made
    names = [law.arm.joint_names[k] for k in (3, 1)]
    faults = [FaultEvent(first, names[0], 0.5), FaultEvent(second, names[1], 1.6)]
    run = hf.simulate_faults(law, start, goal, faults=faults, body=BODY, seed=9, monitor=monitor, time_limit=2.6)
    brakes = {a.joint: a.time for a in run.actions if a.what == "brake"}
    assert list(brakes) == names
    assert 1.6 < brakes[names[1]] < 2.2
    assert [v.joint for v in run.verdicts if v.joint] == names
    assert set(run.degraded.locked) == set(names)
    still = run.q[run.time > brakes[names[1]] + 0.1]
    assert np.ptp(still[:, [3, 1]], axis=0).max() < 2e-4
    assert [run.degraded.locked[name] for name in names] == pytest.approx(run.q[-1, [3, 1]], abs=2e-3)
