"""How far an arm with masses and servos is from the motion that it plays: joints, tool, and a limit."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles

SERVOS = hf.Servos(rate=250.0)
TIME = np.linspace(0, 0.6, 13)
HOME = np.array([0.3, 0.2, 0.1, -2.0, 0.1, 2.0, 0.5])
WAY = HOME + (0.5 - 0.5 * np.cos(np.pi * TIME / 0.6))[:, None] * [0.4, 0.3, 0.0, 0.2, 0.0, 0.3, 0.0]


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


def test_the_first_joint_beyond_the_limit_and_the_tool_error_are_those_of_the_table(panda):
    limit = np.deg2rad(2.0)
    call = {"locked": ["panda_joint6", "panda_joint2"], "lock_time": [0.35, 0.2], "servos": SERVOS, "settle": 0.1}
    run = hf.execute(panda, WAY, TIME, error_limit=(limit, np.inf), **call)
    assert run.lock_time[[1, 5]].tolist() == [0.2, 0.35]  # times are in the order of the joints that were given
    planned = np.stack([np.interp(run.time, TIME, column) for column in WAY.T], axis=1)
    off = np.abs(run.q - planned)
    np.testing.assert_allclose(run.following_error, off, atol=1e-12)
    first = int((off > limit).any(axis=1).argmax())
    assert run.first_excess == (panda.joint_names[int(off[first].argmax())], run.time[first])
    assert run.first_excess[0] == "panda_joint2"
    assert 0.2 < run.first_excess[1] < 0.3
    assert not run.ok
    measured, wanted = oracles.forward(panda, run.q), oracles.forward(panda, planned)
    np.testing.assert_allclose(run.tool_error[0], np.linalg.norm((measured - wanted)[:, :3, 3], axis=1), atol=1e-9)
    turn = Rotation.from_matrix(measured[:, :3, :3]) * Rotation.from_matrix(wanted[:, :3, :3]).inv()
    np.testing.assert_allclose(run.tool_error[1], turn.magnitude(), atol=1e-7)
    said = " ".join(run.describe())
    assert f"first exceeds 2 deg at {run.first_excess[1]:.4g} s, in panda_joint2" in said
    assert f"{1000 * run.tool_error[0][-1]:.3g} mm" in said


def test_a_healthy_arm_keeps_the_limit(panda):
    run = hf.execute(panda, WAY, TIME, error_limit=(np.deg2rad(2.0), 0.01), servos=SERVOS)
    assert run.first_excess is None
    assert run.ok
    assert "The following error stays within its limit in every joint." in run.describe()
    with pytest.raises(hf.HoldfastError, match="two numbers above 0"):
        hf.execute(panda, WAY, TIME, error_limit=(0.0, 1.0))
