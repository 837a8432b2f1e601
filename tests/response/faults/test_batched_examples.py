"""The examples for simulators that are not here: what holdfast gives them goes where they put it, in stand-ins."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

import holdfast as hf

EXAMPLES = Path(__file__).parents[3] / "examples"
JOINTS, ROWS, STEP = ("a", "b"), 6, 0.02
XML = """
<mujoco><worldbody><body><joint name="a"/><geom size=".1"/><body pos=".3 0 0"><joint name="b"/><geom size=".1"/></body></body>
</worldbody></mujoco>
"""


@pytest.fixture
def faults():
    return hf.faults.FaultModel(
        [hf.faults.locked("a", onset=0.1, probability=0.5), hf.faults.friction("b", coulomb=0.3, onset=0.2)], 3
    )


def locked_rows(faults):
    return [any(e.kind == "locked" for e in faults.draw(JOINTS, episode=k)) for k in range(ROWS)]


def test_mjlab_has_rows_of_its_own_for_what_fails(faults):
    example = runpy.run_path(str(EXAMPLES / "faults_mjlab.py"))
    one = mujoco.MjModel.from_xml_string(XML)
    rows = SimpleNamespace(jnt_qposadr=one.jnt_qposadr, jnt_dofadr=one.jnt_dofadr)
    data = SimpleNamespace(qpos=np.arange(2.0 * ROWS).reshape(ROWS, 2))

    def expand(names):
        for name in names:
            setattr(rows, name, np.repeat(np.array(getattr(one, name))[None], ROWS, axis=0))

    env = SimpleNamespace(num_envs=ROWS, sim=SimpleNamespace(expand_model_fields=expand, model=rows, data=data, mj_model=one))
    example["prepare"](env, faults, JOINTS)
    for k in range(20):
        example["apply"](env, [0, 1], k * STEP, STEP)
    locked = locked_rows(faults)
    assert 0 < sum(locked) < ROWS
    assert rows.jnt_limited[:, 0].tolist() == locked
    assert rows.jnt_range[locked, 0].mean(axis=1) == pytest.approx(data.qpos[locked, 0])
    assert not rows.jnt_limited[:, 1].any()
    assert rows.dof_frictionloss.tolist() == [[0.0, 0.3]] * ROWS
    assert not rows.dof_damping.any()


def test_isaac_lab_is_told_once_of_each_fault(faults, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    faults.save("faults.yaml")
    # Its tensors have ``view`` where NumPy has ``reshape``.
    torch = SimpleNamespace(
        tensor=lambda x, device: np.array(x), stack=lambda x: SimpleNamespace(view=lambda *s: np.reshape(x, s))
    )
    monkeypatch.setitem(sys.modules, "torch", torch)
    limits, frictions = [], []
    robot = SimpleNamespace(
        joint_names=JOINTS,
        data=SimpleNamespace(joint_pos=np.arange(2.0 * ROWS).reshape(ROWS, 2)),
        write_joint_position_limit_to_sim=lambda limit, **where: limits.append((limit.ravel(), where)),
        write_joint_friction_coefficient_to_sim=lambda value, **where: frictions.append((value, where)),
    )
    env = SimpleNamespace(num_envs=ROWS, device="cpu", scene={"robot": robot})
    example = runpy.run_path(str(EXAMPLES / "faults_isaac_lab.py"))
    for k in range(20):
        example["begin"](env, SimpleNamespace(name="robot"), k * STEP, STEP)
    rows = [int(where["env_ids"][0]) for _, where in limits]
    assert rows == [k for k, some in enumerate(locked_rows(faults)) if some]
    assert [limit.mean() for limit, _ in limits] == pytest.approx([2.0 * k for k in rows])
    assert [(value, where["joint_ids"]) for value, where in frictions] == [(0.3, [1])] * ROWS
